#include "projects/studio/session.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include "projects/studio/api_values.hpp"
#include "projects/studio/cam_answers.hpp"
#include "projects/studio/message.hpp"
#include "projects/studio/trace_answers.hpp"
#include "projects/studio/trace_part.hpp"

namespace lockstep {
namespace {

using namespace studio_api;
using namespace std::chrono_literals;

constexpr std::string_view kTraces = "/api/traces/";
constexpr std::string_view kDerived = "/derived";
constexpr std::string_view kFiles = "/api/files/";

std::string chance_number() {
  std::random_device chance;
  return std::to_string((std::uint64_t{chance()} << 31) ^ chance());
}

Json signal_json(const StudioSignal& signal) {
  Json json = {{"path", signal.path},
               {"type", signal.type},
               {"unit", signal.unit},
               {"text", signal.text},
               {"writable", signal.why_not_writable.empty()}};
  if (!signal.why_not_writable.empty()) json["why_not_writable"] = signal.why_not_writable;
  return json;
}

}  // namespace

StudioSession::StudioSession(const Project& project, std::int64_t epoch, std::int64_t history)
    : project_(project),
      units_(project),
      epoch_(epoch),
      run_(chance_number()),
      feed_(project, units_, history),
      pages_(project, units_, feed_),
      readings_(project, units_, feed_),
      triggers_(project, feed_, shots_),
      writes_(project, powers_, feed_.tap().writes),
      panels_(powers_) {}

void StudioSession::empower(StudioPowers powers) {
  powers_ = std::move(powers);
  text_ = StudioProjectText(powers_.project_text);
  powers_.project_text.clear();
  trace_folder_ = DeskFolder(powers_.trace_folder);
  if (powers_.project_file.empty()) return;
  std::vector<std::string> cams;
  const Json all = text_.cams();
  for (const Json& cam : all)
    if (const auto file = cam.find("file"); file != cam.end() && file->is_string())
      cams.push_back(file->get<std::string>());
  project_files_ = StudioProjectFiles(powers_.project_file, std::move(cams));
}

void StudioSession::answer(const StudioRequest& request, Done done) {
  try {
    if (request.path == "/api/read" && request.method == "POST") {
      if (read_at_once(request, done)) return;
      readings_.read(request, done);
      return want();
    }
    if (request.path == "/api/write" && request.method == "POST") return writes_.write(request, done);
    if (request.path.starts_with(kFiles)) return done(answer_files(request));
    if (request.method == "GET" || request.method == "HEAD") return done(answer_get(request));
    done(answer_post(request));
  } catch (const BadRequest& bad) {
    done(error_answer(bad.status, bad.code, bad.what()));
  }
}

StudioAnswer StudioSession::answer_post(const StudioRequest& request) {
  const bool posts = request.method == "POST";
  if (posts && request.path == "/api/traces") return take_trace(request);
  if (posts && request.path == "/api/cam/design") return design_answer(request);
  if (posts && request.path == "/api/simulation") return change_simulation(request);
  if (posts && request.path.starts_with(kTraces) && request.path.ends_with(kDerived)) return derive(request);
  if (request.method == "DELETE" && request.path.starts_with(kTraces)) return remove_trace(request);
  return error_answer(405, "not_allowed", "allowed here: GET");
}

StudioAnswer StudioSession::answer_get(const StudioRequest& request) {
  if (request.path == "/api") return about();
  if (request.path == "/api/signals") return signals(request);
  if (request.path == "/api/events") return events();
  if (request.path == "/api/jobs") return jobs();
  if (request.path == "/api/traces") return traces();
  if (request.path == "/api/compare") return compare(request);
  if (request.path.starts_with(kTraces)) return part_of_trace(request);
  return answer_project(request);
}

StudioAnswer StudioSession::about() const {
  return answer_of(Json{{"product", "lockstep"},
                        {"version", LOCKSTEP_VERSION},
                        {"api", 1},
                        {"mode", mode_name(powers_.mode)},
                        {"project", project_.name},
                        {"run", run_},
                        {"epoch", std::to_string(epoch_)},
                        {"rights", rights_json(powers_)},
                        {"why_not", reasons_json(powers_)},
                        {"limits",
                         {{"signals", StudioFeed::kSignals},
                          {"subscribed", StudioPages::kSubscribed},
                          {"read", StudioReadings::kRead},
                          {"points", kWindowPoints},
                          {"pages", StudioServer::kPages}}}});
}

StudioAnswer StudioSession::signals(const StudioRequest& request) {
  const std::int64_t limit = whole_number(request, "limit", 100);
  if (limit < 1 || limit > 10'000)
    throw BadRequest(422, "out_of_range", "limit: " + std::to_string(limit) + "; allowed: 1 to 10000");
  if (all_.empty()) all_ = studio_signals(project_, units_);
  auto found = find_studio_signals(all_, request.value("q"), all_.size());
  const std::size_t matches = found.size();
  found.resize(std::min(matches, static_cast<std::size_t>(limit)));
  const auto described = [](const StudioSignal* signal) { return signal_json(*signal); };
  return answer_of(Json{{"count", all_.size()}, {"found", matches}, {"signals", array_of(found, described)}});
}

StudioAnswer StudioSession::events() const {
  return answer_of(Json{{"pending", array_of(history_.pending(), event_json)},
                        {"events", array_of(history_.events(), event_json)},
                        {"lost", inbox_->lost()}});
}

StudioAnswer StudioSession::jobs() const {
  return answer_of(Json{{"jobs", array_of(history_.jobs(), job_json)}});
}

void StudioSession::closed(StudioClient& client) noexcept {
  if (pages_.close(client)) wants_changed_ = true;
  triggers_.forget(client);
  try {
    panels_.leave(client);
  } catch (...) {
    return;  // there is no memory; the cycle ends a jog that is not repeated
  }
}

void StudioSession::hello(StudioClient& client, const StudioMessage& message) {
  pages_.admit(client, message);
  client.send_text(
      text_of(Json{{"type", "hello"},
                   {"seq", message.seq},
                   {"api", 1},
                   {"version", LOCKSTEP_VERSION},
                   {"project", project_.name},
                   {"run", run_},
                   {"mode", mode_name(powers_.mode)},
                   {"epoch", std::to_string(epoch_)},
                   {"interpolator_cycle", project_.controller->clock.interpolator_cycle()},
                   {"rights", rights_json(powers_)},
                   {"why_not", reasons_json(powers_)},
                   {"panels", panels_.panels_for(client)},
                   {"simulation", powers_.simulation != nullptr ? powers_.simulation->state() : Json()},
                   {"pending", array_of(history_.pending(), event_json)},
                   {"jobs", array_of(history_.jobs(), job_json)}}));
}

void StudioSession::obey(StudioClient& client, const StudioMessage& message) {
  const std::string type = message.json["type"];
  if (type == "hello") return hello(client, message);
  if (!pages_.is_known(client)) throw BadRequest(403, "not_allowed", "the first message has to be 'hello'");
  if (type == "ack") return pages_.acknowledge(client, message);
  if (type == "command") return panels_.obey(client, message);
  if (type == "subscribe") {
    pages_.subscribe(client, message);
    recorded_at_first_.clear();
  } else if (type == "unsubscribe") {
    pages_.unsubscribe(client, message);
  } else if (type == "trigger") {
    triggers_.obey(client, message);
  } else {
    throw BadRequest(422, "bad_request",
                     "'" + type +
                         "' is no message; allowed: hello, subscribe, unsubscribe, trigger, ack, "
                         "command");
  }
  want();
}

void StudioSession::text(StudioClient& client, std::string_view text) {
  StudioMessage message;
  try {
    message.json = parsed(text);
    const auto type = message.json.is_object() ? message.json.find("type") : message.json.end();
    if (type == message.json.end() || !type->is_string())
      throw BadRequest(422, "bad_request", "a message is an object with a 'type'");
    message.seq = message.json.value("seq", Json());
    obey(client, message);
  } catch (const BadRequest& bad) {
    const Json error = {{"code", bad.code}, {"message", bad.what()}};
    client.send_text(text_of(Json{{"type", "error"}, {"seq", message.seq}, {"error", error}}));
  }
}

std::vector<std::string> StudioSession::recorded() const {
  std::vector<std::string> paths;
  for (const TraceSignal& signal : feed_.store().signals()) paths.push_back(signal.name);
  return paths;
}

void StudioSession::record(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::string problem;
    if (std::optional<NamedSignal> signal = signal_at(project_, path, problem))
      recorded_at_first_.push_back(*std::move(signal));
  }
  want();
}

/// The signals of all pages and their triggers, and those that are being read.
void StudioSession::want() {
  std::set<std::string> names;
  std::vector<NamedSignal> signals;
  const auto add = [&](const NamedSignal& signal) {
    if (signals.size() < StudioFeed::kSignals && names.insert(signal.name).second) signals.push_back(signal);
  };
  pages_.wanted(add);
  triggers_.wanted(add);
  readings_.wanted(add);
  for (const NamedSignal& signal : recorded_at_first_) add(signal);
  feed_.want(std::move(signals));
}

void StudioSession::tell_events() {
  for (TraceEvent& event : inbox_->take()) {
    pages_.tell(text_of(Json{{"type", "event"}, {"event", event_json(event)}}));
    triggers_.event(event);
    history_.add(std::move(event));
  }
}

void StudioSession::tell_shots() {
  triggers_.look([this](const StudioShot& shot) {
    Json told = {{"type", "shot"}};
    told.update(shot_json(shot));
    pages_.tell(text_of(told));
    wants_changed_ = true;  // a trigger may be over
  });
}

void StudioSession::tell_panels(Clock::time_point now) {
  if (!panels_.is_due(now)) return;
  pages_.tell_each([this](StudioClient& client) {
    return text_of(Json{{"type", "panel"}, {"panels", panels_.panels_for(client)}});
  });
}

void StudioSession::tell_status(Clock::time_point now) {
  if (now < next_status_) return;
  next_status_ = now + 1s;
  const TraceStore& store = feed_.store();
  const std::string t = store.end() > store.begin() ? std::to_string(store.t(store.end() - 1)) : "";
  Json status = {{"type", "status"},
                 {"t", t},
                 {"dropped", feed_.dropped()},
                 {"bytes", store.bytes()},
                 {"signals", feed_.wanted()},
                 {"pages", pages_.size()},
                 {"events_lost", inbox_->lost()}};
  // How the cycle has gone, of a run in real time.
  if (const Json cycle = powers_.health ? Json::parse(powers_.health()).value("cycle", Json()) : Json();
      cycle.is_object()) {
    tap_cost_.add(cycle.at("ticks"), cycle.at("busy_us"), feed_.wanted());
    status["cycle"] = cycle;
    status["tap"] = tap_cost_.told();
  }
  pages_.tell(text_of(status));
}

void StudioSession::look() {
  const auto now = Clock::now();
  if (readings_.forget(now)) wants_changed_ = true;
  if (std::exchange(wants_changed_, false)) want();
  feed_.look();
  readings_.answer(now);
  tell_events();
  tell_shots();
  tell_files();
  writes_.look(now);
  tell_panels(now);
  pages_.send_rows();
  tell_status(now);
}

}  // namespace lockstep
