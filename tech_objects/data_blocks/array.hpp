/// Arrays of elementary values and of published structures: ARRAY[lower..upper] OF element.
/// @source IEC 61131-3:2013, 6.4.4.5; S7-1500T synchronous operation V7, 12.2.4 (structures of a cam)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// A member of the elements of an array that are structures.
struct ElementMember {
  std::string_view name;   ///< as published
  Type type = Type::BOOL;  ///< an elementary one
  std::size_t offset = 0;  ///< in the element [byte]
  Unit unit = Unit::kNone;
  std::string_view text;  ///< meaning
};

/// What the elements of an array are: values of an elementary type, or structures.
struct ElementType {
  std::string_view name;                     ///< "LREAL", "TO_Cam_Struct_PointData"
  std::size_t size = 0;                      ///< [byte]
  Type type = Type::BOOL;                    ///< of an elementary element
  std::span<const ElementMember> members{};  ///< of a structure; empty: an elementary element

  /// The member with a name, without regard to case; nullptr if there is none.
  const ElementMember* find(std::string_view member) const noexcept;
};

/// TO_Cam_Struct_PointData and TO_Cam_Struct_SegmentData, in memory as in the data block of a cam.
extern const ElementType kCamPointElement;
extern const ElementType kCamSegmentElement;

/// The type of elements with a published name; nullptr if arrays cannot hold it.
const ElementType* find_element_type(std::string_view name) noexcept;
/// The structures that arrays may hold besides elementary values.
std::span<const ElementType* const> structure_types() noexcept;

/// An array. Its memory is a tag's, or whoever's has made it. Thread of its content: the cycle.
struct Array {
  const ElementType* element = nullptr;
  DINT lower = 1;  ///< index of the first element
  DINT upper = 0;  ///< index of the last one, ≥ lower
  void* memory = nullptr;

  std::size_t count() const noexcept {
    return static_cast<std::size_t>(std::int64_t{upper} - std::int64_t{lower} + 1);
  }
  bool holds(std::int64_t index) const noexcept { return index >= lower && index <= upper; }
  /// Address of the element with an index that it holds.
  char* at(std::int64_t index) const noexcept {
    return static_cast<char*>(memory) + static_cast<std::size_t>(index - lower) * element->size;
  }
};

/// Elements at equal distances of which an index chooses one at run time.
struct ElementRange {
  DINT lower = 0;            ///< index of the first one
  std::uint32_t count = 0;   ///< 0: no choice, the address is fixed
  std::uint32_t stride = 0;  ///< [byte]

  /// Distance from the first element to that with an index [byte]; kOutside if there is none.
  static constexpr std::uint64_t kOutside = ~std::uint64_t{0};
  std::uint64_t offset_of(std::int64_t index) const noexcept {
    const std::uint64_t place =
        static_cast<std::uint64_t>(index) - static_cast<std::uint64_t>(std::int64_t{lower});
    return place < count ? place * stride : kOutside;
  }
};

/// "ARRAY[1..100] OF LREAL".
std::string array_type_name(const Array& array);

}  // namespace lockstep
