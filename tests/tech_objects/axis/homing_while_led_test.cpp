// Homing of an axis while another one leads it: everything gets its new name, and nothing moves.
#include <gtest/gtest.h>

#include <cmath>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/power.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::homing_while_led_test {
namespace {

using test::Rig;

constexpr double kSpeed = 100.0;  // of the leading axis [u/s]
constexpr double kMark = 150.0;   // place of the zero mark on the machine [u]
constexpr double kCam = 100.0;    // a pass of the cam, which rises by as much [u]

enum class State : std::uint8_t {
  gear,
  gear_in_pos,
  synchronizing,
  gear_out,
  cam,
  cam_with_offset,
  cam_synchronizing,
  cam_out
};

/// A virtual axis that leads one with a drive, which passes a zero mark.
struct Led : Rig {
  Led()
      : l(axis("Leading")),
        f(axis("Following", [](AxisData& data) { data.VirtualAxis.Mode = 0; })),
        power_l(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home(block<MC_Home>()),
        run_l(block<MC_MoveVelocity>()),
        gear(block<MC_GearIn>()),
        pos(block<MC_GearInPos>()),
        out(block<MC_GearOut>()),
        cam_in(block<MC_CamIn>()),
        cam_out(block<MC_CamOut>()),
        offset(block<MC_OffsetRelative>()) {
    lead(f, l);
    f.drive_settings.time_constant = 0.002;
    f.drive_settings.signals.zero_marks = ZeroMarks{kMark, 0.0};
    f.data.FollowingError.EnableMonitoring = false;
    power_l.Axis = run_l.Axis = &l;
    power_f.Axis = home.Axis = &f;
    gear.Master = pos.Master = cam_in.Master = &l;
    gear.Slave = pos.Slave = cam_in.Slave = out.Slave = cam_out.Slave = offset.Slave = &f;
    cam_in.Cam = &make_cam();
    continuity[1].homing = true;
    power_l.Enable = power_f.Enable = true;
    home_in_place(f);
    run(20);
  }

  Cam& make_cam() {
    Cam& made = static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, "Cam"));
    static_cast<CamData1k*>(made.data_block())->InterpolationSettings = {1, 1};
    constexpr double kBend[] = {0.0, 3.0, 0.0, -3.0, 0.0};
    for (std::size_t i = 0; i < 5; ++i) {
      const double place = kCam / 4.0 * static_cast<double>(i);
      made.define_point(i, {place, place + kBend[i]});
    }
    CamInterpolator interpolator(kCamPoints);
    EXPECT_EQ(made.interpolate(interpolator), ErrorId::none);
    return made;
  }

  /// Comes, led by the other axis, into a state in which it moves at about 100 u/s.
  void come_into(State state) {
    run_l.Velocity = kSpeed;
    run_l.Acceleration = 1000.0;
    run_l.Execute = true;
    const bool synchronizing = state == State::synchronizing || state == State::cam_synchronizing;
    gear.Execute = state == State::gear || state == State::gear_out;
    pos.SyncProfileReference = cam_in.SyncProfileReference = 3;
    pos.MasterSyncPosition = cam_in.MasterSyncPosition = 5.0;
    pos.SlaveSyncPosition = 5.0;
    pos.MasterStartDistance = cam_in.MasterStartDistance = synchronizing ? 190.0 : 40.0;
    pos.Execute = state == State::gear_in_pos || state == State::synchronizing;
    cam_in.ApplicationMode = 2;
    cam_in.Execute = state >= State::cam;
    run(900);
    out.SyncProfileReference = cam_out.SyncProfileReference = 1;
    out.MasterStopDistance = 160.0;
    out.SlavePosition = 180.0;
    cam_out.MasterStopDistance = 100.0;
    cam_out.SlavePosition = 165.0;
    out.Execute = state == State::gear_out;
    cam_out.Execute = state == State::cam_out;
    offset.Offset = 30.0;
    offset.OffsetDistance = 200.0;
    offset.Execute = state == State::cam_with_offset;
    run(450);
    const bool desynchronizing = state == State::gear_out || state == State::cam_out;
    ASSERT_EQ(has_bit(f.data.StatusWord, StatusBit::Synchronizing), synchronizing);
    ASSERT_EQ(has_bit(f.data.StatusWord2, Status2Bit::DesynchronizingCommand), desynchronizing);
    ASSERT_EQ(has_bit(f.data.StatusWord, StatusBit::Synchronous), !synchronizing && !desynchronizing);
  }

