/// Reading an interpolated cam: MC_GetCamLeadingValue and MC_GetCamFollowingValue.
#pragma once

#include "fb/interpolate_cam.hpp"

namespace lockstep {

/// Searches the leading value nearest to an approximate one that has a following value. It is found within
/// the call.
/// @source S7-1500T synchronous operation V7, 12.2.2; 8.9
/// @errors 16#8062 approximate value not finite; 16#8063 no such leading value, or cam not interpolated
struct MC_GetCamLeadingValue final : CamBlock {
  LREAL FollowingValue{};
  LREAL ApproachLeadingValue{};
  LREAL Value{};

  static constexpr std::string_view kName = "MC_GetCamLeadingValue";
  static constexpr std::string_view kText = "Reads the leading value of a cam that has a following value.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.2.2";
  static constexpr auto kPins =
      pins(kCam, pin::kExecute,
           in<&MC_GetCamLeadingValue::FollowingValue>("FollowingValue", Unit::kPosition, kFinite,
                                                      "following value whose leading value is wanted",
                                                      {.error = ErrorId::no_leading_value}),
           in<&MC_GetCamLeadingValue::ApproachLeadingValue>(
               "ApproachLeadingValue", Unit::kLeading, kFinite,
               "the solution nearest to it is the result; outside of the cam it counts as the nearer end",
               {.error = ErrorId::approach_leading_value}),
           pin::kDone, pin::kBusy, pin::kError, pin::kErrorID,
           out<&MC_GetCamLeadingValue::Value>("Value", "leading value; valid with Done", Unit::kLeading));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& /*job*/) const noexcept override {}
  void hand_over(Job& job) noexcept override;
};

/// Reads the following value of a cam and its derivatives at a leading value, within the call.
/// @source S7-1500T synchronous operation V7, 12.2.3; 8.10
/// @errors 16#8064 outside of the cam, or cam not interpolated
struct MC_GetCamFollowingValue final : CamBlock {
  LREAL LeadingValue{};
  LREAL Value{};
  LREAL FirstDerivative{};
  LREAL SecondDerivative{};

  static constexpr std::string_view kName = "MC_GetCamFollowingValue";
  static constexpr std::string_view kText = "Reads the following value of a cam at a leading value.";
  static constexpr std::string_view kSource = "S7-1500T synchronous operation V7, 12.2.3";
  static constexpr auto kPins =
      pins(kCam, pin::kExecute,
           in<&MC_GetCamFollowingValue::LeadingValue>("LeadingValue", Unit::kLeading, kFinite,
                                                      "leading value whose following value is wanted",
                                                      {.error = ErrorId::no_following_value}),
           pin::kDone, pin::kBusy, pin::kError, pin::kErrorID,
           out<&MC_GetCamFollowingValue::Value>("Value", "following value; valid with Done", Unit::kPosition),
           out<&MC_GetCamFollowingValue::FirstDerivative>("FirstDerivative",
                                                          "first derivative there; valid with Done"),
           out<&MC_GetCamFollowingValue::SecondDerivative>("SecondDerivative",
                                                           "second derivative there; valid with Done"));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& /*job*/) const noexcept override {}
  void hand_over(Job& job) noexcept override;
};

}  // namespace lockstep
