/// Declaration of the variables of a cam, of either size.
/// @source S7-1500T synchronous operation V7, 13.2
#include "tech_objects/data_blocks/cam_data.hpp"
#include "tech_objects/data_blocks/declaration.hpp"

namespace lockstep {
namespace {

constexpr Range kCoordinate{-1.0e12, 1.0e12};

constexpr Choice kInterpolationModes[] = {
    {0, "linear"}, {1, "C-splines (cubic splines)"}, {2, "B-splines (Bezier splines)"}};
constexpr Choice kBoundaryConditions[] = {{0, "none"},
                                          {1, "first derivative equal at start and end of the profile"}};
constexpr Choice kReactions[] = {{0, "no reaction"}, {9, "end processing of the technology object"}};

constexpr BitNames kCamStatusBitNames = {
    "Control",        "Error",        "RestartActive",   "OnlineStartValuesChanged",
    "CamDataChanged", "Interpolated", "InInterpolation", "CopyCamDataActive"};
constexpr BitNames kCamErrorBitNames = {"SystemFault", "ConfigFault", "UserFault", "CommandNotAccepted"};
constexpr BitNames kCamWarningBitNames = {"SystemWarning", "ConfigWarning", "UserWarning",
                                          "CommandNotAccepted"};

template <class Data>
constexpr Variable kCamConfiguration[] = {
    ELEMENTS(Point, x, CAL, kLeading, kCoordinate, "leading value of a point"),
    ELEMENTS(Point, y, CAL, kPosition, kCoordinate, "following value of a point"),
    ARRAY(ValidPoint, CAL, kNone, kAny, "whether a point takes part in the interpolation"),
    ELEMENTS(Segment, xmin, CAL, kLeading, kCoordinate, "leading value at which a segment begins"),
    ELEMENTS(Segment, xmax, CAL, kLeading, kCoordinate, "leading value at which a segment ends"),
    ELEMENTS(Segment, a0, CAL, kNone, kCoordinate, "coefficient of x^0"),
    ELEMENTS(Segment, a1, CAL, kNone, kCoordinate,
             "coefficient of x^1, x being the leading value less Origin"),
    ELEMENTS(Segment, a2, CAL, kNone, kCoordinate, "coefficient of x^2"),
    ELEMENTS(Segment, a3, CAL, kNone, kCoordinate, "coefficient of x^3"),
    ELEMENTS(Segment, a4, CAL, kNone, kCoordinate, "coefficient of x^4"),
    ELEMENTS(Segment, a5, CAL, kNone, kCoordinate, "coefficient of x^5"),
    ELEMENTS(Segment, a6, CAL, kNone, kCoordinate, "coefficient of x^6"),
    ELEMENTS(Segment, sineAmplitude, CAL, kPosition, kCoordinate, "amplitude of the sine that is added"),
    ELEMENTS(Segment, sinePeriod, CAL, kNone, kCoordinate,
             "angular frequency of the sine [rad per leading unit]"),
    ELEMENTS(Segment, sinePhase, CAL, kNone, kCoordinate, "phase of the sine at Origin [rad]"),
    ELEMENTS(Segment, Origin, CAL, kLeading, kCoordinate,
             "leading value from which coefficients and phase count; 0.0 is the published form"),
    ARRAY(ValidSegment, CAL, kNone, kAny, "whether a segment takes part in the interpolation"),
    VARIABLE(InterpolationSettings.InterpolationMode, CAL, kNone, (Range{0.0, 2.0}),
             "how what lies between the elements is closed", .choices = kInterpolationModes),
    VARIABLE(InterpolationSettings.BoundaryConditions, CAL, kNone, (Range{0.0, 1.0}),
             "behaviour at start and end", .choices = kBoundaryConditions),
};

template <class Data>
constexpr double kPointCount = static_cast<double>(Data{}.Point.size());

template <class Data>
constexpr Variable kCamStatus[] = {
    COMPUTED(StatusCam.StartLeadingValue, RON, kLeading, kCoordinate,
             "leading value at which the curve begins"),
    COMPUTED(StatusCam.EndLeadingValue, RON, kLeading, kCoordinate, "leading value at which the curve ends"),
    COMPUTED(StatusCam.NumberOfValidPoints, RON, kNone, (Range{0.0, kPointCount<Data>}),
             "points of the curve in effect"),
    COMPUTED(StatusCam.NumberOfValidSegments, RON, kNone, (Range{0.0, static_cast<double>(kCamSegments)}),
             "segments of the curve in effect"),
    COMPUTED(StatusWord, RON, kNone, kAny, "status of the cam", .bits = &kCamStatusBitNames),
    COMPUTED(ErrorWord, RON, kNone, kAny, "technology alarms of the cam", .bits = &kCamErrorBitNames),
    COMPUTED(ErrorDetail.Number, RON, kNone, kAny, "number of the alarm that is pending"),
    COMPUTED(ErrorDetail.Reaction, RON, kNone, (Range{0.0, 9.0}), "its reaction", .choices = kReactions),
    COMPUTED(WarningWord, RON, kNone, kAny, "warnings of the cam", .bits = &kCamWarningBitNames),
};

}  // namespace

const DataBlock& cam_data_block() noexcept {
  static constexpr DataBlock kBlock{kCamConfiguration<CamData1k>, kCamStatus<CamData1k>};
  return kBlock;
}

const DataBlock& cam_10k_data_block() noexcept {
  static constexpr DataBlock kBlock{kCamConfiguration<CamData10k>, kCamStatus<CamData10k>};
  return kBlock;
}

}  // namespace lockstep
