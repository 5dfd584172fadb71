#include "scheduler/units.hpp"

#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/data_blocks/choices.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "tech_objects/sensing/measuring_input.hpp"
#include "tech_objects/switching/cam_track.hpp"
#include "tech_objects/switching/output_cam.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// A name without what a choice explains behind it.
std::string_view short_text(std::span<const Choice> choices, std::int64_t value) noexcept {
  for (const Choice& choice : choices)
    if (choice.value == value) return choice.text.substr(0, choice.text.find(" ("));
  return "u";
}

bool is_angle(UDINT unit) noexcept {
  constexpr int kRadian = 1004, kDegree = 1005, kFineDegree = 1537;
  return unit == kRadian || unit == kDegree || unit == kFineDegree;
}

std::string_view length_unit(UDINT unit, bool rotary) noexcept {
  return rotary && !is_angle(unit) ? "°" : short_text(kUnitsLengthUnit, static_cast<std::int64_t>(unit));
}

/// The object in whose positions another one counts; itself where it has its own.
const TechnologyObject& counted_in(const TechnologyObject& object) noexcept {
  const TechnologyObject* other = nullptr;
  if (object.kind == ObjectKind::TO_MeasuringInput)
    other = static_cast<const MeasuringInput&>(object).measured;
  if (object.kind == ObjectKind::TO_OutputCam) other = static_cast<const OutputCam&>(object).assigned;
  if (object.kind == ObjectKind::TO_CamTrack) other = static_cast<const CamTrack&>(object).assigned;
  return other != nullptr ? *other : object;
}

std::string_view position_unit(const TechnologyObject& object) noexcept {
  const TechnologyObject& counted = counted_in(object);
  if (among(counted.kind, kAnyAxis)) {
    const AxisData& data = static_cast<const ConfiguredAxis&>(counted).data;
    return length_unit(data.Units.LengthUnit, data.Properties.MotionType == MotionType::rotary);
  }
  if (counted.kind != ObjectKind::TO_ExternalEncoder) return "u";
  const auto& data = static_cast<const ExternalEncoder&>(counted).data;
  return length_unit(data.Units.LengthUnit, data.Properties.MotionType == MotionType::rotary);
}

/// Of a speed axis, which turns and has no position.
std::string speed_unit(const ConfiguredAxis& axis) {
  const VariableAddress place = find_variable(axis.kind, "Units.VelocityUnit");
  const auto unit = static_cast<std::int64_t>(axis.data.Units.VelocityUnit);
  return place.variable == nullptr ? "u/s" : std::string(short_text(place.variable->choices, unit));
}

/// What the leading values of an axis are counted in, if that is the same for all of them.
std::string leading_unit(const TechnologyObject& object) {
  std::string found;
  if (object.kind == ObjectKind::TO_SynchronousAxis)
    for (const LeadingValue& leading : static_cast<const ConfiguredAxis&>(object).leading_values) {
      const std::string unit(position_unit(*leading.source));
      if (!found.empty() && found != unit) return std::string(unit_text(Unit::kLeading));
      found = unit;
    }
  return found.empty() ? std::string(unit_text(Unit::kLeading)) : found;
}

const TechnologyObject* wired(const Instance& instance, bool leading) noexcept {
  for (const Pin& pin : instance.type->pins)
    if (pin.type == Type::AXIS && (pin.name == "Master") == leading)
      // NOLINTNEXTLINE(performance-no-int-to-ptr): what a pin of this type holds is an address
      return reinterpret_cast<const TechnologyObject*>(pin.signal(*instance.block).load().u);
  return nullptr;
}

}  // namespace

std::string unit_of(Unit unit, const TechnologyObject& object) {
  const std::string_view generic = unit_text(unit);
  if (unit == Unit::kLeading) return leading_unit(object);
  if (unit < Unit::kPosition || unit > Unit::kJerk) return std::string(generic);
  if (object.kind == ObjectKind::TO_SpeedAxis) {
    const std::string speed = speed_unit(static_cast<const ConfiguredAxis&>(object));
    if (unit == Unit::kPosition) return std::string(generic);
    if (unit == Unit::kVelocity) return speed;
    return speed + (unit == Unit::kAcceleration ? "/s" : "/s²");
  }
  return std::string(position_unit(object)) + std::string(generic.substr(1));  // behind the "u"
}

const TechnologyObject* object_of(const Instance& instance) noexcept {
  return wired(instance, false);
}

std::string unit_of(Unit unit, const Instance& instance) {
  const TechnologyObject* const leads = unit == Unit::kLeading ? wired(instance, true) : nullptr;
  if (leads != nullptr) return unit_of(Unit::kPosition, *leads);
  const TechnologyObject* const object = object_of(instance);
  return object == nullptr ? std::string(unit_text(unit)) : unit_of(unit, *object);
}

}  // namespace lockstep
