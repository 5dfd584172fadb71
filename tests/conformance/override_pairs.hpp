/// Jobs of the override tables on the bench: how each of them is brought about, and what became of it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/conformance/bench.hpp"

namespace lockstep::test {

/// A job as the tables name it.
struct NamedJob {
  std::string block;
  std::string state;  ///< "waiting", "active"; empty: the table does not tell them apart
  int mode = -1;      ///< MC_Home; -1: none
};

/// Whether a job looks for a homing mark: MC_Home Mode 3 and 5 by a motion of its own, 2, 8 and 10 in
/// passing.
inline bool homes_actively(const NamedJob& job) {
  return job.mode == 3 || job.mode == 5;
}
inline bool homes_passively(const NamedJob& job) {
  return job.mode == 2 || job.mode == 8 || job.mode == 10;
}

/// What can become of a job.
enum class Fate { waits, active, done, aborted, failed, silent };

inline std::string text(Fate fate) {
  constexpr const char* kTexts[] = {"waits", "is active", "is done", "is aborted", "has failed", "is silent"};
  return kTexts[static_cast<int>(fate)];
}

inline bool is_one_of(const std::string& name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}
inline bool is_single_axis(const std::string& block) {
  return is_one_of(block, {"MC_Halt", "MC_MoveAbsolute", "MC_MoveRelative", "MC_MoveVelocity", "MC_MoveJog"});
}
inline bool leaves(const std::string& block) {
  return is_one_of(block, {"MC_GearOut", "MC_CamOut"});
}
inline bool is_superimposed(const std::string& block) {
  return block.ends_with("Superimposed");
}
inline bool is_shift(const std::string& block) {
  return block.starts_with("MC_Phasing") || block.starts_with("MC_Offset");
}

/// The bench with a leading axis that turns slowly: five seconds for a turn.
class Stage {
 public:
  /// @param driven whether the following axis has a drive, so that it has a mark to look for
  explicit Stage(bool driven = false) : bench(false, true, driven) {
    bench.run_leading.Velocity = kLeadingVelocity;
    bench.ready();
    bench.run(100);
  }

  Subject& make(const std::string& block) {
    Subject& subject = bench.add(*find_block_type(block));
    if (const Pin* const cam = subject.type().find_pin("Cam")) subject.wire(*cam, &bench.straight);
    return subject;
  }

  /// The job that is to override; it starts at once, or after a way of the leading or following axis.
  Subject& start(const std::string& block, double ahead) {
    Subject& job = make(block);
    set_up(job, ahead);
    job.start(true);
    return job;
  }

  Subject& start(const NamedJob& named, double ahead) {
    Subject& job = make(named.block);
    set_up(job, ahead);
    if (named.mode >= 0) job.set("Mode", named.mode);
    job.start(true);
    return job;
  }

  /// A gear 1:1 that is synchronous, or is being synchronized for seconds.
  Subject& gear(const std::string& block, bool synchronous, bool position_controlled = true) {
    Subject& job = make(block);
    set_up(job, kSoon);
    if (block != "MC_CamIn") job.set("RatioNumerator", 1.0);
    if (block != "MC_GearInPos" && block != "MC_CamIn") job.set("Acceleration", synchronous ? 1000.0 : 5.0);
    if (block == "MC_GearInVelocity") job.set("PositionControlled", position_controlled ? 1.0 : 0.0);
    job.start(true);
    bench.run_until([&] { return synchronous ? job.in_effect() : fate(job) == Fate::active; }, 500);
    return job;
  }

  /// Starts a job that moves the following axis on its own.
  Subject& start_single_axis(const std::string& block) {
    Subject& job = make(block);
    for (const char* pin : {"Position", "Distance"})
      if (job.type().find_pin(pin) != nullptr) job.set(pin, 1e6);
    if (job.type().find_pin("Velocity") != nullptr) job.set("Velocity", kLeadingVelocity);
    job.start(true);
    return job;
  }

  /// The following axis is homed directly, which ends no job.
  void rehome() {
    bench.allow_position_steps(6);
    bench.home_following.Execute = true;
    bench.run(4);
    bench.home_following.Execute = false;
    bench.run(2);
  }

