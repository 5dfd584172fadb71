/// Cams by themselves: MC_InterpolateCam.
#pragma once

#include "fb/execute_block.hpp"
#include "tech_objects/cam_object/cam.hpp"

namespace lockstep {

/// A block whose job a cam carries out.
struct CamBlock : ExecuteBlock {
  lockstep::Cam* Cam{};

  static constexpr Pin kCam = object<&CamBlock::Cam>("Cam", kAnyCam, "cam that carries out the job");

 protected:
  Axis* target() const noexcept final { return nullptr; }
  bool wired() const noexcept final { return Cam != nullptr; }
};

/// Makes the curve of a cam from its valid points and segments. It takes effect at one interpolator tick: in
/// a simulation at the next one after the call, in real time when another thread has made it.
/// @source S7-1500T synchronous operation V7, 12.2.1; 8.3.4
/// @errors 16#80AA empty; 16#80AB in use; 16#80AC elements wrong; 16#80E7 being copied into; 16#80E8 being
///         interpolated already; 16#800D restarting
struct MC_InterpolateCam final : CamBlock {
  static constexpr std::string_view kName = "MC_InterpolateCam";
  static constexpr std::string_view kText = "Interpolates a cam from its points and segments.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.2.1";
  static constexpr auto kPins = pins(kCam, pin::kExecute, pin::kDone, pin::kBusy, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  void hand_over(Job& job) noexcept override { Cam->submit(job); }
};

}  // namespace lockstep
