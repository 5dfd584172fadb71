/// Declaration of the variables of a measuring input.
/// @source S7-1500/S7-1500T measuring input and output cam functions, tags of the measuring input
#include "tech_objects/data_blocks/measuring_input.hpp"

#include "tech_objects/data_blocks/choices.hpp"
#include "tech_objects/data_blocks/declaration.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"

namespace lockstep {
namespace {

using Data = MeasuringInputData;

constexpr Range between(double lowest, double highest) {
  return {lowest, highest};
}

constexpr Choice kStatus[] = {
    {0, "no measurement"}, {1, "waits for the event"}, {2, "values captured"}, {3, "error"}};
constexpr Choice kType[] = {
    {0, "time stamp of an input"}, {1, "PROFIdrive telegram"}, {2, "watches another measuring input"}};
constexpr Choice kErrorDetailReaction[] = {{0, "no reaction"}, {8, "processing of the measuring input ends"}};

constexpr Variable kConfigurationVariables[] = {
    VARIABLE(Parameter.MeasuringInputType, RON, kNone, between(0.0, 2.0), "kind of measuring",
             .choices = kType),
    VARIABLE(Parameter.PROFIdriveProbeNumber, RES, kNone, between(1.0, 2.0), "probe number in the telegram",
             .later = true),
    VARIABLE(Parameter.MeasuringRangeActivationTime, RON, kMilliseconds, between(0.0, 1e12),
             "system part of the time by which measuring begins ahead of the range"),
    VARIABLE(Parameter.MeasuringRangeAdditionalActivationTime, RES, kMilliseconds, between(0.0, 1e12),
             "user part of the time by which measuring begins ahead of the range"),
    VARIABLE(Parameter.CorrectionTime, RES, kMilliseconds, between(0.0, 1e12),
             "by which an event is earlier than it is seen"),
    VARIABLE(Interface.Address, RON, kNone, kAny, "input"),
    VARIABLE(Units.LengthUnit, RON, kNone, kAny, "unit for position", .choices = kUnitsLengthUnit,
             .later = true),
    VARIABLE(Units.TimeUnit, RON, kNone, kAny, "unit for time", .choices = kUnitsMilliseconds, .later = true),
};

constexpr Variable kStatusVariables[] = {
    COMPUTED(Status, RON, kNone, between(0.0, 3.0), "state of the measuring function", .choices = kStatus),
    COMPUTED(InputState, RON, kNone, kAny, "level of the input"),
    COMPUTED(MeasuredValues.MeasuredValue1, RON, kPosition, between(-1e12, 1e12), "first measured position"),
    COMPUTED(MeasuredValues.MeasuredValue2, RON, kPosition, between(-1e12, 1e12), "second measured position"),
    COMPUTED(MeasuredValues.MeasuredValue1Counter, RON, kNone, between(0.0, 2147483647.0),
             "number of first measured positions"),
    COMPUTED(MeasuredValues.MeasuredValue2Counter, RON, kNone, between(0.0, 2147483647.0),
             "number of second measured positions"),
    COMPUTED(MeasuredValues.LostEdgeCounter1, RON, kNone, between(0.0, 7.0),
             "edges lost in the servo cycle of the first measured position; 0 with one-time measuring"),
    COMPUTED(MeasuredValues.LostEdgeCounter2, RON, kNone, between(0.0, 7.0),
             "edges lost in the servo cycle of the second measured position; 0 with one-time measuring"),
    COMPUTED(StatusWord, RON, kNone, kAny, "status information of the technology object",
             .bits = &kMeasuringInputStatusBitNames),
    COMPUTED(ErrorWord, RON, kNone, kAny, "errors (technology alarms) at the technology object",
             .bits = &kInputOutputErrorBitNames),
    COMPUTED(WarningWord, RON, kNone, kAny, "warnings pending at the technology object",
             .bits = &kInputOutputWarningBitNames),
    COMPUTED(ErrorDetail.Number, RON, kNone, kAny, "alarm number"),
    COMPUTED(ErrorDetail.Reaction, RON, kNone, between(0.0, 8.0), "effective alarm reaction",
             .choices = kErrorDetailReaction),
};

}  // namespace

const DataBlock& measuring_input_data_block() noexcept {
  static constexpr DataBlock block{kConfigurationVariables, kStatusVariables};
  return block;
}

}  // namespace lockstep
