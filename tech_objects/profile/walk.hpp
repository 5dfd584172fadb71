/// Along a profile tick by tick.
#pragma once

#include <algorithm>

#include "tech_objects/profile/profile.hpp"

namespace lockstep {

/// The states of a profile at times that do not fall. It keeps the phase at hand beside what asks for it, so
/// that a tick reads that phase alone, not the whole profile. Thread: the cycle.
class ProfileWalk {
 public:
  /// From the beginning of a profile.
  void begin() noexcept { *this = {}; }

  /// What profile.at(t) gives, to the bit. @param profile the one it began with  @param t [s] not before the
  /// last one
  MotionState at(const Profile& profile, double t) noexcept {
    if (within(t)) return phase_.at(t);
    if (t > 0.0 && t < profile.duration()) enter_phase(profile, t);
    return profile.at(t);
  }

  /// At a time `within` the phase at hand [s].
  MotionState here(double t) const noexcept { return phase_.at(t); }
  /// Whether the phase at hand, and so the profile, is not over yet.
  bool within(double t) const noexcept { return t > 0.0 && before_end(t); }
  /// Whether the phase at hand is not over yet at a time that is > 0.
  bool before_end(double t) const noexcept { return t < end_; }

 private:
  void enter_phase(const Profile& profile, double t) noexcept {
    const std::span phases = profile.phases();
    const auto next = std::find_if(phases.begin() + 1, phases.end(),
                                   [t](const Profile::Phase& phase) { return t < phase.begin; });
    phase_ = next[-1];
    end_ = next == phases.end() ? profile.duration() : next->begin;
  }

  Profile::Phase phase_;
  double end_ = 0.0;  // of the phase [s]; 0: none has been entered
};

}  // namespace lockstep
