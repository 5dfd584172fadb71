#include "hmi_bridge/traces/event.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "scheduler/units.hpp"
#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/alarms/error_remedies.hpp"
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

// Whether an alarm is told by its cause: that a mark for homing is missing, and which, says more than its
// published text, that the device does not support it.
bool says_its_cause(const Event& event) {
  return event.number == alarm::kHomingNotSupported && event.detail.cause != AlarmCause::none;
}

}  // namespace

std::string_view event_kind_text(EventKind kind) noexcept {
  constexpr std::string_view texts[] = {
      "alarm",      "acknowledged",  "job started", "job done",         "job aborted",
      "job failed", "job ended",     "overrun",     "command accepted", "command refused",
      "printed",    "program error", "written",     "write refused"};
  return texts[static_cast<std::size_t>(kind)];
}

std::vector<std::string> detail_lines(const TraceEvent& event) {
  std::vector<std::string> lines;
  // As many digits as tell the value from its limit.
  int digits = 6;
  const auto rounded = [&](double value) { return fmt::format("{:.{}g}", value, digits); };
  const bool both = event.has_value() && event.has_limit() && event.value != event.limit;
  while (both && digits < 15 && rounded(event.value) == rounded(event.limit)) ++digits;
  const auto value_text = [&](const std::string& name, double value) {
    return fmt::format("{} {}{}{}", name, rounded(value), event.unit.empty() ? "" : " ", event.unit);
  };
  std::string values;
  if (event.has_value()) values = value_text(event.value_name, event.value);
  if (event.has_value() && event.has_limit()) values += ", " + value_text(event.limit_name, event.limit);
  if (!event.address.empty()) values += (values.empty() ? "" : "; ") + event.address;
  if (!values.empty()) lines.push_back(values);
  if (!event.cause.empty()) lines.push_back("cause: " + event.cause);
  if (!event.remedy.empty()) lines.push_back("remedy: " + event.remedy);
  return lines;
}

EventTexts::EventTexts(const Controller& controller, std::int64_t epoch) : epoch_(epoch) {
  const auto tag_at = [&](const bool* address) {
    for (const Tag& tag : controller.tags)
      if (address != nullptr && tag.signal.address == address) return tag.name;
    return std::string();
  };
  for (const auto& object : controller.objects) {
    objects_.push_back({object->name, std::string(kind_name(object->kind)), object.get()});
    Inputs& inputs = inputs_.emplace_back();
    for (std::size_t unit = 0; unit < std::size(inputs.units); ++unit)
      inputs.units[unit] = unit_of(static_cast<Unit>(unit), *object);
    if (!among(object->kind, kAnyAxis)) continue;
    const AxisData& data = static_cast<const Axis&>(*object).data;
    inputs.limits[0] = tag_at(data.PositionLimits_HW.MinSwitchAddress);
    inputs.limits[1] = tag_at(data.PositionLimits_HW.MaxSwitchAddress);
  }
  for (const Instance& instance : controller.instances) {
    blocks_.emplace_back(instance.block.get(), instances_.size());
    instances_.push_back({instance.name, std::string(instance.type->name), nullptr});
  }
  std::sort(blocks_.begin(), blocks_.end());
}

/// The instance in whose block a job lives: a block is one piece of memory, so it is the last one that does
/// not begin behind the job.
const EventTexts::Name* EventTexts::instance_with(const Job* job) const {
  if (job == nullptr) return nullptr;
  const auto behind =
      std::upper_bound(blocks_.begin(), blocks_.end(), static_cast<const void*>(job),
                       [](const void* a, const auto& b) { return std::less<>()(a, b.first); });
  return behind == blocks_.begin() ? nullptr : &instances_[std::prev(behind)->second];
}

std::string EventTexts::aborted_text(const Event& event) const {
  switch (event.aborted_by) {
    case AbortedBy::job: {
      const Name* const other = instance_with(event.aborted_by_job);
      return other == nullptr ? "by another job" : "by " + other->name + " (" + other->type + ")";
    }
    case AbortedBy::disabling:
      return "by disabling the axis";
    case AbortedBy::restart:
      return "by a restart of the axis";
    case AbortedBy::fixed_stop:
      return "by a fixed stop that the axis has met";
    case AbortedBy::end_of_cam:
      return "by the end of the cam of its coupling";
    case AbortedBy::unknown:
      break;
  }
  return "";
}

