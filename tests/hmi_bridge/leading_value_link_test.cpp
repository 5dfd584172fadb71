// Sender and receiver of leading values, over a real network: what the cycle of one puts comes to the cycle
// of the other, and nothing of strangers does.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/lcm/leading_value_receiver.hpp"
#include "hmi_bridge/lcm/leading_value_sender.hpp"
#include "scheduler/waiting_clock.hpp"
#include "tests/hmi_bridge/own_network.hpp"

namespace lockstep::leading_value_link_test {
namespace {

constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0";
constexpr char kChannel[] = "line.main";

LeadingValueLink link(const std::string& key = "", const std::string& sender = "PLC_1") {
  return {.area = kChannel,
          .sender = sender,
          .source = "Conveyor",
          .interface = 1,
          .key = SharedKey(key.begin(), key.end())};
}

LeadingValueTelegram telegram(std::uint64_t sequence, std::int64_t time) {
  LeadingValueTelegram made;
  made.sequence = sequence;
  made.time = time;
  made.cycle = 1'000'000;
  made.value = {{0, static_cast<double>(sequence) / 7.0}, 1.0 / 3.0, 0.0};
  made.valid = made.position_led = true;
  return made;
}

/// A clock that a test sets.
class SetClock final : public SharedClock {
 public:
  SharedClockReading read() noexcept override { return {offset, locked}; }
  std::atomic<std::int64_t> offset{0};
  std::atomic<bool> locked{true};
};

/// The receiving side: one area, whose telegrams two proxies take.
struct Receiving {
  explicit Receiving(const LeadingValueLink& of, std::vector<IpNetwork> from = {})
      : receiver(kUrl, areas(of, std::move(from)), watch) {
    receiver.start();
  }
  std::vector<LeadingValueReceiver::Area> areas(const LeadingValueLink& of, std::vector<IpNetwork> from) {
    return {{.link = of, .from = std::move(from), .rings = {ring.get(), second.get()}, .counts = &counts}};
  }
  /// Takes what has come, as a cycle does. @return how much there is in all
  std::size_t take() {
    ring->take([&](const LeadingValueTelegram& one) { got.push_back(one); });
    second->take([&](const LeadingValueTelegram& one) { second_got.push_back(one); });
    return got.size();
  }
  bool hears(std::size_t count) {
    return wait_until([&] { return take() >= count && second_got.size() >= count; });
  }

  SetClock clock;
  ClockWatch watch{clock};
  CarrierCounts counts;
  std::unique_ptr<TelegramRing> ring = std::make_unique<TelegramRing>();
  std::unique_ptr<TelegramRing> second = std::make_unique<TelegramRing>();
  std::vector<LeadingValueTelegram> got, second_got;
  LeadingValueReceiver receiver;
};

/// The sending side.
struct Sending {
  explicit Sending(const LeadingValueLink& of, std::int64_t run = 17)
      : sender(kUrl, {{.link = of, .ring = ring.get()}}, run, watch, true) {
    sender.start();
  }
  /// What a tick does; the next one comes a millisecond later.
  void tick() {
    ring->put(telegram(++sequence, monotonic_clock().now()));
    monotonic_clock().sleep_until(monotonic_clock().now() + 1'000'000);
  }

