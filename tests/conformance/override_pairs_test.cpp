// Every single pair of the override tables that existing blocks can form, live: a job runs, a new one starts,
// and both show what the table, and what is known besides it, says of them.
#include "tests/conformance/override_pairs.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

namespace lockstep::test::override_pairs_test {
namespace {

using Json = nlohmann::json;

constexpr int kTicksUntilActive = 6000;
constexpr int kTicksAfterwards = 10;

// ---- The catalogue
// ----------------------------------------------------------------------------------------------

struct Pair {
  NamedJob new_job;
  NamedJob running;
  Json json;
  std::string name() const {
    const auto one = [](const NamedJob& job) {
      return job.block + (job.state.empty() ? "" : " " + job.state) +
             (job.mode < 0 ? "" : " Mode " + std::to_string(job.mode));
    };
    return "new " + one(new_job) + " against running " + one(running);
  }
};

NamedJob named(const Json& pair, const std::string& which) {
  NamedJob job{.block = pair.at(which + "Job"), .state = {}};
  if (!pair.at(which + "State").is_null()) job.state = pair.at(which + "State");
  if (!pair.at(which + "Mode").is_null()) job.mode = pair.at(which + "Mode");
  return job;
}

std::vector<Pair> pairs_of_axes() {
  const Json file = Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/override.json"));
  std::vector<Pair> pairs;
  for (const Json& pair : file.at("pairs"))
    if (pair.at("matrix") == "homing_motion" || pair.at("matrix") == "synchronous")
      pairs.push_back({named(pair, "new"), named(pair, "running"), pair});
  return pairs;
}

OverrideEffect effect_named(const std::string& name) {
  if (name == "aborts") return OverrideEffect::abort;
  if (name == "new_job_rejected") return OverrideEffect::reject;
  if (name == "aborts_if_same_or_higher_stop_response") return OverrideEffect::abort_by_rank;
  EXPECT_EQ(name, "no_effect");
  return OverrideEffect::none;
}

/// Jobs that an exception from the printed tables may concern, beside those that have a state.
JobClass class_of_named(const NamedJob& job) {
  if (job.block.starts_with("MC_MotionIn") && !job.block.ends_with("Superimposed"))
    return JobClass::motion_in;
  if (job.block == "MC_GearIn") return JobClass::gear_in;
  if (job.block == "MC_GearInVelocity") return JobClass::gear_in_velocity;
  if (job.block == "MC_GearInPos" && job.state == "active") return JobClass::gear_in_pos_active;
  if (job.block == "MC_CamIn" && job.state == "active") return JobClass::cam_in_active;
  return JobClass::home_direct;
}

/// The printed effect in a situation, but for the exceptions that are made on purpose.
OverrideEffect expected_effect(const Pair& pair, bool position_controlled) {
  for (const OverrideException& exception : override_exceptions())
    if (exception.new_job == class_of_named(pair.new_job) &&
        exception.running == class_of_named(pair.running))
      return exception.effect;
  if (pair.json.at("effect") != "conditional") return effect_named(pair.json.at("effect"));
  const std::string when =
      position_controlled ? "following axis position-controlled" : "following axis not position-controlled";
  for (const Json& condition : pair.json.at("conditions"))
    if (condition.at("when") == when) return effect_named(condition.at("effect"));
  ADD_FAILURE() << "no condition for: " << when;
  return OverrideEffect::none;
}

/// Whether there is such a block, with such a mode.
bool exists(const NamedJob& job) {
  const BlockType* type = find_block_type(job.block);
  if (type == nullptr) return false;
  if (job.mode < 0) return true;
  static std::map<int, bool> modes;
  if (const auto known = modes.find(job.mode); known != modes.end()) return known->second;
  Bench bench;
  Subject& home = bench.add(*type);
  bench.ready();
  home.set("Mode", job.mode);
  home.start(true);
  bench.run(3);
  return modes[job.mode] = home.error_id() != static_cast<WORD>(ErrorId::mode);
}

// ---- What the tables do not tell: the fate of the new job
// -------------------------------------------------------

constexpr int kEndPassiveHoming = 9;  // MC_Home Mode

struct Rejection {
  bool (*applies)(const Pair& pair, const Situation& situation, OverrideEffect effect);
  ErrorId error;
  const char* reason;
};

/// The first that applies counts; none: the new job is accepted.
constexpr Rejection kRejections[] = {
    {[](const Pair& pair, const Situation&, OverrideEffect) {
       return pair.running.block == "MC_Stop" && pair.new_job.block != "MC_Stop" &&
              pair.new_job.block != "MC_LeadingValueAdditive" && pair.new_job.mode != kEndPassiveHoming;
     },
     ErrorId::locked, "MC_Stop locks the axis (A07); an additive leading value moves nothing by itself"},
    {[](const Pair& pair, const Situation& situation, OverrideEffect) {
       const bool leaving = pair.running.block == "MC_GearOut" || pair.running.block == "MC_CamOut";
       const bool coupled =
           pair.running.block == "MC_GearInPos" || pair.running.block == "MC_CamIn" || leaving;
       return homes_actively(pair.new_job) && situation.position_controlled &&
              ((coupled && pair.running.state == "active") || situation.moves_with_cam);
     },
     ErrorId::homing_while_coupled, "an axis that MC_GearInPos couples, or that is leaving it, is not homed"},
    {[](const Pair& pair, const Situation&, OverrideEffect effect) {
       return effect == OverrideEffect::reject && pair.running.block == "MC_GearInVelocity";
     },
     ErrorId::velocity_gear_active, "velocity synchronous operation has no position to act on"},
    {[](const Pair&, const Situation&, OverrideEffect effect) { return effect == OverrideEffect::reject; },
     ErrorId::shifts_exclude, "phasing and offset exclude each other"},
    {[](const Pair& pair, const Situation& situation, OverrideEffect) {
       return pair.new_job.block == "MC_MotionInSuperimposed" && !situation.position_controlled;
     },
     ErrorId::not_position_controlled, "a superimposed motion needs position control"},
    {[](const Pair& pair, const Situation& situation, OverrideEffect) {
       return pair.new_job.block == "MC_GearOut" && !situation.gear;
     },
     ErrorId::no_gear, "no gear to leave"},
    {[](const Pair& pair, const Situation& situation, OverrideEffect) {
       return pair.new_job.block == "MC_CamOut" && !situation.cam;
     },
     ErrorId::no_cam, "no cam to leave"},
    {[](const Pair& pair, const Situation& situation, OverrideEffect) {
       return is_shift(pair.new_job.block) && !situation.synchronous;
     },
     ErrorId::not_synchronous, "shifts need a synchronous axis"},
};

ErrorId expected_error(const Pair& pair, const Situation& situation, OverrideEffect effect) {
  for (const Rejection& rejection : kRejections)
    if (rejection.applies(pair, situation, effect)) return rejection.error;
  return ErrorId::none;
}

// ---- One pair in one situation
// ----------------------------------------------------------------------------------

/// Whether the new job ends the gear on which the running one acts: what acts on a coupling ends with it.
bool ends_its_gear(const Pair& pair) {
  return homes_actively(pair.new_job) &&
         (is_shift(pair.running.block) ||
          (pair.running.block == "MC_GearOut" && pair.running.state == "waiting"));
}

bool homes(const Pair& pair) {
  return pair.new_job.block == "MC_Home" || pair.running.block == "MC_Home";
}

class Encounter {
 public:
  Encounter(const Pair& pair, const Situation& situation)
      : pair_(pair), situation_(situation), stage_(homes(pair)) {
    running_ = situation.bring_about(stage_);
    before_ = Stage::fate(*running_);
    const bool as_told = situation.ended ? before_ == Fate::done
                                         : before_ == (waits_ought_to_be() ? Fate::waits : Fate::active);
    EXPECT_TRUE(as_told) << "the running job " << text(before_);
  }