  /// The following axis runs so fast that a slow stop takes seconds.
  void rush() {
    bench.relative_following.Distance = 1e6;
    bench.relative_following.Execute = true;
    bench.run(50);
  }

  void set_up(Subject& job, double ahead) {
    const std::string block = job.name();
    const double leading = bench.leading.setpoint().position.value;
    const double following = bench.following.setpoint().position.value;
    if (block == "MC_GearInPos") {
      job.set("MasterStartDistance", kStartDistance);
      job.set("MasterSyncPosition", on_ring(leading + ahead + kStartDistance));
      job.set("SlaveSyncPosition", following + 10.0);
    } else if (block == "MC_CamIn") {
      job.set("MasterStartDistance", kStartDistance);
      job.set("MasterSyncPosition", on_ring(leading + ahead + kStartDistance));
      job.set("ApplicationMode", 2.0);
      job.set("SlaveOffset", following + 10.0 - on_ring(leading + ahead + kStartDistance));
    } else if (is_shift(block)) {
      job.set(block.starts_with("MC_Phasing") ? "PhaseShift" : "Offset", 5.0);
      job.set(block.starts_with("MC_Phasing") ? "PhasingDistance" : "OffsetDistance", 60.0);
      job.set("ProfileReference", ahead == kFar ? 2.0 : 1.0);
      job.set("StartPosition", on_ring(leading + ahead));
    } else if (leaves(block)) {
      job.set("MasterStopDistance", 60.0);
      job.set("SlavePosition", following + 0.5 * 60.0 + ahead);
    } else if (block == "MC_LeadingValueAdditive") {
      job.set("Position", 1.0);
    } else if (is_one_of(block, {"MC_GearIn", "MC_GearInVelocity"})) {
      job.set("RatioNumerator", 2.0);
    } else if (block == "MC_MotionInVelocity") {
      job.set("Velocity", 30.0);
    } else if (block == "MC_MotionInPosition") {
      job.set("Position", following);
    } else if (block == "MC_MoveSuperimposed") {
      job.set("Distance", 1e5);
    } else if (is_single_axis(block) && block != "MC_Halt") {
      for (const char* pin : {"Position", "Distance"})
        if (job.type().find_pin(pin) != nullptr) job.set(pin, 1e5);
      if (job.type().find_pin("Velocity") != nullptr) job.set("Velocity", 30.0);
    }
  }

  /// What the outputs of a block tell.
  static Fate fate(Subject& job) {
    if (job.error()) return Fate::failed;
    if (job.aborted()) return Fate::aborted;
    if (job.done()) return Fate::done;
    if (!job.busy()) return Fate::silent;
    if (!has_start_output(job) || job.in_effect()) return Fate::active;
    return shows(job, "Start") ? Fate::active : Fate::waits;
  }

  static constexpr double kLeadingVelocity = 20.0;  // [u/s]
  static constexpr double kStartDistance = 15.0;    // [u] of the leading axis
  static constexpr double kSoon = 2.0;              // [u] until a waiting job starts
  static constexpr double kFar = 80.0;              // [u]; within one turn of the leading axis

  Bench bench;

