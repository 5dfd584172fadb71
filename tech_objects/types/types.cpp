#include "tech_objects/types/types.hpp"

#include <array>
#include <cstring>
#include <limits>

namespace lockstep {
namespace {

constexpr std::array<std::string_view, 20> kNames = {
    "BOOL", "SINT",  "INT",   "DINT", "LINT",  "USINT", "UINT",   "UDINT", "ULINT", "BYTE",
    "WORD", "DWORD", "LWORD", "REAL", "LREAL", "TIME",  "DB_ANY", "AXIS",  "TAG",   "ARRAY"};
constexpr std::array<int, 20> kSizes = {1, 1, 2, 4, 8, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8, 8, 4, 8, 8, 8};

template <class T>
T read(const void* address) noexcept {
  T value;
  std::memcpy(&value, address, sizeof value);
  return value;
}

template <class T>
void write(void* address, T value) noexcept {
  std::memcpy(address, &value, sizeof value);
}

}  // namespace

std::string_view type_name(Type type) noexcept {
  return kNames[static_cast<std::size_t>(type)];
}

std::optional<Type> tag_type(std::string_view name) noexcept {
  for (std::size_t i = 0; i <= static_cast<std::size_t>(Type::TIME); ++i)
    if (kNames[i] == name) return static_cast<Type>(i);
  return std::nullopt;
}

int size_of(Type type) noexcept {
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_signed_integer(Type type) noexcept {
  return type >= Type::SINT && type <= Type::LINT;
}
bool is_unsigned_integer(Type type) noexcept {
  return type >= Type::USINT && type <= Type::ULINT;
}
bool is_integer(Type type) noexcept {
  return is_signed_integer(type) || is_unsigned_integer(type);
}
bool is_real(Type type) noexcept {
  return type == Type::REAL || type == Type::LREAL;
}
bool is_numeric(Type type) noexcept {
  return is_integer(type) || is_real(type);
}
bool is_bit_string(Type type) noexcept {
  return type >= Type::BYTE && type <= Type::LWORD;
}

std::int64_t lowest(Type type) noexcept {
  if (!is_signed_integer(type) && type != Type::TIME) return 0;
  return std::numeric_limits<std::int64_t>::min() >> (64 - 8 * size_of(type));
}

std::uint64_t highest(Type type) noexcept {
  if (type == Type::BOOL) return 1;
  const bool has_sign = is_signed_integer(type) || type == Type::TIME;
  return std::numeric_limits<std::uint64_t>::max() >> (64 - 8 * size_of(type) + (has_sign ? 1 : 0));
}

Value Signal::load() const noexcept {
  return load_value(address, type, bit);
}

Value load_value(const void* address, Type type, std::int8_t bit) noexcept {
  Value value{};
  switch (type) {
    case Type::BOOL:
      value.u = read<bool>(address) ? 1 : 0;
      break;
    case Type::SINT:
      value.i = read<std::int8_t>(address);
      break;
    case Type::INT:
      value.i = read<std::int16_t>(address);
      break;
    case Type::DINT:
      value.i = read<std::int32_t>(address);
      break;
    case Type::LINT:
    case Type::TIME:
      value.i = read<std::int64_t>(address);
      break;
    case Type::USINT:
    case Type::BYTE:
      value.u = read<std::uint8_t>(address);
      break;
    case Type::UINT:
    case Type::WORD:
      value.u = read<std::uint16_t>(address);
      break;
    case Type::UDINT:
    case Type::DWORD:
    case Type::DB_ANY:
      value.u = read<std::uint32_t>(address);
      break;
    case Type::ULINT:
    case Type::LWORD:
    case Type::AXIS:
    case Type::TAG:
    case Type::ARRAY:
      value.u = read<std::uint64_t>(address);
      break;
    case Type::REAL:
      value.r = static_cast<double>(read<float>(address));
      break;
    case Type::LREAL:
      value.r = read<double>(address);
      break;
  }
  if (bit >= 0) value.u = (value.u >> bit) & 1u;
  return value;
}

void Signal::store(Value value) const noexcept {
  if (bit >= 0) {
    const std::uint64_t mask = std::uint64_t{1} << bit;
    const std::uint64_t word = Signal{address, type, -1}.load().u;
    value.u = (value.u & 1u) != 0 ? word | mask : word & ~mask;
  }
  switch (size_of(type)) {
    case 1:
      if (type == Type::BOOL)
        write(address, value.u != 0);
      else
        write(address, static_cast<std::uint8_t>(value.u));
      break;
    case 2:
      write(address, static_cast<std::uint16_t>(value.u));
      break;
    case 4:
      if (type == Type::REAL)
        write(address, static_cast<float>(value.r));
      else
        write(address, static_cast<std::uint32_t>(value.u));
      break;
    default:
      write(address, value.u);
      break;
  }
}

double as_double(Value value, Type type) noexcept {
  if (is_real(type)) return value.r;
  if (type == Type::TIME) return static_cast<double>(value.i) / 1e9;  // rounded once, as reading 0.3 is
  if (is_signed_integer(type)) return static_cast<double>(value.i);
  return static_cast<double>(value.u);
}

}  // namespace lockstep