  SetClock clock;
  ClockWatch watch{clock};
  std::unique_ptr<TelegramRing> ring = std::make_unique<TelegramRing>();
  std::uint64_t sequence = 0;
  LeadingValueSender sender;
};

TEST(LeadingValueLinks, BringWhatACyclePutsToTheProxiesOfAnother) {
  in_own_network([] {
    bring_up_network();
    Receiving receiving(link("a key of sixteen bytes and more"));
    Sending sending(link("a key of sixteen bytes and more"));
    constexpr std::size_t kTelegrams = 200;
    for (std::size_t i = 0; i < kTelegrams; ++i) sending.tick();
    ASSERT_TRUE(receiving.hears(kTelegrams));
    ASSERT_EQ(receiving.got.size(), kTelegrams);
    for (std::size_t i = 0; i < kTelegrams; ++i) {
      EXPECT_EQ(receiving.got[i].sequence, i + 1);
      EXPECT_EQ(receiving.got[i].value.position.value, static_cast<double>(i + 1) / 7.0);
      EXPECT_EQ(receiving.second_got[i].time, receiving.got[i].time);
      EXPECT_TRUE(receiving.got[i].valid);
    }
    EXPECT_EQ(receiving.counts.accepted, kTelegrams);
    EXPECT_EQ(receiving.counts.malformed + receiving.counts.foreign + receiving.counts.not_signed +
                  receiving.counts.repeated + receiving.counts.stale + receiving.counts.dropped,
              0u);
    EXPECT_EQ(sending.sender.sent().telegrams, kTelegrams);
    EXPECT_EQ(sending.sender.sent().failed, 0u);
  });
}

TEST(LeadingValueLinks, SendWhatIsLeftWhenTheyEnd) {
  in_own_network([] {
    bring_up_network();
    Receiving receiving(link());
    Sending sending(link());
    sending.tick();
    for (std::uint64_t i = 0; i < 50; ++i)
      sending.ring->put(
          telegram(++sending.sequence, monotonic_clock().now() - 1000 * static_cast<int>(50 - i)));
    sending.sender.stop();
    EXPECT_TRUE(receiving.hears(51));
  });
}

TEST(LeadingValueLinks, CountWhatComesFromAnotherAddressSenderOrWithoutTheKey) {
  in_own_network([] {
    bring_up_network();
    std::string problem;
    const auto elsewhere = IpNetwork::parse("10.0.0.0/8", problem);
    const auto here = IpNetwork::parse("0.0.0.0", problem);  // of a machine without an address of a network
    ASSERT_TRUE(elsewhere && here);
    Receiving by_address(link(), {*elsewhere}), right(link(), {*elsewhere, *here}),
        by_name(link("", "PLC_7")), by_key(link("a key that is not theirs"));
    Sending sending(link());
    for (int i = 0; i < 20; ++i) sending.tick();
    EXPECT_TRUE(right.hears(20));
    EXPECT_TRUE(wait_until([&] {
      return by_address.counts.foreign == 20 && by_name.counts.foreign == 20 &&
             by_key.counts.not_signed == 20;
    }));
    for (Receiving* const one : {&by_address, &by_name, &by_key}) EXPECT_EQ(one->take(), 0u);
  });
}

TEST(LeadingValueLinks, CountWhatIsNoTelegramAndHearOtherChannelsNot) {
  in_own_network([] {
    bring_up_network();
    Receiving receiving(link());
    LcmPublisher stranger(kUrl, {"p", "C", 1, 0});
    const auto publish = [&](const char* channel, const std::string& data) {
      lcm_publish(stranger.instance(), channel, data.data(), static_cast<unsigned>(data.size()));
    };
    for (int i = 0; i < 10; ++i) publish(kChannel, std::string(static_cast<std::size_t>(i) * 40, 'x'));
    for (int i = 0; i < 10; ++i) publish("line.other", "x");
    publish(kChannel, std::string(100'000, 'x'));  // in fragments, which no telegram is
    EXPECT_TRUE(wait_until([&] { return receiving.counts.malformed == 10; }));
    Sending sending(link());
    for (int i = 0; i < 5; ++i) sending.tick();
    EXPECT_TRUE(receiving.hears(5));
    EXPECT_EQ(receiving.counts.malformed, 10u);
  });
}

TEST(LeadingValueLinks, BearAFlood) {
  in_own_network([] {
    bring_up_network();
    Receiving receiving(link());
    std::atomic<bool> over{false};
    std::thread flood([&] {
      LcmPublisher stranger(kUrl, {"p", "C", 1, 0});
      const std::string data(300, 'x');
      while (!over)
        lcm_publish(stranger.instance(), kChannel, data.data(), static_cast<unsigned>(data.size()));
    });
    EXPECT_TRUE(wait_until([&] { return receiving.counts.malformed > 1000; }));
    over = true;
    flood.join();
    Sending sending(link());
    EXPECT_TRUE(wait_until([&] {
      sending.tick();
      return receiving.take() > 5;
    })) << "telegrams come when it is over";
  });
}

TEST(LeadingValueLinks, OfAClockThatJumpsCarryNothingUntilItGoesOnEvenly) {
  in_own_network([] {
    bring_up_network();
    constexpr std::int64_t kFar = 37'000'000'000;
    Receiving receiving(link());
    Sending sending(link());
    receiving.clock.offset = sending.clock.offset = kFar;  // as both are set by PTP for the first time
    EXPECT_TRUE(wait_until([&] {
      sending.tick();
      receiving.take();
      return !sending.watch.trusted() && !receiving.watch.trusted() && receiving.counts.untrusted > 0;
    }));
    EXPECT_EQ(receiving.watch.losses(), 1u);
    EXPECT_TRUE(wait_until([&] {
      sending.tick();
      return sending.watch.trusted() && receiving.watch.trusted();
    }));
    EXPECT_EQ(sending.watch.offset(), kFar);
    receiving.take();
    receiving.got.clear();
    receiving.second_got.clear();
    sending.tick();
    ASSERT_TRUE(receiving.hears(1));
    EXPECT_TRUE(receiving.got.back().valid);
    EXPECT_LT(monotonic_clock().now() - receiving.got.back().time, 1'000'000'000)
        << "times in the ring are those of this machine";
  });
}

TEST(LeadingValueLinks, OfASourceWithoutAClockComeAsNotValid) {
  in_own_network([] {
    bring_up_network();
    Receiving receiving(link());
    Sending sending(link());
    sending.clock.locked = false;
    EXPECT_TRUE(wait_until([&] {
      sending.tick();
      receiving.take();
      return !receiving.got.empty() && !receiving.got.back().valid;
    }));
  });
}

}  // namespace
}  // namespace lockstep::leading_value_link_test
