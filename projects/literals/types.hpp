/// Which type becomes which in an expression without being asked to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Wide enough for every integer literal and for the exact result of an operation on two of them.
__extension__ typedef __int128 WideInteger;

/// Whether a value of one type fits a place of the other as it is: the same type, or a wider one along
/// SINT→INT→DINT→LINT, USINT→UINT→UDINT→ULINT, USINT→INT, UINT→DINT, UDINT→LINT, INT and UINT→REAL, DINT and
/// UDINT→LREAL, REAL→LREAL, BYTE→WORD→DWORD→LWORD.
bool widens(Type from, Type to) noexcept;

/// The smallest type that both widen to, an integer before a real one; none if there is no such type.
std::optional<Type> common_type(Type a, Type b) noexcept;

/// Whether an integer is in the range of an integer or bit-string type.
bool in_range(WideInteger value, Type type) noexcept;

/// The smallest integer (or bit-string) type that `type` widens to and that holds both numbers; none if there
/// is no such type.
std::optional<Type> smallest_type(Type type, WideInteger lowest, WideInteger highest) noexcept;

/// The type of a name in any case ("lreal"), of those that a tag may have.
std::optional<Type> type_named(std::string_view name);

std::string upper_case(std::string_view text);

/// A number for a message.
std::string decimal(WideInteger value);

/// A piece of the project's text for a message: quoted, shortened, and without what a terminal cannot show.
std::string quoted(std::string_view text);

}  // namespace lockstep
