#include "hmi_bridge/modbus_request.hpp"

#include <modbus.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace lockstep {
namespace {

constexpr std::size_t kLengthEnd = 6;  ///< end of the MBAP header's length; what it counts begins here
constexpr std::uint32_t kAddresses = 65536;
constexpr std::uint8_t kIdentify = 43;

std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset) noexcept {
  return static_cast<std::uint16_t>(bytes[offset] << 8 | bytes[offset + 1]);
}

/// True if a count lies in 1…most and the list of bytes after it, which says its own length, has that length
/// and the one that the count asks for.
bool is_list(std::span<const std::uint8_t> list, std::uint32_t count, std::uint32_t most,
             std::uint32_t bytes) noexcept {
  return count >= 1 && count <= most && list[0] == bytes && list.size() == 1 + bytes;
}

}  // namespace

std::optional<std::size_t> modbus_frame_length(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < kLengthEnd) return 0;
  const std::size_t counted = word_at(bytes, 4);
  if (word_at(bytes, 2) != 0 || counted < 2 || counted > kModbusFrame - kLengthEnd) return std::nullopt;
  return kLengthEnd + counted;
}

/// The library writes its answer to a socket, and expects that to take all of it at once. So it gets the one
/// end of a pair that never leaves this thread; the other end gives the answer back.
struct ModbusResponder::Library {
  Library() {
    context = modbus_new_tcp("127.0.0.1", 0);
    mapping = modbus_mapping_new(kAddresses, kAddresses, kAddresses, kAddresses);
    if (context == nullptr || mapping == nullptr ||
        socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, pair) != 0) {
      release();
      throw std::runtime_error("no memory or no socket left for the Modbus server");
    }
    modbus_set_socket(context, pair[0]);
  }
  ~Library() { release(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  void release() noexcept {
    for (const int end : pair)
      if (end >= 0) ::close(end);
    modbus_mapping_free(mapping);
    modbus_free(context);
  }

  modbus_t* context = nullptr;
  modbus_mapping_t* mapping = nullptr;
  int pair[2] = {-1, -1};
};

ModbusResponder::ModbusResponder(const ModbusUnits& units, ProcessImage& image, ModbusIdentity identity,
                                 const ModbusCounters* counters)
    : units_(units),
      map_(units.every),
      image_(image),
      identity_(std::move(identity)),
      counters_(counters),
      library_(std::make_unique<Library>()) {
  batch_.reserve(MODBUS_MAX_WRITE_BITS);
}

ModbusResponder::~ModbusResponder() = default;

std::span<const std::uint8_t> ModbusResponder::answer(std::span<const std::uint8_t> frame) {
  const std::uint8_t function = frame[kModbusHeader];
  if (function == kIdentify) return answer_identity(frame);
  image_.refresh();  // the one instant that this request sees
  map_ = &units_.of(frame[kModbusHeader - 1]);
  exception_ = perform(frame.subspan(kModbusHeader));
  Library& library = *library_;
  if (exception_ != ModbusException::none) {
    modbus_reply_exception(library.context, frame.data(), static_cast<unsigned>(exception_));
  } else if (function == MODBUS_FC_WRITE_AND_READ_REGISTERS) {
    // The answer is that of a read. Asked for both, the library would show the registers as they were written
    // and not as the signals hold them: an LREAL that a REAL has rounded.
    std::array<std::uint8_t, kModbusHeader + 5> read;
    std::copy_n(frame.begin(), read.size(), read.begin());
    read[kModbusHeader] = MODBUS_FC_READ_HOLDING_REGISTERS;
    modbus_reply(library.context, read.data(), static_cast<int>(read.size()), library.mapping);
  } else {
    modbus_reply(library.context, frame.data(), static_cast<int>(frame.size()), library.mapping);
  }
  const ssize_t size = ::recv(library.pair[1], reply_.data(), reply_.size(), MSG_DONTWAIT);
  if (size < static_cast<ssize_t>(kModbusHeader + 2)) return {};
  // The library adds 128 to the function, which would make no exception of one to a function above 127.
  reply_[kModbusHeader] =
      exception_ == ModbusException::none ? function : static_cast<std::uint8_t>(function | 0x80);
  return std::span(reply_).first(static_cast<std::size_t>(size));
}

/// The library knows no identification.
std::span<const std::uint8_t> ModbusResponder::answer_identity(std::span<const std::uint8_t> frame) {
  const std::span<std::uint8_t> pdu = std::span(reply_).subspan(kModbusHeader);
  const ModbusIdentification found = identify(identity_, frame.subspan(kModbusHeader), pdu);
  exception_ = static_cast<ModbusException>(found.exception);
  std::size_t size = found.size;
  if (exception_ != ModbusException::none) {
    pdu[0] = kIdentify | 0x80;
    pdu[1] = found.exception;
    size = 2;
  }
  std::copy_n(frame.begin(), kModbusHeader, reply_.begin());
  reply_[kLengthEnd - 2] = static_cast<std::uint8_t>((size + 1) >> 8);
  reply_[kLengthEnd - 1] = static_cast<std::uint8_t>(size + 1);
  return std::span(reply_).first(kModbusHeader + size);
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
      if (!has_two_words || pdu[4] != 0 || (pdu[3] != 0 && pdu[3] != 0xFF)) return kBadValue;
      return write_bits(word_at(pdu, 1), 1, pdu.subspan(3, 1));
    case MODBUS_FC_WRITE_SINGLE_REGISTER:
      return has_two_words ? write_registers(word_at(pdu, 1), pdu.subspan(3, 2)) : kBadValue;
    case MODBUS_FC_WRITE_MULTIPLE_COILS: {
      if (pdu.size() < 6) return kBadValue;
      const std::uint32_t count = word_at(pdu, 3);
      if (!is_list(pdu.subspan(5), count, MODBUS_MAX_WRITE_BITS, (count + 7) / 8)) return kBadValue;
      return write_bits(word_at(pdu, 1), count, pdu.subspan(6));
    }
    case MODBUS_FC_WRITE_MULTIPLE_REGISTERS: {
      if (pdu.size() < 6) return kBadValue;
      const std::uint32_t count = word_at(pdu, 3);
      if (!is_list(pdu.subspan(5), count, MODBUS_MAX_WRITE_REGISTERS, 2 * count)) return kBadValue;
      return write_registers(word_at(pdu, 1), pdu.subspan(6));
    }
    case MODBUS_FC_MASK_WRITE_REGISTER:
      if (pdu.size() != 7) return kBadValue;
      return mask_register(word_at(pdu, 1), word_at(pdu, 3), word_at(pdu, 5));
    case MODBUS_FC_WRITE_AND_READ_REGISTERS:
      return pdu.size() < 10 ? kBadValue : write_and_read_registers(pdu);
    default:
      return ModbusException::illegal_function;
  }
}

