#include "projects/studio/api_values.hpp"

#include <cmath>
#include <utility>

#include "hmi_bridge/traces/text_literal.hpp"
#include "scheduler/text.hpp"

namespace lockstep::studio_api {

Json number_json(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  return number;
}

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

Json shot_json(const StudioShot& shot) {
  return {{"id", shot.id}, {"reason", shot.reason}, {"t", std::to_string(shot.t)}};
}

std::unique_ptr<StudioDerived> derived_at(const Project& project, std::string_view text,
                                          std::string& problem) {
  return StudioDerived::compile(
      text,
      [&project](const std::string& path) -> std::optional<Type> {
        const FoundOperand found = project.names.find(path);
        if (!found.place || found.place->signal.value_type() >= Type::AXIS) return {};
        return found.place->signal.value_type();
      },
      problem);
}

std::optional<NamedSignal> signal_at(const Project& project, const std::string& path, std::string& problem) {
  if (StudioDerived::is_one(path)) {
    const std::unique_ptr<StudioDerived> derived = derived_at(project, path, problem);
    if (!derived) return {};
    return NamedSignal{path, Signal{nullptr, derived->type(), -1}};
  }
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

std::optional<ReadPlace> read_place_at(const Project& project, const std::string& path,
                                       std::string& problem) {
  if (const StringTag* const tag = project.names.find_string(path)) {
    ReadPlace place{tag->name, {}, tag->text.capacity};
    // No path has a '#', so that nobody else asks for them.
    for (const Signal& signal : text_signals(tag->text))
      place.signals.push_back({tag->name + "#" + std::to_string(place.signals.size()), signal});
    return place;
  }
  std::optional<NamedSignal> signal = signal_at(project, path, problem);
  if (!signal) return {};
  ReadPlace place{signal->name, {}};
  place.signals.push_back(std::move(*signal));
  return place;
}

Json reading_json(const ReadPlace& place, std::span<const Value> values, const StudioUnits& units) {
  if (place.capacity > 0)
    return {{"path", place.path},
            {"type", text_type_name(place.capacity)},
            {"unit", ""},
            {"value", text_to_utf8(text_of(values, place.capacity))}};
  const NamedSignal& signal = place.signals.front();
  const Type type = signal.signal.value_type();
  return {{"path", place.path},
          {"type", type_name(type)},
          {"unit", units.of(signal)},
          {"value", value_json(values.front(), type)}};
}

}  // namespace lockstep::studio_api
