// The zero pulses of a master encoder: that bounds between which there is none are known lets none go by.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tech_objects/mco305/master_input.hpp"
#include "tests/support/property.hpp"

namespace lockstep::mco305::master_input_test {
namespace {

class Master {
 public:
  explicit Master(std::int32_t resolution) {
    EXPECT_EQ(parameters_.set(kMasterEncoder, resolution), 0);
    input_.configure(true, {});
    input_.power_up(parameters_);
    refresh();
  }
  void set_resolution(std::int32_t resolution) {
    EXPECT_EQ(parameters_.set(kMasterEncoder, resolution), 0);
    refresh();
  }
  /// The encoder is at 0, the counter somewhere.
  void begin(std::int64_t counter) {
    turn(0.0);
    std::int64_t origin = 0;
    input_.exchange(counter, origin);
  }
  /// Forgets the bounds: the next tick looks for pulses.
  void refresh() { input_.refresh(parameters_, true); }
  /// One tick and one step. @return the pulses of that step
  std::vector<double> turn(double encoder) {
    input_.turn(encoder);
    input_.step();
    std::vector<double> marks;
    for (std::size_t i = 0; i < input().mark_count(); ++i) marks.push_back(input().mark(i));
    return marks;
  }
  const MasterInput& input() const { return input_; }

 private:
  ParameterValues parameters_;
  MasterInput input_;
};

// 1000 pulses are 4000 counts of a turn.
TEST(MasterInput, HasAPulseAtTheEndOfATurnAndBehindIt) {
  Master master(1000);
  master.turn(0.0);
  EXPECT_EQ(master.turn(3000.0), std::vector<double>{});
  EXPECT_EQ(master.turn(3999.25), std::vector<double>{});
  EXPECT_EQ(master.turn(4000.0), std::vector<double>{4000.0});
  EXPECT_EQ(master.turn(4000.5), std::vector<double>{});
  EXPECT_EQ(master.turn(4000.0), std::vector<double>{4000.0}) << "on the way back";
  EXPECT_EQ(master.turn(3999.5), std::vector<double>{});
  EXPECT_EQ(master.turn(100.0), std::vector<double>{});
  EXPECT_EQ(master.turn(-0.5), std::vector<double>{0.0});
}

TEST(MasterInput, HasThePulsesOfAnotherResolutionAtOnce) {
  Master master(1000);
  master.turn(0.0);
  master.turn(100.0);
  EXPECT_EQ(master.turn(200.0), std::vector<double>{});
  master.set_resolution(100);
  EXPECT_EQ(master.turn(500.0), std::vector<double>{400.0});
}

TEST(MasterInput, HasThePulsesThatItHasWithoutBoundsWhereverItIs) {
  test::for_each_seed(1, test::cases(300, 30'000), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    const auto below = [&random](std::size_t end) {
      return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
    };
    const auto either = [&random] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
    const std::int32_t resolution = std::array{1, 3, 250, 1000, 1024, 500'000'000}[below(6)];
    const double turn = 4.0 * resolution;
    // From where a double has parts of a count to where it has none, or not even each count.
    const double far = std::ldexp(either(), static_cast<int>(below(60)));
    const auto counter = static_cast<std::int64_t>(std::floor(far / turn) * turn);
    double place = 0.0;
    Master with(resolution), without(resolution);
    with.begin(counter);
    without.begin(counter);
    for (int i = 0; i < 300; ++i) {
      place += either() * (below(3) == 0 ? turn : std::min(turn, 3.0));
      if (below(4) == 0) place = std::round(place);
      without.refresh();
      ASSERT_EQ(with.turn(place), without.turn(place)) << resolution << ", step " << i << ", at " << place;
      ASSERT_EQ(with.input().latches(), without.input().latches());
    }
  });
}

}  // namespace
}  // namespace lockstep::mco305::master_input_test
