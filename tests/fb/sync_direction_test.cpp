// SyncDirection 1 and 2 with an axis that is where it has to be, or nearly: nothing turns that need not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "tests/support/coupled_rig.hpp"
#include "tests/support/property.hpp"

namespace lockstep::sync_direction_test {
namespace {

constexpr double kRing = 360.0;    // of both axes [u]
constexpr double kThere = 3.6e-7;  // a part of 1e-9 of the ring [u]

void ring(AxisData& data) {
  data.Modulo.Enable = true;
  data.Modulo.Length = kRing;
}

double on_ring(double position) {
  return position - kRing * std::floor(position / kRing);
}

/// Both axes homed, at rest; a gear and a cam that has a rest, turns back at 180 and rises in between.
struct Placed : test::CoupledRig {
  Placed(double leading_place, double following_place)
      : CoupledRig(ring, ring),
        pos(block<MC_GearInPos>()),
        in(block<MC_CamIn>()),
        cam(static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, "Cam"))) {
    static_cast<CamData1k*>(cam.data_block())->InterpolationSettings = {1, 1};
    constexpr double kPoints[][2] = {{0, 0}, {60, 0}, {120, 45}, {180, 90}, {240, 45}, {300, 0}, {360, 0}};
    for (std::size_t i = 0; i < std::size(kPoints); ++i) cam.define_point(i, {kPoints[i][0], kPoints[i][1]});
    auto& data = *static_cast<CamData1k*>(cam.data_block());
    data.Segment[0] = {.xmin = 0.0, .xmax = 60.0};
    data.Segment[1] = {.xmin = 300.0, .xmax = 360.0};
    data.ValidSegment[0] = data.ValidSegment[1] = true;
    CamInterpolator interpolator(kCamPoints);
    EXPECT_EQ(cam.interpolate(interpolator), ErrorId::none);
    pos.Master = in.Master = &l;
    pos.Slave = in.Slave = &f;
    in.Cam = &cam;
    in.ApplicationMode = 1;
    pos.Velocity = in.Velocity = 2000.0;
    pos.Acceleration = pos.Deceleration = in.Acceleration = in.Deceleration = 20000.0;
    home_l.Mode = home_f.Mode = 0;
    home_l.Position = on_ring(leading_place);
    home_f.Position = on_ring(following_place);
    for (auto& rule : continuity) rule = {.velocity = false, .acceleration = false};
    begin();
  }
  double value(double leading) const { return cam.function().value(leading).position; }

  /// Runs until synchronous, or refused; what the axis has made until then.
  template <class Block>
  void synchronize(Block& job, double velocity) {
    job.Execute = true;
    start_leading(velocity);
    go_on(job);
  }
  template <class Block>
  void go_on(Block& job) {
    const AxisPosition from = f.setpoint().position;
    AxisPosition last = from;
    for (int i = 0; i < 30000 && !job.InSync && !job.Error; ++i) {
      tick();
      if (job.InSync) break;  // what comes now is the function's
      const AxisPosition now = f.setpoint().position;
      distance = difference(now, from, f.modulo()).rounded();
      const double step = difference(now, last, f.modulo()).rounded();
      forth += std::max(step, 0.0);
      back += std::max(-step, 0.0);
      last = now;
    }
  }

  MC_GearInPos& pos;
  MC_CamIn& in;
  Cam& cam;
  double distance = 0.0;  // until it is synchronous [u]
  double forth = 0.0;     // in the positive direction [u]
  double back = 0.0;      // in the negative one [u]
};

// ---- Where the function rests: there is nothing to do
// -----------------------------------------------------------------------

TEST(SyncDirection, OnASynchronousValueWhereTheCamRestsOrTurnsBackNothingTurns) {
  for (const DINT direction : {1, 2})
    for (const DINT profile : {0, 1, 6})
      for (const double place : {30.0, 180.0})
        for (const double jerk : {0.0, 1e6})
          for (const double beside : {0.0, 1e-9, -1e-9, 3e-7, -3e-7}) {
            SCOPED_TRACE(::testing::Message() << "direction " << direction << " profile " << profile << " at "
                                              << place << " jerk " << jerk << " beside " << beside);
            Placed rig(280.0, 0.0);
            const double value = rig.value(place);
            rig.home_f.Execute = false;
            rig.run(2);
            rig.home_f.Position = on_ring(value + beside);
            rig.home_f.Execute = true;
            rig.run(3);
            rig.in.SyncDirection = direction;
            rig.in.SyncProfileReference = profile;
            rig.in.MasterSyncPosition = place;
            rig.in.MasterStartDistance = 40.0;
            rig.in.Jerk = jerk;
            rig.synchronize(rig.in, 100.0);
            ASSERT_TRUE(rig.in.InSync) << static_cast<unsigned>(rig.in.ErrorID);
            EXPECT_LE(rig.forth + rig.back, std::abs(beside) + 1e-12);
          }
}

