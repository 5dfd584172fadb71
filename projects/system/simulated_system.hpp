/// All controllers of a system on one virtual time.
///
///     lockstep::SimulatedSystem machine("press_line.json");
///     machine.run_for(std::chrono::seconds(5));
///     double position = machine.read("PLC_2.Line.Position");
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "projects/system/simulated_network.hpp"
#include "projects/system/system.hpp"
#include "scheduler/telegram_ring.hpp"

namespace lockstep {

/// Steps the controllers of a system, each at the ticks of its own cycle and phase, with the network between
/// them that the system file describes. Deterministic: the same files and calls give the same values, bit for
/// bit. One thread at a time.
class SimulatedSystem {
 public:
  /// Of a system that has been loaded to run; the stimuli of its projects apply.
  explicit SimulatedSystem(System system);
  /// Loads the file. @throws InvalidProject, UnreadableFile
  explicit SimulatedSystem(const std::string& path);
  SimulatedSystem(const SimulatedSystem&) = delete;
  SimulatedSystem& operator=(const SimulatedSystem&) = delete;

  /// The controller whose tick comes next: the one with the earliest, of several the first of the file.
  std::size_t next() const noexcept { return due_.top().second; }
  /// Time of that tick [ns], common to all.
  std::int64_t now() const noexcept { return due_.top().first; }
  /// Runs that tick: hands over what has arrived, runs the cycle, sends.
  void step();
  /// Runs all ticks up to that time from now on, but not those of its end.
  void run_for(std::chrono::nanoseconds duration);

  /// The value at a path with the controller before it, such as `PLC_1.Conveyor.Position`.
  /// @throws std::out_of_range with what is wrong with the path
  double read(std::string_view path) const;
  /// Writes a tag, or a variable that a program may set, before the next tick.
  /// @throws as `Simulation::write`
  void write(std::string_view path, double value);

  System& system() noexcept { return system_; }
  /// Telegrams that the network has lost, of all links.
  std::uint64_t lost() const noexcept;

 private:
  struct Sender {
    std::unique_ptr<TelegramRing> ring;
    std::vector<SimulatedLink*> links;
  };
  struct Receiver {
    std::unique_ptr<SimulatedLink> link;
    std::unique_ptr<TelegramRing> ring;
  };
  struct Ends {
    std::vector<Sender> senders;
    std::vector<Receiver> receivers;
  };
  using Due = std::pair<std::int64_t, std::size_t>;

  void connect();
  std::pair<std::size_t, std::string_view> split(std::string_view path) const;

  System system_;
  std::vector<Ends> ends_;  // of the controllers
  std::priority_queue<Due, std::vector<Due>, std::greater<>> due_;
};

}  // namespace lockstep
