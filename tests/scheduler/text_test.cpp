#include "scheduler/text.hpp"

#include <gtest/gtest.h>

#include <string>

#include "scheduler/expression.hpp"

namespace lockstep::text_test {
namespace {

TEST(Text, EndsAtTheFirstZeroOrWithItsRoom) {
  std::string memory("ale\0rest", 8);
  const Text text{memory.data(), memory.size()};
  EXPECT_EQ(text.view(), "ale");
  memory[3] = '!';
  EXPECT_EQ(text.view(), "ale!rest");
}

TEST(Text, IsReplacedWhole) {
  std::string memory(7, 'x');  // the last one is not its own
  const Text text{memory.data(), 6};
  text.assign("stout");
  EXPECT_EQ(memory, std::string("stout\0x", 7));
  text.assign("ale");
  EXPECT_EQ(memory, std::string("ale\0\0\0x", 7));
  text.assign("wheat beer");
  EXPECT_EQ(memory, "wheat x");
  text.assign(text.view().substr(2));
  EXPECT_EQ(text.view(), "eat ");
  text.assign("");
  EXPECT_EQ(text.view(), "");
}

TEST(Text, IsTheSameWhateverStandsBehindItsEnd) {
  std::string memory("ale\0stout", 9);
  std::string other("ale\0\0", 5);
  const Text left{memory.data(), memory.size()};
  const Text right{other.data(), other.size()};
  const auto holds = [](const TextSource& a, const TextSource& b, bool is_equality) {
    EvaluationCounters counters;
    return TextComparison{a, b, is_equality}.holds(counters);
  };
  EXPECT_TRUE(holds({left, {}}, {right, {}}, true));
  EXPECT_FALSE(holds({left, {}}, {right, {}}, false));
  EXPECT_TRUE(holds({left, {}}, {std::nullopt, "ale"}, true));
  EXPECT_FALSE(holds({left, {}}, {std::nullopt, "Ale"}, true));
  EXPECT_TRUE(holds({left, {}}, {std::nullopt, "ale "}, false));
}

TEST(Text, GoesThroughItsSignalsInAnyRoom) {
  for (std::size_t capacity = 1; capacity <= kLongestText; ++capacity)
    for (const std::size_t size : {std::size_t{0}, capacity / 2, capacity}) {
      std::string text;
      for (std::size_t i = 0; i < size; ++i) text += static_cast<char>(1 + (7 * i + capacity) % 255);
      const std::vector<Value> values = text_values(text, capacity);
      ASSERT_EQ(values.size(), (capacity + 1) / 2);
      ASSERT_EQ(text_of(values, capacity), text) << capacity;
      std::string memory(capacity + 1, '#');
      const std::vector<Signal> signals = text_signals({memory.data(), capacity});
      for (std::size_t i = 0; i < signals.size(); ++i) signals[i].store(values[i]);
      ASSERT_EQ(Text({memory.data(), capacity}).view(), text);
      ASSERT_EQ(memory.back(), '#') << "nothing behind the room is touched";
    }
  EXPECT_EQ(text_values("ab", 3)[0].u, 0x6261u) << "the first one in the low byte";
}

}  // namespace
}  // namespace lockstep::text_test
