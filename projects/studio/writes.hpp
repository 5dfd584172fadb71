/// Values that pages write into a run.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"
#include "projects/loader/project.hpp"
#include "projects/studio/powers.hpp"
#include "scheduler/chosen_writes.hpp"

namespace lockstep {

/// Checks each write as a program that embeds the run is checked, and hands whole batches to the cycle, one
/// after the other. Thread: the server's, but for the crossing's other side.
class StudioWrites {
 public:
  using Clock = std::chrono::steady_clock;
  using Done = StudioHandler::Done;
  static constexpr std::size_t kWaiting = 50;  ///< batches

  /// What is given outlives this.
  StudioWrites(const Project& project, const StudioPowers& powers, ChosenWrites& crossing)
      : project_(project), powers_(powers), crossing_(crossing) {}

  /// `POST /api/write`. @throws studio_api::BadRequest
  void write(const StudioRequest& request, Done done);
  /// What a body of it writes, if all of it may be; else nothing. Any thread that has the project to itself.
  std::vector<ChosenWrite> chosen(const std::string& body) const;
  /// Hands on what waits, answers what has been applied or has waited too long.
  void look(Clock::time_point now);
  void end() noexcept { waiting_.clear(); }

 private:
  struct Target {
    std::string path;
    Type type = Type::BOOL;
    bool is_text = false;
    std::string wanted;  // as it was asked for, as JSON
  };
  struct Batch {
    std::vector<ChosenWrite> writes;
    std::vector<Target> targets;
    std::string peer, body;
    Clock::time_point until;
    Done done;  // empty: it has been answered
    bool is_posted = false;
  };

  void add(const studio_api::Json& json, Batch& batch, studio_api::Wrong& wrong) const;
  void add_text(const StringTag& tag, const studio_api::Json& json, Batch& batch,
                studio_api::Wrong& wrong) const;
  void refuse(const studio_api::Wrong& wrong, std::string_view peer) const;
  void tell_applied(const Batch& batch) const;
  void audit(const Target& target, std::string_view peer, const std::string& before, bool accepted,
             const std::string& why) const;
  StudioAnswer answer_of(const Batch& batch) const;
  std::int64_t time_of(std::int64_t tick) const noexcept {
    return tick * project_.controller->clock.servo_cycle;
  }

  const Project& project_;
  const StudioPowers& powers_;
  ChosenWrites& crossing_;
  std::deque<Batch> waiting_;
};

}  // namespace lockstep
