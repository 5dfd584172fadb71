// What the monitor keeps of a network on which anybody sends anything.
#include <gtest/gtest.h>

#include "cli/monitor/inbox.hpp"
#include "cli/monitor/model.hpp"
#include "tests/hmi_bridge/own_network.hpp"

namespace lockstep::cli::monitor_bounds_test {
namespace {

using namespace std::chrono_literals;

const Model::Clock::time_point kNow{1h};

std::vector<std::uint8_t> header_of(const std::string& channel, std::size_t signals,
                                    const std::string& name = "") {
  LcmEncoder encoder({"p", channel, 1'000'000, 0},
                     std::vector<TraceSignal>(signals, {name, Type::LREAL, ""}));
  const auto bytes = encoder.header();
  return {bytes.begin(), bytes.end()};
}

TEST(MonitorMemory, HasAnEndHoweverManySignalsAreDescribed) {
  Model model("url");
  model.accept("GOOD_HEADER", header_of("GOOD", 3, "x"), kNow);
  const auto many = header_of("X", 60'000);
  for (int i = 0; i < 20; ++i) {
    model.accept("X" + std::to_string(i) + "_HEADER", many, kNow);
    ASSERT_LE(model.heard().traces.memory(), HeardTraces::kMaximumMemory);
  }
  const auto& traces = model.heard().traces.all();
  EXPECT_GE(traces.size(), 2u) << "a description of 60,000 signals alone is no attack";
  EXPECT_LT(traces.size(), 5u);
  // Long names cost too, and a small trace does not become a large one behind the count.
  model.accept("LONG_HEADER", header_of("LONG", 8, std::string(8u << 20, 'x')), kNow);
  EXPECT_FALSE(traces.contains("LONG"));
  model.accept("GOOD", header_of("GOOD", 150'000), kNow);
  EXPECT_EQ(traces.at("GOOD").signals().size(), 3u);
  EXPECT_LE(model.heard().traces.memory(), HeardTraces::kMaximumMemory);
}

TEST(MonitorMemory, HoldsNoRowThatIsLargerThanItsDescription) {
  LcmEncoder small({"p", "C", 1, 0}, std::vector<TraceSignal>(2, {"x", Type::LREAL, ""}));
  LcmEncoder large({"p", "C", 1, 0}, std::vector<TraceSignal>(50'000, {"x", Type::LINT, ""}));
  const std::vector<Value> values(50'000);
  LcmDecoder decoder;
  const auto row = large.row({0, 0, 0, values});
  EXPECT_EQ(decoder.accept(row), LcmDecoder::Message::kEarly);
  EXPECT_EQ(decoder.message().values.size(), 0u) << "nothing is decoded without a description";
  ASSERT_EQ(decoder.accept(small.header()), LcmDecoder::Message::kHeader);
  EXPECT_EQ(decoder.accept(row), LcmDecoder::Message::kEarly);
  // In the name of the description that is known.
  std::vector<std::uint8_t> forged(row.begin(), row.end());
  const auto own = small.row({0, 0, 0, std::span(values).first(2)});
  std::copy(own.begin() + 16, own.begin() + 24, forged.begin() + 16);
  EXPECT_EQ(decoder.accept(forged), LcmDecoder::Message::kDamaged);
  EXPECT_EQ(decoder.message().values.size(), 0u);
  EXPECT_EQ(decoder.accept(own), LcmDecoder::Message::kRow);
}

TEST(MonitorMemory, KeepsNoEventNorPanelOfAnExcessiveLength) {
  Model model("url", Panel(1));
  model.accept("C_HEADER", header_of("C", 1, "x"), kNow);
  event_t event{};
  event.kind = "alarm";
  event.source = "Knife";
  EXPECT_TRUE(model.accept("C_EVENTS", encoded(event), kNow));
  event.text = std::string(Model::kLongestNote, 'x');
  EXPECT_FALSE(model.accept("C_EVENTS", encoded(event), kNow));
  EXPECT_EQ(model.heard().events.alarms().size(), 1u);
  panel_t state{};
  state.axis = "Knife";
  model.accept("C_PANEL", encoded(state), kNow);
  state.axis = std::string(Model::kLongestNote, 'x');
  model.accept("C_PANEL", encoded(state), kNow);
  EXPECT_EQ(model.panel->axes().size(), 1u);
}

// LCM hands messages over behind locks of GLib, which the thread sanitizer does not see.
#ifndef __SANITIZE_THREAD__
TEST(MonitorMemory, HoldsNoMoreThanItMayOfWhatNobodyLooksAt) {
  constexpr std::size_t kMessage = 1u << 20, kSent = 50;
  LcmPublisher publisher("memq://", {"monitor", "MONITOR", 0, 0});
  Inbox inbox(publisher);
  const std::string data(kMessage, 'x');
  for (std::size_t i = 0; i < kSent; ++i)
    ASSERT_EQ(lcm_publish(publisher.instance(), "C", data.data(), kMessage), 0);
  constexpr std::size_t kHeld = Inbox::kMaximumBytes / kMessage;
  ASSERT_TRUE(wait_until([&] { return inbox.dropped() == kSent - kHeld; })) << inbox.dropped();
  std::size_t messages = 0;
  inbox.take(kSent, [&](const std::string& channel, std::span<const std::uint8_t> bytes) {
    EXPECT_EQ(channel, "C");
    EXPECT_EQ(bytes.size(), kMessage);
    ++messages;
  });
  EXPECT_EQ(messages, kHeld);
  // What comes then is taken again.
  ASSERT_EQ(lcm_publish(publisher.instance(), "D", "x", 1), 0);
  ASSERT_TRUE(wait_until([&] {
    inbox.take(kSent, [&](const std::string& channel, auto) { messages += channel == "D" ? 1 : 0; });
    return messages == kHeld + 1;
  }));
}
#endif

}  // namespace
}  // namespace lockstep::cli::monitor_bounds_test
