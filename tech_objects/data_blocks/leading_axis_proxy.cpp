/// Declaration of the variables of a leading axis proxy.
/// @source S7-1500T synchronous operation V7, 13.3
#include "tech_objects/data_blocks/leading_axis_proxy.hpp"

#include "tech_objects/data_blocks/declaration.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"

namespace lockstep {
namespace {

using Data = LeadingAxisProxyData;

constexpr Range between(double lowest, double highest) {
  return {lowest, highest};
}

constexpr Choice kErrorDetailReaction[] = {{0, "no reaction"}, {13, "leading value invalid"}};

constexpr Variable kConfigurationVariables[] = {
    VARIABLE(Interface.AddressIn, RON, kNone, kAny,
             "input address of the telegram of the external leading value", .later = true),
    VARIABLE(
        Parameter.LocalLeadingValueDelayTime, DIR, kSeconds, between(0.0, 1e9),
        "delay time of the virtual local following axis that provides a leading value in turn (cascade)"),
    VARIABLE(Parameter.ToleranceTimeExternalLeadingValueInvalid, DIR, kSeconds, between(0.0, 1e12),
             "tolerance time until a technology alarm is raised when the external leading value becomes "
             "invalid"),
};

constexpr Variable kStatusVariables[] = {
    COMPUTED(Position, RON, kPosition, kAny, "adapted leading value for local synchronous operation"),
    COMPUTED(Velocity, RON, kVelocity, kAny, "leading-value velocity for local synchronous operation"),
    COMPUTED(Acceleration, RON, kAcceleration, kAny,
             "leading-value acceleration for local synchronous operation"),
    COMPUTED(StatusExternalLeadingValue.ModuloLength, RON, kPosition, between(0.0, 1e12),
             "modulo length of the external leading value"),
    COMPUTED(StatusExternalLeadingValue.ModuloStartValue, RON, kPosition, between(-1e12, 1e12),
             "modulo start value of the external leading value"),
    COMPUTED(
        StatusExternalLeadingValue.AdjustmentTime, RON, kSeconds, between(-1e12, 1e12),
        "time by which the external leading value is adapted: below 0 interpolated, above 0 extrapolated"),
    COMPUTED(StatusWord, RON, kNone, kAny, "status information of the technology object",
             .bits = &kProxyStatusBitNames),
    COMPUTED(ErrorWord, RON, kNone, kAny, "errors (technology alarms) at the technology object",
             .bits = &kProxyErrorBitNames),
    COMPUTED(ErrorDetail.Number, RON, kNone, kAny, "alarm number"),
    COMPUTED(ErrorDetail.Reaction, RON, kNone, between(0.0, 13.0), "effective alarm reaction",
             .choices = kErrorDetailReaction),
    COMPUTED(WarningWord, RON, kNone, kAny, "warnings pending at the technology object",
             .bits = &kProxyWarningBitNames),
};

}  // namespace

const DataBlock& leading_axis_proxy_data_block() noexcept {
  static constexpr DataBlock block{kConfigurationVariables, kStatusVariables};
  return block;
}

}  // namespace lockstep
