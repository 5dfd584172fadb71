// Random jobs in random order on a leading and a following axis: whatever is asked for, the setpoints stay
// finite and without steps, and every job shows its end.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "tests/conformance/bench.hpp"
#include "tests/support/property.hpp"

namespace lockstep::test::sequences_test {
namespace {

constexpr std::uint64_t kFirstSeed = 1517;
constexpr int kSequences = 1000;
constexpr int kSoakSequences = 100000;
constexpr int kActions = 40;

class Sequence {
 public:
  Sequence(std::uint64_t seed, bool told) : random_(seed), told_(told), bench_(chance(0.5)) {
    for (const BlockType& type : block_types()) {
      if (!Subject(type).acts_on_axis() || type.name == "MC_Power") continue;
      following_.push_back(&bench_.add(type));
      following_.push_back(&bench_.add(type));
      const Pin* axis = type.find_pin("Axis");
      if (axis == nullptr) continue;  // what only a following axis can do
      Subject& subject = bench_.add(type);
      subject.wire(*axis, &bench_.leading);
      leading_.push_back(&subject);
    }
    bench_.watch_coupled = true;
    bench_.ready();
  }

  /// What went wrong first; empty if nothing did.
  std::string run() {
    for (int i = 0; i < kActions && bench_.first_fault.empty(); ++i) {
      act();
      for (int wait = pick(25); wait >= 0; --wait) tick();
      expect_no_function_where_none_is_declared();
    }
    finish();
    if (bench_.allocations != 0) bench_.fault("memory was allocated or released in the cycle");
    return bench_.first_fault;
  }

