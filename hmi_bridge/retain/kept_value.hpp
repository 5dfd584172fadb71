/// Values that are kept across runs, and how they stand in a retain file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A value of a project that is kept across runs.
struct KeptValue {
  std::string name;  ///< as the project spells it; a file knows it without regard to case
  Signal signal;     ///< a whole value, no bit; of an array its first one
  /// BOOL: whether there is a value to keep; none: always.
  std::optional<Signal> present{};
  /// What the value only holds with, such as the settings of an encoder; empty: nothing.
  std::string basis{};
  /// Of an array: its elements, of structures all members of each, in their order; of a text its
  /// `text_signals`; empty: a single value.
  std::vector<Signal> elements{};
  std::string array_type{};  ///< "ARRAY[1..100] OF LREAL", "STRING[20]"
  std::size_t capacity = 0;  ///< of a text; 0: it is none

  std::span<const Signal> signals() const noexcept {
    return elements.empty() ? std::span(&signal, 1) : std::span(elements);
  }
  /// Published name of its type.
  std::string type() const;
  /// How the values of its signals stand in a file, a text as a literal of IEC 61131-3.
  std::string text(std::span<const Value> values) const;
  /// The values of such a text; none if it is no value of that type.
  std::optional<std::vector<Value>> values(std::string_view text) const;
};

/// The value as it stands in a file; reading it back gives the same bits, but for those of a NaN. BOOL is
/// TRUE or FALSE, TIME in nanoseconds. `type` is elementary.
std::string kept_text(Value value, Type type);

/// The value of such a text; none if it is no value of that type.
std::optional<Value> kept_value(std::string_view text, Type type);

/// Several values as one text: those texts, separated by commas. As many values as signals, whose types
/// count.
std::string kept_texts(std::span<const Value> values, std::span<const Signal> signals);

/// The values of such a text; none if it is not one of these types and this number.
std::optional<std::vector<Value>> kept_values(std::string_view text, std::span<const Signal> signals);

}  // namespace lockstep
