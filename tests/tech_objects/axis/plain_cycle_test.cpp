// The short cycle of an axis at which nothing but its base motion happens has, to the bit, the results of the
// one that is carried out in full.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/jog.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/cam_object/interpolation.hpp"
#include "tests/support/property.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::plain_cycle_test {
namespace {

using test::Rig;

constexpr std::uint64_t kFirstSeed = 4407;

/// The blocks of one axis.
struct Blocks {
  MC_Power* power;
  MC_Reset* reset;
  MC_Home* home;
  MC_MoveVelocity* run;
  MC_MoveJog* jog;
  MC_MoveRelative* move;
  MC_MoveSuperimposed* superimposed;
  MC_Halt* halt;
  MC_Stop* stop;
  MC_GearIn* gear;
  MC_GearInPos* gear_at;
  MC_GearInVelocity* gear_velocity;
  MC_CamIn* cam;
  MC_GearOut* out;
  MC_PhasingRelative* phase;
  MC_OffsetRelative* offset;
  MC_LeadingValueAdditive* additive;
  MC_SynchronizedMotionSimulation* simulation;
};

/// Lines and rings, some with drives, that follow each other and do whatever there is.
struct Machine : Rig {
  static constexpr int kAxes = 12;

  Machine(bool never_plain, std::uint64_t seed)
      : cam(static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, "Wave"))) {
    std::mt19937_64 random(seed);
    for (std::size_t i = 0; i <= 8; ++i)
      cam.define_point(i, {45.0 * static_cast<double>(i), i % 2 == 0 ? 0.0 : 20.0});
    CamInterpolator interpolator(cam.point_count());
    EXPECT_EQ(cam.interpolate(interpolator), ErrorId::none);
    for (int i = 0; i < kAxes; ++i) {
      Axis& made = axis("Axis" + std::to_string(i), [&](AxisData& data) {
        data.VirtualAxis.Mode = i % 6 == 5 ? 0 : 1;
        data.Modulo.Enable = i % 2 == 0;
        data.DynamicDefaults.Jerk = i % 3 == 0 ? 0.0 : 1e5;
        data.PositionLimits_SW.MinPosition = -500.0;
        data.PositionLimits_SW.MaxPosition = 500.0;
      });
      made.never_plain = never_plain;
      axes.push_back(&made);
    }
    for (auto& rule : continuity) rule.velocity = rule.acceleration = false;
    for (std::size_t i = 0; i < axes.size(); ++i) wire(i, random);
  }

  template <class B>
  B* of(Axis& axis) {
    B& made = block<B>();
    made.Axis = &axis;
    return &made;
  }
  template <class B>
  B* following(Axis& axis) {
    B& made = block<B>();
    made.Slave = &axis;
    return &made;
  }

  void wire(std::size_t i, std::mt19937_64& random) {
    Axis& own = *axes[i];
    Axis& master = *axes[i == 0 ? 1 : random() % i];
    lead(own, master);
    home_in_place(own);
    Blocks b{.power = of<MC_Power>(own),
             .reset = of<MC_Reset>(own),
             .home = of<MC_Home>(own),
             .run = of<MC_MoveVelocity>(own),
             .jog = of<MC_MoveJog>(own),
             .move = of<MC_MoveRelative>(own),
             .superimposed = of<MC_MoveSuperimposed>(own),
             .halt = of<MC_Halt>(own),
             .stop = of<MC_Stop>(own),
             .gear = following<MC_GearIn>(own),
             .gear_at = following<MC_GearInPos>(own),
             .gear_velocity = following<MC_GearInVelocity>(own),
             .cam = following<MC_CamIn>(own),
             .out = following<MC_GearOut>(own),
             .phase = following<MC_PhasingRelative>(own),
             .offset = following<MC_OffsetRelative>(own),
             .additive = of<MC_LeadingValueAdditive>(own),
             .simulation = following<MC_SynchronizedMotionSimulation>(own)};
    b.power->Enable = true;
    b.home->Mode = 1;
    b.gear->Master = b.gear_at->Master = b.gear_velocity->Master = b.cam->Master = b.phase->Master = &master;
    b.cam->Cam = &cam;
    b.cam->SyncProfileReference = 2;
    b.cam->ApplicationMode = static_cast<DINT>(random() % 2);
    b.gear->RatioNumerator = static_cast<DINT>(random() % 7) - 3;
    if (b.gear->RatioNumerator == 0) b.gear->RatioNumerator = 5;
    b.gear->RatioDenominator = static_cast<DINT>(1 + random() % 5);
    b.gear_at->SyncProfileReference = 1;
    b.gear_at->MasterStartDistance = 15.0;
    b.out->SyncProfileReference = 1;
    b.out->MasterStopDistance = 15.0;
    b.phase->ProfileReference = b.offset->ProfileReference = 1;
    b.phase->PhasingDistance = b.offset->OffsetDistance = 20.0;
    blocks.push_back(b);
  }

  /// Something changes at one axis, the same in each machine that is asked with the same numbers.
  void act(std::mt19937_64& random) {
    const std::size_t i = random() % axes.size();
    Blocks& b = blocks[i];
    AxisData& data = axes[i]->data;
    const double number = static_cast<double>(random() % 400) - 200.0;
    switch (random() % 22) {
      case 0:
        b.power->Enable = !b.power->Enable || random() % 4 != 0;
        break;
      case 1:
        b.reset->Execute = !b.reset->Execute;
        break;
      case 2:
        b.home->Position = number;
        b.home->Execute = !b.home->Execute;
        break;
      case 3:
      case 4:
        b.run->Velocity = number == 0.0 ? 1.0 : number;
        b.run->Execute = !b.run->Execute;
        break;
      case 5:
        b.move->Distance = 0.25 * number;
        b.move->Execute = !b.move->Execute;
        break;
      case 6:
        b.superimposed->Distance = 0.1 * number;
        b.superimposed->VelocityDiff = 30.0;
        b.superimposed->Execute = !b.superimposed->Execute;
        break;
      case 7:
        b.halt->Execute = !b.halt->Execute;
        break;
      case 8:
        b.stop->Execute = !b.stop->Execute && random() % 2 == 0;
        break;
      case 9:
      case 10:
        b.gear->Execute = !b.gear->Execute;
        break;
      case 11:
        b.gear_at->MasterSyncPosition = static_cast<const Axis*>(b.gear_at->Master)->data.Position + 40.0;
        b.gear_at->SlaveSyncPosition = data.Position + 30.0;
        b.gear_at->Execute = !b.gear_at->Execute;
        break;
      case 12:
        b.gear_velocity->Execute = !b.gear_velocity->Execute;
        break;
      case 13:
        b.out->SlavePosition = data.Position + number;
        b.out->Execute = !b.out->Execute;
        break;
      case 14:
        b.phase->PhaseShift = 0.1 * number;
        b.phase->Execute = !b.phase->Execute;
        break;
      case 15:
        b.offset->Offset = 0.1 * number;
        b.offset->Execute = !b.offset->Execute;
        break;
      case 16:
        b.additive->Position = 0.001 * number;
        b.additive->Enable = !b.additive->Enable && random() % 3 == 0;
        break;
      case 17:
        b.simulation->Enable = !b.simulation->Enable && random() % 3 == 0;
        break;
      case 18:
        b.cam->Execute = !b.cam->Execute;
        break;
      case 19:
        b.jog->Velocity = number;
        b.jog->JogForward = !b.jog->JogForward && random() % 2 == 0;
        break;
      case 20:
        data.PositionLimits_SW.Active = random() % 4 == 0;
        break;
      default:
        data.Override.Velocity = random() % 2 == 0 ? 100.0 : 60.0;
        data.DynamicLimits.MaxAcceleration = random() % 8 == 0 ? 2e4 : 1e5;
        axes[i]->control_panel = random() % 5 == 0;
        break;
    }
  }

  Cam& cam;
  std::vector<Axis*> axes;
  std::vector<Blocks> blocks;
};

