/// What every technology object has: a kind, a name and a number.
#pragma once

#include <cstdint>
#include <string>

#include "tech_objects/types.hpp"

namespace lockstep {

/// Published types of technology objects; a bit each, so that a pin can name those it accepts.
enum class ObjectKind : std::uint32_t {
  TO_PositioningAxis = 1u << 0,
  TO_SynchronousAxis = 1u << 1,
};

/// A set of object kinds.
using ObjectKinds = std::uint32_t;
inline constexpr ObjectKinds kAnyAxis = static_cast<ObjectKinds>(ObjectKind::TO_PositioningAxis) |
                                        static_cast<ObjectKinds>(ObjectKind::TO_SynchronousAxis);
inline constexpr ObjectKinds kSynchronousAxis = static_cast<ObjectKinds>(ObjectKind::TO_SynchronousAxis);

/// Published name, such as "TO_SynchronousAxis".
constexpr const char* kind_name(ObjectKind kind) noexcept {
  return kind == ObjectKind::TO_PositioningAxis ? "TO_PositioningAxis" : "TO_SynchronousAxis";
}

/// Base of the technology objects. Only data; the cycle works on the concrete types.
struct TechnologyObject {
  ObjectKind kind;
  std::string name;  ///< as in the project
  DB_ANY number{};   ///< position in `technology_objects`, from 1
};

}  // namespace lockstep
