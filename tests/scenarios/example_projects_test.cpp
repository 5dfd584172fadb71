// The example projects: their traces stay what they were, and mean what their READMEs say.
// LOCKSTEP_UPDATE=1 renews the stored traces.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <string>

#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::example_projects_test {
namespace {

// ---- Stored traces
// -------------------------------------------------------------------------------------------

struct Stored {
  const char* project;
  const char* duration;
  std::size_t every;  // of the rows is stored
};

bool ends_with(const std::string& name, const std::string& end) {
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

/// How far a value may be from the stored one; the runs themselves are identical to the bit.
double tolerance(const std::string& name) {
  for (const char* position :
       {"Position", ".SetPoint", ".FollowingError", ".MeasuredValue1", ".PhaseShift", "error", "off", "laid"})
    if (ends_with(name, position)) return 1e-6;
  if (ends_with(name, "Velocity")) return 1e-5;
  if (ends_with(name, ".Acceleration")) return 1e-3;
  if (ends_with(name, ".ActualTorque") || ends_with(name, ".DemandCurrent")) return 1e-4;
  return 0.0;
}

/// Length of the ring on which a column of an example goes round, as its Modulo says; none: a line, or no
/// position.
std::optional<double> ring(const char* project, const std::string& column) {
  if (!ends_with(column, "Position")) return std::nullopt;
  const Json objects = example_json(project)["technology_objects"];
  const Json object = objects.value(column.substr(0, column.find('.')), Json::object());
  const Json modulo = object.value("config", Json::object()).value("Modulo", Json::object());
  if (!modulo.value("Enable", false)) return std::nullopt;
  return modulo.value("Length", 360.0);
}

void renew(const std::string& path, const std::string& trace, std::size_t every) {
  std::ifstream from(trace);
  std::ofstream to(path);
  std::string line;
  for (std::size_t i = 0; std::getline(from, line); ++i)
    if (i == 0 || (i - 1) % every == 0) to << line << '\n';
}

class StoredTrace : public testing::TestWithParam<Stored> {};

TEST_P(StoredTrace, IsRepeatedWithinATolerancePerColumn) {
  const Stored& stored = GetParam();
  const Directory directory;
  const std::string trace = directory.file("trace.csv");
  const Ended ended = lockstep(
      {"run", example(stored.project), "--simulate", "--duration", stored.duration, "--trace", trace});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const std::string path = std::string(LOCKSTEP_TEST_DATA "/scenario_") + stored.project + ".csv";
  if (std::getenv("LOCKSTEP_UPDATE") != nullptr) renew(path, trace, stored.every);
  EXPECT_LT(std::filesystem::file_size(path), 100'000u);
  const CsvTable before = read_csv(path);
  const CsvTable now = read_csv(trace);
  ASSERT_EQ(now.names, before.names);
  ASSERT_EQ((now.rows + stored.every - 1) / stored.every, before.rows);
  for (std::size_t column = 0; column < now.names.size(); ++column) {
    const std::string& name = now.names[column];
    const auto length = ring(stored.project, name);
    for (std::size_t row = 0; row < before.rows; ++row) {
      const double is = now.columns[column][row * stored.every];
      const double was = before.columns[column][row];
      const double distance = length ? ring_distance(is, was, *length) : is - was;
      ASSERT_LE(std::abs(distance), tolerance(name))
          << name << " at " << before["t"][row] << ": " << is << ", stored " << was;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Examples, StoredTrace,
    testing::Values(Stored{"01_positioning", "5s", 25}, Stored{"02_rotary_knife", "5s", 20},
                    Stored{"03_line_shaft", "5s", 25}, Stored{"04_cross_cutter", "5s", 25},
                    Stored{"05_press_feeder", "8s", 40}, Stored{"06_encoder_conveyor", "8s", 25},
                    Stored{"07_emergency_door", "16s", 40}, Stored{"08_filling_line", "11s", 40},
                    Stored{"09_flying_saw", "12s", 40}, Stored{"10_fixed_stop", "16s", 40},
                    Stored{"11_pick_and_place", "8s", 40}, Stored{"14_twelve_stations", "7s", 50},
                    Stored{"20_bottle_palletizer", "20s", 40}, Stored{"21_suitcase_conveyor", "16s", 20},
                    Stored{"22_teddy_packaging", "22s", 50}, Stored{"29_bottle_filler", "22s", 100},
                    Stored{"24_brake", "4s", 10}, Stored{"26_linear_motor", "7s", 25},
                    Stored{"27_lid", "5s", 25}, Stored{"28_press", "2500ms", 10}),
    [](const auto& stored) { return std::string(stored.param.project); });

// ---- Meaning
// -------------------------------------------------------------------------------------------------

/// No position steps by more than its velocity allows, and no velocity by more than `acceleration` allows.
void expect_smooth(const char* project, const CsvTable& table, const std::string& axis, double velocity,
                   double acceleration) {
  const auto& position = table[axis + ".Position"];
  const auto& speed = table[axis + ".Velocity"];
  const auto length = ring(project, axis + ".Position");
  const double period = table["t"][1] - table["t"][0];
  for (std::size_t i = 1; i < table.rows; ++i) {
    const double step = position[i] - position[i - 1];
    const double distance = length ? ring_distance(position[i], position[i - 1], *length) : step;
    ASSERT_LE(std::abs(speed[i]), velocity * (1 + 1e-12)) << axis << " at " << table["t"][i];
    ASSERT_LE(std::abs(speed[i] - speed[i - 1]), acceleration * period * (1 + 1e-9) + 1e-9)
        << axis << " at " << table["t"][i];
    ASSERT_NEAR(distance, 0.5 * (speed[i] + speed[i - 1]) * period, acceleration * period * period + 1e-9)
        << axis << " at " << table["t"][i];
  }
}

void expect_never(const CsvTable& table, const std::string& name) {
  EXPECT_EQ(table.first(name, 1.0), table.rows) << name;
}

TEST(Positioning, LaysThreePartsDownAndHaltsWhereTheSensorSeesTheNextRoundAfterRound) {
  const CsvTable table = simulate(example("01_positioning"), "120s",
                                  {"--signals",
                                   "Slide.Position,Slide.Velocity,Slide.ActualPosition,step,laid,"
                                   "rounds,alarm,sensor,lay_down.Done,halt.Done,lay_down.Error"});
  expect_never(table, "alarm");
  expect_never(table, "lay_down.Error");
  EXPECT_GE(table["rounds"].back(), 20.0);
  expect_smooth("01_positioning", table, "Slide", 400.0, 5000.0);
  std::size_t laid = 0;
  std::size_t halted = 0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["lay_down.Done"][i] > table["lay_down.Done"][i - 1]) {
      EXPECT_NEAR(table["Slide.Position"][i], 560.0 - 80.0 * table["laid"][i], 1e-9);
      EXPECT_EQ(table["Slide.Velocity"][i], 0.0);
      ++laid;
    }
    if (table["halt.Done"][i] > table["halt.Done"][i - 1]) {
      EXPECT_EQ(table["Slide.Velocity"][i], 0.0);
      EXPECT_LT(table["Slide.Position"][i], 130.0);
      EXPECT_GT(table["Slide.Position"][i], 95.0) << "it takes its way to brake from 200 mm/s";
      ++halted;
    }
  }
  EXPECT_GE(laid, 60u);
  EXPECT_GE(halted, 20u);
}

TEST(PickAndPlace, LaysEveryPartDownWhereItBelongsAlthoughTheTrayHasGrown) {
  const CsvTable table = simulate(example("11_pick_and_place"), "29s",
                                  {"--signals",
                                   "X.Position,X.Velocity,Z.Position,Z.Velocity,off,laid,placed,part,alarm,"
                                   "X.ActualPosition,grip,ready"});
  expect_never(table, "alarm");
  expect_smooth("11_pick_and_place", table, "Z", 600.0, 10000.0);
  EXPECT_GE(table["placed"].back(), 10.0);
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["placed"][i] == table["placed"][i - 1]) continue;
    const double part = table["part"][i - 1];
    EXPECT_NEAR(table["off"][i], 0.7 * part, 1e-6);
    EXPECT_NEAR(table["laid"][i], 600.0, 0.011) << "within the positioning window";
    EXPECT_NEAR(table["X.ActualPosition"][i], 600.0 - 0.7 * part, 0.011);
  }
}

TEST(PickAndPlace, WithoutCorrectionThePartsLieBesideTheirPlace) {
  Json project = example_json("11_pick_and_place");
  project["tags"]["correct"]["init"] = false;
  const CsvTable table = simulate(project, "12s", "off,laid,placed,part");
  std::size_t beside = 0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["placed"][i] == table["placed"][i - 1]) continue;
    EXPECT_NEAR(table["laid"][i], 600.0 + 0.7 * table["part"][i - 1], 0.011);
    if (table["part"][i - 1] > 0.0) ++beside;
  }
  EXPECT_GE(beside, 2u);
}

