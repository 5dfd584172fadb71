#include "projects/studio/session.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "hmi_bridge/studio/frames.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;

constexpr auto kReadTime = 2s;  // for a row that has what is read, and how long it goes on coming
constexpr int kDepth = 20;      // of JSON

/// What is wrong with a request; all of it.
struct Wrong {
  unsigned status;
  Json errors = Json::array();

  void add(std::string_view code, const std::string& message, const Json& more = Json::object()) {
    Json error = {{"code", code}, {"message", message}};
    error.update(more);
    errors.push_back(error);
  }
};

/// Thrown where nothing else is to be looked at.
struct BadRequest : std::runtime_error {
  BadRequest(unsigned status_code, std::string word, const std::string& text)
      : std::runtime_error(text), status(status_code), code(std::move(word)) {}
  unsigned status;
  std::string code;
};

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

StudioAnswer answer_of(const Json& json) {
  StudioAnswer answer;
  answer.body = text_of(json) + "\n";
  return answer;
}

StudioAnswer answer_of(const Wrong& wrong) {
  StudioAnswer answer = answer_of(Json{{"error", wrong.errors.front()}, {"errors", wrong.errors}});
  answer.status = wrong.status;
  return answer;
}

StudioAnswer error_answer(unsigned status, std::string_view code, const std::string& message) {
  Wrong wrong{status};
  wrong.add(code, message);
  return answer_of(wrong);
}

Json parsed(std::string_view text) {
  const Json::parser_callback_t bounded = [](int depth, Json::parse_event_t, Json&) {
    if (depth > kDepth)
      throw BadRequest(422, "bad_request", "this JSON is nested too deeply; allowed: 20 levels");
    return true;
  };
  try {
    return Json::parse(text, bounded);
  } catch (const Json::exception& error) {
    throw BadRequest(422, "bad_request", error.what());
  }
}

Json number_json(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  return number;
}

/// What may exceed 2^53 is a text of decimal digits.
Json value_json(Value value, Type type) {
  if (is_real(type)) return number_json(value.r);
  switch (type) {
    case Type::BOOL:
      return value.u != 0;
    case Type::LINT:
    case Type::TIME:
      return std::to_string(value.i);
    case Type::ULINT:
    case Type::LWORD:
      return std::to_string(value.u);
    default:
      return value.i;
  }
}

Json event_json(const TraceEvent& event) {
  Json json = {{"kind", event_kind_text(event.kind)},
               {"t", std::to_string(event.t)},
               {"tick", std::to_string(event.tick)},
               {"source", event.source},
               {"type", event.type},
               {"number", event.number},
               {"text", event.text}};
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
  };
  add("object", event.object);
  add("reaction", event.reaction_text);
  add("cause", event.cause);
  add("remedy", event.remedy);
  add("address", event.address);
  if (event.utime != 0) json["utime"] = std::to_string(event.utime);
  if (event.has_value())
    json["value"] = {{"name", event.value_name}, {"value", event.value}, {"unit", event.unit}};
  if (event.has_limit())
    json["limit"] = {{"name", event.limit_name}, {"value", event.limit}, {"unit", event.unit}};
  return json;
}

Json job_json(const StudioJob& job) {
  Json json = {{"instance", job.instance},
               {"type", job.type},
               {"object", job.object},
               {"begin", std::to_string(job.begin)}};
  if (job.end < 0) return json;
  json["end"] = std::to_string(job.end);
  json["ended"] = job.ended;
  if (!job.text.empty()) json["text"] = job.text;
  return json;
}

template <class List, class Convert>
Json array_of(const List& list, Convert convert) {
  Json array = Json::array();
  for (const auto& one : list) array.push_back(convert(one));
  return array;
}

