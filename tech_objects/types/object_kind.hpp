/// The published kinds of technology objects.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lockstep {

/// Published types of technology objects; a bit each, so that a pin can name those it accepts.
enum class ObjectKind : std::uint32_t {
  TO_PositioningAxis = 1u << 0,
  TO_SynchronousAxis = 1u << 1,
  TO_ExternalEncoder = 1u << 8,
  TO_MeasuringInput = 1u << 9,
  TO_Cam = 1u << 2,
  TO_Cam_10k = 1u << 3,
  TO_SpeedAxis = 1u << 10,
  TO_OutputCam = 1u << 11,
  TO_CamTrack = 1u << 12,
  MCO_305 = 1u << 13,
  TO_LeadingAxisProxy = 1u << 14,
};

/// A set of object kinds.
using ObjectKinds = std::uint32_t;

constexpr ObjectKinds operator|(ObjectKind a, ObjectKind b) noexcept {
  return static_cast<ObjectKinds>(a) | static_cast<ObjectKinds>(b);
}
constexpr ObjectKinds operator|(ObjectKinds a, ObjectKind b) noexcept {
  return a | static_cast<ObjectKinds>(b);
}
constexpr bool among(ObjectKind kind, ObjectKinds kinds) noexcept {
  return (kinds & static_cast<ObjectKinds>(kind)) != 0;
}

inline constexpr ObjectKinds kAnyAxis = ObjectKind::TO_PositioningAxis | ObjectKind::TO_SynchronousAxis;
/// Axes without a position, too: what jobs take that concern a velocity.
inline constexpr ObjectKinds kAnyDrivenAxis = kAnyAxis | ObjectKind::TO_SpeedAxis;
inline constexpr ObjectKinds kSynchronousAxis = static_cast<ObjectKinds>(ObjectKind::TO_SynchronousAxis);
inline constexpr ObjectKinds kAnyCam = ObjectKind::TO_Cam | ObjectKind::TO_Cam_10k;
/// What has a position of its own: it is homed, measured and switches.
inline constexpr ObjectKinds kPositioned = kAnyAxis | ObjectKind::TO_ExternalEncoder;
/// What may lead a following axis.
inline constexpr ObjectKinds kLeading = kPositioned | ObjectKind::TO_LeadingAxisProxy | ObjectKind::MCO_305;
inline constexpr ObjectKinds kMeasuringInput = static_cast<ObjectKinds>(ObjectKind::TO_MeasuringInput);
inline constexpr ObjectKinds kOutputCam = static_cast<ObjectKinds>(ObjectKind::TO_OutputCam);
inline constexpr ObjectKinds kCamTrack = static_cast<ObjectKinds>(ObjectKind::TO_CamTrack);
/// What MC_Power enables.
inline constexpr ObjectKinds kPowered = kPositioned | ObjectKind::TO_SpeedAxis;
/// What MC_Reset acknowledges.
inline constexpr ObjectKinds kResettable =
    kPowered | ObjectKind::TO_LeadingAxisProxy | ObjectKind::TO_MeasuringInput | ObjectKind::TO_OutputCam |
    ObjectKind::TO_CamTrack | ObjectKind::TO_Cam | ObjectKind::TO_Cam_10k;

/// A published type and what it is, for messages and `describe`.
struct ObjectKindText {
  ObjectKind kind;
  std::string_view name;
  std::string_view text;
};

/// All kinds that a project may have, in the order in which `describe` lists them.
inline constexpr std::array kObjectKinds = {
    ObjectKindText{ObjectKind::TO_SpeedAxis, "TO_SpeedAxis", "Axis that is moved by its velocity alone."},
    ObjectKindText{ObjectKind::TO_PositioningAxis, "TO_PositioningAxis",
                   "Axis that is positioned; it may lead others."},
    ObjectKindText{ObjectKind::TO_SynchronousAxis, "TO_SynchronousAxis",
                   "Axis that is positioned or follows a leading value."},
    ObjectKindText{ObjectKind::TO_ExternalEncoder, "TO_ExternalEncoder",
                   "Encoder that moves nothing; it leads axes by its extrapolated actual value."},
    ObjectKindText{ObjectKind::TO_LeadingAxisProxy, "TO_LeadingAxisProxy",
                   "Leading axis of another controller, as the axes of this one follow it."},
    ObjectKindText{ObjectKind::TO_MeasuringInput, "TO_MeasuringInput",
                   "Input at whose edges the position of an axis or encoder is measured."},
    ObjectKindText{ObjectKind::TO_OutputCam, "TO_OutputCam",
                   "Output that is switched at positions of an axis or encoder."},
    ObjectKindText{ObjectKind::TO_CamTrack, "TO_CamTrack",
                   "Output that up to 32 cams switch along a track that repeats."},
    ObjectKindText{ObjectKind::TO_Cam, "TO_Cam", "Cam of up to 1000 points and 50 segments."},
    ObjectKindText{ObjectKind::TO_Cam_10k, "TO_Cam_10k", "Cam of up to 10000 points and 50 segments."},
    ObjectKindText{ObjectKind::MCO_305, "MCO_305",
                   "Motion controller VLT MCO 305 with its axis and its programs in APOSS."},
};

/// Published name, such as "TO_SynchronousAxis".
constexpr std::string_view kind_name(ObjectKind kind) noexcept {
  for (const ObjectKindText& known : kObjectKinds)
    if (known.kind == kind) return known.name;
  return {};
}

}  // namespace lockstep
