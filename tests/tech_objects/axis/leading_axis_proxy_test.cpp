// Leading axis proxies: a leading axis on one controller, what follows it on another one, and on its own
// behind the delay.
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>
#include <vector>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/home.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "two_controllers.hpp"

namespace lockstep::leading_axis_proxy_test {
namespace {

using test::kMillisecond;
using test::Pair;
using test::Receiver;
using test::Rig;
using test::Wire;

struct Case {
  std::int64_t cycle;
  int ratio;
  double delay;
};

class Proxies : public testing::TestWithParam<Case> {};

/// Equal cycles or not: the axis of the other controller and the local one behind the delay are at the same
/// place at the same time, to the bit.
TEST_P(Proxies, LeadTheAxesOfAllControllersToTheSamePlaceAtTheSameTime) {
  const Case& c = GetParam();
  Pair pair(c.delay, c.cycle, c.ratio);
  pair.source.continuity[1].acceleration = false;
  pair.run(50);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
  pair.source.gear.Execute = pair.receiver.gear.Execute = true;
  pair.run(100);
  ASSERT_TRUE(pair.source.gear.InGear);
  ASSERT_TRUE(pair.receiver.gear.InGear);
  pair.source.move(800.0);
  std::vector<std::pair<std::int64_t, Setpoint>> local;
  std::size_t compared = 0;
  std::size_t seen = 0;
  for (int part = 0; part < 6; ++part) {
    if (part == 3) pair.source.move(-500.0);
    for (int i = 0; i < 500; ++i) {
      pair.run(1, [&] {
        const std::int64_t t = pair.receiver.controller.now() - c.cycle;
        if (t % (c.cycle * c.ratio) != 0) return;
        EXPECT_LE(pair.receiver.proxy.data.StatusExternalLeadingValue.AdjustmentTime, 0.0);
        // The source has had its tick of this time already.
        if (pair.source.controller.now() - kMillisecond != t) return;
        ++seen;
        ASSERT_EQ(pair.receiver.follower.setpoint().position, pair.source.local.setpoint().position) << t;
        ASSERT_EQ(pair.receiver.follower.setpoint().velocity, pair.source.local.setpoint().velocity) << t;
      });
      ASSERT_FALSE(testing::Test::HasFailure());
    }
  }
  compared = seen;
  EXPECT_GT(compared, 300u);
  EXPECT_GT(pair.source.leader.setpoint().position.turns, 2);
  EXPECT_EQ(pair.receiver.proxy.counters().missing, 0u);
  EXPECT_EQ(pair.receiver.proxy.counters().refused, 0u);
}

INSTANTIATE_TEST_SUITE_P(Cycles, Proxies,
                         testing::Values(Case{kMillisecond, 1, 0.002}, Case{2 * kMillisecond, 1, 0.004},
                                         Case{kMillisecond, 4, 0.008}, Case{kMillisecond, 1, 0.0033},
                                         Case{250'000, 1, 0.0031}));

/// With D = 0 the value is extrapolated: within the written bound of the jerk, v̇ and the time.
TEST(Proxy, ExtrapolatesWithoutADelayWithinTheWrittenBound) {
  Pair pair(0.0);
  pair.run(50);
  pair.source.move(800.0);
  double worst = 0.0, cruising = 0.0;
  for (int i = 0; i < 3000; ++i) {
    pair.run(1);
    const double error =
        std::abs(rounded_difference(pair.receiver.proxy.setpoint().position,
                                    pair.source.leader.setpoint().position, pair.source.leader.modulo()));
    worst = std::max(worst, error);
    if (i > 2500) cruising = std::max(cruising, error);
    EXPECT_GT(pair.receiver.proxy.data.StatusExternalLeadingValue.AdjustmentTime, 0.0);
  }
  // Extrapolated by t = 1 ms, the difference to the path goes to zero over T = 12 ms: J · (t + T)³ / 6.
  EXPECT_LE(worst, 4000.0 * std::pow(0.013, 3) / 6);
  EXPECT_GT(worst, 0.0);
  EXPECT_LE(cruising, 1e-9);
}

TEST(Proxy, ShowsTheSourceInItsBits) {
  Pair pair(0.002);
  pair.receiver.tick();
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::Control));
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::LeadingValueValid)) << "nothing has come yet";
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::LeadingValueModulo));
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::LeadingAxisControl));
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 0u) << "what has never been there is not lost";
  pair.run(30);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueModulo));
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingAxisControl));
  EXPECT_EQ(pair.receiver.proxy.data.StatusExternalLeadingValue.ModuloLength, 100.0);
  EXPECT_EQ(pair.receiver.proxy.data.StatusExternalLeadingValue.ModuloStartValue, 0.0);
  pair.source.power.Enable = false;
  pair.run(30);
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::LeadingAxisControl)) << "the source is in follow-up";
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
}

