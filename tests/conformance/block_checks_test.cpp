// The conformance run: every registered block through the same checks, generated from its pins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/conformance/published_values.hpp"
#include "tests/conformance/trial.hpp"
#include "tests/support/property.hpp"

namespace lockstep {

/// The name of a test ends in the name of the block, not in an address.
void PrintTo(const BlockType* type, std::ostream* out) {
  *out << type->name;
}

}  // namespace lockstep

namespace lockstep::test {
namespace {

const testing::Environment* const kTable = testing::AddGlobalTestEnvironment(new Table);

// ---- Blocks that use technology objects
// -------------------------------------------------------------------------

class MotionBlock : public testing::TestWithParam<const BlockType*> {
 protected:
  const BlockType& type() const { return *GetParam(); }
};

/// Blocks with jobs of an axis, which disabling it ends.
class JobBlock : public MotionBlock {};
/// Blocks whose jobs a rising edge starts, so that Done, CommandAborted or Error shows their end.
class EdgeBlock : public MotionBlock {};

// What the other checks disturb has to work when nothing does.
TEST_P(MotionBlock, ReachesItsAimWithTheSettingsOfThisTest) {
  Trial run(type(), "ends once");
  Subject& s = *run.subject;
  bool reached = false;
  s.start(true);
  for (int i = 0; i < 600 && !reached; ++i) {
    run.bench.tick();
    reached = s.done() || s.in_effect() || ((!s.has_jobs() || !s.has_aim()) && s.busy());
    if (s.error()) run.bench.fault("rejected with " + std::to_string(static_cast<int>(s.error_id())));
  }
  if (!reached) run.bench.fault("neither Done nor in effect");
  run.leave_in_order();
}

TEST_P(EdgeBlock, ShowsTheEndOfAShortRequestInExactlyOneCall) {
  for (const int delay : {0, 1, 2, 5, 30, 400}) {
    Trial run(type(), "ends once");
    run.what = "disabled " + std::to_string(delay) + " calls after the start";
    Subject& s = *run.subject;
    int ends = 0;
    const auto step = [&] {
      run.bench.tick();
      if (s.ended()) ++ends;
    };
    s.start(true);
    step();
    s.start(false);
    for (int i = 0; i < delay; ++i) step();
    run.bench.power_following.Enable = false;
    for (int i = 0; i < 200; ++i) step();
    if (ends != 1) run.bench.fault("shown in " + std::to_string(ends) + " calls");
    if (s.busy()) run.bench.fault("Busy after its end");
    run.leave_in_order();
  }
}

TEST_P(EdgeBlock, HoldsItsEndWhileItIsCalledFor) {
  for (const int delay : {0, 1, 2, 5, 30, 400}) {
    Trial run(type(), "ends once");
    run.what = "held, disabled after " + std::to_string(delay) + " calls";
    Subject& s = *run.subject;
    s.start(true);
    run.bench.run(1 + delay);
    run.bench.power_following.Enable = false;
    run.bench.run(200);
    if (!s.ended()) run.bench.fault("no end is shown");
    const bool done = s.done(), aborted = s.aborted();
    run.bench.run(50);
    if (s.done() != done || s.aborted() != aborted || !s.ended()) run.bench.fault("the end is not held");
    s.start(false);
    run.bench.run(1);
    if (s.ended() || s.busy()) run.bench.fault("something is left of the end");
    run.leave_in_order();
  }
}

std::vector<double> hostile_values(const Pin& pin) {
  if (is_real(pin.type))
    return {NAN,  INFINITY, -INFINITY, 0.0,    -0.0,    1.0,      -1.0,  1e-300, 5e-324, -5e-324,
            1e12, -1e12,    1e308,     -1e308, DBL_MAX, -DBL_MAX, 1e-12, 1e100,  -1e100};
  std::vector<double> values = {static_cast<double>(lowest(pin.type)),
                                static_cast<double>(highest(pin.type))};
  for (int number = is_signed_integer(pin.type) ? -2 : 0; number <= 20; ++number) values.push_back(number);
  return values;
}

bool listed(const std::vector<Unsupported>& list, const BlockType& type, const Pin& pin, double value) {
  return std::any_of(list.begin(), list.end(), [&](const Unsupported& row) {
    return type.name == row.block && pin.name == row.pin && row.values.contains(value);
  });
}

void try_value(const BlockType& type, const PublishedValues& published, const Pin& pin, double value,
               bool modulo, bool make_relevant) {
  Trial run(type, "values", modulo);
  Subject& s = *run.subject;
  if (make_relevant)
    for (const auto& [name, number] : published.relevant_setting(pin)) s.set(name, number);
  s.store(pin, value);
  run.what = std::string(pin.name) + " = " + std::to_string(s.number(pin)) + (modulo ? ", ring" : "") +
             (make_relevant ? ", relevant" : "");
  Verdict verdict = published.verdict(s, pin, value, modulo);
  if (listed(kUnsupported, type, pin, value)) {
    EXPECT_EQ(verdict, Verdict::accepted) << "listed as unsupported without need";
    verdict = Verdict::rejected;
  }
  s.start(true);
  run.bench.tick();
  const bool refused = s.error() && s.error_id() == static_cast<WORD>(pin.error);
  if (verdict == Verdict::rejected && !refused) run.bench.fault("a value that is not permitted is accepted");
  if (verdict == Verdict::accepted && s.error())
    run.bench.fault("a permitted value is rejected with " + std::to_string(static_cast<int>(s.error_id())));
  if (s.error() && !refused) run.bench.fault("rejected with the error of something else");
  run.bench.run(250);
  s.start(false);
  run.bench.run(20);
  run.leave_in_order();
}

TEST_P(MotionBlock, AcceptsOrRejectsEachValueOfEachNumericInputAndLeavesTheAxisSafe) {
  const PublishedValues published(type().name);
  for (const Pin& pin : type().pins) {
    if (pin.pin_class != PinClass::input || !is_numeric(pin.type)) continue;
    for (const double value : hostile_values(pin))
      for (const bool modulo : {false, true}) {
        if (listed(kUnfit, type(), pin, value)) continue;
        try_value(type(), published, pin, value, modulo, false);
        if (!published.relevant_setting(pin).empty()) try_value(type(), published, pin, value, modulo, true);
      }
  }
}

// A job has taken its inputs over; a block that reads them in every call refuses them.
TEST_P(MotionBlock, StaysSafeWhenAnInputTurnsHostileWhileItRuns) {
  for (const Pin& pin : type().pins) {
    if (pin.pin_class != PinClass::input || !is_numeric(pin.type)) continue;
    for (const double value : hostile_values(pin)) {
      Trial run(type(), "values");
      Subject& s = *run.subject;
      const double usual = s.number(pin);
      s.start(true);
      run.bench.run(30);
      s.store(pin, value);
      run.what = std::string(pin.name) + " = " + std::to_string(s.number(pin)) + " while running";
      const bool error_before = s.error();
      run.bench.run(60);
      if (s.starts_by_edge() && s.error() && !error_before)
        run.bench.fault("an input counts after the start");
      s.store(pin, usual);
      run.bench.run(60);
      s.start(false);
      run.bench.run(20);
      run.leave_in_order();
    }
  }
}

TEST_P(MotionBlock, TakesEachFlagEitherWay) {
  for (const Pin& pin : type().pins) {
    if (pin.pin_class != PinClass::input || pin.type != Type::BOOL || pin.name == "Execute") continue;
    for (const double value : {0.0, 1.0}) {
      Trial run(type(), "values");
      run.what = std::string(pin.name) + " = " + std::to_string(value);
      Subject& s = *run.subject;
      s.store(pin, value);
      s.start(true);
      run.bench.run(250);
      s.start(false);
      run.bench.run(20);
      run.leave_in_order();
    }
  }
}

TEST_P(JobBlock, RejectsWhatADisabledAxisCannotDo) {
  Trial run(type(), "disabled", false, false);
  run.bench.power_following.Enable = false;
  Subject& s = *run.subject;
  s.start(true);
  run.bench.run(5);
  if (kOnDisabledAxis.contains(type().name)) {
    if (!s.done()) run.bench.fault("not done on a disabled axis");
  } else if (!s.error() || s.error_id() != static_cast<WORD>(ErrorId::locked)) {
    run.bench.fault("not rejected with 16#800F");
  }
  if (run.bench.following.data.Velocity != 0.0) run.bench.fault("a disabled axis moves");
  s.start(false);
  run.bench.run(2);
  if (s.error()) run.bench.fault("the error outlasts the request");
}

TEST_P(JobBlock, EndsWhenTheAxisIsDisabledWhateverItDoes) {
  for (const INT stop_mode : {INT{0}, INT{1}, INT{2}, INT{3}})
    for (const int delay : {0, 1, 2, 3, 4, 5, 10, 20, 40, 80, 160, 320}) {
      Trial run(type(), "disabled");
      run.what = "StopMode " + std::to_string(stop_mode) + " after " + std::to_string(delay) + " calls";
      Subject& s = *run.subject;
      run.bench.power_following.StopMode = stop_mode;
      s.start(true);
      run.bench.run(delay);
      run.bench.power_following.Enable = false;
      run.bench.run(4);
      if (s.busy()) run.bench.fault("Busy on an axis that is being disabled");
      if (s.starts_by_edge() && !s.ended()) run.bench.fault("no end is shown");
      run.leave_in_order();
    }
}

TEST_P(JobBlock, StartsAnewAfterTheAxisWasDisabledAndEnabledAgain) {
  Trial run(type(), "disabled");
  Subject& s = *run.subject;
  for (int round = 0; round < 3; ++round) {
    s.start(true);
    run.bench.run(20);
    run.bench.power_following.Enable = false;
    run.bench.run_until([&] { return run.bench.following.off(); }, kStoppingTicks);
    s.start(false);
    run.bench.run(2);
    run.bench.power_following.Enable = true;
    run.bench.run(3);
    if (kOnCoupledAxis.contains(type().name)) run.bench.couple_for(type().name);
    s.start(true);
    run.bench.run(2);
    if (s.error())
      run.bench.fault("rejected after enabling, round " + std::to_string(round) + ", with " +
                      std::to_string(static_cast<int>(s.error_id())));
    s.start(false);
    run.bench.run(2);
  }
  run.leave_in_order();
}

TEST_P(MotionBlock, MayBeRetriggeredInEveryCallOnTwoInstances) {
  for (const int period : {2, 3, 5, 40}) {
    Trial run(type(), "retriggered");
    run.what = "every " + std::to_string(period) + " calls";
    Subject& first = *run.subject;
    Subject& second = run.bench.add(type());
    apply_settings(second);
    for (int i = 0; i < 400; ++i) {
      first.start(i % period < (period + 1) / 2);
      second.start((i + period / 2) % period < (period + 1) / 2);
      run.bench.tick();
    }
    second.start(false);
    first.start(false);
    run.bench.run(20);
    if (second.starts_by_edge() && first.starts_by_edge() && first.busy() && second.busy())
      run.bench.fault("two jobs of one kind run at once");
    run.leave_in_order();
    if (second.busy() && second.acts_on_axis())
      run.bench.fault("the second instance is Busy on a disabled axis");
  }
}

TEST_P(MotionBlock, TellsThatItIsNotWired) {
  for (const Pin& pin : type().pins) {
    if (pin.type != Type::AXIS) continue;
    Trial run(type(), "unwired");
    run.what = pin.name;
    Subject& s = *run.subject;
    if (s.powers()) {
      s.start(false);
      run.bench.run_until([&] { return run.bench.following.off(); }, kStoppingTicks);
    }
    s.wire(pin, nullptr);
    for (int i = 0; i < 4; ++i) {
      s.start(true);
      run.bench.tick();
      if (!s.error() || s.error_id() != static_cast<WORD>(ErrorId::no_technology_object))
        run.bench.fault("not rejected with 16#8002");
      run.bench.run(3);
      s.start(false);
      run.bench.run(2);
      if (s.error() && s.has_jobs()) run.bench.fault("the error outlasts the request");
    }
    s.wire(pin, run.bench.object_for(pin));
    run.leave_in_order();
  }
}

// Every other block starts while this one runs, and this one while the other does.
TEST_P(JobBlock, MeetsEveryOtherBlockAtAnyTime) {
  for (const BlockType& other_type : block_types()) {
    if (!Subject(other_type).uses_objects() || other_type.name == "MC_Power") continue;
    for (const int delay : {0, 1, 2, 7, 60, 200}) {
      Trial run(type(), "other jobs");
      run.what = std::string(other_type.name) + " after " + std::to_string(delay) + " calls";
      if (kRenamesPositions.contains(other_type.name)) run.bench.allow_position_steps(kTicksOfATrial);
      if (kGivesSetpoints.contains(other_type.name)) run.bench.allow_jumps(kTicksOfATrial);
      Subject& s = *run.subject;
      Subject& other = run.bench.add(other_type);
      apply_settings(other);
      s.start(true);
      run.bench.run(delay);
      other.start(true);
      run.bench.run(150);
      s.start(false);
      other.start(false);
      run.bench.run(150);
      run.leave_in_order();
      if (other.busy() && other.acts_on_axis()) run.bench.fault(other.name() + " is Busy on a disabled axis");
    }
  }
}

template <class Condition>
std::vector<const BlockType*> blocks_that(Condition condition) {
  std::vector<const BlockType*> types;
  for (const BlockType& type : block_types())
    if (condition(Subject(type))) types.push_back(&type);
  return types;
}

std::string block_name(const testing::TestParamInfo<const BlockType*>& info) {
  return std::string(info.param->name);
}

INSTANTIATE_TEST_SUITE_P(Every, MotionBlock,
                         testing::ValuesIn(blocks_that([](const Subject& s) { return s.uses_objects(); })),
                         block_name);
INSTANTIATE_TEST_SUITE_P(Every, JobBlock, testing::ValuesIn(blocks_that([](const Subject& s) {
                           return s.has_jobs() && s.acts_on_axis();
                         })),
                         block_name);
INSTANTIATE_TEST_SUITE_P(Every, EdgeBlock, testing::ValuesIn(blocks_that([](const Subject& s) {
                           return s.starts_by_edge() && s.acts_on_axis();
                         })),
                         block_name);

// ---- Blocks without technology objects
// --------------------------------------------------------------------------

class StandardBlock : public testing::TestWithParam<const BlockType*> {};

void set_at_random(Subject& subject, std::mt19937& random) {
  for (const Pin& pin : subject.type().pins) {
    if (pin.pin_class != PinClass::input) continue;
    if (pin.type == Type::BOOL)
      subject.store(pin, static_cast<double>(random() % 2));
    else if (random() % 20 == 0)
      subject.store(pin, hostile_values(pin)[random() % hostile_values(pin).size()]);
  }
}

// The same calls give the same outputs, whatever the inputs; TIME and counters stay in their types.
TEST_P(StandardBlock, DependsOnItsCallsAloneAndAllocatesNothing) {
  const std::uint64_t seed = seed_of_test(61131);
  Subject first(*GetParam()), second(*GetParam());
  std::mt19937 random_first(seed), random_second(seed);
  std::uint64_t allocations = 0;
  bool same = true, in_range = true;
  for (int call = 0; call < cases(20'000, 200'000); ++call) {
    set_at_random(first, random_first);
    set_at_random(second, random_second);
    const std::int64_t now = call * 1'000'000LL;
    const std::uint64_t before = allocations_counted();
    {
      const CountAllocations count;
      first.block().call(now);
      second.block().call(now);
    }
    allocations += allocations_counted() - before;
    for (const Pin& pin : GetParam()->pins) {
      if (pin.pin_class != PinClass::output) continue;
      same &= pin.signal(first.block()).load().u == pin.signal(second.block()).load().u;
      if (pin.type == Type::BOOL) in_range &= *static_cast<unsigned char*>(pin.address(first.block())) <= 1;
      if (pin.type == Type::TIME) in_range &= first.number(pin) >= 0.0;
    }
  }
  EXPECT_TRUE(same) << "two instances differ";
  EXPECT_TRUE(in_range) << "an output out of its type";
  EXPECT_EQ(allocations, 0u);
  Count& values = Table::at(*GetParam(), "values");
  Count& allocation = Table::at(*GetParam(), "allocation");
  ++values.runs;
  ++allocation.runs;
  if (!same || !in_range) ++values.failed;
  if (allocations != 0) ++allocation.failed;
}

INSTANTIATE_TEST_SUITE_P(Every, StandardBlock,
                         testing::ValuesIn(blocks_that([](const Subject& s) { return !s.uses_objects(); })),
                         block_name);

TEST(ConformanceRun, KnowsOnlyBlocksAndPinsThatExist) {
  const auto exists = [](std::string_view block, std::string_view pin) {
    const BlockType* type = find_block_type(block);
    return type != nullptr && (pin.empty() || type->find_pin(pin) != nullptr);
  };
  for (const Setting& setting : kSettings) EXPECT_TRUE(exists(setting.block, setting.pin)) << setting.block;
  for (const Unsupported& row : kUnsupported) EXPECT_TRUE(exists(row.block, row.pin)) << row.block;
  for (const auto& names :
       {kOnMovingAxis, kOnSuperimposedMotion, kGivesSetpoints, kOnDisabledAxis, kRenamesPositions})
    for (const std::string_view name : names) EXPECT_TRUE(exists(name, "")) << name;
}

/// "Velocity not permitted" names the pin and its error.
TEST(ErrorsOfPins, AreThoseOfTheCatalogues) {
  constexpr std::string_view kEnd = " not permitted";
  int compared = 0;
  for (const char* name : {"instructions_axis.json", "instructions.json"}) {
    const auto file = nlohmann::json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/" + name));
    for (const auto& entry : file) {
      const BlockType* type = find_block_type(entry.at("name").get<std::string>());
      if (type == nullptr || !entry.contains("errorRulesExternal")) continue;
      for (const auto& rule : entry.at("errorRulesExternal")) {
        const auto when = rule.at("when").get<std::string>();
        if (!when.ends_with(kEnd)) continue;
        std::string of = when.substr(0, when.size() - kEnd.size());
        if (of == "direction") of = "SyncOutDirection";
        const Pin* pin = type->find_pin(of);
        if (pin == nullptr || pin->type == Type::AXIS) continue;
        const auto published = std::stoul(rule.at("errorId").get<std::string>().substr(3), nullptr, 16);
        EXPECT_EQ(static_cast<unsigned long>(pin->error), published) << type->name << " " << of;
        ++compared;
      }
    }
  }
  std::printf("%d errors of pins compared\n", compared);
  EXPECT_GT(compared, 80);
}

}  // namespace
}  // namespace lockstep::test
