/// Every kind of drive there is.
#pragma once

#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <string_view>

#include "tech_objects/drive/drive.hpp"
#include "tech_objects/drive/linear_motor_drive.hpp"
#include "tech_objects/drive/simulated_drive.hpp"

namespace lockstep {

template <class Model>
std::unique_ptr<Drive> make_drive() {
  return std::make_unique<Model>();
}

/// A new drive is a class and a line here. The first one is that of an axis that names none.
inline constexpr DriveModel kDriveModels[] = {
    {"simulated", make_drive<SimulatedDrive>},
    {"linear_motor", make_drive<LinearMotorDrive>},
};

/// Their names, in the same order.
inline constexpr auto kDriveModelNames = [] {
  std::array<std::string_view, std::size(kDriveModels)> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kDriveModels[i].name;
  return names;
}();

}  // namespace lockstep
