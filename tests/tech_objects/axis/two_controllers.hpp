/// Two controllers on the bench: one with a leading axis and an axis that follows it behind the delay, one
/// with a proxy and an axis that follows that, and the wire between them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::test {

inline constexpr std::int64_t kMillisecond = 1'000'000;

/// What lies between two controllers: telegrams are handed over `latency` later, but for those that are cut.
struct Wire {
  TelegramRing from, to;
  std::int64_t latency = 500'000;
  bool cut = false;
  bool doubled = false;  // each of them comes twice
  std::function<void(LeadingValueTelegram&)> change;
  std::function<std::int64_t(const LeadingValueTelegram&)> delayed;  // by how much it comes later still
  struct UnderWay {
    std::int64_t arrival;
    LeadingValueTelegram telegram;
  };
  std::deque<UnderWay> under_way;

  void carry(std::int64_t now) {
    from.take([&](LeadingValueTelegram telegram) {
      if (change) change(telegram);
      if (cut) return;
      const std::int64_t arrival = telegram.time + latency + (delayed ? delayed(telegram) : 0);
      const auto behind = std::ranges::upper_bound(under_way, arrival, {}, &UnderWay::arrival);
      under_way.insert(under_way.insert(behind, {arrival, telegram}) + 1, doubled ? 1u : 0u,
                       {arrival, telegram});
    });
    while (!under_way.empty() && under_way.front().arrival <= now) {
      to.put(under_way.front().telegram);
      under_way.pop_front();
    }
  }
};

/// The controller of the leading axis, with a local axis that follows it behind the delay.
struct Source : Rig {
  explicit Source(double delay, bool modulo = true, bool driven = false)
      : leader(axis("Leader",
                    [&](AxisData& data) {
                      data.VirtualAxis.Mode = driven ? 0 : 1;
                      data.Modulo.Enable = modulo;
                      data.Modulo.Length = 100.0;
                      data.CrossPlcSynchronousOperation.Interface[0].EnableLeadingValueOutput = true;
                      data.CrossPlcSynchronousOperation.LocalLeadingValueDelayTime = delay;
                    })),
        local(axis("Local",
                   [&](AxisData& data) {
                     data.Modulo.Enable = modulo;
                     data.Modulo.Length = 100.0;
                   })),
        gear(block<MC_GearIn>()),
        velocity(block<MC_MoveVelocity>()),
        home(block<MC_Home>()),
        reset(block<MC_Reset>()),
        power(block<MC_Power>()) {
    local.leading_values.push_back({&leader, Coupling::delayed});
    power.Axis = home.Axis = &leader;
    velocity.Axis = &leader;
    reset.Axis = &leader;
    power.Enable = true;
    auto& power_local = block<MC_Power>();
    power_local.Axis = &local;
    power_local.Enable = true;
    gear.Master = &leader;
    gear.Slave = &local;
    controller.telegram_outputs.push_back({&leader, &wire.from});
  }

  void move(double speed) {
    velocity.Velocity = speed;
    velocity.Acceleration = velocity.Deceleration = 400.0;
    velocity.Jerk = 4000.0;
    velocity.Execute = !velocity.Execute;
    if (!velocity.Execute) again = true;
  }
  void tick() {
    Rig::tick();
    if (again) velocity.Execute = true;
    again = false;
  }

  Wire wire;
  Axis &leader, &local;
  MC_GearIn& gear;
  MC_MoveVelocity& velocity;
  MC_Home& home;
  MC_Reset& reset;
  MC_Power& power;
  bool again = false;
};

/// Another controller, with a proxy and an axis that follows it.
struct Receiver : Rig {
  explicit Receiver(Wire& from, std::int64_t cycle = kMillisecond, int ratio = 1, bool modulo = true)
      : Rig(cycle, ratio),
        wire(from),
        proxy(static_cast<LeadingAxisProxy&>(controller.add_object(ObjectKind::TO_LeadingAxisProxy, "Line"))),
        follower(axis("Follower",
                      [&](AxisData& data) {
                        data.Modulo.Enable = modulo;
                        data.Modulo.Length = 100.0;
                      })),
        cam(static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, "Curve"))),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        reset(block<MC_Reset>()),
        gear(block<MC_GearIn>()),
        gear_pos(block<MC_GearInPos>()),
        gear_velocity(block<MC_GearInVelocity>()),
        cam_in(block<MC_CamIn>()),
        relative(block<MC_PhasingRelative>()),
        absolute(block<MC_PhasingAbsolute>()) {
    follower.leading_values.push_back({&proxy, Coupling::setpoint});
    power.Axis = home.Axis = &follower;
    power.Enable = true;
    reset.Axis = &proxy;
    gear.Master = gear_pos.Master = gear_velocity.Master = cam_in.Master = relative.Master = absolute.Master =
        &proxy;
    gear.Slave = gear_pos.Slave = gear_velocity.Slave = cam_in.Slave = relative.Slave = absolute.Slave =
        &follower;
    controller.telegram_inputs.push_back({&proxy, &wire.to});
    cam.define_point(0, {0.0, 0.0});
    cam.define_point(1, {100.0, 100.0});
    CamInterpolator interpolator(kCamPoints);
    EXPECT_EQ(cam.interpolate(interpolator), ErrorId::none);
  }

  void tick() {
    wire.carry(controller.now() + controller.shared_time_at_start);
    Rig::tick();
  }
  bool bit(ProxyBit which) const {
    return (static_cast<std::uint32_t>(proxy.data.StatusWord) >> static_cast<unsigned>(which) & 1u) != 0;
  }

  Wire& wire;
  LeadingAxisProxy& proxy;
  Axis& follower;
  Cam& cam;
  MC_Power& power;
  MC_Home& home;
  MC_Reset& reset;
  MC_GearIn& gear;
  MC_GearInPos& gear_pos;
  MC_GearInVelocity& gear_velocity;
  MC_CamIn& cam_in;
  MC_PhasingRelative& relative;
  MC_PhasingAbsolute& absolute;
};

/// Both on one virtual time.
struct Pair {
  explicit Pair(double delay, std::int64_t cycle = kMillisecond, int ratio = 1, bool modulo = true,
                bool driven = false)
      : source(delay, modulo, driven), receiver(source.wire, cycle, ratio, modulo) {}

  /// Up to a time, each at its ticks; the source first where both have one.
  void run_to(std::int64_t end, const std::function<void()>& look = {}) {
    while (std::min(source.controller.now(), receiver.controller.now()) < end) {
      if (source.controller.now() <= receiver.controller.now()) {
        source.tick();
      } else {
        receiver.tick();
        if (look) look();
      }
    }
  }
  void run(int milliseconds, const std::function<void()>& look = {}) {
    run_to(std::min(source.controller.now(), receiver.controller.now()) + milliseconds * kMillisecond, look);
  }

  Source source;
  Receiver receiver;
};

}  // namespace lockstep::test