/// Every declared variable, by its bytes.
::testing::AssertionResult same(Axis& a, Axis& b) {
  const auto* const first = static_cast<const char*>(a.data_block());
  const auto* const second = static_cast<const char*>(b.data_block());
  for (const auto& list : data_block_of(a.kind).lists())
    for (const Variable& variable : list) {
      const std::size_t elements = variable.count == 0 ? 1 : variable.count;
      for (std::size_t i = 0; i < elements; ++i) {
        const std::size_t offset = variable.offset + i * variable.stride;
        if (std::memcmp(first + offset, second + offset, size_of(variable.type)) != 0)
          return ::testing::AssertionFailure() << a.name << "." << variable.path << " differs";
      }
    }
  return ::testing::AssertionSuccess();
}

TEST(PlainCycle, ShowsWhatTheWholeCycleShows) {
  int synchronous = 0;
  int camming = 0;
  int shifted = 0;
  int standing = 0;
  int moving = 0;
  int jogging = 0;
  int alarms = 0;
  test::for_each_seed(kFirstSeed, test::cases(6, 600), [&](const test::Case& one) {
    Machine whole(true, one.seed);
    Machine plain(false, one.seed);
    std::mt19937_64 first(one.seed);
    std::mt19937_64 second(one.seed);
    for (int tick = 0; tick < 3000; ++tick) {
      if (tick % 8 == 0) {
        whole.act(first);
        plain.act(second);
      }
      whole.tick();
      plain.tick();
      for (std::size_t i = 0; i < whole.axes.size(); ++i) {
        ASSERT_TRUE(same(*whole.axes[i], *plain.axes[i])) << "in tick " << tick;
        const AxisData& data = plain.axes[i]->data;
        synchronous += has_bit(data.StatusWord, StatusBit::Synchronous) ? 1 : 0;
        camming += data.StatusSynchronizedMotion.ActualCam != DB_ANY{} ? 1 : 0;
        shifted += has_bit(data.StatusWord2, Status2Bit::OffsetCommand) ? 1 : 0;
        standing += has_bit(data.StatusWord, StatusBit::Done) ? 1 : 0;
        moving += has_bit(data.StatusWord, StatusBit::PositioningCommand) ? 1 : 0;
        jogging += has_bit(data.StatusWord, StatusBit::JogCommand) ? 1 : 0;
        alarms += data.ErrorDetail.Number != 0 ? 1 : 0;
      }
    }
  });
  EXPECT_GT(synchronous, 1000);
  EXPECT_GT(camming, 1000);
  EXPECT_GT(shifted, 100);
  EXPECT_GT(standing, 1000);
  EXPECT_GT(moving, 1000);
  EXPECT_GT(jogging, 1000);
  EXPECT_GT(alarms, 100);
}

}  // namespace
}  // namespace lockstep::plain_cycle_test
