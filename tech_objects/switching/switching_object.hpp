/// What an output cam and a cam track have in common: they switch an output by the position of an axis or
/// external encoder, in MC_Servo, behind axes and encoders.
/// @source S7-1500/S7-1500T measuring input and output cam functions, output cam
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "tech_objects/data_blocks/object_bits.hpp"
#include "tech_objects/data_blocks/output_cam.hpp"
#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/jobs/new_jobs.hpp"
#include "tech_objects/objects/object_alarms.hpp"
#include "tech_objects/switching/single_cam.hpp"
#include "tech_objects/switching/switched_output.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

/// @tparam Data the data block  @tparam kEnd what an alarm ends
template <class Data, ProcessingEnd kEnd>
class SwitchingObject : public TechnologyObject {
 public:
  // ---- Load time

  Data data;
  const LeadingObject* assigned = nullptr;  ///< whose position switches
  SwitchingTimes switching_times;

  void configure(double servo_period, int ratio) override {
    servo_period_ = servo_period;
    ratio_ = ratio;
    start_values_ = data;
    if (assigned == nullptr) return;
    watch();
    publish();
  }
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &start_values_; }

  // ---- Cycle

  void submit(Job& job) noexcept override { new_jobs_.submit(job); }  ///< MC_Reset
  /// Whether an alarm has ended the processing, until it is acknowledged.
  bool faulty() const noexcept { return data.ErrorDetail.Reaction != 0; }
  /// Whether it is processed.
  bool active() const noexcept { return active_; }
  bool output() const noexcept { return output_of(data); }

  bool takes_part(Phase phase) const noexcept override { return phase != Phase::behind_axes; }
  void before_axes() noexcept override { path_.interpolated(); }
  /// Cams with the same address switch one output.
  SwitchedBy switches() const noexcept override {
    const auto& interface = data.Interface;
    if (!interface.EnableOutput || interface.Address == nullptr) return {};
    bool all = false;
    if constexpr (requires { interface.LogicOperation; }) all = interface.LogicOperation == 1;
    return {&output_of(data), interface.Address, all};
  }

 protected:
  static constexpr double kMillisecond = 1e-3;  // [s]

  using TechnologyObject::TechnologyObject;

  /// Ends the processing, for a restart.
  virtual void end() noexcept = 0;
  /// Shows what only this kind of object has.
  virtual void show_processing() noexcept {}

  /// An external encoder has no setpoint.
  bool by_setpoint() const noexcept {
    return data.Parameter.PositionType == PositionType::setpoint &&
           assigned->kind != ObjectKind::TO_ExternalEncoder;
  }
  /// Whether there is a setpoint that would switch, if it is the setpoint that has to.
  bool has_position() const noexcept { return !by_setpoint() || assigned->position_controlled(); }

  bool position_valid() const noexcept { return assigned->actual_values_valid(); }
  /// Whether what is assigned has been restarted since the last tick: its places have other names now, and
  /// the job of the object ends.
  bool assigned_restarted() noexcept {
    if (restarts_ == assigned->restarts()) return false;
    watch();
    return true;
  }
  /// Whether what it switches ahead of its place [s] stays within the range of positions.
  bool leads_within_range(double lead) const noexcept {
    const Stretch& distance = path_.stretch();
    return std::max(std::abs(distance.from_velocity), std::abs(distance.to_velocity)) * lead <=
           kPositionRange;
  }
  void raise(int alarm_number) noexcept {
    raise_alarm(alarm_number, kEnd, *this, data, {.object = static_cast<std::uint16_t>(assigned->number)});
    path_.begin_anew();
  }

  /// The output at this tick; `last` as the edges before the tick have left it.
  void switch_output(bool on, bool last) noexcept {
    if (on != last) note(path_.time(), on);
    output_of(data) = on;
  }
  /// Tells when the output has changed.
  void note(double time, bool to) noexcept {
    double* const place = to ? switching_times.on : switching_times.off;
    if (place != nullptr) *place = time;
  }

  /// End of a servo tick: jobs, and the data block.
  void finish() noexcept {
    new_jobs_.take([this](Job& job) { start(job); });
    publish();
  }

  SwitchingPath path_;
  bool active_ = false;
  bool inverted_ = false;

 private:
  static auto& output_of(auto& data) noexcept {
    if constexpr (requires { data.CamOutput; })
      return data.CamOutput;
    else
      return data.TrackOutput;
  }

  void watch() noexcept {
    path_.watch(*assigned, !by_setpoint(), servo_period_, ratio_);
    restarts_ = assigned->restarts();
  }

  void start(Job& job) noexcept {
    if (job.kind != JobKind::MC_Reset) return job.fail(ErrorId::no_technology_object);
    clear_alarms(*this, data);
    job.phase = JobPhase::done;
    if (!job.as<ResetJob>().restart) return;
    const BOOL shown = output();
    data = start_values_;
    output_of(data) = shown;  // until the next tick
    start_values_changed = false;
    end();
    watch();
  }

  void publish() noexcept {
    show_processing();
    set_bit(data.StatusWord, InputOutputBit::Control, active_);
    set_bit(data.StatusWord, InputOutputBit::Error, data.ErrorDetail.Number != 0);
    set_bit(data.StatusWord, InputOutputBit::OnlineStartValuesChanged, start_values_changed);
    set_bit(data.StatusWord, InputOutputBit::OutputInverted, inverted_);
    set_bit(data.StatusWord, InputOutputBit::CommunicationOK, true);
  }

  double servo_period_ = 0.001;  // [s]
  int ratio_ = 1;
  std::uint32_t restarts_ = 0;  // of what is assigned
  NewJobs new_jobs_;
  Data start_values_;
};

}  // namespace lockstep