std::int64_t whole_number(const StudioRequest& request, std::string_view key, std::int64_t otherwise) {
  const std::string_view text = request.value(key);
  if (text.empty()) return otherwise;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    throw BadRequest(422, "wrong_type",
                     std::string(key) + ": '" + std::string(text) + "' has to be a whole number");
  return number;
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

/// The signal at a path, or why there is none.
std::optional<NamedSignal> signal_at(const Project& project, const std::string& path, std::string& problem) {
  const FoundOperand found = project.names.find(path);
  if (!found.place) {
    problem = found.problem;
    return {};
  }
  if (found.place->signal.type >= Type::AXIS) {
    problem = path + " has no value that could be shown";
    return {};
  }
  return NamedSignal{path, found.place->signal, found.place->unit, found.place->object,
                     found.place->instance};
}

/// The paths that a message names; @throws BadRequest if they are none
std::vector<std::string> paths_in(const Json& json, std::size_t limit) {
  const auto paths = json.find("paths");
  if (paths == json.end() || !paths->is_array() || paths->empty())
    throw BadRequest(422, "bad_request", "'paths' has to be a list of paths, one at least");
  if (paths->size() > limit)
    throw BadRequest(422, "too_many",
                     std::to_string(paths->size()) + " paths; allowed: " + std::to_string(limit));
  std::vector<std::string> result;
  for (const Json& path : *paths) {
    if (!path.is_string()) throw BadRequest(422, "wrong_type", "a path has to be a text");
    result.push_back(path.get<std::string>());
  }
  return result;
}

std::string chance_number() {
  std::random_device chance;
  return std::to_string((std::uint64_t{chance()} << 31) ^ chance());
}

}  // namespace

/// What a page says.
struct StudioMessage {
  Json json;
  Json seq;  ///< that the answer has as well

  /// @throws BadRequest
  std::uint32_t number(const char* key) const {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number_unsigned() ||
        found->get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
      throw BadRequest(422, "wrong_type",
                       std::string("'") + key + "' has to be a number from 0 to 4294967295");
    return found->get<std::uint32_t>();
  }
};

StudioSession::StudioSession(const Project& project, std::int64_t epoch)
    : project_(project),
      units_(project),
      epoch_(epoch),
      run_(chance_number()),
      feed_(project.controller->clock.interpolator_cycle(), units_) {}

void StudioSession::answer(const StudioRequest& request, Done done) {
  try {
    if (request.path == "/api/read" && request.method == "POST") return read(request, done);
    if (request.method != "GET" && request.method != "HEAD")
      return done(error_answer(405, "not_allowed", "allowed here: GET"));
    done(answer_get(request));
  } catch (const BadRequest& bad) {
    done(error_answer(bad.status, bad.code, bad.what()));
  }
}

StudioAnswer StudioSession::answer_get(const StudioRequest& request) {
  if (request.path == "/api") return about();
  if (request.path == "/api/project") {
    StudioAnswer answer;
    answer.body = studio_project(project_);
    answer.etag = "\"" + run_ + "\"";
    answer.cache = "no-cache";
    return answer;
  }
  if (request.path == "/api/signals") return signals(request);
  if (request.path == "/api/events")
    return answer_of(Json{{"pending", array_of(history_.pending(), event_json)},
                          {"events", array_of(history_.events(), event_json)},
                          {"lost", inbox_->lost()}});
  if (request.path == "/api/jobs") return answer_of(Json{{"jobs", array_of(history_.jobs(), job_json)}});
  if (request.path == "/api/traces") return traces();
  if (request.path == "/api/traces/live/window" || request.path == "/api/traces/live/statistics")
    return part_of_trace(request);
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
                        {"rights", {{"write", false}, {"command", false}, {"files", false}}},
                        {"limits",
                         {{"signals", StudioFeed::kSignals},
                          {"subscribed", kSubscribed},
                          {"read", kRead},
                          {"points", kPoints},
                          {"pages", StudioServer::kPages}}}});
}

