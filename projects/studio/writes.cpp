#include "projects/studio/writes.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "hmi_bridge/traces/text_literal.hpp"
#include "projects/json/problem.hpp"
#include "projects/loader/written_value.hpp"
#include "projects/studio/api_values.hpp"

namespace lockstep {
namespace {

using namespace studio_api;

constexpr std::chrono::seconds kPatience{2};  // for a tick that takes a batch
constexpr std::size_t kTold = 20;             // writes of a batch that are told as events

/// A number as JSON has it; none if it is something else.
std::optional<GivenNumber> number_of(const Json& json, Type type) {
  if (json.is_boolean() && type == Type::BOOL) return std::int64_t{json.get<bool>() ? 1 : 0};
  if (json.is_number_unsigned()) return json.get<std::uint64_t>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number_float() && type != Type::TIME) return json.get<double>();
  const bool may_be_text =
      type == Type::LINT || type == Type::ULINT || type == Type::LWORD || type == Type::TIME;
  if (!json.is_string() || !may_be_text) return std::nullopt;
  const auto& text = json.get_ref<const std::string&>();
  const char* const end = text.data() + text.size();
  std::int64_t whole = 0;
  if (const auto [to, error] = std::from_chars(text.data(), end, whole); error == std::errc{} && to == end)
    return whole;
  std::uint64_t natural = 0;
  if (const auto [to, error] = std::from_chars(text.data(), end, natural); error == std::errc{} && to == end)
    return natural;
  return std::nullopt;
}

std::string expected_of(Type type) {
  if (type == Type::BOOL) return "true or false";
  if (is_real(type)) return "a number";
  if (type == Type::TIME) return "whole nanoseconds, as a number or a text of digits";
  if (type == Type::LINT || type == Type::ULINT || type == Type::LWORD)
    return "a whole number, or a text of its digits";
  return "a whole number";
}

std::string_view code_of(WriteProblem problem) noexcept {
  if (problem == WriteProblem::not_writable) return "not_writable";
  return problem == WriteProblem::wrong_type ? "wrong_type" : "out_of_range";
}

/// Bits of a whole integer or bit string that may have any value.
bool has_free_bits(const Operand& place) {
  const Type type = place.signal.type;
  const bool is_word = is_bit_string(type) || is_integer(type);
  const bool is_free =
      place.variable == nullptr || (place.variable->range.unbounded() && place.variable->choices.empty());
  return place.signal.bit < 0 && is_word && is_free;
}

std::string old_text_of(const ChosenWrite& write) {
  return text_to_utf8(write.old_text.substr(0, write.old_text.find('\0')));
}

Json before_of(const ChosenWrite& write, Type type, bool is_text) {
  return is_text ? Json(old_text_of(write)) : value_json(write.before, type);
}

/// A key that is none, such as one with a mistake in it; empty: there is none.
std::string unknown_key(const Json& json, std::initializer_list<std::string_view> allowed) {
  std::string names;
  for (const std::string_view name : allowed) names += (names.empty() ? "" : ", ") + std::string(name);
  for (const auto& [key, value] : json.items())
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end())
      return "unknown key " + quote(key) + "; allowed: " + names;
  return "";
}

}  // namespace

void StudioWrites::add_text(const StringTag& tag, const Json& json, Batch& batch, Wrong& wrong) const {
  const Json more = {{"path", tag.name}, {"value", json}};
  if (!json.is_string()) return wrong.add("wrong_type", tag.name + " takes a text", more);
  const auto text = text_from_utf8(json.get<std::string>());
  if (!text)
    return wrong.add("wrong_type", tag.name + " takes printable characters of ISO 8859-1 alone", more);
  if (text->size() > tag.text.capacity)
    return wrong.add("out_of_range",
                     tag.name + " holds " + std::to_string(tag.text.capacity) + " characters at most", more);
  batch.writes.push_back({.text = tag.text, .new_text = *text});
  batch.targets.push_back({tag.name, Type::BOOL, true, text_of(json)});
}