TEST(PickAndPlace, AMissingPartStopsTheGantryUntilItIsReset) {
  Json project = example_json("11_pick_and_place");
  project["technology_objects"]["Eye"]["marks"]["period"] = 103.5;
  project["stimuli"].push_back(stimulus("20s", "reset", true));
  project["stimuli"].push_back(stimulus("20.1s", "reset", false));
  const CsvTable table =
      simulate(project, "22s", "alarm,placed,start,step,Eye.ErrorDetail.Number,measure.ErrorID");
  const std::size_t raised = table.first("alarm", 1.0);
  ASSERT_LT(raised, table.rows);
  EXPECT_EQ(table["Eye.ErrorDetail.Number"][raised], 752.0);
  EXPECT_EQ(table["placed"][raised], 3.0);
  EXPECT_EQ(table["start"][raised], 0.0);
  EXPECT_EQ(table["alarm"].back(), 0.0);
  EXPECT_EQ(table["step"].back(), 10.0);
}

TEST(Positioning, AnAlarmTakesStartBackAndAResetMakesItReadyAgain) {
  Json project = example_json("01_positioning");
  Json& slide = project["technology_objects"]["Slide"];
  slide["drive"]["time_constant"] = "40ms";
  slide["config"]["PositioningMonitoring"] = {{"Window", 0.0001}, {"ToleranceTime", 0.5}};
  project["stimuli"] = {stimulus("4s", "reset", true), stimulus("5s", "start", true)};
  const CsvTable table =
      simulate(project, "6s", "alarm,start,step,Slide.ErrorDetail.Number,Slide.StatusWord.X0");
  const std::size_t raised = table.first("alarm", 1.0);
  ASSERT_LT(raised, table.rows);
  EXPECT_EQ(table["Slide.ErrorDetail.Number"][raised], 541.0);
  EXPECT_EQ(table["start"][raised], 0.0);
  EXPECT_EQ(table["step"][raised], 99.0);
  const std::size_t ready = table.first("step", 10.0, raised);
  ASSERT_LT(ready, table.rows);
  EXPECT_NEAR(table["t"][ready], 4.0, 0.05);
  EXPECT_EQ(table["alarm"][ready], 0.0);
  EXPECT_NEAR(table["t"][table.first("step", 20.0, ready)], 5.0, 0.05) << "it runs again";
}