TEST(Proxy, RefusesAJobAsLongAsNoLeadingValueIsThere) {
  Pair pair(0.002);
  pair.source.wire.cut = true;
  pair.run(20);
  pair.receiver.gear.Execute = true;
  pair.run(5);
  EXPECT_TRUE(pair.receiver.gear.Error);
  EXPECT_EQ(pair.receiver.follower.pending_alarm(), alarm::kLeadingAxis);
}

/// Alarm 900 behind the tolerance time; until then the axis goes on, then it stops with 601; acknowledged, it
/// begins anew.
TEST(Proxy, GoesOnForTheToleranceTimeAndThenRaisesAlarm900) {
  Pair pair(0.002);
  pair.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.05;
  pair.run(50);
  pair.receiver.gear.Execute = true;
  pair.run(50);
  pair.source.move(300.0);
  pair.run(1000);
  ASSERT_NEAR(pair.receiver.follower.setpoint().velocity, 300.0, 1e-6);
  pair.source.wire.cut = true;
  pair.run(40);
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_NEAR(pair.receiver.follower.setpoint().velocity, 300.0, 1e-6);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 0u);
  EXPECT_NEAR(pair.receiver.proxy.data.StatusExternalLeadingValue.AdjustmentTime, 0.038, 2e-3);
  pair.run(30);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 900u);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Reaction, 13);
  EXPECT_EQ(static_cast<std::uint32_t>(pair.receiver.proxy.data.ErrorWord), 4u);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::Error));
  EXPECT_EQ(pair.receiver.follower.pending_alarm(), alarm::kLeadingAxis);
  pair.source.wire.cut = false;
  pair.run(3000);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 900u) << "until it is acknowledged";
  EXPECT_EQ(pair.receiver.follower.setpoint().velocity, 0.0);
  pair.receiver.reset.Execute = true;
  pair.run(20);
  EXPECT_TRUE(pair.receiver.reset.Done);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 0u);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_NEAR(pair.receiver.proxy.data.Velocity, 300.0, 1e-6);
}

/// What comes again within the tolerance time is met without a step; the rig asserts that of the follower.
TEST(Proxy, ComesBackToThePathWithinTheToleranceTimeWithoutAStep) {
  Pair pair(0.002);
  pair.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.1;
  pair.run(50);
  pair.receiver.gear.Execute = pair.source.gear.Execute = true;
  pair.run(50);
  pair.source.move(300.0);
  pair.run(30);
  pair.source.wire.cut = true;  // while it accelerates
  pair.run(60);
  pair.source.wire.cut = false;
  pair.run(600);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 0u);
  EXPECT_TRUE(pair.receiver.gear.InGear);
  EXPECT_EQ(pair.receiver.follower.setpoint().position, pair.source.local.setpoint().position);
}

