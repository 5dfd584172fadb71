/// The system file: several controllers, each with a project of its own, and the leading values between
/// them.
/// @source S7-1500T synchronous operation V7, chapter 10
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/keys/system.hpp"
#include "projects/loader/project.hpp"

namespace lockstep {

/// A project in a system.
struct SystemController {
  std::string name;
  std::string file;                    ///< of the project, as it can be opened
  std::int64_t phase = 0;              ///< of its ticks behind whole cycles of the common time [ns]
  std::vector<IpNetwork> addresses{};  ///< from which its telegrams come, in real time; empty: any
  Project project;
};

/// By which interface of a leading object telegrams go to proxies of other controllers, or of its own.
struct SystemArea {
  struct Receiver {
    std::size_t controller = 0;  ///< index
    LeadingAxisProxy* proxy = nullptr;
  };

  std::string name;
  std::size_t controller = 0;  ///< of the source, index
  LeadingObject* from = nullptr;
  int interface = 1;
  std::vector<Receiver> to;
};

/// What the calculation of delays does not touch.
struct KeptDelays {
  struct Axis {
    std::size_t controller = 0;
    TechnologyObject* object = nullptr;
  };
  std::vector<Axis> fixed;     ///< objects whose delay stays as it is
  std::vector<Axis> left_out;  ///< following axes whose interconnections with proxies do not count
};

struct System {
  std::string name;
  std::string description;
  std::vector<SystemController> controllers;  ///< in the order of the file
  std::vector<SystemArea> areas;
  NetworkConfig network;  ///< in real time
  SimulatedNetwork simulated_network;
  KeptDelays delays;

  /// The index of a controller, without regard to case; none: there is no such controller.
  std::optional<std::size_t> find(std::string_view controller) const;
  /// By which telegrams of an area travel in real time: SYSTEM.AREA.
  std::string channel_of(const SystemArea& area) const;
};

/// What loading gives: a system if there are no problems. A problem of a project names its file.
struct LoadedSystem {
  std::optional<System> system;
  std::vector<Problem> problems;
  std::vector<Problem> warnings;
};

/// What to do with proxies that have several sources.
enum class SeveralSources : std::uint8_t {
  refused,
  kept  ///< as for an overview, which shows them
};

/// What to do with the project of a controller before its objects take over their start values.
using PrepareController = std::function<void(Project&, const SystemController&)>;

/// A system has no more controllers.
inline constexpr std::size_t kMaximumControllers = 1000;

/// Loads a system and the projects of its controllers. Allocates.
/// @throws UnreadableFile for the system file itself; that a project cannot be read is a problem
LoadedSystem load_system_file(const std::string& path, LoadedFor use = LoadedFor::running,
                              SeveralSources sources = SeveralSources::refused);

/// Loads a system of which one controller is to run here, in real time, coupled to the others by the network:
/// those are looked at only.
/// @param controller its name, without regard to case; of one that there is not nothing runs
/// @param prepare of its project, before its objects take over their start values
/// @throws as `load_system_file`, and what `prepare` throws
LoadedSystem load_controller_of(const std::string& path, std::string_view controller,
                                const PrepareController& prepare = {});

/// Whether a text looks like a system file: an object with the key `lockstep_system`.
bool is_system(std::string_view text);
/// Whether a file looks like a system file; one that cannot be read does not.
bool is_system_file(const std::string& path);

/// Where the leading object `object` of a controller stands in messages: "PLC_1.Conveyor".
std::string full_name(const SystemController& controller, const TechnologyObject& object);

}  // namespace lockstep
