#include "tech_objects/sensing/probe_signal.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// Number of the last border at or before a place; borders lie at `first` + n · period. The same place always
/// gives the same number, so that no border is seen twice or not at all between two cycles.
double border_before(DoubleDouble place, DoubleDouble first, double period) noexcept {
  const DoubleDouble periods = (place - first) / period;
  double number = std::floor(periods.hi);
  if (number == periods.hi && periods.lo < 0.0) number -= 1.0;
  return number;
}

}  // namespace

void ProbeSignal::sample(bool level, Edges& edges) noexcept {
  if (level == level_) return;
  level_ = level;
  (level ? edges.rising : edges.falling) += 1;
  edges.add({level, 1.0});
}

bool ProbeSignal::on_mark(const PrintMarks& marks, DoubleDouble place) noexcept {
  const double begun = border_before(place, to_double_double(marks.offset), marks.period);
  const double ended = border_before(place, two_sum(marks.offset, marks.width), marks.period);
  return begun > ended;
}

/// Borders are numbered together: mark n begins at 2n and ends at 2n + 1.
void ProbeSignal::move(const PrintMarks& marks, DoubleDouble from, DoubleDouble to, Edges& edges) noexcept {
  const DoubleDouble first[2] = {to_double_double(marks.offset), two_sum(marks.offset, marks.width)};
  const DoubleDouble distance = to - from;
  const bool forwards = distance.hi > 0.0;
  const auto borders_before = [&](DoubleDouble place) {
    const double begun = border_before(place, first[0], marks.period);
    const double ended = border_before(place, first[1], marks.period);
    return begun + ended + 1.0;  // number of the last border, counted together
  };
  const double before = borders_before(from);
  const double now = borders_before(to);
  const double all = std::abs(now - before);
  const double told = std::min(all, static_cast<double>(Edges::kMaximum));
  for (double i = 0.0; i < told; i += 1.0) {
    const double border = forwards ? before + 1.0 + i : before - i;
    const bool end = border - 2.0 * std::floor(0.5 * border) != 0.0;
    const DoubleDouble place = first[end ? 1 : 0] + two_product(std::floor(0.5 * border), marks.period);
    const double part = ((place - from) / distance.hi).rounded();
    edges.add({end != forwards, std::clamp(part, 0.0, 1.0)});
  }
  // Edges alternate; the first one is opposite to the level before.
  const bool first_rises = told > 0.0 && edges.list[0].rising;
  const auto half = static_cast<std::int64_t>(all) / 2;
  const auto odd = static_cast<std::int64_t>(all) % 2;
  edges.rising += half + (first_rises ? odd : 0);
  edges.falling += half + (first_rises ? 0 : odd);
  level_ = on_mark(marks, to);
}

}  // namespace lockstep
