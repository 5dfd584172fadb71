// The acceptance scenarios of set-points and position loop: commands and numbers are those of the file.
#include <algorithm>
#include <limits>

#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_motion_scenario_test {
namespace {

const Json& expected(const std::string& id, std::size_t index) {
  return expectations(id)[index];
}

/// [m/s²] The largest change of velocity from tick to tick.
double largest_acceleration(const std::vector<LinMotRun::Sample>& samples) {
  double largest = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    largest = std::max(largest, std::abs(samples[i].velocity - samples[i - 1].velocity) /
                                    (samples[i].time - samples[i - 1].time));
  return largest;
}

/// When the set-point has reached a place first, since a time.
double time_at(const std::vector<LinMotRun::Sample>& samples, double from, double place) {
  for (const LinMotRun::Sample& one : samples)
    if (one.time >= from && std::abs(one.setpoint - place) < 1e-9) return one.time;
  return std::numeric_limits<double>::infinity();
}

TEST(LinMotScenario, L01TheBasicSettingMovesHundredMillimetres) {
  LinMotRun run(linmot_project());
  run.start();
  run.until(0.1);
  run.samples.clear();
  EXPECT_EQ(run.send(linmot_scenario("L01").at("steps").at(0).at("ascii")), "#");
  run.until(0.4);
  const double begin = 0.1;
  EXPECT_NEAR(time_at(run.samples, begin, 100.0) - begin, expected("L01", 0).at("value").get<double>(),
              expected("L01", 0).at("tolerance").get<double>());
  const double ramp = expected("L01", 1).at("value");
  const auto at_ramp = std::find_if(run.samples.begin(), run.samples.end(),
                                    [&](const auto& one) { return one.time >= begin + ramp - 1e-9; });
  EXPECT_NEAR(at_ramp->setpoint, expected("L01", 1).at("distance_mm").get<double>(), 1e-6);
  double fastest = 0.0;
  for (const auto& one : run.samples) fastest = std::max(fastest, std::abs(one.velocity));
  EXPECT_NEAR(fastest, expected("L01", 2).at("value").get<double>(),
              expected("L01", 2).at("tolerance").get<double>());
  EXPECT_LE(largest_acceleration(run.samples), expected("L01", 3).at("max").get<double>() * (1.0 + 1e-9));
  EXPECT_NEAR(run.motor().SetPoint, expected("L01", 4).at("value").get<double>(), 1e-9);
}

TEST(LinMotScenario, L02RetargetsAndTakesOtherLimitsInMotion) {
  LinMotRun run(linmot_project());
  run.start();
  std::vector<double> ends;
  run.until(0.1);
  run.samples.clear();
  for (const Json& one : linmot_scenario("L02").at("steps")) {
    run.until(std::stod(one.at("at").get<std::string>()));
    if (run.time() > 0.49 && ends.empty()) ends.push_back(run.motor().SetPoint);
    EXPECT_EQ(run.send(one.at("ascii")), "#");
  }
  run.until(1.0);
  ends.push_back(run.motor().SetPoint);
  EXPECT_LE(largest_acceleration(run.samples), expected("L02", 0).at("max").get<double>() * (1.0 + 1e-9));
  EXPECT_EQ(expected("L02", 1).at("value"), "continuous");
  for (std::size_t i = 1; i < run.samples.size(); ++i)
    EXPECT_LE(std::abs(run.samples[i].setpoint - run.samples[i - 1].setpoint), 0.79 * 0.1)
        << run.samples[i].time;
  const double slow = expected("L02", 2).at("value");
  for (const auto& one : run.samples) {
    if (one.time > 0.57) {
      EXPECT_LE(one.velocity, slow + 1e-9) << one.time;
    }
  }
  const auto ends_wanted = expected("L02", 3).at("value").get<std::vector<double>>();
  ASSERT_EQ(ends.size(), ends_wanted.size());
  for (std::size_t i = 0; i < ends.size(); ++i) EXPECT_NEAR(ends[i], ends_wanted[i], 1e-9);
}

TEST(LinMotScenario, L03MakesCurvesOfLimitedJerk) {
  Json project = linmot_project();
  controller_of(project)["curves"] = linmot_scenario("L03").at("setup").at("curves");
  LinMotRun run(project);
  const ScenarioList expect = expectations("L03");
  for (std::size_t i = 0; i < expect.size(); ++i) {
    const Json& one = expect[i];
    const linmot::Curve& curve = run.controller().curves[one.at("curve").get<std::size_t>()];
    ASSERT_TRUE(curve.exists());
    if (one.contains("at_ms")) {
      for (std::size_t k = 0; k < one.at("at_ms").size(); ++k)
        EXPECT_NEAR(curve.function().value(one.at("at_ms")[k].get<double>() * 1e-3).position,
                    one.at("position_mm")[k].get<double>(), 1e-9);
      EXPECT_NEAR(curve.function().value(curve.duration()).first_derivative, 0.0, 1e-9);
    }
    if (one.contains("duration_ms")) {
      EXPECT_NEAR(curve.duration() * 1e3, one.at("duration_ms").get<double>(), 1e-9);
    }
    if (one.contains("peak")) {
      const linmot::CurvePeaks peaks = curve.peaks();
      const double tolerance = one.value("relative_tolerance", 1e-6);
      EXPECT_NEAR(peaks.velocity / one.at("peak").at("v").get<double>(), 1.0, tolerance);
      EXPECT_NEAR(peaks.acceleration / one.at("peak").at("a").get<double>(), 1.0, tolerance);
      EXPECT_NEAR(peaks.jerk / one.at("peak").at("j").get<double>(), 1.0, tolerance);
    }
  }
  const CamFunction& limited = run.controller().curves[3].function();
  const Json& phases = expect[4].at("phases_ms");
  const double tj = phases.at("Tj"), ta = phases.at("Ta"), tv = phases.at("Tv");
  EXPECT_NEAR(limited.piece_start(1) * 1e3, tj, 1e-9);
  EXPECT_NEAR(limited.piece_start(2) * 1e3, tj + ta, 1e-9);
  EXPECT_NEAR(limited.piece_start(3) * 1e3, 2.0 * tj + ta, 1e-9);
  EXPECT_NEAR(limited.piece_start(4) * 1e3, 2.0 * tj + ta + tv, 1e-9);
}

Json there_and_back() {
  return Json::parse(
      R"({ "1": { "parts": [ { "type": "Minimal Jerk", "start": 0, "end": 30, "time": "200ms" },
                                            { "type": "Minimal Jerk", "start": 30, "end": 0, "time": "200ms" } ] },
                          "2": { "type": "Minimal Jerk", "start": 0, "end": 10, "time": "200ms" },
                          "3": { "type": "Minimal Jerk", "start": 0, "end": 30, "time": "400ms" },
                          "4": { "type": "Minimal Jerk", "start": 30, "end": 10, "time": "200ms" } })");
}

