#include "hmi_bridge/modbus/map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace lockstep {
namespace {

constexpr std::array<std::string_view, 4> kTableNames = {"coil", "discrete_input", "input_register",
                                                         "holding_register"};
constexpr std::uint32_t kAddresses = 65536;

constexpr std::array kBool = {Type::BOOL};
constexpr std::array kTime = {Type::TIME, Type::LINT};
constexpr std::array kReals = {Type::REAL, Type::LREAL, Type::REAL};
constexpr std::array kBitStrings = {Type::BYTE, Type::WORD, Type::DWORD, Type::LWORD};
constexpr std::array kIntegers = {Type::SINT,  Type::INT,  Type::DINT,  Type::LINT,
                                  Type::USINT, Type::UINT, Type::UDINT, Type::ULINT};

/// The members of a family with each one in turn at the front.
template <std::size_t N>
constexpr std::array<std::array<Type, N>, N> rotations(const std::array<Type, N>& family) {
  std::array<std::array<Type, N>, N> result{};
  for (std::size_t first = 0; first < N; ++first) {
    result[first][0] = family[first];
    std::size_t next = 1;
    for (const Type type : family)
      if (type != family[first]) result[first][next++] = type;
  }
  return result;
}
constexpr auto kIntegerLists = rotations(kIntegers);
constexpr auto kBitStringLists = rotations(kBitStrings);

template <std::size_t N>
std::span<const Type> list_of(const std::array<std::array<Type, N>, N>& lists, Type first) noexcept {
  for (const auto& list : lists)
    if (list[0] == first) return list;
  return {};
}

constexpr std::int64_t kNanosecondsPerMillisecond = 1'000'000;

std::int64_t to_milliseconds(std::int64_t nanoseconds) noexcept {
  const std::int64_t half = nanoseconds % kNanosecondsPerMillisecond / (kNanosecondsPerMillisecond / 2);
  return nanoseconds / kNanosecondsPerMillisecond + half;
}

bool is_signed(Type type) noexcept {
  return is_signed_integer(type) || type == Type::TIME;
}

/// An integer of one type, brought into the range of another one: the nearest value that it holds.
std::uint64_t saturated(Value value, Type from, std::int64_t low, std::uint64_t high) noexcept {
  if (is_signed(from) && value.i < 0) return static_cast<std::uint64_t>(std::max(value.i, low));
  return std::min(value.u, high);
}

bool fits(Value value, Type from, Type to) noexcept {
  if (is_signed(from) && value.i < 0) return value.i >= lowest(to);
  return value.u <= highest(to);
}

std::uint64_t wire_bits(Type wire, Type signal, Value value) noexcept {
  switch (wire) {
    case Type::REAL:
      return std::bit_cast<std::uint32_t>(static_cast<float>(value.r));
    case Type::LREAL:
      return std::bit_cast<std::uint64_t>(value.r);
    case Type::TIME:
      value.i = to_milliseconds(value.i);
      return saturated(value, Type::TIME, lowest(Type::DINT), highest(Type::DINT));
    default:
      break;
  }
  if (wire == signal) return value.u;  // it fits as it is
  if (is_bit_string(wire)) return value.u & highest(wire);
  return saturated(value, signal, lowest(wire), highest(wire));
}

/// The value that the bits of the registers mean; none for bits that are no value of the type.
std::optional<Value> wire_value(Type wire, std::uint64_t bits) noexcept {
  Value value{};
  value.u = bits;
  switch (wire) {
    case Type::REAL:
      value.r = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
      return std::isfinite(value.r) ? std::optional(value) : std::nullopt;
    case Type::LREAL:
      value.r = std::bit_cast<double>(bits);
      return std::isfinite(value.r) ? std::optional(value) : std::nullopt;
    case Type::TIME:
      value.i = static_cast<std::int32_t>(bits) * kNanosecondsPerMillisecond;
      return value;
    default:
      break;
  }
  if (is_signed_integer(wire)) {
    const int unused = 64 - 16 * modbus_registers(wire);
    value.i = static_cast<std::int64_t>(bits << unused) >> unused;
  }
  const bool fills_its_registers = size_of(wire) >= 2;
  return fills_its_registers || fits(value, wire, wire) ? std::optional(value) : std::nullopt;
}

bool holds(Type signal, Type wire, Value value) noexcept {
  if (signal == Type::REAL) return std::isfinite(static_cast<float>(value.r));
  if (signal == Type::LREAL) return std::isfinite(value.r);
  if (wire == signal) return true;
  return fits(value, wire, signal);
}

std::uint16_t swapped(std::uint16_t word) noexcept {
  return static_cast<std::uint16_t>(word << 8 | word >> 8);
}

/// The integer that stands for a scaled value: the nearest that the type on the wire holds.
std::uint64_t scaled_bits(const ModbusEntry& entry, Value value) noexcept {
  const double number = std::round((value.r - entry.offset) / entry.scale);
  if (std::isnan(number)) return 0;
  const std::int64_t low = lowest(entry.type);
  const std::uint64_t high = highest(entry.type);
  if (number <= static_cast<double>(low)) return static_cast<std::uint64_t>(low);
  if (number >= static_cast<double>(high)) return high;
  return number < 0.0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(number))
                      : static_cast<std::uint64_t>(number);
}

