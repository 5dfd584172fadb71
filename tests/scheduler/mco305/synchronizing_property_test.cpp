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

// With a drive it is the machine that must not be thrown: in SYNCV the set position is where the axis is.
void throw_no_machine(std::uint64_t seed) {
  Random random(seed);
  mco305::DeviceSettings settings;
  settings.has_drive = true;
  settings.drive.time_constant = 0.003;
  settings.markers = {.period = between(random, 300, 1500) * 1.0, .noise = below(random, 40) * 1.0};
  settings.master_marks = settings.markers;
  Device device;
  prepare(device, settings);
  for (const auto& [number, value] : {std::pair{mco305::kFFVel, 10'486},
                                      {mco305::kMarkerTypeMaster, 2},
                                      {mco305::kMarkerTypeSlave, 2},
                                      {mco305::kSyncMPulsM, static_cast<int>(settings.markers.period)},
                                      {mco305::kSyncMPulsS, static_cast<int>(settings.markers.period)}})
    ASSERT_EQ(device.set_parameter(number, value), 0);
  const int acceleration = between(random, 5, 100);
  device.set_acceleration(acceleration);
  device.set_deceleration(acceleration);
  const double change = acceleration * 0.2 / 100.0;
  // Single counts of the target, and what the following error has asked of the controller.
  const double steepest = change + 2.0 * (change + 1.0) + 1.0;
  Master master(random);
  double place = device.machine_position(), velocity = 0.0;
  for (int i = 0; i < 600; ++i) {
    if (below(random, 60) == 0) change_mode(device, random);
    if (below(random, 60) == 0) set_any(device, random);
    master.step(device);
    device.servo(true);
    const double now = device.machine_position() - place;
    ASSERT_LE(std::abs(now - velocity), steepest) << "in step " << i;
    // At 100 qc/ms a drive of 3 ms is 300 qc behind.
    ASSERT_LE(std::abs(device.set_position() - static_cast<double>(device.actual_position())), 500.0)
        << "in step " << i;
    velocity = now;
    place += now;
  }
}

TEST(Mco305SynchronizingProperties, AMachineIsThrownByNoChangeOfMode) {
  constexpr int kTenth = 10;
  test::for_each_seed(1, test::cases(kUsualCases / kTenth, kSoakCases / kTenth),
                      [](const test::Case& one) { throw_no_machine(one.seed); });
}

// With a master of whole counts in a step nothing but band and reversal bounds the way into an offset.
void keep_band_and_reversal(std::uint64_t seed) {
  Random random(seed);
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
}

TEST(Mco305SynchronizingProperties, BandAndReversalAreKept) {
  test::for_each_seed(1, test::cases(kUsualCases / 10, kSoakCases / 10),
                      [](const test::Case& one) { keep_band_and_reversal(one.seed); });
}

// With these an offset of a single count, and the last part of a longer one, was made up for in one step.
TEST(Mco305SynchronizingProperties, ASingleCountIsMadeUpForWithinTheBand) {
  for (const std::uint64_t seed : {2911U, 24'855U, 28'184U, 49'331U, 74'729U}) {
    SCOPED_TRACE("follow it with LOCKSTEP_SEED=" + std::to_string(seed));
    keep_band_and_reversal(seed);
  }
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
class Markers {
 public:
  static constexpr double kPeriod = 400.0, kBehind = 40.0;  // a double is a tenth of the period behind

  /// @param parts whether a marker may be lost whose double is seen
  Markers(Random& random, bool parts) : random_(random), parts_(parts), noise_(between(random, 5, 25) * 1.0) {
    settings_.master_marks = marks(missing_master_);
    settings_.markers = marks(missing_slave_);
  }
  Markers(const Markers&) = delete;  // its switches are looked at where they are
  Markers& operator=(const Markers&) = delete;
  const mco305::DeviceSettings& settings() const { return settings_; }
  double noise() const { return noise_; }
  void change(double master, double slave) {
    if (below(random_, 100) == 0 && may_change(master)) missing_master_ = below(random_, 8) == 0;
    if (below(random_, 100) == 0 && may_change(slave)) missing_slave_ = below(random_, 8) == 0;
    if (below(random_, 200) == 0) spurious_ = below(random_, 2) == 0;
    if (below(random_, 200) == 0) twice_ = below(random_, 2) == 0;
  }

 private:
  mco305::MarkerTrackSettings marks(const bool& missing) {
    return {.period = kPeriod,
            .noise = noise_,
            .seed = between(random_, 1, 1'000'000),
            .missing = &missing,
            .spurious = &spurious_,
            .twice = &twice_};
  }
  /// Markers lie up to 25 counts beside a multiple of the period, their doubles 40 behind them.
  bool may_change(double place) const {
    constexpr double kFirst = 80.0, kLast = 360.0;
    const double phase = place - kPeriod * std::floor(place / kPeriod);
    return parts_ || (phase > kFirst && phase < kLast);
  }

  Random& random_;
  bool parts_, missing_master_ = false, missing_slave_ = false, spurious_ = false, twice_ = false;
  double noise_;
  mco305::DeviceSettings settings_;
};

/// Each pair once: of both sides one has counted, and none has been missed since.
class Pairs {
 public:
  /// One step. @param apart where it goes, beside its master  @return whether a pair ended with this step
  void look(std::int32_t status, double apart) {
    const bool master = (status & mco305::kMasterHit) != 0, slave = (status & mco305::kSlaveHit) != 0;
    if ((master || slave) && master_ && slave_) {
      sum_ += last_;
      ++count_;
      master_ = slave_ = false;
    }
    if ((status & (mco305::kMasterMissed | mco305::kSlaveMissed)) != 0) master_ = slave_ = false;
    master_ = master_ || master;
    slave_ = slave_ || slave;
    last_ = apart;
  }
  int count() const { return count_; }
  double mean() const { return sum_ / std::max(count_, 1); }

 private:
  bool master_ = false, slave_ = false;
  double last_ = 0.0, sum_ = 0.0;
  int count_ = 0;
};

struct Stream {
  double noise = 0.0, mean = 0.0, farthest = 0.0;
  int pairs = 0;
};

Stream stream_of(std::uint64_t seed, bool parts) {
  Random random(seed);
  Markers markers(random, parts);
  Device device;
  prepare(device, markers.settings());
  for (const auto& [number, value] : {std::pair{mco305::kMarkerTypeMaster, 2},
                                      {mco305::kMarkerTypeSlave, 2},
                                      {mco305::kSyncMPulsM, 400},
                                      {mco305::kSyncMPulsS, 400},
                                      {mco305::kSyncMWinM, 60},
                                      {mco305::kSyncMWinS, 60},
                                      {mco305::kSyncAccuracy, -1000},  // SYNCERR has a sign
                                      {mco305::kSyncMStart, 5}})
    device.set_parameter(number, value);
  device.set_velocity(100);
  device.set_acceleration(100);
  device.set_deceleration(100);
  double place = 0.0;
  const double speed = between(random, 80, 200) / 10.0;
  device.follow(mco305::SyncMode::kMarkers);
  Stream result{.noise = markers.noise()};
  Pairs pairs;
  for (int i = 0; i < 2500; ++i) {
    device.master().turn(place += speed);
    device.servo(true);
    const std::int32_t status = device.sync_status();
    device.clear_sync_status(status);
    if (i > 500) markers.change(place, device.set_position());
    EXPECT_TRUE(std::isfinite(device.set_position()));
    if (i < 400) continue;
    // Where it goes is a whole number of markers beside its master, and what noise does to the last pair.
    const auto beside = [&](double position) {
      const double apart = position - static_cast<double>(device.master().position());
      return apart - Markers::kPeriod * std::round(apart / Markers::kPeriod);
    };
    const double goes = beside(std::round(device.set_position()) + device.sync_error());
    pairs.look(status, goes);
    result.farthest = std::max(result.farthest, std::abs(goes));
  }
  result.mean = pairs.mean();
  result.pairs = pairs.count();
  return result;
}

// A pair is apart by the noise of its two markers: uniform over ±noise each, so with a deviation of noise *
// √(2/3), and independent of all other pairs. Six times that of their mean comes by chance twice in 10⁹
// streams; that places of markers are whole counts adds one at the most.
testing::AssertionResult has_its_mean(const Stream& stream) {
  if (stream.pairs == 0) return testing::AssertionFailure() << "no pair";
  const double allowed = 6.0 * stream.noise * std::sqrt(2.0 / 3.0 / stream.pairs) + 1.0;
  if (std::abs(stream.mean) <= allowed) return testing::AssertionSuccess();
  return testing::AssertionFailure() << stream.mean << " of " << allowed << " in " << stream.pairs
                                     << " pairs";
}

TEST(Mco305SynchronizingProperties, TheMeanOfMarkersIsMetUnderNoiseLossesAndDoubles) {
  double sum = 0.0, squares = 0.0;
  const test::Cases ran =
      test::for_each_seed(1, test::cases(kUsualCases / 10, kSoakCases), [&](const test::Case& one) {
        const Stream stream = stream_of(one.seed, false);
        ASSERT_TRUE(has_its_mean(stream));
        sum += stream.mean / stream.noise;
        squares += stream.mean * stream.mean / (stream.noise * stream.noise);
      });
  if (ran.alone) return;
  const double mean = sum / ran.count, deviation = std::sqrt(squares / ran.count);
  std::printf("mean deviation %.5f of the noise, of one stream %.4f\n", mean, deviation);
  constexpr double kHalfACount = 0.5 / 5.0;  // of the smallest noise
  EXPECT_LE(std::abs(mean), 5.0 * deviation / std::sqrt(ran.count) + kHalfACount) << "of all streams";
}

// The window is about the last marker that counted, whatever it was: where a marker is lost and its double is
// not, that one lies within the window and counts. There the axis stays until the next pair; markers of
// either side are missing as long as it likes, so no mean can be told. Never is it farther off than that.
testing::AssertionResult stays_near(const Stream& stream) {
  constexpr double kWhole = 1.0;  // both places are cut to counts
  const double allowed = 2.0 * stream.noise + Markers::kBehind + kWhole;
  if (stream.farthest <= allowed) return testing::AssertionSuccess();
  return testing::AssertionFailure() << stream.farthest << " of " << allowed;
}

TEST(Mco305SynchronizingProperties, ADoubleCountsAsItsMarkerWhereThatIsLost) {
  double farthest = 0.0;
  test::for_each_seed(1, test::cases(kUsualCases / 10, kSoakCases / 10), [&](const test::Case& one) {
    const Stream stream = stream_of(one.seed, true);
    ASSERT_TRUE(stays_near(stream));
    farthest = std::max(farthest, stream.farthest - 2.0 * stream.noise);
  });
  std::printf("%.1f counts beyond the noise\n", farthest);
}

// Those with which a mean over all markers, and not over pairs, was farther off than the noise.
TEST(Mco305SynchronizingProperties, StreamsThatOnceWereFarOff) {
  for (const std::uint64_t seed :
       {1376U, 2619U, 4204U, 5087U, 10'790U, 14'981U, 16'206U, 20'707U, 21'110U, 24'797U}) {
    SCOPED_TRACE("follow it with LOCKSTEP_SEED=" + std::to_string(seed));
    EXPECT_TRUE(has_its_mean(stream_of(seed, false)));
    const Stream parted = stream_of(seed, true);
    EXPECT_TRUE(stays_near(parted));
    EXPECT_GT(parted.pairs, 0);
  }
}

}  // namespace
}  // namespace lockstep::synchronizing_property_test
