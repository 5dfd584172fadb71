#include "tech_objects/axis/homing_course.hpp"

#include "tech_objects/sensing/homing_marks.hpp"

namespace lockstep {

void HomingCourse::end() noexcept {
  search_.end();
  begin({}, Phase::none);
}

void HomingCourse::search(HomingMark mark, int direction, bool positive_side, bool inverse) noexcept {
  begin_search(search_, mark, direction, positive_side, inverse);
  on_switch_ = false;
}

HomingCourse::Leg HomingCourse::guide(HomingMark mark, int direction, bool at_limit_switch) noexcept {
  if (at_limit_switch) return reverse(mark, direction);
  const int homing = settings_.direction;
  const Leg towards_mark{Leg::Kind::begins, Phase::search, homing, 0};
  switch (phase_) {
    case Phase::approach: {
      if (!on_switch_) return {};
      // An edge that is met from outside, in the homing direction, is left behind first.
      const bool met_from_outside =
          mark == HomingMark::switch_edge && (settings_.positive_side ? 1 : -1) != homing;
      if (met_from_outside) return {Leg::Kind::begins, Phase::clear, -homing, 0};
      return towards_mark;
    }
    case Phase::clear:
      return on_switch_ ? Leg{} : towards_mark;
    case Phase::back:
      return search_.found() ? Leg{Leg::Kind::begins, Phase::search, homing, homing} : Leg{};
    default:
      return {};
  }
}

/// Once: on the way to the switch the other way is tried; a zero mark is looked for beyond, to be met in the
/// homing direction.
HomingCourse::Leg HomingCourse::reverse(HomingMark mark, int direction) noexcept {
  const bool approaches = phase_ == Phase::approach;
  const bool can_turn = approaches || (phase_ == Phase::search && mark == HomingMark::zero_mark);
  if (reversed_ || !can_turn) return {Leg::Kind::gives_up, phase_, 0, 0};
  reversed_ = true;
  if (approaches) return {Leg::Kind::begins, Phase::approach, -direction, 0};
  return {Leg::Kind::begins, Phase::back, -settings_.direction, -settings_.direction};
}

}  // namespace lockstep