ModbusException ModbusResponder::check_read(ModbusTable table, std::uint32_t address,
                                            std::uint32_t count) const {
  for (std::uint32_t i = 0; i < count; ++i)
    if (map_->find(table, address + i) == nullptr) return ModbusException::illegal_data_address;
  return ModbusException::none;
}

ModbusException ModbusResponder::check_write(ModbusTable table, std::uint32_t address,
                                             std::uint32_t count) const {
  const std::uint32_t end = address + count;
  while (address < end) {
    const ModbusEntry* const entry = map_->find(table, address);
    if (entry == nullptr || entry->address != address) return ModbusException::illegal_data_address;
    if (map_->is_plain(*entry) && entry->writable) {
      ++address;
      continue;
    }
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
  modbus_mapping_t& mapping = *library_->mapping;
  std::uint8_t* bits = table == ModbusTable::coil ? mapping.tab_bits : mapping.tab_input_bits;
  for (std::uint32_t i = address; i < address + count; ++i)
    bits[i] = image_.value(map_->find(table, i)->signal).u != 0 ? 1 : 0;
  return ModbusException::none;
}

ModbusException ModbusResponder::read_registers(ModbusTable table, std::uint32_t address,
                                                std::uint32_t count) {
  if (count < 1 || count > MODBUS_MAX_READ_REGISTERS) return ModbusException::illegal_data_value;
  modbus_mapping_t& mapping = *library_->mapping;
  std::uint16_t* registers =
      table == ModbusTable::holding_register ? mapping.tab_registers : mapping.tab_input_registers;
  // A value that begins before the range or ends behind it gives the part that was asked for.
  for (std::uint32_t i = address; i < address + count;) {
    const ModbusEntry* const entry = map_->find(table, i);
    if (entry == nullptr) return ModbusException::illegal_data_address;
    if (map_->is_plain(*entry)) {
      registers[i++] = static_cast<std::uint16_t>(image_.value(entry->signal).u);
      continue;
    }
    const ModbusWords words = words_of(*entry);
    const std::uint32_t end = std::min(address + count, entry->address + modbus_span(*entry));
    for (; i < end; ++i) registers[i] = words[i - entry->address];
  }
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
    if (!entry.range.allows(as_double(value, Type::BOOL))) return ModbusException::illegal_data_value;
    batch_.push_back({entry.signal, value});
  }
  image_.post(batch_);
  return ModbusException::none;
}

