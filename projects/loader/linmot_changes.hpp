/// Writes control parameters of a LinMot motor into the text of a project.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

struct ControlParameter {
  std::string_view name;  ///< as printed, such as "FF Friction"
  double value;
};

struct ChangedText {
  std::string text;
  std::vector<std::size_t> lines;  ///< of each parameter in it, from 1
};

/// No other byte changes: a number gives way to another one; what is not there yet is put at the beginning of
/// the directory that it belongs to.
/// @param motor 0 to 3
/// @throws std::runtime_error if that motor has no place in this text, as one of an included file
ChangedText with_control_parameters(std::string text, std::string_view controller, std::size_t motor,
                                    std::span<const ControlParameter> parameters);

}  // namespace lockstep
