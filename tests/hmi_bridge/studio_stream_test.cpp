// Frames and back-pressure, without a network.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hmi_bridge/studio/frames.hpp"
#include "hmi_bridge/studio/stream.hpp"
#include "tests/hmi_bridge/studio_client.hpp"
#include "tests/support/values.hpp"

namespace lockstep::studio_stream_test {
namespace {

using test::DecodedFrame;
using test::integer;
using test::real;

DecodedFrame decoded(const std::vector<std::uint8_t>& bytes) {
  return DecodedFrame(std::string(bytes.begin(), bytes.end()));
}

class Streamed : public testing::Test {
 protected:
  void SetUp() override {
    store.set_signals(std::vector<TraceSignal>{{"x", Type::LREAL, ""}, {"on", Type::BOOL, ""}});
    stream.subscribe(7, {0, 1}, store);
  }
  void add(std::uint64_t rows, std::uint64_t missing = 0) {
    for (std::uint64_t i = 0; i < rows; ++i, ++next) {
      const double value = next == peak ? 1e6 : std::sin(static_cast<double>(next));
      store.append(static_cast<std::int64_t>(next) * 1000, next,
                   std::vector<Value>{real(value), integer(static_cast<std::int64_t>(next % 2))},
                   i == 0 ? missing : 0);
    }
  }
  DecodedFrame frame() {
    const auto bytes = stream.next(store);
    if (!bytes) return DecodedFrame("");
    return decoded(*bytes);
  }

