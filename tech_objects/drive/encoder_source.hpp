/// What an external encoder measures: a simulated encoder.
#pragma once

#include <cstdint>

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/drive/machine_signals.hpp"
#include "tech_objects/objects/load_position.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A simulated encoder. It sits on the load of an axis, or takes its position from a signal.
struct SimulatedEncoderSettings {
  const LeadingObject* follows = nullptr;  ///< the axis on whose load it sits; nullptr: the signal counts
  double ratio = 1.0;                      ///< [u] of the encoder per [u] of that axis, not 0
  Signal signal;                           ///< a number: the position [u]
  const bool* valid = nullptr;             ///< whether the signal is heard of; nullptr: always
  double wrap = 0.0;                       ///< [u] > 0: length at which the signal wraps; 0: it does not
  double resolution = 0.0;                 ///< [u] ≥ 0, increment that it reports; 0: the position itself
  double noise = 0.0;                      ///< [u] ≥ 0, largest deviation of a reading to either side
  MachineSignals signals{};  ///< homing marks, at positions of the encoder as it lies, from where it began
};

/// The multiple of an increment [u] > 0 that is nearest to a position [u].
DoubleDouble quantised(DoubleDouble position, double increment) noexcept;

/// What the encoder shows in one servo cycle.
struct EncoderReading {
  DoubleDouble position;       ///< [u] on a line; never wraps
  DoubleDouble true_position;  ///< [u] without noise and increments
  bool valid = false;          ///< false: the signal is not heard of, or is none that a position can have
  bool awaited = false;        ///< not valid since nothing has been heard of the signal so far
};

/// Deterministic: the noise comes from a generator of integers that begins with the same seed in every run.
/// Thread: the cycle.
class SimulatedEncoder {
 public:
  /// While loading. @param servo_period [s] > 0  @param ratio servo ticks per interpolator tick  @param seed
  /// of the noise
  void configure(const SimulatedEncoderSettings& settings, double servo_period, int ratio,
                 std::uint64_t seed) noexcept;

  /// Once in each servo tick, behind the axis on which it sits.
  EncoderReading read() noexcept;
  void interpolated() noexcept { load_.interpolated(); }
  /// Whether it goes on by itself, whatever this controller does.
  bool foreign() const noexcept { return settings_.follows == nullptr; }

 private:
  bool follow_signal() noexcept;
  bool heard_of() const noexcept { return settings_.valid == nullptr || *settings_.valid; }
  double noise() noexcept;

  SimulatedEncoderSettings settings_;
  LoadPosition load_;
  bool begun_ = false;
  double last_signal_ = 0.0;  // [u]
  DoubleDouble position_;     // without noise and increments [u]
  std::uint64_t state_ = 0;   // of the generator
};

}  // namespace lockstep
