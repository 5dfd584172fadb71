/// lockstep run: when it ends. Signals, and a limit in time for all that comes before and after the motion.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace lockstep::cli {

/// Watches over a run, on a thread of its own, so that nothing that blocks elsewhere keeps the process from
/// ending: a pipe that nobody reads, a hung disk, a name server. What it waits for are SIGINT, SIGTERM,
/// SIGQUIT, SIGPWR and SIGXCPU, each of which asks the run to end; all others that would end or stop the
/// process are ignored, but for those that tell of a fault in it.
///
/// Axes are always given the time to come to rest. What comes after that has `kPatience`, and a second signal
/// makes that `kShortPatience`; then it is told what was not finished, and the process ends with status 3.
/// Where a run was asked to end before it began and does not come to that, it ends with 2.
class Ending {
 public:
  static constexpr std::chrono::milliseconds kPatience{5000};
  static constexpr std::chrono::milliseconds kShortPatience{300};
  /// For the axes, counted from the signal; the cycle itself takes ten seconds at most.
  static constexpr std::chrono::milliseconds kLongestBraking{15'000};

  /// Takes the signals over, for all threads that are started after it.
  Ending();
  ~Ending();
  Ending(const Ending&) = delete;
  Ending& operator=(const Ending&) = delete;

  /// Whether a signal has asked the run to end. Any thread.
  bool requested() const noexcept { return signals_ > 0; }

  /// The run begins; `stop` is called once, in the thread of the watch, when a signal asks for the end. It
  /// must not block.
  void run(std::function<void()> stop);
  /// The axes are at rest; from here on time is limited.
  /// @param lost tells, in the thread of the watch, what is not finished; with what is called it must live
  ///   until `finished`
  void limit(std::function<std::vector<std::string>()> lost);
  /// Nothing can be lost any more; what still comes is limited all the same.
  void finished();

 private:
  enum class Stage { starting, running, ending };

  void enter(Stage stage);
  void watch() noexcept;
  void take_signal() noexcept;
  std::chrono::milliseconds limit_now() const noexcept;
  [[noreturn]] void leave() noexcept;
  void tell_lost();

  int signals_in_ = -1;  // descriptor that gives the signals
  int wake_ = -1;        // descriptor that wakes the watch
  std::atomic<int> signals_{0};
  std::atomic<Stage> stage_{Stage::starting};
  std::atomic<std::int64_t> spent_{0};  // [ms] of the stage, while time counts
  std::atomic<bool> over_{false};
  std::mutex mutex_;  // guards those below
  std::function<void()> stop_;
  std::function<std::vector<std::string>()> lost_;
  std::thread thread_;
};

}  // namespace lockstep::cli