Value unscaled(const ModbusEntry& entry, Value integer) noexcept {
  const double number =
      is_signed(entry.type) ? static_cast<double>(integer.i) : static_cast<double>(integer.u);
  integer.r = number * entry.scale + entry.offset;
  return integer;
}

std::string allowed(std::span<const Type> types) {
  std::string text;
  for (const Type type : types) {
    if (!text.empty()) text += ", ";
    text += type_name(type);
  }
  return text;
}

}  // namespace

std::string_view modbus_table_name(ModbusTable table) noexcept {
  return kTableNames[static_cast<std::size_t>(table)];
}

std::optional<ModbusTable> modbus_table(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kTableNames.size(); ++i)
    if (kTableNames[i] == name) return static_cast<ModbusTable>(i);
  return std::nullopt;
}

bool is_bit_table(ModbusTable table) noexcept {
  return table == ModbusTable::coil || table == ModbusTable::discrete_input;
}

bool is_writable_table(ModbusTable table) noexcept {
  return table == ModbusTable::coil || table == ModbusTable::holding_register;
}

int modbus_registers(Type wire) noexcept {
  if (wire == Type::TIME) return 2;
  return (size_of(wire) + 1) / 2;
}

std::uint32_t modbus_span(const ModbusEntry& entry) noexcept {
  return is_bit_table(entry.table) ? 1 : static_cast<std::uint32_t>(modbus_registers(entry.type));
}

std::span<const Type> modbus_types(Type signal) noexcept {
  if (signal == Type::BOOL) return kBool;
  if (signal == Type::TIME) return kTime;
  if (signal == Type::REAL) return std::span(kReals).first(2);
  if (signal == Type::LREAL) return std::span(kReals).last(2);
  if (signal == Type::DB_ANY) return list_of(kIntegerLists, Type::UDINT);
  if (is_bit_string(signal)) return list_of(kBitStringLists, signal);
  return list_of(kIntegerLists, signal);
}

ModbusWords encode(const ModbusEntry& entry, Type signal, Value value) noexcept {
  if (entry.bit >= 0) return {value.u != 0 ? modbus_bit(entry) : std::uint16_t{0}};
  const std::uint64_t bits =
      entry.is_scaled ? scaled_bits(entry, value) : wire_bits(entry.type, signal, value);
  const int count = modbus_registers(entry.type);
  ModbusWords words{};
  for (int i = 0; i < count; ++i) {
    const int place = entry.word_order == WordOrder::big ? count - 1 - i : i;
    const auto word = static_cast<std::uint16_t>(bits >> (16 * place));
    words[static_cast<std::size_t>(i)] = entry.byte_order == ByteOrder::big ? word : swapped(word);
  }
  return words;
}

std::optional<Value> decode(const ModbusEntry& entry, Type signal,
                            std::span<const std::uint16_t> words) noexcept {
  const std::size_t count = words.size();
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t word = words[entry.word_order == WordOrder::big ? i : count - 1 - i];
    bits = bits << 16 | (entry.byte_order == ByteOrder::big ? word : swapped(word));
  }
  if (entry.bit >= 0) bits = bits >> entry.bit & 1u;
  std::optional<Value> value = wire_value(entry.type, bits);
  if (value && entry.is_scaled) value = unscaled(entry, *value);
  if (!value || !holds(signal, entry.type, *value)) return std::nullopt;
  if (!entry.range.unbounded() && !entry.range.allows(as_double(*value, signal))) return std::nullopt;
  return value;
}

namespace {

bool bits_as_they_are(const ModbusEntry& entry, Type signal) noexcept {
  const bool whole = !is_bit_table(entry.table) && entry.bit < 0 && entry.counter == nullptr;
  const bool sixteen = signal == Type::INT || signal == Type::UINT || signal == Type::WORD;
  return whole && sixteen && entry.type == signal && !entry.is_scaled && entry.byte_order == ByteOrder::big &&
         entry.range.unbounded();
}

}  // namespace

ModbusMap::ModbusMap(std::vector<ModbusEntry> entries, std::span<const Type> signals)
    : entries_(std::move(entries)), signals_(signals.begin(), signals.end()), next_(entries_.size(), kNone) {
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (check(i)) place(i);
}

void ModbusMap::report(std::size_t index, std::string_view key, std::string text) {
  problems_.push_back({index, key, std::move(text)});
}

/// As a message calls an entry.
std::string ModbusMap::line_of(std::size_t index) const {
  const std::uint32_t line = entries_[index].line;
  return std::to_string(line == ModbusEntry::kOwnLine ? index : line);
}

