#include "hmi_bridge/modbus/request.hpp"

#include <modbus.h>

#include <algorithm>
#include <utility>

namespace lockstep {
namespace {

constexpr std::size_t kLengthEnd = 6;  ///< end of the MBAP header's length; what it counts begins here
constexpr std::uint8_t kIdentify = 43;

std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset) noexcept {
  return static_cast<std::uint16_t>(bytes[offset] << 8 | bytes[offset + 1]);
}

/// True if a count lies in 1…most and the list of bytes after it, which says its own length, has that length
/// and the one that the count asks for.
bool is_list(std::span<const std::uint8_t> list, std::uint32_t count, std::uint32_t maximum,
             std::uint32_t bytes) noexcept {
  return count >= 1 && count <= maximum && list[0] == bytes && list.size() == 1 + bytes;
}

}  // namespace

std::optional<std::size_t> modbus_frame_length(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < kLengthEnd) return 0;
  const std::size_t counted = word_at(bytes, 4);
  if (word_at(bytes, 2) != 0 || counted < 2 || counted > kModbusFrame - kLengthEnd) return std::nullopt;
  return kLengthEnd + counted;
}

ModbusResponder::ModbusResponder(const ModbusUnits& units, ProcessImage& image, ModbusIdentity identity,
                                 const ModbusCounters* counters)
    : units_(units), map_(units.every), image_(image), identity_(std::move(identity)), counters_(counters) {
  batch_.reserve(MODBUS_MAX_WRITE_BITS);
}

std::span<const std::uint8_t> ModbusResponder::answer(std::span<const std::uint8_t> frame) {
  const Bytes pdu = frame.subspan(kModbusHeader);
  image_.refresh();  // the one instant that this request sees
  unit_ = frame[kModbusHeader - 1];
  map_ = &units_.of(unit_);
  refused_ = {};
  exception_ = perform(pdu);
  if (audit_ != nullptr && exception_ != ModbusException::none) audit_refusal(pdu);
  reply_[kModbusHeader] = pdu[0];
  if (exception_ != ModbusException::none) {
    reply_[kModbusHeader] = static_cast<std::uint8_t>(pdu[0] | 0x80);
    reply_[kModbusHeader + 1] = static_cast<std::uint8_t>(exception_);
    size_ = 2;
  }
  std::copy_n(frame.begin(), kModbusHeader, reply_.begin());
  reply_[kLengthEnd - 2] = static_cast<std::uint8_t>((size_ + 1) >> 8);
  reply_[kLengthEnd - 1] = static_cast<std::uint8_t>(size_ + 1);
  return std::span(reply_).first(kModbusHeader + size_);
}

ModbusException ModbusResponder::identify_us(Bytes pdu) {
  const ModbusIdentification found = identify(identity_, pdu, std::span(reply_).subspan(kModbusHeader));
  size_ = found.size;
  return static_cast<ModbusException>(found.exception);
}

/// The beginning of an answer that is function, number of bytes and these bytes.
std::uint8_t* ModbusResponder::begin_list(std::size_t bytes) {
  reply_[kModbusHeader + 1] = static_cast<std::uint8_t>(bytes);
  size_ = 2 + bytes;
  return &reply_[kModbusHeader + 2];
}

/// An answer that repeats a part of the request, function first.
ModbusException ModbusResponder::echo(Bytes part) {
  std::copy(part.begin(), part.end(), reply_.begin() + kModbusHeader);
  size_ = part.size();
  return ModbusException::none;
}

ModbusException ModbusResponder::perform(Bytes pdu) {
  constexpr auto kBadValue = ModbusException::illegal_data_value;
  const bool has_two_words = pdu.size() == 5;
  switch (pdu[0]) {
    case MODBUS_FC_READ_COILS:
      return has_two_words ? read_bits(ModbusTable::coil, pdu) : kBadValue;
    case MODBUS_FC_READ_DISCRETE_INPUTS:
      return has_two_words ? read_bits(ModbusTable::discrete_input, pdu) : kBadValue;
    case MODBUS_FC_READ_HOLDING_REGISTERS:
      if (!has_two_words) return kBadValue;
      return read_registers(ModbusTable::holding_register, word_at(pdu, 1), word_at(pdu, 3));
    case MODBUS_FC_READ_INPUT_REGISTERS:
      if (!has_two_words) return kBadValue;
      return read_registers(ModbusTable::input_register, word_at(pdu, 1), word_at(pdu, 3));
    case MODBUS_FC_WRITE_SINGLE_COIL:
      return has_two_words ? write_one_bit(pdu) : kBadValue;
    case MODBUS_FC_WRITE_SINGLE_REGISTER:
      return has_two_words ? write_one_register(pdu) : kBadValue;
    case MODBUS_FC_WRITE_MULTIPLE_COILS:
      return pdu.size() < 6 ? kBadValue : write_many_bits(pdu);
    case MODBUS_FC_WRITE_MULTIPLE_REGISTERS:
      return pdu.size() < 6 ? kBadValue : write_many_registers(pdu);
    case MODBUS_FC_MASK_WRITE_REGISTER: {
      if (pdu.size() != 7) return kBadValue;
      const ModbusException bad = mask_register(word_at(pdu, 1), word_at(pdu, 3), word_at(pdu, 5));
      return bad == ModbusException::none ? echo(pdu) : bad;
    }
    case MODBUS_FC_WRITE_AND_READ_REGISTERS:
      return pdu.size() < 10 ? kBadValue : write_and_read_registers(pdu);
    case kIdentify:
      return identify_us(pdu);
    default:
      return ModbusException::illegal_function;
  }
}