TEST(Proxy, IsLostWhenItsSourceIsRestarted) {
  Pair pair(0.002);
  pair.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.01;
  pair.run(50);
  pair.source.power.Enable = false;
  pair.run(10);
  pair.source.reset.Restart = true;
  pair.source.reset.Execute = true;
  pair.run(30);
  ASSERT_TRUE(pair.source.reset.Done);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 900u);
  EXPECT_GT(pair.receiver.proxy.counters().refused, 0u);
  pair.receiver.reset.Execute = true;
  pair.run(20);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
}

TEST(Proxy, RaisesAlarm903WhenTheRingOfItsSourceIsAnother) {
  Pair pair(0.002);
  pair.run(50);
  pair.source.wire.change = [](LeadingValueTelegram& telegram) { telegram.modulo.length = 200.0; };
  pair.run(10);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 903u);
  pair.receiver.reset.Execute = true;
  pair.run(10);
  EXPECT_TRUE(pair.receiver.reset.Error) << "that asks for a restart";
  pair.receiver.reset.Execute = false;
  pair.run(5);
  pair.receiver.reset.Restart = pair.receiver.reset.Execute = true;
  pair.run(20);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 0u);
  EXPECT_EQ(pair.receiver.proxy.data.StatusExternalLeadingValue.ModuloLength, 200.0);
}

/// A restart takes one tick of the interpolator, which shows it.
TEST(Proxy, ShowsItsRestartAndChangedStartValues) {
  Pair pair(0.002);
  pair.run(50);
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::OnlineStartValuesChanged));
  pair.receiver.proxy.start_values_changed = true;  // as set_start does
  pair.receiver.reset.Restart = true;
  pair.run(5);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::OnlineStartValuesChanged));
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::RestartActive));
  pair.receiver.reset.Execute = true;
  int active = 0;
  for (int i = 0; i < 20; ++i) {
    pair.run(1);
    active += pair.receiver.bit(ProxyBit::RestartActive) ? 1 : 0;
  }
  EXPECT_EQ(active, 1);
  EXPECT_TRUE(pair.receiver.reset.Done);
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::OnlineStartValuesChanged));
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
}

/// Homing the source renames positions there and at the proxy; nothing that follows moves for it.
TEST(Proxy, HonoursHomingOfItsSourceWithoutMotion) {
  Pair pair(0.002);
  pair.run(50);
  pair.receiver.gear.Execute = pair.source.gear.Execute = true;
  pair.run(50);
  pair.source.move(300.0);
  pair.run(1000);
  pair.source.continuity[0].homing = true;
  pair.source.home.Mode = 0;
  pair.source.home.Position = 42.0;
  pair.source.home.Execute = true;
  Setpoint last = pair.receiver.follower.setpoint();
  for (int i = 0; i < 100; ++i) {
    pair.run(1);
    const Setpoint now = pair.receiver.follower.setpoint();
    ASSERT_NEAR(rounded_difference(now.position, last.position, pair.receiver.follower.modulo()), 0.3, 1e-9);
    last = now;
  }
  ASSERT_TRUE(pair.source.home.Done);
  const double behind =
      rounded_difference(pair.source.leader.setpoint().position, pair.receiver.proxy.setpoint().position,
                         pair.source.leader.modulo());
  EXPECT_NEAR(behind, 300.0 * 0.002, 1e-9) << "the proxy has the new names";
  EXPECT_NEAR(rounded_difference(pair.source.local.setpoint().position,
                                 pair.receiver.follower.setpoint().position, pair.source.leader.modulo()),
              0.0, 1e-9);
}

