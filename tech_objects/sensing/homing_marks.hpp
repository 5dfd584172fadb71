/// The homing marks of an encoder as its settings tell them: which there are, and where they are looked for.
/// What axes and external encoders have in common.
/// @source S7-1500/S7-1500T axis functions, homing; S7-1500T synchronous operation V7, 13.1.12
#pragma once

#include "tech_objects/alarms/detail.hpp"
#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/drive/machine_signals.hpp"

namespace lockstep {

/// A homing switch as it is configured: a BOOL tag that is active at one of its levels; without a tag the
/// reference cam of the simulated machine.
struct HomeSwitch {
  const bool* address = nullptr;
  bool level = false;

  /// Whether there is one.
  bool exists(const MachineSignals& machine) const noexcept {
    return address != nullptr || machine.reference_cam.has_value();
  }
  /// @param place of the machine [u]  @param turn [u] after which it is where it was; 0: never
  bool active(const MachineSignals& machine, double place, double turn) const noexcept;
};

/// What the machine lacks of that which a kind of mark needs; none: it has everything.
AlarmCause missing_mark(HomingMark mark, const HomeSwitch& home_switch,
                        const MachineSignals& machine) noexcept;

/// Begins to look for a mark that a motion passes.
/// @param direction 1, -1: in which it has to be passed, as the object counts; 0: any
/// @param positive_side of a switch  @param inverse whether the machine lies the other way round
void begin_search(MarkSearch& search, HomingMark mark, int direction, bool positive_side,
                  bool inverse) noexcept;

/// Direction of PassiveHoming.Direction: 1, -1, or 0 for any.
int passive_direction(int setting) noexcept;

/// The turn that counts as 0 once a place has got its position on a ring: homed in the first half of the ring
/// the turns begin there, else with the next one.
std::int64_t first_turn(const AxisPosition& homed, const Modulo& modulo) noexcept;

}  // namespace lockstep