ModbusException ModbusResponder::write_one_bit(Bytes pdu) {
  if (pdu[4] != 0 || (pdu[3] != 0 && pdu[3] != 0xFF)) return ModbusException::illegal_data_value;
  const ModbusException bad = write_bits(word_at(pdu, 1), 1, pdu.subspan(3, 1));
  return bad == ModbusException::none ? echo(pdu) : bad;
}

ModbusException ModbusResponder::write_many_bits(Bytes pdu) {
  const std::uint32_t count = word_at(pdu, 3);
  if (!is_list(pdu.subspan(5), count, MODBUS_MAX_WRITE_BITS, (count + 7) / 8))
    return ModbusException::illegal_data_value;
  const ModbusException bad = write_bits(word_at(pdu, 1), count, pdu.subspan(6));
  return bad == ModbusException::none ? echo(pdu.first(5)) : bad;
}

ModbusException ModbusResponder::write_one_register(Bytes pdu) {
  const ModbusException bad = write_registers(word_at(pdu, 1), pdu.subspan(3, 2));
  return bad == ModbusException::none ? echo(pdu) : bad;
}

ModbusException ModbusResponder::write_many_registers(Bytes pdu) {
  const std::uint32_t count = word_at(pdu, 3);
  if (!is_list(pdu.subspan(5), count, MODBUS_MAX_WRITE_REGISTERS, 2 * count))
    return ModbusException::illegal_data_value;
  const ModbusException bad = write_registers(word_at(pdu, 1), pdu.subspan(6));
  return bad == ModbusException::none ? echo(pdu.first(5)) : bad;
}

ModbusException ModbusResponder::check_read(ModbusTable table, std::uint32_t address,
                                            std::uint32_t count) const {
  for (std::uint32_t i = 0; i < count; ++i)
    if (map_->find(table, address + i) == nullptr && !map_->is_gap(table, address + i))
      return ModbusException::illegal_data_address;
  return ModbusException::none;
}

ModbusException ModbusResponder::check_write(ModbusTable table, std::uint32_t address,
                                             std::uint32_t count) const {
  const std::uint32_t end = address + count;
  while (address < end) {
    if (map_->plain(table, address).writable) {
      ++address;
      continue;
    }
    const ModbusEntry* const entry = map_->find(table, address);
    if (entry == nullptr || entry->address != address) return ModbusException::illegal_data_address;
    for (const ModbusEntry* part = entry; part != nullptr; part = map_->next(*part))
      if (!part->writable) return ModbusException::illegal_data_address;
    address += modbus_span(*entry);
  }
  return address == end ? ModbusException::none : ModbusException::illegal_data_address;
}

Value ModbusResponder::value_of(const ModbusEntry& entry) const {
  if (entry.counter == nullptr) return image_.value(entry.signal);
  Value value{};
  if (counters_ != nullptr) value.u = (counters_->*entry.counter).load(std::memory_order_relaxed);
  return value;
}

/// The registers of an entry; of a bit, with the other bits of its register.
ModbusWords ModbusResponder::words_of(const ModbusEntry& entry) const {
  ModbusWords words = encode(entry, map_->signal_type(entry), value_of(entry));
  if (entry.bit >= 0)
    for (const ModbusEntry* part = map_->next(entry); part != nullptr; part = map_->next(*part))
      words[0] |= encode(*part, Type::BOOL, value_of(*part))[0];
  return words;
}

