/// Lags of signals in the ticks of one period.
#pragma once

namespace lockstep {

/// A first-order lag in the ticks of one period, exact for an input that runs straight from tick to tick: so
/// behind a ramp it is late by its time constant, not by about that. It keeps by how much its output is
/// behind its input, never the values themselves: nothing is lost where they are large. Thread: the cycle.
class FirstOrderLag {
 public:
  /// @param time_constant [s] ≥ 0; 0: none  @param period [s] > 0
  void tune(double time_constant, double period) noexcept;
  double time_constant() const noexcept { return time_constant_; }

  /// One tick in which the input has changed by `change`. Returns by how much the output has changed.
  double step(double change) noexcept {
    const double before = behind_;
    behind_ += gain_ * change - decay_ * before;
    if (change == 0.0 && behind_ < kNothing && behind_ > -kNothing) behind_ = 0.0;
    return change - (behind_ - before);
  }

  /// By how much the output is behind the input.
  double behind() const noexcept { return behind_; }
  void set_behind(double behind) noexcept { behind_ = behind; }

 private:
  /// What is left of an input that stands and is less than this is nothing: a lag that only ever halves what
  /// is left would never come to rest.
  static constexpr double kNothing = 1e-18;

  double behind_ = 0.0;
  double decay_ = 1.0;  // 1 - exp(-period / time constant)
  double gain_ = 0.0;   // time constant / period · decay
  double time_constant_ = 0.0;
};

/// PT2 filter: two first-order lags in series. Behind a ramp it is late by T1 + T2 exactly.
class Pt2Filter {
 public:
  FirstOrderLag first;
  FirstOrderLag second;

  void step(double change) noexcept { second.step(first.step(change)); }
  double behind() const noexcept { return first.behind() + second.behind(); }
};

}  // namespace lockstep