bool ModbusMap::check(std::size_t index) {
  const ModbusEntry& entry = entries_[index];
  const std::size_t before = problems_.size();
  if (entry.counter == nullptr && entry.signal >= signals_.size())
    report(index, "tag", "there is no signal with number " + std::to_string(entry.signal));
  else if (check_type(index) && check_shape(index) &&
           entry.address + std::uint64_t{modbus_span(entry)} > kAddresses)
    report(index, "address",
           std::to_string(modbus_span(entry)) + " addresses from " + std::to_string(entry.address) +
               " on go beyond 65535");
  if (entry.writable && !is_writable_table(entry.table))
    report(index, "access",
           "a client cannot write to the table " + std::string(modbus_table_name(entry.table)) +
               "; allowed: coil, holding_register");
  return problems_.size() == before;
}

bool ModbusMap::check_type(std::size_t index) {
  const ModbusEntry& entry = entries_[index];
  const Type signal = signal_type(entry);
  const std::span<const Type> types =
      entry.is_scaled ? std::span<const Type>(kIntegers) : modbus_types(signal);
  if (types.empty()) {
    report(index, "tag", "a reference to a tag or a technology object has no value that Modbus could carry");
    return false;
  }
  if (is_bit_table(entry.table) && signal != Type::BOOL) {
    report(index, "table",
           "a value of type " + std::string(type_name(signal)) + " does not fit the one bit of the table " +
               std::string(modbus_table_name(entry.table)) + "; allowed: input_register, holding_register");
    return false;
  }
  if (std::find(types.begin(), types.end(), entry.type) == types.end()) {
    report(index, "type",
           "a " + std::string(entry.is_scaled ? "scaled " : "") + "value of type " +
               std::string(type_name(signal)) + " cannot go as " + std::string(type_name(entry.type)) +
               "; allowed: " + allowed(types));
    return false;
  }
  return true;
}

/// Bits in registers and scales.
bool ModbusMap::check_shape(std::size_t index) {
  const ModbusEntry& entry = entries_[index];
  const Type signal = signal_type(entry);
  const std::size_t before = problems_.size();
  if (entry.bit >= 0 && (is_bit_table(entry.table) || signal != Type::BOOL || entry.bit > 15))
    report(index, "bit",
           "only a BOOL in a register has a bit there; allowed: from 0 to 15, in the tables input_register, "
           "holding_register");
  if (entry.is_scaled && !is_real(signal))
    report(index, "scale",
           "a value of type " + std::string(type_name(signal)) +
               " cannot be scaled; allowed: REAL, LREAL, as an integer on the wire");
  return problems_.size() == before;
}

void ModbusMap::place(std::size_t index) {
  const ModbusEntry& entry = entries_[index];
  std::vector<std::uint32_t>& at = at_[static_cast<std::size_t>(entry.table)];
  const std::uint32_t end = entry.address + modbus_span(entry);
  if (entry.bit >= 0 && entry.address < at.size() && at[entry.address] != kNone &&
      entries_[at[entry.address]].bit >= 0)
    return chain(index, at[entry.address]);
  for (std::uint32_t address = entry.address; address < end; ++address)
    if (address < at.size() && at[address] != kNone)
      return report(index, "address",
                    "address " + std::to_string(address) + " of the table " +
                        std::string(modbus_table_name(entry.table)) + " is taken by entry " +
                        line_of(at[address]) + " of the map already");
  if (at.size() < end) at.resize(end, kNone);
  std::uint32_t& first = first_[static_cast<std::size_t>(entry.table)];
  first = std::min(first, entry.address);
  std::fill(at.begin() + entry.address, at.begin() + end, static_cast<std::uint32_t>(index));
  if (!bits_as_they_are(entry, signal_type(entry))) return;
  std::vector<PlainRegister>& plain = plain_[static_cast<std::size_t>(entry.table)];
  if (plain.size() < end) plain.resize(end);
  plain[entry.address] = {entry.signal, entry.writable, entry.type == Type::INT};
}

/// Adds a bit to those that share its register.
void ModbusMap::chain(std::size_t index, std::uint32_t first) {
  for (std::uint32_t other = first;; other = next_[other]) {
    if (modbus_bit(entries_[other]) == modbus_bit(entries_[index]))
      return report(index, "bit",
                    "bit " + std::to_string(entries_[index].bit) + " of address " +
                        std::to_string(entries_[index].address) + " is taken by entry " + line_of(other) +
                        " of the map already");
    if (next_[other] != kNone) continue;
    next_[other] = static_cast<std::uint32_t>(index);
    return;
  }
}

const ModbusEntry* ModbusMap::next(const ModbusEntry& entry) const noexcept {
  const std::uint32_t index = next_[static_cast<std::size_t>(&entry - entries_.data())];
  return index == kNone ? nullptr : &entries_[index];
}

}  // namespace lockstep
