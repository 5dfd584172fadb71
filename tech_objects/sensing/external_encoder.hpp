/// An external encoder: TO_ExternalEncoder. It has no setpoints and moves nothing; following axes follow its
/// extrapolated actual value.
///
/// In MC_Servo, behind the axes, it is read; in MC_Interpolator, before the axes, it is extrapolated and
/// shown.
/// @source S7-1500/S7-1500T axis functions, external encoder; S7-1500T synchronous operation V7, 5.2
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "tech_objects/data_blocks/encoder.hpp"
#include "tech_objects/data_blocks/standstill.hpp"
#include "tech_objects/drive/encoder_source.hpp"
#include "tech_objects/jobs/new_jobs.hpp"
#include "tech_objects/objects/leading_object.hpp"
#include "tech_objects/sensing/homing_marks.hpp"

namespace lockstep {

class ExternalEncoder final : public LeadingObject {
 public:
  ExternalEncoder(std::string name, DB_ANY number);

  // ---- Load time

  ExternalEncoderData data;
  SimulatedEncoderSettings source_settings;  ///< what it measures

  void configure(double servo_period, int ratio) override;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &start_values_; }

  // ---- Cycle

  /// MC_Reset and MC_Home, which start at the next interpolator tick.
  void submit(Job& job) noexcept override { new_jobs_.submit(job); }

  bool takes_part(Phase phase) const noexcept override { return phase != Phase::behind_axes; }
  /// Reads the encoder.
  void servo(std::int64_t now) noexcept override;
  /// What this controller does not move has gone on.
  void skip(std::int64_t ticks) noexcept override {
    if (source_.foreign()) unseen_ += static_cast<double>(ticks) * servo_period_;
  }
  /// Starts jobs, extrapolates, shows.
  void before_axes() noexcept override;

  AxisPosition actual_position() const noexcept override { return actual_; }
  bool measured_in_servo() const noexcept override { return true; }
  DoubleDouble measured_line() const noexcept override { return line_; }
  bool actual_values_valid() const noexcept override { return begun_ && !faulty(); }
  /// Where it would be read without noise and increments, now and in the servo tick before [u]: what the
  /// material does.
  DoubleDouble true_line() const noexcept { return true_line_; }
  DoubleDouble last_true_line() const noexcept { return last_true_line_; }
  bool leading_value_stands() const noexcept override { return standstill_.stands(); }
  bool homing() const noexcept override { return passive_ != nullptr; }

 private:
  void take_start_values() noexcept;
  void begin(DoubleDouble line) noexcept;
  void go_on_from_here(DoubleDouble line) noexcept;
  bool follow(DoubleDouble line) noexcept;
  bool faulty() const noexcept { return data.ErrorDetail.Number != 0; }
  void fault(int alarm_number, const AlarmDetail& detail = {}) noexcept;
  void start(Job& job) noexcept;
  ErrorId reset(bool restart) noexcept;
  ErrorId home(Job& job) noexcept;
  ErrorId begin_passive_homing(Job& job) noexcept;
  void take_mark() noexcept;
  void end_passive_homing(JobPhase phase, ErrorId error) noexcept;
  bool fits(double by) const noexcept;
  HomeSwitch home_switch() const noexcept;
  /// After which distance the encoder is where it was [u]; 0: never.
  double turn() const noexcept { return modulo_.enabled ? modulo_.length : 0.0; }
  void shift(double by) noexcept;
  void publish() noexcept;

  double servo_period_ = 0.001;  // [s]
  double period_ = 0.001;        // of the interpolator [s]
  double unseen_ = 0.0;          // in which a signal has gone on beyond that [s]
  SimulatedEncoder source_;
  NewJobs new_jobs_;
  bool begun_ = false;
  bool heard_ = false;  // whether the last reading was valid
  bool homed_ = false;
  DoubleDouble line_;  // of the encoder, in the direction of the object [u]
  DoubleDouble true_line_;
  DoubleDouble last_true_line_;
  AxisPosition origin_;  // where the encoder shows 0
  AxisPosition actual_;
  AxisPosition last_actual_;      // of the last interpolator tick
  double actual_velocity_ = 0.0;  // [u/s]
  Standstill standstill_;
  Job* passive_ = nullptr;  // passive homing
  MarkSearch mark_search_;
  std::int64_t counted_from_ = 0;  // turn that ActualModuloCycle shows as 0
  ExternalEncoderData start_values_;
};

}  // namespace lockstep
