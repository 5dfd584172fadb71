#include "tech_objects/sensing/homing_marks.hpp"

namespace lockstep {

bool HomeSwitch::active(const MachineSignals& machine, double place, double turn) const noexcept {
  if (address != nullptr) return *address == level;
  return machine.reference_cam && machine.reference_cam->contains(place, turn);
}

AlarmCause missing_mark(HomingMark mark, const HomeSwitch& home_switch,
                        const MachineSignals& machine) noexcept {
  if (mark != HomingMark::switch_edge && !machine.zero_marks) return AlarmCause::no_zero_mark;
  const bool found = mark == HomingMark::zero_mark || home_switch.exists(machine);
  return found ? AlarmCause::none : AlarmCause::no_reference_switch;
}

void begin_search(MarkSearch& search, HomingMark mark, int direction, bool positive_side,
                  bool inverse) noexcept {
  const int sign = inverse ? -1 : 1;
  search.begin(mark, sign * direction, positive_side ? sign : -sign);
}

int passive_direction(int setting) noexcept {
  constexpr int kAny = 2;
  if (setting == kAny) return 0;
  return setting == 0 ? 1 : -1;
}

std::int64_t first_turn(const AxisPosition& homed, const Modulo& modulo) noexcept {
  return homed.value <= modulo.start + 0.5 * modulo.length ? homed.turns : homed.turns + 1;
}

}  // namespace lockstep