TEST(Proxy, CountsAndDropsWhatNoSourceCanHaveSent) {
  Pair pair(0.002);
  pair.run(50);
  const auto refused = [&](const std::function<void(LeadingValueTelegram&)>& change) {
    const std::uint64_t before = pair.receiver.proxy.counters().refused;
    pair.source.wire.change = change;
    pair.run(1);
    pair.source.wire.change = {};
    pair.run(2);
    return pair.receiver.proxy.counters().refused - before;
  };
  EXPECT_EQ(refused([](auto& t) { t.value.position.value = std::nan(""); }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.value.position.value = 100.0; }), 1u) << "beyond its ring";
  EXPECT_EQ(refused([](auto& t) { t.value.velocity = INFINITY; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.value.velocity = 1e13; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.value.acceleration = -1e16; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.value.position.turns = INT64_MIN; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.renamed.hi = 1e16; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.delay = INT64_MAX; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.cycle = 0; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.cycle = INT64_MAX; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.modulo.length = -1.0; }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.renamed.hi = std::nan(""); }), 1u);
  EXPECT_EQ(refused([](auto& t) { t.delay = -1; }), 1u);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 0u);
}

/// The parameter of a proxy before a cascade brings the value forward; axes coupled `delayed` do not see it.
TEST(Proxy, BringsTheValueForwardByItsLocalDelay) {
  Pair pair(0.004);
  Axis& beside = pair.receiver.axis("Beside", [](AxisData& data) {
    data.Modulo.Enable = true;
    data.Modulo.Length = 100.0;
  });
  beside.leading_values.push_back({&pair.receiver.proxy, Coupling::delayed});
  auto& power = pair.receiver.block<MC_Power>();
  power.Axis = &beside;
  power.Enable = true;
  auto& gear = pair.receiver.block<MC_GearIn>();
  gear.Master = &pair.receiver.proxy;
  gear.Slave = &beside;
  pair.receiver.proxy.data.Parameter.LocalLeadingValueDelayTime = 0.002;
  pair.run(50);
  pair.receiver.gear.Execute = gear.Execute = true;
  pair.run(50);
  pair.source.move(300.0);
  pair.run(2000);
  const Modulo& ring = pair.source.leader.modulo();
  EXPECT_NEAR(rounded_difference(pair.source.leader.setpoint().position,
                                 pair.receiver.follower.setpoint().position, ring),
              300.0 * 0.002, 1e-9);
  EXPECT_NEAR(rounded_difference(pair.source.leader.setpoint().position, beside.setpoint().position, ring),
              300.0 * 0.004, 1e-9);
}

