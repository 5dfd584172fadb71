/// The members of a cam's elements: for reading, writing and the schema alike.
#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "projects/json/key.hpp"
#include "tech_objects/cam_design/design.hpp"
#include "tech_objects/cam_design/design_check.hpp"

namespace lockstep {

/// Magnitude of every number of a cam.
inline constexpr double kLargestCamNumber = 1.0e12;

/// The motion laws by which a transition may be made, by their names.
inline std::vector<std::string_view> law_names() {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kMotionLaws; ++i)
    names.push_back(motion_law_name(static_cast<MotionLawKind>(i)));
  return names;
}

/// A member that is a number.
template <class T>
struct CamNumber {
  std::string_view key;
  std::variant<double T::*, std::optional<double> T::*> member;
  std::string_view text;
  bool required = false;
};

/// Another member of an element, read and written by hand.
struct CamMember {
  std::string_view key;
  bool required = false;
};

namespace cam_fields {

inline constexpr std::string_view kFrom = "leading value at which it starts";
inline constexpr std::string_view kTo = "leading value at which it ends";

inline constexpr CamNumber<CamPointElement> kPoint[] = {
    {"x", &CamPointElement::x, "leading value", true},
    {"y", &CamPointElement::y, "following value", true},
    {"velocity", &CamPointElement::velocity, "first derivative, for transitions by a law; 0 if not given"},
    {"acceleration", &CamPointElement::acceleration, "second derivative, the same"},
    {"jerk", &CamPointElement::jerk, "third derivative, the same"}};
inline constexpr CamNumber<CamPointGroup> kGroup[] = {
    {"start", &CamPointGroup::start, "leading value that 0 stands for, with relative_x"},
    {"end", &CamPointGroup::end, "leading value that 1 stands for, with relative_x"},
    {"lowest", &CamPointGroup::lowest, "following value that 0 stands for, with relative_y"},
    {"highest", &CamPointGroup::highest, "following value that 1 stands for, with relative_y"},
    {"tolerance", &CamPointGroup::tolerance, "greatest deviation of the cam from the group, for a warning"}};
inline constexpr CamMember kGroupMembers[] = {{"points", true},  {"relative_x"}, {"relative_y"},
                                              {"interpolation"}, {"mapping"},    {"count"}};
inline constexpr CamNumber<CamLine> kLine[] = {
    {"start", &CamLine::start, kFrom, true},
    {"end", &CamLine::end, kTo, true},
    {"start_value", &CamLine::start_value, "following value at the start"},
    {"end_value", &CamLine::end_value, "following value at the end"},
    {"slope", &CamLine::slope, "slope; two of start_value, end_value and slope are needed"}};
inline constexpr CamNumber<CamWave> kWave[] = {
    {"amplitude", &CamWave::amplitude, "amplitude of the sine", true},
    {"start_phase", &CamWave::start_phase, "phase at the start [degrees]"},
    {"end_phase", &CamWave::end_phase, "phase at the end [degrees]"},
    {"period", &CamWave::period, "length of a period"},
    {"frequency", &CamWave::frequency,
     "periods per leading unit; two of start_phase, end_phase, period and frequency are needed"}};
inline constexpr CamNumber<CamSine> kSine[] = {
    {"start", &CamSine::start, kFrom, true},
    {"end", &CamSine::end, kTo, true},
    {"offset", &CamSine::offset, "centre of the sine"},
    {"start_offset", &CamSine::start_offset, "inclined sine: centre at the start"},
    {"end_offset", &CamSine::end_offset, "inclined sine: centre at the end"},
    {"inclination", &CamSine::inclination,
     "inclined sine: slope of the centre; two of the three are needed"}};
inline constexpr CamNumber<CamPolynomial> kPolynomial[] = {
    {"start", &CamPolynomial::start, kFrom, true},
    {"end", &CamPolynomial::end, kTo, true},
    {"start_value", &CamPolynomial::start_value, "following value at the start"},
    {"start_velocity", &CamPolynomial::start_velocity, "first derivative at the start"},
    {"start_acceleration", &CamPolynomial::start_acceleration, "second derivative at the start"},
    {"start_jerk", &CamPolynomial::start_jerk, "third derivative at the start"},
    {"end_value", &CamPolynomial::end_value, "following value at the end"},
    {"end_velocity", &CamPolynomial::end_velocity, "first derivative at the end"},
    {"end_acceleration", &CamPolynomial::end_acceleration, "second derivative at the end"},
    {"end_jerk", &CamPolynomial::end_jerk, "third derivative at the end"},
    {"lambda", &CamPolynomial::lambda, "place of the inflection point, 0 to 1 of the element"},
    {"lambda_at", &CamPolynomial::lambda_at, "the same as a leading value"}};
inline constexpr CamMember kPolynomialMembers[] = {{"coefficients"}};
inline constexpr CamNumber<CamInverseSine> kInverseSine[] = {
    {"start", &CamInverseSine::start, kFrom, true},
    {"end", &CamInverseSine::end, kTo, true},
    {"lowest", &CamInverseSine::lowest, "least following value", true},
    {"highest", &CamInverseSine::highest, "greatest following value", true},
    {"from", &CamInverseSine::from, "start in the domain of the arcsine, -1 to 1"},
    {"to", &CamInverseSine::to, "end in the domain of the arcsine"},
    {"tolerance", &CamInverseSine::tolerance,
     "greatest deviation of the cam from the arcsine, for a warning"}};
inline constexpr CamMember kInverseSineMembers[] = {{"mirrored"}, {"count"}};
inline constexpr CamNumber<CamTransition> kTransition[] = {
    {"lambda", &CamTransition::lambda, "place of the inflection point, 0 to 1 of the transition"},
    {"lambda_at", &CamTransition::lambda_at, "the same as a leading value"},
    {"ca", &CamTransition::ca, "normalised greatest acceleration"},
    {"ca_star", &CamTransition::ca_star, "normalised greatest deceleration"},
    {"tolerance", &CamTransition::tolerance, "greatest deviation of the cam from the law, for a warning"}};
inline constexpr CamMember kTransitionMembers[] = {
    {"method"}, {"law"}, {"goal"}, {"start_continuity"}, {"end_continuity"}, {"count"}};
inline constexpr CamNumber<CamChecks> kChecks[] = {
    {"leading_velocity", &CamChecks::leading_velocity, "velocity of the leading value for the limits [u/s]"},
    {"max_velocity", &CamChecks::max_velocity, "limit of the following axis [u/s]"},
    {"max_acceleration", &CamChecks::max_acceleration, "limit of the following axis [u/s²]"},
    {"max_jerk", &CamChecks::max_jerk, "limit of the following axis [u/s³]"}};
inline constexpr CamMember kCheckMembers[] = {
    {"leading_range"}, {"following_range"}, {"suitability"}, {"continuity"}, {"cyclic"}};
inline constexpr CamNumber<TO_Cam_Struct_SegmentData> kSegment[] = {
    {"xmin", &TO_Cam_Struct_SegmentData::xmin, kFrom, true},
    {"xmax", &TO_Cam_Struct_SegmentData::xmax, kTo, true},
    {"a0", &TO_Cam_Struct_SegmentData::a0, "coefficient of x^0"},
    {"a1", &TO_Cam_Struct_SegmentData::a1, "coefficient of x^1"},
    {"a2", &TO_Cam_Struct_SegmentData::a2, "coefficient of x^2"},
    {"a3", &TO_Cam_Struct_SegmentData::a3, "coefficient of x^3"},
    {"a4", &TO_Cam_Struct_SegmentData::a4, "coefficient of x^4"},
    {"a5", &TO_Cam_Struct_SegmentData::a5, "coefficient of x^5"},
    {"a6", &TO_Cam_Struct_SegmentData::a6, "coefficient of x^6"},
    {"sineAmplitude", &TO_Cam_Struct_SegmentData::sineAmplitude, "amplitude of the sine"},
    {"sinePeriod", &TO_Cam_Struct_SegmentData::sinePeriod, "its angular frequency [rad per leading unit]"},
    {"sinePhase", &TO_Cam_Struct_SegmentData::sinePhase, "its phase at the origin [rad]"},
    {"origin", &TO_Cam_Struct_SegmentData::Origin,
     "leading value from which coefficients and phase count; 0 if it is left out"}};

}  // namespace cam_fields

