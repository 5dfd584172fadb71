// The variables of data blocks, by their paths: declared in variable.hpp.
#include <algorithm>
#include <cctype>
#include <charconv>

#include "tech_objects/data_blocks/declaration.hpp"

namespace lockstep {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

/// Takes the index out of `Sensor[2].Type` or `ValidPoint[2]`, leaving the parts before and behind it.
struct IndexedPath {
  std::string_view array, member;
  std::size_t index = 0;  // as published, from 1; 0: no well-formed index
};

IndexedPath split_index(std::string_view path) {
  const auto open = path.find('[');
  const auto close = path.find(']');
  if (open == path.npos || close == path.npos || close < open) return {};
  std::size_t index = 0;
  const char* last = path.data() + close;
  const auto [end, error] = std::from_chars(path.data() + open + 1, last, index);
  if (error != std::errc{} || end != last) return {};
  return {path.substr(0, open), path.substr(close + 1), index};
}

VariableAddress find_whole(ObjectKind kind, std::string_view path) {
  const IndexedPath indexed = split_index(path);
  for (const auto list : data_block_of(kind).lists()) {
    for (const Variable& variable : list) {
      if (variable.count == 0) {
        if (same_name(variable.path, path)) return {&variable, variable.offset, -1};
        continue;
      }
      const auto brackets = variable.path.find("[]");
      if (indexed.index >= 1 && indexed.index <= variable.count &&
          same_name(variable.path.substr(0, brackets), indexed.array) &&
          same_name(variable.path.substr(brackets + 2), indexed.member))
        return {&variable, variable.offset + (indexed.index - 1) * variable.stride, -1};
    }
  }
  return {};
}

/// Number of a bit suffix such as `X22`; -1 if it is none.
int bit_number(std::string_view suffix) {
  if (suffix.size() < 2 || suffix.size() > 3 || lower(suffix[0]) != 'x') return -1;
  int number = 0;
  for (const char c : suffix.substr(1)) {
    if (c < '0' || c > '9') return -1;
    number = number * 10 + (c - '0');
  }
  return number;
}

}  // namespace

const DataBlock& data_block_of(ObjectKind kind) noexcept {
  switch (kind) {
    case ObjectKind::TO_SynchronousAxis:
      break;
    case ObjectKind::TO_PositioningAxis:
      return positioning_axis_data_block();
    case ObjectKind::TO_ExternalEncoder:
      return encoder_data_block();
    case ObjectKind::TO_MeasuringInput:
      return measuring_input_data_block();
    case ObjectKind::TO_LeadingAxisProxy:
      return leading_axis_proxy_data_block();
    case ObjectKind::TO_SpeedAxis:
      return speed_axis_data_block();
    case ObjectKind::TO_OutputCam:
      return output_cam_data_block();
    case ObjectKind::TO_CamTrack:
      return cam_track_data_block();
    case ObjectKind::TO_Cam:
      return cam_data_block();
    case ObjectKind::TO_Cam_10k:
      return cam_10k_data_block();
    case ObjectKind::MCO_305:
      return mco305_data_block();
    case ObjectKind::LinMot_Controller:
      return linmot_data_block();
  }
  return axis_data_block();
}

Signal VariableAddress::signal(void* data_block) const noexcept {
  return {static_cast<char*>(data_block) + offset, variable->type, static_cast<std::int8_t>(bit)};
}

VariableAddress find_variable(ObjectKind kind, std::string_view path) noexcept {
  if (const VariableAddress whole = find_whole(kind, path); whole.variable != nullptr) return whole;
  const auto dot = path.rfind('.');
  if (dot == path.npos) return {};
  const int bit = bit_number(path.substr(dot + 1));
  if (bit < 0) return {};
  VariableAddress place = find_whole(kind, path.substr(0, dot));
  if (place.variable == nullptr) return {};
  const Type type = place.variable->type;
  const bool has_bits = is_bit_string(type) || is_integer(type);
  if (!has_bits || bit >= 8 * size_of(type)) return {};
  place.bit = bit;
  return place;
}

}  // namespace lockstep
