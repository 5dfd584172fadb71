/// The asking side of Modbus: one connection to one device or gateway, over TCP or a serial line.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hmi_bridge/modbus/map.hpp"
#include "hmi_bridge/modbus/serial.hpp"
#include "hmi_bridge/network/network.hpp"

namespace lockstep {

/// The maximum that one request may read or write.
inline constexpr std::uint32_t kMaximumRegistersRead = 125, kMaximumRegistersWritten = 123;
inline constexpr std::uint32_t kMaximumBitsRead = 2000, kMaximumBitsWritten = 1968;

/// A connection. Each function waits for its whole answer, for the time-out at most and on a serial line for
/// what its characters take besides (a name server may take longer). An answer that is not one to the
/// request, by its header or by `judge_answer`, is a failure. After any failure but an exception the
/// connection is closed, since an answer that comes late would be taken for that of the next request. All
/// functions: one thread.
class ModbusMaster {
 public:
  ModbusMaster(const Endpoint& endpoint, std::chrono::milliseconds timeout);
  ModbusMaster(const SerialOptions& line, std::chrono::milliseconds timeout);
  ~ModbusMaster();
  ModbusMaster(const ModbusMaster&) = delete;
  ModbusMaster& operator=(const ModbusMaster&) = delete;

  bool connect();
  void close() noexcept;
  bool is_connected() const noexcept { return is_connected_; }
  /// Whether the other side has ended the connection meanwhile, as many do with one that rests; of a serial
  /// line never.
  bool is_cut() const noexcept;

  /// Reads registers, or bits as 0 and 1, into all of `words`; as many as one request may read.
  /// @param unit 1…247; over TCP 0 and 255 too
  bool read(int unit, ModbusTable table, std::uint32_t address, std::span<std::uint16_t> words);
  /// Writes holding registers or coils; one of them with functions 6 and 5, several with 16 and 15.
  bool write(int unit, ModbusTable table, std::uint32_t address, std::span<const std::uint16_t> words);
  /// Writes the bits of a holding register that `mask` names, with function 22.
  bool write_bits(int unit, std::uint32_t address, std::uint16_t mask, std::uint16_t bits);

  /// What went wrong in the last function that failed.
  const std::string& problem() const noexcept { return problem_; }
  /// Whether that was an exception: the device has answered and refused.
  bool was_refused() const noexcept { return was_refused_; }

 private:
  struct Library;
  bool has_address();
  void wait_for(std::chrono::microseconds time);
  void begin(int unit, int function, std::uint32_t address, std::uint32_t second);
  void put(std::uint32_t word);
  bool ask(std::size_t bytes_back);
  bool send();
  bool receive();
  bool fail(int error);
  bool fail(const char* flaw);

  std::unique_ptr<Library> library_;
  const std::string host_;  // empty: a serial line
  const std::chrono::milliseconds timeout_;
  const std::chrono::nanoseconds character_{0};  // on a serial line
  bool is_connected_ = false;
  bool was_refused_ = false;
  std::string problem_;
  std::uint16_t transaction_ = 0;
  std::vector<std::uint8_t> request_, answer_;  // each from the unit on
};

}  // namespace lockstep
