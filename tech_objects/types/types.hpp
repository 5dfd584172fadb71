/// The elementary data types of IEC 61131-3 and references to values of these types.
/// @source IEC 61131-3:2013, 6.4.2
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

namespace lockstep {

struct Array;

using BOOL = bool;
using SINT = std::int8_t;
using INT = std::int16_t;
using DINT = std::int32_t;
using LINT = std::int64_t;
using USINT = std::uint8_t;
using UINT = std::uint16_t;
using UDINT = std::uint32_t;
using ULINT = std::uint64_t;
using REAL = float;
using LREAL = double;

/// Bit strings and durations have types of their own, so that a declaration can tell WORD from UINT.
enum class BYTE : std::uint8_t {};
enum class WORD : std::uint16_t {};
enum class DWORD : std::uint32_t {};
enum class LWORD : std::uint64_t {};
/// A duration [ns].
enum class TIME : std::int64_t {};
/// The number of a technology object: its position in `technology_objects` of the project, from 1; 0 is none.
enum class DB_ANY : std::uint32_t {};

/// The types that a tag, a pin or a variable may have.
enum class Type : std::uint8_t {
  BOOL,
  SINT,
  INT,
  DINT,
  LINT,
  USINT,
  UINT,
  UDINT,
  ULINT,
  BYTE,
  WORD,
  DWORD,
  LWORD,
  REAL,
  LREAL,
  TIME,
  DB_ANY,  ///< number of a technology object
  AXIS,    ///< pin that takes a technology object by its name; holds an `Axis*`
  TAG,     ///< variable that takes a tag by its name (VREF); holds the address of a BOOL
  ARRAY    ///< pin that takes an array by the name of its tag; holds a `const Array*`
};

/// Published name of a type, such as "LREAL".
std::string_view type_name(Type type) noexcept;

/// The type with a published name that a tag may have; none for anything else.
std::optional<Type> tag_type(std::string_view name) noexcept;

/// Size in memory [byte].
int size_of(Type type) noexcept;

bool is_signed_integer(Type type) noexcept;    ///< SINT INT DINT LINT
bool is_unsigned_integer(Type type) noexcept;  ///< USINT UINT UDINT ULINT
bool is_integer(Type type) noexcept;
bool is_real(Type type) noexcept;        ///< REAL LREAL
bool is_numeric(Type type) noexcept;     ///< integers and reals
bool is_bit_string(Type type) noexcept;  ///< BYTE WORD DWORD LWORD; BOOL is none of them here

/// Minimum and maximum value of an integer or bit-string type.
std::int64_t lowest(Type type) noexcept;
std::uint64_t highest(Type type) noexcept;

/// Type of a C++ value type.
template <class T>
consteval Type type_of() {
  if constexpr (std::is_same_v<T, bool>)
    return Type::BOOL;
  else if constexpr (std::is_same_v<T, lockstep::SINT>)
    return Type::SINT;
  else if constexpr (std::is_same_v<T, lockstep::INT>)
    return Type::INT;
  else if constexpr (std::is_same_v<T, lockstep::DINT>)
    return Type::DINT;
  else if constexpr (std::is_same_v<T, lockstep::LINT>)
    return Type::LINT;
  else if constexpr (std::is_same_v<T, lockstep::USINT>)
    return Type::USINT;
  else if constexpr (std::is_same_v<T, lockstep::UINT>)
    return Type::UINT;
  else if constexpr (std::is_same_v<T, lockstep::UDINT>)
    return Type::UDINT;
  else if constexpr (std::is_same_v<T, lockstep::ULINT>)
    return Type::ULINT;
  else if constexpr (std::is_same_v<T, lockstep::BYTE>)
    return Type::BYTE;
  else if constexpr (std::is_same_v<T, lockstep::WORD>)
    return Type::WORD;
  else if constexpr (std::is_same_v<T, lockstep::DWORD>)
    return Type::DWORD;
  else if constexpr (std::is_same_v<T, lockstep::LWORD>)
    return Type::LWORD;
  else if constexpr (std::is_same_v<T, lockstep::REAL>)
    return Type::REAL;
  else if constexpr (std::is_same_v<T, lockstep::LREAL>)
    return Type::LREAL;
  else if constexpr (std::is_same_v<T, lockstep::TIME>)
    return Type::TIME;
  else if constexpr (std::is_same_v<T, lockstep::DB_ANY>)
    return Type::DB_ANY;
  else if constexpr (std::is_same_v<T, const bool*>)
    return Type::TAG;
  else if constexpr (std::is_same_v<T, const Array*>)
    return Type::ARRAY;
  else if constexpr (std::is_pointer_v<T>)
    return Type::AXIS;
  else
    return T::no_such_type;
}

/// A value of any elementary type; which member counts is known from the type that goes with it.
/// Integers, bit strings and TIME are held widened to 64 bits, BOOL as 0 or 1 in `u`, REAL and LREAL in `r`.
union Value {
  std::int64_t i;
  std::uint64_t u;
  double r;
};

/// Where a value lives, resolved once at load time; reading and writing it costs a switch and no look-up.
struct Signal {
  void* address = nullptr;
  Type type = Type::BOOL;
  std::int8_t bit =
      -1;  ///< bit of the integer or bit string at `address`, then `type` is that of the word; -1: whole

  /// Type of what `load` gives: BOOL for a bit.
  Type value_type() const noexcept { return bit < 0 ? type : Type::BOOL; }
  Value load() const noexcept;
  /// Stores a value that is already in the range of the type. A bit leaves its neighbours alone.
  void store(Value value) const noexcept;
};

/// What `Signal::load` gives for a variable in memory: of this type, or a bit of it.
Value load_value(const void* address, Type type, std::int8_t bit = -1) noexcept;

/// The value as a double, whatever its type (BOOL as 0 or 1, TIME in seconds): for traces and displays.
double as_double(Value value, Type type) noexcept;

}  // namespace lockstep
