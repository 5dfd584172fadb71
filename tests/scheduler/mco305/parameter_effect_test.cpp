// Each parameter that is declared changes something that can be observed, or says that it does not.
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep::parameter_effect_test {
namespace {

using Settings = std::vector<std::pair<std::string, double>>;

/// How a parameter is looked at: two runs that differ in its value alone.
struct Look {
  std::string number;
  double value;  ///< beside its start value, or that of `given`
  std::string program;
  Settings given{};
  bool drive = false;
  int stops_at = -1;  ///< [Esc] from the panel in this millisecond
};

/// All that a device shows in a run: positions, errors, flags, outputs, latches; no read-out of a parameter.
class Shown : public DeviceRun {
 public:
  Shown(const Look& look, const Settings& more) : stops_at_(look.stops_at) {
    if (look.drive) {
      object.settings.has_drive = true;
      object.settings.drive.time_constant = 0.01;
      object.settings.drive.faults = {.drive = &fault_, .encoder = &encoder_, .blocked = &blocked_};
    }
    object.settings.drive.signals.reference_cam = PositionRange{5000.0, 6000.0};
    if (look.drive) object.settings.drive.signals.zero_marks = ZeroMarks{.position = 700.0, .period = 2000.0};
    object.settings.markers = {.position = 300.0, .period = 4040.0, .noise = 20.0};
    object.settings.master_marks = {.position = 700.0, .period = 4000.0, .noise = 30.0};
    object.settings.faults.supply = &fault_;
    object.settings.faults.master_encoder = &encoder_;
    object.settings.faults.encoder_counts = &disturbed_;
    object.settings.faults.master_encoder_counts = &disturbed_;
    object.master.signal = &turned_;
    for (const auto& [name, value] : kUsual) set(name, value);
    for (const auto& [name, value] : look.given) set(name, value);
    for (const auto& [name, value] : more) set(name, value);
    add_program(look.program +
                "\nwait:\nDELAY 1\nGOTO wait\nSUBMAINPROG\nSUBPROG trouble\nn = n + 1\nDELAY "
                "300\nERRCLR\nRETURN\nENDPROG\n");
    add_program("OUT 8 1\nDELAY 500\nOUT 7 1\n", 3, false);
    begin();
  }
  std::vector<double> all(int milliseconds) {
    std::vector<double> shown;
    auto& device = object.device();
    for (int i = 0; i < milliseconds; ++i) {
      happen(i);
      if (i == stops_at_) ++object.data.Outside.Stops;
      step();
      for (const double one : {device.set_position(),
                               device.machine_position(),
                               device.actual_units() * 1.0,
                               device.following_error() * 1.0,
                               device.velocity_units() * 1.0,
                               device.sync_error() * 1.0,
                               device.sync_status() * 1.0,
                               device.master().shown() * 1.0,
                               device.master().shown_latch() * 1.0,
                               device.latched_units() * 1.0,
                               device.latches() * 1.0,
                               device.io().output_byte() * 1.0,
                               device.io().input_word() * 1.0,
                               device.controlled() * 1.0,
                               device.moving() * 1.0,
                               device.arrived() * 1.0,
                               device.axis_end() * 1.0,
                               object.machine().error() * 1.0,
                               device.pending().any() * 1.0,
                               device.reference() * 1.0,
                               system_variable(4102) * 1.0,
                               system_variable(4103) * 1.0,
                               system_variable(16) * 1.0,
                               system_variable(4120) * 1.0,
                               system_variable(4126) * 1.0,
                               system_variable(4240) * 1.0,
                               system_variable(4244) * 1.0,
                               system_variable(4128) * 1.0})
        shown.push_back(one);
    }
    return shown;
  }

 private:
  static inline const Settings kUsual = {{"ENCODER", 500}, {"MENCODER", 500}, {"VELMAX", 3000},
                                         {"RAMPMIN", 0.5}, {"FFVEL", 9000},   {"KPROP", 200}};
  /// Inputs come and go, something goes wrong for a while, the master speeds up, goes, reverses.
  void happen(int i) {
    const int speed = i < 1500 ? 20 : i < 2200 ? 30 : i < 2600 ? -20 : 20;
    if (i > 100) turned_ += speed;
    if (i % 400 == 200)
      for (std::size_t input = 1; input <= 12; ++input) object.device().io().set_input(input, i % 800 == 200);
    blocked_ = i > 600 && i < 900;
    fault_ = encoder_ = i > 1700 && i < 1800;
    if (i == 1000) disturbed_ = 700;
    if (i == 1001) disturbed_ = 0;
  }
  int stops_at_;
  DINT turned_ = 0, disturbed_ = 0;
  bool blocked_ = false, encoder_ = false, fault_ = false;
};

const std::string kPositions =
    "VEL 60\nACC 60\nDEC 50\nON ERROR GOSUB trouble\nn = 0\nPOSA 20000\nPOSA 1500\n";
const std::string kRuns = "VEL 60\nACC 60\nDEC 50\nON ERROR GOSUB trouble\nn = 0\nCVEL 30\nCSTART\n";
const std::string kPlain = "ON ERROR GOSUB trouble\nn = 0\nPOSA 20000\nPOSA 1500\n";
const std::string kHomes = "ON ERROR GOSUB trouble\nn = 0\nHOME\n";
const std::string kByPosition =
    "VEL 100\nACC 100\nDEC 100\nDELAY 300\nSYNCP\nDELAY 300\nMOVESYNCORIGIN 500\n";
const std::string kByMarkers = "VEL 100\nACC 100\nDEC 100\nDELAY 300\nSYNCM\n";
const Settings kMarkers = {{"SYNCMTYPM", 2},   {"SYNCMTYPS", 2},   {"SYNCMPULSM", 4000}, {"SYNCMPULSS", 4040},
                           {"SYNCMWINM", 400}, {"SYNCMWINS", 400}, {"SYNCFACTM", 100},   {"SYNCFACTS", 101}};

Settings with(Settings all, const Settings& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<Look> looks() {
  const Settings filtered = with(kMarkers, {{"SYNCMFTIME", 300}, {"SYNCOFFTIME", 400}});
  const Settings limited = {{"RAMPTYPE", 2}, {"JERKMIN", 100}};
  const Settings home = {{"33-50", 1}, {"HOME_VEL", 20}, {"HOME_RAMP", 50}};
  std::vector<Look> all = {

      {"32-01", 1000, kPositions},
      {"32-02", 4, kPositions, {}, true},
      {"32-03", 1000, kPositions, {{"ENCODERABSTYPE", 5}}, true},
      {"32-05", 8, kPositions, {{"ENCODERABSTYPE", 4}}, true},
      {"32-06", 10, kPositions},
      {"32-09", 1, kRuns, {}, true},
      {"32-10", 2, kPositions, {}, true},
      {"32-11", 3, kPositions},
      {"32-12", 3, kPositions},
      {"32-30", 0, kByPosition},
      {"32-31", 1000, kByPosition},
      {"32-32", 4, kByPosition},
      {"32-33", 100, kByPosition, {{"MENCODERABSTYPE", 5}}},
      {"32-35", 9, kByPosition, {{"MENCODERABSTYPE", 4}}},
      {"32-39", 1, kByPosition},
      {"32-60", 400, kPositions, {}, true},
      {"32-61", 50, kPositions, {}, true},
      {"32-62", 20, kPositions, {}, true},
      {"32-63", 10, kPositions, {{"KINT", 200}}, true},
      {"32-64", 10, kPositions, {}, true},
      {"32-65", 5000, kPositions, {}, true},
      {"32-66", 5000, kPositions, {}, true},
      {"32-67", 1000, kRuns, {}, true},
      {"32-68", 2, kByPosition},
      {"32-69", 5, kPositions, {}, true},
      {"32-70", 5, kPositions, {}, true},
      {"32-71", 3000, kPositions, {{"REGWMIN", 500}}, true},
      {"32-72", 500, kPositions, {{"REGWMAX", 3000}}, true},
      {"32-73", 100, kPositions, {{"KINT", 200}}, true},
      {"32-74", 200, kRuns, {{"POSERR", 1000}}, true},
      {"32-80", 1500, kPositions},
      {"32-81", 1, kPositions},
      {"32-82", 1, kPositions},
      {"32-83", 200, kPositions},
      {"32-84", 20, kPlain},
      {"32-85", 20, kPlain},
      {"32-86", 200, kPositions, limited},
      {"32-87", 200, kPositions, limited},
      {"32-88", 200, kPositions, limited},
      {"32-89", 200, kPositions, limited},
      {"33-00", 1, kPositions},
      {"33-01", 700, kHomes, home, true},
      {"33-02", 20, kHomes, home, true},
      {"33-03", 30, kHomes, home, true},
      {"33-04", 1, kHomes, home, true},
      {"33-10", 3, kByPosition},
      {"33-11", 3, kByPosition},
      {"33-12", 500, kByPosition},
      {"33-13", 3, kByPosition},
      {"33-14", 3, kByPosition},
      {"33-15", 2, kByMarkers, kMarkers},
      {"33-16", 2, kByMarkers, kMarkers},
      {"33-17", 5000, kByMarkers, kMarkers},
      {"33-18", 5000, kByMarkers, kMarkers},
      {"33-19", 0, kByMarkers, kMarkers},
      {"33-20", 0, kByMarkers, kMarkers},
      {"33-21", 5, kByMarkers, kMarkers},
      {"33-22", 5, kByMarkers, kMarkers},
      {"33-23", 1, kByMarkers, kMarkers},
      {"33-24", 1, kByMarkers, with(kMarkers, {{"SYNCACCURACY", 1}})},
      {"33-25", 5, kByMarkers, kMarkers},
      {"33-26", 5000, "VEL 100\nACC 100\nDEC 100\nDELAY 300\nSYNCV\n"},
      {"33-27", 700, kByPosition},
      {"33-28", 2, kByMarkers, filtered},
      {"33-29", 100, kByMarkers, kMarkers},
      {"33-30", 3, kByMarkers, kMarkers},
      {"33-31", 1, kByPosition},
      {"33-32", 500, kByPosition},
      {"33-33", 10, kByPosition, {{"SYNCVFTIME", -50000}}},
      {"33-40", 1, kRuns, {{"33-50", 5}}},
      {"33-41", -200, "VEL 60\nON ERROR GOSUB trouble\nn = 0\nCVEL (-30)\nCSTART\n", {{"SWNEGLIMACT", 1}}},
      {"33-42", 200, kRuns, {{"SWPOSLIMACT", 1}}},
      {"33-43", 1, "VEL 60\nON ERROR GOSUB trouble\nn = 0\nCVEL (-30)\nCSTART\n", {{"NEGLIMIT", -200}}},
      {"33-44", 1, kRuns, {{"POSLIMIT", 200}}},
      {"33-45", 10, kPositions, {{"TESTWIN", 2000}, {"TESTVAL", 50}}, true},
      {"33-46", 100, kPositions, {{"TESTWIN", 2000}, {"TESTTIM", 10}}, true},
      {"33-47", 2, kPositions, {{"TESTTIM", 5}}, true},
      {"33-60", 0, "OUT 1 1\n"},
      {"33-61", 5, kRuns, {{"IOMODE", 0}}},
      {"33-62", 5, kRuns, {{"IOMODE", 0}}},
      {"33-80", 3, "n = 0\nDELAY 100\nEXIT\n"},
      {"33-81", 0, kPositions},
      {"33-82", 0, kRuns, {}, true},
      {"33-83", 2, kRuns, {{"33-50", 5}}},
      {"33-84", 2, kRuns, {}, false, 1000},
      {"33-85", 1, kRuns},
  };
  for (int i = 0; i < 10; ++i) all.push_back({"33-" + std::to_string(50 + i), 5, kRuns});
  for (int i = 0; i < 8; ++i) all.push_back({"33-" + std::to_string(63 + i), 1, kRuns});
  return all;
}

TEST(Mco305ParameterEffects, AreSeenOfEachThatHasOne) {
  std::set<std::int32_t> seen;
  for (const Look& look : looks()) {
    const auto number = aposs::parameter_of(look.number);
    ASSERT_TRUE(number) << look.number;
    seen.insert(*number);
    constexpr int kTime = 3500;
    const std::vector<double> one = Shown(look, {}).all(kTime);
    EXPECT_EQ(one, Shown(look, {}).all(kTime)) << look.number << ": the same again is the same";
    EXPECT_NE(one, Shown(look, {{look.number, look.value}}).all(kTime)) << look.number << " changes nothing";
  }
  // Of what is not looked at here others tell: ENCODERTYPE, ENCCONTROL and MENCCONTROL
  // Mco305Features.EncodersChangePlacesByTheirTypesHardOrSoft, read-outs
  // Mco305Features, process data ProcessData.
  const std::set<std::int32_t> told_elsewhere = {3200, 3213, 3243};
  for (const mco305::Parameter& of : mco305::parameters()) {
    if (mco305::is_read_out(of.number) || told_elsewhere.contains(of.number)) continue;
    EXPECT_EQ(seen.contains(of.number), of.effective)
        << of.number << (of.effective ? ": nobody looks at it" : ": is said to have no effect");
  }
}

// And what is said to have none has none, whatever happens.
TEST(Mco305ParameterEffects, AreNoneOfThoseThatSaySo) {
  const std::pair<std::string, Settings> runs[] = {{kPositions, {}}, {kByMarkers, kMarkers}};
  for (const mco305::Parameter& of : mco305::parameters()) {
    if (of.effective || of.decimals != 0) continue;
    for (const auto& [program, given] : runs) {
      const std::string number = aposs::parameter_text(of.number);
      const Look look{number, 0.0, program, given, true};
      const double other = of.start == of.highest ? of.lowest : of.highest;
      EXPECT_EQ(Shown(look, {}).all(800), Shown(look, {{number, other}}).all(800)) << number;
    }
  }
}

}  // namespace
}  // namespace lockstep::parameter_effect_test