/// What is measured is provided ahead of the delay: who follows it behind the delay is where it is now.
TEST(Proxy, OfAnEncoderHasWhatItProvidesAheadOfTheDelay) {
  Rig source;
  Axis& conveyor = source.axis("Conveyor");
  auto& encoder =
      static_cast<ExternalEncoder&>(source.controller.add_object(ObjectKind::TO_ExternalEncoder, "Encoder"));
  encoder.source_settings.follows = &conveyor;
  encoder.data.CrossPlcSynchronousOperation.Interface[7].EnableLeadingValueOutput = true;
  encoder.data.CrossPlcSynchronousOperation.LocalLeadingValueDelayTime = 0.005;
  auto& power = source.block<MC_Power>();
  power.Axis = &conveyor;
  power.Enable = true;
  auto& velocity = source.block<MC_MoveVelocity>();
  velocity.Axis = &conveyor;
  velocity.Velocity = 200.0;
  Wire wire;
  source.controller.telegram_outputs.push_back({&encoder, &wire.from});
  Receiver receiver(wire);
  for (int i = 0; i < 3000; ++i) {
    source.tick();
    receiver.tick();
    velocity.Execute = i > 20;
  }
  ASSERT_TRUE(velocity.InVelocity);
  EXPECT_TRUE(receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_NEAR(receiver.proxy.data.Velocity, 200.0, 1e-6);
  EXPECT_NEAR(receiver.proxy.data.Position, encoder.leading_state(Coupling::actual).position.value, 1e-6);
  EXPECT_NEAR(encoder.data.StatusProvidedLeadingValue.DelayedLeadingValue.Position,
              receiver.proxy.data.Position, 1e-9);
}

/// An encoder with noise: by the delay of 0.1 s it would be seen to and fro by a unit. The delay counts ahead
/// of the hysteresis, and nobody who follows the proxy goes back.
TEST(Proxy, OfAnEncoderWithNoiseDoesNotReverseWithinTheHysteresis) {
  Rig source;
  auto& encoder =
      static_cast<ExternalEncoder&>(source.controller.add_object(ObjectKind::TO_ExternalEncoder, "Encoder"));
  Value signal{};
  encoder.source_settings.signal = {&signal, Type::LREAL, -1};
  encoder.data.Extrapolation.Hysteresis.Value = 3.0;
  encoder.data.CrossPlcSynchronousOperation.Interface[0].EnableLeadingValueOutput = true;
  encoder.data.CrossPlcSynchronousOperation.LocalLeadingValueDelayTime = 0.1;
  Wire wire;
  source.controller.telegram_outputs.push_back({&encoder, &wire.from});
  Receiver receiver(wire, kMillisecond, 1, false);
  double last = 0.0;
  for (int i = 0; i < 2000; ++i) {
    signal.r = 0.02 * i + (i % 2 == 0 ? 0.005 : -0.005);  // 20 u/s, ±10 u/s of noise
    source.tick();
    receiver.tick();
    const double position = receiver.proxy.data.Position;
    if (i > 300) {
      ASSERT_GE(position, last - 1e-9) << i;
    }
    last = position;
  }
  EXPECT_TRUE(receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_NEAR(last, signal.r, 3.0);
}

// ---- The blocks of table 4.4, proxy column

/// Each of them that takes a proxy as its leading axis, at work on one.
TEST(ProxyAsMaster, LeadsEveryBlockOfItsColumn) {
  Pair pair(0.002);
  Receiver& r = pair.receiver;
  r.continuity[0].acceleration = false;
  pair.run(50);
  r.home.Execute = true;
  pair.run(10);
  pair.source.move(200.0);
  pair.run(1000);
  r.gear.Execute = true;
  pair.run(500);
  EXPECT_TRUE(r.gear.InGear);
  EXPECT_NEAR(r.follower.data.Velocity, 200.0, 1e-6);
  EXPECT_EQ(r.follower.data.StatusSynchronizedMotion.ActualMaster, r.proxy.number);
  r.relative.PhaseShift = 5.0;
  r.relative.Execute = true;
  pair.run(2000);
  EXPECT_TRUE(r.relative.Done);
  r.absolute.PhaseShift = 8.0;
  r.absolute.Execute = true;
  pair.run(2000);
  EXPECT_TRUE(r.absolute.Done);
  EXPECT_NEAR(r.follower.data.StatusSynchronizedMotion.PhaseShift, 8.0, 1e-9);
  r.gear_velocity.Execute = true;
  pair.run(1000);
  EXPECT_TRUE(r.gear_velocity.InSync);
  r.gear.Execute = false;
  pair.run(5);
  r.gear.Execute = true;
  pair.run(1000);
  EXPECT_TRUE(r.gear.InGear);
  r.gear_pos.MasterSyncPosition = 50.0;
  r.gear_pos.SlaveSyncPosition = 20.0;
  r.gear_pos.MasterStartDistance = 40.0;
  r.gear_pos.SyncProfileReference = 1;
  r.gear_pos.Execute = true;
  pair.run(3000);
  EXPECT_TRUE(r.gear_pos.InSync);
  r.cam_in.Cam = &r.cam;
  r.cam_in.MasterSyncPosition = 50.0;
  r.cam_in.MasterStartDistance = 40.0;
  r.cam_in.SyncProfileReference = 1;
  r.cam_in.ApplicationMode = 1;
  r.cam_in.Execute = true;
  pair.run(3000);
  EXPECT_TRUE(r.cam_in.InSync) << static_cast<int>(r.cam_in.ErrorID);
  EXPECT_NEAR(r.follower.data.Position, r.proxy.data.Position, 1e-6);
}

}  // namespace
}  // namespace lockstep::leading_axis_proxy_test