/// Every row in which the knife says that it is synchronous; gives their number.
std::size_t expect_synchronous_function(const CsvTable& table) {
  std::size_t synchronous = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < table.rows; ++i) {
    if (table["gear.InSync"][i] == 0.0) continue;
    const double function = 90.0 + 1.5 * (table["Conveyor.Position"][i] - 60.0);
    largest = std::max(largest, std::abs(ring_distance(table["Knife.Position"][i], function, 360.0)));
    EXPECT_EQ(table["Knife.Velocity"][i], 1.5 * table["Conveyor.Velocity"][i]) << table["t"][i];
    ++synchronous;
  }
  EXPECT_LT(largest, 1e-9);
  return synchronous;
}

TEST(RotaryKnifeTrace, InSyncMeansThatTheKnifeIsWhereTheSynchronousFunctionSays) {
  const CsvTable table = simulate(example("02_rotary_knife"), "60s");
  EXPECT_GT(expect_synchronous_function(table), table.rows * 3 / 4);
  expect_smooth("02_rotary_knife", table, "Conveyor", 300.0, 400.0);
  expect_smooth("02_rotary_knife", table, "Knife", 450.0 * 1.02, 5000.0);
}

TEST(RotaryKnifeTrace, WaitsSynchronizesAndIsSynchronousAfterEveryStartAndParksAfterEveryStop) {
  const CsvTable table = simulate(example("02_rotary_knife"), "60s",
                                  {"--signals",
                                   "start,waiting,gear.StartSync,gear.InSync,alarm,gear.Error,"
                                   "park.Done,Knife.Position,Conveyor.Velocity,cuts"});
  expect_never(table, "alarm");
  expect_never(table, "gear.Error");
  std::size_t row = 0;
  for (int start = 0; start < 2; ++start) {
    row = table.first("start", 1.0, row);
    for (const char* phase : {"waiting", "gear.StartSync", "gear.InSync"}) {
      const std::size_t next = table.first(phase, 1.0, row);
      ASSERT_LT(next, table.rows) << phase << " after start " << start;
      row = next;
    }
    if (start == 1) break;
    row = table.first("start", 0.0, row);
    row = table.first("park.Done", 1.0, row);
    ASSERT_LT(row, table.rows);
    EXPECT_EQ(table["Knife.Position"][row], 0.0);
    EXPECT_EQ(table["Conveyor.Velocity"][row], 0.0);
  }
  EXPECT_GT(table["cuts"].back(), 30.0);
}

TEST(RotaryKnifeTrace, MayBeStoppedAndStartedAgainInEachOfItsPhases) {
  // Waiting from 0.5 s on, synchronizing from 1.7 s on, synchronous from 2.3 s on.
  for (int stop = 600; stop < 3500; stop += 230) {
    for (const int pause : {60, 400, 900, 2000}) {
      SCOPED_TRACE(testing::Message() << "stopped at " << stop << " ms, started " << pause << " ms later");
      Json project = example_json("02_rotary_knife");
      project["stimuli"] = {stimulus("0.5s", "start", true),
                            stimulus(std::to_string(stop) + "ms", "start", false),
                            stimulus(std::to_string(stop + pause) + "ms", "start", true)};
      const CsvTable table = simulate(project, "9s",
                                      "Conveyor.Position,Conveyor.Velocity,Knife.Position,Knife.Velocity,"
                                      "gear.InSync,gear.Error,alarm,cuts");
      expect_never(table, "alarm");
      expect_never(table, "gear.Error");
      expect_synchronous_function(table);
      expect_smooth("02_rotary_knife", table, "Conveyor", 200.0, 400.0);
      expect_smooth("02_rotary_knife", table, "Knife", 700.0, 8000.0);
      EXPECT_EQ(table["gear.InSync"].back(), 1.0);
      EXPECT_GT(table["cuts"].back(), 0.0);
    }
  }
}

TEST(CrossCutter, HitsEveryMarkWhateverTheSpeedAndMissesThemWithoutCorrection) {
  for (const bool correct : {true, false}) {
    Json project = example_json("04_cross_cutter");
    project["tags"]["correct"]["init"] = correct;
    const CsvTable table = simulate(project, "30s",
                                    "Web.Position,Cutter.Position,gear.InSync,phasing.Error,"
                                    "phasing.CommandAborted,gear.Error,alarm,measure.MeasuredValue1Counter,"
                                    "error");
    for (const char* fault : {"alarm", "gear.Error", "phasing.Error", "phasing.CommandAborted"})
      expect_never(table, fault);
    double web = 0.0;  // on a line
    int cuts = 0;
    int in_step = 0;  // cuts since the drum became synchronous
    double largest = 0.0;
    for (std::size_t i = 1; i < table.rows; ++i) {
      const double distance = ring_distance(table["Web.Position"][i], table["Web.Position"][i - 1], 300.0);
      const double before = table["Cutter.Position"][i - 1];
      const double after = table["Cutter.Position"][i];
      web += distance;
      if (table["gear.InSync"][i] == 0.0) in_step = 0;
      if (table["gear.InSync"][i] == 0.0 || !(before < 180.0 && after >= 180.0)) continue;
      const double place = web - distance * (after - 180.0) / (after - before);
      const double marks = (place - 200.0 - 40.0) / 300.4;
      ++cuts;
      if (++in_step > 2) largest = std::max(largest, std::abs(marks - std::round(marks)) * 300.4);
    }
    EXPECT_GT(cuts, 50);
    if (correct) {
      EXPECT_LT(largest, 1e-3);
    } else {
      EXPECT_GT(largest, 10.0);
    }
    // Behind the first mark each one is 0.4 mm further on.
    const std::size_t last = table.rows - 1;
    if (correct) {
      EXPECT_NEAR(table["error"][last], -0.4, 1e-9);
    }
  }
}