void StudioWrites::add(const Json& json, Batch& batch, Wrong& wrong) const {
  const auto path_of = json.is_object() ? json.find("path") : json.end();
  if (path_of == json.end() || !path_of->is_string() || !json.contains("value"))
    return wrong.add("bad_request", "each write has a 'path' and a 'value'");
  if (const std::string unknown = unknown_key(json, {"path", "value", "bits"}); !unknown.empty())
    return wrong.add("bad_request", unknown, {{"path", *path_of}});
  const std::string path = path_of->get<std::string>();
  const Json& wanted = json.at("value");
  if (const StringTag* const text = project_.names.find_string(path))
    return add_text(*text, wanted, batch, wrong);
  const Json more = {{"path", path}, {"value", wanted}};
  const FoundOperand found = project_.names.find(path);
  if (!found.place) return wrong.add("not_found", found.problem, more);
  const Type type = found.place->signal.value_type();
  const std::optional<GivenNumber> number = number_of(wanted, type);
  if (!number)
    return wrong.add("wrong_type",
                     path + " is of type " + std::string(type_name(type)) + "; allowed: " + expected_of(type),
                     more);
  const WrittenValue written = written_value(*found.place, *number);
  if (written.problem != WriteProblem::none)
    return wrong.add(code_of(written.problem), path + ": " + written.text, more);
  ChosenWrite write{.signal = found.place->signal, .value = written.value};
  if (const auto bits = json.find("bits"); bits != json.end()) {
    const std::optional<GivenNumber> mask = number_of(*bits, Type::LWORD);
    const auto* const whole = mask ? std::get_if<std::int64_t>(&*mask) : nullptr;
    const auto* const natural = mask ? std::get_if<std::uint64_t>(&*mask) : nullptr;
    if ((whole == nullptr && natural == nullptr) || !has_free_bits(*found.place))
      return wrong.add("wrong_type",
                       path + ": 'bits' is a mask, of whole integers and bit strings without a range alone",
                       more);
    write.mask = natural != nullptr ? *natural : static_cast<std::uint64_t>(*whole);
  }
  batch.writes.push_back(std::move(write));
  batch.targets.push_back({path, type, false, text_of(wanted)});
}

void StudioWrites::audit(const Target& target, std::string_view peer, const std::string& before,
                         bool accepted, const std::string& why) const {
  if (powers_.audit == nullptr) return;
  AuditEntry entry;
  entry.tick = accepted ? crossing_.tick() : -1;
  entry.via = "studio";
  entry.from = peer;
  entry.target = target.path;
  entry.action = "write";
  entry.before = before;
  entry.after = accepted ? target.wanted : "";
  entry.accepted = accepted;
  entry.why = why;
  entry.source = entry.from.substr(0, entry.from.rfind(':'));
  entry.subject = accepted ? target.path : "refused";
  powers_.audit->add(std::move(entry));
}

/// Refusals are told as events too: somebody has tried.
void StudioWrites::refuse(const Wrong& wrong, std::string_view peer) const {
  const Json& first = wrong.errors.front();
  TraceEvent event;
  event.kind = EventKind::write_refused;
  event.source = first.value("path", "");
  event.text = first.value("message", "");
  event.address = peer;
  audit({event.source, Type::BOOL, false, ""}, peer, "", false, event.text);
  if (powers_.tell) powers_.tell(std::move(event));
}