 private:
  bool chance(double probability) { return std::bernoulli_distribution(probability)(random_); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void tick() {
    bench_.watch_coupled = std::none_of(following_.begin(), following_.end(), steps_what_follows);
    if (falls_off_a_cam()) bench_.allow_jumps(2);
    for (const auto* subjects : {&following_, &leading_})
      for (Subject* s : *subjects)
        if (s->type().name.starts_with("MC_MotionIn") && (s->busy() || s->on_start())) bench_.allow_jumps(3);
    bench_.tick();
    for (const auto* subjects : {&following_, &leading_}) {
      const auto in_effect = std::count_if(subjects->begin(), subjects->end(),
                                           [](Subject* s) { return s->has_jobs() && s->in_effect(); });
      if (in_effect > 1 && !bench_.following.simulating())
        bench_.fault("two jobs on one axis have met their aims at once");
    }
  }

  /// Additive velocities and positions need not fit each other; what follows them shows it. A cam scaled at
  /// random steps where it is set on or changed directly: published for profiles 2 and 5, until they are
  /// InSync.
  static bool steps_what_follows(Subject* s) {
    if (!s->busy()) return false;
    if (s->type().name == "MC_LeadingValueAdditive") return true;
    if (s->type().name != "MC_CamIn" || s->in_effect()) return false;
    const double profile = s->number(*s->type().find_pin("SyncProfileReference"));
    return profile == 2.0 || profile == 5.0;
  }

  /// An additive leading value, or a leading axis that is homed, may take the axis over the end of a cam that
  /// is passed once, where it stands, also of one that it waits for. The instance that started the cam may
  /// show a later job.
  bool falls_off_a_cam() {
    const bool leading_homes = std::any_of(leading_.begin(), leading_.end(), [](Subject* s) {
      return s->busy() && s->type().name == "MC_Home";
    });
    const auto& status = bench_.following.data.StatusSynchronizedMotion;
    const bool camming = status.ActualCam != DB_ANY{} || status.WaitingFunctionState == 3;
    return camming && (bench_.following.additive_request.owner != nullptr || leading_homes || homes_);
  }

  void act() {
    const int kind = pick(100);
    if (kind < 4) {
      bench_.power_following.Enable = !bench_.power_following.Enable;
      bench_.power_following.StopMode = static_cast<INT>(pick(4));
    } else if (kind < 6) {
      bench_.power_leading.Enable = !bench_.power_leading.Enable;
    } else if (kind < 12) {
      Axis& axis = chance(0.5) ? bench_.following : bench_.leading;
      constexpr double kOverrides[] = {0.0, 10.0, 50.0, 100.0, 100.0, 150.0, 200.0};
      axis.data.Override.Velocity = kOverrides[pick(7)];
    } else if (kind < 15) {
      bench_.run_leading.Execute = !bench_.run_leading.Execute;
    } else {
      const bool follows = chance(0.75);
      auto& subjects = follows ? following_ : leading_;
      use(*subjects[static_cast<std::size_t>(pick(static_cast<int>(subjects.size())))], follows);
    }
  }

  /// Starts a block with inputs at random, starts it anew in mid-job, or drops its request.
  void use(Subject& subject, bool follows) {
    if (may_step(subject)) bench_.allow_position_steps(4);
    homes_ = subject.type().name == "MC_Home";
    if (subject.number(*subject.start_pin()) != 0.0) {
      subject.start(false);
      if (chance(0.5)) return;
      tick();
    }
    for (const Pin& pin : subject.type().pins)
      if (pin.pin_class == PinClass::input && pin.type != Type::AXIS) set_at_random(subject, pin, follows);
    subject.start(true);
    tell(subject, follows);
  }

  /// Published steps: homing, also of the leading axis; additive leading values.
  static bool may_step(const Subject& subject) {
    return subject.type().name == "MC_Home" || subject.type().name == "MC_Reset" ||
           subject.type().name == "MC_LeadingValueAdditive";
  }

  void set_at_random(Subject& subject, const Pin& pin, bool follows) {
    if (pin.type == Type::BOOL) {
      // A leading axis that leaves position control is a published step of what follows it.
      const bool flag = pin.name == "PositionControlled" ? !follows || chance(0.8) : chance(0.2);
      return subject.store(pin, flag ? 1.0 : 0.0);
    }
    if (!pin.choices.empty())
      return subject.store(
          pin, static_cast<double>(
                   pin.choices[static_cast<std::size_t>(pick(static_cast<int>(pin.choices.size())))].value));
    if (is_integer(pin.type)) return subject.store(pin, pick(7) - (pin.name == "RatioNumerator" ? 3 : 0));
    if (pin.name.ends_with("Scaling"))
      return subject.store(pin, (chance(0.2) ? -1.0 : 1.0) * uniform(0.5, 2.0));
    subject.store(pin, number_for(pin));
  }

  double number_for(const Pin& pin) {
    if (chance(0.02)) return NAN;
    switch (pin.unit) {
      case Unit::kVelocity:
        return chance(0.3) ? -1.0 : uniform(1.0, 600.0);
      case Unit::kAcceleration:
        return chance(0.3) ? -1.0 : uniform(50.0, 6000.0);
      case Unit::kJerk:
        return chance(0.3) ? -1.0 : chance(0.2) ? 0.0 : uniform(500.0, 150000.0);
      case Unit::kLeading:
        return uniform(40.0, 95.0);
      default:
        return uniform(-200.0, 200.0);
    }
  }

  /// Disabled, both axes come to rest and no block is left with a running job, unless a simulated synchronous
  /// motion outlives the enable.
  /// A variable whose function is declared to be missing keeps its start value.
  void expect_no_function_where_none_is_declared() {
    for (const Variable& variable : data_block_of(bench_.following.kind).status) {
      if (!variable.later) continue;
      const VariableAddress place{&variable, variable.offset};
      const Value value = place.signal(&bench_.following.data).load();
      if (as_double(value, variable.type) != as_double(variable.start_value(), variable.type))
        bench_.fault(std::string(variable.path) + " has a function");
    }
  }

  void finish() {
    for (const auto* subjects : {&following_, &leading_})
      for (Subject* subject : *subjects)
        if (!subject->has_jobs()) subject->start(false);
    bench_.allow_position_steps(4);
    bench_.power_following.Enable = bench_.power_leading.Enable = false;
    for (int i = 0; i < kStoppingTicks && !(bench_.following.off() && bench_.leading.off()); ++i) tick();
    for (int i = 0; i < 3; ++i) tick();
    if (bench_.brakes_for_long()) return;  // left at a velocity by a step of the additive leading value
    if (!bench_.following.off() || !bench_.leading.off()) return bench_.fault("an axis does not stop");
    for (const auto* subjects : {&following_, &leading_})
      for (Subject* subject : *subjects)
        if (subject->busy() && !bench_.following.simulating())
          bench_.fault(subject->name() + " is Busy on a disabled axis");
    if (bench_.following.data.Velocity != 0.0 || bench_.leading.data.Velocity != 0.0)
      bench_.fault("a disabled axis moves");
  }

  /// The sequence of one seed is told, to follow what led to a fault.
  void tell(Subject& subject, bool follows) {
    if (!told_) return;
    std::printf("%.3f s %s %s, v %.17g a %.17g:", static_cast<double>(bench_.now()) * 1e-9,
                follows ? "following" : "leading", subject.name().c_str(),
                (follows ? bench_.following : bench_.leading).setpoint().velocity,
                (follows ? bench_.following : bench_.leading).setpoint().acceleration);
    for (const Pin& pin : subject.type().pins)
      if (pin.pin_class == PinClass::input && pin.type != Type::AXIS)
        std::printf(" %s=%.17g", std::string(pin.name).c_str(), subject.number(pin));
    std::printf("\n");
  }

  std::mt19937_64 random_;
  bool told_;
  bool homes_ = false;  // with the block used last
  Bench bench_;
  std::vector<Subject*> following_, leading_;
};

TEST(Sequences, OfRandomJobsEndInOrderWithoutAStep) {
  for_each_seed(kFirstSeed, cases(kSequences, kSoakSequences),
                [](const Case& one) { EXPECT_EQ(Sequence(one.seed, one.alone).run(), ""); });
}

}  // namespace
}  // namespace lockstep::test::sequences_test