/// Which of several causes, limits, sensors, inputs and objects an alarm means.
std::string EventTexts::address_of(const Event& event) const {
  std::vector<std::string> parts;
  const AlarmDetail& detail = event.detail;
  const bool switches = event.number == alarm::kHardwareLimitSwitch;
  const bool positive = detail.cause == AlarmCause::positive_side;
  if (detail.object > 0 && detail.object <= objects_.size())
    parts.push_back(objects_[detail.object - 1].type + " " + objects_[detail.object - 1].name);
  if (switches && event.source < inputs_.size()) {
    const std::string& tag = inputs_[event.source].limits[positive ? 1 : 0];
    parts.push_back(std::string(positive ? "positive" : "negative") + " limit switch" +
                    (tag.empty() ? "" : ", input " + tag));
  } else if (const std::string_view text = cause_text(detail.cause).text;
             !text.empty() && !says_its_cause(event)) {
    parts.emplace_back(text);
  }
  if (detail.sensor != 0) parts.push_back("sensor " + std::to_string(detail.sensor));
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : "; ") + part;
  return all;
}

/// What is known of an alarm besides its number.
void EventTexts::fill(TraceEvent& told, const Event& event) const {
  const Alarm* const alarm = find_alarm(event.number);
  if (alarm == nullptr) return;
  const AlarmDetail& detail = event.detail;
  told.text = says_its_cause(event) ? cause_text(detail.cause).text : alarm->text;
  const std::string_view remedy = cause_text(detail.cause).remedy;
  told.cause = alarm->cause;
  told.remedy = remedy.empty() ? alarm->remedy : remedy;
  told.address = address_of(event);
  told.cause_number = static_cast<int>(detail.cause);
  told.sensor = detail.sensor;
  told.value_name = alarm->values.value;
  told.limit_name = alarm->values.limit;
  told.value = detail.value;
  told.limit = detail.limit;
  const auto unit = static_cast<std::size_t>(alarm->values.unit);
  if (event.source < inputs_.size() && unit < std::size(inputs_[event.source].units))
    told.unit = inputs_[event.source].units[unit];
}

TraceEvent EventTexts::of(const Event& event, std::uint64_t lost) const {
  TraceEvent told;
  told.kind = event.kind;
  told.t = event.t;
  told.tick = event.tick;
  told.lost = lost;
  if (epoch_ != 0) told.utime = epoch_ + event.t / 1000;
  if (event.object > 0 && event.object <= objects_.size()) told.object = objects_[event.object - 1].name;
  const std::vector<Name>& names = of_object(event.kind) ? objects_ : instances_;
  if (event.kind != EventKind::overrun && event.source < names.size()) {
    told.source = names[event.source].name;
    told.type = names[event.source].type;
  }
  told.number = event.number;
  told.reaction = event.reaction;
  if (event.kind == EventKind::alarm) {
    fill(told, event);
    if (event.late) told.text += kAfterMissedTicks;
    told.reaction_text = alarm_reaction_text(event.reaction);
  }
  if (of_object(event.kind) && event.source < objects_.size()) {
    if (event.kind == EventKind::printed && event.number == 0)
      objects_[event.source].object->take_line(told.text);
    else if (event.kind == EventKind::printed)
      told.text = fmt::format("{} printed lines or errors are lost: they came faster than they were told",
                              event.number);
    if (event.kind == EventKind::program_error) told.text = program_error_text(event);
  }
  if (event.kind == EventKind::job_failed) {
    told.text = error_text(static_cast<ErrorId>(event.number));
    told.remedy = error_remedy(static_cast<ErrorId>(event.number));
  }
  if (event.kind == EventKind::job_aborted) told.text = aborted_text(event);
  return told;
}

}  // namespace lockstep
