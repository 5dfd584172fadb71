#include "tech_objects/cam_design/motion_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tech_objects/cam/sine.hpp"
#include "tech_objects/cam_design/motion_law_polynomial.hpp"

namespace lockstep {
namespace {

constexpr int kSamples = 128;  // per piece, to find the neighbourhood of a peak

/// Maximum value of f over 0 … length: sampled, then narrowed by the golden section.
template <class Function>
double maximum(const Function& f, double length) noexcept {
  int best = 0;
  double best_value = f(0.0);
  for (int k = 1; k <= kSamples; ++k)
    if (const double value = f(length * k / kSamples); value > best_value) {
      best = k;
      best_value = value;
    }
  double low = length * std::max(best - 1, 0) / kSamples;
  double high = length * std::min(best + 1, kSamples) / kSamples;
  for (int step = 0; step < 60; ++step) {
    const double left = high - 0.6180339887498949 * (high - low);
    const double right = low + 0.6180339887498949 * (high - low);
    const double left_value = f(left);
    const double right_value = f(right);
    best_value = std::max({best_value, left_value, right_value});
    (left_value < right_value ? low : high) = left_value < right_value ? left : right;
  }
  return best_value;
}

bool has_no_acceleration(MotionTask task) noexcept {
  return task == MotionTask::rest || task == MotionTask::constant_velocity;
}

}  // namespace

MotionValue MotionPiece::value(double distance) const noexcept {
  MotionValue result;
  result.position = polynomial_derivative(coefficient, 0, distance);
  result.velocity = polynomial_derivative(coefficient, 1, distance);
  result.acceleration = polynomial_derivative(coefficient, 2, distance);
  result.jerk = polynomial_derivative(coefficient, 3, distance);
  for (const Sine& s : sine) {
    if (s.amplitude == 0.0) continue;
    const SineCosine wave = sine_cosine(s.frequency * distance + s.phase);
    const double w = s.frequency;
    result.position += s.amplitude * wave.sine;
    result.velocity += s.amplitude * w * wave.cosine;
    result.acceleration -= s.amplitude * w * w * wave.sine;
    result.jerk -= s.amplitude * w * w * w * wave.cosine;
  }
  return result;
}

MotionValue MotionLaw::value(double leading_value) const noexcept {
  if (count_ == 0) return {};
  std::size_t i = 0;
  while (i + 1 < count_ && leading_value >= pieces_[i + 1].start) ++i;
  const double distance = leading_value - pieces_[i].start;
  return pieces_[i].value(distance > 0.0 ? std::min(distance, pieces_[i].length) : 0.0);
}

MotionPeaks MotionLaw::peaks() const noexcept {
  MotionPeaks peaks;
  const double direction = stroke_ < 0.0 ? -1.0 : 1.0;
  const auto raise = [](double& peak, double value) { peak = std::max(peak, value); };
  for (const MotionPiece& p : pieces()) {
    raise(peaks.velocity, maximum([&](double d) { return std::abs(p.value(d).velocity); }, p.length));
    raise(peaks.acceleration,
          maximum([&](double d) { return direction * p.value(d).acceleration; }, p.length));
    raise(peaks.deceleration,
          maximum([&](double d) { return -direction * p.value(d).acceleration; }, p.length));
    raise(peaks.jerk, maximum([&](double d) { return std::abs(p.value(d).jerk); }, p.length));
    raise(peaks.torque, maximum(
                            [&](double d) {
                              const MotionValue value = p.value(d);
                              return std::abs(value.velocity * value.acceleration);
                            },
                            p.length));
  }
  // A step of the acceleration, beyond rounding, is an infinite jerk.
  const double acceleration_scale = 1.0e-9 * std::max(peaks.acceleration, peaks.deceleration);
  bool steps = false;
  for (std::size_t i = 0; i + 1 < count_; ++i)
    steps |= std::abs(pieces_[i].value(pieces_[i].length).acceleration -
                      pieces_[i + 1].value(0.0).acceleration) > acceleration_scale;
  if (count_ > 0) {
    const MotionPiece& last = pieces_[count_ - 1];
    steps |=
        has_no_acceleration(tasks_[0]) && std::abs(pieces_[0].value(0.0).acceleration) > acceleration_scale;
    steps |=
        has_no_acceleration(tasks_[1]) && std::abs(last.value(last.length).acceleration) > acceleration_scale;
  }
  if (steps) peaks.jerk = std::numeric_limits<double>::infinity();
  return peaks;
}

MotionPeaks MotionLaw::normalised_peaks() const noexcept {
  MotionPeaks peaks = this->peaks();
  if (stroke_ == 0.0) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan, nan, nan};
  }
  const double velocity = std::abs(stroke_) / length_;
  const double acceleration = velocity / length_;
  peaks.velocity /= velocity;
  peaks.acceleration /= acceleration;
  peaks.deceleration /= acceleration;
  peaks.jerk /= acceleration / length_;
  peaks.torque /= velocity * acceleration;
  return peaks;
}

bool MotionLaw::becomes_points() const noexcept {
  return std::ranges::any_of(pieces(), [](const MotionPiece& p) { return p.sine[1].amplitude != 0.0; });
}

void MotionLaw::points(std::span<TO_Cam_Struct_PointData> points) const noexcept {
  const auto last = static_cast<double>(points.size() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = i + 1 < points.size() ? start() + length_ * (static_cast<double>(i) / last) : end_;
    points[i] = {x, value(x).position};
  }
}

}  // namespace lockstep
