// What pages ask of the project and of how the run goes.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "projects/loader/simulation.hpp"
#include "projects/studio/api_values.hpp"
#include "projects/studio/cam_answers.hpp"
#include "projects/studio/couplings.hpp"
#include "projects/studio/project_answers.hpp"
#include "projects/studio/session.hpp"

namespace lockstep {
namespace {

using namespace studio_api;

/// What stands behind a path with one more part; empty: it is another path.
std::string behind(const StudioRequest& request, std::string_view path) {
  return request.path.starts_with(path) ? request.path.substr(path.size()) : "";
}

}  // namespace

StudioAnswer StudioSession::answer_project(const StudioRequest& request) const {
  if (request.path == "/api/health") {
    Json health = Json::parse(powers_.health ? powers_.health() : "{}");
    health["tap"] = {{"signals", feed_.store().signals().size()},
                     {"dropped", feed_.dropped()},
                     {"bytes", feed_.store().bytes()}};
    if (!tap_cost_.told().is_null()) health["tap"].update(tap_cost_.told());
    health["pages"] = pages_.size();
    health["events_lost"] = inbox_->lost();
    return answer_of(health);
  }
  if (request.path == "/api/simulation")
    return powers_.simulation != nullptr ? answer_of(powers_.simulation->state())
                                         : error_answer(404, "not_found", "this run goes on by itself");
  if (request.path == "/api/describe" || request.path.starts_with("/api/describe/")) {
    const std::optional<std::string> told =
        powers_.describe ? powers_.describe(behind(request, "/api/describe/")) : std::nullopt;
    if (!told) return error_answer(404, "not_found", "there is nothing of this name to describe");
    StudioAnswer answer;
    answer.body = *told;
    return answer;
  }
  if (request.path == "/api/cams") return answer_of(Json{{"cams", cams()}});
  if (const std::string cam = behind(request, "/api/cams/"); !cam.empty()) return cam_named(request, cam);
  if (powers_.mode == StudioMode::files)
    return error_answer(404, "not_found", "there is no project, only traces");
  StudioAnswer answer;
  if (request.path == "/api/project") {
    Json json = Json::parse(studio_project(project_));
    json["couplings"] = couplings_json(project_, text_);
    json["cams"] = cams();
    json["files"] = project_files_.names();
    json["warnings"] = powers_.warnings.size();
    answer = answer_of(json);
  } else if (request.path == "/api/tags") {
    answer = answer_of(tags_json(project_));
  } else if (const std::string object = behind(request, "/api/objects/"); !object.empty()) {
    answer = answer_of(object_json(project_, units_, text_, object));
  } else if (const std::string instance = behind(request, "/api/instances/"); !instance.empty()) {
    answer = answer_of(instance_json(project_, units_, text_, instance));
  } else if (request.path == "/api/programs") {
    answer = answer_of(Json{{"programs", text_.programs()}});
  } else if (request.path == "/api/uses") {
    answer = answer_of(Json{{"uses", text_.uses(request.value("name"))}});
  } else if (request.path == "/api/check") {
    answer = answer_of(Json{{"problems", Json::array()}, {"warnings", problems_json(powers_.warnings)}});
  } else {
    return error_answer(404, "not_found",
                        "there is no '" + request.path + "'; STUDIO.md tells what there is");
  }
  // Nothing of it changes while the run goes on.
  answer.etag = "\"" + run_ + "\"";
  answer.cache = "no-cache";
  return answer;
}

/// Of the project, and files beside it.
Json StudioSession::cams() const {
  Json cams = text_.cams();
  for (const StudioCam& cam : powers_.cams)
    cams.push_back({{"name", cam.name}, {"type", "file"}, {"file", cam.name}});
  return cams;
}

StudioAnswer StudioSession::cam_named(const StudioRequest& request, const std::string& name) const {
  for (const StudioCam& cam : powers_.cams)
    if (cam.name == name) try {
        return cam_answer(request, load_cam_file(cam.path, "", kCam10kPoints));
      } catch (const UnreadableFile& error) {
        return error_answer(404, "not_found", error.what());
      }
  const Json all = text_.cams();
  for (const Json& cam : all)
    if (same_name(cam.at("name").get_ref<const std::string&>(), name))
      return cam_answer(request,
                        load_cam(text_.whole(), powers_.project_folder, cam.at("name"), kCam10kPoints));
  return error_answer(404, "not_found", "there is no cam '" + name + "'");
}

/// Files of the project. Whoever tries to change one is told of, as of a write.
StudioAnswer StudioSession::answer_files(const StudioRequest& request) {
  const std::string name = behind(request, "/api/files/");
  const bool changes = request.method == "PUT";
  if (!changes && request.method != "GET" && request.method != "HEAD")
    return error_answer(405, "not_allowed", "allowed here: GET, PUT");
  StudioAnswer answer;
  if (!project_files_.are_there()) {
    answer = error_answer(403, "not_allowed",
                          "files of a project are read and written at the desk alone, with lockstep studio");
  } else if (changes && !powers_.why_no_write.empty()) {
    answer = error_answer(403, "not_allowed", powers_.why_no_write);
  } else {
    try {
      answer = project_files_.answer(request, name);
    } catch (const BadRequest& bad) {
      answer = error_answer(bad.status, bad.code, bad.what());
    }
  }
  if (changes) tell_written(request, name, answer);
  return answer;
}

void StudioSession::tell_written(const StudioRequest& request, std::string_view name,
                                 const StudioAnswer& answer) const {
  if (!powers_.tell) return;
  TraceEvent event;
  const bool is_done = answer.status == 200;
  event.kind = is_done ? EventKind::written : EventKind::write_refused;
  event.source = name;
  event.type = "file";
  const Json told = Json::parse(answer.body);
  event.text = is_done ? std::to_string(told.at("bytes").get<std::uint64_t>()) + " bytes"
                       : told.at("error").at("message").get<std::string>();
  event.address = request.peer;
  powers_.tell(std::move(event));
}

StudioAnswer StudioSession::change_simulation(const StudioRequest& request) {
  if (powers_.simulation == nullptr)
    return error_answer(409, "conflict", "this run goes on by itself; lockstep studio drives a simulation");
  if (!powers_.why_no_write.empty()) return error_answer(403, "not_allowed", powers_.why_no_write);
  const Json asked = parsed(request.body);
  Wrong wrong{422};
  try {
    return answer_of(powers_.simulation->obey(asked));
  } catch (const InvalidProject& error) {  // the file is another one since; a line for each problem
    const std::string_view text = error.what();
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      wrong.add("invalid_project", std::string(text.substr(at, end - at)));
      at = end + 1;
    }
  } catch (const UnreadableFile& error) {
    wrong.add("invalid_project", error.what());
  }
  return answer_of(wrong);
}

