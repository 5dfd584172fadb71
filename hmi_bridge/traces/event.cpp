#include "hmi_bridge/traces/event.hpp"

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/alarms/reactions.hpp"
#include "tech_objects/mco305_catalogue/errors.hpp"

namespace lockstep {
namespace {

constexpr std::string_view kAfterMissedTicks =
    "; ticks were missed within the second before, which it may come from";

std::string program_error_text(const Event& event) {
  const mco305::Error* const error = mco305::find_error(event.number);
  std::string text =
      error != nullptr ? std::string(error->text) : "a command that is not there ends the program";
  if (event.reaction >= 0)
    text += "; program " + std::to_string(event.reaction) + ", line " + std::to_string(event.line);
  return text;
}

}  // namespace

std::string_view event_kind_text(EventKind kind) noexcept {
  constexpr std::string_view texts[] = {
      "alarm",     "acknowledged", "job started",      "job done",        "job aborted", "job failed",
      "job ended", "overrun",      "command accepted", "command refused", "printed",     "program error"};
  return texts[static_cast<std::size_t>(kind)];
}

EventTexts::EventTexts(const Controller& controller) {
  for (const auto& object : controller.objects)
    objects_.push_back({object->name, std::string(kind_name(object->kind)), object.get()});
  for (const Instance& instance : controller.instances)
    instances_.push_back({instance.name, std::string(instance.type->name), nullptr});
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
  if (of_object(event.kind) && event.source < objects_.size()) {
    if (event.kind == EventKind::printed) objects_[event.source].object->take_line(told.text);
    if (event.kind == EventKind::program_error) told.text = program_error_text(event);
  }
  if (event.kind == EventKind::job_failed) told.text = error_text(static_cast<ErrorId>(event.number));
  return told;
}

}  // namespace lockstep
