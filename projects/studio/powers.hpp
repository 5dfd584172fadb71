/// What pages may do besides looking, and through what they do it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/audit/log.hpp"
#include "hmi_bridge/lcm/shared_desk.hpp"
#include "hmi_bridge/traces/event.hpp"
#include "projects/json/problem.hpp"
#include "projects/studio/api.hpp"
#include "projects/studio/cam_answers.hpp"
#include "projects/studio/trace_files.hpp"

namespace lockstep {

/// Where a studio runs: it decides what can be done there.
enum class StudioMode : std::uint8_t {
  machine,  ///< beside a run
  desk,     ///< it drives a simulation of its own
  files     ///< it has no project, only traces
};

/// A simulation that its studio drives.
class StudioSimulation {
 public:
  virtual ~StudioSimulation() = default;
  /// How it stands, for pages. Thread: the server's.
  virtual studio_api::Json state() const = 0;
  /// Obeys `POST /api/simulation`. @return how it stands then @throws studio_api::BadRequest
  virtual studio_api::Json obey(const studio_api::Json& request) = 0;
  /// If no tick goes on until it comes back, calls `act` with the number of the next tick. Thread: the
  /// server's.
  /// @return whether it was called
  virtual bool while_paused(const std::function<void(std::int64_t tick)>& act) = 0;
};

/// Given once, before the first request; what it points to outlives the session.
struct StudioPowers {
  StudioMode mode = StudioMode::machine;
  std::string why_no_write = "this studio only reads; --studio-write lets it write";  ///< empty: it may
  std::string why_no_command =
      "this studio only reads; --studio-write lets it command";  ///< empty: it may command axes of the desk
  std::string why_no_files = "files are kept at the desk alone, with lockstep studio";  ///< empty: it may
  SharedDesk* desk = nullptr;              ///< nullptr: no axis takes commands
  AuditLog* audit = nullptr;               ///< nullptr: there is none
  StudioSimulation* simulation = nullptr;  ///< nullptr: there is none
  std::function<void(TraceEvent)> tell;    ///< an event of the studio, to all who hear events
  std::function<std::string()> health;     ///< a JSON object; empty: nothing is known
  std::function<std::optional<std::string>(const std::string&)> describe;  ///< as `lockstep describe --json`
  /// Hears of each batch of writes that a tick has applied, as it was asked for; nullptr: nobody does.
  std::function<void(std::int64_t tick, const std::string& body)> journal;
  StudioTraceFiles* files = nullptr;  ///< traces that pages give; nullptr: none are taken
  std::string trace_folder;           ///< in or below which pages name traces by path; empty: nowhere
  std::string project_file;           ///< that pages read and write, with its cams; empty: there is none
  std::string project_folder;         ///< of files that the project names; empty: it names none
  std::vector<StudioCam> cams;        ///< files that were given beside it
  std::string project_text;           ///< of the project, whole; empty: it is not known
  std::vector<Problem> warnings;      ///< of the loader
};

namespace studio_api {

Json rights_json(const StudioPowers& powers);
Json reasons_json(const StudioPowers& powers);
std::string_view mode_name(StudioMode mode) noexcept;

}  // namespace studio_api
}  // namespace lockstep
