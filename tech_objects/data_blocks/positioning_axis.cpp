/// The variables of a TO_PositioningAxis: those of a synchronous axis without what only a follower has.
/// @source S7-1500/S7-1500T axis functions, tags of the positioning axis
#include <vector>

#include "tech_objects/data_blocks/declaration.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"

namespace lockstep {
namespace {

constexpr BitNames kStatusNames = without(kStatusBitNames, {21, 22, 24});
constexpr BitNames kStatus2Names = without(kStatus2BitNames, {1, 3, 4, 5});
constexpr BitNames kErrorNames = without(kErrorBitNames, {14});
constexpr BitNames kWarningNames = without(kWarningBitNames, {14});

const BitNames* bits_of(const Variable& variable) noexcept {
  if (variable.path == "StatusWord") return &kStatusNames;
  if (variable.path == "StatusWord2") return &kStatus2Names;
  if (variable.path == "ErrorWord") return &kErrorNames;
  if (variable.path == "WarningWord") return &kWarningNames;
  return variable.bits;
}

std::vector<Variable> without_following(std::span<const Variable> variables) {
  std::vector<Variable> list;
  for (const Variable& variable : variables) {
    if (variable.path.starts_with("StatusSynchronizedMotion.")) continue;
    list.push_back(variable);
    list.back().bits = bits_of(variable);
  }
  return list;
}

}  // namespace

const DataBlock& positioning_axis_data_block() {
  static const std::vector<Variable> configuration = without_following(axis_data_block().configuration);
  static const std::vector<Variable> status = without_following(axis_data_block().status);
  static const DataBlock block{configuration, status};
  return block;
}

}  // namespace lockstep
