/// One client of the Modbus server: its socket and what is on its way in and out.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hmi_bridge/modbus/request.hpp"

namespace lockstep {

/// A client's connection. Never blocks, and holds at most a few frames in and one answer out: while an answer
/// waits for the client to take it, no further request of that client is read, so that it can fill nothing
/// but its own socket. All functions: the thread of the server.
class ModbusConnection {
 public:
  using Clock = std::chrono::steady_clock;

  /// Owns the socket, which is non-blocking already.
  ModbusConnection(int socket, Clock::time_point now) noexcept;
  ~ModbusConnection();
  ModbusConnection(const ModbusConnection&) = delete;
  ModbusConnection& operator=(const ModbusConnection&) = delete;

  int socket() const noexcept { return socket_; }
  /// What to wait for: poll's events.
  short events() const noexcept;

  /// Takes in what has come, as far as there is space. False: the connection is broken.
  bool receive(Clock::time_point now) noexcept;
  /// The next whole request, once the answer to the one before is on its way; else empty.
  std::span<const std::uint8_t> request() const noexcept;
  /// Removes that request and sends the answer, at once or as the client takes it. False: broken.
  bool reply(std::span<const std::uint8_t> answer, Clock::time_point now) noexcept;
  /// Sends what is left of an answer. False: broken.
  bool flush() noexcept;

  /// True if what comes next is not Modbus.
  bool is_malformed() const noexcept { return sent_ == to_send_ && !modbus_frame_length(received()); }
  /// True once the client has ended its side and everything whole was answered.
  bool is_over() const noexcept { return has_ended_ && sent_ == to_send_ && request().empty(); }
  /// True if a request has begun and not ended, or an answer was not taken: the client owes something.
  bool is_owing() const noexcept { return filled_ != 0 || sent_ != to_send_; }
  /// Time of the last request, or of the first byte of the one that has begun.
  Clock::time_point last_progress() const noexcept { return last_progress_; }

 private:
  std::span<const std::uint8_t> received() const noexcept { return std::span(in_).first(filled_); }

  int socket_;
  bool has_ended_ = false;
  std::size_t filled_ = 0;
  std::size_t to_send_ = 0;
  std::size_t sent_ = 0;
  Clock::time_point last_progress_;
  std::array<std::uint8_t, 8 * kModbusFrame> in_;
  std::array<std::uint8_t, kModbusFrame> out_;
};

}  // namespace lockstep