TEST(EncoderConveyor, MeetsTheBeltWhileThatRunsEvenlyAndIsCalmerThanTheEncoder) {
  const CsvTable table = simulate(example("06_encoder_conveyor"), "17s",
                                  {"--signals",
                                   "Belt.ActualPosition,Belt.ActualVelocity,Encoder.ActualVelocity,"
                                   "Encoder.StatusExtrapolation.FilteredVelocity,Stamp.ActualPosition,"
                                   "gear.InSync,gear.Error,alarm,stamps"});
  expect_never(table, "alarm");
  expect_never(table, "gear.Error");
  double even = 0.0;
  double uneven = 0.0;
  double noise = 0.0;
  double calm = 0.0;
  int rows = 0;
  for (std::size_t i = 500; i < table.rows; ++i) {
    if (table["gear.InSync"][i] == 0.0) continue;
    const double belt = table["Belt.ActualPosition"][i];
    const double error =
        ring_distance(table["Stamp.ActualPosition"][i], 270.0 + 1.8 * (belt - 150.0), 360.0) / 1.8;
    const double speed = table["Belt.ActualVelocity"][i];
    const bool constant = std::abs(speed - table["Belt.ActualVelocity"][i - 400]) < 1e-3;
    (constant ? even : uneven) = std::max(constant ? even : uneven, std::abs(error));
    if (!constant) continue;
    ++rows;
    noise = std::max(noise, std::abs(table["Encoder.ActualVelocity"][i] - speed));
    calm = std::max(calm, std::abs(table["Encoder.StatusExtrapolation.FilteredVelocity"][i] - speed));
  }
  EXPECT_GT(rows, 3000);
  EXPECT_LT(even, 0.05);
  EXPECT_GT(uneven, even) << "the filters are late while the speed changes";
  EXPECT_GT(noise, 9.0);
  EXPECT_LT(calm, 1.0);
  EXPECT_GT(table["stamps"].back(), 15.0);
}

/// A roll of the line shaft and what it hangs on.
struct Roll {
  const char* following;
  const char* leading;
  double numerator;
  double denominator;
};

TEST(PressFeeder, FeedsTheLengthOfItsCamInEveryStrokeAndChangesItBetweenTwo) {
  const CsvTable table =
      simulate(example("05_press_feeder"), "60s",
               {"--signals",
                "Press.Position,Press.Velocity,Feeder.Position,Feeder.Velocity,long,alarm,"
                "first.Error,to_long.Error,to_short.Error,to_long.InSync,to_short.InSync"});
  for (const char* name : {"alarm", "first.Error", "to_long.Error", "to_short.Error"})
    expect_never(table, name);
  double expected = 0.0;
  int strokes = 0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["Press.Position"][i] > table["Press.Position"][i - 1] - 180.0) continue;
    // The press has come by 0°: a stroke has ended, with the cam that was in effect in it.
    expected += table["to_long.InSync"][i - 1] != 0.0 ? 125.0 : 80.0;
    ASSERT_NEAR(table["Feeder.Position"][i], expected, 1e-9) << table["t"][i];
    ++strokes;
  }
  EXPECT_GT(strokes, 50);
  EXPECT_GT(expected, 80.0 * strokes) << "some were long";
  const auto& speed = table["Feeder.Velocity"];
  const auto& position = table["Feeder.Position"];
  const double period = table["t"][1] - table["t"][0];
  for (std::size_t i = 1; i < table.rows; ++i) {
    ASSERT_LE(std::abs(speed[i] - speed[i - 1]), 8000.0 * period) << table["t"][i];
    ASSERT_NEAR(position[i] - position[i - 1], 0.5 * (speed[i] + speed[i - 1]) * period,
                8000.0 * period * period)
        << table["t"][i];
  }
}

/// What the program of the filling line computes, in closed form.
double nozzle_at(double angle, double depth, double level) {
  const auto rise = [](double u) { return u * u * u * (10.0 - 15.0 * u + 6.0 * u * u); };
  if (angle <= 40.0 || angle >= 320.0) return 0.0;
  if (angle <= 100.0) return -depth * rise((angle - 40.0) / 60.0);
  if (angle <= 260.0) return level * rise((angle - 100.0) / 160.0) - depth;
  return (level - depth) * rise((320.0 - angle) / 60.0);
}

TEST(FillingLine, FillsEveryBottleByItsOwnCurveAndChangesItBetweenTwo) {
  const CsvTable table = simulate(example("08_filling_line"), "20s",
                                  {"--signals",
                                   "Line.Position,Line.Velocity,Nozzle.Position,Nozzle.Velocity,step,on_a,d,"
                                   "alarm,refused,bottles,Profile_A.StatusWord.X5,Profile_B.StatusWord.X5"});
  for (const char* name : {"alarm", "refused"}) expect_never(table, name);
  EXPECT_EQ(table["Profile_A.StatusWord.X5"][0], 0.0) << "the project has no cam";
  struct Bottle {
    double depth, level;
  };
  const Bottle kinds[] = {{150.0, 120.0}, {220.0, 190.0}, {90.0, 60.0}};
  std::size_t kind = 0;
  std::size_t changes = 0;
  double furthest = 0.0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["on_a"][i] != table["on_a"][i - 1]) {
      kind = changes++;
      // The line stands at the first one; the others come when a bottle is done.
      EXPECT_LT(table["Line.Position"][i], 1.0) << table["t"][i];
      EXPECT_NEAR(table["Nozzle.Position"][i], 0.0, 0.01);
    }
    if (changes == 0) continue;
    const double curve = nozzle_at(table["Line.Position"][i], kinds[kind].depth, kinds[kind].level);
    furthest = std::max(furthest, std::abs(table["Nozzle.Position"][i] - curve));
    const double period = table["t"][i] - table["t"][i - 1];
    const double mean = 0.5 * (table["Nozzle.Velocity"][i] + table["Nozzle.Velocity"][i - 1]) * period;
    ASSERT_NEAR(table["Nozzle.Position"][i] - table["Nozzle.Position"][i - 1], mean, 0.02) << table["t"][i];
  }
  EXPECT_EQ(changes, 3u);
  EXPECT_LT(furthest, 0.05) << "what the splines between the points make";
  EXPECT_GT(table["bottles"].back(), 8.0);
}

