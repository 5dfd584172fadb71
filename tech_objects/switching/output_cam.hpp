/// An output cam: TO_OutputCam. It switches an output at positions of an axis or external encoder.
/// @source S7-1500/S7-1500T measuring input and output cam functions, output cam
#pragma once

#include <cstdint>
#include <string>

#include "tech_objects/switching/switching_object.hpp"

namespace lockstep {

/// What MC_OutputCam wants; written in every call by the one instance in charge.
struct OutputCamRequest {
  const void* owner = nullptr;  ///< nullptr: none
  BOOL enable{};
  LREAL on_position{};   ///< [u]
  LREAL off_position{};  ///< [u]
  LREAL duration{};      ///< [ms]
  OutputCamMode mode = OutputCamMode::normal;
  PublishedDirection direction = PublishedDirection::positive;
};

class OutputCam final : public SwitchingObject<OutputCamData, ProcessingEnd::output_cam> {
 public:
  OutputCam(std::string name, DB_ANY number);

  OutputCamRequest request;
  /// Whether an input of a request is not permitted with this kind of cam.
  ErrorId refused(const OutputCamRequest& wanted) const noexcept;

  void servo(std::int64_t now) noexcept override;

 private:
  void end() noexcept override { active_ = false; }
  int alarm_of(const SwitchingShape& shape) const noexcept;
  SwitchingShape shape() const noexcept;
  void process(const SwitchingShape& shape, SwitchingEdges& edges) noexcept;
  void step_cam(const SwitchingShape& shape, SwitchingEdges& edges) noexcept;
  void show(bool on, const SwitchingEdges& edges) noexcept;

  SingleCam cam_;
};

}  // namespace lockstep