struct Course {
  double begin = 0.0, duration = 0.0, peak = -1e9, lowest = 1e9, acceleration = 0.0, first_step = 0.0;
};

/// What the set-point does from a time until it stands again.
Course course(const std::vector<LinMotRun::Sample>& samples, double from, double to) {
  Course run{.begin = from};
  double last_motion = from;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto& now = samples[i];
    if (now.time < from || now.time >= to) continue;
    run.peak = std::max(run.peak, now.setpoint);
    run.lowest = std::min(run.lowest, now.setpoint);
    run.acceleration = std::max(run.acceleration, std::abs(now.velocity - samples[i - 1].velocity) / 1e-4);
    if (std::abs(now.setpoint - samples[i - 1].setpoint) > 0.0) last_motion = now.time;
    if (std::abs(now.time - from) < 1e-9) run.first_step = std::abs(now.setpoint - samples[i - 1].setpoint);
  }
  run.duration = last_motion - from;
  return run;
}

TEST(LinMotScenario, L04PlaysACurveAtAnyRateAmplitudeAndOffset) {
  Json project = linmot_project();
  controller_of(project)["curves"] = there_and_back();
  LinMotRun run(project);
  run.start();
  for (const Json& one : linmot_scenario("L04").at("steps")) {
    run.until(std::stod(one.at("at").get<std::string>()));
    EXPECT_EQ(run.send(one.at("ascii")), one.value("answer", "#")) << one;
  }
  const auto& samples = run.samples;
  const Course first = course(samples, 0.1, 0.9);
  EXPECT_NEAR(first.peak, expected("L04", 0).at("value").get<double>(), 1e-6);
  EXPECT_NEAR(first.duration, expected("L04", 1).at("value").get<double>(), 0.0011);
  const Course second = course(samples, 1.1, 2.4);
  EXPECT_NEAR(second.duration, expected("L04", 2).at("value")[0].get<double>(), 0.0011);
  EXPECT_NEAR(second.acceleration, expected("L04", 2).at("value")[1].get<double>(),
              expected("L04", 2).at("tolerance")[1].get<double>());
  const Course third = course(samples, 2.6, 3.4);
  EXPECT_NEAR(third.peak, expected("L04", 3).at("value").get<double>(), 1e-6);
  const Course fourth = course(samples, 4.0, 4.6);
  EXPECT_NEAR(fourth.lowest, expected("L04", 4).at("value")[0].get<double>(), 1e-6);
  EXPECT_NEAR(fourth.peak, expected("L04", 4).at("value")[1].get<double>(), 1e-6);
  EXPECT_LE(fourth.first_step, expected("L04", 5).at("max").get<double>());
}