TEST(SyncDirection, OfAnAxisThatMovesOnTheFunctionAlreadyTurnsNothing) {
  for (const DINT ratio : {1, -1}) {
    Placed rig(0.0, 100.0);
    auto& gear = rig.block<MC_GearIn>();
    gear.Master = &rig.l;
    gear.Slave = &rig.f;
    gear.RatioNumerator = rig.pos.RatioNumerator = ratio;
    gear.Execute = true;
    rig.start_leading(300.0);
    ASSERT_TRUE(rig.run_until([&] { return gear.InGear && rig.run_l.InVelocity; }));
    // The same function, over several turns: that of the gear goes through both positions.
    rig.pos.MasterSyncPosition = rig.l.data.Position;
    rig.pos.SlaveSyncPosition = rig.f.data.Position;
    rig.pos.MasterStartDistance = 1500.0;
    rig.pos.SyncProfileReference = 3;
    rig.pos.SyncDirection = ratio > 0 ? 1 : 2;
    rig.pos.Execute = true;
    const double apart = rig.f.data.Position - ratio * rig.l.data.Position;
    ASSERT_TRUE(rig.run_until([&] {
      EXPECT_NEAR(rig.f.data.Velocity, ratio * 300.0, 1e-6);
      EXPECT_NEAR(std::remainder(rig.f.data.Position - ratio * rig.l.data.Position - apart, kRing), 0.0,
                  1e-9);
      return rig.pos.InSync || ::testing::Test::HasFailure();
    }));
  }
}

TEST(SyncDirection, BothAxesStandingWithin1E9OfTheRingAreSynchronousAtOnce) {
  for (const DINT direction : {1, 2, 3})
    for (const double beside : {0.0, 1e-9, -1e-9, 3e-7, -3e-7}) {
      Placed rig(100.0, 50.0 + beside);
      rig.pos.MasterSyncPosition = 100.0;
      rig.pos.SlaveSyncPosition = 50.0;
      rig.pos.SyncDirection = direction;
      rig.pos.Execute = true;
      rig.run(2);
      EXPECT_TRUE(rig.pos.InSync) << beside;
      EXPECT_EQ(rig.f.data.Position, 50.0);
    }
  Placed rig(100.0, 50.0 + 4e-7);
  rig.pos.MasterSyncPosition = 100.0;
  rig.pos.SlaveSyncPosition = 50.0;
  rig.pos.Execute = true;
  rig.run(10);
  EXPECT_TRUE(rig.pos.Busy && !rig.pos.InSync);
}

/// What counts as there is put there in one tick, so it is no distance on a long ring either.
TEST(SyncDirection, OnALongRingWhatIsSeenAsAStepIsNotThere) {
  for (const double beside : {1e-6, 1.1e-6}) {
    test::CoupledRig rig(test::line, [](AxisData& data) {
      data.Modulo.Enable = true;
      data.Modulo.Length = 1048576.0;
    });
    auto& pos = rig.block<MC_GearInPos>();
    pos.Master = &rig.l;
    pos.Slave = &rig.f;
    pos.SyncProfileReference = 3;
    rig.continuity[1].homing = true;
    rig.home_f.Mode = 0;
    rig.home_f.Position = beside;
    rig.begin();
    pos.Execute = true;
    rig.run(3);
    EXPECT_EQ(pos.InSync, beside == 1e-6);
  }
}

// ---- Where it has a slope: the axis has to gain it, in the direction that it may turn
// ----------------------------------------------------

/// Two axes cannot come from rest to the same place with a velocity without going the other way first, so
/// that it takes a turn: with profile 0 as with profile 1.
TEST(SyncDirection, OnASynchronousValueWithAVelocityTheAxisGainsItInOneTurn) {
  for (const DINT ratio : {1, -1})
    for (const DINT profile : {0, 1})
      for (const double short_by : {0.0, 1e-9, -1e-9, 0.1}) {
        SCOPED_TRACE(::testing::Message() << ratio << " profile " << profile << " short by " << short_by);
        Placed rig(250.0, 50.0 - ratio * short_by);
        rig.pos.RatioNumerator = ratio;
        rig.pos.SyncDirection = ratio > 0 ? 1 : 2;
        rig.pos.SyncProfileReference = profile;
        rig.pos.MasterSyncPosition = 200.0;
        rig.pos.SlaveSyncPosition = 50.0;
        rig.pos.MasterStartDistance = 100.0;
        rig.synchronize(rig.pos, 100.0);
        ASSERT_TRUE(rig.pos.InSync);
        EXPECT_EQ(ratio > 0 ? rig.back : rig.forth, 0.0);
        EXPECT_NEAR(rig.distance, ratio * (kRing + short_by), 0.2);
        EXPECT_NEAR(std::remainder(rig.f.data.Position - 50.0 - ratio * (rig.l.data.Position - 200.0), kRing),
                    0.0, 1e-9);
      }
}

