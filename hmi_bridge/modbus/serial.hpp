/// Modbus RTU: a serial line and the frames on it.
/// @source Modbus over serial line V1.02, 2.5.1
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hmi_bridge/modbus/counters.hpp"
#include "hmi_bridge/modbus/options.hpp"
#include "hmi_bridge/modbus/request.hpp"

namespace lockstep {

/// How long the line takes for one character, with its start, parity and stop bits.
std::chrono::nanoseconds character_time(const SerialOptions& options) noexcept;

/// The silence that ends a frame with these options.
std::chrono::microseconds frame_silence(const SerialOptions& options) noexcept;

/// The check at the end of a frame, whose low byte goes first.
std::uint16_t modbus_crc(std::span<const std::uint8_t> bytes) noexcept;

/// The side of a line that answers. Never blocks. A line that breaks, such as an adapter that is pulled out,
/// is opened again once a second. All functions: one thread.
class ModbusSerialLine {
 public:
  using Clock = std::chrono::steady_clock;

  /// `counters` outlive it.
  ModbusSerialLine(SerialOptions options, ModbusCounters& counters);
  ~ModbusSerialLine();
  ModbusSerialLine(const ModbusSerialLine&) = delete;
  ModbusSerialLine& operator=(const ModbusSerialLine&) = delete;

  /// Opens the device. Returns an empty text or what is wrong.
  std::string open();
  /// To wait for; -1 while it is closed.
  int descriptor() const noexcept { return descriptor_; }
  /// When something has to be done even if nothing comes: a frame ends, the line is opened again.
  Clock::time_point due() const noexcept;

  /// Takes in what has come; opens the line again if that is due.
  /// @param is_broken the system says that there is nobody any more
  void receive(Clock::time_point now, bool is_broken = false);
  /// The frame that has ended, with the header of Modbus TCP before it, or nothing. Valid until the next
  /// call.
  std::span<std::uint8_t> request(Clock::time_point now);
  /// Sends an answer, which has the header of Modbus TCP.
  void reply(std::span<const std::uint8_t> answer);

 private:
  static constexpr std::size_t kLongest = 256;  ///< of a frame [byte]

  void close(Clock::time_point now) noexcept;

  const SerialOptions options_;
  const std::chrono::microseconds silence_;
  ModbusCounters& counters_;
  struct Port;
  std::unique_ptr<Port> port_;  ///< the library's
  int descriptor_ = -1;
  Clock::time_point open_again_{};
  Clock::time_point last_byte_{};
  std::size_t filled_ = 0;  ///< beyond kLongest: the frame is too long
  std::array<std::uint8_t, kLongest + 1> in_{};
  std::array<std::uint8_t, kModbusFrame> frame_{};
};

}  // namespace lockstep