  /// By how much positions have other names now.
  double renamed() const { return f.renamed().rounded(); }
  /// Where the axis is, as it was called at the beginning.
  double place() const { return f.setpoint().position.value - renamed(); }

  Axis& l;
  Axis& f;
  MC_Power& power_l;
  MC_Power& power_f;
  MC_Home& home;
  MC_MoveVelocity& run_l;
  MC_GearIn& gear;
  MC_GearInPos& pos;
  MC_GearOut& out;
  MC_CamIn& cam_in;
  MC_CamOut& cam_out;
  MC_OffsetRelative& offset;
};

class HomingWhileLed : public ::testing::TestWithParam<std::tuple<State, bool>> {};
INSTANTIATE_TEST_SUITE_P(States, HomingWhileLed,
                         ::testing::Combine(::testing::Values(State::gear, State::gear_in_pos,
                                                              State::synchronizing, State::gear_out,
                                                              State::cam, State::cam_with_offset,
                                                              State::cam_synchronizing, State::cam_out),
                                            ::testing::Bool()));

/// Beside a machine that is not homed again: the same motion, by other names. By passive homing, which is
/// under way when the coupling begins, or by direct homing where that is permitted. (Mode 8 takes the homed
/// state away, without which nothing couples at a position.)
TEST_P(HomingWhileLed, ShiftsWhatLeadsTheAxisAndMovesNothing) {
  const auto [state, passive] = GetParam();
  Led rig, beside;
  const bool by_gear = state == State::gear || state == State::gear_out;
  rig.home.Mode = !passive ? 1 : by_gear ? 8 : 2;
  rig.home.Position = passive ? 1000.0 : 11.0;
  rig.home.Execute = passive;
  rig.run(2);
  beside.run(2);
  rig.come_into(state);
  beside.come_into(state);
  ASSERT_FALSE(rig.home.Done);
  rig.home.Execute = true;
  const bool refused =
      !passive && state != State::gear && state != State::gear_out && state != State::cam_out;
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    beside.tick();
    ASSERT_NEAR(rig.place(), beside.f.setpoint().position.value, 1e-9) << i;
    ASSERT_NEAR(rig.f.setpoint().velocity, beside.f.setpoint().velocity, 1e-9) << i;
    ASSERT_NEAR(rig.f.data.StatusPositioning.FollowingError, beside.f.data.StatusPositioning.FollowingError,
                1e-6)
        << i;
  }
  EXPECT_EQ(rig.home.Done, !refused);
  EXPECT_EQ(rig.home.ErrorID, static_cast<WORD>(refused ? ErrorId::homing_while_coupled : ErrorId::none));
  EXPECT_EQ(rig.renamed() != 0.0, !refused);
  for (const StatusBit bit : {StatusBit::Synchronizing, StatusBit::Synchronous})
    EXPECT_EQ(has_bit(rig.f.data.StatusWord, bit), has_bit(beside.f.data.StatusWord, bit));
  EXPECT_EQ(rig.out.Done, state == State::gear_out);
  EXPECT_EQ(rig.cam_out.Done, state == State::cam_out);
  EXPECT_EQ(rig.offset.Done, state == State::cam_with_offset);
  EXPECT_NEAR(rig.offset.CoveredOffset, beside.offset.CoveredOffset, 1e-9);
}

}  // namespace
}  // namespace lockstep::homing_while_led_test
