/// The course of a homing: the legs of an active one, and the mark that it, or one in passing, looks for.
/// @source S7-1500T axis functions, homing
#pragma once

#include <cstdint>
#include <optional>

#include "tech_objects/drive/machine_signals.hpp"

namespace lockstep {

/// Knows where on its way to the mark an active homing is, and where it has to go next; the axis moves.
/// Thread: the cycle.
class HomingCourse {
 public:
  enum class Phase : std::uint8_t {
    none,
    approach,  // to the reference cam or switch
    clear,     // off the switch again, to meet its edge from outside
    back,      // beyond a zero mark, to meet it in the homing direction
    search,    // towards the mark, with the homing velocity
    travel     // the mark is known: to the home position
  };
  /// As they are when the job is taken over; changed later, they count for the next one.
  struct Settings {
    int direction = 1;                  // in which the mark has to be met
    double mark = 0.0;                  // position that the mark gets [u]
    double approach_velocity = 0.0;     // [u/s]
    double referencing_velocity = 0.0;  // [u/s]
    bool positive_side = false;         // of the switch
  };
  /// What the axis does next.
  struct Leg {
    enum class Kind : std::uint8_t { goes_on, begins, gives_up };
    Kind kind = Kind::goes_on;
    Phase phase = Phase::none;
    int direction = 0;
    int search = 0;  // direction in which a mark is looked for anew; 0: as before
  };

  // ---- An active homing

  void begin(const Settings& settings, Phase phase) noexcept {
    settings_ = settings;
    phase_ = phase;
    reversed_ = false;
  }
  /// A running homing ends, whatever the reason.
  void end() noexcept;
  void enter(Phase phase) noexcept { phase_ = phase; }

  Phase phase() const noexcept { return phase_; }
  bool active() const noexcept { return phase_ != Phase::none; }
  bool travels() const noexcept { return phase_ == Phase::travel; }
  /// Whether the mark is not known yet.
  bool seeks() const noexcept { return active() && !travels(); }
  const Settings& settings() const noexcept { return settings_; }
  /// Of the present leg [u/s].
  double velocity() const noexcept {
    return phase_ == Phase::search ? settings_.referencing_velocity : settings_.approach_velocity;
  }

  /// Each interpolator tick until the mark is found. @param mark what is looked for  @param direction in
  /// which the axis moves  @param at_limit_switch whether it has met a hardware limit switch at which it may
  /// reverse
  Leg guide(HomingMark mark, int direction, bool at_limit_switch) noexcept;

  // ---- The mark

  /// @param direction 1, -1: in which it has to be passed; 0: any  @param inverse whether the machine lies
  /// the other way round than the axis counts
  void search(HomingMark mark, int direction, bool positive_side, bool inverse) noexcept;
  void end_search() noexcept { search_.end(); }
  bool searching() const noexcept { return search_.active(); }
  bool found() const noexcept { return search_.found(); }
  /// Where it has been found [u] on the scale of the machine.
  double mark_position() const noexcept { return search_.place(); }
  /// Each servo cycle while it searches. @param position of the machine [u]
  void pass(double position, bool on_switch, const std::optional<ZeroMarks>& zero_marks) noexcept {
    on_switch_ = on_switch;
    search_.step(position, on_switch, zero_marks);
  }

 private:
  Leg reverse(HomingMark mark, int direction) noexcept;

  Phase phase_ = Phase::none;
  bool reversed_ = false;  // at a hardware limit switch
  bool on_switch_ = false;
  Settings settings_;
  MarkSearch search_;
};

}  // namespace lockstep
