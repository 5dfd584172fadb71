/// Polls and writes foreign Modbus devices on a schedule.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/modbus/map.hpp"
#include "hmi_bridge/modbus/master.hpp"
#include "hmi_bridge/modbus/options.hpp"
#include "scheduler/process_image.hpp"

namespace lockstep {

/// What a client has seen. Any thread may read.
struct ModbusClientCounters {
  std::atomic<std::uint64_t> requests{0};     ///< answered as they should be
  std::atomic<std::uint64_t> refused{0};      ///< answered with an exception
  std::atomic<std::uint64_t> failed{0};       ///< without a good answer
  std::atomic<std::uint64_t> bad_values{0};   ///< read, and not held by their tag
  std::atomic<std::uint64_t> connections{0};  ///< made
  std::atomic<std::uint64_t> unreachable{0};  ///< attempts at a connection that failed
  std::atomic<std::uint64_t> faults{0};       ///< internal failures survived
};

/// A client on a thread of its own. In each cycle of a device the values of its write entries, all of one
/// instant, go out; then all its read entries are read, neighbours in one request, and enter their signals at
/// one tick, with quality and age. What was read in a cycle that failed half-way enters as far as it came;
/// the other signals keep their values. Where a device refuses a request for several lines, each is asked for
/// alone, so that only what it refuses is bad; they go together again after a hundred cycles. A device that
/// does not answer is asked again after a pause that doubles, so that it does not hold up the others behind
/// the same connection; so it is with the connection itself.
class ModbusClient {
 public:
  /// `image` outlives it; the client is the image's thread of the bridge.
  ModbusClient(ModbusClientOptions options, ProcessImage& image);
  /// Stops.
  ~ModbusClient();
  ModbusClient(const ModbusClient&) = delete;
  ModbusClient& operator=(const ModbusClient&) = delete;

  /// Thread: the owner.
  void start();
  /// Ends the thread, after the time-out at most. Thread: the owner.
  void stop();

  const ModbusClientOptions& options() const noexcept { return options_; }
  const ModbusClientCounters& counters() const noexcept { return counters_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Entries that follow each other in a table, for one request.
  struct Block {
    ModbusTable table;
    std::uint32_t address = 0;
    std::uint32_t count = 0;
    std::vector<ModbusEntry> entries;
  };
  /// A pause that doubles.
  struct Retry {
    Clock::time_point at{};
    std::chrono::milliseconds pause{0};
  };
  /// How a request ended: refused by the device with an exception, failed without a good answer.
  enum class Outcome : std::uint8_t { good, bad_value, refused, failed };
  /// A line of entries; number and direction as in `ModbusLineState`.
  struct Line {
    bool is_good = false;  ///< in the cycle at hand
    Clock::time_point last_good{};
  };
  struct Device {
    const ModbusDevice* options;
    std::vector<Block> reads, writes;
    std::array<std::vector<Line>, 2> lines{};  ///< of reads and writes, by number
    int cycles_apart = 0;                      ///< until refused requests go together again; 0: they do
    Clock::time_point next{};
    Clock::time_point last_good{};
    Retry retry{};
  };

  static std::vector<Block> blocks_of(std::vector<ModbusEntry> entries, std::uint32_t maximum_registers,
                                      std::uint32_t maximum_bits);
  void run() noexcept;
  void turn(Device& device);
  bool wait_until(Clock::time_point time);
  bool is_reachable(Clock::time_point now);
  bool exchange(Device& device);
  void make_blocks(Device& device) const;
  static std::vector<Block> parts_of(const Block& block);
  bool exchange(Device& device, std::vector<Block>& blocks, bool is_write);
  static bool take_apart(std::vector<Block>& blocks, std::size_t index);
  Outcome read_block(Device& device, const Block& block);
  Outcome write_block(const Device& device, const Block& block);
  Outcome count(bool is_good);
  void put_off(Retry& retry, Clock::time_point now) const;
  void show(Device& device, bool is_good, Clock::time_point now);

  const ModbusClientOptions options_;
  ProcessImage& image_;
  ModbusClientCounters counters_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_stopping_ = false;
  std::thread thread_;

  // The thread's.
  std::unique_ptr<ModbusMaster> master_;
  Retry connection_;
  std::vector<Device> devices_;
  std::vector<std::uint16_t> words_;
  std::vector<SignalWrite> batch_;
};

}  // namespace lockstep
