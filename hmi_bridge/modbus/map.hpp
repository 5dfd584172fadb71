/// Which signal stands at which Modbus address, and how its value looks in registers.
/// @source contract of the project file, section 6; Modbus application protocol V1.1b3, 4.3
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/modbus/counters.hpp"
#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// The four tables of Modbus, spelled as in the project file.
enum class ModbusTable : std::uint8_t { coil, discrete_input, input_register, holding_register };
/// Which register of a value comes first: its most (big) or its least (little) significant one.
enum class WordOrder : std::uint8_t { big, little };
/// Which byte of a register comes first. Modbus itself has the more significant one first; devices that
/// think otherwise are common.
enum class ByteOrder : std::uint8_t { big, little };

std::string_view modbus_table_name(ModbusTable table) noexcept;
std::optional<ModbusTable> modbus_table(std::string_view name) noexcept;
/// True for coils and discrete inputs, where an address is one bit; else it is a register of 16.
bool is_bit_table(ModbusTable table) noexcept;
/// True where a client may write at all: coils and holding registers.
bool is_writable_table(ModbusTable table) noexcept;

/// Number of registers of a value of this type on the wire: 1, 2 or 4.
int modbus_registers(Type wire) noexcept;

/// Types that a signal of this type may have on the wire, its usual one first; none for a reference. A type
/// stays in its family (BOOL; integers; bit strings; REAL and LREAL) and may be narrower or wider.
/// TIME goes as TIME: 32 bits, whole milliseconds; or as LINT: 64 bits, nanoseconds.
std::span<const Type> modbus_types(Type signal) noexcept;

/// One line of the map.
struct ModbusEntry {
  std::uint32_t signal = 0;  ///< index into the signals of the process image
  ModbusTable table = ModbusTable::holding_register;
  std::uint32_t address = 0;  ///< zero-based, 0…65535
  Type type = Type::BOOL;     ///< on the wire
  WordOrder word_order = WordOrder::big;
  bool writable = false;
  Range range = kAny;  ///< what may be written, besides what the signal's type holds; TIME in [s]
  ByteOrder byte_order = ByteOrder::big;
  std::int8_t bit = -1;  ///< 0…15: the BOOL is this bit of the register; -1: the value fills its registers
  bool is_scaled = false;           ///< the registers hold an integer, value = integer · scale + offset
  double scale = 1.0;               ///< finite, not 0
  double offset = 0.0;              ///< finite
  ModbusCounter counter = nullptr;  ///< shows this counter of the server, an ULINT, instead of a signal
  /// Number of its line in the project's map, where one line may be an entry for each element of an array;
  /// kOwnLine: as it stands among the entries.
  std::uint32_t line = kOwnLine;
  static constexpr std::uint32_t kOwnLine = ~0U;
};

/// The registers of a value, in the order of the wire; what the type does not need is 0.
using ModbusWords = std::array<std::uint16_t, 4>;

/// A value as it goes to a client. A number that the type on the wire cannot hold becomes the nearest one
/// that it can; a real number is rounded (beyond the range of REAL: infinity); of a bit string the low bits
/// count. A scaled number is rounded to the nearest integer, half away from zero; NaN becomes 0. The register
/// of a bit has its other bits 0.
ModbusWords encode(const ModbusEntry& entry, Type signal, Value value) noexcept;

/// A value as it comes from a client; none if the signal cannot hold it or the entry's range does not allow
/// it: too large, negative for an unsigned, NaN, infinity, a BOOL that is neither 0 nor 1.
/// `words` has modbus_registers(entry.type) elements.
std::optional<Value> decode(const ModbusEntry& entry, Type signal,
                            std::span<const std::uint16_t> words) noexcept;

/// A register that has the 16 bits of an INT, UINT or WORD as they are and takes any, which needs neither
/// `encode` nor `decode`.
struct PlainRegister {
  static constexpr std::uint32_t kNoSignal = ~0U;

  bool exists() const noexcept { return signal != kNoSignal; }
  Value value_of(std::uint16_t word) const noexcept {
    Value value{};
    value.i = is_signed ? static_cast<std::int16_t>(word) : word;
    return value;
  }

  std::uint32_t signal = kNoSignal;  ///< index into the signals of the process image
  bool writable = false;
  bool is_signed = false;
};

/// What is wrong with a line of the map.
struct ModbusMapProblem {
  std::size_t entry;     ///< index of the line
  std::string_view key;  ///< key of the line in the project file that has to change
  std::string text;      ///< what is wrong, what is allowed
};