TEST(FillingLine, RefusesABottleThatCannotBe) {
  for (const double level : {0.0, 150.0, 300.0}) {
    Json project = example_json("08_filling_line");
    project["tags"]["level"]["init"] = level;
    project["stimuli"] = Json::array();
    const CsvTable table = simulate(project, "1s", "refused,step,Line.Velocity");
    EXPECT_EQ(table["refused"].back(), 1.0);
    EXPECT_EQ(table["step"].back(), 0.0);
    EXPECT_EQ(table["Line.Velocity"].back(), 0.0) << "nothing moves without a cam";
  }
}

TEST(FlyingSaw, RunsAlongWithTheMaterialWhileTheBladeIsDown) {
  const CsvTable table =
      simulate(example("09_flying_saw"), "30s",
               {"--signals",
                "Material.Position,Material.Velocity,Saw.Position,Saw.Velocity,Saw.Acceleration,"
                "blade,cuts,alarm,cut,follow.Error,leave.Error,follow.InSync,leave.Done"});
  for (const char* name : {"alarm", "follow.Error", "leave.Error"}) expect_never(table, name);
  const auto& saw = table["Saw.Position"];
  const auto& speed = table["Saw.Velocity"];
  const double period = table["t"][1] - table["t"][0];
  std::size_t sawing = 0;
  double furthest = 0.0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    furthest = std::max(furthest, saw[i]);
    ASSERT_GE(saw[i], -1e-9);
    ASSERT_NEAR(saw[i] - saw[i - 1], 0.5 * (speed[i] + speed[i - 1]) * period, 0.05) << table["t"][i];
    ASSERT_LE(std::abs(speed[i] - speed[i - 1]), 30000.0 * period) << table["t"][i];
    if (table["blade"][i] == 0.0) continue;
    ++sawing;
    ASSERT_NEAR(saw[i], table["Material.Position"][i] - 200.0, 1e-9);
    ASSERT_NEAR(speed[i], table["Material.Velocity"][i], 1e-9);
  }
  EXPECT_GT(sawing, 1000u);
  EXPECT_NEAR(furthest, 480.0, 0.01);
  const std::size_t parked = table.first("leave.Done", 1.0);
  const std::size_t wanted = table.first("cut", 1.0, table.first("cut", 0.0));
  ASSERT_LT(parked, wanted);
  ASSERT_LT(wanted, table.rows);
  for (std::size_t i = parked; i < wanted; ++i) {
    ASSERT_EQ(saw[i], 0.0) << table["t"][i];
    ASSERT_GT(table["Material.Velocity"][i], 0.0) << "the material runs on";
  }
  EXPECT_EQ(table["follow.InSync"].back(), 1.0) << "taken up again";
  EXPECT_GT(table["cuts"].back(), 6.0);
}

TEST(EmergencyDoor, KeepsTheCouplingWhileTheDriveIsOffAndGoesOnInStep) {
  const CsvTable table =
      simulate(example("07_emergency_door"), "30s",
               {"--signals",
                "Belt.Position,Belt.Velocity,Press.Position,Press.Velocity,Press.StatusDrive.InOperation,"
                "gear.InSync,in_step,safe,hold,simulation.InSimulation,simulation.Error,alarm"});
  expect_never(table, "alarm");
  expect_never(table, "simulation.Error");
  const std::size_t synchronous = table.first("gear.InSync", 1.0);
  const std::size_t simulated = table.first("simulation.InSimulation", 1.0);
  const std::size_t safe = table.first("safe", 1.0);
  const std::size_t resumed = table.first("simulation.InSimulation", 0.0, simulated);
  ASSERT_LT(synchronous, simulated);
  ASSERT_LT(simulated, safe);
  ASSERT_LT(safe, resumed);
  ASSERT_LT(resumed, table.rows);
  EXPECT_EQ(table["Press.StatusDrive.InOperation"][safe], 0.0);
  EXPECT_EQ(table.first("gear.InSync", 0.0, synchronous), table.rows) << "the coupling never ends";
  double furthest = 0.0;
  for (std::size_t i = synchronous; i < table.rows; ++i) {
    const double function = 90.0 + 0.9 * (table["Belt.Position"][i] - 200.0);
    const double away = std::abs(ring_distance(table["Press.Position"][i], function, 360.0));
    if (table["in_step"][i] != 0.0 && table["simulation.InSimulation"][i] == 0.0) {
      ASSERT_LT(away, 1e-9) << table["t"][i];
    }
    furthest = std::max(furthest, away);
    if (table["safe"][i] != 0.0) {
      ASSERT_EQ(table["Belt.Velocity"][i], 0.0);
    }
  }
  EXPECT_GT(furthest, 15.0) << "the press was inched away meanwhile";
  expect_smooth("07_emergency_door", table, "Press", 185.0, 1000.0);
}

