/// Plays a curve: at a rate, with an amplitude and an offset, each of which may change at any time.
/// @source LinMot release 1.3 addendum, 6.4 (Set Value Configuration), 8.5 (DC, DO, DS)
#pragma once

#include <cmath>
#include <cstdint>

#include "tech_objects/drive/current_loop.hpp"
#include "tech_objects/linmot/curve.hpp"

namespace lockstep::linmot {

/// x(t) = offset + amplitude · c(s), ds/dt = rate. The next run of a cyclic curve begins at the exact end of
/// the last one. The cycle's thread.
class CurvePlayer {
 public:
  /// @param cycle [s] > 0
  void configure(double cycle) noexcept { cycle_ = cycle; }

  /// Begins at once. @param curve that exists and stays
  void start(const Curve& curve, bool cyclic, double rate) noexcept {
    curve_ = &curve;
    cyclic_ = cyclic;
    done_ = false;
    rate_ = wanted_ = rate;
    slope_ = base_ = 0.0;
    cycles_ = runs_ = 0;
  }
  void stop() noexcept { curve_ = nullptr; }
  /// A cyclic one runs to its end and no further.
  void end_cycle() noexcept { cyclic_ = false; }

  bool running() const noexcept { return curve_ != nullptr && !done_; }
  /// It has given a setpoint, and is behind its start.
  bool begun() const noexcept { return cycles_ != 0 || base_ != 0.0 || runs_ != 0; }
  bool cyclic() const noexcept { return cyclic_; }
  const Curve* curve() const noexcept { return curve_; }
  /// The runs of a cyclic curve that are over.
  std::int64_t runs() const noexcept { return runs_; }
  /// [s] on the curve.
  double time() const noexcept {
    const double since = base_ + rate_ * (static_cast<double>(cycles_) * cycle_);
    return curve_ == nullptr ? 0.0 : since - static_cast<double>(runs_) * curve_->duration();
  }

  /// @param rate 0 … 1; at once, unless it is on its way to another
  void set_rate(double rate) noexcept {
    if (slope_ == 0.0 && rate != rate_) {
      rebase();
      rate_ = rate;
    }
    wanted_ = rate;
  }
  /// Comes evenly to another rate within a time [s]; 0: at once.
  void ramp_to(double rate, double duration) noexcept {
    rebase();
    wanted_ = rate;
    slope_ = duration > 0.0 ? (rate - rate_) / duration : 0.0;
    if (slope_ == 0.0) rate_ = rate;
  }

  /// The setpoint of a control cycle, which is then over.
  LoopSetpoint step(double offset, double amplitude) noexcept {
    double s = time();
    const double duration = curve_->duration();
    if (s >= duration - kRounding) {
      if (!cyclic_) {
        done_ = true;
        return {offset + amplitude * curve_->end(), 0.0, 0.0};
      }
      ++runs_;
      s = s > duration ? s - duration : 0.0;
    }
    const CamValue at = curve_->function().value(s, hint_);
    const LoopSetpoint setpoint{
        offset + amplitude * at.position, amplitude * at.first_derivative * rate_,
        amplitude * (at.second_derivative * rate_ * rate_ + at.first_derivative * slope_)};
    ++cycles_;
    if (slope_ != 0.0) change_rate();
    return setpoint;
  }

 private:
  static constexpr double kRounding = 1e-12;  // [s]

  void rebase() noexcept {
    base_ = time();
    cycles_ = runs_ = 0;
  }
  /// The cycle that is over was one of the ramp.
  void change_rate() noexcept {
    const double next = rate_ + slope_ * cycle_;
    const bool there = slope_ > 0.0 ? next >= wanted_ : next <= wanted_;
    const double after = there ? wanted_ : next;
    --cycles_;
    rebase();
    base_ += 0.5 * (rate_ + after) * cycle_;
    rate_ = after;
    if (there) slope_ = 0.0;
  }

  const Curve* curve_ = nullptr;
  CamHint hint_;
  double cycle_ = 1e-4;
  double base_ = 0.0;  // [s] where the present rate began
  double rate_ = 1.0, wanted_ = 1.0;
  double slope_ = 0.0;  // of the rate [1/s]
  std::int64_t cycles_ = 0, runs_ = 0;
  bool cyclic_ = false, done_ = false;
};

}  // namespace lockstep::linmot
