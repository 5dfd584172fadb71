/// The keys of technology objects: each type has keys of its own.
#pragma once

#include "projects/keys/linmot.hpp"
#include "projects/keys/mco305.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"
#include "tech_objects/sensing/probe_signal.hpp"
#include "tech_objects/switching/switched_output.hpp"

namespace lockstep::keys {

/// `type` and `config`, which all types have.
inline constexpr auto kType = key::selector("type", "published type");
constexpr auto configuration_of(std::string_view definition) {
  return key::defined("config", definition, "variables", "start values of the technology data block");
}

inline constexpr Word kCouplings[] = {{"setpoint", static_cast<int>(Coupling::setpoint)},
                                      {"actual", static_cast<int>(Coupling::actual)},
                                      {"delayed", static_cast<int>(Coupling::delayed)}};
inline constexpr auto kLeadingValue =
    key_table<LeadingValue>(key::object("to", kLeading, "name of the leading axis").needed(),
                            key::word("coupling", kCouplings, "how its value is taken")
                                .otherwise_is("setpoint; of an external encoder actual"));

inline constexpr auto kDriveKey =
    key::variants("drive", kDrives, "the drive of an axis that is not virtual (VirtualAxis.Mode 1)")
        .defined_as("drive");
inline constexpr auto kSpeedAxis = key_table<Axis>(kType, configuration_of("TO_SpeedAxis"), kDriveKey);
inline constexpr auto kPositioningAxis =
    key_table<Axis>(kType, configuration_of("TO_PositioningAxis"), kDriveKey);
inline constexpr auto kSynchronousAxisObject = key_table<Axis>(
    kType, configuration_of("TO_SynchronousAxis"), kDriveKey,
    key::structure("leading_values", kLeadingValue, "axes and encoders that this one may follow").list());

inline constexpr auto kEncoderObject =
    key_table<void>(kType, configuration_of("TO_ExternalEncoder"),
                    key::variants("encoder", kEncoders, "what it measures").needed());

inline constexpr auto kTelegramCounts = key_table<TelegramCountTags>(
    key::tag<&TelegramCountTags::received>("received", "ULINT tag: telegrams that have been taken over",
                                           Type::ULINT),
    key::tag<&TelegramCountTags::missing>("missing", "ULINT tag: those that have not come", Type::ULINT),
    key::tag<&TelegramCountTags::late>("late", "ULINT tag: those that have come behind later ones",
                                       Type::ULINT),
    key::tag<&TelegramCountTags::doubled>("doubled", "ULINT tag: those that were there already", Type::ULINT),
    key::tag<&TelegramCountTags::refused>(
        "refused",
        "ULINT tag: those from the future, of a source that has been restarted, or that no source sends",
        Type::ULINT),
    key::tag<&TelegramCountTags::malformed>("malformed", "ULINT tag: messages from the network that are none",
                                            Type::ULINT),
    key::tag<&TelegramCountTags::foreign>(
        "foreign", "ULINT tag: those of another area, sender, address or layout", Type::ULINT),
    key::tag<&TelegramCountTags::not_signed>("not_signed", "ULINT tag: those without the right code",
                                             Type::ULINT),
    key::tag<&TelegramCountTags::repeated>("repeated", "ULINT tag: those that had come already", Type::ULINT),
    key::tag<&TelegramCountTags::ambiguous>(
        "ambiguous", "ULINT tag: those that came while there were two senders", Type::ULINT),
    key::tag<&TelegramCountTags::stale>("stale", "ULINT tag: those older or newer than the clock allows",
                                        Type::ULINT),
    key::tag<&TelegramCountTags::untrusted>(
        "untrusted", "ULINT tag: those that came while the common clock was not to be trusted", Type::ULINT));
inline constexpr auto kProxyObject =
    key_table<void>(kType, configuration_of("TO_LeadingAxisProxy"),
                    key::structure("telegrams", kTelegramCounts, "where the counts of telegrams stand"));

inline constexpr auto kMarks = key_table<PrintMarks>(
    key::number<&PrintMarks::period>("period", {0.001, kFurthest}, "u", "distance from mark to mark")
        .needed(),
    key::number<&PrintMarks::offset>("offset", kPlace, "u", "beginning of a mark"),
    key::number<&PrintMarks::width>("width", kLength, "u",
                                    "of a mark, greater than 0 and less than the period")
        .otherwise_is("half the period"));
inline constexpr auto kMeasuringInputObject = key_table<void>(
    kType, configuration_of("TO_MeasuringInput"),
    key::object("assigned_to", kPositioned, "axis or external encoder whose position is measured").needed(),
    key::structure("marks", kMarks, "print marks that the input sees; or the tag of Interface.Address"));

inline constexpr auto kSwitchingTimes = key_table<SwitchingTimes>(
    key::tag<&SwitchingTimes::on>(
        "on", "LREAL tag: when the output has gone on last [s], more finely than in servo cycles",
        Type::LREAL),
    key::tag<&SwitchingTimes::off>("off", "LREAL tag: when it has gone off last [s]", Type::LREAL));
inline constexpr auto kAssignedTo =
    key::object("assigned_to", kPositioned, "axis or external encoder whose position switches").needed();
inline constexpr auto kSwitchingTimesKey =
    key::structure("switching_times", kSwitchingTimes, "where the times of the edges stand");
inline constexpr auto kOutputCamObject =
    key_table<void>(kType, configuration_of("TO_OutputCam"), kAssignedTo, kSwitchingTimesKey);
inline constexpr auto kCamTrackObject =
    key_table<void>(kType, configuration_of("TO_CamTrack"), kAssignedTo, kSwitchingTimesKey);

template <class Configuration>
consteval auto cam_keys(Configuration configuration) {
  return key_table<void>(
      kType, configuration,
      key::defined("elements", "cam_elements", "list of elements",
                   "curve elements and transitions (CAMS.md)"),
      key::defined("optimization", "cam_optimization", "object",
                   "of transitions that do not say it themselves"),
      key::defined("points", "cam_points", "list of points", "points of the data block, instead of elements"),
      key::defined("segments", "cam_segments", "list of segments",
                   "segments of the data block, instead of elements"),
      key::text("file", "cam file beside the project, instead of what else defines a cam"));
}
inline constexpr auto kCam = cam_keys(configuration_of("TO_Cam"));
inline constexpr auto kCam10k = cam_keys(configuration_of("TO_Cam_10k"));

/// The types, in the order of `kObjectKinds`.
inline constexpr KeyVariant kObjects[] = {{"TO_SpeedAxis", kSpeedAxis},
                                          {"TO_PositioningAxis", kPositioningAxis},
                                          {"TO_SynchronousAxis", kSynchronousAxisObject},
                                          {"TO_ExternalEncoder", kEncoderObject},
                                          {"TO_LeadingAxisProxy", kProxyObject},
                                          {"TO_MeasuringInput", kMeasuringInputObject},
                                          {"TO_OutputCam", kOutputCamObject},
                                          {"TO_CamTrack", kCamTrackObject},
                                          {"TO_Cam", kCam},
                                          {"TO_Cam_10k", kCam10k},
                                          {"MCO_305", kMco305},
                                          {"LinMot_Controller", kLinMot}};
static_assert(
    [] {
      for (std::size_t i = 0; i < std::size(kObjects); ++i)
        if (kObjects[i].name != kObjectKinds[i].name) return false;
      return std::size(kObjects) == std::size(kObjectKinds);
    }(),
    "a type of object without keys");

}  // namespace lockstep::keys
