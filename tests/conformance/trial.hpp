/// One run of a block on the bench, what it needs that its pins do not tell, and the table of all runs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/conformance/bench.hpp"

namespace lockstep::test {

// ---- What cannot be generated
// -----------------------------------------------------------------------------------

// Inputs with which a block has something to do on the bench. A pin that a block does not have is left out.
struct Setting {
  const char* block;
  const char* pin;
  double value;
};
inline constexpr Setting kSettings[] = {
    {"MC_MoveAbsolute", "Position", 60.0},
    {"MC_WriteParameter", "ParameterNumber", 1000.0},
    {"MC_MoveRelative", "Distance", 60.0},
    {"MC_MoveVelocity", "Velocity", 120.0},
    {"MC_MoveJog", "Velocity", 120.0},
    {"MC_Home", "Position", 10.0},
    {"MC_GearIn", "RatioNumerator", -1.0},
    {"MC_GearInPos", "MasterSyncPosition", 50.0},
    {"MC_GearInPos", "MasterStartDistance", 30.0},
    {"MC_PhasingAbsolute", "PhaseShift", 10.0},
    {"MC_PhasingRelative", "PhaseShift", 10.0},
    {"MC_PhasingAbsolute", "PhasingDistance", 40.0},
    {"MC_PhasingRelative", "PhasingDistance", 40.0},
    {"MC_OffsetAbsolute", "Offset", 10.0},
    {"MC_OffsetRelative", "Offset", 10.0},
    {"MC_OffsetAbsolute", "OffsetDistance", 40.0},
    {"MC_OffsetRelative", "OffsetDistance", 40.0},
    {"MC_MotionInVelocity", "Velocity", 50.0},
    {"MC_MoveSuperimposed", "Distance", 60.0},
    {"MC_GearOut", "SlavePosition", 300.0},
    {"MC_GearOut", "MasterStopDistance", 50.0},
    {"MC_CamIn", "MasterSyncPosition", 50.0},
    {"MC_CamIn", "MasterStartDistance", 30.0},
    {"MC_CamIn", "ApplicationMode", 1.0},
    {"MC_CopyCamData", "NumberOfPoints", 1.0},
    {"MC_CopyCamData", "NumberOfSegments", 1.0},
    {"MC_CamOut", "SlavePosition", 300.0},
    {"MC_CamOut", "MasterStopDistance", 50.0},
    {"MC_OutputCam", "OnPosition", 20.0},
    {"MC_OutputCam", "OffPosition", 40.0},
};
// Blocks that act on an axis which moves.
inline const std::set<std::string_view> kOnMovingAxis = {"MC_Halt", "MC_Stop"};
// Blocks that act on what is superimposed on the motion of an axis.
inline const std::set<std::string_view> kOnSuperimposedMotion = {"MC_HaltSuperimposed"};
// Blocks that act on an axis which is coupled.
inline const std::set<std::string_view> kOnCoupledAxis = {
    "MC_PhasingAbsolute", "MC_PhasingRelative", "MC_OffsetAbsolute",       "MC_OffsetRelative",
    "MC_GearOut",         "MC_CamOut",          "MC_LeadingValueAdditive", "MC_SynchronizedMotionSimulation"};
// Blocks whose inputs are the setpoints themselves, without profile or limits, so that these may jump.
inline const std::set<std::string_view> kGivesSetpoints = {"MC_MotionInSuperimposed", "MC_MotionInVelocity",
                                                           "MC_MotionInPosition"};
// Blocks that also act on a disabled axis.
inline const std::set<std::string_view> kOnDisabledAxis = {
    "MC_Home",           "MC_Reset",          "MC_SetSensor",          "MC_SetAxisSTW",
    "MC_WriteParameter", "MC_InterpolateCam", "MC_GetCamLeadingValue", "MC_GetCamFollowingValue",
    "MC_CopyCamData"};
// Blocks that act on a drive.
inline const std::set<std::string_view> kOnDrive = {
    "MC_TorqueLimiting", "MC_TorqueRange", "MC_TorqueAdditive", "MC_SetAxisSTW", "MC_WriteParameter"};
// Blocks that rename positions, so that these may step.
inline const std::set<std::string_view> kRenamesPositions = {"MC_Home", "MC_Reset"};
// Published values that are not supported and are refused with the error of their pin.
struct Unsupported {
  const char* block;
  const char* pin;
  std::set<double> values;
};
inline const std::vector<Unsupported> kUnsupported;  // none
// Permitted values that do not go together with the default of another pin.
inline const std::vector<Unsupported> kUnfit = {{"MC_TorqueRange", "UpperLimit", {-1e12}},
                                                {"MC_TorqueRange", "LowerLimit", {1e12}},
                                                {"MC_SetSensor", "Mode", {3}}};

// ---- The table of results
// ---------------------------------------------------------------------------------------

inline constexpr std::array<const char*, 7> kChecks = {"ends once", "values",     "disabled",  "retriggered",
                                                       "unwired",   "other jobs", "allocation"};

struct Count {
  int runs = 0;
  int failed = 0;
};

class Table : public testing::Environment {
 public:
  static Count& at(const BlockType& type, const char* check) {
    return counts()[{std::string(type.name), check}];
  }
  void TearDown() override {
    if (counts().empty()) return;
    std::printf("\n%-18s", "runs per check");
    for (const char* check : kChecks) std::printf("%14s", check);
    std::printf("\n");
    for (const BlockType& type : block_types()) print(type);
  }

