/// A project in memory, with all that its file says.
/// @source contract of the project file, sections 1, 2, 5, 6
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "hmi_bridge/audit/file.hpp"
#include "hmi_bridge/lcm/command_desk.hpp"
#include "hmi_bridge/modbus/map.hpp"
#include "hmi_bridge/modbus/options.hpp"
#include "hmi_bridge/network/network.hpp"
#include "hmi_bridge/retain/kept_value.hpp"
#include "hmi_bridge/studio/config.hpp"
#include "hmi_bridge/traces/channel.hpp"
#include "hmi_bridge/traces/columns.hpp"
#include "hmi_bridge/traces/flight_recorder.hpp"
#include "projects/expressions/element_path.hpp"
#include "projects/expressions/names.hpp"
#include "projects/json/problem.hpp"
#include "projects/json/text_file.hpp"
#include "projects/loader/expectation.hpp"
#include "projects/loader/network_coupling.hpp"
#include "scheduler/controller.hpp"
#include "scheduler/transfer_area.hpp"
#include "tech_objects/linmot/ascii_line.hpp"

namespace lockstep {

/// The entries of a map that one of its lines has made, one for each element of an array.
struct ModbusArray {
  ElementPath elements;
  std::size_t first;  ///< index of the first element's entry in the map; the others follow
};

/// The entries of a map that show a text, two characters each.
struct ModbusText {
  const StringTag* tag;
  std::size_t first;  ///< index of the first entry in the map; the others follow

  std::size_t count() const noexcept { return (tag->text.capacity + 1) / 2; }
};

/// A map, and for whom it is.
struct ModbusMapConfig {
  std::optional<std::size_t> server;  ///< index of the server whose own it is; none: of those without any
  std::optional<std::uint8_t> unit;   ///< none: of all unit ids that have none of their own
  ModbusMap map;
  std::vector<ModbusArray> arrays{};
  std::vector<ModbusText> texts{};
};

/// A client with the signals of its image.
struct ModbusClientConfig {
  ModbusClientOptions options;
  std::vector<NamedSignal> signals;
};

/// A tag that a watchdog looks at or writes.
struct WatchdogTag {
  enum class Role : std::uint8_t { heartbeat, status, set };
  Signal signal;
  Role role = Role::heartbeat;
};

struct ModbusConfig {
  std::vector<ModbusServerOptions> servers;  ///< none: the project has no server
  std::vector<NamedSignal> signals;          ///< of the process image, to which the entries of the maps refer
  std::vector<ModbusClientConfig> clients;
  std::vector<WatchdogTag> watchdog_tags;  ///< what watchdogs have in their hands
  std::deque<ModbusMapConfig> maps;        ///< the first one is the project's map of all unit ids

  /// The maps that a server has: its own, else the common ones. Pointers into `maps`.
  /// @param server index; none, or one that is not there: the common ones
  std::vector<const ModbusMapConfig*> maps_of(std::optional<std::size_t> server) const;
  /// The maps that a server serves; this outlives them.
  ModbusUnits units_of(std::size_t server) const;
  /// The signal of an entry under its name; a diagnostic is called "diagnostic.NAME", and one of the server
  /// itself has no place in memory.
  NamedSignal signal_of(const ModbusEntry& entry) const;
};

/// A channel of its own with some of the signals, fewer of the rows, or only those around an occasion.
struct TraceChannelConfig {
  std::string channel;
  std::vector<NamedSignal> signals;  ///< each name once
  TraceSelection selection;
  std::optional<NamedSignal> occasion;  ///< the signal of the trigger; none: an alarm, or no trigger
};

struct TraceConfig {
  std::string url;  ///< empty: the project has no LCM trace
  std::string channel;
  std::vector<NamedSignal> signals;  ///< each name once
  std::vector<TraceChannelConfig> channels;
};

/// What commands write of one axis, and what of it has been carried out. Only the cycle touches it.
struct PanelInputs {
  BOOL Enable{}, Forward{}, Backward{};
  UDINT Beat{}, Homings{}, Resets{}, Overrides{};  ///< counts, which ask by changing
  LREAL JogVelocity{}, HomePosition{}, Override{};
  UDINT SeenBeat{}, SeenHomings{}, SeenResets{}, SeenOverrides{};
  UDINT Stops{}, Starts{};  ///< counts, of a device alone
  LREAL Program{};
  LREAL NoPosition{};  ///< stands for the position of a speed axis
};

/// Axes that take commands; none unless the project says so.
struct CommandsConfig {
  std::vector<CommandAxis> axes;
  std::deque<PanelInputs> inputs;  ///< of the axes; where they are they stay
};

/// What is kept for the time before an alarm.
struct FlightRecorderConfig {
  FlightRecorderOptions options;     ///< `file` as the project has it, which may be relative
  std::vector<NamedSignal> signals;  ///< each name once
};

/// What is kept across runs.
struct RetainConfig {
  std::vector<KeptValue> values;  ///< tags and arrays with "retain", and adjustments of absolute encoders
  std::vector<const ArrayTag*> arrays;                          ///< those among the values
  std::string file;                                             ///< empty: the project does not say
  std::chrono::nanoseconds interval = std::chrono::seconds(1);  ///< between two writes
};

/// A loaded project.
struct Project {
  std::string name;
  std::string description;
  std::unique_ptr<Controller> controller;
  Names names;                   ///< of everything in the controller, for signals named on the command line
  bool stop_on_overrun = false;  ///< "overrun": "stop"
  ModbusConfig modbus;
  TraceConfig trace;
  CommandsConfig commands;
  RetainConfig retain;
  std::deque<linmot::AsciiLine> ascii_lines;            ///< to LinMot controllers
  std::vector<TransferArea> transfer_areas;             ///< within the controller
  std::vector<NetworkCoupling> couplings;               ///< to other processes, in real time
  SentTelegramTags sent_tags;                           ///< of those
  std::optional<FlightRecorderConfig> flight_recorder;  ///< none: the project has none
  std::optional<AuditOptions> audit;                    ///< none: the project has no audit log
  Expectations expectations;                            ///< of a simulated run
  StudioConfig studio;
  Program* panel = nullptr;  ///< that carries commands out; nullptr: no axis takes any
};

/// What a project is loaded for.
enum class LoadedFor : std::uint8_t {
  running,  ///< its objects are readied for the clock
  looking   ///< it is valid or not; nothing is to be done with its controller, which has no axes
};

/// The names, in lower case, of what something outside of a project uses in it: a system of several
/// controllers its proxies and leading objects.
using UsedOutside = std::unordered_set<std::string>;

}  // namespace lockstep
