/// What every simulated drive has beside its motion: states and words, what goes wrong with it, what it told.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/drive/drive.hpp"
#include "tech_objects/drive/encoder_source.hpp"
#include "tech_objects/drive/profidrive.hpp"
#include "tech_objects/types/bool_tag.hpp"

namespace lockstep {

/// A part of a drive, which moves on its own. What every cycle touches comes first, so that a drive puts it
/// behind its own such members. The cycle's thread.
class SimulatedControlUnit {
 public:
  /// Off, without fault. @param servo_cycle [s]
  void configure(const DriveSettings& settings, double servo_cycle) noexcept;

  const DriveStates& states() const noexcept { return states_; }
  /// Something may go wrong: `watch_causes` is called in every servo cycle.
  bool has_faults() const noexcept { return has_faults_; }
  bool blocked() const noexcept { return blocked_; }
  /// Words reach the drive.
  bool hears() const noexcept { return !is_on(faults_.communication); }

  /// Words that the drive has heard. @return whether a stop of the drive's own begins
  bool control(std::uint16_t stw1, std::uint16_t stw2) noexcept {
    stw1_ = stw1;
    stw2_ = stw2;
    const DriveStates::State before = states_.state();
    states_.control(stw1);
    const bool begins = states_.stopping() && states_.state() != before;
    if (begins) stopping_cycles_ = 0;
    return begins;
  }
  /// What has gone wrong. @return whether a stop of the drive's own begins
  bool watch_causes() noexcept;
  /// A servo cycle of a stop of the drive's own, which ends at rest; or, if something keeps the machine
  /// going, after a while. @param velocity of the machine  @param setpoint that the stop has come down to
  /// [u/s]
  void watch_stop(double velocity, double setpoint) noexcept;

  /// What the drive tells. @param read_encoder puts position and velocity into it, of an encoder that tells
  template <class ReadEncoder>
  DriveActual tell(double torque, ReadEncoder read_encoder) noexcept {
    // One object for all paths: it is made where the caller has it, and not copied.
    DriveActual now;
    if (has_faults_ && !hears()) {
      told_.silent = told_.trouble = true;
      now = told_;
      return now;
    }
    now.enabled = states_.operation();
    now.torque = torque;
    now.fault = states_.fault();
    now.inhibited = states_.state() == DriveStates::State::inhibited;
    if (has_faults_ && is_on(faults_.encoder)) {
      now.position = told_.position;
      now.encoder_failed = true;
    } else {
      read_encoder(now);
    }
    now.trouble = now.fault || now.encoder_failed;
    if (has_faults_) told_ = now;
    return now;
  }
  /// An encoder beside that of the drive. @param position of the machine since its start
  SensorActual read_sensor(std::size_t sensor, const DoubleDouble& position) const noexcept {
    const SimulatedSensor& model = sensors_[sensor - 1];
    if (is_on(model.fault)) return {};
    const DoubleDouble told = position * model.ratio;
    return {model.resolution > 0.0 ? quantised(told, model.resolution) : told, false};
  }

  DriveWords words() const noexcept { return {stw1_, stw2_, states_.zsw1()}; }
  bool in_trouble() const noexcept {
    return states_.fault() || is_on(faults_.drive) || is_on(faults_.encoder) || !hears();
  }
  const MachineSignals& signals() const noexcept { return signals_; }

 private:
  DriveStates states_;
  bool has_faults_ = false;
  bool blocked_ = false;

  // Seldom of account.
  std::uint16_t stw1_ = kControlOff;
  std::uint16_t stw2_ = 0;
  int stopping_cycles_ = 0;     // of a stop of the drive's own
  double stop_velocity_ = 0.0;  // at its begin [u/s]
  double maximum_stop_cycles_ = 0.0;
  SimulatedFaults faults_;
  DriveActual told_;  // last, for a drive that falls silent
  MachineSignals signals_;
  std::array<SimulatedSensor, 3> sensors_{};
};

}  // namespace lockstep
