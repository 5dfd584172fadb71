#include "projects/studio/triggers.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "projects/studio/api_values.hpp"
#include "projects/studio/message.hpp"

namespace lockstep {

using namespace studio_api;

namespace {

double number_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) return 0.0;
  if (!found->is_number())
    throw BadRequest(422, "wrong_type", std::string("'") + key + "' has to be a number");
  return found->get<double>();
}

std::int64_t duration_in(const Json& json, const char* key) {
  const double duration = number_in(json, key);
  if (!(duration >= 0.0 && duration <= static_cast<double>(StudioTriggers::kLongest)))
    throw BadRequest(422, "out_of_range",
                     std::string("'") + key + "': " + std::to_string(duration) +
                         "; allowed: 0 to 50000000000 ns, with 'before' and 'after' together");
  return static_cast<std::int64_t>(duration);
}

std::string word_in(const Json& json, const char* key, const std::string& otherwise) {
  const auto found = json.find(key);
  if (found == json.end()) return otherwise;
  if (!found->is_string()) throw BadRequest(422, "wrong_type", std::string("'") + key + "' has to be a text");
  return found->get<std::string>();
}

StudioTrigger::Condition condition_in(const Json& json, const std::string& kind) {
  const std::optional<StudioTriggerKind> known = studio_trigger_kind(kind);
  if (!known)
    throw BadRequest(422, "bad_request",
                     "kind: '" + kind + "'; allowed: " + std::string(studio_trigger_kinds()));
  const StudioTrigger::Condition condition{*known, number_in(json, "level"), number_in(json, "upper"),
                                           number_in(json, "hysteresis")};
  if (condition.hysteresis < 0.0) throw BadRequest(422, "out_of_range", "'hysteresis' has to be 0 or more");
  if (condition.kind == StudioTriggerKind::outside && !(condition.level <= condition.upper))
    throw BadRequest(422, "out_of_range", "'level' has to be no more than 'upper'");
  return condition;
}

}  // namespace

StudioTriggers::Armed StudioTriggers::armed_by(const StudioMessage& message) const {
  const Json& json = message.json;
  const std::string kind = word_in(json, "kind", "rising");
  const std::string path = word_in(json, "path", "");
  const std::string mode = word_in(json, "mode", "single");
  if (mode != "single" && mode != "normal")
    throw BadRequest(422, "bad_request", "mode: '" + mode + "'; allowed: single, normal");
  Armed armed{.trigger = StudioTrigger(condition_in(json, kind)),
              .reason = path.empty() ? kind : path + " " + kind,
              .before = duration_in(json, "before"),
              .after = duration_in(json, "after"),
              .is_repeated = mode == "normal",
              .row = feed_.store().end()};
  if (armed.before + armed.after > kLongest)
    throw BadRequest(422, "out_of_range", "'before' and 'after' together: at most 50 s");
  if (armed.trigger.waits_for_event()) return armed;
  std::string problem;
  armed.signal = signal_at(project_, path, problem);
  if (!armed.signal) throw BadRequest(422, "not_found", problem);
  armed.index = feed_.index(*armed.signal);
  return armed;
}

void StudioTriggers::obey(StudioClient& client, const StudioMessage& message) {
  const std::string action = word_in(message.json, "action", "");
  std::string state = "armed";
  if (action == "arm") {
    armed_.insert_or_assign(&client, armed_by(message));
  } else if (action == "disarm") {
    armed_.erase(&client);
    state = "disarmed";
  } else if (action == "force") {
    const TraceStore& store = feed_.store();
    const auto armed = armed_.find(&client);
    if (armed == armed_.end() || store.end() == store.begin())
      throw BadRequest(409, "conflict", "nothing is armed, or there are no rows yet");
    if (!armed->second.occasion) armed->second.occasion = store.t(store.end() - 1);
    state = "forced";
  } else {
    throw BadRequest(422, "bad_request", "action: '" + action + "'; allowed: arm, disarm, force");
  }
  client.send_text(text_of(Json{{"type", "trigger"}, {"seq", message.seq}, {"state", state}}));
}

void StudioTriggers::event(const TraceEvent& event) {
  for (auto& [client, armed] : armed_)
    if (!armed.occasion && armed.trigger.is_of(event.kind)) armed.occasion = event.t;
}

void StudioTriggers::judge_rows(Armed& armed) const {
  const TraceStore& store = feed_.store();
  if (!armed.signal || armed.occasion) return;
  const std::array<std::size_t, 1> index{armed.index};
  const std::uint64_t from = std::max(armed.row, store.begin());
  const TraceWindow rows = store.rows(index, from, store.end());
  for (std::size_t i = 0; i < rows.t.size() && !armed.occasion; ++i) {
    armed.row = from + i + 1;
    if (armed.trigger.judge(as_double(rows.columns[0].first[i], rows.columns[0].type)))
      armed.occasion = rows.t[i];
  }
}

/// The shot, once all rows after the occasion are there.
const StudioShot* StudioTriggers::shot_of(Armed& armed) {
  const TraceStore& store = feed_.store();
  if (!armed.occasion || store.end() == store.begin()) return nullptr;
  const std::int64_t t = *armed.occasion;
  if (store.t(store.end() - 1) < t + armed.after) return nullptr;
  const std::uint64_t behind = store.row_at(t + armed.after + 1);
  const StudioShot& shot = shots_.add(armed.reason, t, store.copy(store.row_at(t - armed.before), behind));
  armed.is_over = !armed.is_repeated;
  armed.occasion.reset();
  armed.trigger.begin();
  armed.row = behind;
  return &shot;
}

}  // namespace lockstep