 private:
  static bool is_output(const Pin& pin, std::string_view prefix) {
    return pin.pin_class == PinClass::output && pin.type == Type::BOOL && pin.name.starts_with(prefix);
  }
  static bool has_start_output(Subject& job) {
    for (const Pin& pin : job.type().pins)
      if (is_output(pin, "Start")) return true;
    return false;
  }
  static bool shows(Subject& job, std::string_view prefix) {
    for (const Pin& pin : job.type().pins)
      if (is_output(pin, prefix) && job.number(pin) != 0.0) return true;
    return false;
  }
  double on_ring(double position) const { return std::fmod(position, BenchLimits::kLeadingLength); }
};

/// One way in which a job runs, and how it gets there.
struct Situation {
  const char* name;
  std::function<Subject*(Stage&)> bring_about;
  bool gear = false;                ///< a gear runs or waits, so that MC_GearOut has something to leave
  bool moves_with_leading = false;  ///< a gear runs, or will once it is synchronized
  bool cam = false;                 ///< a cam runs or waits, so that MC_CamOut has something to leave
  bool moves_with_cam = false;
  bool synchronous = false;  ///< the following axis is synchronous
  bool position_controlled = true;
  bool ended = false;                     ///< the job has ended, and holds the axis by its Execute
  double before_gear_out = Stage::kSoon;  ///< way until MC_GearOut begins: the axis has to be synchronous [u]
};

inline std::vector<Situation> stop_situations(const std::string& block) {
  const auto braking = [block](Stage& stage) {
    stage.rush();
    Subject& job = stage.make(block);
    job.set("Deceleration", 20.0);
    if (block == "MC_Stop") job.set("Mode", 3.0);
    job.start(true);
    stage.bench.run(5);
    return &job;
  };
  if (block == "MC_Halt") return {{.name = "braking", .bring_about = braking}};
  const auto held = [block](Stage& stage) {
    Subject& job = stage.make(block);
    job.start(true);
    stage.bench.run_until([&] { return job.done(); }, 500);
    return &job;
  };
  return {{.name = "braking", .bring_about = braking}, {.name = "held", .bring_about = held, .ended = true}};
}

inline std::vector<Situation> gear_situations(const std::string& block) {
  const auto gear = [block](bool synchronous, bool controlled) {
    return [=](Stage& stage) { return &stage.gear(block, synchronous, controlled); };
  };
  constexpr double kUntilSynchronous = 90.0;
  Situation synchronizing{.name = "synchronizing", .bring_about = gear(false, true)};
  Situation synchronous{.name = "synchronous", .bring_about = gear(true, true)};
  if (block == "MC_GearInVelocity") {
    Situation uncontrolled{.name = "synchronous without position control", .bring_about = gear(true, false)};
    uncontrolled.position_controlled = false;
    return {synchronizing, synchronous, uncontrolled};
  }
  for (Situation* situation : {&synchronizing, &synchronous}) {
    const bool cam = block == "MC_CamIn";
    situation->cam = situation->moves_with_cam = cam;
    situation->gear = situation->moves_with_leading = !cam;
  }
  synchronizing.before_gear_out = kUntilSynchronous;
  synchronous.synchronous = true;
  return {synchronizing, synchronous};
}

/// A job beside a gear: it waits for the leading or following axis, or acts on the gear.
inline std::vector<Situation> accompanying_situations(const NamedJob& running) {
  const std::string block = running.block;
  const auto beside = [block](bool gear, double ahead) {
    return [=](Stage& stage) {
      if (gear) stage.bench.couple_for(block);
      Subject& job = stage.start(block, ahead);
      stage.bench.run(3);
      return &job;
    };
  };
  Situation far{.name = "waiting", .bring_about = beside(true, Stage::kFar)};
  Situation near{.name = "running", .bring_about = beside(true, Stage::kSoon)};
  Situation alone{.name = "alone", .bring_about = beside(false, Stage::kFar)};
  for (Situation* situation : {&far, &near})
    situation->gear = situation->moves_with_leading = situation->synchronous = true;
  if (is_shift(block)) return {far, near};
  if (block == "MC_GearOut") return {far};
  if (block == "MC_CamOut") {
    far.cam = far.moves_with_cam = true;
    far.gear = far.moves_with_leading = false;
    return {far};
  }
  if (block == "MC_CamIn") {
    far.cam = alone.cam = true;
    Situation other{.name = "waiting beside a cam", .bring_about = [block](Stage& stage) {
                      stage.bench.couple_to_cam();
                      Subject& job = stage.start(block, Stage::kFar);
                      stage.bench.run(3);
                      return &job;
                    }};
    other.cam = other.moves_with_cam = other.synchronous = true;
    return {far, alone, other};
  }
  if (block == "MC_GearInPos") {
    alone.gear = true;
    return {far, alone};
  }
  return {near, alone};  // MC_LeadingValueAdditive
}

inline std::vector<Situation> out_situations(const std::string& block) {
  const auto leaving = [block](double profile) {
    return [block, profile](Stage& stage) {
      stage.bench.couple_for(block);
      Subject& job = stage.make(block);
      stage.set_up(job, Stage::kSoon);
      job.set("SyncProfileReference", profile);
      job.set("Deceleration", 10.0);
      job.start(true);
      stage.bench.run_until([&] { return Stage::fate(job) == Fate::active; }, 500);
      return &job;
    };
  };
  return {{.name = "with dynamics", .bring_about = leaving(0.0)},
          {.name = "over a distance", .bring_about = leaving(1.0)}};
}

/// Setpoints from the program, with and without position control.
inline std::vector<Situation> motion_in_situations(const std::string& block) {
  const auto given = [block](bool controlled) {
    return [=](Stage& stage) {
      stage.bench.allow_jumps(2);
      Subject& job = stage.make(block);
      job.set("Velocity", block == "MC_MotionInVelocity" ? 20.0 : 0.0);
      if (block == "MC_MotionInPosition")
        job.set("Position", stage.bench.following.setpoint().position.value);
      if (!controlled) job.set("PositionControlled", 0.0);
      job.start(true);
      stage.bench.run(10);
      return &job;
    };
  };
  const Situation controlled{.name = "given", .bring_about = given(true)};
  if (block == "MC_MotionInPosition") return {controlled};
  Situation uncontrolled{.name = "given without position control", .bring_about = given(false)};
  uncontrolled.position_controlled = false;
  return {controlled, uncontrolled};
}

/// On top of no motion, of a single-axis one and of a synchronous one.
inline std::vector<Situation> superimposed_situations(const std::string& block) {
  const auto on_top = [block](bool moving, bool gear) {
    return [=](Stage& stage) {
      if (gear) stage.bench.couple();
      if (moving) stage.start_single_axis("MC_MoveVelocity");
      stage.bench.run(10);
      if (block == "MC_HaltSuperimposed") {  // it needs something to halt, and time for it
        Subject& superimposed = stage.make("MC_MoveSuperimposed");
        superimposed.set("Distance", 1e5);
        superimposed.start(true);
        stage.bench.run(50);
      }
      Subject& job = stage.make(block);
      if (block == "MC_MoveSuperimposed") job.set("Distance", 1e5);
      if (block == "MC_HaltSuperimposed") job.set("Deceleration", 20.0);
      job.start(true);
      stage.bench.run(10);
      return &job;
    };
  };
  Situation gear{.name = "on a gear", .bring_about = on_top(false, true)};
  gear.gear = gear.moves_with_leading = gear.synchronous = true;
  return {{.name = "alone", .bring_about = on_top(false, false)},
          {.name = "on a motion", .bring_about = on_top(true, false)},
          gear};
}

/// Every way in which a job of the tables can run here; none: nothing that exists brings it about.
inline std::vector<Situation> situations(const NamedJob& running) {
  const std::string& block = running.block;
  if (block == "MC_Home") {
    const auto searching = [running](Stage& stage) {
      Subject& job = stage.start(running, Stage::kSoon);
      stage.bench.run(10);
      stage.rehome();  // without it, MC_MoveAbsolute ends in alarm 321
      return &job;
    };
    return {{.name = "searching", .bring_about = searching}};
  }
  if (is_one_of(block, {"MC_Halt", "MC_Stop"})) return stop_situations(block);
  if (is_single_axis(block)) {
    const auto moving = [block](Stage& stage) {
      Subject& job = stage.start_single_axis(block);
      stage.bench.run(10);
      return &job;
    };
    return {{.name = "moving", .bring_about = moving}};
  }
  if (block.starts_with("MC_MotionIn") && !is_superimposed(block)) return motion_in_situations(block);
  if (is_superimposed(block)) return superimposed_situations(block);
  if (is_one_of(block, {"MC_GearIn", "MC_GearInVelocity"})) return gear_situations(block);
  if (is_one_of(block, {"MC_GearInPos", "MC_CamIn"}) && running.state == "active")
    return gear_situations(block);
  if (leaves(block) && running.state == "active") return out_situations(block);
  if (is_shift(block) || leaves(block) ||
      is_one_of(block, {"MC_GearInPos", "MC_CamIn", "MC_LeadingValueAdditive"}))
    return accompanying_situations(running);
  return {};
}

}  // namespace lockstep::test
