/// The types of values and their literals, as they are told.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "projects/expressions/example.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

struct TypeText {
  Type type;
  std::string_view meaning;
  Example literal;  ///< a value of it
};

/// The elementary types, each once, in their order.
std::span<const TypeText> elementary_types() noexcept;

/// "-128 to 127".
std::string range_of_type(Type type);
/// The types in which a value of it stands without being converted, from the next one on.
std::vector<Type> wider_types(Type type);
/// The types into which TO_type makes it, itself left out.
std::vector<Type> conversions_of(Type type);
/// "INT, DINT, LINT"; empty for none.
std::string names_of(std::span<const Type> types);

/// A type that is no elementary one.
struct OtherType {
  std::string_view name, meaning;
};
std::span<const OtherType> other_types() noexcept;

/// How values are written in expressions.
struct LiteralForm {
  std::string_view form, meaning;
  Example example;
};
std::span<const LiteralForm> literal_forms() noexcept;

}  // namespace lockstep