StudioAnswer StudioSession::signals(const StudioRequest& request) {
  const std::int64_t limit = whole_number(request, "limit", 100);
  if (limit < 1 || limit > 10'000)
    throw BadRequest(422, "out_of_range", "limit: " + std::to_string(limit) + "; allowed: 1 to 10000");
  if (all_.empty()) all_ = studio_signals(project_, units_);
  const auto found = find_studio_signals(all_, request.value("q"), static_cast<std::size_t>(limit));
  return answer_of(Json{{"count", all_.size()}, {"signals", array_of(found, [](const StudioSignal* signal) {
                                                   Json json = {
                                                       {"path", signal->path},
                                                       {"type", signal->type},
                                                       {"unit", signal->unit},
                                                       {"text", signal->text},
                                                       {"writable", signal->why_not_writable.empty()}};
                                                   if (!signal->why_not_writable.empty())
                                                     json["why_not_writable"] = signal->why_not_writable;
                                                   return json;
                                                 })}});
}

StudioAnswer StudioSession::traces() const {
  const TraceStore& store = feed_.store();
  Json live = {
      {"id", "live"},
      {"rows", store.end() - store.begin()},
      {"bytes", store.bytes()},
      {"dropped", feed_.dropped()},
      {"signals",
       array_of(store.signals(),
                [](const TraceSignal& signal) {
                  return Json{{"path", signal.name}, {"type", type_name(signal.type)}, {"unit", signal.unit}};
                })},
      {"gaps", array_of(store.gaps(), [](const TraceStore::Gap& gap) {
         return Json{{"t", std::to_string(gap.t)}, {"rows", gap.missing}};
       })}};
  if (store.end() > store.begin()) {
    live["from"] = std::to_string(store.t(store.begin()));
    live["to"] = std::to_string(store.t(store.end() - 1));
  }
  return answer_of(Json{{"traces", Json::array({live})}});
}

/// A window or statistics of the trace that goes on.
StudioAnswer StudioSession::part_of_trace(const StudioRequest& request) {
  const TraceStore& store = feed_.store();
  if (store.end() == store.begin())
    return error_answer(416, "out_of_range", "there are no rows yet: nobody has asked for a signal");
  const std::int64_t from = whole_number(request, "from", store.t(store.begin()));
  const std::int64_t to = whole_number(request, "to", store.t(store.end() - 1));
  if (from > to) throw BadRequest(416, "out_of_range", "'from' has to be before 'to'");
  std::vector<std::size_t> columns;
  Wrong wrong{422};
  for (const std::string& path : split(request.value("signals"))) {
    if (const auto column = store.find(path))
      columns.push_back(*column);
    else
      wrong.add("not_found", "'" + path + "' is not in this trace", {{"path", path}});
  }
  if (!wrong.errors.empty()) return answer_of(wrong);
  if (columns.empty() || columns.size() > kSubscribed)
    throw BadRequest(422, "bad_request", "'signals' has to name 1 to 512 of the trace, by commas");
  const std::uint64_t first = store.row_at(from);
  const std::uint64_t behind =
      to == std::numeric_limits<std::int64_t>::max() ? store.end() : store.row_at(to + 1);
  if (request.path.ends_with("/window")) {
    const std::int64_t points = whole_number(request, "pixels", 1000);
    if (points < 1 || points > static_cast<std::int64_t>(kPoints))
      throw BadRequest(422, "out_of_range", "pixels: " + std::to_string(points) + "; allowed: 1 to 20000");
    StudioAnswer answer;
    answer.type = "application/octet-stream";
    const TraceWindow window = store.window(columns, first, behind, static_cast<std::size_t>(points));
    const std::vector<std::uint8_t> bytes = encode_frame({StudioFrameKind::window, 0, 0, 0}, window);
    answer.body.assign(bytes.begin(), bytes.end());
    return answer;
  }
  return answer_of(array_of(columns, [&](std::size_t column) {
    const TraceStatistics seen = store.statistics(column, first, behind);
    Json json = {{"signal", store.signals()[column].name}, {"n", seen.rows}, {"nans", seen.nans}};
    if (seen.rows == 0) return json;
    const auto add = [&](const char* key, double number) { json[key] = number_json(number); };
    add("minimum", seen.minimum);
    json["t_minimum"] = std::to_string(seen.t_minimum);
    add("maximum", seen.maximum);
    json["t_maximum"] = std::to_string(seen.t_maximum);
    add("mean", seen.mean);
    add("deviation", seen.deviation);
    add("rms", seen.rms);
    add("peak_to_peak", seen.maximum - seen.minimum);
    add("integral", seen.integral);
    add("first", seen.first);
    add("last", seen.last);
    return json;
  }));
}

/// Answered by the first row that has all of it.
void StudioSession::read(const StudioRequest& request, Done done) {
  Reading reading;
  Wrong wrong{422};
  for (const std::string& path : paths_in(parsed(request.body), kRead)) {
    std::string problem;
    if (std::optional<NamedSignal> signal = signal_at(project_, path, problem))
      reading.signals.push_back(std::move(*signal));
    else
      wrong.add("not_found", problem, {{"path", path}});
  }
  if (!wrong.errors.empty()) return done(answer_of(wrong));
  reading.until = Clock::now() + kReadTime;
  for (const NamedSignal& signal : reading.signals) {
    reading.indices.push_back(feed_.index(signal));
    kept_.insert_or_assign(signal.name, Kept{signal, reading.until});
  }
  // The row that is being made now may be older than the question.
  reading.from = feed_.store().end();
  reading.done = std::move(done);
  readings_.push_back(std::move(reading));
  want();
}

void StudioSession::answer_readings() {
  const TraceStore& store = feed_.store();
  const auto now = Clock::now();
  std::erase_if(readings_, [&](Reading& reading) {
    const bool is_there = store.end() > reading.from && store.end() > store.begin() &&
                          std::all_of(reading.indices.begin(), reading.indices.end(),
                                      [this](std::size_t index) { return feed_.is_in_newest(index); });
    if (!is_there && now < reading.until) return false;
    if (!is_there) {
      reading.done(
          error_answer(503, "busy", "no tick has ended within two seconds, or too much is asked for"));
      return true;
    }
    const TraceWindow row = store.rows(reading.indices, store.end() - 1, store.end());
    Json values = Json::array();
    for (std::size_t i = 0; i < reading.signals.size(); ++i) {
      const NamedSignal& signal = reading.signals[i];
      values.push_back({{"path", signal.name},
                        {"type", type_name(signal.signal.value_type())},
                        {"unit", units_.of(signal)},
                        {"value", value_json(row.columns[i].first[0], signal.signal.value_type())}});
    }
    reading.done(answer_of(
        Json{{"t", std::to_string(row.t[0])}, {"tick", std::to_string(row.tick[0])}, {"values", values}}));
    return true;
  });
}

void StudioSession::opened(StudioClient& client) {
  pages_[&client];
}

void StudioSession::closed(StudioClient& client) noexcept {
  if (pages_.erase(&client) != 0) wants_changed_ = true;
}

void StudioSession::hello(StudioClient& client, Page& page, const StudioMessage& message) {
  const Json& json = message.json;
  const std::string token = json.contains("token") && json["token"].is_string() ? json["token"] : "";
  if (!client.authorise(token)) throw BadRequest(401, "not_allowed", "'token' has to be that of the studio");
  page.is_known = true;
  client.send_text(text_of(Json{{"type", "hello"},
                                {"seq", message.seq},
                                {"api", 1},
                                {"version", LOCKSTEP_VERSION},
                                {"project", project_.name},
                                {"run", run_},
                                {"mode", "machine"},
                                {"epoch", std::to_string(epoch_)},
                                {"interpolator_cycle", project_.controller->clock.interpolator_cycle()},
                                {"rights", {{"write", false}, {"command", false}, {"files", false}}},
                                {"pending", array_of(history_.pending(), event_json)},
                                {"jobs", array_of(history_.jobs(), job_json)}}));
}

void StudioSession::unsubscribe(StudioClient& client, Page& page, const StudioMessage& message) {
  const std::uint32_t id = message.number("id");
  page.subscriptions.erase(id);
  page.stream.unsubscribe(id);
  want();
  client.send_text(text_of(Json{{"type", "unsubscribed"}, {"seq", message.seq}, {"id", id}}));
}

/// Whether there is space for more signals, besides those of one subscription that is replaced.
void StudioSession::check_sum(std::size_t more, const Page& page, std::uint32_t id) const {
  std::size_t sum = more;
  for (const auto& [client, other] : pages_)
    for (const auto& [number, subscribed] : other.subscriptions)
      if (&other != &page || number != id) sum += subscribed.size();
  if (sum > StudioFeed::kSignals)
    throw BadRequest(422, "too_many", std::to_string(sum) + " signals of all pages; allowed: 1024");
}

void StudioSession::subscribe(StudioClient& client, Page& page, const StudioMessage& message) {
  const std::uint32_t id = message.number("id");
  std::vector<NamedSignal> wanted;
  Json signals = Json::array();
  for (const std::string& path : paths_in(message.json, kSubscribed)) {
    std::string problem;
    const std::optional<NamedSignal> signal = signal_at(project_, path, problem);
    if (!signal) {
      signals.push_back({{"path", path}, {"error", {{"code", "not_found"}, {"message", problem}}}});
      continue;
    }
    signals.push_back({{"path", path},
                       {"column", wanted.size()},
                       {"type", type_name(signal->signal.value_type())},
                       {"unit", units_.of(*signal)}});
    wanted.push_back(*signal);
  }
  check_sum(wanted.size(), page, id);
  std::vector<std::size_t> indices;
  for (const NamedSignal& signal : wanted) indices.push_back(feed_.index(signal));
  page.subscriptions[id] = std::move(wanted);
  page.stream.subscribe(id, std::move(indices), feed_.store());
  want();
  client.send_text(
      text_of(Json{{"type", "subscribed"}, {"seq", message.seq}, {"id", id}, {"signals", signals}}));
}

void StudioSession::obey(StudioClient& client, const StudioMessage& message) {
  Page& page = pages_.at(&client);
  const std::string type = message.json["type"];
  if (type == "hello") return hello(client, page, message);
  if (!page.is_known) throw BadRequest(403, "not_allowed", "the first message has to be 'hello'");
  if (type == "ack") return page.stream.acknowledge(message.number("frame"));
  if (type == "subscribe") return subscribe(client, page, message);
  if (type == "unsubscribe") return unsubscribe(client, page, message);
  throw BadRequest(422, "bad_request",
                   "'" + type + "' is no message; allowed: hello, subscribe, unsubscribe, ack");
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

/// The signals of all pages, and those that are being read.
void StudioSession::want() {
  std::set<std::string> names;
  std::vector<NamedSignal> signals;
  const auto add = [&](const NamedSignal& signal) {
    if (signals.size() < StudioFeed::kSignals && names.insert(signal.name).second) signals.push_back(signal);
  };
  for (const auto& [client, page] : pages_)
    for (const auto& [id, subscribed] : page.subscriptions)
      for (const NamedSignal& signal : subscribed) add(signal);
  for (const auto& [path, kept] : kept_) add(kept.signal);
  feed_.want(std::move(signals));
}

void StudioSession::tell_events() {
  for (TraceEvent& event : inbox_->take()) {
    const std::string text = text_of(Json{{"type", "event"}, {"event", event_json(event)}});
    for (auto& [client, page] : pages_)
      if (page.is_known) client->send_text(text);
    history_.add(std::move(event));
  }
}

void StudioSession::tell_status() {
  const auto now = Clock::now();
  if (now < next_status_) return;
  next_status_ = now + 1s;
  const TraceStore& store = feed_.store();
  const std::string t = store.end() > store.begin() ? std::to_string(store.t(store.end() - 1)) : "";
  const std::string text = text_of(Json{{"type", "status"},
                                        {"t", t},
                                        {"dropped", feed_.dropped()},
                                        {"bytes", store.bytes()},
                                        {"pages", pages_.size()},
                                        {"events_lost", inbox_->lost()}});
  for (auto& [client, page] : pages_)
    if (page.is_known) client->send_text(text);
}

void StudioSession::send_rows() {
  for (auto& [client, page] : pages_) {
    if (!client->is_idle()) continue;
    // One of each subscription at most.
    for (std::size_t i = 0; i < page.subscriptions.size(); ++i) {
      std::optional<std::vector<std::uint8_t>> frame = page.stream.next(feed_.store());
      if (!frame) break;
      client->send_bytes(std::move(*frame));
    }
  }
}

void StudioSession::look() {
  const auto now = Clock::now();
  if (std::erase_if(kept_, [&](const auto& one) { return one.second.until < now; }) != 0)
    wants_changed_ = true;
  if (std::exchange(wants_changed_, false)) want();
  feed_.look();
  answer_readings();
  tell_events();
  send_rows();
  tell_status();
}

}  // namespace lockstep