void StudioWrites::write(const StudioRequest& request, Done done) {
  if (!powers_.why_no_write.empty()) {
    Wrong wrong{403};
    wrong.add("not_allowed", powers_.why_no_write);
    refuse(wrong, request.peer);
    return done(studio_api::answer_of(wrong));
  }
  const Json json = parsed(request.body);
  const auto writes = json.is_object() ? json.find("writes") : json.end();
  if (writes == json.end() || !writes->is_array() || writes->empty())
    throw BadRequest(422, "bad_request", "'writes' has to be a list of {\"path\", \"value\"}, one at least");
  if (const std::string unknown = unknown_key(json, {"writes"}); !unknown.empty())
    throw BadRequest(422, "bad_request", unknown);
  if (writes->size() > ChosenWrites::kMaximum)
    throw BadRequest(
        422, "too_many",
        std::to_string(writes->size()) + " writes; allowed: " + std::to_string(ChosenWrites::kMaximum));
  if (waiting_.size() >= kWaiting)
    throw BadRequest(503, "busy", "too many writes wait for a tick; allowed: " + std::to_string(kWaiting));
  Wrong wrong{422};
  Batch batch;
  batch.peer = request.peer;
  batch.body = request.body;
  for (const Json& one : *writes) add(one, batch, wrong);
  if (!wrong.errors.empty()) {
    refuse(wrong, request.peer);
    return done(studio_api::answer_of(wrong));
  }
  batch.until = Clock::now() + kPatience;
  batch.done = std::move(done);
  waiting_.push_back(std::move(batch));
  look(Clock::now());
}

std::vector<ChosenWrite> StudioWrites::chosen(const std::string& body) const {
  const Json json = parsed(body);
  Wrong wrong{422};
  Batch batch;
  for (const Json& one : json.at("writes")) add(one, batch, wrong);
  if (!wrong.errors.empty()) return {};
  return std::move(batch.writes);
}

StudioAnswer StudioWrites::answer_of(const Batch& batch) const {
  Json writes = Json::array();
  const std::vector<ChosenWrite>& applied = crossing_.batch();
  for (std::size_t i = 0; i < batch.targets.size(); ++i) {
    const Target& target = batch.targets[i];
    writes.push_back({{"path", target.path}, {"before", before_of(applied[i], target.type, target.is_text)}});
    if (target.is_text)
      writes.back()["value"] = text_to_utf8(applied[i].new_text);
    else
      writes.back()["value"] = value_json(applied[i].value, target.type);
  }
  const std::int64_t tick = crossing_.tick();
  return studio_api::answer_of(
      Json{{"tick", std::to_string(tick)}, {"t", std::to_string(time_of(tick))}, {"writes", writes}});
}

void StudioWrites::tell_applied(const Batch& batch) const {
  const std::vector<ChosenWrite>& applied = crossing_.batch();
  for (std::size_t i = 0; i < batch.targets.size(); ++i) {
    const Target& target = batch.targets[i];
    const std::string before = text_of(before_of(applied[i], target.type, target.is_text));
    audit(target, batch.peer, before, true, "");
    if (i >= kTold || !powers_.tell) continue;
    TraceEvent event;
    event.kind = EventKind::written;
    event.tick = static_cast<std::uint64_t>(crossing_.tick());
    event.t = time_of(crossing_.tick());
    event.source = target.path;
    event.type = target.is_text ? "STRING" : type_name(target.type);
    event.text = before + " → " + target.wanted;
    if (i + 1 == kTold && batch.targets.size() > kTold)
      event.text += ", and " + std::to_string(batch.targets.size() - kTold) + " more";
    event.address = batch.peer;
    powers_.tell(std::move(event));
  }
}

void StudioWrites::look(Clock::time_point now) {
  while (!waiting_.empty()) {
    Batch& batch = waiting_.front();
    if (!batch.is_posted) batch.is_posted = crossing_.post(batch.writes);
    if (powers_.simulation != nullptr && batch.is_posted)
      powers_.simulation->while_paused([this](std::int64_t tick) { crossing_.apply(tick); });
    if (batch.is_posted && crossing_.is_applied()) {
      tell_applied(batch);
      if (powers_.journal) powers_.journal(crossing_.tick(), batch.body);
      if (batch.done) batch.done(answer_of(batch));
      waiting_.pop_front();
      continue;
    }
    for (Batch& late : waiting_)
      if (late.done && now >= late.until)
        std::exchange(late.done, nullptr)(
            error_answer(503, "busy",
                         late.is_posted ? "no tick has taken it within two seconds; one that comes will"
                                        : "no tick has taken it within two seconds"));
    // What waits behind it and has been answered is not written any more.
    std::erase_if(waiting_, [](const Batch& one) { return !one.done && !one.is_posted; });
    return;
  }
}

}  // namespace lockstep