/// The map, checked and made ready for look-up. Constant after construction: any thread may read it.
class ModbusMap {
 public:
  /// `signals` are the types of the signals' values. A line with a problem is left out of the look-up.
  ModbusMap(std::vector<ModbusEntry> entries, std::span<const Type> signals);

  /// Everything that is wrong, in the order of the lines; a map with problems is not to be served.
  const std::vector<ModbusMapProblem>& problems() const noexcept { return problems_; }
  const std::vector<ModbusEntry>& entries() const noexcept { return entries_; }

  /// The entry that covers an address, or nullptr; of several bits in a register the first one.
  const ModbusEntry* find(ModbusTable table, std::uint32_t address) const noexcept {
    const std::vector<std::uint32_t>& at = at_[static_cast<std::size_t>(table)];
    return address >= at.size() || at[address] == kNone ? nullptr : &entries_[at[address]];
  }
  /// From now on what lies between entries of a table is read as 0, and written by nobody.
  void read_gaps_as_zero() noexcept { gaps_are_zero_ = true; }
  /// Whether an address lies between entries of a table, has none, and is read as 0.
  bool is_gap(ModbusTable table, std::uint32_t address) const noexcept {
    const auto index = static_cast<std::size_t>(table);
    return gaps_are_zero_ && address >= first_[index] && address < at_[index].size() &&
           at_[index][address] == kNone;
  }
  /// The plain register at an address; one without a signal if there is another one, or none.
  PlainRegister plain(ModbusTable table, std::uint32_t address) const noexcept {
    const std::vector<PlainRegister>& plain = plain_[static_cast<std::size_t>(table)];
    return address >= plain.size() ? PlainRegister{} : plain[address];
  }
  /// What `plain` gives, of all addresses from this one on that may have one.
  std::span<const PlainRegister> plain_from(ModbusTable table, std::uint32_t address) const noexcept {
    const std::vector<PlainRegister>& plain = plain_[static_cast<std::size_t>(table)];
    return address >= plain.size() ? std::span<const PlainRegister>{} : std::span(plain).subspan(address);
  }
  /// The next bit in the same register, or nullptr.
  const ModbusEntry* next(const ModbusEntry& entry) const noexcept;
  /// Type of the values of the signal of an entry.
  Type signal_type(const ModbusEntry& entry) const noexcept {
    return entry.counter == nullptr ? signals_[entry.signal] : Type::ULINT;
  }

 private:
  bool check(std::size_t index);
  bool check_type(std::size_t index);
  bool check_shape(std::size_t index);
  void place(std::size_t index);
  void chain(std::size_t index, std::uint32_t first);
  void report(std::size_t index, std::string_view key, std::string text);
  std::string line_of(std::size_t index) const;

  static constexpr std::uint32_t kNone = ~0U;

  std::vector<ModbusEntry> entries_;
  std::vector<Type> signals_;
  std::vector<ModbusMapProblem> problems_;
  std::array<std::vector<std::uint32_t>, 4> at_;     ///< per table and address: index of the entry or kNone
  std::array<std::vector<PlainRegister>, 4> plain_;  ///< per table and address
  std::array<std::uint32_t, 4> first_{kNone, kNone, kNone, kNone};  ///< per table: lowest address of an entry
  bool gaps_are_zero_ = false;
  std::vector<std::uint32_t> next_;  ///< per entry: the next bit in its register or kNone
};

/// The maps of one endpoint: which one answers depends on the unit id. The maps outlive it.
struct ModbusUnits {
  /// One map for every unit id.
  ModbusUnits(const ModbusMap& map) noexcept : every(&map) {}
  const ModbusMap& of(std::uint8_t unit) const noexcept { return own[unit] == nullptr ? *every : *own[unit]; }

  const ModbusMap* every;                   ///< of the unit ids that have none of their own
  std::array<const ModbusMap*, 256> own{};  ///< by unit id; nullptr: none
};

/// Bit of a register's number in which an entry with `bit` stands.
constexpr std::uint16_t modbus_bit(const ModbusEntry& entry) noexcept {
  return static_cast<std::uint16_t>(1u << (entry.byte_order == ByteOrder::big ? entry.bit : entry.bit ^ 8));
}

/// Number of addresses that an entry covers.
std::uint32_t modbus_span(const ModbusEntry& entry) noexcept;

}  // namespace lockstep
