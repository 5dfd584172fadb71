// Leading axis proxies whose source is invalid, off, restarted or replaced, or whose telegrams come late,
// twice or from ahead: what is followed goes on, or ends in an alarm, and never jumps.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fb/gear_in.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "two_controllers.hpp"

namespace lockstep::proxy_sources_test {
namespace {

using test::kMillisecond;
using test::Pair;
using test::Receiver;
using test::Rig;
using test::Wire;

double apart(const Setpoint& a, const Setpoint& b, const Modulo& modulo) {
  return std::abs(rounded_difference(a.position, b.position, modulo));
}

// ---- A source that is not valid

/// An encoder that measures a signal, which is heard of or not, and a receiver of what it provides.
struct Measured : Rig {
  Measured()
      : encoder(
            static_cast<ExternalEncoder&>(controller.add_object(ObjectKind::TO_ExternalEncoder, "Encoder"))),
        reset(block<MC_Reset>()),
        receiver(wire) {
    signal_value.r = 0.0;
    encoder.source_settings.signal = {&signal_value, Type::LREAL, -1};
    encoder.source_settings.valid = &heard;
    encoder.data.CrossPlcSynchronousOperation.Interface[0].EnableLeadingValueOutput = true;
    encoder.data.CrossPlcSynchronousOperation.LocalLeadingValueDelayTime = 0.002;
    reset.Axis = &encoder;
    controller.telegram_outputs.push_back({&encoder, &wire.from});
  }
  /// Milliseconds of both controllers, in which the signal moves.
  void go(int milliseconds, double velocity = 0.0) {
    for (int i = 0; i < milliseconds; ++i) {
      signal_value.r += velocity * 1e-3;
      tick();
      receiver.tick();
    }
  }

