/// What may lead a following axis, and what the following axis sees of it.
/// @source S7-1500T synchronous operation V7, 5.2
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/filters/extrapolation.hpp"
#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/objects/provided_value.hpp"
#include "tech_objects/objects/technology_object.hpp"
#include "tech_objects/synchronous/leading_source.hpp"

namespace lockstep {

/// What MC_Power wants of an object; written by the one instance that has claimed it.
struct PowerRequest {
  const void* owner = nullptr;  ///< the instance of MC_Power in charge; nullptr: none yet
  BOOL enable{};
  StartMode start_mode = StartMode::position_control;
  PowerStopMode stop_mode{};
};

/// A technology object with a position that following axes follow. It is stepped before them. The functions
/// below run in the thread of the cycle.
class LeadingObject : public TechnologyObject, public LeadingSource {
 protected:
  // Behind the end of LeadingSource, to the probe: what every interpolator cycle touches, with that in two
  // lines of the cache.
  bool enable_removed_ = false;
  bool leads_by_actual_value_ = false;
  bool provides_ = false;
  bool leads_specially_ = false;  // one of these two
  const bool has_position_ = kind != ObjectKind::TO_SpeedAxis;

 public:
  /// Raised by a restart, after which positions may be on another ring; the cycle tells those that follow.
  bool restarted = false;
  /// Raised when those that follow have to look at it: it has been restarted, or has failed.
  bool lost = false;
  PowerRequest power;
  /// The measuring input that measures by the telegram of the encoder at present; nullptr: none.
  const void* telegram_probe = nullptr;

  using TechnologyObject::TechnologyObject;

  bool enabled() const noexcept { return power_state_ == PowerState::on; }
  bool off() const noexcept { return power_state_ == PowerState::off; }
  /// Whether an alarm has removed the enable, until it is acknowledged.
  bool enable_removed() const noexcept { return enable_removed_; }

  /// The actual position, as it is called now.
  virtual AxisPosition actual_position() const noexcept = 0;
  /// Whether a drive or a sensor is read in each MC_Servo; else the actual position is the setpoint.
  virtual bool measured_in_servo() const noexcept = 0;
  /// Where it is read: what has been moved, on a line from where it was called 0 at the start [u]. Neither
  /// homing nor a restart changes it.
  virtual DoubleDouble measured_line() const noexcept = 0;
  /// False once a sensor has failed, until that is acknowledged.
  virtual bool actual_values_valid() const noexcept { return true; }
  /// Whether a homing waits for its mark, so that the zero mark or probe of the encoder's telegram is taken.
  virtual bool homing() const noexcept { return false; }
  /// Jobs of MC_Home so far that end what measures here: those that look for a mark, and mode 9.
  /// @source S7-1500T synchronous operation V7, 12.3.3
  std::uint32_t homings() const noexcept { return homings_; }
  /// Restarts since the start.
  std::uint32_t restarts() const noexcept { return restarts_; }

  /// Whether it stands, so that a coupling may be taken over to its simulation.
  virtual bool leading_value_stands() const noexcept = 0;

  /// Positions have other names from now on, each by this more [u].
  void shift_leading(double by) noexcept;

  /// Load time: somebody follows the actual value, which has to be extrapolated from then on.
  void lead_by_actual_value() noexcept { leads_by_actual_value_ = leads_specially_ = true; }
  /// Load time: other controllers, or axes behind a delay, follow what it provides from then on.
  void provide_leading_value();
  bool provides() const noexcept { return provides_; }
  /// Time of the interpolator tick [ns]; told, before it is stepped, to an object that provides.
  std::int64_t tick_time = 0;
  /// What other controllers are told in this tick; of an object that provides, after its step.
  LeadingValueTelegram telegram() const noexcept;

 protected:
  /// Takes the start values over; positions have to be configured.
  void configure_leading(double period, TO_Struct_Extrapolation& settings) noexcept;
  void reset_leading(AxisPosition actual) noexcept;
  /// One interpolator tick of the actual value.
  void extrapolate(AxisPosition actual, double velocity, const TO_Struct_Extrapolation& settings) noexcept;
  /// Of a job of MC_Home that has been accepted: counts it if the override rules have it end what measures.
  void count_homing(const Job& job) noexcept;
  void publish_extrapolation(TO_Struct_Extrapolation& settings,
                             TO_Struct_StatusExtrapolation& status) const noexcept;
  bool leads_by_actual_value() const noexcept { return leads_by_actual_value_; }
  /// Load time: it provides if one of its interfaces is enabled.
  void provide_if_asked(const TO_Struct_CrossPlcSynchronousOperation& settings);
  /// Of an object that provides: takes its delay over; positions have to be configured.
  void configure_provided(double period, const TO_Struct_CrossPlcSynchronousOperation& settings) noexcept;
  /// Provides the leading value of this tick, and shows what is seen of it behind the delay.
  void provide(const Setpoint& value, bool position_led,
               TO_Struct_StatusProvidedLeadingValue& status) noexcept;
  /// The actual value of this tick where it will be behind the delay: that counts as a part of the
  /// extrapolation time, ahead of the hysteresis, of what is provided.
  /// @source S7-1500T synchronous operation V7, 5.2.4
  Setpoint ahead_of_delay() const noexcept;

  std::uint32_t restarts_ = 0;
  std::uint32_t homings_ = 0;

 private:
  /// The delay that counts [s].
  double provided_delay() const noexcept { return provided_ == nullptr ? 0.0 : provided_->delay(); }

  Extrapolation extrapolation_;
  std::unique_ptr<ProvidedValue> provided_;  // nullptr: it does not provide
};

/// One configured leading value interconnection of a following axis.
struct LeadingValue {
  LeadingObject* source = nullptr;
  Coupling coupling = Coupling::setpoint;
};

}  // namespace lockstep
