/// The keys of a project file, from its root on.
#pragma once

#include "hmi_bridge/audit/file.hpp"
#include "hmi_bridge/lcm/channel_length.hpp"
#include "hmi_bridge/studio/config.hpp"
#include "hmi_bridge/traces/channel.hpp"
#include "hmi_bridge/traces/flight_recorder.hpp"
#include "projects/keys/modbus.hpp"
#include "projects/keys/network.hpp"
#include "projects/keys/objects.hpp"
#include "projects/keys/parts.hpp"
#include "projects/keys/priority.hpp"
#include "scheduler/controller.hpp"
#include "scheduler/transfer_area.hpp"

namespace lockstep::keys {

inline constexpr double kShortestServoCycle = 1e3;  // what a call of the system's clock takes some of [ns]
inline constexpr Word kOverruns[] = {{"report", 0}, {"stop", 1}};
inline constexpr auto kClock = key_table<Clock>(
    key::duration<&Clock::servo_cycle>("servo_cycle", {kShortestServoCycle, kLongestServoCycle},
                                       "period of MC_Servo")
        .needed(),
    key::integer<&Clock::interpolator_ratio>("interpolator_ratio", {1, 32},
                                             "servo cycles per interpolator cycle"),
    key::integer<&Clock::processors>("processors", {1, Clock::kMaximumProcessors},
                                     "that a tick uses for the axes, where there are many"),
    key::word("overrun", kOverruns, "what three overruns in a row do").otherwise_is("report"));

inline constexpr auto kTag = key_table<void>(
    key::defined(
        "type", "tag_type", "type",
        "elementary type, STRING[n], or ARRAY[lower..upper] OF an elementary type or of a structure of cams")
        .needed(),
    key::defined("init", "initial_value", "constant",
                 "value at the start; of an array [element, ...] from the first one on"),
    key::boolean("retain", "kept across runs").otherwise_is("false"));

inline constexpr Word kObs[] = {word_for("MC_PreServo", Ob::MC_PreServo),
                                word_for("MC_PostServo", Ob::MC_PostServo),
                                word_for("MC_PreInterpolator", Ob::MC_PreInterpolator),
                                word_for("Cyclic", Ob::Cyclic), word_for("Main", Ob::Main)};
inline constexpr auto kProgram = key_table<void>(
    key::text("name", "name of the program").needed(),
    key::word("ob", kObs, "organization block in which it runs").needed(),
    key::duration("cycle", {1, kDay}, "period of a Main or Cyclic program, a whole multiple of servo_cycle"),
    key::integer("priority", {kLowestPriority, kHighestPriority},
                 "of a Cyclic program; the higher runs first")
        .otherwise_is("8"),
    key::defined("calls", "call", "call", "what runs, in this order").list().needed());
inline constexpr auto kCall = key_table<void>(
    key::defined("fb", "function_block", "name of a function block", "function block").needed(),
    key::text("name", "name of the instance").needed(),
    key::constant("in", "pin: value, expression or technology object").named());
inline constexpr auto kSet =
    key_table<void>(key::signal("set", "tag or writable variable to assign to").needed(),
                    key::constant("to", "value or expression").needed());
inline constexpr auto kSetStart = key_table<void>(
    key::signal("set_start", "variable whose start value is changed; it counts with a restart by MC_Reset")
        .needed(),
    key::constant("to", "value or expression").needed());
inline constexpr auto kIf =
    key_table<void>(key::constant("if", "BOOL value or expression").needed(),
                    key::defined("then", "call", "call", "what runs if it is TRUE").list().needed(),
                    key::defined("else", "call", "call", "what runs if it is FALSE").list());

inline constexpr auto kStimulus =
    key_table<void>(key::duration("at", {0, kAny.highest}, "time since the start").needed(),
                    key::constant("set", "tag: value").named(),
                    key::structure("ascii", kScriptedCommand, "a command on a line to LinMot controllers"));

constexpr auto signals_key(std::string_view text) {
  return key::signal("signals", text).list();
}
inline constexpr auto kCommandAxis =
    key_table<void>(key::number("jog_velocity", kAboveZero, "",
                                "highest velocity of jogging, in the unit of the axis' velocities")
                        .otherwise_is("DynamicDefaults.Velocity"));
inline constexpr auto kCommands =
    key_table<void>(key::structure("axes", kCommandAxis,
                                   "name of an axis, a speed axis too: its limits; of an MCO_305, "
                                   "whose program is started and stopped: {}")
                        .named()
                        .needed());
inline constexpr auto kChannel =
    key::title("channel", "channel of the rows").up_to(kLongestTraceChannel).needed();
inline constexpr auto kLcm = key_table<void>(
    key::text("url", "network, such as udpm://239.255.76.67:7667?ttl=0").of_form(kLcmUrlForm).needed(),
    kChannel,
    key::structure("commands", kCommands, "axes that take commands from panels").otherwise_is("none does"));

inline constexpr double kLongestBefore = 600e9;  // [ns]
inline constexpr Word kTriggers[] = {
    word_for("above", TriggerKind::above), word_for("below", TriggerKind::below),
    word_for("rising", TriggerKind::rising), word_for("falling", TriggerKind::falling),
    word_for("alarm", TriggerKind::alarm)};
inline constexpr auto kTrigger = key_table<TraceSelection>(
    key::word<&TraceSelection::trigger>("on", kTriggers,
                                        "above, below: rows with the signal beyond the level; rising, "
                                        "falling: around the row in which it passes "
                                        "the level; alarm: around an alarm")
        .needed(),
    key::signal("signal", "tag, instance.Pin, variable"),
    key::number<&TraceSelection::level>("level", {-1e300, 1e300}, "", "of the signal"),
    key::duration<&TraceSelection::before>("before", {0, kLongestBefore},
                                           "of which the rows before count as well"),
    key::duration<&TraceSelection::after>("after", {0, kHour}, "of which the rows after count as well"));
inline constexpr auto kTraceChannel = key_table<TraceSelection>(
    kChannel, signals_key("columns").needed(),
    key::integer<&TraceSelection::every>("every", {1, 1e9}, "only each n-th row"),
    key::group<TraceSelection>("trigger", kTrigger, "only the rows at an occasion"));
inline constexpr auto kTrace = key_table<void>(
    key::structure("lcm", kLcm, "the network on which the trace goes out"),
    signals_key("columns of the trace"),
    key::structure("channels", kTraceChannel, "further channels of LCM, each with a part of the trace")
        .list());

inline constexpr auto kFlightRecorder = key_table<FlightRecorderOptions>(
    key::duration<&FlightRecorderOptions::before>("before", {1, kLongestBefore},
                                                  "how much is kept for the time before an alarm")
        .needed(),
    key::duration<&FlightRecorderOptions::after>("after", {0, kHour}, "how much is added behind it"),
    key::title<&FlightRecorderOptions::file>(
        "file",
        "FILE_20261123T115200Z_17.csv and its like are written, one for each alarm: time (UTC) and a number "
        "that "
        "goes on from run to run; relative to the project file, in a service to its state directory")
        .needed(),
    key::integer<&FlightRecorderOptions::files>("files", {1, 1000}, "at most so many in a run"),
    key::integer<&FlightRecorderOptions::keep>(
        "keep", {1, 10'000}, "so many stay, those of earlier runs among them; the oldest are removed"),
    signals_key("what is kept").otherwise_is("everything that may change"));

inline constexpr auto kRetain = key_table<void>(
    key::text("file", "where kept values stand, relative to the project file"),
    key::duration("interval", {kMilli, kHour}, "between two writes of changed values").otherwise_is("1s"));

inline constexpr auto kAudit = key_table<AuditOptions>(
    key::title<&AuditOptions::file>("file", "one JSON object a line for each write and command from outside")
        .needed(),
    key::integer<&AuditOptions::size>("size", {4096, 1099511627776.0},
                                      "of a file, behind which the next one begins")
        .of("byte"),
    key::integer<&AuditOptions::files>("files", {2, 1000},
                                       "in all: FILE, FILE.1 and so on; the oldest gives way"));

inline constexpr auto kStudio = key_table<StudioConfig>(
    key::text<&StudioConfig::listen>("listen", "where a browser sees the run, such as 127.0.0.1:8780")
        .of_form(kEndpointForm)
        .otherwise_is("nowhere unless --studio says so"),
    key::boolean<&StudioConfig::write>("write", "it may write, and command the axes of 'commands'"),
    key::text("allow", "from which clients may come, such as 192.168.1.0/24")
        .of_form(kNetworkForm)
        .list()
        .otherwise_is("from everywhere"),
    key::duration<&StudioConfig::history>("history", {1e9, kHour}, "of the run that is kept for it"),
    key::structure("commands", kCommands, "axes that take commands of the studio").otherwise_is("none does"));

inline constexpr auto kExpectation = key_table<void>(
    key::duration("at", {0, kDay}, "time since the start").otherwise_is("at the end"),
    key::text("expect", "BOOL expression; with value that of a number").needed(),
    key::number("value", kFinite, "", "that the number is to have"),
    key::number("tolerance", {0.0, 1e300}, "", "by which it may differ").otherwise_is("0"),
    key::title("text", "what it means, for whoever reads the result").otherwise_is("the expression"));

inline constexpr int kVersions[] = {1};
inline constexpr Word kTransferDirections[] = {{"within", static_cast<int>(TransferDirection::within)},
                                               {"send", static_cast<int>(TransferDirection::send)},
                                               {"receive", static_cast<int>(TransferDirection::receive)}};
inline constexpr auto kTransferArea = key_table<TransferArea>(
    key::word<&TransferArea::direction>("direction", kTransferDirections,
                                        "whether its other end is in another process, and which one"),
    key::object("from", kPositioned,
                "axis or external encoder that provides its leading value; not with 'receive'")
        .otherwise_is("has to be given but with 'receive'"),
    key::integer<&TransferArea::interface>("interface", {1.0, 8.0},
                                           "which CrossPlcSynchronousOperation.Interface provides it"),
    key::object("to", kLeadingAxisProxy,
                "leading axis proxy that takes it, or several of them; not with 'send'")
        .one_or_list()
        .otherwise_is("has to be given but with 'send'"),
    key::title<&TransferArea::channel>(
        "channel", "of the network, but with 'within'; of an area of a system SYSTEM.AREA")
        .up_to(kLongestLcmChannel)
        .otherwise_is("the name of the area"),
    key::title<&TransferArea::controller>("controller", "that sends, with 'receive'")
        .otherwise_is("has to be given with 'receive'"),
    key::title<&TransferArea::source>("source", "its leading object, with 'receive'")
        .otherwise_is("has to be given with 'receive'"),
    key::text("address", "of the sender, or several of them, with 'receive'")
        .of_form(kSenderForm)
        .one_or_list()
        .otherwise_is("any"));

inline constexpr auto kSentTelegrams = key_table<SentTelegramTags>(
    key::tag<&SentTelegramTags::sent>("sent", "ULINT tag: telegrams that the network has taken", Type::ULINT),
    key::tag<&SentTelegramTags::failed>("failed", "ULINT tag: those that it has not taken", Type::ULINT),
    key::tag<&SentTelegramTags::dropped>("dropped", "ULINT tag: those for which there was no space left",
                                         Type::ULINT),
    key::tag<&SentTelegramTags::clock_losses>(
        "clock_losses",
        "ULINT tag: times at which the clock that all controllers share has jumped, or was not kept in step "
        "any more",
        Type::ULINT));

inline constexpr auto kProject = key_table<void>(
    kSchema, kInclude, key::one_of("lockstep", kVersions, "version of the format").needed(),
    key::title("name", "name of the project").needed(), key::text("description", "what the project does"),
    key::structure("clock", kClock, "when things run").needed(),
    key::variants("technology_objects", kObjects, "name: technology object").named(),
    key::structure("transfer_areas", kTransferArea, "name: path of a leading value to proxies").named(),
    key::structure("network", kProjectNetwork,
                   "by which telegrams of transfer areas travel to other processes"),
    key::structure("telegrams", kSentTelegrams,
                   "where the counts of telegrams stand that go out over networks, in real time"),
    key::structure("tags", kTag, "name: tag").named().defined_as("tags"),
    key::structure("programs", kProgram, "programs").list(),
    key::structure("ascii", kAsciiLine, "lines to LinMot controllers").list(),
    key::structure("stimuli", kStimulus, "what comes from outside in a simulation").list(),
    key::structure("modbus", kModbus, "servers and foreign devices"),
    key::structure("trace", kTrace, "what is recorded and sent"),
    key::structure("retain", kRetain, "what is kept across runs"),
    key::structure("flight_recorder", kFlightRecorder, "keeps what happened before an alarm"),
    key::structure("audit", kAudit, "who has written or commanded what"),
    key::structure("studio", kStudio, "where a browser sees the run, and what it may do"), kTemplates,
    kInstances, key::structure("expectations", kExpectation, "what lockstep test looks at").list(),
    key::duration("duration", {1, kDay}, "how long lockstep test simulates")
        .otherwise_is("to the last expectation with a time"));

}  // namespace lockstep::keys
