// What pages do with traces: that of the run, shots, files.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "projects/studio/api_values.hpp"
#include "projects/studio/session.hpp"
#include "projects/studio/trace_analysis.hpp"
#include "projects/studio/trace_answers.hpp"

namespace lockstep {
namespace {

using namespace studio_api;

constexpr std::string_view kOfTraces = "/api/traces/";
constexpr std::size_t kLongestName = 128;
constexpr std::uint64_t kDerivedRows = 20'000'000;

std::string_view state_name(StudioFileState state) noexcept {
  if (state == StudioFileState::loading) return "loading";
  return state == StudioFileState::ready ? "ready" : "failed";
}

Json file_json(const StudioTraceFile& file) {
  Json json = {{"id", file.id},
               {"kind", "file"},
               {"name", file.name},
               {"state", state_name(file.state)},
               {"progress", file.progress}};
  if (!file.error.empty()) json["error"] = {{"code", "bad_request"}, {"message", file.error}};
  if (!file.remark.empty()) json["remark"] = file.remark;
  if (!file.of.empty()) json["of"] = file.of;
  return json;
}

/// A file that was sent, which is removed unless somebody takes it.
class SentFile {
 public:
  explicit SentFile(std::string path) : path_(std::move(path)) {}
  ~SentFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  SentFile(const SentFile&) = delete;
  SentFile& operator=(const SentFile&) = delete;
  void taken() noexcept { path_.clear(); }

