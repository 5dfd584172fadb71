/// lockstep run: what the command line asks for, and the parts that carry it out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "projects/loader/project.hpp"
#include "projects/runtime/run_options.hpp"
#include "projects/system/system.hpp"

namespace lockstep::cli {

class ToldOnStandardError;

/// What makes a run fail that has otherwise ended as asked.
struct FailOn {
  bool alarm = false;    ///< one that has a reaction, or has to be acknowledged
  bool warning = false;  ///< one that has none, and goes by itself
  bool job = false;      ///< one that has failed or was rejected
};

/// Loads the project and carries the run out; gives the exit status.
int run_project(const RunOptions& options, FailOn fail_on);

/// Carries the run of a system file out: in virtual time all controllers in this process, in real time each
/// in a process of its own. Gives the exit status.
int run_system(const RunOptions& options, FailOn fail_on);
int run_processes(const RunOptions& options, FailOn fail_on);

/// Carries out the run of one controller of a system, here, in real time; gives the exit status.
int run_controller(const RunOptions& options, const std::string& controller, FailOn fail_on);

/// What the options of a run of a system come to for one of its controllers: its project file, its trace, its
/// signals. @throws CouldNotStart
RunOptions options_of(const System& system, std::size_t controller, const RunOptions& options);

/// In the environment of a process that runs a controller for `run_processes`: where its summary goes, as a
/// descriptor.
inline constexpr char kSummaryVariable[] = "LOCKSTEP_SUMMARY_DESCRIPTOR";

/// Live values on a terminal; nothing in a pipe. Used by one thread, never the cycle's.
class Display {
 public:
  /// Makes the crossing for the values shown; `project` outlives it.
  /// @param alone whether nothing else writes to the terminal; if something does, nothing is shown
  Display(Project& project, const std::vector<NamedSignal>& signals, std::int64_t duration,
          bool alone = true);

  /// Draws the line anew. @param time of the run [ns]  @param note further text, such as counts
  void show(std::int64_t time, const std::string& note);
  /// Ends the line, so that messages may follow.
  void close();

 private:
  std::vector<NamedSignal> shown_;
  std::int64_t duration_;
  std::unique_ptr<ProcessImage> image_;
  bool terminal_;
  bool open_ = false;
};

/// What proxies have had, a line each.
void tell_proxies(const Controller& controller);
/// Tells how the axes stood at the end. @param told what has been told of their alarms
void tell_axes(const Controller& controller, const ToldOnStandardError& told);

}  // namespace lockstep::cli
