// Camming at random: all profiles, scalings of both signs, rings and lines, directions, smooth cams. Whatever
// is asked for, the setpoints stay finite and no faster than cam, leading axis and the way to catch up
// explain.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fb/cam_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::camming_random_test {
namespace {

constexpr int kLongestWait = 2500;  // [ticks] for a synchronous position
constexpr int kLongestRun = 600;    // [ticks] in step

/// What became of the cases of each profile.
struct Outcomes {
  int synchronous[7] = {};
  int refused[7] = {};
};

/// Maximum magnitudes of a cam, sampled.
struct CamBounds {
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
};

class RandomCamming : test::Rig {
 public:
  explicit RandomCamming(std::uint64_t seed)
      : random_(seed),
        l_(axis("Leading", shape(leading_ring_))),
        f_(axis("Following", shape(following_ring_))),
        cam_(static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, "Profile"))),
        power_l_(block<MC_Power>()),
        power_f_(block<MC_Power>()),
        home_l_(block<MC_Home>()),
        home_f_(block<MC_Home>()),
        run_(block<MC_MoveVelocity>()),
        first_(block<MC_CamIn>()),
        in_(block<MC_CamIn>()) {
    lead(f_, l_);
    power_l_.Axis = home_l_.Axis = run_.Axis = &l_;
    power_f_.Axis = home_f_.Axis = &f_;
    continuity[0].velocity = continuity[1].velocity = false;  // of interest is what is lasting: the velocity
    define_cam();
    ask();
  }

  void run(Outcomes& outcomes) {
    begin();
    const double bound = maximum_velocity();
    in_.Execute = true;
    int in_step = 0;
    for (int i = 0; i < kLongestWait && in_step < kLongestRun && !in_.Error; ++i) {
      tick();
      if (testing::Test::HasFatalFailure()) return;
      if (in_.InSync) ++in_step;
      ASSERT_LE(std::abs(f_.setpoint().velocity), bound) << described() << " after " << i << " ticks";
    }
    if (in_.Error) ++outcomes.refused[in_.SyncProfileReference];
    if (in_step > 0) ++outcomes.synchronous[in_.SyncProfileReference];
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool coin() { return random_() % 2 == 0; }

  std::function<void(AxisData&)> shape(bool& ring) {
    ring = coin();
    return [ring](AxisData& data) {
      data.Modulo.Enable = ring;
      data.DynamicLimits.MaxVelocity = data.DynamicLimits.Velocity = 1e6;
      data.DynamicLimits.MaxAcceleration = 1e7;
    };
  }

  /// A closed cubic spline of a length, a start and a stroke of its own; some are all but flat.
  void define_cam() {
    const int count = 4 + static_cast<int>(random_() % 5);
    const double start = coin() ? 0.0 : between(-100.0, 100.0);
    length_ = coin() ? 360.0 : between(200.0, 500.0);
    const double stroke = random_() % 8 == 0 ? 1e-6 : between(1.0, 100.0);
    const double closing = between(-1.0, 1.0) * stroke;
    for (int i = 0; i < count; ++i) {
      const double y = i == 0 || i + 1 == count ? closing : between(-1.0, 1.0) * stroke;
      cam_.define_point(static_cast<std::size_t>(i), {start + length_ * i / (count - 1), y});
    }
    cam_.set_interpolation({1, 1});
    CamInterpolator interpolator(kCamPoints);
    ASSERT_EQ(cam_.interpolate(interpolator), ErrorId::none);
    for (int i = 0; i <= 2000; ++i) {
      const CamValue value = cam_.function().value(start + length_ * i / 2000);
      bounds_.value = std::max(bounds_.value, std::abs(value.position));
      bounds_.slope = std::max(bounds_.slope, std::abs(value.first_derivative));
      bounds_.curvature = std::max(bounds_.curvature, std::abs(value.second_derivative));
    }
  }

  void ask() {
    for (MC_CamIn* in : {&first_, &in_}) {
      in->Master = &l_;
      in->Slave = &f_;
      in->Cam = &cam_;
      in->ApplicationMode = 1 + static_cast<DINT>(random_() % 2);
      in->MasterScaling = between(0.3, 3.0) * (coin() ? 1.0 : -1.0);
      in->SlaveScaling = between(0.3, 3.0) * (coin() ? 1.0 : -1.0);
      in->MasterOffset = between(-300.0, 300.0);
      in->SlaveOffset = between(-100.0, 100.0);
      // At a turning point of the cam, where one-way synchronizing is hardest, more often than chance has it.
      const double place = random_() % 4 == 0 ? turning_place() : between(0.0, length_);
      in->MasterSyncPosition = place * in->MasterScaling;
      in->MasterStartDistance = between(20.0, 300.0);
      in->Velocity = between(500.0, 5000.0);
      in->Acceleration = in->Deceleration = 1e5;
      in->SyncDirection = 1 + static_cast<DINT>(random_() % 3);
      in->SyncProfileReference = static_cast<DINT>(random_() % 7);
    }
    first_.SyncProfileReference = 2;  // what profile 5 takes over
    if (in_.SyncProfileReference == 5) in_.ApplicationMode = first_.ApplicationMode;
  }

  double turning_place() {
    const CamFunction& cam = cam_.function();
    const double extreme = coin() ? cam.lowest_following_value() : cam.highest_following_value();
    return cam.leading_value(extreme, cam.start_leading_value()).value_or(0.0) - cam.start_leading_value();
  }

  void begin() {
    power_l_.Enable = power_f_.Enable = true;
    Rig::run(3);
    home_l_.Position = between(0.0, 360.0);
    home_f_.Position = between(0.0, 360.0);
    home_l_.Execute = home_f_.Execute = true;
    Rig::run(3);
    velocity_ = between(50.0, 720.0) * (random_() % 4 == 0 ? -1.0 : 1.0);
    run_.Velocity = velocity_;
    run_.Acceleration = run_.Deceleration = 1e6;
    run_.Jerk = 0.0;
    run_.Execute = true;
    ASSERT_TRUE(run_until([&] { return run_.InVelocity; }));
    if (in_.SyncProfileReference != 5) return;
    first_.Execute = true;
    Rig::run(20);
  }

  /// What a profile may take: the cam's own velocity, that of catching up over the distance (the way to the
  /// cam, turns of a ring, and what bending needs), or that of the dynamic parameters.
  double maximum_velocity() const {
    const double scale = std::max(std::abs(in_.SlaveScaling), std::abs(first_.SlaveScaling));
    const double pass = std::min(std::abs(in_.MasterScaling), std::abs(first_.MasterScaling));
    const double slope = bounds_.slope * scale / pass;
    const double curvature = bounds_.curvature * scale / (pass * pass);
    const double distance = in_.MasterStartDistance;
    const double covered =
        360.0 + 100.0 + bounds_.value * scale + 720.0 + 2.0 * distance * (slope + 0.5 * curvature * distance);
    double ratio = slope;
    double own = 0.0;
    if (in_.SyncProfileReference == 0)
      own = in_.Velocity;
    else if (in_.SyncProfileReference != 2 && in_.SyncProfileReference != 5)
      ratio += 2.5 * covered / distance + curvature * distance;
    return 1.01 * (std::abs(velocity_) * ratio + own) + 1e-6;
  }

  std::string described() const {
    const MC_CamIn& b = in_;
    return "profile " + std::to_string(b.SyncProfileReference) + " direction " +
           std::to_string(b.SyncDirection) + " mode " + std::to_string(b.ApplicationMode) + " scalings " +
           std::to_string(b.MasterScaling) + " " + std::to_string(b.SlaveScaling) + " at " +
           std::to_string(b.MasterSyncPosition) + " over " + std::to_string(b.MasterStartDistance) +
           (leading_ring_ ? " ring" : " line") + (following_ring_ ? " to ring" : " to line") + " at " +
           std::to_string(velocity_);
  }

  std::mt19937_64 random_;
  bool leading_ring_ = false;
  bool following_ring_ = false;
  double length_ = 360.0;
  double velocity_ = 0.0;
  CamBounds bounds_;
  Axis& l_;
  Axis& f_;
  Cam& cam_;
  MC_Power& power_l_;
  MC_Power& power_f_;
  MC_Home& home_l_;
  MC_Home& home_f_;
  MC_MoveVelocity& run_;
  MC_CamIn& first_;
  MC_CamIn& in_;
};

TEST(CammingAtRandom, StaysFiniteAndNoFasterThanCamAndWayExplain) {
  Outcomes outcomes;
  const test::Cases ran = test::for_each_seed(
      4100, test::cases(1000, 100000), [&](const test::Case& one) { RandomCamming(one.seed).run(outcomes); });
  if (ran.alone || HasFailure()) return;
  for (int profile = 0; profile < 7; ++profile) {
    std::printf("profile %d: %d synchronous, %d refused\n", profile, outcomes.synchronous[profile],
                outcomes.refused[profile]);
    EXPECT_GT(outcomes.synchronous[profile], ran.count / 70) << "profile " << profile;
  }
}

}  // namespace
}  // namespace lockstep::camming_random_test
