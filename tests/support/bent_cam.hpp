/// A cam that is nearly a gear of 2 : 1, for what holds of cams as of gears: twice the way of the leading
/// axis, bent a little.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "scheduler/controller.hpp"

namespace lockstep::test {

/// As long as a ring of the leading axis.
inline Cam& add_bent_cam(Controller& controller, double ring) {
  Cam& made = static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, "Cam"));
  static_cast<CamData1k*>(made.data_block())->InterpolationSettings = {1, 1};
  constexpr double kBend[] = {0.0, 1.0, 0.0, -1.0, 0.0};
  for (std::size_t i = 0; i < 5; ++i) {
    const double place = ring / 4.0 * static_cast<double>(i);
    made.define_point(i, {place, 2.0 * place + kBend[i]});
  }
  CamInterpolator interpolator(kCamPoints);
  EXPECT_EQ(made.interpolate(interpolator), ErrorId::none);
  return made;
}

/// Its following value, of passes that are appended.
inline double on_bent_cam(const Cam& cam, double ring, double leading) {
  const double turns = std::floor(leading / ring);
  return 2.0 * ring * turns + cam.function().value(leading - turns * ring).position;
}

}  // namespace lockstep::test