ModbusException ModbusResponder::read_bits(ModbusTable table, Bytes pdu) {
  const std::uint32_t address = word_at(pdu, 1);
  const std::uint32_t count = word_at(pdu, 3);
  if (count < 1 || count > MODBUS_MAX_READ_BITS) return ModbusException::illegal_data_value;
  if (const auto bad = check_read(table, address, count); bad != ModbusException::none) return bad;
  std::uint8_t* const bytes = begin_list((count + 7) / 8);
  std::fill_n(bytes, (count + 7) / 8, std::uint8_t{0});
  for (std::uint32_t i = 0; i < count; ++i)
    if (const ModbusEntry* const entry = map_->find(table, address + i);
        entry != nullptr && image_.value(entry->signal).u != 0)
      bytes[i / 8] |= static_cast<std::uint8_t>(1u << (i % 8));
  return ModbusException::none;
}

/// Puts plain registers one after the other, up to the first that is none. @return how many
std::uint32_t ModbusResponder::put_plain(ModbusTable table, std::uint32_t address, std::uint32_t maximum,
                                         std::uint8_t* bytes) const noexcept {
  const std::span<const PlainRegister> plain = map_->plain_from(table, address);
  const std::size_t end = std::min<std::size_t>(maximum, plain.size());
  std::size_t count = 0;
  for (; count < end && plain[count].exists(); ++count) {
    const auto word = static_cast<std::uint16_t>(image_.value(plain[count].signal).u);
    bytes[2 * count] = static_cast<std::uint8_t>(word >> 8);
    bytes[2 * count + 1] = static_cast<std::uint8_t>(word);
  }
  return static_cast<std::uint32_t>(count);
}

ModbusException ModbusResponder::read_registers(ModbusTable table, std::uint32_t address,
                                                std::uint32_t count) {
  if (count < 1 || count > MODBUS_MAX_READ_REGISTERS) return ModbusException::illegal_data_value;
  std::uint8_t* byte = begin_list(2 * count);
  const auto put = [&byte](std::uint16_t word) {
    *byte++ = static_cast<std::uint8_t>(word >> 8);
    *byte++ = static_cast<std::uint8_t>(word);
  };
  // A value that begins before the range or ends behind it gives the part that was asked for.
  for (std::uint32_t i = address; i < address + count;) {
    if (const std::uint32_t plain = put_plain(table, i, address + count - i, byte); plain != 0) {
      i += plain;
      byte += 2 * plain;
      continue;
    }
    const ModbusEntry* const entry = map_->find(table, i);
    if (entry == nullptr) {
      if (!map_->is_gap(table, i++)) return ModbusException::illegal_data_address;
      put(0);
      continue;
    }
    const ModbusWords words = words_of(*entry);
    const std::uint32_t end = std::min(address + count, entry->address + modbus_span(*entry));
    for (; i < end; ++i) put(words[i - entry->address]);
  }
  return ModbusException::none;
}

/// Hands the writes of a request that is good to the cycle.
ModbusException ModbusResponder::post() {
  if (refuses_writes_) return ModbusException::server_device_failure;
  if (audit_ != nullptr) audit_writes();
  image_.post(batch_);
  return ModbusException::none;
}

ModbusException ModbusResponder::write_bits(std::uint32_t address, std::uint32_t count, Bytes bits) {
  if (const auto bad = check_write(ModbusTable::coil, address, count); bad != ModbusException::none)
    return bad;
  batch_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const ModbusEntry& entry = *map_->find(ModbusTable::coil, address + i);
    Value value{};
    value.u = bits[i / 8] >> (i % 8) & 1u;
    if (!entry.range.allows(as_double(value, Type::BOOL))) return refuse(entry, {}, value);
    batch_.push_back({entry.signal, value});
  }
  return post();
}

/// Notes which entry has not taken its value, and which one that was.
ModbusException ModbusResponder::refuse(const ModbusEntry& entry, ModbusWords words,
                                        std::optional<Value> value) noexcept {
  refused_ = {&entry, words, value};
  return ModbusException::illegal_data_value;
}

ModbusException ModbusResponder::stage_registers(std::uint32_t address, Bytes words) {
  const auto end = address + static_cast<std::uint32_t>(words.size() / 2);
  batch_.clear();
  for (std::uint32_t i = address; i < end;) {
    if (const PlainRegister plain = map_->plain(ModbusTable::holding_register, i); plain.exists()) {
      batch_.push_back({plain.signal, plain.value_of(word_at(words, 2 * (i - address)))});
      ++i;
      continue;
    }
    const ModbusEntry& entry = *map_->find(ModbusTable::holding_register, i);
    if (entry.bit >= 0) {
      if (const auto bad = stage_bits(entry, word_at(words, 2 * (i - address))); bad != ModbusException::none)
        return bad;
      ++i;
      continue;
    }
    ModbusWords value_words{};
    const std::uint32_t span = modbus_span(entry);
    for (std::uint32_t k = 0; k < span; ++k) value_words[k] = word_at(words, 2 * (i - address + k));
    const auto value = decode(entry, map_->signal_type(entry), std::span(value_words).first(span));
    if (!value) return refuse(entry, value_words);
    batch_.push_back({entry.signal, *value});
    i += span;
  }
  return ModbusException::none;
}