  /// @return whether a job that is active in the table has become so
  bool run(OverrideEffect effect, OverrideEffect effect_while_waiting) {
    const ErrorId error = expected_error(pair_, situation_, effect);
    const bool by_and_by = pair_.new_job.state == "active";
    const double ahead = pair_.new_job.state == "waiting" ? Stage::kFar
                         : leaves(pair_.new_job.block)    ? situation_.before_gear_out
                                                          : Stage::kSoon;
    new_ = &stage_.start(pair_.new_job, ahead);
    if (pair_.new_job.block.starts_with("MC_MotionIn")) stage_.bench.allow_jumps(2);  // what is given counts
    stage_.bench.run(2);
    if (by_and_by) {
      for (int i = 0; i < kTicksUntilActive && Stage::fate(*new_) == Fate::waits; ++i) {
        expect_running(effect_while_waiting, "while the new one waits");
        stage_.bench.tick();
      }
    }
    const bool reached = Stage::fate(*new_) == Fate::active;
    expect_running(error == ErrorId::none ? effect : OverrideEffect::none, "once the new one counts");
    expect_new(error);
    if (pair_.running.block != "MC_Halt") stage_.bench.run(kTicksAfterwards);
    expect_running(error == ErrorId::none ? effect : OverrideEffect::none, "afterwards");
    EXPECT_EQ(stage_.bench.first_fault, "");
    return reached || error != ErrorId::none;
  }