TEST(LinMotScenario, L05AnswersAStepAsTheClosedFormSays) {
  Json project = linmot_project();
  controller_of(project)["motors"]["A"]["friction"] = 0.0;
  controller_of(project)["curves"] = linmot_scenario("L05").at("setup").at("curves");
  LinMotRun run(project);
  run.start();
  run.until(0.1);
  EXPECT_EQ(run.send("!CC1A"), "#");
  run.until(0.2);
  EXPECT_EQ(run.send("!DO51A"), "#");
  const double step = run.motor().SetPoint;
  EXPECT_EQ(step, expected("L05", 0).at("value").get<double>());
  EXPECT_NEAR(run.motor().DemandCurrent, expected("L05", 3).at("value").get<double>(), 1e-6);
  run.samples.clear();
  run.until(0.6);
  const auto peak = std::max_element(run.samples.begin(), run.samples.end(),
                                     [](const auto& a, const auto& b) { return a.actual < b.actual; });
  EXPECT_NEAR(peak->actual / step - 1.0, expected("L05", 1).at("value").get<double>(), 0.03 * 0.399);
  EXPECT_NEAR(peak->time - 0.2, expected("L05", 2).at("value").get<double>(), 0.0012);
  double settled = 0.0;
  for (const auto& one : run.samples)
    if (std::abs(one.actual / step - 1.0) > 0.02) settled = one.time;
  EXPECT_NEAR(settled - 0.2, expected("L05", 4).at("value").get<double>(), 0.004);
}

struct Following {
  double error = 0.0, time = 0.0, current = 0.0;
};

Following largest_error(const std::vector<LinMotRun::Sample>& samples, double from) {
  Following found;
  for (const auto& one : samples) {
    if (one.time < from) continue;
    found.current = std::max(found.current, std::abs(one.current));
    if (std::abs(one.setpoint - one.actual) <= found.error) continue;
    found.error = std::abs(one.setpoint - one.actual);
    found.time = one.time - from;
  }
  return found;
}

TEST(LinMotScenario, L06FollowsWithAndWithoutFeedForward) {
  LinMotRun run(linmot_project());
  run.start();
  run.until(0.1);
  EXPECT_EQ(run.send("!SP5120A"), "#");
  run.until(0.6);
  const Following first = largest_error(run.samples, 0.1);
  EXPECT_NEAR(first.error, expected("L06", 0).at("value").get<double>(), 0.02);
  EXPECT_NEAR(first.time, expected("L06", 1).at("value").get<double>(), 0.0012);
  EXPECT_NEAR(first.current, expected("L06", 2).at("value").get<double>(), 0.05);
  EXPECT_LE(std::abs(run.motor().FollowingError), expected("L06", 4).at("max").get<double>());
  for (const Json& command : linmot_scenario("L06").at("steps").at(1).at("ascii")) {
    if (command == "!SP0A") {
      // What is left of the first move is no part of the second.
      run.run(0.2);
      run.samples.clear();
    }
    EXPECT_EQ(run.send(command), "#");
  }
  const double begin = run.samples.front().time;
  const double rest = std::abs(run.samples.front().setpoint - run.samples.front().actual);
  run.run(0.4);
  const Following second = largest_error(run.samples, begin);
  EXPECT_LE(second.error, std::max(expected("L06", 3).at("max").get<double>(), rest));
  EXPECT_LE(std::abs(run.motor().FollowingError), expected("L06", 4).at("max").get<double>());
}

