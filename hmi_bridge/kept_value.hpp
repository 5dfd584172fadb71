/// Values that are kept across runs, and how they stand in a retain file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tech_objects/types.hpp"

namespace lockstep {

/// A value of a project that is kept across runs.
struct KeptValue {
  std::string name;  ///< as the project spells it; a file knows it without regard to case
  Signal signal;     ///< a whole value, no bit
  /// BOOL: whether there is a value to keep; none: always.
  std::optional<Signal> present{};
  /// What the value only holds with, such as the settings of an encoder; empty: nothing.
  std::string basis{};
};

/// The value as it stands in a file; reading it back gives the same bits, but for those of a NaN. BOOL is
/// TRUE or FALSE, TIME in nanoseconds. `type` is elementary.
std::string kept_text(Value value, Type type);

/// The value of such a text; none if it is no value of that type.
std::optional<Value> kept_value(std::string_view text, Type type);

}  // namespace lockstep