/// Values of a simulation that stands still.
bool StudioSession::read_at_once(const StudioRequest& request, const Done& done) {
  if (powers_.simulation == nullptr) return false;
  std::vector<ReadPlace> places;
  Wrong wrong{422};
  const Json asked = parsed(request.body);
  for (const std::string& path : paths_in(asked, StudioReadings::kRead)) {
    std::string problem;
    std::optional<ReadPlace> place = read_place_at(project_, path, problem);
    if (place && place->signals.front().signal.address != nullptr)
      places.push_back(std::move(*place));
    else if (!place && is_partial(asked))
      wrong.add("not_found", problem, {{"path", path}});
    else
      return false;  // which is told there
  }
  if (places.empty()) return false;
  return powers_.simulation->while_paused([&](std::int64_t tick) {
    const Json values = array_of(places, [this](const ReadPlace& place) {
      std::vector<Value> loaded;
      for (const NamedSignal& signal : place.signals) loaded.push_back(signal.signal.load());
      return reading_json(place, loaded, units_);
    });
    const std::int64_t t = tick * project_.controller->clock.servo_cycle;
    Json json = {{"t", std::to_string(t)}, {"tick", std::to_string(tick)}, {"values", values}};
    if (!wrong.errors.empty()) json["errors"] = wrong.errors;
    done(answer_of(json));
  });
}

}  // namespace lockstep