TEST(FixedStopProject, HoldsEachPartWithTheTorqueThatIsAskedFor) {
  const CsvTable table =
      simulate(example("10_fixed_stop"), "10s",
               {"--signals",
                "Jaw.Position,Jaw.ActualPosition,Jaw.StatusTorqueData.ActualTorque,"
                "grip.InClamping,grip.InLimitation,close.CommandAborted,torque,parts,alarm,"
                "found_at"});
  expect_never(table, "alarm");
  EXPECT_GE(table["parts"].back(), 3.0);
  EXPECT_NEAR(table["found_at"].back(), 62.5, 0.1) << "into the part by torque over stiffness";
  std::size_t held = 0;
  std::size_t settled = 0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["grip.InClamping"][i] == 0.0 || table["grip.InClamping"][i - 1] == 0.0) continue;
    ++held;
    if (table["Jaw.Position"][i] != table["Jaw.Position"][i - 1]) continue;  // it opens already
    EXPECT_GT(table["Jaw.Position"][i], 63.0) << "the following error is kept";
    if (i < 300 || table["grip.InClamping"][i - 300] == 0.0 || table["torque"][i] != table["torque"][i - 300])
      continue;
    EXPECT_EQ(table["Jaw.StatusTorqueData.ActualTorque"][i], table["torque"][i]) << table["t"][i];
    EXPECT_EQ(table["grip.InLimitation"][i], 1.0);
    ++settled;
  }
  EXPECT_GT(held, 1500u);
  EXPECT_GT(settled, 600u);
}

TEST(FixedStopProject, GoesOnAfterAFaultOfItsDriveHasBeenAcknowledged) {
  const CsvTable table = simulate(
      example("10_fixed_stop"), "20s",
      {"--signals",
       "alarm,Jaw.ErrorDetail.Number,Jaw.ErrorWord.X4,Jaw.StatusDrive.Error,drive_fault,reset,parts,step"});
  const std::size_t failed = table.first("drive_fault", 1.0);
  const std::size_t alarm = table.first("Jaw.ErrorWord.X4", 1.0);
  ASSERT_LT(failed, table.rows);
  EXPECT_LE(alarm - failed, 3u);
  EXPECT_EQ(table["Jaw.ErrorDetail.Number"][alarm], 421.0);
  const std::size_t reset = table.first("reset", 1.0);
  EXPECT_EQ(table["Jaw.ErrorDetail.Number"][reset], 421.0) << "the fault is over, and waits";
  EXPECT_LE(table.first("Jaw.ErrorWord.X4", 0.0, reset) - reset, 6u);
  EXPECT_GT(table["parts"].back(), table["parts"][reset] + 1.0);
}

TEST(LineShaft, EveryRollKeepsItsRatioWhileItIsSynchronous) {
  std::string signals = "Shaft.Position,Shaft.Velocity,Impression.StatusSynchronizedMotion.Offset";
  for (const char* roll : {"Infeed", "Impression", "Chill", "Slitter", "Delivery"})
    for (const char* signal : {".Position", ".Velocity", ".StatusWord.X22"})
      signals += std::string(",") + roll + signal;
  const CsvTable table = simulate(example("03_line_shaft"), "60s", {"--signals", signals});
  const auto& offset = table["Impression.StatusSynchronizedMotion.Offset"];
  for (const Roll& roll :
       {Roll{"Infeed", "Shaft", 1, 1}, Roll{"Impression", "Shaft", -1, 1}, Roll{"Chill", "Shaft", 355, 113},
        Roll{"Slitter", "Chill", -3, 7}, Roll{"Delivery", "Shaft", 22, 7}}) {
    const auto& synchronous = table[std::string(roll.following) + ".StatusWord.X22"];
    const std::string following = std::string(roll.following) + ".Position";
    const std::string leading = std::string(roll.leading) + ".Position";
    const double following_ring = *ring("03_line_shaft", following);
    const double leading_ring = *ring("03_line_shaft", leading);
    // Ways since the roll became synchronous, added up over the turns of the rings.
    double following_distance = 0.0;
    double leading_distance = 0.0;
    double largest = 0.0;
    std::size_t rows = 0;
    for (std::size_t i = 1; i < table.rows; ++i) {
      if (synchronous[i] == 0.0 || synchronous[i - 1] == 0.0) {
        following_distance = leading_distance = 0.0;
        continue;
      }
      following_distance += ring_distance(table[following][i], table[following][i - 1], following_ring);
      if (following == "Impression.Position") following_distance -= offset[i] - offset[i - 1];
      leading_distance += ring_distance(table[leading][i], table[leading][i - 1], leading_ring);
      largest = std::max(largest,
                         std::abs(following_distance - leading_distance * roll.numerator / roll.denominator));
      ++rows;
    }
    EXPECT_LT(largest, 1e-7) << roll.following;
    EXPECT_GT(rows, table.rows / 2) << roll.following;
    expect_smooth("03_line_shaft", table, roll.following, 2000.0, 2000.0);
  }
  expect_smooth("03_line_shaft", table, "Shaft", 360.0, 240.0);
}

TEST(LineShaft, TheRegisterIsCorrectedByWhatIsAskedForOverHalfATurnOfTheShaft) {
  const CsvTable table = simulate(example("03_line_shaft"), "30s",
                                  {"--signals",
                                   "Impression.StatusSynchronizedMotion.Offset,register.StartOffset,"
                                   "register.Done,register.Error,Shaft.Position"});
  expect_never(table, "register.Error");
  const auto& offset = table["Impression.StatusSynchronizedMotion.Offset"];
  std::size_t row = 0;
  double before = 0.0;
  for (const double after : {2.5, -1.5}) {
    const std::size_t start = table.first("register.StartOffset", 1.0, row);
    const std::size_t end = table.first("register.Done", 1.0, start);
    ASSERT_LT(end, table.rows);
    EXPECT_NEAR(offset[start], before, 0.1);
    EXPECT_EQ(offset[end], after);
    before = after;
    row = table.first("register.Done", 0.0, end);
  }
  EXPECT_EQ(offset.back(), -1.5);
}