  TraceStore store;
  StudioStream stream;
  std::uint64_t next = 0;
  std::uint64_t peak = ~std::uint64_t{0};
};

TEST_F(Streamed, RowsComeOnceAndToTheBit) {
  add(5);
  const DecodedFrame first = frame();
  ASSERT_TRUE(first.is_whole);
  EXPECT_EQ(first.kind, 1);
  EXPECT_EQ(first.subscription, 7u);
  EXPECT_EQ(first.frame, 1u);
  EXPECT_EQ(first.tick, (std::vector<std::uint64_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(first.t[4], 4000);
  EXPECT_EQ(first.columns[0].real(0, 3), std::sin(3.0));
  EXPECT_EQ(first.columns[1].type, 3);
  EXPECT_EQ(first.columns[1].arrays[0], (std::vector<std::uint64_t>{0, 1, 0, 1, 0}));
  EXPECT_FALSE(frame().is_whole) << "there is nothing new";
  add(1);
  EXPECT_EQ(frame().tick, std::vector<std::uint64_t>{5});
}

TEST_F(Streamed, APageThatDoesNotAnswerGetsNoMoreAndLaterEveryPeak) {
  for (int i = 0; i < 20; ++i) {
    add(10);
    frame();
  }
  EXPECT_EQ(stream.unanswered_frames(), StudioStream::kFrames);
  peak = 5000;
  add(20'000);
  EXPECT_FALSE(frame().is_whole);
  stream.acknowledge(8);
  const DecodedFrame coarse = frame();
  ASSERT_TRUE(coarse.is_whole);
  EXPECT_EQ(coarse.kind, 2);
  EXPECT_LE(coarse.t.size(), StudioStream::kPoints + 1);
  EXPECT_EQ(coarse.tick.front(), 80u) << "from where it stood";
  double highest = 0.0;
  for (std::size_t i = 0; i < coarse.t.size(); ++i) highest = std::max(highest, coarse.columns[0].real(2, i));
  EXPECT_EQ(highest, 1e6);
  EXPECT_EQ(coarse.dropped, 0u);
}

TEST_F(Streamed, AnAnswerToAFrameThatWasNotSentMeansNothing) {
  for (int i = 0; i < 9; ++i) {
    add(1);
    frame();
  }
  stream.acknowledge(4'000'000'000u);
  EXPECT_EQ(stream.unanswered_frames(), 8u);
  stream.acknowledge(3);
  EXPECT_EQ(stream.unanswered_frames(), 5u);
}

TEST_F(Streamed, MissingRowsEndAFrameAndAreCounted) {
  add(3);
  add(3, 40);
  const DecodedFrame before = frame();
  EXPECT_EQ(before.tick, (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(before.dropped, 0u);
  const DecodedFrame behind = frame();
  EXPECT_EQ(behind.tick, (std::vector<std::uint64_t>{3, 4, 5}));
  EXPECT_EQ(behind.dropped, 40u);
  add(1);
  EXPECT_EQ(frame().dropped, 40u) << "each gap once";
}

TEST_F(Streamed, OnlyEachSoManiethRowIsSentWhereThatIsWanted) {
  stream.subscribe(7, {0, 1}, store, 4);
  add(6);
  EXPECT_EQ(frame().tick, (std::vector<std::uint64_t>{0, 4}));
  add(2);
  EXPECT_FALSE(frame().is_whole) << "rows 6 and 7 are none of them";
  add(1);
  const DecodedFrame one = frame();
  EXPECT_EQ(one.tick, std::vector<std::uint64_t>{8});
  EXPECT_EQ(one.columns[0].real(0, 0), std::sin(8.0));
  EXPECT_EQ(one.columns[1].arrays[0], std::vector<std::uint64_t>{0});
  // Those that are missing are counted, and not those that are left out.
  add(7, 3);
  EXPECT_EQ(frame().dropped, 3u);
  // One that begins later sees the same rows.
  stream.subscribe(8, {0}, store, 5);
  stream.unsubscribe(7);
  add(10);
  EXPECT_EQ(frame().tick, (std::vector<std::uint64_t>{20, 25}));
}

TEST_F(Streamed, OfThinnedRowsAPageThatComesBackSeesEveryPeak) {
  stream.subscribe(7, {0, 1}, store, 10);
  peak = 30'007;
  add(40'000);
  const DecodedFrame coarse = frame();
  EXPECT_EQ(coarse.kind, 2);
  EXPECT_LE(coarse.t.size(), StudioStream::kPoints + 1);
  double highest = 0.0;
  for (std::size_t i = 0; i < coarse.t.size(); ++i) highest = std::max(highest, coarse.columns[0].real(2, i));
  EXPECT_EQ(highest, 1e6) << "of a row that would not have been sent by itself";
}

TEST(StudioStream, WhatTheStoreHasForgottenIsCounted) {
  TraceStore store({.bytes = 1});
  store.set_signals(std::vector<TraceSignal>{{"x", Type::LREAL, ""}});
  StudioStream stream;
  stream.subscribe(1, {0}, store);
  for (std::uint64_t i = 0; i < 10'000; ++i)
    store.append(static_cast<std::int64_t>(i), i, std::vector<Value>{real(1.0)});
  ASSERT_GT(store.begin(), 0u);
  const auto bytes = stream.next(store);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(decoded(*bytes).dropped, store.begin());
  EXPECT_EQ(decoded(*bytes).tick.front(), store.begin());
}

TEST(StudioStream, SubscriptionsTakeTurnsAndCanBeReplaced) {
  TraceStore store;
  store.set_signals(std::vector<TraceSignal>{{"x", Type::LREAL, ""}, {"y", Type::LREAL, ""}});
  StudioStream stream;
  stream.subscribe(1, {0}, store);
  stream.subscribe(2, {1}, store);
  stream.subscribe(2, {1, 0}, store);
  store.append(0, 0, std::vector<Value>{real(1.0), real(2.0)});
  std::vector<std::pair<std::uint32_t, std::size_t>> seen;
  while (const auto bytes = stream.next(store))
    seen.emplace_back(decoded(*bytes).subscription, decoded(*bytes).columns.size());
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(seen, (std::vector<std::pair<std::uint32_t, std::size_t>>{{1, 1}, {2, 2}}));
}

TEST(StudioFrames, EachKindOfNumberHasItsType) {
  TraceStore store;
  store.set_signals(std::vector<TraceSignal>{{"r", Type::REAL, ""},
                                             {"d", Type::DINT, ""},
                                             {"u", Type::ULINT, ""},
                                             {"t", Type::TIME, ""},
                                             {"b", Type::BOOL, ""}});
  Value large{};
  large.u = std::numeric_limits<std::uint64_t>::max();
  const std::vector<Value> row = {real(0.5), integer(-3), large, integer(-1), integer(1)};
  for (std::uint64_t i = 0; i < 3; ++i) store.append(static_cast<std::int64_t>(i), i, row);
  const std::vector<std::size_t> all = {0, 1, 2, 3, 4};
  const DecodedFrame frame =
      decoded(encode_frame({StudioFrameKind::window, 0, 9, 4}, store.window(all, 0, 3, 10)));
  ASSERT_TRUE(frame.is_whole);
  EXPECT_EQ(frame.kind, 3);
  EXPECT_EQ(frame.frame, 9u);
  EXPECT_EQ(frame.dropped, 4u);
  std::vector<int> types;
  for (const DecodedFrame::Column& column : frame.columns) types.push_back(column.type);
  EXPECT_EQ(types, (std::vector<int>{0, 1, 2, 1, 3}));
  EXPECT_EQ(frame.columns[2].arrays[0][2], large.u) << "no bit is lost";
  EXPECT_EQ(static_cast<std::int64_t>(frame.columns[1].arrays[0][0]), -3);
}

}  // namespace
}  // namespace lockstep::studio_stream_test
