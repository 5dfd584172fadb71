// What the audit log is told of requests.
#include <fmt/format.h>
#include <modbus.h>

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "hmi_bridge/modbus/request.hpp"

namespace lockstep {
namespace {

/// The table that a function writes to, and from where on in the request its address and its number stand; 0:
/// its number is 1.
struct WriteFunction {
  std::uint8_t function;
  ModbusTable table;
  std::size_t address, count;
};
constexpr WriteFunction kWriteFunctions[] = {
    {MODBUS_FC_WRITE_SINGLE_COIL, ModbusTable::coil, 1, 0},
    {MODBUS_FC_WRITE_SINGLE_REGISTER, ModbusTable::holding_register, 1, 0},
    {MODBUS_FC_WRITE_MULTIPLE_COILS, ModbusTable::coil, 1, 3},
    {MODBUS_FC_WRITE_MULTIPLE_REGISTERS, ModbusTable::holding_register, 1, 3},
    {MODBUS_FC_MASK_WRITE_REGISTER, ModbusTable::holding_register, 1, 0},
    {MODBUS_FC_WRITE_AND_READ_REGISTERS, ModbusTable::holding_register, 5, 7}};

std::string reason_of(ModbusException exception) {
  switch (exception) {
    case ModbusException::illegal_data_address:
      return "exception 2: an address that is not in the map, is read-only, or is part of a value";
    case ModbusException::illegal_data_value:
      return "exception 3: a value that the tag cannot hold, or a request that contradicts itself";
    case ModbusException::server_device_failure:
      return "exception 4: the run ends, and no tick takes it any more";
    default:
      return "exception " + std::to_string(static_cast<int>(exception));
  }
}

/// What may be written to an entry, in the unit of the signal.
std::string limits_of(const Range& range) {
  const bool from = range.lowest > -std::numeric_limits<double>::max();
  const bool to = range.highest < std::numeric_limits<double>::max();
  if (from && to) return fmt::format("{} to {}", range.lowest, range.highest);
  return from ? fmt::format("{} and more", range.lowest) : fmt::format("up to {}", range.highest);
}

/// What a write makes of the bits of a value.
Value after(const SignalWrite& write, Value before) noexcept {
  if (write.mask == ~0ULL) return write.value;
  before.u = (before.u & ~write.mask) | (write.value.u & write.mask);
  return before;
}

}  // namespace

AuditEntry ModbusResponder::audit_entry() const {
  AuditEntry entry;
  entry.tick = image_.tick();
  entry.via = "modbus";
  entry.who = "unit " + std::to_string(unit_);
  entry.action = "write";
  if (peer_ == nullptr) return entry;
  entry.from = peer_->from;
  entry.source = peer_->source;
  return entry;
}

/// The writes of a request that is good, with the values before them.
void ModbusResponder::audit_writes() {
  for (const SignalWrite& write : batch_) {
    const Type type = image_.type(write.signal);
    const Value before = image_.value(write.signal);
    AuditEntry entry = audit_entry();
    entry.target = entry.subject = write.signal < names_.size() ? names_[write.signal] : "";
    entry.before = audit_value(before, type);
    entry.after = audit_value(after(write, before), type);
    entry.accepted = true;
    audit_->add(std::move(entry));
  }
}

/// Which tag has not taken its value, which value that was, and what it takes.
void ModbusResponder::name_refused(AuditEntry& told) const {
  const ModbusEntry& entry = *refused_.entry;
  const Type type = map_->signal_type(entry);
  ModbusEntry unlimited = entry;
  unlimited.range = kAny;
  std::optional<Value> value = refused_.value;
  if (!value) value = decode(unlimited, type, std::span(refused_.words).first(modbus_span(entry)));
  const std::string at = fmt::format("{} {}", modbus_table_name(entry.table), entry.address);
  told.why = value ? fmt::format("exception 3: beyond the limits of {}, {}", at, limits_of(entry.range))
                   : fmt::format("exception 3: what {} was to get is no {}", at, type_name(type));
  if (entry.signal < names_.size() && !names_[entry.signal].empty()) told.target = names_[entry.signal];
  told.subject = told.target + " refused";
  told.before = audit_value(image_.value(entry.signal), type);
  if (value) told.after = audit_value(*value, type);
}

/// A request that was answered with an exception, if it was one that writes.
void ModbusResponder::audit_refusal(Bytes pdu) {
  for (const WriteFunction& one : kWriteFunctions) {
    if (one.function != pdu[0]) continue;
    AuditEntry entry = audit_entry();
    const auto word = [&pdu](std::size_t at) -> unsigned {
      return at + 1 < pdu.size() ? static_cast<unsigned>(pdu[at] << 8 | pdu[at + 1]) : 0;
    };
    entry.target = std::string(modbus_table_name(one.table)) + " " + std::to_string(word(one.address));
    if (one.count != 0) entry.target += ", " + std::to_string(word(one.count)) + " of them";
    entry.why = reason_of(exception_);
    entry.subject = std::string(modbus_table_name(one.table)) + std::to_string(static_cast<int>(exception_));
    if (refused_.entry != nullptr) name_refused(entry);
    audit_->add(std::move(entry));
  }
}

}  // namespace lockstep
