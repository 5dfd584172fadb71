#include "hmi_bridge/traces/event.hpp"

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/alarms/reactions.hpp"

namespace lockstep {
namespace {

constexpr std::string_view kAfterMissedTicks =
    "; ticks were missed within the second before, which it may come from";

}  // namespace

std::string_view event_kind_text(EventKind kind) noexcept {
  constexpr std::string_view texts[] = {
      "alarm",      "acknowledged", "job started", "job done",         "job aborted",
      "job failed", "job ended",    "overrun",     "command accepted", "command refused"};
  return texts[static_cast<std::size_t>(kind)];
}

EventTexts::EventTexts(const Controller& controller) {
  for (const auto& object : controller.objects)
    objects_.push_back({object->name, std::string(kind_name(object->kind))});
  for (const Instance& instance : controller.instances)
    instances_.push_back({instance.name, std::string(instance.type->name)});
}

TraceEvent EventTexts::of(const Event& event, std::uint64_t lost) const {
  TraceEvent told;
  told.kind = event.kind;
  told.t = event.t;
  told.tick = event.tick;
  told.lost = lost;
  const std::vector<Name>& names = of_object(event.kind) ? objects_ : instances_;
  if (event.kind != EventKind::overrun && event.source < names.size()) {
    told.source = names[event.source].name;
    told.type = names[event.source].type;
  }
  told.number = event.number;
  told.reaction = event.reaction;
  if (event.kind == EventKind::alarm) {
    const Alarm* const alarm = find_alarm(event.number);
    if (alarm != nullptr) told.text = alarm->text;
    if (event.late) told.text += kAfterMissedTicks;
    told.reaction_text = alarm_reaction_text(event.reaction);
  }
  if (event.kind == EventKind::job_failed) told.text = error_text(static_cast<ErrorId>(event.number));
  return told;
}

}  // namespace lockstep
