/// What the pins of leading and following value offsets have in common.
#pragma once

#include "fb/block.hpp"
#include "tech_objects/jobs/modes.hpp"

namespace lockstep::shift_pins {

inline constexpr Choice kPhasingProfiles[] = {
    {0, "with dynamic parameters"},
    {1, "over leading value distance, from the current leading position"},
    {2, "over leading value distance, from StartPosition"},
    {5, "only cancel a waiting job"}};
inline constexpr Choice kOffsetProfiles[] = {
    {1, "over leading value distance, from the current leading position"},
    {2, "over leading value distance, from StartPosition"},
    {5, "only cancel a waiting job"}};
inline constexpr Choice kDirections[] = {{1, "while the leading value moves in positive direction"},
                                         {2, "while the leading value moves in negative direction"},
                                         {3, "in the current direction of the leading value"}};

/// Whether the profile of T, which has ProfileReference, is made over a leading distance.
template <class T>
bool over_distance(const Block& block) noexcept {
  const DINT profile = static_cast<const T&>(block).ProfileReference;
  return chooses(profile, ShiftProfileReference::from_here) ||
         chooses(profile, ShiftProfileReference::from_position);
}
template <class T>
bool from_position(const Block& block) noexcept {
  return chooses(static_cast<const T&>(block).ProfileReference, ShiftProfileReference::from_position);
}

template <class T>
constexpr Pin profile(std::span<const Choice> profiles) {
  return in<&T::ProfileReference>("ProfileReference", Unit::kNone, kAny, "way of offsetting",
                                  {.error = ErrorId::profile_reference, .choices = profiles});
}
template <auto Member>
constexpr Pin distance(std::string_view name, ErrorId error) {
  using T = typename pin_detail::MemberOf<decltype(Member)>::Block;
  return in<Member>(name, Unit::kLeading, kPositive,
                    "profiles 1, 2: leading distance over which the offset is made, > 0",
                    {.error = error, .relevant = &over_distance<T>});
}
template <class T>
constexpr Pin start_position() {
  return in<&T::StartPosition>("StartPosition", Unit::kLeading, kFinite,
                               "profile 2: leading position from which the offset is made",
                               {.error = ErrorId::start_position, .relevant = &from_position<T>});
}
template <class T>
constexpr Pin direction() {
  return in<&T::Direction>(
      "Direction", Unit::kNone, kAny, "profiles 1, 2: direction of the leading value",
      {.error = ErrorId::direction, .choices = kDirections, .relevant = &over_distance<T>});
}

}  // namespace lockstep::shift_pins