TEST(LineShaft, AllRollsComeIntoGearOneAfterAnotherAndNoneRaisesAnAlarm) {
  const CsvTable table = simulate(example("03_line_shaft"), "60s",
                                  {"--signals",
                                   "gear_1.InGear,gear_2.InGear,gear_3.InGear,gear_4.InGear,"
                                   "gear_5.InGear,all_geared,alarm,clutch_3,fast"});
  expect_never(table, "alarm");
  std::size_t row = 0;
  for (int gear = 1; gear <= 5; ++gear) {
    const std::size_t next = table.first("gear_" + std::to_string(gear) + ".InGear", 1.0);
    ASSERT_LT(next, table.rows) << gear;
    EXPECT_GT(next, row) << gear;
    row = next;
  }
  EXPECT_EQ(table["all_geared"].back(), 1.0) << "again, after the clutch of the chill roll was open";
}

TEST(BottlePalletizer, CarriesBoxAfterBoxToThePallet) {
  const CsvTable table = simulate(example("20_bottle_palletizer"), "30s");
  std::size_t boxes = 0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["gripped"][i] < table["gripped"][i - 1]) {
      EXPECT_NEAR(table["Horizontal.APOS"][i], 2500.0, 5.0) << "opened beside the pallet";
      EXPECT_NEAR(table["Vertical.APOS"][i], 900.0, 5.0);
      ++boxes;
    }
    if (table["gripped"][i] > table["gripped"][i - 1]) {
      EXPECT_NEAR(table["Vertical.APOS"][i], 850.0, 5.0) << "50 behind the edge of the touch probe at 800";
    }
  }
  EXPECT_EQ(boxes, 6u);
}