ModbusException ModbusResponder::stage_registers(std::uint32_t address, Bytes words) {
  const auto end = address + static_cast<std::uint32_t>(words.size() / 2);
  batch_.clear();
  for (std::uint32_t i = address; i < end;) {
    const ModbusEntry& entry = *map_->find(ModbusTable::holding_register, i);
    if (map_->is_plain(entry)) {
      const std::uint16_t word = word_at(words, 2 * (i - address));
      Value value{};
      if (entry.type == Type::INT)
        value.i = static_cast<std::int16_t>(word);
      else
        value.u = word;
      batch_.push_back({entry.signal, value});
      ++i;
      continue;
    }
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
    if (!value) return ModbusException::illegal_data_value;
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
    if (!part->range.allows(as_double(value, Type::BOOL))) return ModbusException::illegal_data_value;
    batch_.push_back({part->signal, value});
    word &= static_cast<std::uint16_t>(~modbus_bit(*part));
  }
  return word == 0 ? ModbusException::none : ModbusException::illegal_data_value;
}

ModbusException ModbusResponder::write_registers(std::uint32_t address, Bytes words) {
  const auto count = static_cast<std::uint32_t>(words.size() / 2);
  auto bad = check_write(ModbusTable::holding_register, address, count);
  if (bad == ModbusException::none) bad = stage_registers(address, words);
  if (bad == ModbusException::none) image_.post(batch_);
  return bad;
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
  const std::uint16_t after[] = {
      static_cast<std::uint16_t>((before & and_mask) | (or_mask & static_cast<std::uint16_t>(~and_mask)))};
  const auto value = decode(entry, type, after);
  if (!value) return ModbusException::illegal_data_value;
  batch_.assign(1, {entry.signal, *value});
  // Bits that the request leaves alone stay what they are when the write enters, not what they were when it
  // was asked for: a program may own them. Where the register is not the signal itself, the whole value goes.
  if (size_of(type) == 2 && !entry.is_scaled) {
    const auto named = static_cast<std::uint16_t>(~and_mask);
    batch_[0].mask = entry.byte_order == ByteOrder::big ? named : std::uint16_t(named << 8 | named >> 8);
  }
  image_.post(batch_);
  return ModbusException::none;
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
    if (!part->range.allows(as_double(value, Type::BOOL))) return ModbusException::illegal_data_value;
    batch_.push_back({part->signal, value});
  }
  if ((named & or_mask) != 0) return ModbusException::illegal_data_value;
  if (!batch_.empty()) image_.post(batch_);
  return ModbusException::none;
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