  Value signal_value{};
  bool heard = false;
  Wire wire;
  ExternalEncoder& encoder;
  MC_Reset& reset;
  Receiver receiver;
};

TEST(ProxySources, ThatAreNotValidAtFirstLeadOnceTheyAreWhateverComesTwice) {
  Measured rig;
  rig.wire.doubled = true;
  rig.wire.delayed = [](const LeadingValueTelegram& telegram) {
    return telegram.sequence % 5 == 0 ? 3 * kMillisecond : 0;
  };
  rig.go(50);
  EXPECT_FALSE(rig.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_EQ(rig.receiver.proxy.data.ErrorDetail.Number, 0u);
  EXPECT_EQ(rig.receiver.proxy.counters().refused, 0u);
  rig.heard = true;
  rig.go(50, 20.0);
  EXPECT_TRUE(rig.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_NEAR(rig.receiver.proxy.data.Velocity, 20.0, 1e-6);
  EXPECT_EQ(rig.receiver.proxy.counters().refused, 0u);
  EXPECT_EQ(rig.receiver.proxy.counters().missing, 0u);
  EXPECT_GT(rig.receiver.proxy.counters().doubled, 50u);
}

/// A fault of the source that is acknowledged within the tolerance time, over a network that doubles.
TEST(ProxySources, ThatAreInvalidForLessThanTheToleranceTimeAreFollowedOn) {
  Measured rig;
  rig.wire.doubled = rig.heard = true;
  rig.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.2;
  rig.go(50);
  rig.receiver.gear.Execute = true;
  rig.go(2000, 20.0);
  ASSERT_TRUE(rig.receiver.gear.InGear);
  rig.heard = false;
  rig.go(30, 20.0);
  EXPECT_FALSE(rig.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_NEAR(rig.receiver.follower.data.Velocity, 20.0, 1e-6) << "it goes on";
  rig.heard = true;
  rig.reset.Execute = true;
  rig.go(1000, 20.0);
  EXPECT_EQ(rig.receiver.proxy.data.ErrorDetail.Number, 0u);
  EXPECT_TRUE(rig.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_TRUE(rig.receiver.gear.InGear);
  EXPECT_NEAR(
      apart(rig.receiver.follower.setpoint(), rig.receiver.proxy.setpoint(), rig.receiver.follower.modulo()),
      0.0, 1e-9);
}

TEST(ProxySources, ThatStayInvalidRaiseAlarm900) {
  Measured rig;
  rig.heard = true;
  rig.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.02;
  rig.go(50);
  rig.heard = false;
  rig.go(40);
  EXPECT_EQ(rig.receiver.proxy.data.ErrorDetail.Number, 900u);
}

// ---- A source that is another one

TEST(ProxySources, ThatAreRestartedBeforeTheyHaveLedCountAtOnce) {
  Measured rig;
  rig.go(20);
  rig.reset.Restart = rig.reset.Execute = true;
  rig.go(20);
  rig.heard = true;
  rig.go(20);
  EXPECT_TRUE(rig.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_EQ(rig.receiver.proxy.counters().refused, 0u);
}

/// A controller that has been started anew may be anywhere, whatever number its telegrams have.
TEST(ProxySources, OfAControllerThatHasBeenStartedAnewAreLost) {
  Pair pair(0.002);
  pair.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.01;
  pair.run(50);
  pair.receiver.gear.Execute = true;
  pair.run(50);
  const Setpoint before = pair.receiver.follower.setpoint();
  pair.source.wire.change = [](LeadingValueTelegram& telegram) {
    telegram.run = 7;
    telegram.value.position.value = 50.0;
  };
  pair.run(50);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 900u);
  EXPECT_EQ(pair.receiver.follower.setpoint().position, before.position);
  pair.receiver.reset.Execute = true;
  pair.run(20);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
  EXPECT_EQ(pair.receiver.proxy.data.Position, 50.0);
}

TEST(ProxySources, WithoutAToleranceTimeAreLostInTheTickInWhichTheyAreInvalid) {
  Pair pair(0.002);
  pair.run(50);
  pair.source.wire.cut = true;
  int alarmed = 0;
  for (int i = 0; i < 20 && alarmed == 0; ++i) {
    pair.run(1);
    EXPECT_NE(pair.receiver.bit(ProxyBit::LeadingValueValid), pair.receiver.bit(ProxyBit::Error));
    if (pair.receiver.bit(ProxyBit::Error)) alarmed = i;
  }
  // Two cycles of the receiver and four of the source behind the newest, half a millisecond under way.
  EXPECT_NEAR(alarmed, 6, 1);
}

TEST(ProxySources, AreFollowedNoFurtherOnceTheProxyIsRestarted) {
  Pair pair(0.002);
  pair.run(50);
  pair.receiver.gear.Execute = true;
  pair.run(50);
  pair.source.move(100.0);
  pair.run(1000);
  pair.receiver.reset.Restart = pair.receiver.reset.Execute = true;
  pair.run(1000);
  EXPECT_TRUE(pair.receiver.reset.Done);
  EXPECT_EQ(pair.receiver.follower.pending_alarm(), alarm::kLeadingAxis);
  EXPECT_EQ(pair.receiver.follower.data.Velocity, 0.0);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
}

// ---- A source that is switched off, or on a line

/// Switched off and on again in motion: what follows through the proxy does what follows behind the delay at
/// home, to the bit, and the rig watches that neither steps.
TEST(ProxySources, ThatAreSwitchedOffAndOnInMotionLeadAsAtHome) {
  Pair pair(0.004, kMillisecond, 1, true, true);
  pair.source.continuity[0].velocity = pair.source.continuity[0].acceleration = false;  // has a drive
  // They come over with the maximum dynamics of the leading axis, which is what the rig watches by itself.
  for (Rig* const rig : {static_cast<Rig*>(&pair.source), static_cast<Rig*>(&pair.receiver)})
    for (auto& rule : rig->continuity) {
      rule.acceleration = false;
      rule.highest_acceleration *= 1.0 + 1e-6;
    }
  pair.run(50);
  pair.receiver.gear.Execute = pair.source.gear.Execute = true;
  pair.run(50);
  pair.source.move(300.0);
  bool off = false;
  for (int i = 0; i < 3000; ++i) {
    if (i == 1500) pair.source.power.Enable = false;
    if (i == 1520) pair.source.power.Enable = true;
    if (i == 1800) pair.source.move(-200.0);
    pair.run(1);
    off |= !pair.receiver.bit(ProxyBit::LeadingAxisControl);
    ASSERT_EQ(pair.receiver.bit(ProxyBit::LeadingValueValid), true) << i;
  }
  EXPECT_TRUE(off);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingAxisControl));
  EXPECT_NEAR(pair.source.leader.data.Velocity, -200.0, 1e-6);
  EXPECT_TRUE(pair.source.gear.InGear);
  EXPECT_TRUE(pair.receiver.gear.InGear);
  EXPECT_EQ(pair.receiver.follower.setpoint().position, pair.source.local.setpoint().position);
}

TEST(ProxySources, OnALineLeadToTheSamePlaceHoweverFarTheyGo) {
  Pair pair(0.003, kMillisecond, 1, false);
  pair.run(50);
  EXPECT_FALSE(pair.receiver.bit(ProxyBit::LeadingValueModulo));
  pair.receiver.gear.Execute = pair.source.gear.Execute = true;
  pair.run(50);
  pair.source.move(900.0);
  pair.run(8000);
  EXPECT_GT(pair.receiver.follower.data.Position, 4000.0);
  EXPECT_EQ(pair.receiver.follower.setpoint().position, pair.source.local.setpoint().position);
  pair.source.move(-900.0);
  pair.run(20000);
  EXPECT_LT(pair.receiver.follower.data.Position, -4000.0);
  EXPECT_EQ(pair.receiver.follower.setpoint().position, pair.source.local.setpoint().position);
  EXPECT_EQ(pair.receiver.proxy.data.StatusExternalLeadingValue.ModuloLength, 0.0);
}

// ---- A source that misses ticks, and stands still in them

/// Whoever follows behind the delay at home stands still with it, and whoever follows elsewhere goes on,
/// slower, until it is at the same place again; the rigs watch that neither steps.
TEST(ProxySources, ThatMissTicksLeadNobodyBackNorByAStep) {
  for (const double delay : {0.0, 0.002, 0.004, 0.03}) {
    SCOPED_TRACE(delay);
    Pair pair(delay);
    pair.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.5;
    pair.receiver.continuity[0].highest_jerk = 2e7;  // of 0.3 u in 12 ms
    pair.run(100);
    pair.receiver.gear.Execute = pair.source.gear.Execute = true;
    pair.run(50);
    pair.source.move(300.0);
    pair.run(2000);
    for (const int missed : {1, 5, 6, 20, 100, 7, 7, 7}) {
      pair.source.controller.skip(missed);
      for (int i = 0; i < 4 * missed; ++i) {
        pair.run(1);
        ASSERT_GE(pair.receiver.follower.setpoint().velocity, 0.0) << missed;
        ASSERT_FALSE(testing::Test::HasFailure()) << missed;
      }
    }
    pair.run(600);
    EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 0u);
    EXPECT_EQ(pair.receiver.proxy.counters().missing, 0u) << "none was sent in those";
    EXPECT_NEAR(
        apart(pair.receiver.follower.setpoint(), pair.source.local.setpoint(), pair.source.leader.modulo()),
        0.0, delay == 0.0 ? 1e-6 : 1e-9);
  }
}

/// Ticks that are missed while somebody synchronizes elsewhere are no reversal: no alarm 608.
TEST(ProxySources, ThatMissTicksWhileSomebodySynchronizesElsewhereAreMet) {
  Pair pair(0.004);
  pair.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.5;
  pair.receiver.continuity[0].acceleration = false;  // behind the profile
  pair.run(50);
  pair.receiver.home.Execute = true;
  pair.run(10);
  pair.source.move(100.0);
  pair.run(1000);
  pair.receiver.gear_pos.MasterSyncPosition = 50.0;
  pair.receiver.gear_pos.SlaveSyncPosition = 20.0;
  pair.receiver.gear_pos.MasterStartDistance = 40.0;
  pair.receiver.gear_pos.SyncProfileReference = 1;
  pair.receiver.gear_pos.Execute = true;
  bool stalled = false;
  for (int i = 0; i < 3000 && !pair.receiver.gear_pos.InSync; ++i) {
    if (!stalled && pair.receiver.gear_pos.StartSync) {
      pair.run(100);
      ASSERT_FALSE(pair.receiver.gear_pos.InSync) << "it has just begun";
      pair.source.controller.skip(130);
      stalled = true;
    }
    pair.run(1);
  }
  EXPECT_TRUE(stalled);
  EXPECT_TRUE(pair.receiver.gear_pos.InSync);
  EXPECT_EQ(pair.receiver.follower.pending_alarm(), 0);
}

// ---- Telegrams out of time

/// A tick that is late by up to a second leaves telegrams to later ones; what is further ahead no tick can be
/// late for. That is refused at once, and what comes behind it is taken.
TEST(ProxySources, AheadByMoreThanASecondAreRefusedAndHoldNothingUp) {
  Pair pair(0.002);
  pair.run(50);
  constexpr std::int64_t kSecond = 1000 * kMillisecond;
  LeadingValueTelegram newest;
  pair.source.wire.change = [&](const LeadingValueTelegram& one) { newest = one; };
  pair.run(2);
  pair.source.wire.cut = true;
  pair.run(1);
  const auto put = [&](std::int64_t ahead) {
    const std::uint64_t taken = pair.receiver.proxy.counters().received;
    LeadingValueTelegram telegram = newest;
    telegram.sequence += 1;
    telegram.time = pair.receiver.controller.now() + ahead;
    pair.source.wire.to.put(telegram);
    newest.sequence += 1;
    newest.time = pair.receiver.controller.now();
    pair.source.wire.to.put(newest);
    pair.receiver.tick();
    return pair.receiver.proxy.counters().received - taken;
  };
  EXPECT_EQ(put(kSecond + 1), 1u) << "the one behind it";
  EXPECT_EQ(pair.receiver.proxy.counters().refused, 1u);
  EXPECT_EQ(put(kSecond), 0u) << "its tick may come yet";
  EXPECT_EQ(pair.receiver.proxy.counters().refused, 1u);
  const std::uint64_t taken = pair.receiver.proxy.counters().received;
  for (int i = 0; i < 998; ++i) pair.receiver.tick();
  EXPECT_EQ(pair.receiver.proxy.counters().received, taken);
  pair.receiver.tick();
  EXPECT_GT(pair.receiver.proxy.counters().received, taken);
  EXPECT_EQ(pair.receiver.proxy.counters().refused, 1u);
}

/// Homing while telegrams of before come after those of after it: they have the new names, and nothing moves.
TEST(ProxySources, ThatAreHomedDoNotMoveWhatFollowsThoughOlderTelegramsComeLater) {
  Pair pair(0.006);
  pair.source.wire.delayed = [](const LeadingValueTelegram& telegram) {
    return telegram.sequence % 3 == 0 ? 3 * kMillisecond : 0;
  };
  pair.source.continuity[0].homing = true;
  pair.run(50);
  pair.receiver.gear.Execute = pair.source.gear.Execute = true;
  pair.run(50);
  pair.source.move(300.0);
  pair.run(1000);
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
  EXPECT_GT(pair.receiver.proxy.counters().late, 100u);
  EXPECT_LE(pair.receiver.proxy.counters().missing, 1u) << "under way";
}

/// A network of 30 ms, for which the delay has been chosen: nothing of it is extrapolated, and it is valid.
TEST(ProxySources, OnASlowNetworkAreValidBehindADelayThatIsLongEnough) {
  Pair pair(0.04);
  pair.source.wire.latency = 30 * kMillisecond;
  pair.run(100);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
  pair.receiver.gear.Execute = pair.source.gear.Execute = true;
  pair.run(50);
  pair.source.move(300.0);
  pair.run(2000);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 0u);
  EXPECT_EQ(pair.receiver.follower.setpoint().position, pair.source.local.setpoint().position);
  EXPECT_NEAR(pair.receiver.proxy.data.StatusExternalLeadingValue.AdjustmentTime, -0.01, 1.1e-3);
  Pair shorter(0.02);
  shorter.source.wire.latency = 30 * kMillisecond;
  shorter.run(100);
  EXPECT_FALSE(shorter.receiver.bit(ProxyBit::LeadingValueValid)) << "here it would be extrapolated by 10 ms";
}

/// A tick that is late finds telegrams of what is ahead of its time: by one of its cycles they count.
TEST(ProxySources, AheadByNoMoreThanACycleOfTheReceiverCount) {
  Pair pair(0.008, kMillisecond, 4);
  pair.source.wire.latency = -3 * kMillisecond;
  pair.run(50);
  EXPECT_EQ(pair.receiver.proxy.counters().refused, 0u);
  EXPECT_TRUE(pair.receiver.bit(ProxyBit::LeadingValueValid));
  LeadingValueTelegram telegram;
  pair.source.wire.change = [&](const LeadingValueTelegram& newest) { telegram = newest; };
  pair.run(4);
  const std::int64_t now = telegram.time;
  telegram.time = now + 4 * kMillisecond;
  ++telegram.sequence;
  pair.receiver.proxy.take(telegram, now);
  EXPECT_EQ(pair.receiver.proxy.counters().refused, 0u);
  telegram.time += 1;
  ++telegram.sequence;
  pair.receiver.proxy.take(telegram, now);
  EXPECT_EQ(pair.receiver.proxy.counters().refused, 1u);
}

// ---- Delays that change in motion

struct Beside : Pair {
  Beside()
      : Pair(0.004),
        beside(receiver.axis("Beside",
                             [](AxisData& data) {
                               data.Modulo.Enable = true;
                               data.Modulo.Length = 100.0;
                             })),
        gear_beside(receiver.block<MC_GearIn>()) {
    beside.leading_values.push_back({&receiver.proxy, Coupling::delayed});
    auto& power = receiver.block<MC_Power>();
    power.Axis = &beside;
    power.Enable = true;
    gear_beside.Master = &receiver.proxy;
    gear_beside.Slave = &beside;
  }
  Axis& beside;
  MC_GearIn& gear_beside;
};

/// Written while the value comes back to the path from a gap: neither what is brought forward steps, nor what
/// is not; the rig watches both.
TEST(ProxySources, AreBroughtForwardInMotionWithoutAStep) {
  Beside pair;
  pair.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 0.1;
  pair.run(50);
  pair.receiver.gear.Execute = pair.gear_beside.Execute = pair.source.gear.Execute = true;
  pair.run(50);
  pair.source.move(300.0);
  pair.run(100);
  pair.source.wire.cut = true;  // while it accelerates
  pair.run(40);
  pair.source.wire.cut = false;
  pair.run(10);
  pair.receiver.proxy.data.Parameter.LocalLeadingValueDelayTime = 0.002;
  pair.run(2000);
  const Modulo& ring = pair.source.leader.modulo();
  EXPECT_NEAR(apart(pair.beside.setpoint(), pair.source.local.setpoint(), ring), 0.0, 1e-9);
  EXPECT_NEAR(
      rounded_difference(pair.receiver.follower.setpoint().position, pair.beside.setpoint().position, ring),
      300.0 * 0.002, 1e-9);
}

/// What no cascade can ask for is limited as the delay of a source is.
TEST(ProxySources, AreBroughtForwardByNoMoreThanTheLongestDelay) {
  Pair pair(0.002);
  pair.run(50);
  pair.receiver.proxy.data.Parameter.LocalLeadingValueDelayTime = 1e9;
  pair.run(20);
  EXPECT_NEAR(pair.receiver.proxy.data.StatusExternalLeadingValue.AdjustmentTime,
              kLongestLeadingDelay * 1e-3 - 0.001, 1.1e-3);
}

/// Extrapolated without end, a fast source leaves every range: that is an alarm, not a number.
TEST(ProxySources, ThatWouldBeExtrapolatedBeyondEveryRangeAreLost) {
  Pair pair(0.002, kMillisecond, 1, false);
  pair.receiver.proxy.data.Parameter.ToleranceTimeExternalLeadingValueInvalid = 1e12;
  pair.source.wire.change = [](LeadingValueTelegram& telegram) {
    telegram.value.velocity = 9e11;
    telegram.value.position.value = 1e11;
  };
  pair.run(50);
  pair.source.wire.cut = true;
  pair.run(3000);
  EXPECT_EQ(pair.receiver.proxy.data.ErrorDetail.Number, 900u);
  EXPECT_LE(std::abs(pair.receiver.proxy.data.Position), kPositionRange);
}

}  // namespace
}  // namespace lockstep::proxy_sources_test
