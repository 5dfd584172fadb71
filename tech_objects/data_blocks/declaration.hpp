/// How the declaration tables of data blocks are written; included by those tables only. Before its table, a
/// file says `using Data = …`, which data block it declares.
#pragma once

#include <iterator>
#include <type_traits>
#include <utility>

#include "tech_objects/data_blocks/variable.hpp"

/// VARIABLE(path, effect, unit, range, text, further fields): declares one variable; its path is spelled
/// once. COMPUTED: one that the runtime computes.
#define VARIABLE(path_, ...) DECLARED_VARIABLE(false, path_, __VA_ARGS__)
#define COMPUTED(path_, ...) DECLARED_VARIABLE(true, path_, __VA_ARGS__)

/// ELEMENTS(array, member, effect, unit, range, text, further fields): declares a member of every array
/// element. COMPUTED_ELEMENTS: one that the runtime computes.
#define ELEMENTS(array_, member_, ...) DECLARED_ELEMENTS(false, array_, member_, __VA_ARGS__)
#define COMPUTED_ELEMENTS(array_, member_, ...) DECLARED_ELEMENTS(true, array_, member_, __VA_ARGS__)

/// ARRAY(array, effect, unit, range, text, further fields): declares an array of plain values.
#define ARRAY(array_, effect_, unit_, range_, text_, ...)                                                  \
  Variable {                                                                                               \
    .path = #array_ "[]", .type = type_of<std::remove_cvref_t<decltype(Data{}.array_[0])>>(),              \
    .offset = offsetof(Data, array_), .count = kElementsOf<decltype(Data::array_)>,                        \
    .stride = sizeof(Data{}.array_[0]), .effect = Effect::effect_, .computed = false, .unit = Unit::unit_, \
    .range = range_, .text = text_ __VA_OPT__(, ) __VA_ARGS__, .start = &start_value_in<Data>              \
  }

#define DECLARED_VARIABLE(computed_, path_, effect_, unit_, range_, text_, ...)                 \
  Variable {                                                                                    \
    .path = #path_, .type = type_of<decltype(Data{}.path_)>(), .offset = offsetof(Data, path_), \
    .effect = Effect::effect_, .computed = computed_, .unit = Unit::unit_, .range = range_,     \
    .text = text_ __VA_OPT__(, ) __VA_ARGS__, .start = &start_value_in<Data>                    \
  }

#define DECLARED_ELEMENTS(computed_, array_, member_, effect_, unit_, range_, text_, ...)    \
  Variable {                                                                                 \
    .path = #array_ "[]." #member_, .type = type_of<decltype(Data{}.array_[0].member_)>(),   \
    .offset = offsetof(Data, array_) + offsetof(ElementOf<decltype(Data::array_)>, member_), \
    .count = kElementsOf<decltype(Data::array_)>, .stride = sizeof(Data{}.array_[0]),        \
    .effect = Effect::effect_, .computed = computed_, .unit = Unit::unit_, .range = range_,  \
    .text = text_ __VA_OPT__(, ) __VA_ARGS__, .start = &start_value_in<Data>                 \
  }

namespace lockstep {

/// Type of the elements of an array.
template <class Array>
using ElementOf = std::remove_cvref_t<decltype(std::declval<Array&>()[0])>;

/// How many of them it has, built in or std::array.
template <class Array>
inline constexpr std::size_t kElementsOf = sizeof(Array) / sizeof(ElementOf<Array>);

// What the tables declare, for `data_block_of`.
const DataBlock& axis_data_block() noexcept;
const DataBlock& positioning_axis_data_block();
const DataBlock& encoder_data_block() noexcept;
const DataBlock& measuring_input_data_block() noexcept;
const DataBlock& leading_axis_proxy_data_block() noexcept;
const DataBlock& speed_axis_data_block();
const DataBlock& output_cam_data_block() noexcept;
const DataBlock& cam_track_data_block() noexcept;
const DataBlock& cam_data_block() noexcept;
const DataBlock& cam_10k_data_block() noexcept;
const DataBlock& mco305_data_block();
const DataBlock& linmot_data_block();
std::span<const Variable> axis_status_variables() noexcept;

/// Start value in a data block that has just been made. While loading.
template <class Data>
Value start_value_in(const Variable& variable, std::size_t element) {
  static Data data{};
  return VariableAddress{&variable, variable.offset + element * variable.stride, -1}.signal(&data).load();
}

}  // namespace lockstep