 private:
  std::string path_;
};

/// Of `/api/traces/ID/WHAT`.
std::pair<std::string_view, std::string_view> parts_of(const StudioRequest& request) {
  const std::string_view rest = std::string_view(request.path).substr(kOfTraces.size());
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  return {rest.substr(0, slash), rest.substr(std::min(slash + 1, rest.size()))};
}

/// A trace with a further signal that is computed of its others.
TraceStore with_derived(const TraceStore& store, const std::string& name, StudioDerived& derived) {
  std::vector<std::size_t> columns(store.signals().size());
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = i;
  std::vector<std::size_t> operands;
  for (const std::string& path : derived.operands()) operands.push_back(*store.find(path));
  std::vector<TraceSignal> signals = store.signals();
  signals.push_back({name, derived.type(), ""});
  TraceStore result;
  bool begins = true;
  auto gap = store.gaps().begin();
  // In portions, so that a long trace is not there three times.
  for (std::uint64_t from = store.begin(); from < store.end(); from += TraceStore::kPortion) {
    const std::uint64_t to = std::min<std::uint64_t>(from + TraceStore::kPortion, store.end());
    const TraceWindow rows = store.rows(columns, from, to);
    for (std::size_t i = 0; i < columns.size(); ++i) signals[i].type = rows.columns[i].type;
    if (begins) result.set_signals(signals);
    std::vector<Value> values(columns.size() + 1), of;
    for (std::size_t row = 0; row < rows.t.size(); ++row) {
      for (std::size_t i = 0; i < columns.size(); ++i) values[i] = rows.columns[i].first[row];
      of.clear();
      for (const std::size_t operand : operands) of.push_back(values[operand]);
      while (gap != store.gaps().end() && gap->row < from + row) ++gap;
      const bool is_gap = gap != store.gaps().end() && gap->row == from + row;
      values.back() = derived.value(of, rows.t[row], !begins && !is_gap);
      result.append(rows.t[row], rows.tick[row], values, is_gap ? gap->missing : 0);
      begins = false;
    }
  }
  return result;
}

}  // namespace

StudioAnswer StudioSession::traces() const {
  Json live = trace_json("live", feed_.store());
  live["kind"] = "live";
  live["dropped"] = feed_.dropped();
  Json all = Json::array({live});
  for (const StudioShot& shot : shots_.all()) {
    Json json = trace_json(shot.id, shot.store);
    json["kind"] = "shot";
    json.update(shot_json(shot));
    all.push_back(json);
  }
  if (powers_.files != nullptr)
    for (const StudioTraceFile& file : powers_.files->all()) {
      Json json = trace_json(file.id, file.store);
      json.update(file_json(file));
      all.push_back(json);
    }
  return answer_of(Json{{"traces", all}});
}

/// @throws BadRequest if it is being read, or could not be
const TraceStore* StudioSession::find_trace(std::string_view id) const {
  if (id == "live") return &feed_.store();
  if (const StudioShot* shot = shots_.find(id)) return &shot->store;
  const StudioTraceFile* const file =
      powers_.files == nullptr ? nullptr : std::as_const(*powers_.files).find(id);
  if (file == nullptr) throw BadRequest(404, "not_found", "there is no trace '" + std::string(id) + "'");
  if (file->state == StudioFileState::loading) throw BadRequest(409, "busy", file->name + " is being read");
  if (file->state == StudioFileState::failed) throw BadRequest(422, "bad_request", file->error);
  return &file->store;
}

StudioAnswer StudioSession::part_of_trace(const StudioRequest& request) const {
  const auto [id, what] = parts_of(request);
  const TraceStore& store = *find_trace(id);
  if (what == "events") return events_of(id);
  if (what != "xy") return trace_answer(request, what, store, history_of(id));
  const std::string_view with = request.value("with", id);
  return xy_answer(request, store, *find_trace(with));
}

/// Of the run, which shots are a part of; of a file what it has itself.
const StudioHistory& StudioSession::history_of(std::string_view id) const {
  const StudioTraceFile* const file =
      powers_.files == nullptr ? nullptr : std::as_const(*powers_.files).find(id);
  return file != nullptr ? file->history : history_;
}

StudioAnswer StudioSession::events_of(std::string_view id) const {
  const StudioHistory& history = history_of(id);
  return answer_of(Json{{"pending", array_of(history.pending(), event_json)},
                        {"events", array_of(history.events(), event_json)},
                        {"jobs", array_of(history.jobs(), job_json)}});
}

StudioAnswer StudioSession::compare(const StudioRequest& request) const {
  return compare_answer(request, *find_trace(request.value("a", "live")),
                        *find_trace(request.value("b", "live")));
}

StudioAnswer StudioSession::take_trace(const StudioRequest& request) {
  const bool is_sent = !request.body_file.empty();
  SentFile sent(request.body_file);
  if (!takes_uploads()) return error_answer(403, "not_allowed", powers_.why_no_files);
  OpenFile named;
  std::string name(request.value("name", "trace.csv"));
  if (!is_sent) {
    const Json json = parsed(request.body);
    const auto given = json.is_object() ? json.find("path") : json.end();
    if (given == json.end() || !given->is_string())
      throw BadRequest(422, "bad_request", "'path' has to be the name of a file, or the body is one");
    const auto path = given->get<std::string>();
    named = trace_folder_.open(trace_folder_.name_of(path));
    name = path;
  }
  name = name.substr(name.rfind('/') + 1).substr(0, kLongestName);
  if (!name.ends_with(".csv") && !name.ends_with(".lcm"))
    throw BadRequest(422, "bad_request", "'" + name + "' is no trace; it has to end in .csv or .lcm");
  std::error_code unknown;
  if (is_sent && std::filesystem::file_size(request.body_file, unknown) == 0)
    throw BadRequest(422, "bad_request", "the body is empty; a trace has a line of names at least");
  const StudioTraceFile* const file = is_sent ? powers_.files->add(request.body_file, name, true)
                                              : powers_.files->add(std::move(named), name);
  if (file == nullptr)
    throw BadRequest(422, "too_many",
                     "allowed: " + std::to_string(StudioTraceFiles::kFiles) + " files at once");
  sent.taken();
  StudioAnswer answer = answer_of(file_json(*file));
  answer.status = 202;
  return answer;
}

StudioAnswer StudioSession::remove_trace(const StudioRequest& request) {
  const auto [id, what] = parts_of(request);
  const bool is_file = what.empty() && powers_.files != nullptr && powers_.files->remove(id);
  if (!is_file && !(what.empty() && shots_.remove(id)))
    throw BadRequest(404, "not_found",
                     "there is no shot and no file '" + std::string(id) + "' that could be removed");
  return answer_of(Json{{"id", id}});
}

StudioAnswer StudioSession::derive(const StudioRequest& request) {
  const std::string_view id = parts_of(request).first;
  const Json json = parsed(request.body);
  const auto signal = json.is_object() ? json.find("signal") : json.end();
  if (signal == json.end() || !signal->is_string() ||
      !StudioDerived::is_one(signal->get_ref<const std::string&>()))
    throw BadRequest(422, "bad_request", "'signal' has to be '=' and an expression");
  const std::string name = signal->get<std::string>();
  if (id == "live")
    throw BadRequest(409, "conflict", "of the run that goes on, such a signal is subscribed to");
  const TraceStore& store = *find_trace(id);
  if (store.find(name)) return answer_of(Json{{"path", name}});
  if ((store.end() - store.begin()) * (store.signals().size() + 1) > kDerivedRows)
    return error_answer(413, "too_large", "allowed: 20000000 values of a trace");
  std::string problem;
  const auto type_at = [&store](const std::string& path) -> std::optional<Type> {
    const auto column = store.find(path);
    if (!column) return {};
    return store.signals()[*column].type;
  };
  const std::unique_ptr<StudioDerived> derived = StudioDerived::compile(name, type_at, problem);
  if (!derived) throw BadRequest(422, "bad_request", name + ": " + problem);
  TraceStore made = with_derived(store, name, *derived);
  if (StudioShot* const shot = shots_.find(id))
    shot->store = std::move(made);
  else if (StudioTraceFile* const file = powers_.files->find(id))
    file->store = std::move(made);
  return answer_of(Json{{"path", name}, {"type", type_name(derived->type())}});
}

void StudioSession::tell_files() {
  if (powers_.files == nullptr) return;
  powers_.files->look([this](const StudioTraceFile& file) {
    Json told = {{"type", "trace"}};
    told.update(file_json(file));
    pages_.tell(text_of(told));
  });
}

}  // namespace lockstep
