/// Technology alarms of an axis: each is shown, and its reaction carried out.
#pragma once

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/alarms/notes.hpp"
#include "tech_objects/axis/power.hpp"

namespace lockstep {

/// Where alarms show, and what their reactions act on.
struct ReactionParts {
  AxisData& data;
  AlarmNotes& alarm_notes;
  const JobSlots& jobs_;
  const PowerState& power_state_;
  bool& enable_removed_;
  const SingleAxisMotion& single_;
  const MotionLimits& limits_;
  JobEnds& ends_;
  AxisCoupling& coupling_;
  StopOrders& stops_;
  PowerOrders& power_;
};

/// The one place in which an alarm is raised, reacted to and acknowledged. What it acts on raises nothing.
/// Thread: the cycle.
class Reactions : private ReactionParts {
 public:
  explicit Reactions(const ReactionParts& parts) noexcept : ReactionParts(parts) {}

  void raise(int alarm_number, const AlarmDetail& detail = {}) noexcept;
  /// For alarms whose reaction is a matter of configuration.
  void raise(int alarm_number, AlarmReaction reaction, const AlarmDetail& detail = {}) noexcept;
  /// Nothing is pending any more, and the enable counts again.
  void acknowledge() noexcept;

 private:
  void react(AlarmReaction reaction) noexcept;
};

}  // namespace lockstep