/// All bits of a register that have an entry; the others hold nothing, so that they can only be 0.
ModbusException ModbusResponder::stage_bits(const ModbusEntry& first, std::uint16_t word) {
  for (const ModbusEntry* part = &first; part != nullptr; part = map_->next(*part)) {
    Value value{};
    value.u = (word & modbus_bit(*part)) != 0 ? 1 : 0;
    if (!part->range.allows(as_double(value, Type::BOOL))) return refuse(*part, {}, value);
    batch_.push_back({part->signal, value});
    word &= static_cast<std::uint16_t>(~modbus_bit(*part));
  }
  return word == 0 ? ModbusException::none : ModbusException::illegal_data_value;
}

ModbusException ModbusResponder::write_registers(std::uint32_t address, Bytes words) {
  const auto count = static_cast<std::uint32_t>(words.size() / 2);
  auto bad = check_write(ModbusTable::holding_register, address, count);
  if (bad == ModbusException::none) bad = stage_registers(address, words);
  return bad == ModbusException::none ? post() : bad;
}

ModbusException ModbusResponder::mask_register(std::uint32_t address, std::uint16_t and_mask,
                                               std::uint16_t or_mask) {
  const ModbusEntry* const first = map_->find(ModbusTable::holding_register, address);
  if (first != nullptr && first->bit >= 0) return mask_bits(*first, and_mask, or_mask);
  if (const auto bad = check_write(ModbusTable::holding_register, address, 1); bad != ModbusException::none)
    return bad;
  const ModbusEntry& entry = *map_->find(ModbusTable::holding_register, address);
  const Type type = map_->signal_type(entry);
  const std::uint16_t before = words_of(entry)[0];
  const ModbusWords after{
      static_cast<std::uint16_t>((before & and_mask) | (or_mask & static_cast<std::uint16_t>(~and_mask)))};
  const auto value = decode(entry, type, std::span(after).first(1));
  if (!value) return refuse(entry, after);
  batch_.assign(1, {entry.signal, *value});
  // Bits that the request leaves alone stay what they are when the write enters, not what they were when it
  // was asked for: a program may own them. Where the register is not the signal itself, the whole value goes.
  // Where not every value is allowed, the one that was judged has to be the one that is written.
  if (size_of(type) == 2 && !entry.is_scaled && entry.range.unbounded()) {
    const auto named = static_cast<std::uint16_t>(~and_mask);
    batch_[0].mask = entry.byte_order == ByteOrder::big ? named : std::uint16_t(named << 8 | named >> 8);
  }
  return post();
}

/// Of a register of bits only those that the request names have to be writable.
ModbusException ModbusResponder::mask_bits(const ModbusEntry& first, std::uint16_t and_mask,
                                           std::uint16_t or_mask) {
  auto named = static_cast<std::uint16_t>(~and_mask);
  batch_.clear();
  for (const ModbusEntry* part = &first; part != nullptr; part = map_->next(*part)) {
    if ((named & modbus_bit(*part)) == 0) continue;
    named &= static_cast<std::uint16_t>(~modbus_bit(*part));
    if (!part->writable) return ModbusException::illegal_data_address;
    Value value{};
    value.u = (or_mask & modbus_bit(*part)) != 0 ? 1 : 0;
    if (!part->range.allows(as_double(value, Type::BOOL))) return refuse(*part, {}, value);
    batch_.push_back({part->signal, value});
  }
  if ((named & or_mask) != 0) return ModbusException::illegal_data_value;
  return batch_.empty() ? ModbusException::none : post();
}

ModbusException ModbusResponder::write_and_read_registers(Bytes pdu) {
  const std::uint32_t read_address = word_at(pdu, 1);
  const std::uint32_t read_count = word_at(pdu, 3);
  const std::uint32_t write_address = word_at(pdu, 5);
  const std::uint32_t write_count = word_at(pdu, 7);
  if (read_count < 1 || read_count > MODBUS_MAX_READ_REGISTERS ||
      !is_list(pdu.subspan(9), write_count, MODBUS_MAX_WR_WRITE_REGISTERS, 2 * write_count))
    return ModbusException::illegal_data_value;
  if (const auto bad = check_read(ModbusTable::holding_register, read_address, read_count);
      bad != ModbusException::none)
    return bad;  // before the write: a request that is answered with an exception changes nothing
  if (const auto bad = write_registers(write_address, pdu.subspan(10)); bad != ModbusException::none)
    return bad;
  return read_registers(ModbusTable::holding_register, read_address, read_count);
}

}  // namespace lockstep
