#include "tech_objects/data_blocks/array.hpp"

#include <algorithm>
#include <array>

#include "tech_objects/data_blocks/cam_data.hpp"

namespace lockstep {
namespace {

#define MEMBER(structure, member, unit, text)                                                  \
  ElementMember {                                                                              \
#member, type_of < decltype(structure::member)>(), offsetof(structure, member), unit, text \
  }
#define POINT(member, unit, text) MEMBER(TO_Cam_Struct_PointData, member, unit, text)
#define SEGMENT(member, unit, text) MEMBER(TO_Cam_Struct_SegmentData, member, unit, text)

constexpr ElementMember kPointMembers[] = {POINT(x, Unit::kLeading, "leading value"),
                                           POINT(y, Unit::kPosition, "following value")};
constexpr ElementMember kSegmentMembers[] = {
    SEGMENT(xmin, Unit::kLeading, "leading value at which the segment begins"),
    SEGMENT(xmax, Unit::kLeading, "leading value at which the segment ends"),
    SEGMENT(a0, Unit::kNone, "coefficient of x^0"),
    SEGMENT(a1, Unit::kNone, "coefficient of x^1, x being the leading value less Origin"),
    SEGMENT(a2, Unit::kNone, "coefficient of x^2"),
    SEGMENT(a3, Unit::kNone, "coefficient of x^3"),
    SEGMENT(a4, Unit::kNone, "coefficient of x^4"),
    SEGMENT(a5, Unit::kNone, "coefficient of x^5"),
    SEGMENT(a6, Unit::kNone, "coefficient of x^6"),
    SEGMENT(sineAmplitude, Unit::kPosition, "amplitude of the sine that is added"),
    SEGMENT(sinePeriod, Unit::kNone, "angular frequency of the sine [rad per leading unit]"),
    SEGMENT(sinePhase, Unit::kNone, "phase of the sine at Origin [rad]"),
    SEGMENT(Origin, Unit::kLeading, "leading value from which coefficients and phase count")};

#undef SEGMENT
#undef POINT
#undef MEMBER

constexpr std::size_t kElementary = static_cast<std::size_t>(Type::TIME) + 1;

/// Of the types that a tag may have, in their order.
const std::array<ElementType, kElementary>& elementary_types() noexcept {
  static const std::array<ElementType, kElementary> types = [] {
    std::array<ElementType, kElementary> made;
    for (std::size_t i = 0; i < made.size(); ++i) {
      const auto type = static_cast<Type>(i);
      made[i] = {type_name(type), static_cast<std::size_t>(size_of(type)), type, {}};
    }
    return made;
  }();
  return types;
}

bool same_name(std::string_view a, std::string_view b) noexcept {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

constinit const ElementType kCamPointElement{"TO_Cam_Struct_PointData", sizeof(TO_Cam_Struct_PointData),
                                             Type::LREAL, kPointMembers};
constinit const ElementType kCamSegmentElement{"TO_Cam_Struct_SegmentData", sizeof(TO_Cam_Struct_SegmentData),
                                               Type::LREAL, kSegmentMembers};

const ElementMember* ElementType::find(std::string_view member) const noexcept {
  for (const ElementMember& known : members)
    if (same_name(known.name, member)) return &known;
  return nullptr;
}

std::span<const ElementType* const> structure_types() noexcept {
  static constexpr const ElementType* kTypes[] = {&kCamPointElement, &kCamSegmentElement};
  return kTypes;
}

const ElementType* find_element_type(std::string_view name) noexcept {
  for (const ElementType* type : structure_types())
    if (type->name == name) return type;
  const auto type = tag_type(name);
  return type ? &elementary_types()[static_cast<std::size_t>(*type)] : nullptr;
}

std::string array_type_name(const Array& array) {
  return "ARRAY[" + std::to_string(array.lower) + ".." + std::to_string(array.upper) + "] OF " +
         std::string(array.element->name);
}

}  // namespace lockstep