TEST(BottlePalletizer, SaysEachBoxOnTheConsole) {
  const Ended ended = lockstep({"run", example("20_bottle_palletizer"), "--simulate", "--duration", "10s"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find("Horizontal: box 1 at 2500\n"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("Horizontal: box 2 at 2500\n"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("error"), std::string::npos) << ended.err;
}

TEST(SuitcaseConveyor, RunsAtTheSpeedOfTheBeltInFrontAndByHandInSteps) {
  const CsvTable table = simulate(example("21_suitcase_conveyor"), "16s");
  expect_never(table, "failed");
  const auto speed_at = [&](double t) {
    return table["TransferBelt.AVEL"][static_cast<std::size_t>(std::lround(t * 1000.0))];
  };
  for (const double t : {3.0, 5.5, 8.5}) {
    const auto row = static_cast<std::size_t>(std::lround(t * 1000.0));
    EXPECT_EQ(table["follows"][row], 1.0);
    EXPECT_NEAR(speed_at(t), 1.25 * table["MainBelt.AVEL"][row], 120.0) << "4 counts for 5 at " << t;
  }
  EXPECT_NEAR(speed_at(9.8), 0.0, 100.0);
  for (const auto& [t, speed] :
       {std::pair{10.8, 20'000.0}, {11.8, 25'000.0}, {12.8, 30'000.0}, {13.8, 25'000.0}})
    EXPECT_NEAR(speed_at(t), speed, 100.0) << "by hand at " << t;
  EXPECT_NEAR(speed_at(15.0), 0.0, 100.0);
  EXPECT_EQ(table["hand"].back(), 0.0);
}

/// The row of a time.
std::size_t row_at(double t) {
  return static_cast<std::size_t>(std::lround(t * 1000.0));
}

TEST(TeddyPackaging, GoesBesideTheBoxesToTheCountAndWithSlipByWhatSensorsSee) {
  const CsvTable table = simulate(example("22_teddy_packaging"), "22s");
  expect_never(table, "failed");
  const auto apart = [&](double t) {
    return table["Teddies.CPOS"][row_at(t)] - table["Teddies.MAPOS"][row_at(t)];
  };
  for (const double t : {2.5, 2.9}) EXPECT_EQ(apart(t), apart(2.0)) << "belt beside belt";
  EXPECT_NEAR(apart(4.5) - apart(2.9), 500.0, 1.0) << "two steps of 250";
  EXPECT_EQ(table["accurate"][row_at(4.5)], 1.0);
  EXPECT_NEAR(table["Teddies.SYNCMPULSM"][row_at(11.0)], 4000.0, 6.0) << "of boxes, measured";
  EXPECT_NEAR(table["Teddies.SYNCMPULSS"][row_at(11.0)], 4040.4, 6.0) << "of teddies, whose belt slips";
  // At each teddy the last box is as far behind as the belts have moved since: by a whole number of boxes.
  int pairs = 0;
  double largest = 0.0;
  for (std::size_t i = row_at(13.5); i < row_at(21.0); ++i) {
    const double t = table["t"][i];
    if (t > 15.9 && t < 17.0) continue;
    if (table["Teddies.IPOS"][i] == table["Teddies.IPOS"][i - 1]) continue;
    const double box = table["Teddies.MAPOS"][i] - table["Teddies.MIPOS"][i];
    const double teddy = table["Teddies.APOS"][i] - table["Teddies.IPOS"][i];
    largest = std::max(largest, std::abs(std::remainder(box - teddy, 4000.0)));
    ++pairs;
  }
  EXPECT_GT(pairs, 25);
  EXPECT_LE(largest, 90.0) << "a percent of 4000, and the noise";
  EXPECT_EQ(table["ready"][row_at(15.5)], 1.0);
  const std::size_t missed = table.first("missing", 1.0);
  ASSERT_LT(missed, table.rows);
  EXPECT_NEAR(table["t"][missed], 16.2, 0.3);
  EXPECT_EQ(table["missing"][row_at(18.0)], 0.0) << "the next pair puts it right";
  EXPECT_EQ(table["ready"][row_at(20.5)], 1.0);
}

TEST(BottleFiller, FillsEachBottleThatIsThereAndNothingElse) {
  const CsvTable table = simulate(example("29_bottle_filler"), "22s");
  const auto at = [&](const char* name, double t) {
    return table[name][static_cast<std::size_t>(std::lround(t * 2000.0))];
  };
  EXPECT_NEAR(at("Line.PcdOut[2]", 3.0), 240.0, 1.0);
  EXPECT_NEAR(at("Line.PcdOut[2]", 16.0), 360.0, 1.0);
  EXPECT_EQ(at("valves", 6.0), 1.0);
  EXPECT_EQ(at("Heads.PcdOut[3]", 7.5), 0.0);
  EXPECT_EQ(at("Heads.PcdOut[3]", 9.5), 1.0) << "one is missing";
  EXPECT_EQ(at("Heads.PcdOut[3]", 12.5), 1.0) << "glints are no bottles";
  // Ready all the time, so that each bottle of the sensor is filled: four a second.
  EXPECT_NEAR(at("Heads.PcdOut[2]", 16.0) - at("Heads.PcdOut[2]", 14.0), 12.0, 1.0);
  EXPECT_EQ(at("Heads.ERRNO", 17.5), 108.0);
  EXPECT_EQ(at("Heads.PcdOut[4]", 17.9), 108.0);
  EXPECT_EQ(at("valves", 17.9), 0.0);
  EXPECT_EQ(at("Heads.ERRNO", 18.4), 0.0) << "cleared by the field bus";
  EXPECT_EQ(at("valves", 21.5), 1.0);
}

TEST(MixedLine, KeepsLabellerAndStackerInStepWithTheBelt) {
  const CsvTable table = simulate(example("25_mixed_line"), "9s");
  expect_never(table, "alarm");
  std::size_t together = 0;
  for (std::size_t i = 1000; i < table.rows; ++i) {
    const double t = table["t"][i];
    if ((t < 3.0 || t > 5.0) && (t < 7.0 || t > 9.0)) continue;
    EXPECT_EQ(table["stacks"][i], 1.0) << t;
    EXPECT_LE(std::abs(table["Labeller.SYNCERR"][i]), 1.0) << t;
    // 100 counts a millimetre, two for one, 40 counts a unit, half of them.
    EXPECT_NEAR(table["Stacker.Velocity"][i], 2.5 * table["Belt.Velocity"][i], 60.0) << t;
    ++together;
  }
  EXPECT_GT(together, 3000u);
  const auto stopped = static_cast<std::size_t>(std::lround(5.9 * 1000.0));
  EXPECT_NEAR(table["Stacker.Velocity"][stopped], 0.0, 1.0) << "stops with the labeller";
}

TEST(Brake, IsOpenWhileTheLiftMovesAndShutBehindAnError) {
  const CsvTable table = simulate(example("24_brake"), "4s");
  const std::size_t hit = table.first("end_switch", 1.0);
  const std::size_t shut = table.first("emergency", 1.0);
  ASSERT_LT(hit, shut);
  ASSERT_LT(shut, table.rows);
  EXPECT_NEAR(table["t"][hit], 1.6, 1e-9);
  for (std::size_t i = 1; i < table.rows; ++i) {
    // With the motor off the set position follows the actual one, by a count or two.
    if (std::abs(table["Lift.CPOS"][i] - table["Lift.CPOS"][i - 1]) > 2.0 && i < hit) {
      EXPECT_EQ(table["released"][i], 1.0) << "moves with the brake shut at " << table["t"][i];
    }
    if (i > shut + 20) {
      EXPECT_EQ(table["released"][i], 0.0);
      EXPECT_NEAR(table["Lift.APOS"][i], table["Lift.APOS"][shut], 10.0);
    }
  }
  EXPECT_EQ(table["Lift.ERRNO"].back(), 125.0);
  EXPECT_GT(table["Lift.AVEL"][hit], 10'000.0) << "was at rest already";
  EXPECT_LT(std::abs(table["Lift.AVEL"][shut]), 5'000.0) << "braked while it moved";
}

TEST(LinearMotor, RunsAlongWithTheBeltByItsForceAndGivesWayToAnotherOne) {
  const CsvTable table = simulate(example("26_linear_motor"), "7s");
  expect_never(table, "alarm");
  EXPECT_GE(table["rounds"].back(), 3.0);
  expect_smooth("26_linear_motor", table, "Slide", 1500.0, 30'000.0);
  double along = 0.0, pushed = 0.0, force = 0.0;
  for (std::size_t i = 0; i < table.rows; ++i) {
    const double t = table["t"][i];
    const double error = std::abs(table["Slide.StatusPositioning.FollowingError"][i]);
    force = std::max(force, std::abs(table["Slide.StatusTorqueData.ActualTorque"][i]));
    if (t >= 4.0 && t < 4.3)
      pushed = std::max(pushed, error);
    else if (table["along.InSync"][i] > 0.0)
      along = std::max(along, error);
  }
  EXPECT_LT(along, 0.15);
  EXPECT_GT(pushed, 0.5);
  EXPECT_LT(pushed, 1.4);
  EXPECT_GT(force, 2.029 * 15.0);  // of the acceleration on the way back
  EXPECT_LT(force, 5.0 * 40.0);    // of the maximal current
}

}  // namespace
}  // namespace lockstep::test::example_projects_test
