#include "hmi_bridge/modbus/serial.hpp"

#include <modbus.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace lockstep {
namespace {

constexpr std::chrono::seconds kReopen{1};
constexpr std::size_t kCheck = 2;     ///< bytes of the check
constexpr std::size_t kShortest = 4;  ///< address, function, check

char parity_letter(Parity parity) noexcept {
  return parity == Parity::none ? 'N' : parity == Parity::even ? 'E' : 'O';
}

}  // namespace

/// The library opens the device and sets it up. Its framing is not used: it waits for the rest of a frame,
/// and takes what other devices on the line answer for requests.
struct ModbusSerialLine::Port {
  explicit Port(const SerialOptions& options)
      : context(modbus_new_rtu(options.device.c_str(), options.baud, parity_letter(options.parity), 8,
                               options.stop_bits)) {}
  ~Port() {
    if (context == nullptr) return;
    modbus_close(context);
    modbus_free(context);
  }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  modbus_t* context;
};

std::chrono::nanoseconds character_time(const SerialOptions& options) noexcept {
  const int bits = 1 + 8 + (options.parity == Parity::none ? 0 : 1) + options.stop_bits;
  return std::chrono::nanoseconds(1'000'000'000LL * bits / options.baud);
}

std::chrono::microseconds frame_silence(const SerialOptions& options) noexcept {
  if (options.silence.count() > 0) return options.silence;
  const auto characters =
      std::chrono::duration_cast<std::chrono::microseconds>(7 * character_time(options) / 2);
  return std::max(characters, std::chrono::microseconds(1750));
}

std::uint16_t modbus_crc(std::span<const std::uint8_t> bytes) noexcept {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xA001u : crc >> 1;
  }
  return static_cast<std::uint16_t>(crc);
}

ModbusSerialLine::ModbusSerialLine(SerialOptions options, ModbusCounters& counters)
    : options_(std::move(options)), silence_(frame_silence(options_)), counters_(counters) {}

ModbusSerialLine::~ModbusSerialLine() = default;

std::string ModbusSerialLine::open() {
  auto port = std::make_unique<Port>(options_);
  if (port->context == nullptr || modbus_connect(port->context) != 0) return modbus_strerror(errno);
  descriptor_ = modbus_get_socket(port->context);
  if (::isatty(descriptor_) == 0) {
    descriptor_ = -1;
    return "is no serial line";
  }
  ::tcflush(descriptor_, TCIOFLUSH);
  port_ = std::move(port);
  filled_ = 0;
  return {};
}

void ModbusSerialLine::close(Clock::time_point now) noexcept {
  port_.reset();
  descriptor_ = -1;
  filled_ = 0;
  open_again_ = now + kReopen;
}

ModbusSerialLine::Clock::time_point ModbusSerialLine::due() const noexcept {
  if (descriptor_ < 0) return open_again_;
  return filled_ == 0 ? Clock::time_point::max() : last_byte_ + silence_;
}

void ModbusSerialLine::receive(Clock::time_point now, bool is_broken) {
  if (descriptor_ < 0) {
    if (now >= open_again_ && !open().empty()) close(now);
    return;
  }
  for (;;) {
    // What goes beyond the longest frame is thrown away; the silence after it begins a new one.
    if (filled_ > kLongest) filled_ = kLongest;
    const ssize_t count = ::read(descriptor_, in_.data() + filled_, in_.size() - filled_);
    if (count > 0) {
      filled_ += static_cast<std::size_t>(count);
      last_byte_ = now;
      continue;
    }
    // No bytes is what a quiet line gives as well as one that has ended.
    is_broken |= count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR;
    if (is_broken) {
      ++counters_.broken_lines;
      close(now);
    }
    return;
  }
}

std::span<std::uint8_t> ModbusSerialLine::request(Clock::time_point now) {
  if (filled_ == 0 || now < last_byte_ + silence_) return {};
  const std::size_t size = std::exchange(filled_, 0);
  const auto got = std::span<const std::uint8_t>(in_).first(size);
  if (size < kShortest || size > kLongest ||
      modbus_crc(got.first(size - kCheck)) != (got[size - 2] | got[size - 1] << 8)) {
    ++counters_.bad_frames;
    return {};
  }
  const std::size_t counted = size - kCheck;
  const std::array<std::uint8_t, kModbusHeader - 1> head = {
      0, 0, 0, 0, static_cast<std::uint8_t>(counted >> 8), static_cast<std::uint8_t>(counted)};
  std::copy(head.begin(), head.end(), frame_.begin());
  std::copy_n(got.begin(), counted, frame_.begin() + head.size());
  return std::span(frame_).first(head.size() + counted);
}

void ModbusSerialLine::reply(std::span<const std::uint8_t> answer) {
  if (descriptor_ < 0) return;
  const auto body = answer.subspan(kModbusHeader - 1);
  std::array<std::uint8_t, kLongest> out;
  std::copy(body.begin(), body.end(), out.begin());
  const std::uint16_t crc = modbus_crc(body);
  out[body.size()] = static_cast<std::uint8_t>(crc);
  out[body.size() + 1] = static_cast<std::uint8_t>(crc >> 8);
  const std::size_t size = body.size() + kCheck;
  // The system takes 4 kB at once; if it does not, nobody listens, and the asker will ask again.
  if (::write(descriptor_, out.data(), size) != static_cast<ssize_t>(size)) ++counters_.bad_frames;
}

}  // namespace lockstep