TEST(SyncDirection, FarEnoughBeforeTheSynchronousValueNoTurnIsAdded) {
  for (const DINT profile : {0, 1}) {
    Placed rig(250.0, 50.0 - 45.0);
    rig.pos.SyncDirection = 1;
    rig.pos.SyncProfileReference = profile;
    rig.pos.MasterSyncPosition = 200.0;
    rig.pos.SlaveSyncPosition = 50.0;
    rig.pos.MasterStartDistance = 100.0;
    rig.synchronize(rig.pos, 100.0);
    ASSERT_TRUE(rig.pos.InSync);
    EXPECT_EQ(rig.back, 0.0);
    EXPECT_NEAR(rig.distance, 45.0, 0.2);
  }
}

// ---- At random
// -----------------------------------------------------------------------------------------------

/// What a random case asks for.
struct Wish {
  bool by_cam = false;
  DINT profile = 1;
  DINT direction = 1;
  double scaling = 1.0;  // of the cam; ratio of the gear
  double place = 0.0;    // synchronous position of the leading axis
  double beside = 0.0;   // of the following one from its own
  double distance = 40.0;
  double velocity = 100.0;
};

Wish wish(std::mt19937_64& random) {
  const auto any = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  const auto pick = [&](std::initializer_list<double> list) { return list.begin()[random() % list.size()]; };
  Wish wanted;
  wanted.by_cam = random() % 3 != 0;
  wanted.profile = static_cast<DINT>(wanted.by_cam ? pick({0, 1, 3, 6}) : pick({0, 1, 3}));
  wanted.direction = static_cast<DINT>(pick({1, 2}));
  wanted.scaling = wanted.by_cam ? pick({0.0, 1.0, -1.0, 0.4}) : pick({1, 2, -1, -3});
  wanted.place = wanted.by_cam ? pick({0.0, 30.0, 90.0, 180.0, any(0.0, 360.0)}) : any(0.0, 360.0);
  wanted.beside = pick({0.0, 0.0, 1e-9, -1e-9, any(-kThere, kThere), any(-180.0, 180.0)});
  wanted.distance = any(5.0, 300.0);
  wanted.velocity = any(20.0, 300.0);
  return wanted;
}

TEST(SyncDirection, AtRandomNeverTurnsBackAndTurnsNothingWhereNothingIsToDo) {
  int refused = 0;
  int still = 0;
  int turned = 0;
  const test::Cases ran = test::for_each_seed(1, test::cases(400, 20'000), [&](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const Wish wanted = wish(random);
    SCOPED_TRACE(::testing::Message()
                 << (wanted.by_cam ? "cam" : "gear") << " profile " << wanted.profile << " direction "
                 << wanted.direction << " scaling " << wanted.scaling << " at " << wanted.place << " beside "
                 << wanted.beside << " over " << wanted.distance << " velocity " << wanted.velocity);
    Placed rig(std::uniform_real_distribution<double>(0.0, kRing)(random), 0.0);
    const double value = wanted.by_cam ? wanted.scaling * rig.value(wanted.place) : 120.0;
    rig.home_f.Execute = false;
    rig.run(2);
    rig.home_f.Position = on_ring(value + wanted.beside);
    rig.home_f.Execute = true;
    rig.run(3);
    rig.pos.RatioNumerator = static_cast<DINT>(wanted.by_cam ? 1 : wanted.scaling);
    rig.in.SlaveScaling = wanted.scaling;
    rig.pos.SyncDirection = rig.in.SyncDirection = wanted.direction;
    rig.pos.SyncProfileReference = rig.in.SyncProfileReference = wanted.profile;
    rig.pos.MasterSyncPosition = rig.in.MasterSyncPosition = wanted.place;
    rig.pos.SlaveSyncPosition = value;
    rig.pos.MasterStartDistance = rig.in.MasterStartDistance = wanted.distance;
    if (wanted.by_cam)
      rig.synchronize(rig.in, wanted.velocity);
    else
      rig.synchronize(rig.pos, wanted.velocity);
    if (wanted.by_cam ? rig.in.Error : rig.pos.Error) {
      EXPECT_EQ(rig.f.data.ErrorDetail.Number, 0u);
      ++refused;
      return;
    }
    ASSERT_TRUE(wanted.by_cam ? rig.in.InSync : rig.pos.InSync) << "it waits for ever";
    EXPECT_LE(wanted.direction == 1 ? rig.back : rig.forth, kThere * 1.001) << "it turns back";
    const bool rests = wanted.by_cam && wanted.profile != 3 &&
                       (wanted.scaling == 0.0 || wanted.place == 30.0 || wanted.place == 180.0);
    if (rests && std::abs(wanted.beside) <= kThere) {
      EXPECT_LE(rig.forth + rig.back, kThere * 1.001) << "nothing is to do";
      ++still;
    } else if (std::abs(rig.distance) > 0.9 * kRing) {
      ++turned;
    }
  });
  if (ran.alone) return;
  EXPECT_GT(still, ran.count / 20);
  EXPECT_GT(turned, ran.count / 40);
  EXPECT_LT(refused, ran.count / 2);
}

}  // namespace
}  // namespace lockstep::sync_direction_test
