#include "hmi_bridge/modbus_master.hpp"

#include <modbus.h>
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
          modbus_new_tcp_pi(place.host.c_str(), std::to_string(place.port).c_str()))) {
  prepare(timeout);
}

ModbusMaster::ModbusMaster(const SerialOptions& line, std::chrono::milliseconds timeout)
    : library_(std::make_unique<Library>(modbus_new_rtu(line.device.c_str(), line.baud,
                                                        line.parity == Parity::none   ? 'N'
                                                        : line.parity == Parity::even ? 'E'
                                                                                      : 'O',
                                                        8, line.stop_bits))) {
  prepare(timeout);
}

ModbusMaster::~ModbusMaster() {
  close();
}

void ModbusMaster::prepare(std::chrono::milliseconds timeout) {
  if (library_->context == nullptr) return;
  const auto seconds = static_cast<std::uint32_t>(timeout.count() / 1000);
  const auto rest = static_cast<std::uint32_t>(timeout.count() % 1000 * 1000);
  modbus_set_response_timeout(library_->context, seconds, rest);
  modbus_set_byte_timeout(library_->context, seconds, rest);
}

bool ModbusMaster::connect() {
  close();
  if (library_->context == nullptr) return fail(EINVAL);
  errno = 0;
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
  // A name that cannot be found leaves no number of an error.
  problem_ = error == 0 ? "no such host" : modbus_strerror(error);
  if (!was_refused_) close();
  return false;
}

bool ModbusMaster::select(int unit) {
  if (!is_connected_) return fail(ENOTCONN);
  return modbus_set_slave(library_->context, unit) == 0 || fail(errno);
}

bool ModbusMaster::finish(bool is_good) {
  return is_good || fail(errno);
}

bool ModbusMaster::read(int unit, ModbusTable table, std::uint32_t address, std::span<std::uint16_t> words) {
  if (!select(unit)) return false;
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
  if (!select(unit)) return false;
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
  if (!select(unit)) return false;
  return finish(modbus_mask_write_register(library_->context, static_cast<int>(address),
                                           static_cast<std::uint16_t>(~mask), bits) == 1);
}

}  // namespace lockstep