 private:
  bool waits_ought_to_be() const {
    return pair_.running.state == "waiting" ||
           (is_shift(pair_.running.block) && std::string_view(situation_.name) == "waiting");
  }

  void expect_running(OverrideEffect effect, const char* when) {
    const bool ends =
        effect == OverrideEffect::abort || effect == OverrideEffect::abort_by_rank || ends_its_gear(pair_);
    // MC_LeadingValueAdditive has no CommandAborted: the older instance shows Busy FALSE and nothing else
    // (A04).
    const Fate aborted = pair_.running.block == "MC_LeadingValueAdditive" ? Fate::silent : Fate::aborted;
    const Fate expected = ends && !situation_.ended ? aborted : before_;
    EXPECT_EQ(text(Stage::fate(*running_)), text(expected)) << "the running job, " << when;
  }

  void expect_new(ErrorId error) {
    const Fate fate = Stage::fate(*new_);
    if (error != ErrorId::none) {
      EXPECT_EQ(new_->error_id(), static_cast<WORD>(error)) << "the new job " << text(fate);
      return;
    }
    EXPECT_EQ(new_->error_id(), WORD{});
    const bool ended_at_once = pair_.new_job.mode == kEndPassiveHoming;
    const bool nothing_to_leave = (pair_.new_job.block == "MC_GearOut" && !situation_.moves_with_leading) ||
                                  (pair_.new_job.block == "MC_CamOut" && !situation_.moves_with_cam);
    const Fate expected = nothing_to_leave || ended_at_once     ? Fate::done
                          : pair_.new_job.state == "waiting"    ? Fate::waits
                          : fate == Fate::done && short_lived() ? Fate::done
                                                                : Fate::active;
    EXPECT_EQ(text(fate), text(expected)) << "the new job";
  }

  bool short_lived() const {
    return is_one_of(pair_.new_job.block, {"MC_Halt", "MC_Stop", "MC_HaltSuperimposed"});
  }

