/// An output cam: TO_OutputCam. It switches an output at positions of an axis or external encoder. All of it
/// runs in MC_Servo, behind axes and encoders.
/// @source S7-1500/S7-1500T measuring input and output cam functions, output cam
#pragma once

#include <cstdint>
#include <string>

#include "tech_objects/data_block_output_cam.hpp"
#include "tech_objects/new_jobs.hpp"
#include "tech_objects/single_cam.hpp"
#include "tech_objects/switched_output.hpp"

namespace lockstep {

/// What MC_OutputCam wants; written in every call by the one instance in charge.
struct OutputCamRequest {
  const void* owner = nullptr;  ///< nullptr: none
  BOOL enable{};
  LREAL on_position{};   ///< [u]
  LREAL off_position{};  ///< [u]
  LREAL duration{};      ///< [ms]
  DINT mode = 1;
  DINT direction = 1;
};

class OutputCam final : public TechnologyObject {
 public:
  OutputCam(std::string name, DB_ANY number);

  // ---- Load time

  OutputCamData data;
  const LeadingObject* assigned = nullptr;  ///< whose position switches
  SwitchingTimes switching_times;

  void configure(double servo_period, int ratio) override;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &start_values_; }

  // ---- Cycle

  void submit(Job& job) noexcept override { new_jobs_.submit(job); }  ///< MC_Reset
  OutputCamRequest request;
  /// Whether an input of a request is not permitted with this kind of cam.
  ErrorId refused(const OutputCamRequest& wanted) const noexcept;
  /// Whether an alarm has ended the processing, until it is acknowledged.
  bool faulty() const noexcept { return data.ErrorDetail.Reaction != 0; }

  void servo(std::int64_t now) noexcept;
  void skip_servo(std::int64_t ticks) noexcept { path_.skip(ticks); }
  void interpolated() noexcept { path_.interpolated(); }

 private:
  void watch() noexcept;
  int alarm_of(const SwitchingShape& shape) const noexcept;
  SwitchingShape shape() const noexcept;
  void process(const SwitchingShape& shape, SwitchingEdges& edges) noexcept;
  void step_cam(const SwitchingShape& shape, SwitchingEdges& edges) noexcept;
  void show(bool on, const SwitchingEdges& edges) noexcept;
  void start(Job& job) noexcept;
  void publish() noexcept;

  double servo_period_ = 0.001;  // [s]
  int ratio_ = 1;
  std::uint32_t restarts_ = 0;  // of what is assigned
  SwitchingPath path_;
  SingleCam cam_;
  bool active_ = false;
  bool inverted_ = false;
  NewJobs new_jobs_;
  OutputCamData start_values_;
};

}  // namespace lockstep
