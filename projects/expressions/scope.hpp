/// What the names in an expression stand for.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scheduler/text.hpp"
#include "tech_objects/data_blocks/array.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// What a reference stands for: a signal, or why there is none.
struct Reference {
  std::optional<Signal> signal;
  std::string error;           ///< what is wrong and what is allowed, if there is no signal
  ElementRange elements{};     ///< of a path with "[]": `signal` is the first of them
  std::optional<Text> text{};  ///< of a tag of type STRING, in place of a signal
};

/// What the names in an expression stand for.
class Scope {
 public:
  virtual ~Scope() = default;
  /// Finds `name` (a tag, an instance, a technology object; in any case) and within it `path`, which is what
  /// follows the name, without the point: "" (a tag), "Done", "StatusSynchronizedMotion.StatusWord",
  /// "Sensor[1].Position", "[3]", "[].x" (the element is chosen by an index at run time). A bit .Xn at the
  /// end is resolved by the compiler, unless the path with it names a variable. The signal has to outlive
  /// what is compiled.
  virtual Reference resolve(std::string_view name, std::string_view path) const = 0;
};

}  // namespace lockstep
