/// lockstep run: what a run tells on standard error, and what that makes of its exit status.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "cli/run/events.hpp"
#include "cli/run/run_command.hpp"
#include "projects/runtime/messages.hpp"

namespace lockstep::cli {

/// Tells on standard error what the run has to say.
class ToldOnStandardError final : public Messages {
 public:
  /// @param timeout how long an alarm waits for a reader [ms]
  /// @param controller of a system, by which its messages are told from others; empty: it is no system
  explicit ToldOnStandardError(int timeout, std::string controller = "")
      : timeout_(timeout), controller_(std::move(controller)) {}

  void inform(const std::string& text) noexcept override;
  void warn(const std::string& text) noexcept override;
  void event(const TraceEvent& event) override;
  /// What has been counted only. After the run.
  void tell_rest();

  /// "alarm 343 (…)" with the text that was told of it, which says of some alarms what was missing. After the
  /// run.
  std::string alarm_text(const std::string& object, int number) const;

  /// Those with a reaction, or that have to be acknowledged; the others are warnings.
  std::uint64_t alarms() const noexcept { return alarms_; }
  std::uint64_t warnings() const noexcept { return warnings_; }
  std::uint64_t failed_jobs() const noexcept { return failed_jobs_; }

 private:
  std::atomic<std::uint64_t> alarms_{0};                      // counted by the recorder
  std::atomic<std::uint64_t> warnings_{0};                    // counted by the recorder
  std::atomic<std::uint64_t> failed_jobs_{0};                 // counted by the recorder
  std::map<std::pair<std::string, int>, std::string> texts_;  // of alarms, by object and number
  int timeout_;
  std::string controller_;
  EventMessages events_;
};

/// What a run has counted that somebody has to look at.
/// @param who stands before each message; empty: nothing
/// @param divided time of the first integer division by zero [ns]; negative: nobody knows
void tell_counters(const Controller& controller, const std::string& who = "", std::int64_t divided = -1);

/// The exit status of a run that would have had another one. Whether there was what it is to fail on is in
/// doubt where events were lost.
int status_of(int status, const FailOn& fail_on, const ToldOnStandardError& told,
              const Controller& controller);

}  // namespace lockstep::cli
