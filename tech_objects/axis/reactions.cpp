#include "tech_objects/axis/reactions.hpp"

#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

void Reactions::raise(int alarm_number, const AlarmDetail& detail) noexcept {
  raise(alarm_number, static_cast<AlarmReaction>(find_alarm(alarm_number)->reaction), detail);
}

void Reactions::raise(int alarm_number, AlarmReaction reaction, const AlarmDetail& detail) noexcept {
  const Alarm* alarm = find_alarm(alarm_number);
  alarm_notes.raised(alarm_number, static_cast<int>(reaction), detail);
  if (reaction == AlarmReaction::none) {
    set_bit(data.WarningWord, static_cast<unsigned>(alarm->warning_bit), true);
    return;
  }
  set_bit(data.ErrorWord, static_cast<unsigned>(alarm->error_bit), true);
  set_bit(data.StatusWord, StatusBit::Error, true);
  const DINT strength = static_cast<DINT>(reaction);
  if (strength <= data.ErrorDetail.Reaction) return;  // a weaker reaction changes nothing
  data.ErrorDetail.Number = static_cast<UDINT>(alarm->number);
  data.ErrorDetail.Reaction = strength;
  react(reaction);
}

void Reactions::react(AlarmReaction reaction) noexcept {
  Dynamics dynamics = limits_.maximum();
  if (reaction == AlarmReaction::stop_current) dynamics = single_.dynamics();
  if (reaction == AlarmReaction::stop_emergency) dynamics = limits_.emergency();
  if (jobs_.stops_harder_than(reaction))
    return coupling_.end_simulated(JobPhase::failed, ErrorId::technology_alarm);
  ends_.end_all(JobPhase::failed, ErrorId::technology_alarm);
  coupling_.end_simulated(JobPhase::failed, ErrorId::technology_alarm);
  if (reaction == AlarmReaction::remove_enable || reaction == AlarmReaction::track_setpoints) {
    enable_removed_ = true;
    if (power_state_ == PowerState::off) return;
    // The drive stops by its own ramp; a virtual axis, which has none, takes the emergency ramp.
    power_.begin_braking(PowerStopMode::quick_stop);
    return;
  }
  if (power_state_ != PowerState::on) return;
  stops_.begin(dynamics, false);
  if (reaction == AlarmReaction::stop_emergency) power_.ask_for_emergency_ramp();
}

void Reactions::acknowledge() noexcept {
  data.ErrorWord = DWORD{};
  data.WarningWord = DWORD{};
  data.ErrorDetail = {};
  alarm_notes.acknowledged();
  enable_removed_ = false;
}

}  // namespace lockstep
