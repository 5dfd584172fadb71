/// Paths that name several elements at once: "heights", "heights[*]", "heights[2..5]", "points[*].x".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "projects/expressions/names.hpp"

namespace lockstep {

/// Elements that follow each other.
struct ElementPath {
  std::string before;        ///< "points["
  std::string behind;        ///< "].x"
  std::int64_t first = 0;    ///< index of the first one
  std::int64_t last = 0;     ///< of the last one, ≥ first
  std::string name;          ///< "heights" for all of an array of elementary values, else "points[1..4].x"
  std::string type;          ///< "ARRAY[1..4] OF LREAL"
  bool is_all = false;       ///< the path says no range
  Operand place;             ///< of the first one
  std::uint32_t stride = 0;  ///< from one to the next [byte]

  std::size_t count() const noexcept { return static_cast<std::size_t>(last - first + 1); }
  /// "points[3].x".
  std::string name_of(std::int64_t index) const { return before + std::to_string(index) + behind; }
  /// Where an element lives, `index` from first to last.
  Signal signal_of(std::int64_t index) const noexcept;
};

/// What a path names, if it names several elements.
struct FoundElements {
  std::optional<ElementPath> elements;  ///< none: a single value, or there is a problem
  std::string problem;                  ///< what is wrong, what is allowed; empty if nothing is
  bool known_problem = false;           ///< which has been reported already
};

/// Looks whether a path names several elements: an array without an index, or with [*] or [first..last].
FoundElements find_several(const Names& names, std::string_view path);

}  // namespace lockstep
