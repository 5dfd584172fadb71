// What is kept across runs: tags with "retain", and the adjustments of absolute encoders.
#include <algorithm>
#include <filesystem>

#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/mco305_retain.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/data_blocks/variable.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// Structures of the data block on which the meaning of an encoder's value depends.
constexpr std::string_view kScales[] = {"Sensor[]", "LoadGear.",  "Mechanics.", "Modulo.",
                                        "Units.",   "UnitFactor", "Properties."};

bool scales(const Variable& variable) {
  if (variable.type == Type::TAG || variable.type == Type::AXIS) return false;
  if (variable.path.find("Homing") != std::string_view::npos) return false;
  return variable.path == "Actor.InverseDirection" ||
         std::any_of(std::begin(kScales), std::end(kScales),
                     [&](std::string_view scale) { return variable.path.starts_with(scale); });
}

/// The settings with which the value of an absolute encoder is a position, those that are not the default.
std::string scale_of(Axis& axis, std::size_t sensor) {
  std::string text;
  for (const Variable& variable : data_block_of(axis.kind).configuration) {
    if (!scales(variable)) continue;
    std::string path(variable.path);
    const auto brackets = path.find("[]");
    const std::size_t element = brackets != std::string::npos ? sensor : 0;
    const std::size_t offset = variable.offset + element * variable.stride;
    const Signal place{static_cast<char*>(axis.data_block()) + offset, variable.type, -1};
    const std::string value = kept_text(place.load(), variable.type);
    if (value == kept_text(variable.start_value(element), variable.type)) continue;
    if (brackets != std::string::npos) path.insert(brackets + 1, std::to_string(sensor + 1));
    text.append(text.empty() ? "" : " ").append(path).append("=").append(value);
  }
  return text;
}

bool keeps_adjustment(const Axis& axis, std::size_t sensor) {
  const auto type = axis.data.Sensor[sensor].Type;
  if (sensor > 0 && !axis.drive_settings.sensors[sensor - 1].exists) return false;
  return !axis.is_virtual() && (type == SensorType::ABSOLUTE || type == SensorType::CYCLIC_ABSOLUTE);
}

KeptValue adjustment_of(Axis& axis, std::size_t sensor) {
  EncoderAdjustment& adjustment = axis.encoder_adjustments[sensor];
  return {.name = axis.name + ".StatusSensor[" + std::to_string(sensor + 1) + "].AbsEncoderOffset",
          .signal = {&adjustment.offset, Type::LREAL, -1},
          .present = Signal{&adjustment.adjusted, Type::BOOL, -1},
          .basis = scale_of(axis, sensor)};
}

KeptValue array_of(const ArrayTag& tag) {
  const Array& array = tag.array;
  KeptValue kept{.name = tag.name, .signal = {array.memory, array.element->type, -1}};
  kept.array_type = array_type_name(array);
  for (std::int64_t index = array.lower; index <= array.upper; ++index) {
    char* const element = array.at(index);
    for (const ElementMember& member : array.element->members)
      kept.elements.push_back({element + member.offset, member.type, -1});
    if (array.element->members.empty()) kept.elements.push_back({element, array.element->type, -1});
  }
  kept.signal = kept.elements.front();
  return kept;
}

KeptValue text_of(const StringTag& tag) {
  KeptValue kept{.name = tag.name, .signal = {}, .elements = text_signals(tag.text)};
  kept.array_type = text_type_name(tag.text.capacity);
  kept.capacity = tag.text.capacity;
  kept.signal = kept.elements.front();
  return kept;
}

}  // namespace

void load_retain(const JsonValue* retain, const Loading& loading) {
  RetainConfig& config = loading.project.retain;
  for (const Tag& tag : loading.controller().tags)
    if (tag.retain) config.values.push_back({.name = tag.name, .signal = tag.signal});
  for (const ArrayTag* const tag : config.arrays) config.values.push_back(array_of(*tag));
  for (const StringTag& tag : loading.controller().strings)
    if (tag.retain) config.values.push_back(text_of(tag));
  for (const auto& object : loading.controller().objects)
    if (object->kind == ObjectKind::MCO_305) keep_mco305(static_cast<Mco305&>(*object), config.values);
  for (Axis* axis : loading.controller().axes)
    for (std::size_t sensor = 0; sensor < Axis::kSensors; ++sensor)
      if (keeps_adjustment(*axis, sensor)) config.values.push_back(adjustment_of(*axis, sensor));
  if (retain == nullptr) return;
  const Fields fields(*retain, keys::kRetain, loading.problems);
  if (const auto file = read_string(fields["file"], loading.problems)) {
    if (file->empty() || file->find('\0') != std::string_view::npos)
      loading.problems.report(*fields["file"],
                              fields["file"]->shown() + " is no name of a file; allowed: a path");
    else
      config.file = (std::filesystem::path(loading.folder) / *file).string();
  }
  if (const auto interval = read_value(fields, keys::kRetain["interval"], loading))
    config.interval = std::chrono::nanoseconds(interval->integer);
}

}  // namespace lockstep
