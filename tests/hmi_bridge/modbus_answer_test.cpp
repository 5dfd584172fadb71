#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hmi_bridge/modbus/answer.hpp"

namespace lockstep::modbus_answer_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A request of each function that the client has, and the right answer to it.
struct Exchange {
  Bytes asked, got;
};
const std::vector<Exchange> kExchanges = {
    {{1, 1, 0, 7, 0, 10}, {1, 1, 2, 0xFF, 3}},
    {{1, 2, 0, 7, 0, 8}, {1, 2, 1, 0xFF}},
    {{9, 3, 0, 7, 0, 2}, {9, 3, 4, 1, 2, 3, 4}},
    {{9, 4, 0, 7, 0, 1}, {9, 4, 2, 1, 2}},
    {{1, 5, 0, 7, 0xFF, 0}, {1, 5, 0, 7, 0xFF, 0}},
    {{1, 6, 0, 7, 0x12, 0x34}, {1, 6, 0, 7, 0x12, 0x34}},
    {{1, 15, 0, 7, 0, 3, 1, 5}, {1, 15, 0, 7, 0, 3}},
    {{1, 16, 0, 7, 0, 2, 4, 1, 2, 3, 4}, {1, 16, 0, 7, 0, 2}},
    {{1, 22, 0, 7, 0xFF, 0xF0, 0, 5}, {1, 22, 0, 7, 0xFF, 0xF0, 0, 5}},
};

std::string flaw(const Bytes& asked, const Bytes& got) {
  const ModbusAnswer answer = judge_answer(asked, got);
  return answer.flaw == nullptr ? "" : answer.flaw;
}

TEST(ModbusAnswer, IsGoodAsTheStandardHasItForEachFunction) {
  for (const Exchange& one : kExchanges) {
    EXPECT_EQ(flaw(one.asked, one.got), "") << "function " << int{one.asked[1]};
    EXPECT_EQ(judge_answer(one.asked, one.got).exception, 0);
  }
}

TEST(ModbusAnswer, HasAFlawIfAnyByteOfTheHeadOrOfAnEchoIsWrong) {
  for (const Exchange& one : kExchanges) {
    const std::size_t head = one.asked[1] <= 4 ? 3 : one.got.size();
    for (std::size_t place = 0; place < head; ++place)
      for (const int bit : {1, 4, 128}) {
        Bytes got = one.got;
        got[place] = static_cast<std::uint8_t>(got[place] ^ bit);
        EXPECT_NE(flaw(one.asked, got), "") << "function " << int{one.asked[1]} << ", byte " << place;
      }
  }
}

TEST(ModbusAnswer, HasAFlawIfItIsShorterOrLonger) {
  for (const Exchange& one : kExchanges) {
    Bytes got = one.got;
    got.push_back(0);
    EXPECT_NE(flaw(one.asked, got), "") << "function " << int{one.asked[1]};
    for (got.pop_back(); !got.empty();) {
      got.pop_back();
      EXPECT_NE(flaw(one.asked, got), "") << got.size() << " bytes of function " << int{one.asked[1]};
    }
  }
}

TEST(ModbusAnswer, MayBeAnExceptionOfThatUnitAndFunctionWithAKnownCode) {
  for (const Exchange& one : kExchanges) {
    const auto refusal = static_cast<std::uint8_t>(one.asked[1] | 0x80);
    EXPECT_EQ(judge_answer(one.asked, Bytes{one.asked[0], refusal, 2}).exception, 2);
    EXPECT_EQ(flaw(one.asked, {one.asked[0], refusal, 11}), "");
    for (const Bytes& bad : {Bytes{one.asked[0], refusal, 0}, Bytes{one.asked[0], refusal, 12},
                             Bytes{one.asked[0], refusal, 2, 0}, Bytes{77, refusal, 2},
                             Bytes{one.asked[0], static_cast<std::uint8_t>(refusal ^ 1), 2}}) {
      EXPECT_NE(flaw(one.asked, bad), "");
      EXPECT_EQ(judge_answer(one.asked, bad).exception, 0);
    }
  }
}

}  // namespace
}  // namespace lockstep::modbus_answer_test
