#include "hmi_bridge/modbus/master.hpp"

#include <modbus.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

#include "hmi_bridge/modbus/answer.hpp"

namespace lockstep {
namespace {

int function_that_reads(ModbusTable table) noexcept {
  switch (table) {
    case ModbusTable::coil:
      return MODBUS_FC_READ_COILS;
    case ModbusTable::discrete_input:
      return MODBUS_FC_READ_DISCRETE_INPUTS;
    case ModbusTable::input_register:
      return MODBUS_FC_READ_INPUT_REGISTERS;
    case ModbusTable::holding_register:
      break;
  }
  return MODBUS_FC_READ_HOLDING_REGISTERS;
}

}  // namespace

struct ModbusMaster::Library {
  explicit Library(modbus_t* made) : context(made) {}
  ~Library() {
    if (context != nullptr) modbus_free(context);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  modbus_t* context;
};

ModbusMaster::ModbusMaster(const Endpoint& endpoint, std::chrono::milliseconds timeout)
    : library_(std::make_unique<Library>(
          modbus_new_tcp_pi(endpoint.host.c_str(), std::to_string(endpoint.port).c_str()))),
      host_(endpoint.host),
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

bool ModbusMaster::fail(const char* flaw) {
  was_refused_ = false;
  problem_ = flaw;
  close();
  return false;
}

/// A request begins with the unit. All that we ask have an address and another word behind the function.
void ModbusMaster::begin(int unit, int function, std::uint32_t address, std::uint32_t second) {
  request_.assign({static_cast<std::uint8_t>(unit), static_cast<std::uint8_t>(function)});
  put(address);
  put(second);
}

void ModbusMaster::put(std::uint32_t word) {
  request_.push_back(static_cast<std::uint8_t>(word >> 8));
  request_.push_back(static_cast<std::uint8_t>(word));
}

/// Sends the request and waits for its answer. The library's own functions would do so too, but they take an
/// answer of any unit, and one that tells another write than the one that was asked for.
/// @param bytes_back of data that the answer has
bool ModbusMaster::ask(std::size_t bytes_back) {
  if (!is_connected_) return fail(ENOTCONN);
  constexpr std::size_t kAround = 20;  // what request and answer have besides
  const auto on_the_line = static_cast<std::int64_t>(request_.size() + bytes_back + kAround) * character_;
  wait_for(timeout_ + std::chrono::duration_cast<std::chrono::microseconds>(on_the_line));
  // On a line nothing tells which request an answer is for: one that has come late must not wait there.
  if (character_.count() > 0) modbus_flush(library_->context);
  if (modbus_set_slave(library_->context, request_[0]) != 0 || !send()) return fail(errno);
  if (!receive()) return false;
  const ModbusAnswer answer = judge_answer(request_, answer_);
  if (answer.flaw != nullptr) return fail(answer.flaw);
  return answer.exception == 0 || fail(MODBUS_ENOBASE + answer.exception);
}

/// The library numbers no request that it did not make itself, so over TCP they go out from here.
bool ModbusMaster::send() {
  modbus_t* const context = library_->context;
  const auto size = static_cast<int>(request_.size());
  if (host_.empty()) return modbus_send_raw_request(context, request_.data(), size) > 0;
  ++transaction_;
  std::vector<std::uint8_t> frame = {static_cast<std::uint8_t>(transaction_ >> 8),
                                     static_cast<std::uint8_t>(transaction_),
                                     0,
                                     0,
                                     0,
                                     static_cast<std::uint8_t>(size)};
  frame.insert(frame.end(), request_.begin(), request_.end());
  const ssize_t sent = ::send(modbus_get_socket(context), frame.data(), frame.size(), MSG_NOSIGNAL);
  return sent == static_cast<ssize_t>(frame.size());
}

/// The answer without what stands around it: on TCP the rest of the header, on a line the check.
bool ModbusMaster::receive() {
  constexpr std::size_t kHead = 6;
  answer_.resize(std::max(MODBUS_TCP_MAX_ADU_LENGTH, MODBUS_RTU_MAX_ADU_LENGTH));
  const int count = modbus_receive_confirmation(library_->context, answer_.data());
  if (count < 0) return fail(errno);
  if (count == 0) return fail("the answer is of another unit");  // the library does not look further then
  answer_.resize(static_cast<std::size_t>(count));
  if (host_.empty()) {
    constexpr std::size_t kCheck = 2;
    answer_.resize(answer_.size() - kCheck);
    return true;
  }
  if ((answer_[0] << 8 | answer_[1]) != transaction_) return fail("the answer is one to another request");
  if (answer_[2] != 0 || answer_[3] != 0) return fail("the answer is of another protocol than Modbus");
  if ((std::size_t{answer_[4]} << 8 | answer_[5]) != answer_.size() - kHead)
    return fail("the answer has another length than its header says");
  answer_.erase(answer_.begin(), answer_.begin() + kHead);
  return true;
}

bool ModbusMaster::read(int unit, ModbusTable table, std::uint32_t address, std::span<std::uint16_t> words) {
  const auto count = static_cast<std::uint32_t>(words.size());
  const bool is_bits = is_bit_table(table);
  begin(unit, function_that_reads(table), address, count);
  if (!ask(is_bits ? (words.size() + 7) / 8 : 2 * words.size())) return false;
  const auto data = std::span<const std::uint8_t>(answer_).subspan(3);
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] =
        static_cast<std::uint16_t>(is_bits ? data[i / 8] >> (i % 8) & 1 : data[2 * i] << 8 | data[2 * i + 1]);
  return true;
}

bool ModbusMaster::write(int unit, ModbusTable table, std::uint32_t address,
                         std::span<const std::uint16_t> words) {
  const auto count = static_cast<std::uint32_t>(words.size());
  if (is_bit_table(table)) {
    if (count == 1) {
      begin(unit, MODBUS_FC_WRITE_SINGLE_COIL, address, words[0] != 0 ? 0xFF00 : 0);
      return ask(0);
    }
    begin(unit, MODBUS_FC_WRITE_MULTIPLE_COILS, address, count);
    request_.push_back(static_cast<std::uint8_t>((count + 7) / 8));
    request_.resize(request_.size() + (count + 7) / 8);
    std::uint8_t* const bits = request_.data() + request_.size() - (count + 7) / 8;
    for (std::uint32_t i = 0; i < count; ++i)
      if (words[i] != 0) bits[i / 8] |= static_cast<std::uint8_t>(1u << (i % 8));
    return ask(0);
  }
  if (count == 1) {
    begin(unit, MODBUS_FC_WRITE_SINGLE_REGISTER, address, words[0]);
    return ask(0);
  }
  begin(unit, MODBUS_FC_WRITE_MULTIPLE_REGISTERS, address, count);
  request_.push_back(static_cast<std::uint8_t>(2 * count));
  for (const std::uint16_t word : words) put(word);
  return ask(0);
}

bool ModbusMaster::write_bits(int unit, std::uint32_t address, std::uint16_t mask, std::uint16_t bits) {
  begin(unit, MODBUS_FC_MASK_WRITE_REGISTER, address, static_cast<std::uint16_t>(~mask));
  put(bits);
  return ask(0);
}

}  // namespace lockstep
