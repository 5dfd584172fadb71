/// Declaration of the variables of an output cam and of a cam track.
/// @source S7-1500/S7-1500T measuring input and output cam functions, tags of output cam and cam track
#include "tech_objects/data_blocks/output_cam.hpp"

#include "tech_objects/data_blocks/choices.hpp"
#include "tech_objects/data_blocks/declaration.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"

namespace lockstep {
namespace {

constexpr Range between(double lowest, double highest) {
  return {lowest, highest};
}

constexpr Choice kOutputCamType[] = {{0, "distance cam: on from OnPosition to OffPosition"},
                                     {1, "time cam: on for Duration from OnPosition on"},
                                     {2, "switching cam: published without a description, and refused"}};
constexpr Choice kCamTrackType[] = {{0, "distance cams"}, {1, "time cams"}};
constexpr Choice kPositionType[] = {{0, "setpoint"}, {1, "actual position"}};
constexpr Choice kLogicOperation[] = {{0, "OR"}, {1, "AND"}};
constexpr Choice kTrackStatus[] = {
    {0, "INACTIVE: off"},
    {1, "ACTIVE: on"},
    {2, "ACTIVE_WAITING_FOR_NEXT_CYCLE: on, new data wait for the next track cycle"}};
constexpr Choice kCamReaction[] = {{0, "no reaction"}, {6, "processing of the output cam ends"}};
constexpr Choice kTrackReaction[] = {{0, "no reaction"}, {7, "processing of the cam track ends"}};

constexpr std::string_view kOnText = "by which the switch-on edge leads";
constexpr std::string_view kOffText = "by which the switch-off edge leads";
constexpr std::string_view kHysteresisText =
    "after a reversal the state is held until the position has gone back by more than this";

namespace output_cam {
using Data = OutputCamData;
constexpr Variable kConfigurationVariables[] = {
    VARIABLE(Parameter.OutputCamType, RES, kNone, between(0.0, 2.0), "kind of cam",
             .choices = kOutputCamType),
    VARIABLE(Parameter.PositionType, RES, kNone, between(0.0, 1.0), "position that counts",
             .choices = kPositionType),
    VARIABLE(Parameter.OnCompensation, DIR, kMilliseconds, between(0.0, 1e12), kOnText),
    VARIABLE(Parameter.OffCompensation, DIR, kMilliseconds, between(0.0, 1e12), kOffText),
    VARIABLE(Parameter.Hysteresis, DIR, kPosition, between(0.0, 1e12), kHysteresisText),
    VARIABLE(Interface.EnableOutput, RES, kNone, kAny, "whether the output is written"),
    VARIABLE(Interface.Address, RON, kNone, kAny, "output"),
    VARIABLE(Interface.LogicOperation, RON, kNone, between(0.0, 1.0), "of all cams on one output",
             .choices = kLogicOperation),
    VARIABLE(Units.LengthUnit, RON, kNone, kAny, "unit for position", .choices = kUnitsLengthUnit,
             .later = true),
    VARIABLE(Units.TimeUnit, RON, kNone, kAny, "unit for time", .choices = kUnitsMilliseconds, .later = true),
};
constexpr Variable kStatusVariables[] = {
    COMPUTED(CamOutput, RON, kNone, kAny, "switching state"),
    COMPUTED(StatusWord, RON, kNone, kAny, "status information of the technology object",
             .bits = &kCamStatusBitNames),
    COMPUTED(ErrorWord, RON, kNone, kAny, "errors (technology alarms) at the technology object",
             .bits = &kInputOutputErrorBitNames),
    COMPUTED(WarningWord, RON, kNone, kAny, "warnings pending at the technology object",
             .bits = &kInputOutputWarningBitNames),
    COMPUTED(ErrorDetail.Number, RON, kNone, kAny, "alarm number"),
    COMPUTED(ErrorDetail.Reaction, RON, kNone, between(0.0, 6.0), "effective alarm reaction",
             .choices = kCamReaction),
};
}  // namespace output_cam

namespace cam_track {
using Data = CamTrackData;
constexpr Variable kConfigurationVariables[] = {
    VARIABLE(Parameter.CamTrackType, RES, kNone, between(0.0, 1.0), "kind of the cams",
             .choices = kCamTrackType),
    VARIABLE(Parameter.PositionType, RES, kNone, between(0.0, 1.0), "position that counts",
             .choices = kPositionType),
    VARIABLE(Parameter.ReferencePosition, DIR, kPosition, between(-1e12, 1e12), "where a track begins"),
    VARIABLE(Parameter.CamTrackLength, DIR, kPosition, between(0.001, 1e12),
             "length of the track, after which it repeats"),
    VARIABLE(Parameter.CamMasking, DIR, kNone, between(0.0, 4294967295.0), "bit n - 1 enables cam n"),
    VARIABLE(Parameter.OnCompensation, DIR, kMilliseconds, between(0.0, 1e12), kOnText),
    VARIABLE(Parameter.OffCompensation, DIR, kMilliseconds, between(0.0, 1e12), kOffText),
    VARIABLE(Parameter.Hysteresis, DIR, kPosition, between(0.0, 1e12), kHysteresisText),
    ELEMENTS(Parameter.Cam, OnPosition, CAL, kPosition, between(0.0, 1e12), "beginning, in the track"),
    ELEMENTS(Parameter.Cam, OffPosition, CAL, kPosition, between(0.0, 1e12),
             "end, in the track; distance cams"),
    ELEMENTS(Parameter.Cam, Duration, CAL, kMilliseconds, between(0.001, 1e12),
             "how long it is on; time cams"),
    ELEMENTS(Parameter.Cam, Existent, CAL, kNone, kAny, "whether the cam is used"),
    VARIABLE(Interface.EnableOutput, RES, kNone, kAny, "whether the output is written"),
    VARIABLE(Interface.Address, RON, kNone, kAny, "output"),
    VARIABLE(Units.LengthUnit, RON, kNone, kAny, "unit for position", .choices = kUnitsLengthUnit,
             .later = true),
    VARIABLE(Units.TimeUnit, RON, kNone, kAny, "unit for time", .choices = kUnitsMilliseconds, .later = true),
};
constexpr Variable kStatusVariables[] = {
    COMPUTED(Status, RON, kNone, between(0.0, 2.0), "state of the track", .choices = kTrackStatus),
    COMPUTED(TrackOutput, RON, kNone, kAny, "switching state"),
    COMPUTED(SingleCamState, RON, kNone, between(0.0, 4294967295.0), "a bit per cam: it is on"),
    COMPUTED(TrackPosition, RON, kPosition, between(-1e12, 1e12), "position in the track"),
    COMPUTED(MatchPosition, RON, kPosition, between(-1e12, 1e12), "where the present track begins"),
    COMPUTED(StatusWord, RON, kNone, kAny, "status information of the technology object",
             .bits = &kCamStatusBitNames),
    COMPUTED(ErrorWord, RON, kNone, kAny, "errors (technology alarms) at the technology object",
             .bits = &kInputOutputErrorBitNames),
    COMPUTED(WarningWord, RON, kNone, kAny, "warnings pending at the technology object",
             .bits = &kInputOutputWarningBitNames),
    COMPUTED(ErrorDetail.Number, RON, kNone, kAny, "alarm number"),
    COMPUTED(ErrorDetail.Reaction, RON, kNone, between(0.0, 7.0), "effective alarm reaction",
             .choices = kTrackReaction),
};
}  // namespace cam_track

}  // namespace

const DataBlock& output_cam_data_block() noexcept {
  static constexpr DataBlock block{output_cam::kConfigurationVariables, output_cam::kStatusVariables};
  return block;
}

const DataBlock& cam_track_data_block() noexcept {
  static constexpr DataBlock block{cam_track::kConfigurationVariables, cam_track::kStatusVariables};
  return block;
}

}  // namespace lockstep
