// Datagrams of an LCM network put together to messages, and those that lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hmi_bridge/lcm/reassembly.hpp"
#include "tests/support/datagrams.hpp"
#include "tests/support/property.hpp"

namespace lockstep::lcm_reassembly_test {
namespace {

using namespace std::chrono_literals;
using test::fragment_datagram;
using test::in_fragments;
using test::short_datagram;

constexpr std::uint64_t kSender = 5;

std::string random_text(std::mt19937& random, std::size_t size) {
  std::string text(size, '\0');
  for (char& c : text) c = static_cast<char>(random());
  return text;
}

/// "CHANNEL=DATA".
std::string text_of(const LcmMessage& message) {
  return std::string(message.channel) + "=" + std::string(message.data.begin(), message.data.end());
}

class Reassembly : public testing::Test {
 protected:
  /// The text of the message that the datagram is or completes, else empty.
  std::string give(const std::vector<std::uint8_t>& datagram, std::uint64_t sender = kSender) {
    const auto message = reassembly_.accept(datagram, sender, now_);
    return message ? text_of(*message) : "";
  }

  LcmReassembly reassembly_{{.message = 1000, .memory = 3000, .incomplete = 4, .timeout = 100ms}};
  LcmReassembly::Clock::time_point now_{1h};
};

TEST_F(Reassembly, AShortMessageIsWholeAtOnce) {
  EXPECT_EQ(give(short_datagram("KNIFE", "data")), "KNIFE=data");
  EXPECT_EQ(give(short_datagram(std::string(63, 'x'), "")), std::string(63, 'x') + "=");
  EXPECT_EQ(reassembly_.counters().messages, 2u);
}

TEST_F(Reassembly, WhatIsNoMessageIsCounted) {
  for (const std::vector<std::uint8_t>& datagram : {std::vector<std::uint8_t>{},
                                                    {'L', 'C', '0', '2'},
                                                    short_datagram("", "data"),
                                                    short_datagram(std::string(64, 'x'), "data"),
                                                    {'L', 'C', '0', '2', 0, 0, 0, 1, 'x'},
                                                    {'L', 'C', '0', '4', 0, 0, 0, 1, 'x', 0}})
    EXPECT_EQ(give(datagram), "");
  EXPECT_EQ(reassembly_.counters().malformed, 6u);
}

TEST_F(Reassembly, FragmentsInAnyOrderAndOfSeveralSendersMakeTheirMessages) {
  LcmReassembly reassembly({.message = 1000});
  std::mt19937 random(test::seed_of_test(20261123));
  struct Sent {
    std::uint64_t sender;
    std::vector<std::uint8_t> datagram;
  };
  for (int round = 0; round < 200; ++round) {
    std::vector<Sent> sent;
    std::vector<std::string> expected, got;
    for (std::uint64_t sender = 0; sender < 3; ++sender) {
      const std::string data = random_text(random, 1 + random() % 900);
      expected.push_back("C=" + data);
      for (const auto& datagram :
           in_fragments(static_cast<std::uint32_t>(round), "C", data, 1 + random() % 300))
        sent.push_back({sender, datagram});
    }
    std::shuffle(sent.begin(), sent.end(), random);
    for (const Sent& one : sent)
      if (const auto message = reassembly.accept(one.datagram, one.sender, now_))
        got.push_back(text_of(*message));
    std::sort(got.begin(), got.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(got, expected);
    ASSERT_EQ(reassembly.memory(), 0u);
  }
}

// The sum of the two has 33 bits: what wraps to a small number would be written before the message.
TEST_F(Reassembly, AnOffsetThatWrapsWithItsSizeIsRefused) {
  for (const std::uint32_t offset : {0xFFFFFFFFu, 0xFFFFFFF0u, 0x80000000u, 996u, 1000u})
    EXPECT_EQ(give(fragment_datagram({.size = 1000, .offset = offset, .number = 1, .count = 2}, "01234567")),
              "");
  EXPECT_EQ(reassembly_.counters().malformed, 5u);
  EXPECT_EQ(reassembly_.incomplete(), 0u);
}

TEST_F(Reassembly, FragmentsThatContradictEachOtherMakeNoMessage) {
  EXPECT_EQ(give(fragment_datagram({.size = 8, .number = 2, .count = 2}, "x")), "") << "number beyond count";
  EXPECT_EQ(give(fragment_datagram({.size = 8, .number = 0, .count = 0}, "x")), "") << "none at all";
  EXPECT_EQ(give(fragment_datagram({.size = 8, .number = 0, .count = 2}, "no channel")), "");
  EXPECT_EQ(give(fragment_datagram({.size = 8, .number = 1, .count = 2}, "")), "") << "nothing in it";
  EXPECT_EQ(give(fragment_datagram({.size = 0, .number = 0, .count = 1}, std::string("C\0", 2))), "");
  EXPECT_EQ(reassembly_.counters().malformed, 5u);
  const std::string first("C\0abcd", 6);
  EXPECT_EQ(give(fragment_datagram({.size = 8, .number = 0, .count = 2}, first)), "");
  EXPECT_EQ(give(fragment_datagram({.size = 9, .offset = 4, .number = 1, .count = 2}, "efghi")), "");
  EXPECT_EQ(give(fragment_datagram({.size = 8, .offset = 4, .number = 1, .count = 3}, "efgh")), "");
  EXPECT_EQ(give(fragment_datagram({.size = 8, .number = 0, .count = 2}, first)), "") << "twice";
  EXPECT_EQ(give(fragment_datagram({.size = 8, .offset = 4, .number = 1, .count = 2}, "efgh")), "C=abcdefgh");
  EXPECT_EQ(give(fragment_datagram({.sequence = 2, .size = 8, .number = 0, .count = 2}, first)), "");
  EXPECT_EQ(give(fragment_datagram({.sequence = 2, .size = 8, .offset = 2, .number = 1, .count = 2}, "ef")),
            "")
      << "they overlap and leave a gap";
  EXPECT_EQ(reassembly_.memory(), 0u);
}

TEST_F(Reassembly, WhatIsIncompleteIsBoundedInNumberSizeAndTime) {
  EXPECT_EQ(give(fragment_datagram({.size = 1001, .number = 1, .count = 2}, "x")), "");
  EXPECT_EQ(reassembly_.counters().refused, 1u);
  for (std::uint32_t sequence = 0; sequence < 1000; ++sequence) {
    give(fragment_datagram({.sequence = sequence, .size = 900, .number = 1, .count = 60000}, "x"), sequence);
    ASSERT_LE(reassembly_.memory(), 3000u);
    ASSERT_LE(reassembly_.incomplete(), 4u);
  }
  EXPECT_EQ(reassembly_.counters().given_up, 996u) << "the oldest give way";
  now_ += 101ms;
  EXPECT_EQ(give(short_datagram("C", "x")), "C=x");
  EXPECT_EQ(reassembly_.incomplete(), 0u);
  EXPECT_EQ(reassembly_.memory(), 0u);
}

TEST_F(Reassembly, ManySmallFragmentsCostNoMoreThanAllowed) {
  for (std::uint16_t number = 1; number < 900; ++number) {
    give(fragment_datagram({.size = 900, .offset = number, .number = number, .count = 900}, "x"));
    ASSERT_LE(reassembly_.memory(), 3000u);
  }
  EXPECT_GT(reassembly_.counters().refused, 0u) << "a message alone may be too much";
  const std::string data(900, 'd');
  std::string got;
  for (const auto& datagram : in_fragments(2, "C", data, 300)) got += give(datagram);
  EXPECT_EQ(got, "C=" + data) << "what is whole in time is not kept away by it";
}

// 8 MiB that a datagram of 21 bytes announces would be memory to clear for each of them.
TEST(ReassemblyOfAnything, TakesNoMemoryForWhatIsOnlyAnnounced) {
  LcmReassembly reassembly;
  const auto now = LcmReassembly::Clock::time_point{};
  for (std::uint32_t sequence = 0; sequence < 16; ++sequence)
    EXPECT_FALSE(reassembly.accept(
        fragment_datagram({.sequence = sequence, .size = 8u << 20, .number = 1, .count = 65535}, "x"),
        kSender, now));
  EXPECT_EQ(reassembly.incomplete(), 16u);
  EXPECT_LT(reassembly.memory(), 10'000u);
}

TEST(ReassemblyOfCommands, RefusesFragments) {
  LcmReassembly reassembly({.message = 0});
  const auto now = LcmReassembly::Clock::time_point{};
  for (const auto& datagram : in_fragments(1, "KNIFE_CMD", "a command", 4))
    EXPECT_FALSE(reassembly.accept(datagram, kSender, now));
  EXPECT_FALSE(reassembly.accept(
      fragment_datagram({.size = 0, .number = 0, .count = 1}, std::string("KNIFE_CMD\0", 10)), kSender, now));
  EXPECT_EQ(reassembly.counters().refused, 4u);
  EXPECT_EQ(reassembly.incomplete(), 0u);
  EXPECT_TRUE(reassembly.accept(short_datagram("KNIFE_CMD", "a command"), kSender, now));
}

}  // namespace
}  // namespace lockstep::lcm_reassembly_test