 private:
  static std::map<std::pair<std::string, std::string>, Count>& counts() {
    static std::map<std::pair<std::string, std::string>, Count> all;
    return all;
  }
  static void print(const BlockType& type) {
    std::printf("%-18s", std::string(type.name).c_str());
    for (const char* check : kChecks) {
      const auto found = counts().find({std::string(type.name), check});
      std::string cell = "-";
      if (found != counts().end() && found->second.failed == 0)
        cell = std::to_string(found->second.runs);
      else if (found != counts().end())
        cell = std::to_string(found->second.failed) + " FAILED";
      std::printf("%14s", cell.c_str());
    }
    std::printf("\n");
  }
};

// ---- One run
// ----------------------------------------------------------------------------------------------------

inline void apply_settings(Subject& subject) {
  for (const Setting& setting : kSettings)
    if (subject.type().name == setting.block) subject.set(setting.pin, setting.value);
}

/// More ticks than any trial has.
inline constexpr int kTicksOfATrial = 1'000'000;

/// A bench with the block under test on it, ready to be started.
struct Trial {
  Trial(const BlockType& type, const char* check_name, bool modulo = false, bool enabled = true)
      : subject_type(type),
        check(check_name),
        bench(modulo, enabled && type.name != "MC_Power", kOnDrive.contains(type.name)) {
    subject = &bench.add(type);
    apply_settings(*subject);
    if (kRenamesPositions.contains(type.name)) bench.allow_position_steps(kTicksOfATrial);
    if (kGivesSetpoints.contains(type.name)) bench.allow_jumps(kTicksOfATrial);
    if (subject->powers() && enabled) subject->start(true);
    bench.ready();
    if (enabled && kOnCoupledAxis.contains(type.name)) bench.couple_for(type.name);
    if (enabled && kOnMovingAxis.contains(type.name)) {
      bench.relative_following.Distance = 1e6;
      bench.relative_following.Execute = true;
      bench.run(15);
      bench.relative_following.Execute = false;
    }
    if (enabled && kOnSuperimposedMotion.contains(type.name)) {
      bench.superimposed_following.Distance = 1e6;
      bench.superimposed_following.Execute = true;
      bench.run(15);
      bench.superimposed_following.Execute = false;
    }
  }
  ~Trial() {
    if (bench.allocations != 0) bench.fault("memory was allocated or released in the cycle");
    Count& count = Table::at(subject_type, check);
    ++count.runs;
    if (!bench.first_fault.empty()) ++count.failed;
    EXPECT_EQ(bench.first_fault, "") << subject_type.name << ", " << check << ": " << what;
    Count& allocation = Table::at(subject_type, "allocation");
    ++allocation.runs;
    if (bench.allocations != 0) ++allocation.failed;
  }

  /// The axis can be brought to rest, acknowledged and used again, and ends disabled at rest.
  void leave_in_order() {
    Subject& s = *subject;
    for (const Pin& pin : s.type().pins)
      if (pin.pin_class == PinClass::input && pin.type == Type::BOOL && pin.name != "PositionControlled")
        s.store(pin, 0.0);
    restore_defaults();
    const auto enable = [&](bool on) {
      if (s.powers())
        s.start(on);
      else
        bench.power_following.Enable = on;
    };
    enable(false);
    if (!bench.run_until([&] { return bench.following.off(); }, kStoppingTicks)) {
      // A ratio of 2^31 leaves an axis at a velocity from which no ramp brakes it in this time.
      if (!bench.brakes_for_long()) bench.fault("the axis does not stop when it is disabled");
      return;
    }
    bench.run(2);
    if (s.busy() && s.acts_on_axis()) return bench.fault(s.name() + " is Busy on a disabled axis");
    bench.reset_following.Execute = true;
    bench.run(3);
    if (!bench.reset_following.Done) return bench.fault("the axis cannot be acknowledged");
    bench.reset_following.Execute = false;
    enable(true);
    bench.run(3);
    if (!bench.following.enabled()) return bench.fault("the axis cannot be enabled again");
    // Away from the end of the numeric range, where homing may have put the axis.
    bench.relative_following.Distance = bench.following.data.Position > 0.0 ? -1.0 : 1.0;
    bench.relative_following.Execute = false;
    bench.run(2);
    bench.relative_following.Execute = true;
    if (!bench.run_until([&] { return bench.relative_following.Done; }, 500))
      return bench.fault("the axis cannot be used again");
    bench.relative_following.Execute = false;
    enable(false);
    bench.run(20);
    if (!bench.following.off() || bench.following.data.Velocity != 0.0 ||
        !has_bit(bench.following.data.StatusWord, StatusBit::Standstill))
      bench.fault("the disabled axis does not stand");
  }

  void restore_defaults() {
    Subject fresh(subject->type());
    for (const Pin& pin : subject->type().pins)
      if (pin.pin_class == PinClass::input && pin.type < Type::AXIS && pin.type != Type::BOOL)
        subject->store(pin, fresh.number(pin));
  }

  const BlockType& subject_type;
  const char* check;
  std::string what;  // of this run, for the message
  Bench bench;
  Subject* subject = nullptr;
};

}  // namespace lockstep::test
