/// How the declaration tables of the data block are written; included by those tables only.
#pragma once

#include <iterator>
#include <utility>

#include "tech_objects/variable.hpp"

/// VARIABLE(path, effect, unit, range, text, further fields): declares one variable; its path is spelled
/// once.
#define VARIABLE(path_, effect_, unit_, range_, text_, ...)                                             \
  Variable {                                                                                            \
    .path = #path_, .type = type_of<decltype(AxisData{}.path_)>(), .offset = offsetof(AxisData, path_), \
    .effect = Effect::effect_, .unit = Unit::unit_, .range = range_,                                    \
    .text = text_ __VA_OPT__(, ) __VA_ARGS__                                                            \
  }

/// ELEMENTS(array, member, effect, unit, range, text, further fields): declares a member of every array
/// element.
#define ELEMENTS(array_, member_, effect_, unit_, range_, text_, ...)                                        \
  Variable {                                                                                                 \
    .path = #array_ "[]." #member_, .type = type_of<decltype(AxisData{}.array_[0].member_)>(),               \
    .offset = offsetof(AxisData, array_[0].member_),                                                         \
    .count = sizeof(AxisData{}.array_) / sizeof(AxisData{}.array_[0]),                                       \
    .stride = sizeof(AxisData{}.array_[0]), .effect = Effect::effect_, .unit = Unit::unit_, .range = range_, \
    .text = text_ __VA_OPT__(, ) __VA_ARGS__                                                                 \
  }
