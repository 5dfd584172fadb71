#include <gtest/gtest.h>
#include <lcm/lcm.h>

#include <stdexcept>

#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/traces/recorder.hpp"
#include "tests/hmi_bridge/trace_samples.hpp"

namespace lockstep::lcm_publisher_test {
namespace {

const LcmTraceIdentity kIdentity{"rotary_knife", "KNIFE", 2'000'000, 0};

/// What a stranger does: decodes what comes with the generated types.
struct Subscriber {
  std::vector<trace_header_t> headers;
  std::vector<trace_row_t> rows;

  static void on_message(const lcm_recv_buf_t* buffer, const char* channel, void* self) {
    auto& subscriber = *static_cast<Subscriber*>(self);
    const auto size = static_cast<int>(buffer->data_size);
    if (std::string(channel) == "KNIFE_HEADER")
      EXPECT_EQ(subscriber.headers.emplace_back().decode(buffer->data, 0, size), size);
    else
      EXPECT_EQ(subscriber.rows.emplace_back().decode(buffer->data, 0, size), size);
  }
  void subscribe(lcm_t* lcm) { lcm_subscribe(lcm, "KNIFE.*", on_message, this); }
  static void drain(lcm_t* lcm) {
    while (lcm_handle_timeout(lcm, 0) > 0) continue;
  }
};

std::string refusal(const std::string& url) {
  try {
    LcmPublisher publisher(url, kIdentity);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no refusal";
}

TEST(LcmPublisher, ASubscriberDecodesHeaderAndRows) {
  LcmPublisher publisher("memq://", kIdentity);
  Subscriber subscriber;
  subscriber.subscribe(publisher.instance());
  publisher.begin(sample_signals());
  const auto rows = sample_rows(50, 8);
  for (std::size_t i = 0; i < rows.size(); ++i)
    publisher.row({static_cast<std::int64_t>(i) * 2'000'000, i, 0, rows[i]});
  Subscriber::drain(publisher.instance());

  ASSERT_GE(subscriber.headers.size(), 1u);
  ASSERT_EQ(subscriber.rows.size(), rows.size());
  EXPECT_EQ(subscriber.headers[0].names[0], "Knife.Position");
  EXPECT_EQ(subscriber.headers[0].id, subscriber.rows[0].header_id);
  EXPECT_EQ(subscriber.rows[49].t, 98'000'000);
  EXPECT_EQ(subscriber.rows[49].values[0], rows[49][0].r);
  EXPECT_EQ(subscriber.rows[49].exact[0], rows[49][3].i);
  EXPECT_EQ(publisher.reason(), "");
}

TEST(LcmPublisher, TheHeaderComesAgainEverySecondEvenWithoutRows) {
  LcmPublisher publisher("memq://", kIdentity);
  Subscriber subscriber;
  subscriber.subscribe(publisher.instance());
  const auto start = std::chrono::steady_clock::now();
  publisher.begin(sample_signals());
  publisher.flush();
  Subscriber::drain(publisher.instance());
  EXPECT_LE(subscriber.headers.size(),
            1u + (std::chrono::steady_clock::now() - start) / LcmPublisher::kHeaderPeriod);
  const auto deadline = start + std::chrono::seconds(20);
  while (subscriber.headers.size() < 2 && std::chrono::steady_clock::now() < deadline) {
    publisher.flush();
    Subscriber::drain(publisher.instance());
  }
  EXPECT_EQ(subscriber.headers.size(), 2u);
  EXPECT_GE(std::chrono::steady_clock::now() - start, LcmPublisher::kHeaderPeriod);
}

TEST(LcmPublisher, WhatIsNoNetworkIsRefusedWithTheReason) {
  EXPECT_EQ(refusal("tcp://127.0.0.1:80"),
            "LCM on tcp://127.0.0.1:80: unknown network, udpm://ADDRESS:PORT?ttl=N and memq:// are allowed");
  EXPECT_EQ(refusal("udpm://127.0.0.1:7667"),
            "LCM on udpm://127.0.0.1:7667: \"127.0.0.1\" is not a multicast address (224.0.0.0 to "
            "239.255.255.255)");
  EXPECT_EQ(refusal("udpm://239.255.76.67:76677"),
            "LCM on udpm://239.255.76.67:76677: \"76677\" is not a port (1 to 65535)");
  EXPECT_THROW(LcmPublisher("memq://", {"p", "", 1, 0}), std::invalid_argument);
}

TEST(LcmPublisher, TheRecorderPublishesFromItsOwnThread) {
  LREAL x = 0.0;
  TraceRing ring({{&x, Type::LREAL}}, 64);
  auto owned = std::make_unique<LcmPublisher>("memq://", kIdentity);
  lcm_t* const lcm = owned->instance();
  Subscriber subscriber;
  subscriber.subscribe(lcm);
  std::vector<std::unique_ptr<TraceSink>> sinks;
  sinks.push_back(std::move(owned));
  TraceRecorder recorder(ring, {{"x", Type::LREAL, "u"}}, std::move(sinks));
  for (std::uint64_t tick = 0; tick < 1000; ++tick) {
    x = static_cast<double>(tick);
    ring.wait_for_space();
    ring.push(0, tick);
  }
  recorder.stop();
  Subscriber::drain(lcm);
  ASSERT_EQ(subscriber.rows.size(), 1000u);
  for (int tick = 0; tick < 1000; ++tick) EXPECT_EQ(subscriber.rows[tick].values.at(0), tick);
}

}  // namespace
}  // namespace lockstep::lcm_publisher_test
