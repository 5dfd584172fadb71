/// The keys of the project file, for the loader, its messages and the schema alike.
/// @source contract of the project file, section 1
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {

struct Key {
  std::string_view name;
  bool required = false;
};

/// The keys of one kind of object.
using Keys = std::span<const Key>;

namespace keys {

inline constexpr bool kRequired = true;

inline constexpr Key kProject[] = {{"lockstep", kRequired},
                                   {"name", kRequired},
                                   {"description"},
                                   {"clock", kRequired},
                                   {"technology_objects"},
                                   {"tags"},
                                   {"programs"},
                                   {"stimuli"},
                                   {"modbus"},
                                   {"trace"},
                                   {"retain"},
                                   {"flight_recorder"},
                                   {"audit"}};
inline constexpr Key kClock[] = {
    {"servo_cycle", kRequired}, {"interpolator_ratio"}, {"processors"}, {"overrun"}};
inline constexpr Key kObject[] = {{"type", kRequired}, {"config"}, {"drive"}, {"leading_values"}};
inline constexpr Key kEncoderObject[] = {{"type", kRequired}, {"config"}, {"encoder", kRequired}};
inline constexpr Key kEncoder[] = {
    {"model", kRequired}, {"follows"}, {"ratio"},      {"signal"},       {"valid"}, {"wrap"},
    {"resolution"},       {"noise"},   {"zero_marks"}, {"reference_cam"}};
inline constexpr Key kMeasuringInputObject[] = {
    {"type", kRequired}, {"config"}, {"assigned_to", kRequired}, {"marks"}};
inline constexpr Key kOutputCamObject[] = {
    {"type", kRequired}, {"config"}, {"assigned_to", kRequired}, {"switching_times"}};
inline constexpr Key kSwitchingTimes[] = {{"on"}, {"off"}};
inline constexpr Key kMarks[] = {{"period", kRequired}, {"offset"}, {"width"}};
inline constexpr Key kCam[] = {{"type", kRequired}, {"config"},   {"elements"}, {"optimization"},
                               {"points"},          {"segments"}, {"file"}};
inline constexpr Key kDrive[] = {{"model", kRequired},
                                 {"time_constant"},
                                 {"dead_time"},
                                 {"encoder_resolution"},
                                 {"inverted"},
                                 {"start_position"},
                                 {"zero_marks"},
                                 {"reference_cam"},
                                 {"limit_switches"},
                                 {"digital_inputs"},
                                 {"quick_stop_deceleration"},
                                 {"plant"},
                                 {"faults"},
                                 {"position_cycle"},
                                 {"sensors"}};
inline constexpr Key kSensor[] = {{"sensor", kRequired}, {"ratio"},          {"resolution"},
                                  {"inverted"},          {"start_position"}, {"fault"}};
inline constexpr Key kPlant[] = {
    {"inertia", kRequired}, {"friction"}, {"load_torque"}, {"maximum_torque"}, {"fixed_stop"}};
inline constexpr Key kFixedStop[] = {{"position", kRequired}, {"stiffness", kRequired}, {"direction"}};
inline constexpr Key kFaults[] = {{"drive"}, {"encoder"}, {"communication"}, {"blocked"}};
inline constexpr Key kZeroMarks[] = {{"position", kRequired}, {"period"}};
inline constexpr Key kLimitSwitches[] = {{"min"}, {"max"}};
inline constexpr Key kDigitalInput[] = {{"tag", kRequired}, {"range", kRequired}};
inline constexpr Key kLeadingValue[] = {{"to", kRequired}, {"coupling"}};
inline constexpr Key kTag[] = {{"type", kRequired}, {"init"}, {"retain"}, {"comment"}};
inline constexpr Key kProgram[] = {
    {"name", kRequired}, {"ob", kRequired}, {"cycle"}, {"priority"}, {"calls", kRequired}};
inline constexpr Key kCall[] = {{"fb", kRequired}, {"name", kRequired}, {"in"}};
inline constexpr Key kSet[] = {{"set", kRequired}, {"to", kRequired}};
inline constexpr Key kSetStart[] = {{"set_start", kRequired}, {"to", kRequired}};
inline constexpr Key kIf[] = {{"if", kRequired}, {"then", kRequired}, {"else"}};
inline constexpr Key kStimulus[] = {{"at", kRequired}, {"set", kRequired}};
inline constexpr Key kModbus[] = {{"server"}, {"map"}, {"watchdog"}, {"units"}, {"clients"}};
inline constexpr Key kServer[] = {{"listen"},       {"serial"},
                                  {"unit"},         {"allow"},
                                  {"max_clients"},  {"max_requests_per_second"},
                                  {"idle_timeout"}, {"map"},
                                  {"units"},        {"max_clients_per_address"},
                                  {"watchdog"}};
inline constexpr Key kSerial[] = {{"device", kRequired}, {"baud"}, {"parity"}, {"stop_bits"}, {"silence"}};
inline constexpr Key kClient[] = {{"connect"}, {"serial"}, {"timeout"}, {"devices", kRequired}};
inline constexpr Key kDevice[] = {
    {"name", kRequired}, {"unit"}, {"cycle", kRequired}, {"quality"}, {"age"}, {"read"}, {"write"}};
inline constexpr Key kDeviceEntry[] = {{"tag", kRequired},
                                       {"table", kRequired},
                                       {"address", kRequired},
                                       {"type"},
                                       {"word_order"},
                                       {"byte_order"},
                                       {"bit"},
                                       {"scale"},
                                       {"offset"},
                                       {"quality"},
                                       {"age"}};
inline constexpr Key kUnit[] = {{"unit", kRequired}, {"map", kRequired}, {"watchdog"}};
inline constexpr Key kWatchdog[] = {{"tag", kRequired}, {"timeout", kRequired}, {"set"}, {"status"}};
inline constexpr Key kMapEntry[] = {{"tag"},
                                    {"diagnostic"},
                                    {"table", kRequired},
                                    {"address", kRequired},
                                    {"type"},
                                    {"word_order"},
                                    {"byte_order"},
                                    {"bit"},
                                    {"scale"},
                                    {"offset"},
                                    {"access"}};
inline constexpr Key kTrace[] = {{"lcm"}, {"signals"}, {"channels"}};
inline constexpr Key kTraceChannel[] = {
    {"channel", kRequired}, {"signals", kRequired}, {"every"}, {"trigger"}};
inline constexpr Key kTrigger[] = {{"on", kRequired}, {"signal"}, {"level"}, {"before"}, {"after"}};
inline constexpr Key kFlightRecorder[] = {
    {"before", kRequired}, {"after"}, {"file", kRequired}, {"files"}, {"keep"}, {"signals"}};
inline constexpr Key kRetain[] = {{"file"}, {"interval"}};
inline constexpr Key kAudit[] = {{"file", kRequired}, {"size"}, {"files"}};
inline constexpr Key kLcm[] = {{"url", kRequired}, {"channel", kRequired}, {"commands"}};
inline constexpr Key kCommands[] = {{"axes", kRequired}};
inline constexpr Key kCommandAxis[] = {{"jog_velocity"}};

}  // namespace keys

/// Priorities of a Cyclic program.
inline constexpr int kLowestPriority = 1;
inline constexpr int kHighestPriority = 26;

namespace words {

inline constexpr std::string_view kOverrun[] = {"report", "stop"};
inline constexpr auto kObjectTypes = [] {
  std::array<std::string_view, kObjectKinds.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kObjectKinds[i].name;
  return names;
}();
inline constexpr std::string_view kModels[] = {"simulated"};
inline constexpr std::string_view kDirections[] = {"positive", "negative"};
inline constexpr std::string_view kCouplings[] = {"setpoint", "actual"};
inline constexpr std::string_view kObs[] = {"MC_PreServo", "MC_PostServo", "MC_PreInterpolator", "Cyclic",
                                            "Main"};
inline constexpr std::string_view kTables[] = {"coil", "discrete_input", "input_register",
                                               "holding_register"};
inline constexpr std::string_view kWordOrders[] = {"big", "little"};
inline constexpr std::string_view kParities[] = {"none", "even", "odd"};
inline constexpr std::string_view kTriggers[] = {"above", "below", "rising", "falling", "alarm"};
inline constexpr std::string_view kAccesses[] = {"read", "write"};

}  // namespace words
}  // namespace lockstep