TEST(LinMotScenario, L07CarriesAWeight) {
  Json project = linmot_project();
  controller_of(project)["motors"]["A"]["friction"] = 0.0;
  controller_of(project)["motors"]["A"]["inclination"] = 90.0;
  LinMotRun run(project);
  run.start();
  run.run(1.0);
  EXPECT_NEAR(run.motor().FollowingError, expected("L07", 0).at("value").get<double>(), 0.0005);
  EXPECT_EQ(run.send("!DK21A"), "#");
  run.run(1.0);
  EXPECT_NEAR(run.motor().FollowingError, expected("L07", 1).at("value").get<double>(), 0.0005);
  EXPECT_EQ(run.send("!DK0A"), "#");
  EXPECT_EQ(run.send("!DI438A"), "#");
  run.run(0.5);
  EXPECT_LE(std::abs(run.motor().FollowingError), expected("L07", 2).at("max").get<double>());
}

TEST(LinMotCurve, RunsCyclicallyWithoutAGap) {
  Json project = linmot_project();
  controller_of(project)["curves"] = there_and_back();
  drive_of(project)["Set Value Generation"] = {{"Run Mode", "Continuous Curve"},
                                               {"Set Value Configuration", {{"Curve Number", 1}}}};
  LinMotRun run(project);
  run.start();
  // The first cycle of a run is the one in which the set-point has come back to its begin.
  run.run(0.01);
  run.samples.clear();
  run.run(10.0);
  int begins = 0;
  for (std::size_t i = 1; i + 1 < run.samples.size(); ++i)
    begins += run.samples[i].velocity >= 0.0 && run.samples[i - 1].velocity < 0.0 ? 1 : 0;
  EXPECT_EQ(begins, 25);
}

TEST(LinMotRunMode, FollowsAVoltage) {
  Json project = linmot_project();
  drive_of(project)["Set Value Generation"] = {
      {"Run Mode", "Analog"}, {"Set Value Configuration", {{"0V Position", -10.0}, {"10V Position", 30.0}}}};
  LinMotRun run(project);
  run.write("volts", 2.5);
  run.start();
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 0.0, 1e-9);
  run.write("volts", 20.0);
  run.run(0.3);
  EXPECT_NEAR(run.motor().SetPoint, 30.0, 1e-9);
}

TEST(LinMotRunMode, RunsTheFallCurveBehindTheRiseCurve) {
  Json project = linmot_project("1ms");
  controller_of(project)["curves"] = there_and_back();
  drive_of(project)["Set Value Generation"] = {
      {"Run Mode", "Trigger Curve"},
      {"Set Value Configuration", {{"Rise Curve Number", 3}, {"Fall Curve Number", 4}}}};
  LinMotRun run(project);
  run.start();
  run.until(0.1);
  run.write("t_a", 1);
  run.until(0.2);
  run.write("t_a", 0);
  run.until(0.499);
  EXPECT_NEAR(run.motor().SetPoint, 30.0, 0.01);
  run.until(0.8);
  EXPECT_NEAR(run.motor().SetPoint, 10.0, 1e-9);
}

TEST(LinMotTrigger, BeginsAnArmedMotionAtItsEdge) {
  LinMotRun run(linmot_project("1ms"));
  run.start();
  EXPECT_EQ(run.send("!TP2560A"), "#");
  run.run(1.0);
  EXPECT_EQ(run.motor().SetPoint, 0.0);
  run.write("t_a", 1);
  run.run(0.5);
  EXPECT_NEAR(run.motor().SetPoint, 50.0, 1e-9);
}

}  // namespace
}  // namespace lockstep::linmot_motion_scenario_test
