#include "projects/studio/panels.hpp"

#include <algorithm>
#include <charconv>
#include <random>
#include <string>
#include <string_view>
#include <utility>

#include "hmi_bridge/lcm/commands.hpp"
#include "projects/studio/api_values.hpp"
#include "projects/studio/message.hpp"

namespace lockstep {
namespace {

using namespace studio_api;

constexpr std::int32_t kActions = 8;

std::int32_t action_of(const Json& message) {
  const auto given = message.find("action");
  std::string allowed;
  for (std::int32_t action = 0; action < kActions; ++action) {
    if (given != message.end() && given->is_string() &&
        given->get_ref<const std::string&>() == action_text(action))
      return action;
    allowed += (allowed.empty() ? "" : ", ") + std::string(action_text(action));
  }
  throw BadRequest(422, "bad_request", "'action' is none; allowed: " + allowed);
}

/// A number that may exceed 2^53: a text of digits, or a whole number. @throws BadRequest
std::int64_t whole_in(const Json& message, const char* key) {
  const auto given = message.find(key);
  if (given != message.end() && given->is_number_integer()) return given->get<std::int64_t>();
  if (given != message.end() && given->is_string()) {
    const auto& text = given->get_ref<const std::string&>();
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && end == text.data() + text.size()) return number;
  }
  throw BadRequest(422, "wrong_type", std::string("'") + key + "' has to be a whole number, or a text of it");
}

bool calms(std::int32_t action) noexcept {
  return action == command_t::STOP || action == command_t::DISABLE;
}

command_t command_in(const Json& message) {
  command_t command{};
  command.action = action_of(message);
  const auto axis = message.find("axis");
  if (axis == message.end() || !axis->is_string())
    throw BadRequest(422, "wrong_type", "'axis' has to be the name of an axis");
  command.axis = axis->get<std::string>();
  if (const auto value = message.find("value"); value != message.end()) {
    if (!value->is_number()) throw BadRequest(422, "wrong_type", "'value' has to be a number");
    command.value = value->get<double>();
  }
  return command;
}

Json panel_json(const SharedDesk::Panel& panel, std::int64_t sender) {
  const panel_t& stand = panel.stand;
  Json json = {{"axis", stand.axis},
               {"type", stand.type},
               {"run", std::to_string(stand.run)},
               {"beat", stand.beat},
               {"t", std::to_string(stand.t)},
               {"status_word", std::to_string(stand.status_word)},
               {"alarm", stand.alarm},
               {"enables", stand.enables != 0},
               {"has_position", stand.has_position != 0},
               {"position", number_json(stand.position)},
               {"velocity", number_json(stand.velocity)},
               {"speed", number_json(stand.speed)},
               {"jog_velocity", stand.jog_velocity},
               {"velocity_unit", stand.velocity_unit}};
  if (!panel.enabled_by.empty()) json["enabled_by"] = panel.enabled_by;
  json["held_by"] = panel.holder == 0 ? "" : panel.holder == sender ? "me" : "another";
  return json;
}

}  // namespace

std::int64_t StudioPanels::sender_of(StudioClient& client) {
  std::int64_t& sender = senders_[&client];
  while (sender == 0) {
    std::random_device chance;
    sender = static_cast<std::int64_t>(std::uint64_t{chance()} << 32 | chance());
  }
  return sender;
}

void StudioPanels::obey(StudioClient& client, const StudioMessage& message) {
  command_t command = command_in(message.json);
  Json answer = {{"type", "command"},
                 {"seq", message.seq},
                 {"axis", command.axis},
                 {"action", action_text(command.action)}};
  const Json reasons = reasons_json(powers_);
  CommandDesk::Verdict verdict;
  if (const auto reason = reasons.find("command"); reason != reasons.end()) {
    verdict.reason = *reason;
    if (powers_.tell) {
      TraceEvent event;
      event.kind = EventKind::command_refused;
      event.type = action_text(command.action);
      event.text = verdict.reason;
      event.address = client.peer();
      powers_.tell(std::move(event));
    }
  } else {
    command.sender = sender_of(client);
    // What brings to rest is heard from a page that has heard nothing for long, too.
    const bool is_free = calms(command.action) && !newest_.empty();
    command.run = is_free ? newest_.front().stand.run : whole_in(message.json, "run");
    command.beat = is_free ? newest_.front().stand.beat : whole_in(message.json, "beat");
    if (!calms(command.action) || message.json.contains("sequence"))
      command.sequence = whole_in(message.json, "sequence");
    verdict = powers_.desk->give(command, client.peer());
  }
  answer["accepted"] = verdict.accepted;
  if (!verdict.accepted) answer["reason"] = verdict.reason;
  client.send_text(text_of(answer));
}

void StudioPanels::leave(StudioClient& client) {
  const auto known = senders_.find(&client);
  if (known == senders_.end()) return;
  if (powers_.desk != nullptr) powers_.desk->leave(known->second);
  senders_.erase(known);
}

Json StudioPanels::panels_for(StudioClient& client) {
  if (newest_.empty() && powers_.desk != nullptr) newest_ = powers_.desk->panels(CommandRoute::studio);
  const auto known = senders_.find(&client);
  const std::int64_t sender = known == senders_.end() ? 0 : known->second;
  return array_of(newest_, [sender](const SharedDesk::Panel& panel) { return panel_json(panel, sender); });
}

bool StudioPanels::is_due(Clock::time_point now) {
  if (powers_.desk == nullptr || !powers_.desk->has_axes(CommandRoute::studio) || now < next_) return false;
  next_ = std::max(next_ + SharedDesk::kBeat, now);
  powers_.desk->beat(now);
  newest_ = powers_.desk->panels(CommandRoute::studio);
  return true;
}

}  // namespace lockstep
