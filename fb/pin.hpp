/// Declaration of the pins of function blocks: one constexpr table per block feeds wiring, checks,
/// `describe`, traces and the conformance run.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/data_blocks/array.hpp"
#include "tech_objects/objects/technology_object.hpp"
#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

class Block;

enum class PinClass : std::uint8_t { input, output, in_out };

/// One pin of a block. Its default is the value that a newly made block holds.
struct Pin {
  std::string_view name;  ///< as published
  PinClass pin_class;
  Type type;
  Unit unit = Unit::kNone;
  Range range = kAny;
  std::string_view text;                     ///< meaning
  ErrorId error = ErrorId::none;             ///< reported for a value that is not permitted
  std::span<const Choice> choices{};         ///< the permitted values, where they are an enumeration
  bool (*relevant)(const Block&) = nullptr;  ///< whether the value counts, given the others; nullptr: always
  ObjectKinds objects = 0;                   ///< kinds that a technology-object pin accepts
  const ElementType* element = nullptr;      ///< of the arrays that an array pin takes
  void* (*address)(Block&) = nullptr;        ///< where the value lives in an instance

  Signal signal(Block& block) const { return {address(block), type, -1}; }
  /// Whether the present value is permitted: finite, in range and among the choices.
  bool allows(const Block& block) const noexcept;
};

namespace pin_detail {
template <class T>
struct MemberOf;
template <class T, class Owner>
struct MemberOf<T Owner::*> {
  using Value = T;
  using Block = Owner;
};
}  // namespace pin_detail

/// Address of a member of a block whose concrete type is T.
template <auto Member, class T>
void* member_address(Block& block) {
  return &(static_cast<T&>(block).*Member);
}

/// Further facts of an input, given with designated initializers.
struct InputFacts {
  ErrorId error = ErrorId::none;
  std::span<const Choice> choices{};
  bool (*relevant)(const Block&) = nullptr;
};

/// Declares a numeric or BOOL input.
template <auto Member>
constexpr Pin in(std::string_view name, Unit unit, Range range, std::string_view text,
                 InputFacts facts = {}) {
  using M = pin_detail::MemberOf<decltype(Member)>;
  return {.name = name,
          .pin_class = PinClass::input,
          .type = type_of<typename M::Value>(),
          .unit = unit,
          .range = range,
          .text = text,
          .error = facts.error,
          .choices = facts.choices,
          .relevant = facts.relevant,
          .address = &member_address<Member, typename M::Block>};
}

/// Declares an input that takes a technology object.
template <auto Member>
constexpr Pin object(std::string_view name, ObjectKinds objects, std::string_view text) {
  using M = pin_detail::MemberOf<decltype(Member)>;
  return {.name = name,
          .pin_class = PinClass::input,
          .type = Type::AXIS,
          .text = text,
          .error = ErrorId::no_technology_object,
          .objects = objects,
          .address = &member_address<Member, typename M::Block>};
}

/// Declares what a block takes by reference: an array of a type of elements, of any bounds. It may stay
/// unwired; what that means is the block's matter.
template <auto Member>
constexpr Pin array(std::string_view name, const ElementType& element, std::string_view text) {
  using M = pin_detail::MemberOf<decltype(Member)>;
  return {.name = name,
          .pin_class = PinClass::in_out,
          .type = Type::ARRAY,
          .text = text,
          .element = &element,
          .address = &member_address<Member, typename M::Block>};
}

/// Declares an output.
template <auto Member>
constexpr Pin out(std::string_view name, std::string_view text, Unit unit = Unit::kNone) {
  using M = pin_detail::MemberOf<decltype(Member)>;
  return {.name = name,
          .pin_class = PinClass::output,
          .type = type_of<typename M::Value>(),
          .unit = unit,
          .text = text,
          .address = &member_address<Member, typename M::Block>};
}

/// The table of a block's pins, in published order.
template <class... P>
constexpr std::array<Pin, sizeof...(P)> pins(P... list) {
  return {list...};
}

}  // namespace lockstep
