// What holds of synchronizing whatever is asked for, over seeds in a row: continuity in every change of mode,
// limits, band and reversal, the exact gear, and markers whose mean is met although they lie anywhere.
#include <algorithm>
#include <cmath>
#include <random>

#include "tech_objects/mco305/device.hpp"
#include "tests/support/property.hpp"

namespace lockstep::synchronizing_property_test {
namespace {

constexpr int kUsualCases = 10'000, kSoakCases = 1'000'000;

using mco305::Device;
using Random = std::mt19937_64;

int below(Random& random, int n) {
  return static_cast<int>(random() % static_cast<unsigned>(n));
}
int between(Random& random, int low, int high) {
  return low + below(random, high - low + 1);
}

/// 100 qc/ms at VEL 100, 0.2 qc/ms² at ACC 100; ahead of its master by no step.
void prepare(Device& device, const mco305::DeviceSettings& settings = {}) {
  for (const auto& [number, value] : {std::pair{mco305::kEncoder, 500},
                                      {mco305::kMasterEncoder, 500},
                                      {mco305::kVelMax, 3000},
                                      {mco305::kRampMin, 500},
                                      {mco305::kSyncType, 1}})
    ASSERT_EQ(device.set_parameter(number, value), 0);
  mco305::DeviceSettings with_master = settings;
  with_master.has_master = true;
  device.configure(with_master, 1e-3);
}

/// What turns the master: velocities that change, whole counts or parts of them.
class Master {
 public:
  explicit Master(Random& random) : random_(random) {}
  void step(Device& device) {
    if (below(random_, 60) == 0) velocity_ = between(random_, -900, 900) / 10.0;
    place_ += velocity_;
    device.master().turn(place_);
  }

 private:
  Random& random_;
  double velocity_ = 0.0, place_ = 0.0;
};

void set_any(Device& device, Random& random) {
  const auto set = [&](std::int32_t number, std::int32_t value) { device.set_parameter(number, value); };
  switch (below(random, 9)) {
    case 0:
      set(mco305::kSyncFactM, below(random, 2) == 0 ? between(random, 1, 50) : -between(random, 1, 50));
      return set(mco305::kSyncFactS, between(random, 0, 50));
    case 1:
      return set(mco305::kSyncPosOffs, between(random, -5000, 5000));
    case 2:
      return set(mco305::kSyncOffTime, below(random, 2) * between(random, 1, 2000));
    case 3:
      return set(mco305::kSyncVelRel, below(random, 2) * between(random, 1, 50));
    case 4:
      return set(mco305::kRevers, below(random, 3));
    case 5:
      return set(mco305::kSyncVfTime, between(random, -50'000, 50'000));
    case 6:
      return set(mco305::kSyncMfTime, below(random, 2) * between(random, 1, 2000));
    case 7: {
      const int start = below(random, 8);
      return set(mco305::kSyncMStart, start + 1000 * below(random, 2));
    }
    default:
      return set(mco305::kSyncType, below(random, 2));
  }
}

void change_mode(Device& device, Random& random) {
  switch (below(random, 8)) {
    case 0:
      device.follow(mco305::SyncMode::kVelocity);
      break;
    case 1:
    case 2:
      device.follow(mco305::SyncMode::kPosition);
      break;
    case 3:
    case 4:
      device.follow(mco305::SyncMode::kMarkers);
      break;
    case 5:
      device.position_to(between(random, -20'000, 20'000), below(random, 2) == 0);
      break;
    case 6:
      device.set_speed(between(random, -100, 100));
      device.start_speed();
      break;
    default:
      device.motor_stop();
  }
}

/// Of a step: the set position goes by what its velocity says, and that keeps the limits.
struct Watched {
  double position = 0.0, velocity = 0.0;

