#include "projects/studio/triggers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <utility>

#include "projects/studio/api_values.hpp"
#include "projects/studio/message.hpp"

namespace lockstep {

using namespace studio_api;

namespace {

constexpr std::int64_t kAutoAfter = 1'000'000'000;  // of `auto` [ns]
constexpr StudioTriggerKind kLasting[] = {StudioTriggerKind::above, StudioTriggerKind::below,
                                          StudioTriggerKind::outside, StudioTriggerKind::bits};

/// Bits are those of whole numbers.
void check_type(const NamedSignal& signal, const std::string& kind) {
  if (kind == "bits" && is_real(signal.signal.value_type()))
    throw BadRequest(422, "wrong_type",
                     signal.name + " has no bits; allowed: BOOL, whole numbers and bit strings");
}

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

/// Whole numbers of 64 bits, as a number or a text of digits.
std::uint64_t word_of_bits_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found != json.end() && found->is_number_unsigned()) return found->get<std::uint64_t>();
  std::uint64_t number = 0;
  if (found != json.end() && found->is_string()) {
    const auto& text = found->get_ref<const std::string&>();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && end == text.data() + text.size()) return number;
  }
  throw BadRequest(422, "wrong_type",
                   std::string("'") + key + "' has to be a whole number from 0 to 2^64 - 1");
}

StudioTrigger::Condition condition_in(const Json& json, const std::string& kind) {
  const std::optional<StudioTriggerKind> known = studio_trigger_kind(kind);
  if (!known)
    throw BadRequest(422, "bad_request",
                     "kind: '" + kind + "'; allowed: " + std::string(studio_trigger_kinds()));
  StudioTrigger::Condition condition{*known, number_in(json, "level"), number_in(json, "upper"),
                                     number_in(json, "hysteresis")};
  if (condition.kind == StudioTriggerKind::bits) {
    condition.mask = word_of_bits_in(json, "mask");
    condition.wanted = word_of_bits_in(json, "value");
    if (condition.mask == 0 || (condition.wanted & ~condition.mask) != 0)
      throw BadRequest(422, "out_of_range", "'mask' has to have bits, and 'value' none besides them");
  }
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
  if (mode != "single" && mode != "normal" && mode != "auto")
    throw BadRequest(422, "bad_request", "mode: '" + mode + "'; allowed: single, normal, auto");
  Armed armed{.trigger = StudioTrigger(condition_in(json, kind)),
              .reason = path.empty() ? kind : path + " " + kind,
              .before = duration_in(json, "before"),
              .after = duration_in(json, "after"),
              .is_repeated = mode != "single",
              .row = feed_.store().end()};
  if (mode == "auto") {
    armed.patience = json.contains("auto") ? duration_in(json, "auto") : kAutoAfter;
    if (armed.patience == 0) throw BadRequest(422, "out_of_range", "'auto' has to be more than 0 ns");
  }
  if (armed.before + armed.after > kLongest)
    throw BadRequest(422, "out_of_range", "'before' and 'after' together: at most 50 s");
  if (armed.trigger.waits_for_event()) return armed;
  armed.signal = signal_of(path);
  check_type(*armed.signal, kind);
  const auto second = json.find("and");
  std::optional<NamedSignal> other;
  if (second != json.end() && !second->is_null()) {
    if (!second->is_object())
      throw BadRequest(422, "wrong_type", "'and' has to be an object with 'kind' and 'path'");
    const std::string holds = word_in(*second, "kind", "above");
    const StudioTrigger::Condition condition = condition_in(*second, holds);
    if (std::ranges::find(kLasting, condition.kind) == std::end(kLasting))
      throw BadRequest(422, "bad_request",
                       "kind of 'and': '" + holds + "'; allowed: above, below, outside, window, bits");
    other = signal_of(word_in(*second, "path", ""));
    check_type(*other, holds);
    armed.second = Second{StudioTrigger(condition), *other, 0};
  }
  armed.index = feed_.index(*armed.signal);
  if (armed.second) armed.second->index = feed_.index(*other);
  return armed;
}

/// @throws BadRequest
NamedSignal StudioTriggers::signal_of(const std::string& path) const {
  std::string problem;
  std::optional<NamedSignal> signal = signal_at(project_, path, problem);
  if (!signal) throw BadRequest(422, "not_found", problem);
  return *std::move(signal);
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
  const std::array<std::size_t, 2> indices{armed.index, armed.second ? armed.second->index : armed.index};
  const std::uint64_t from = std::max(armed.row, store.begin());
  const TraceWindow rows = store.rows(indices, from, store.end());
  for (std::size_t i = 0; i < rows.t.size() && !armed.occasion; ++i) {
    armed.row = from + i + 1;
    const bool is_one = armed.trigger.judge(rows.columns[0].first[i], rows.columns[0].type);
    const bool holds =
        !armed.second || armed.second->trigger.judge(rows.columns[1].first[i], rows.columns[1].type);
    if (is_one && holds) armed.occasion = rows.t[i];
  }
}

/// One that has waited for too long takes what is now.
void StudioTriggers::come_by_itself(Armed& armed) const {
  const TraceStore& store = feed_.store();
  if (armed.patience == 0 || armed.occasion || store.end() == store.begin()) return;
  const std::int64_t now = store.t(store.end() - 1);
  if (!armed.until) armed.until = now + armed.patience;
  if (now < *armed.until) return;
  armed.occasion = now;
  armed.is_by_itself = true;
}

/// The shot, once all rows after the occasion are there.
const StudioShot* StudioTriggers::shot_of(Armed& armed) {
  const TraceStore& store = feed_.store();
  if (!armed.occasion || store.end() == store.begin()) return nullptr;
  const std::int64_t t = *armed.occasion;
  if (store.t(store.end() - 1) < t + armed.after) return nullptr;
  const std::uint64_t behind = store.row_at(t + armed.after + 1);
  const std::string reason = armed.reason + (armed.is_by_itself ? ", by itself" : "");
  const StudioShot& shot = shots_.add(reason, t, store.copy(store.row_at(t - armed.before), behind));
  armed.is_over = !armed.is_repeated;
  armed.occasion.reset();
  armed.until.reset();
  armed.is_by_itself = false;
  armed.trigger.begin();
  armed.row = behind;
  return &shot;
}

}  // namespace lockstep
