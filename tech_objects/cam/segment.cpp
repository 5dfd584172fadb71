#include "tech_objects/cam/segment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/cam/sine.hpp"

namespace lockstep {
namespace {

constexpr DoubleDouble kTwoPi{6.283185307179586, 2.4492935982947064e-16};
constexpr double kQuarterTurn = 1.5707963267948966;

/// angle less whole turns, in -π … π or a rounding beyond. Each pass takes off 53 bits of the turns.
DoubleDouble within_one_turn(DoubleDouble angle) noexcept {
  for (int pass = 0; pass < 3; ++pass) angle = angle - kTwoPi * std::floor(angle.hi / kTwoPi.hi + 0.5);
  return angle;
}

/// Where a function that changes its sign between low and high is zero.
template <class Function>
double bisect(const Function& f, double low, double high) noexcept {
  const bool rising = f(low) < 0.0;
  for (int step = 0; step < 80; ++step) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) break;
    ((f(middle) < 0.0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Zeros of the first derivative in a section in which the seventh does not change its sign: the zeros of
/// each derivative part the section into stretches in which the next lower one is monotone.
int turns_in_section(const CamSegment& segment, double low, double high, double (&zeros)[8]) noexcept {
  int count = 0;
  for (int order = 6; order >= 1; --order) {
    const auto f = [&](double distance) { return segment.derivative(order, distance); };
    double found[8];
    int found_count = 0;
    double from = low;
    double value_from = f(from);
    for (int k = 0; k <= count; ++k) {
      const double to = k < count ? zeros[k] : high;
      const double value_to = f(to);
      const bool sign_changes = (value_from < 0.0 && value_to > 0.0) || (value_from > 0.0 && value_to < 0.0);
      if (sign_changes && found_count < 7) found[found_count++] = bisect(f, from, to);
      // A zero hit exactly parts the section too.
      if (value_to == 0.0 && k < count && found_count < 7) found[found_count++] = to;
      from = to;
      value_from = value_to;
    }
    count = found_count;
    std::copy_n(found, count, zeros);
  }
  return count;
}

}  // namespace

CamValue CamSegment::value(double distance) const noexcept {
  double position = coefficient[6];
  double first = 0.0;
  double half_second = 0.0;
  for (int k = 5; k >= 0; --k) {
    half_second = half_second * distance + first;
    first = first * distance + position;
    position = position * distance + coefficient[k];
  }
  double second = 2.0 * half_second;
  if (frequency != 0.0) {
    const SineCosine wave = sine_cosine(phase + frequency * distance);
    const double slope = amplitude * frequency;
    position += amplitude * wave.sine;
    first += slope * wave.cosine;
    second -= slope * frequency * wave.sine;
  }
  return {position, first, second};
}

double CamSegment::derivative(int order, double distance) const noexcept {
  double sum = 0.0;
  for (int k = 6; k >= order; --k) {
    double factor = 1.0;
    for (int j = k; j > k - order; --j) factor *= j;
    sum = sum * distance + coefficient[k] * factor;
  }
  if (frequency == 0.0) return sum;
  const SineCosine wave = sine_cosine(phase + frequency * distance);
  double scale = amplitude;
  for (int j = 0; j < order; ++j) scale *= frequency;
  const double waves[] = {wave.sine, wave.cosine, -wave.sine, -wave.cosine};
  return sum + scale * waves[order & 3];
}

CamSegment shifted(const CamSegment& segment, double origin) noexcept {
  DoubleDouble c[7];
  for (int k = 0; k < 7; ++k) c[k] = to_double_double(segment.coefficient[k]);
  const DoubleDouble by = to_double_double(origin) - to_double_double(segment.origin);
  for (int k = 0; k < 6 && by.hi != 0.0; ++k)  // Horner's scheme once per derivative
    for (int j = 5; j >= k; --j) c[j] = c[j] + c[j + 1] * by;
  CamSegment result;
  result.origin = origin;
  for (int k = 0; k < 7; ++k) result.coefficient[k] = c[k].rounded();
  if (segment.amplitude == 0.0) return result;
  const DoubleDouble phase = within_one_turn(by * segment.frequency + to_double_double(segment.phase));
  result.amplitude = segment.amplitude;
  result.frequency = segment.frequency;
  result.phase = phase.rounded();
  // A sine that does not swing is a constant.
  if (result.frequency == 0.0) result.coefficient[0] += result.amplitude * sine_cosine(result.phase).sine;
  return result;
}

int turning_points(const CamSegment& segment, double length, std::span<double> turns) noexcept {
  const double rate = std::abs(segment.frequency);
  const double direction = segment.frequency < 0.0 ? -1.0 : 1.0;
  std::size_t count = 0;
  double low = 0.0;
  // Sections end where the phase passes a multiple of a quarter turn: there the seventh derivative is zero.
  double quarter = std::floor(direction * segment.phase / kQuarterTurn) + 1.0;
  while (low < length) {
    double high = length;
    if (rate != 0.0) high = std::min(length, (quarter * kQuarterTurn - direction * segment.phase) / rate);
    quarter += 1.0;
    if (!(high > low)) continue;
    double zeros[8];
    const int found = turns_in_section(segment, low, high, zeros);
    for (int k = 0; k < found && count < turns.size(); ++k)
      if (zeros[k] > 0.0 && zeros[k] < length && (count == 0 || zeros[k] > turns[count - 1]))
        turns[count++] = zeros[k];
    // An extremum may lie where two sections meet.
    if (high < length && segment.derivative(1, high) == 0.0 && count < turns.size()) turns[count++] = high;
    low = high;
  }
  return static_cast<int>(count);
}

}  // namespace lockstep
