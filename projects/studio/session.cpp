#include "projects/studio/session.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include "projects/studio/api_values.hpp"
#include "projects/studio/message.hpp"
#include "projects/studio/trace_answers.hpp"

namespace lockstep {
namespace {

using namespace studio_api;
using namespace std::chrono_literals;

constexpr std::string_view kTraces = "/api/traces/";

std::string chance_number() {
  std::random_device chance;
  return std::to_string((std::uint64_t{chance()} << 31) ^ chance());
}

Json rights_json() {
  return {{"write", false}, {"command", false}, {"files", false}};
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

Json shot_json(const StudioShot& shot) {
  return {{"id", shot.id}, {"reason", shot.reason}, {"t", std::to_string(shot.t)}};
}

}  // namespace

StudioSession::StudioSession(const Project& project, std::int64_t epoch)
    : project_(project),
      units_(project),
      epoch_(epoch),
      run_(chance_number()),
      feed_(project.controller->clock.interpolator_cycle(), units_),
      pages_(project, units_, feed_),
      readings_(project, units_, feed_),
      triggers_(project, feed_, shots_) {}

void StudioSession::answer(const StudioRequest& request, Done done) {
  try {
    if (request.path == "/api/read" && request.method == "POST") {
      readings_.read(request, done);
      return want();
    }
    if (request.method != "GET" && request.method != "HEAD")
      return done(error_answer(405, "not_allowed", "allowed here: GET"));
    done(answer_get(request));
  } catch (const BadRequest& bad) {
    done(error_answer(bad.status, bad.code, bad.what()));
  }
}

StudioAnswer StudioSession::answer_get(const StudioRequest& request) {
  if (request.path == "/api") return about();
  if (request.path == "/api/project") return project_answer();
  if (request.path == "/api/signals") return signals(request);
  if (request.path == "/api/events") return events();
  if (request.path == "/api/jobs") return jobs();
  if (request.path == "/api/traces") return traces();
  if (request.path.starts_with(kTraces)) return part_of_trace(request);
  return error_answer(404, "not_found", "there is no '" + request.path + "'; STUDIO.md tells what there is");
}

StudioAnswer StudioSession::about() const {
  return answer_of(Json{{"product", "lockstep"},
                        {"version", LOCKSTEP_VERSION},
                        {"api", 1},
                        {"mode", "machine"},
                        {"project", project_.name},
                        {"run", run_},
                        {"epoch", std::to_string(epoch_)},
                        {"rights", rights_json()},
                        {"limits",
                         {{"signals", StudioFeed::kSignals},
                          {"subscribed", StudioPages::kSubscribed},
                          {"read", StudioReadings::kRead},
                          {"points", kWindowPoints},
                          {"pages", StudioServer::kPages}}}});
}

StudioAnswer StudioSession::project_answer() const {
  StudioAnswer answer;
  answer.body = studio_project(project_);
  answer.etag = "\"" + run_ + "\"";
  answer.cache = "no-cache";
  return answer;
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

StudioAnswer StudioSession::traces() const {
  Json live = trace_json("live", feed_.store());
  live["dropped"] = feed_.dropped();
  Json all = Json::array({live});
  for (const StudioShot& shot : shots_.all()) {
    Json json = trace_json(shot.id, shot.store);
    json.update(shot_json(shot));
    all.push_back(json);
  }
  return answer_of(Json{{"traces", all}});
}

/// `/api/traces/ID/WHAT`.
StudioAnswer StudioSession::part_of_trace(const StudioRequest& request) const {
  const std::string_view rest = std::string_view(request.path).substr(kTraces.size());
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const std::string_view id = rest.substr(0, slash);
  const std::string_view what = rest.substr(std::min(slash + 1, rest.size()));
  if (id == "live") return trace_answer(request, what, feed_.store());
  if (const StudioShot* shot = shots_.find(id)) return trace_answer(request, what, shot->store);
  return error_answer(404, "not_found", "there is no trace '" + std::string(id) + "'");
}

void StudioSession::closed(StudioClient& client) noexcept {
  if (pages_.close(client)) wants_changed_ = true;
  triggers_.forget(client);
}

void StudioSession::hello(StudioClient& client, const StudioMessage& message) {
  pages_.admit(client, message);
  client.send_text(text_of(Json{{"type", "hello"},
                                {"seq", message.seq},
                                {"api", 1},
                                {"version", LOCKSTEP_VERSION},
                                {"project", project_.name},
                                {"run", run_},
                                {"mode", "machine"},
                                {"epoch", std::to_string(epoch_)},
                                {"interpolator_cycle", project_.controller->clock.interpolator_cycle()},
                                {"rights", rights_json()},
                                {"pending", array_of(history_.pending(), event_json)},
                                {"jobs", array_of(history_.jobs(), job_json)}}));
}

void StudioSession::obey(StudioClient& client, const StudioMessage& message) {
  const std::string type = message.json["type"];
  if (type == "hello") return hello(client, message);
  if (!pages_.is_known(client)) throw BadRequest(403, "not_allowed", "the first message has to be 'hello'");
  if (type == "ack") return pages_.acknowledge(client, message);
  if (type == "subscribe") {
    pages_.subscribe(client, message);
  } else if (type == "unsubscribe") {
    pages_.unsubscribe(client, message);
  } else if (type == "trigger") {
    triggers_.obey(client, message);
  } else {
    throw BadRequest(422, "bad_request",
                     "'" + type + "' is no message; allowed: hello, subscribe, unsubscribe, trigger, ack");
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

void StudioSession::tell_status(Clock::time_point now) {
  if (now < next_status_) return;
  next_status_ = now + 1s;
  const TraceStore& store = feed_.store();
  const std::string t = store.end() > store.begin() ? std::to_string(store.t(store.end() - 1)) : "";
  pages_.tell(text_of(Json{{"type", "status"},
                           {"t", t},
                           {"dropped", feed_.dropped()},
                           {"bytes", store.bytes()},
                           {"pages", pages_.size()},
                           {"events_lost", inbox_->lost()}}));
}

void StudioSession::look() {
  const auto now = Clock::now();
  if (readings_.forget(now)) wants_changed_ = true;
  if (std::exchange(wants_changed_, false)) want();
  feed_.look();
  readings_.answer(now);
  tell_events();
  tell_shots();
  pages_.send_rows();
  tell_status(now);
}

}  // namespace lockstep
