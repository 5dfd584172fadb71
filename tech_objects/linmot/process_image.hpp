/// The words of PROFIBUS: which module has which of them.
/// @source LinMot release 1.3 addendum, 3.7, 3.8
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tech_objects/linmot_catalogue/modules.hpp"

namespace lockstep::linmot {

/// A configured module.
struct ModulePlace {
  Module module;
  std::uint8_t motor = 0;
  std::uint8_t out = 0, in = 0;  ///< its first words
};

struct ProcessImageLayout {
  std::vector<ModulePlace> places;
  std::uint8_t out_words = 0, in_words = 0;
};

/// What has been seen of a motor's words.
struct MotorWords {
  bool run_curve_toggle = false;  ///< as it was last
  bool done_toggle = false;       ///< Curve Done
  bool locked = false;            ///< Set Position
  bool running = false;           ///< a curve, whose end is told
  std::int32_t position = 0;      ///< of Set Position as it was last
  bool position_known = false;
};

}  // namespace lockstep::linmot