  const Pair& pair_;
  const Situation& situation_;
  Stage stage_;
  Subject* running_ = nullptr;
  Subject* new_ = nullptr;
  Fate before_{};
};

/// What the table says of the same job while it still waits.
OverrideEffect effect_while_waiting(const std::vector<Pair>& pairs, const Pair& active, bool controlled) {
  for (const Pair& pair : pairs)
    if (pair.new_job.block == active.new_job.block && pair.new_job.state == "waiting" &&
        pair.running.block == active.running.block && pair.running.state == active.running.state)
      return expected_effect(pair, controlled);
  ADD_FAILURE() << "no row for the waiting job";
  return OverrideEffect::none;
}

TEST(OverridePairs, EndAndGoOnAsTheTablesSayInEverySituationThatExists) {
  const std::vector<Pair> pairs = pairs_of_axes();
  int tested = 0, runs = 0;
  std::map<std::string, int> awaited;  // pairs that wait for a block or mode
  for (const Pair& pair : pairs) {
    if (!exists(pair.new_job) || !exists(pair.running)) {
      const NamedJob& job = exists(pair.new_job) ? pair.running : pair.new_job;
      ++awaited[job.block + (job.mode < 0 ? "" : " Mode " + std::to_string(job.mode))];
      continue;
    }
    const std::vector<Situation> distances = situations(pair.running);
    EXPECT_FALSE(distances.empty()) << pair.name() << ": no situation brings the running job about";
    bool active = false;
    for (const Situation& distance : distances) {
      SCOPED_TRACE(pair.name() + ", " + distance.name);
      const OverrideEffect effect = expected_effect(pair, distance.position_controlled);
      const OverrideEffect waiting = pair.new_job.state == "active"
                                         ? effect_while_waiting(pairs, pair, distance.position_controlled)
                                         : effect;
      active |= Encounter(pair, distance).run(effect, waiting);
      ++runs;
    }
    EXPECT_TRUE(active || pair.new_job.state != "active") << pair.name() << ": never became active";
    ++tested;
  }
  std::printf("%d of %zu pairs tested, in %d situations\n", tested, pairs.size(), runs);
  for (const auto& [block, count] : awaited) std::printf("%5d wait for %s\n", count, block.c_str());
  EXPECT_EQ(tested, 820) << "400 of table 12.3.1, 420 of 12.3.2";
  EXPECT_TRUE(awaited.empty());
}

/// The letter B: emergency stop over maximum dynamics over given dynamics.
TEST(OverridePairs, AStopIsEndedByTheSameOrAStrongerOneOnly) {
  constexpr int kModes[] = {3, 2, 0};  // by strength
  for (int running = 0; running < 3; ++running)
    for (int next = 0; next < 3; ++next) {
      Stage stage;
      stage.rush();
      const auto stop = [&](int mode) -> Subject& {
        Subject& job = stage.make("MC_Stop");
        job.set("Mode", mode);
        job.set("Deceleration", 20.0);
        job.start(true);
        stage.bench.run(2);
        return job;
      };
      stage.bench.following.data.DynamicLimits.MaxDeceleration = 50.0;
      stage.bench.following.data.DynamicDefaults.EmergencyDeceleration = 100.0;
      Subject& first = stop(kModes[running]);
      Subject& second = stop(kModes[next]);
      SCOPED_TRACE("Mode " + std::to_string(kModes[next]) + " against " + std::to_string(kModes[running]));
      const bool ends = next >= running;
      EXPECT_EQ(text(Stage::fate(first)), text(ends ? Fate::aborted : Fate::active));
      EXPECT_EQ(text(Stage::fate(second)), text(ends ? Fate::active : Fate::failed));
      EXPECT_EQ(second.error_id(), ends ? WORD{} : static_cast<WORD>(ErrorId::locked));
    }
}

/// Profile 5 ends a shift that waits and leaves one that runs (A05).
TEST(OverridePairs, ProfileFiveEndsAWaitingShiftAndLeavesARunningOne) {
  for (const char* block :
       {"MC_PhasingAbsolute", "MC_PhasingRelative", "MC_OffsetAbsolute", "MC_OffsetRelative"})
    for (const bool waits : {true, false}) {
      SCOPED_TRACE(std::string(block) + (waits ? ", waiting" : ", running"));
      Stage stage;
      stage.bench.couple();
      Subject& running = stage.start(block, waits ? Stage::kFar : Stage::kSoon);
      stage.bench.run(3);
      ASSERT_EQ(text(Stage::fate(running)), text(waits ? Fate::waits : Fate::active));
      Subject& cancel = stage.make(block);
      cancel.set("ProfileReference", 5.0);
      cancel.start(true);
      stage.bench.run(3);
      EXPECT_TRUE(cancel.done());
      EXPECT_EQ(text(Stage::fate(running)), text(waits ? Fate::aborted : Fate::active));
    }
}

}  // namespace
}  // namespace lockstep::test::override_pairs_test
