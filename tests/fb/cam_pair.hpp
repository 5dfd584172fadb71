/// A leading and a following axis and two cams: a rig of the tests of camming.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "fb/cam_in.hpp"
#include "fb/interpolate_cam.hpp"
#include "fb/move.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/coupled_rig.hpp"

namespace lockstep::test {

/// An axis on a ring that nothing limits here.
inline void fast_ring(AxisData& data) {
  data.Modulo.Enable = true;
  data.DynamicLimits.MaxVelocity = data.DynamicLimits.Velocity = 1e6;
  data.DynamicLimits.MaxAcceleration = 1e7;
}

struct CamPair : CoupledRig {
  explicit CamPair(const Shape& leading = fast_ring, const Shape& following = line)
      : CoupledRig(leading, following),
        wave(cam("Wave", {{0, 0}, {90, 30}, {180, 50}, {270, 10}, {360, 0}}, 1)),
        feed(cam("Feed", {{0, 0}, {120, 5}, {240, 35}, {360, 40}}, 1)),
        in(block<MC_CamIn>()),
        next(block<MC_CamIn>()),
        out(block<MC_CamOut>()),
        move_f(block<MC_MoveRelative>()),
        interpolate(block<MC_InterpolateCam>()) {
    move_f.Axis = &f;
    in.Master = next.Master = &l;
    in.Slave = next.Slave = out.Slave = &f;
    in.Cam = &wave;
    next.Cam = &feed;
    interpolate.Cam = &wave;
    begin();
    continuity[1].highest_jerk = 1e10;
    continuity[0].highest_acceleration = 1e7;
    continuity[0].highest_jerk = 1e12;
  }

  Cam& cam(const char* name, const std::vector<TO_Cam_Struct_PointData>& points, DINT boundary) {
    Cam& made = static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, name));
    auto& data = *static_cast<CamData1k*>(made.data_block());
    data.InterpolationSettings = {1, boundary};
    for (std::size_t i = 0; i < points.size(); ++i) made.define_point(i, points[i]);
    CamInterpolator interpolator(kCamPoints);
    EXPECT_EQ(made.interpolate(interpolator), ErrorId::none);
    return made;
  }

  void start_leading(double velocity) {
    run_l.Acceleration = run_l.Deceleration = 1e6;
    run_l.Jerk = 0.0;
    CoupledRig::start_leading(velocity);
    ASSERT_TRUE(run_until([&] { return run_l.InVelocity; }));
  }

  /// Camming, cyclic, synchronous.
  void couple(double velocity = 720.0) {
    start_leading(velocity);
    in.ApplicationMode = 1;
    in.MasterStartDistance = 100.0;
    in.Execute = true;
    ASSERT_TRUE(run_until([&] { return in.InSync; }));
  }

  const TO_Struct_StatusSynchronizedMotion& status() const { return f.data.StatusSynchronizedMotion; }
  double leading() const { return l.setpoint().position.value; }

  Cam& wave;
  Cam& feed;
  MC_CamIn& in;
  MC_CamIn& next;
  MC_CamOut& out;
  MC_MoveRelative& move_f;
  MC_InterpolateCam& interpolate;
};

inline bool bit(const Cam& cam, CamStatusBit which) {
  return has_bit(static_cast<CamData1k*>(const_cast<Cam&>(cam).data_block())->StatusWord, which);
}

}  // namespace lockstep::test