  testing::AssertionResult look(const Device& device, double velocity_limit, double steepest) {
    const double now = device.set_velocity_now(), place = device.set_position();
    const double change = std::abs(now - velocity), limit = std::max(velocity_limit, std::abs(velocity));
    const double apart = std::abs(place - position - (now + velocity) / 2.0);
    position = place;
    velocity = now;
    constexpr double kRounding = 1.0 + 1e-9;
    if (!std::isfinite(place) || !std::isfinite(now)) return testing::AssertionFailure() << "not finite";
    if (change > steepest * kRounding) return testing::AssertionFailure() << "velocity steps by " << change;
    if (std::abs(now) > limit * kRounding) return testing::AssertionFailure() << "velocity is " << now;
    if (apart > steepest) return testing::AssertionFailure() << "position steps by " << apart;
    return testing::AssertionSuccess();
  }
};

TEST(Mco305SynchronizingProperties, TheSetPositionIsContinuousInEveryChangeOfMode) {
  test::for_each_seed(1, test::cases(kUsualCases, kSoakCases), [](const test::Case& one) {
    Random random(one.seed);
    mco305::DeviceSettings settings;
    settings.markers = {.period = between(random, 300, 1500) * 1.0, .noise = below(random, 40) * 1.0};
    settings.master_marks = {.period = between(random, 300, 1500) * 1.0, .noise = below(random, 40) * 1.0};
    Device device;
    prepare(device, settings);
    for (const std::int32_t number : {mco305::kMarkerTypeMaster, mco305::kMarkerTypeSlave})
      device.set_parameter(number, 2);
    device.set_parameter(mco305::kSyncMPulsM, static_cast<std::int32_t>(settings.master_marks.period));
    device.set_parameter(mco305::kSyncMPulsS, static_cast<std::int32_t>(settings.markers.period));
    const int velocity = between(random, 10, 100), acceleration = between(random, 5, 100),
              deceleration = between(random, 5, 100);
    device.set_velocity(velocity);
    device.set_acceleration(acceleration);
    device.set_deceleration(deceleration);
    const double change = std::max(acceleration, deceleration) * 0.2 / 100.0;
    Master master(random);
    Watched watched;
    for (int i = 0; i < 150; ++i) {
      if (below(random, 25) == 0) change_mode(device, random);
      if (below(random, 20) == 0) set_any(device, random);
      master.step(device);
      device.servo(true);
      device.clear_all_errors();
      // On a counted target it takes each count as it comes, to either side of a velocity that keeps the
      // limits.
      const double counts = device.following() ? 2.0 * (change + 1.0) : 0.0;
      // CVEL has a velocity of its own.
      const double limit = device.mode() == mco305::MotionMode::kSpeed ? 100.0 : velocity;
      const testing::AssertionResult good = watched.look(device, limit, change + counts);
      EXPECT_TRUE(good) << "in step " << i;
      if (!good) return;
    }
  });
}

// With a master of whole counts in a step nothing but band and reversal bounds the way into an offset.
TEST(Mco305SynchronizingProperties, BandAndReversalAreKept) {
  test::for_each_seed(1, test::cases(kUsualCases / 10, kSoakCases / 10), [](const test::Case& one) {
    Random random(one.seed);
    Device device;
    prepare(device);
    const int band = between(random, 1, 60), reversal = below(random, 3);
    const int speed = between(random, 2, 40) * (below(random, 2) == 0 ? 1 : -1);
    const bool blocked = reversal == 2 && speed < 0;
    device.set_parameter(mco305::kSyncVelRel, band);
    device.set_parameter(mco305::kRevers, reversal);
    device.set_velocity(100);
    device.set_acceleration(100);
    device.set_deceleration(100);
    device.follow(mco305::SyncMode::kPosition);
    double place = 0.0;
    const double share = std::abs(speed) * band / 100.0;
    const auto is_kept = [&](double v, bool reached) {
      if (reversal == 2 && v < 0.0) return false;
      return !reached || (blocked ? v == 0.0 : std::abs(v - speed) <= share * (1.0 + 1e-9));
    };
    for (int i = 0; i < 900; ++i) {
      if (i == 600) device.set_parameter(mco305::kSyncPosOffs, between(random, -3000, 3000));
      device.master().turn(place += speed);
      device.servo(true);
      const double v = device.set_velocity_now();
      EXPECT_TRUE(is_kept(v, i > 500)) << v << " of " << speed << " in step " << i;
      if (!is_kept(v, i > 500)) return;
    }
  });
}

// Of any ratio and any motion the gear is where it has to be, to the last part of a count.
TEST(Mco305SynchronizingProperties, TheErrorOfTheGearIsZeroAfterABillionCounts) {
  test::for_each_seed(1, test::cases(kUsualCases, kSoakCases), [](const test::Case& one) {
    Random random(one.seed);
    const std::int64_t leading = 1 + static_cast<std::int64_t>(random() % 2'000'000'000ULL);
    const std::int64_t following = static_cast<std::int64_t>(random() % 4'000'000'000ULL) - 2'000'000'000;
    const bool turned = below(random, 2) == 0;
    CountGear gear;
    gear.set(turned ? -leading : leading, turned ? -following : following);
    gear.begin(0.0);
    std::int64_t moved = 0, distance = 0;
    while (distance < 1'000'000'000) {
      const std::int64_t counts = static_cast<std::int64_t>(random() % 60'000'000) - 20'000'000;
      gear.move(counts);
      moved += counts;
      distance += std::abs(counts);
    }
    __extension__ using Wide = __int128;
    const Wide product = Wide{moved} * following;
    Wide whole = product / leading;
    if (product - whole * leading < 0) --whole;
    ASSERT_EQ(gear.whole(), static_cast<std::int64_t>(whole));
    ASSERT_EQ(gear.fraction(), static_cast<double>(static_cast<std::int64_t>(product - whole * leading)) /
                                   static_cast<double>(leading));
  });
}

// A device that has followed for a billion counts is where the ratio says, and its set position with it.
TEST(Mco305SynchronizingProperties, ADeviceIsWhereItsGearIsAfterABillionCounts) {
  test::for_each_seed(1, test::cases(3, 30), [](const test::Case& one) {
    Random random(one.seed);
    Device device;
    prepare(device);
    const int leading = between(random, 20'000, 90'000), following = between(random, 1, 97);
    device.set_parameter(mco305::kSyncFactM, leading);
    device.set_parameter(mco305::kSyncFactS, following);
    device.set_velocity(100);
    device.master().turn(0.0);
    device.servo(true);
    device.follow(mco305::SyncMode::kPosition);
    double place = 0.0;
    constexpr int kFast = 5000;  // counts in a step
    for (int i = 0; i < 200'000; ++i) device.master().turn(place += kFast), device.servo(true);
    for (int i = 0; i < 2000; ++i) device.master().turn(place), device.servo(true);
    const auto counts = static_cast<std::int64_t>(place);
    const double belongs = static_cast<double>(counts * following / leading) +
                           static_cast<double>(counts * following % leading) / leading;
    ASSERT_NEAR(device.set_position(), belongs, 1e-9);
    ASSERT_EQ(device.sync_error(), 0);
  });
}

/// Markers to either side that lie anywhere within their noise, some missing, some more than there are.
struct Stream {
  double noise, mean = 0.0;
  int pairs = 0;
};

Stream mean_of(std::uint64_t seed) {
  Random random(seed);
  bool missing_master = false, missing_slave = false, spurious = false, twice = false;
  constexpr double kPeriod = 400.0;
  mco305::DeviceSettings settings;
  Stream result{.noise = between(random, 5, 25) * 1.0};
  settings.master_marks = {.period = kPeriod,
                           .noise = result.noise,
                           .seed = between(random, 1, 1'000'000),
                           .missing = &missing_master,
                           .spurious = &spurious,
                           .twice = &twice};
  settings.markers = {.period = kPeriod,
                      .noise = result.noise,
                      .seed = between(random, 1, 1'000'000),
                      .missing = &missing_slave,
                      .spurious = &spurious,
                      .twice = &twice};
  Device device;
  prepare(device, settings);
  for (const auto& [number, value] : {std::pair{mco305::kMarkerTypeMaster, 2},
                                      {mco305::kMarkerTypeSlave, 2},
                                      {mco305::kSyncMPulsM, 400},
                                      {mco305::kSyncMPulsS, 400},
                                      {mco305::kSyncMWinM, 60},
                                      {mco305::kSyncMWinS, 60},
                                      {mco305::kSyncMStart, 5}})
    device.set_parameter(number, value);
  device.set_velocity(100);
  device.set_acceleration(100);
  device.set_deceleration(100);
  double place = 0.0;
  const double speed = between(random, 80, 200) / 10.0;
  device.follow(mco305::SyncMode::kMarkers);
  std::uint32_t seen = 0;
  for (int i = 0; i < 2500; ++i) {
    device.master().turn(place += speed);
    device.servo(true);
    if (i > 500 && below(random, 100) == 0) missing_master = below(random, 8) == 0;
    if (i > 500 && below(random, 100) == 0) missing_slave = below(random, 8) == 0;
    if (i > 500 && below(random, 200) == 0) spurious = below(random, 2) == 0;
    if (i > 500 && below(random, 200) == 0) twice = below(random, 2) == 0;
    EXPECT_TRUE(std::isfinite(device.set_position()));
    if (i < 600 || device.latches() == seen) continue;
    seen = device.latches();
    // Where it goes is a whole number of markers beside its master, and what noise does to the last pair.
    const double apart = device.set_position() - static_cast<double>(device.master().position());
    result.mean += apart - kPeriod * std::round(apart / kPeriod);
    ++result.pairs;
  }
  result.mean /= std::max(result.pairs, 1);
  return result;
}

TEST(Mco305SynchronizingProperties, TheMeanOfMarkersIsMetUnderNoiseLossesAndDoubles) {
  double sum = 0.0, squares = 0.0;
  const test::Cases ran =
      test::for_each_seed(1, test::cases(kUsualCases / 10, kSoakCases), [&](const test::Case& one) {
        const Stream stream = mean_of(one.seed);
        ASSERT_GT(stream.pairs, 20);
        ASSERT_LE(std::abs(stream.mean), stream.noise) << "of one stream";
        sum += stream.mean / stream.noise;
        squares += stream.mean * stream.mean / (stream.noise * stream.noise);
      });
  if (ran.alone) return;
  const double mean = sum / ran.count, deviation = std::sqrt(squares / ran.count);
  std::printf("mean deviation %.5f of the noise, of one stream %.4f\n", mean, deviation);
  constexpr double kHalfACount = 0.5 / 5.0;  // of the smallest noise
  EXPECT_LE(std::abs(mean), 5.0 * deviation / std::sqrt(ran.count) + kHalfACount) << "of all streams";
}

}  // namespace
}  // namespace lockstep::synchronizing_property_test
