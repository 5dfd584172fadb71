// A damaged image is refused before it runs.
#include "scheduler/aposs/image.hpp"

#include <gtest/gtest.h>

#include <random>

#include "scheduler/aposs/machine.hpp"
#include "scheduler/aposs/plain_device.hpp"

namespace lockstep::aposs::image_test {
namespace {

// a = 3; again: a = a - 1; LOAD; PRINT; OUT; loop.
Image good() {
  Image image;
  image.variables = {"a"};
  image.temporaries = 1;
  image.constants = {3, 1, 1};
  image.arrays = {{"list", 4}};
  image.texts = {"text"};
  image.prints = {{{{PrintItem::Kind::kText, 0}, {PrintItem::Kind::kNumber, 0}}, true}};
  const auto out = static_cast<std::uint16_t>(Command::kOut);
  image.code = {{Operation::kMove, 0, 2, 0},
                {Operation::kSubtract, 0, 0, 3},
                {Operation::kLoadElement, 1, 0, 0},
                {Operation::kPrint, 0, 0, 0},
                {Operation::kCommand, out, 3, kNoCell},
                {Operation::kJumpIfZero, 7, 0, 0},
                {Operation::kJump, 1, 0, 0},
                {Operation::kEnd, 0, 0, 0}};
  image.places.assign(image.code.size(), Place{0, 1, 1});
  return image;
}

TEST(AposImage, IsTakenAsTheCompilerMakesIt) {
  EXPECT_EQ(good().fault(), 0);
}

TEST(AposImage, OfAnotherVersionIsError196) {
  Image image = good();
  image.version = 2;
  EXPECT_EQ(image.fault(), 196);
}

TEST(AposImage, ThatIsDamagedIsError110) {
  const auto changed = [](auto change) {
    Image image = good();
    change(image);
    return image.fault();
  };
  EXPECT_EQ(changed([](Image& image) { image.code.clear(); }), 110);
  EXPECT_EQ(changed([](Image& image) { image.code.pop_back(); }), 110);  // no place fits any more
  EXPECT_EQ(changed([](Image& image) { image.code.back().operation = Operation::kMove; }), 110);
  EXPECT_EQ(changed([](Image& image) { image.code[0].operation = static_cast<Operation>(999); }), 110);
  EXPECT_EQ(changed([](Image& image) { image.code[0].a = 2; }), 110);  // a constant is not written
  EXPECT_EQ(changed([](Image& image) { image.code[0].b = 5; }), 110);
  EXPECT_EQ(changed([](Image& image) { image.code[2].b = 1; }), 110);  // there is one array
  EXPECT_EQ(changed([](Image& image) { image.code[4].a = 999; }), 110);
  EXPECT_EQ(changed([](Image& image) { image.code[4].b = 4; }), 110);  // two arguments, one cell
  EXPECT_EQ(changed([](Image& image) { image.code[6].a = 8; }), 110);
  EXPECT_EQ(changed([](Image& image) { image.code[3].a = 1; }), 110);
  EXPECT_EQ(changed([](Image& image) { image.prints[0].items[0].text = 1; }), 110);
}

// Whatever the bytes of the code are: refused, or run within its memory and its budget.
TEST(AposImage, OfRandomInstructionsNeverLeavesItsMemory) {
  std::mt19937 random(7);
  int taken = 0;
  for (int round = 0; round < 20000; ++round) {
    Image image = good();
    for (int change = 0; change < 3; ++change) {
      Instruction& at = image.code[random() % (image.code.size() - 1)];
      const auto value = static_cast<std::uint16_t>(random() % 9);
      switch (random() % 4) {
        case 0:
          at.operation = static_cast<Operation>(random() % (operation_count() + 2));
          break;
        case 1:
          at.a = value;
          break;
        case 2:
          at.b = value;
          break;
        default:
          at.c = value;
      }
    }
    PlainDevice device;
    Arrays arrays;
    Machine machine(device, arrays);
    if (machine.load(image) != 0) continue;
    ++taken;
    for (int step = 0; step < 20; ++step) {
      const std::uint64_t before = machine.counters().commands;
      machine.step(10);
      ASSERT_LE(machine.counters().commands - before, 10u);
      device.advance(1);
    }
  }
  EXPECT_GT(taken, 1000);
}

}  // namespace
}  // namespace lockstep::aposs::image_test