namespace cam_words {

inline constexpr std::string_view kClosed = "closed";  ///< of `cyclic`, beside true and false

inline constexpr std::string_view kElements[] = {"point",      "point group",  "line",      "sine",
                                                 "polynomial", "inverse sine", "transition"};
inline constexpr std::size_t kTransition = 6;  // among them
inline constexpr std::string_view kTypes[] = {"TO_Cam", "TO_Cam_10k"};
inline constexpr std::string_view kModes[] = {"linear", "cubic", "bezier"};
inline constexpr std::string_view kBoundaries[] = {"free", "velocity"};
inline constexpr std::string_view kGroupInterpolations[] = {"cubic", "bezier"};
inline constexpr std::string_view kMappings[] = {"points", "segments"};
inline constexpr std::string_view kMethods[] = {"system", "law"};
inline constexpr std::string_view kContinuities[] = {"position", "velocity", "acceleration", "jerk"};
inline constexpr std::string_view kGoals[] = {"none", "Cv", "Ca", "Cj", "Cmdyn"};

}  // namespace cam_words

namespace keys {

/// What defines a cam, in a cam file and in a technology object of a project alike.
inline constexpr Key kCamDefinition[] = {{"elements"}, {"optimization"}, {"points"}, {"segments"}, {"file"}};
inline constexpr Key kCamFile[] = {{"$schema"},  {"lockstep_cam", kRequired},
                                   {"name"},     {"description"},
                                   {"type"},     {"interpolation"},
                                   {"elements"}, {"optimization"},
                                   {"points"},   {"segments"},
                                   {"checks"}};
inline constexpr Key kCamInterpolation[] = {{"mode"}, {"boundary"}};
inline constexpr Key kCamOptimization[] = {{"continuity"}, {"goal"}};

}  // namespace keys

/// The keys of an element: of its numbers, its other members, and those that all have.
template <class T>
void add_keys(std::span<const CamNumber<T>> numbers, std::vector<Key>& keys) {
  for (const CamNumber<T>& number : numbers) keys.push_back({number.key, number.required});
}
inline void add_keys(std::span<const CamMember> members, std::vector<Key>& keys) {
  for (const CamMember& member : members) keys.push_back({member.key, member.required});
}

}  // namespace lockstep
