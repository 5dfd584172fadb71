#include "hmi_bridge/modbus_master.hpp"

#include <modbus.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace lockstep {

struct ModbusMaster::Library {
  explicit Library(modbus_t* made) : context(made) {}
  ~Library() {
    if (context != nullptr) modbus_free(context);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  modbus_t* context;
};

ModbusMaster::ModbusMaster(const Endpoint& place, std::chrono::milliseconds timeout)
    : library_(std::make_unique<Library>(
          modbus_new_tcp_pi(place.host.c_str(), std::to_string(place.port).c_str()))),
      host_(place.host),
      timeout_(timeout) {}

ModbusMaster::ModbusMaster(const SerialOptions& line, std::chrono::milliseconds timeout)
    : library_(std::make_unique<Library>(modbus_new_rtu(line.device.c_str(), line.baud,
                                                        line.parity == Parity::none   ? 'N'
                                                        : line.parity == Parity::even ? 'E'
                                                                                      : 'O',
                                                        8, line.stop_bits))),
      timeout_(timeout),
      character_(character_time(line)) {}

ModbusMaster::~ModbusMaster() {
  close();
}

/// For connecting, and for an answer from its request to its last byte: without a time-out between two bytes
/// that of the answer counts for all of it.
void ModbusMaster::wait_for(std::chrono::microseconds time) {
  const auto seconds = static_cast<std::uint32_t>(time.count() / 1'000'000);
  const auto rest = static_cast<std::uint32_t>(time.count() % 1'000'000);
  modbus_set_response_timeout(library_->context, seconds, rest);
  modbus_set_byte_timeout(library_->context, 0, 0);
}

/// The library takes a name that it cannot find for a refused connection.
bool ModbusMaster::has_address() {
  if (host_.empty()) return true;
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(host_.c_str(), nullptr, &hints, &found);
  if (error == 0) {
    ::freeaddrinfo(found);
    return true;
  }
  was_refused_ = false;
  problem_ = std::string("the name has no address: ") + ::gai_strerror(error);
  return false;
}

bool ModbusMaster::connect() {
  close();
  if (library_->context == nullptr) return fail(EINVAL);
  if (!has_address()) return false;
  wait_for(timeout_);
  is_connected_ = modbus_connect(library_->context) == 0;
  if (is_connected_) modbus_flush(library_->context);
  return is_connected_ || fail(errno);
}

void ModbusMaster::close() noexcept {
  if (is_connected_) modbus_close(library_->context);
  is_connected_ = false;
}

bool ModbusMaster::is_cut() const noexcept {
  char byte = 0;
  const ssize_t count =
      ::recv(modbus_get_socket(library_->context), &byte, 1, MSG_PEEK | MSG_DONTWAIT | MSG_NOSIGNAL);
  return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != ENOTSOCK);
}

bool ModbusMaster::fail(int error) {
  was_refused_ = error > MODBUS_ENOBASE && error < EMBBADCRC;
  problem_ = modbus_strerror(error);
  if (!was_refused_) close();
  return false;
}

/// @param bytes of data that go out or come in
bool ModbusMaster::prepare(int unit, std::size_t bytes) {
  if (!is_connected_) return fail(ENOTCONN);
  constexpr std::size_t kAround = 20;  // what request and answer have besides
  const auto on_the_line = static_cast<std::int64_t>(bytes + kAround) * character_;
  wait_for(timeout_ + std::chrono::duration_cast<std::chrono::microseconds>(on_the_line));
  // On a line nothing tells which request an answer is for: one that has come late must not wait there.
  if (character_.count() > 0) modbus_flush(library_->context);
  return modbus_set_slave(library_->context, unit) == 0 || fail(errno);
}

bool ModbusMaster::finish(bool is_good) {
  return is_good || fail(errno);
}

bool ModbusMaster::read(int unit, ModbusTable table, std::uint32_t address, std::span<std::uint16_t> words) {
  if (!prepare(unit, words.size() * 2)) return false;
  modbus_t* const context = library_->context;
  const int from = static_cast<int>(address);
  const int count = static_cast<int>(words.size());
  if (table == ModbusTable::holding_register)
    return finish(modbus_read_registers(context, from, count, words.data()) == count);
  if (table == ModbusTable::input_register)
    return finish(modbus_read_input_registers(context, from, count, words.data()) == count);
  std::array<std::uint8_t, kMostBitsRead> bits{};
  const int got = table == ModbusTable::coil ? modbus_read_bits(context, from, count, bits.data())
                                             : modbus_read_input_bits(context, from, count, bits.data());
  std::copy_n(bits.begin(), words.size(), words.begin());
  return finish(got == count);
}

bool ModbusMaster::write(int unit, ModbusTable table, std::uint32_t address,
                         std::span<const std::uint16_t> words) {
  if (!prepare(unit, words.size() * 2)) return false;
  modbus_t* const context = library_->context;
  const int from = static_cast<int>(address);
  const int count = static_cast<int>(words.size());
  if (table == ModbusTable::holding_register) {
    if (count == 1) return finish(modbus_write_register(context, from, words[0]) == 1);
    return finish(modbus_write_registers(context, from, count, words.data()) == count);
  }
  if (count == 1) return finish(modbus_write_bit(context, from, words[0] != 0 ? 1 : 0) == 1);
  std::array<std::uint8_t, kMostBitsWritten> bits{};
  std::transform(words.begin(), words.end(), bits.begin(),
                 [](std::uint16_t word) { return static_cast<std::uint8_t>(word != 0 ? 1 : 0); });
  return finish(modbus_write_bits(context, from, count, bits.data()) == count);
}

bool ModbusMaster::write_bits(int unit, std::uint32_t address, std::uint16_t mask, std::uint16_t bits) {
  if (!prepare(unit, 0)) return false;
  return finish(modbus_mask_write_register(library_->context, static_cast<int>(address),
                                           static_cast<std::uint16_t>(~mask), bits) == 1);
}

}  // namespace lockstep
