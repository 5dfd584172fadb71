/// Lockstep embedded: a project in real time, with all that is around its cycle, in a few lines.
///
///     lockstep::Runtime machine({.file = "knife.json", .modbus = "127.0.0.1:1502"});
///     machine.start();
///     …
///     machine.stop();
///     machine.wait();
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/retain/writer.hpp"
#include "hmi_bridge/traces/columns.hpp"
#include "projects/loader/project.hpp"
#include "projects/runtime/messages.hpp"
#include "projects/runtime/run_options.hpp"
#include "scheduler/real_time.hpp"

namespace lockstep {

/// How far a run has come.
enum class RuntimeState : std::uint8_t {
  loaded,   ///< not started
  running,  ///< ticks go on, those included that bring the axes to rest
  ending,   ///< the axes are at rest; values, server, clients, traces and audit log come to their end
  ended     ///< nothing goes on any more
};

/// A project that runs in real time, which is what `lockstep run` is made of: with its Modbus server and
/// clients, traces and commands over LCM, kept values, flight recorder and audit log. Its threads are the
/// cycle's, those of what is around it, and one that looks after them; it runs once. Signals of the process,
/// exit statuses and the service manager stay with the program that embeds it. In virtual time there is
/// `Simulation`.
class Runtime {
 public:
  /// For what comes after the axes are at rest; that itself takes ten seconds at most.
  static constexpr std::chrono::milliseconds kPatience{5000};

  /// Loads the project and gives kept values back.
  /// @param messages hears what the run tells; it lives as long as something of it does; nullptr: nobody
  /// @throws InvalidProject, UnreadableFile, RetainFileError, and CouldNotStart for options of virtual time
  explicit Runtime(RunOptions options, std::shared_ptr<Messages> messages = nullptr);
  /// For a project that has been loaded.
  /// @param keeper as `restore_kept` has given it for this project; nullptr: nothing is kept
  Runtime(Project project, std::unique_ptr<RetainWriter> keeper, RunOptions options,
          std::shared_ptr<Messages> messages = nullptr);
  /// Stops and waits. What does not come to its end in time is left alone with all that it needs, and may
  /// go on until the process ends.
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  /// With `cpu`, leaves that processor with the calling thread, and so with those that it starts from then
  /// on; nothing otherwise, and after the first call. Before threads of the program that are to leave it too.
  /// @throws CouldNotStart
  void leave_processor();

  /// Leaves the processor, and starts all that is around the cycle. Between this and `start` a program adds
  /// images of its own to the controller.
  /// @throws CouldNotStart, std::logic_error if it has been called before; std::exception where the system
  ///   gives no threads or memory. This object cannot be started any more then
  void prepare();

  /// Prepares, if that has not been done, and starts the cycle. The memory of the process is locked as far
  /// as the system permits, the stacks of its threads included: `keep_stacks_small` limits those.
  /// @throws as `prepare`. Nothing runs then, and this object cannot be started any more
  void start();

  /// Asks the run to end: its axes are brought to rest. Any thread; returns at once.
  void stop() noexcept;

  /// Waits until the run has ended: because of `stop`, its duration, or the overrun policy. Not limited as
  /// long as the axes are not at rest. One thread at a time.
  /// @param timeout for what comes after that
  /// @return false if something does not come to its end (`unfinished`); it may be called again
  bool wait(std::chrono::milliseconds timeout = kPatience);
  /// Waits until the axes are at rest, for so long at most, or until `stop`, if that comes first.
  /// @return whether they are
  bool wait_for_rest(std::chrono::milliseconds time);

  /// Any thread.
  RuntimeState state() const;
  /// Ticks, overruns, times. Every member may be read by any thread, from `start` on.
  /// @throws std::logic_error before that
  const RealTimeStatus& status() const;
  /// What has not come to its end, a line each. Any thread.
  std::vector<std::string> unfinished() const;
  /// Where the Modbus server listens, with the ports that the system gave; empty: there is none over TCP.
  /// From `prepare` on.
  std::vector<Endpoint> modbus_endpoints() const;
  /// Where the studio listens, with the port that the system gave; none: there is no studio. From `prepare`
  /// on.
  std::optional<Endpoint> studio_endpoint() const;
  /// Of the trace, as options and project say. From `prepare` on.
  const std::vector<NamedSignal>& trace_signals() const;

  /// The loaded project. Between `start` and `ended` its controller belongs to the cycle: what a program
  /// wants to see or write then goes through a `ProcessImage` that it adds to `controller->images` before.
  Project& project() noexcept;

 private:
  class Run;

  // Shared with the thread that looks after it, which may outlive this.
  std::shared_ptr<Run> run_;
  std::thread thread_;
};

}  // namespace lockstep
