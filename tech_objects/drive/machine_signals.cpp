#include "tech_objects/drive/machine_signals.hpp"

#include <cmath>

namespace lockstep {

bool PositionRange::contains(double position, double turn) const noexcept {
  double beyond = position - from;
  if (turn > 0.0) beyond -= std::floor(beyond / turn) * turn;
  return beyond >= 0.0 && beyond <= to - from;
}

std::optional<double> ZeroMarks::between(double from, double to) const noexcept {
  if (from == to) return std::nullopt;
  const bool forward = to > from;
  double mark = position;
  if (period > 0.0) {
    const double passed = (from - position) / period;
    // The quotient is rounded: the next mark is this one, or one of the following two.
    double count = forward ? std::floor(passed) : std::ceil(passed);
    mark = position + count * period;
    for (int i = 0; i < 2 && (forward ? mark <= from : mark >= from); ++i) {
      count += forward ? 1.0 : -1.0;
      mark = position + count * period;
    }
  }
  const bool met = forward ? mark > from && mark <= to : mark < from && mark >= to;
  return met ? std::optional(mark) : std::nullopt;
}

void MarkSearch::begin(HomingMark mark, int direction, int side) noexcept {
  *this = MarkSearch{};
  mark_ = mark;
  direction_ = direction;
  side_ = side;
  active_ = true;
}

void MarkSearch::step(double position, bool on_switch, const std::optional<ZeroMarks>& zero_marks) noexcept {
  if (found_) return;
  const double from = begun_ ? last_position_ : position;
  const bool was_on_switch = begun_ ? last_on_switch_ : on_switch;
  begun_ = true;
  last_position_ = position;
  last_on_switch_ = on_switch;
  if (position != from) heading_ = position > from ? 1 : -1;
  const bool edge = on_switch != was_on_switch;

  if (mark_ == HomingMark::switch_edge) {
    const int side = on_switch == (heading_ > 0) ? -1 : 1;
    if (edge && heading_ != 0 && side == side_ && fits(heading_)) find(position);
    return;
  }
  const bool may_be_here = mark_ == HomingMark::zero_mark || left_cam_ == heading_;
  if (mark_ == HomingMark::zero_mark_after_cam) watch_cam(on_switch);
  if (mark_ == HomingMark::zero_mark_after_cam && edge && !on_switch && fits(heading_)) left_cam_ = heading_;
  if (!may_be_here || heading_ == 0 || !fits(heading_) || !zero_marks) return;
  if (const auto place = zero_marks->between(from, position)) find(*place);
}

/// On the cam, or after turning back, the cam has to be left anew.
void MarkSearch::watch_cam(bool on_cam) noexcept {
  if (on_cam || left_cam_ != heading_) left_cam_ = 0;
}

}  // namespace lockstep
