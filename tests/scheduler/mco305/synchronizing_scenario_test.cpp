// The acceptance scenarios of synchronizing: masters, markers, programs and numbers are those of the file.
#include <algorithm>
#include <cmath>
#include <functional>
#include <regex>

#include "tests/scheduler/mco305/device_run.hpp"
#include "tests/scheduler/mco305/series.hpp"

namespace lockstep {
namespace synchronizing_scenario_test {
namespace {

/// Segments [t0, t1, v0, v1] of its velocity.
double master_at(const Json& segments, double t) {
  double place = 0.0;
  for (const Json& one : segments) {
    const double t0 = one[0], t1 = one[1], v0 = one[2], v1 = one[3];
    const double passed = std::clamp(t - t0, 0.0, t1 - t0);
    place += passed * (v0 + (v1 - v0) * passed / (t1 - t0) / 2.0);
  }
  return place;
}

/// "4000*k, k>=1, without 24000, with one more at 14000".
std::vector<double> markers_of(const std::string& text) {
  constexpr int kMany = 2000;
  std::vector<double> places;
  std::smatch found;
  if (std::regex_search(text, found, std::regex("only ([0-9]+)"))) return {std::stod(found[1])};
  if (!std::regex_search(text, found, std::regex("(?:([0-9]+)\\+)?([0-9]+)\\*k"))) return places;
  const double begin = found[1].matched ? std::stod(found[1]) : 0.0, period = std::stod(found[2]);
  const int first = text.find("k>=0") != text.npos ? 0 : 1;
  double without = -1.0;
  if (std::regex_search(text, found, std::regex("without ([0-9]+)"))) without = std::stod(found[1]);
  for (int k = first; k < kMany; ++k)
    if (begin + period * k != without) places.push_back(begin + period * k);
  if (std::regex_search(text, found, std::regex("one more at ([0-9]+)")))
    places.push_back(std::stod(found[1]));
  std::sort(places.begin(), places.end());
  return places;
}

/// A scenario with what one of its variants says otherwise, run to its end and recorded.
class Recorded {
 public:
  Recorded(const Json& scenario, const Json& variant) {
    const auto of = [&](const char* key) {
      return variant.contains(key) ? variant.at(key) : scenario.value(key, Json());
    };
    run_.set_all(scenario.at("parameters"));
    run_.set_all(variant);
    run_.add_program(joined(of("program")));
    run_.object.master.signal = &turned_;
    run_.begin();
    Json master = scenario.value("master", Json::object());
    if (variant.contains("master_segments")) master["segments"] = variant["master_segments"];
    for (const char* key : {"markers_master", "markers_slave"})
      if (variant.contains(key)) master[key] = variant[key];
    text_ = scenario.dump() + variant.dump();
    int duration = scenario.at("duration_ms");
    if (variant.contains("duration_ms")) {
      duration = variant["duration_ms"];
      master["segments"].back()[1] = duration;
    }
    record(master, duration);
  }

  Series series(const std::string& text) { return SeriesReader(signals_).read(text); }
  double at(const std::string& text, std::size_t step) { return series(text).at(step); }
  double last(const std::string& text) { return series(text).back(); }
  std::size_t steps() const { return signals_.begin()->second.size(); }
  const std::vector<std::size_t>& slave_marks() const { return slave_marks_; }
  const std::vector<std::size_t>& master_marks() const { return master_marks_; }
  DeviceRun& run() { return run_; }

 private:
  void record(const Json& master, int duration) {
    const Json segments = master.value("segments", Json::array());
    const auto master_places = markers_of(master.value("markers_master", ""));
    const auto slave_places = markers_of(master.value("markers_slave", ""));
    std::size_t next_master = 0, next_slave = 0;
    mco305::Device& device = run_.object.device();
    std::vector<std::pair<std::function<double()>, Series*>> recorded;
    const auto add = [&](const std::string& name, std::function<double()> signal) {
      if (name == "marks" || text_.find(name) != text_.npos)
        recorded.emplace_back(std::move(signal), &signals_[name]);
    };
    add("MAPOS", [&] { return device.master().shown(); });
    add("CPOS", [&] { return device.set_units(); });
    add("APOS", [&] { return device.actual_units(); });
    add("SYNCERR", [&] { return device.sync_error(); });
    add("SYNCSTAT", [&] { return device.sync_status(); });
    add("marks", [&] { return static_cast<double>(next_slave); });
    for (const int index : {4097, 4109, 4110, 4231, 4238, 4243})
      add("SYSVAR[" + std::to_string(index) + "]", [this, index] { return run_.system_variable(index); });
    for (int t = 0; t <= duration; ++t) {
      const double place = master_at(segments, t);
      turned_ = static_cast<DINT>(std::llround(std::floor(place)));
      for (; next_master < master_places.size() && master_places[next_master] <= place; ++next_master) {
        device.master().mark(master_places[next_master]);
        master_marks_.push_back(static_cast<std::size_t>(t));
      }
      run_.step();
      const auto actual = static_cast<double>(device.actual_position());
      for (; next_slave < slave_places.size() && slave_places[next_slave] <= actual; ++next_slave) {
        device.mark(slave_places[next_slave]);
        slave_marks_.push_back(static_cast<std::size_t>(t));
      }
      for (auto& [signal, series] : recorded) series->push_back(signal());
    }
  }

  DeviceRun run_;
  DINT turned_ = 0;
  std::string text_;  // in which the signals are named
  std::map<std::string, Series> signals_;
  std::vector<std::size_t> master_marks_, slave_marks_;
};

std::string signal_name(std::string name) {
  return name == "slave markers passed" ? "marks" : name;
}

/// The first step in which a condition becomes true, or false again.
std::size_t change_of(Recorded& recorded, const std::string& condition, bool rises) {
  const Series series = recorded.series(condition);
  for (std::size_t i = 1; i < series.size(); ++i)
    if ((series[i] != 0.0) == rises && (series[i - 1] != 0.0) != rises) return i;
  ADD_FAILURE() << condition << (rises ? " never rises" : " never falls");
  return 0;
}

void expect_one(Recorded& recorded, const Json& one) {
  const double tolerance = one.value("tolerance", 0.0);
  const std::size_t from = one.value("from", 1),
                    to = std::min<std::size_t>(one.value("to", 1 << 30), recorded.steps());
  if (one.contains("at")) {
    EXPECT_NEAR(recorded.at(one.at("signal"), one.at("at")), one.at("value").get<double>(), tolerance) << one;
  } else if (one.contains("final")) {
    EXPECT_NEAR(recorded.last(one.at("final")), one.at("value").get<double>(), tolerance) << one;
  } else if (one.contains("max") || one.contains("min")) {
    const bool maximum = one.contains("max");
    const Series series = recorded.series(one.at(maximum ? "max" : "min"));
    const auto begin = series.begin() + static_cast<std::ptrdiff_t>(from),
               end = series.begin() + static_cast<std::ptrdiff_t>(to);
    EXPECT_NEAR(maximum ? *std::max_element(begin, end) : *std::min_element(begin, end),
                one.at("value").get<double>(), tolerance)
        << one;
  } else if (one.contains("mean")) {
    const Series series = recorded.series(one.at("mean"));
    double sum = 0.0;
    for (std::size_t i = from; i < to; ++i) sum += series[i];
    EXPECT_NEAR(sum / static_cast<double>(to - from), one.at("value").get<double>(), tolerance) << one;
  } else if (one.contains("never")) {
    const Series series = recorded.series(one.at("never"));
    for (std::size_t i = from; i < to; ++i) ASSERT_EQ(series[i], 0.0) << one << " in step " << i;
  } else if (one.contains("rises") || one.contains("falls")) {
    const bool rises = one.contains("rises");
    const std::size_t step = change_of(recorded, one.at(rises ? "rises" : "falls"), rises);
    const double value = one.contains("value_of") ? recorded.at(signal_name(one.at("value_of")), step)
                                                  : static_cast<double>(step);
    EXPECT_NEAR(value, one.at("value").get<double>(), tolerance) << one;
  } else if (one.contains("after")) {
    const std::size_t step = recorded.slave_marks().at(0) + one.at("plus_ms").get<std::size_t>();
    EXPECT_NEAR(recorded.at(one.at("signal"), step), one.at("value").get<double>(), tolerance) << one;
  } else {
    ADD_FAILURE() << "not looked at: " << one;
  }
}

void expect_all(const char* id, const Json& variant = Json::object()) {
  const Json& scenario = mco305_scenario(id);
  Recorded recorded(scenario, variant);
  for (const Json& one : scenario.at("expect")) expect_one(recorded, one);
}

/// "final CPOS": 5, "tolerance": 1 of a variant.
void expect_final(const char* id) {
  const Json& scenario = mco305_scenario(id);
  for (const Json& variant : scenario.at("variants"))
    for (const auto& [key, value] : variant.items())
      if (key.starts_with("final ")) {
        Recorded recorded(scenario, variant);
        EXPECT_NEAR(recorded.last(key.substr(6)), value.get<double>(), variant.at("tolerance").get<double>())
            << variant;
      }
}

TEST(Mco305Synchronizing, S02ExactRatio) {
  expect_all("S02");
  expect_final("S02");
}

TEST(Mco305Synchronizing, S03VelocityFilter) {
  expect_all("S03");
  const Json& scenario = mco305_scenario("S03");
  for (const Json& variant : scenario.at("variants")) {
    Recorded recorded(scenario, variant);
    EXPECT_NEAR(recorded.at("SYSVAR[4231]/128", variant.at("at")),
                variant.at("SYSVAR[4231]/128").get<double>(), variant.at("tolerance").get<double>())
        << variant;
  }
}

TEST(Mco305Synchronizing, S04OntoARunningMaster) {
  expect_all("S04");
  // What lies between both when SYNCP is said stays there: the variant is about what is added to that.
  const Json& scenario = mco305_scenario("S04");
  const Json& variant = scenario.at("variants")[0];
  Recorded looks_ahead(scenario, Json::object()), lags(scenario, variant);
  EXPECT_NEAR(lags.last("MAPOS - CPOS") - looks_ahead.last("MAPOS - CPOS"),
              variant.at("final MAPOS - CPOS").get<double>(), variant.at("tolerance").get<double>());
}

TEST(Mco305Synchronizing, S05BandOfTheVelocity) {
  expect_all("S05");
}

TEST(Mco305Synchronizing, S06SpreadOffset) {
  expect_all("S06");
}

TEST(Mco305Synchronizing, S07StartsByMarkers) {
  const Json& scenario = mco305_scenario("S07");
  for (const Json& variant : scenario.at("variants")) {
    Recorded recorded(scenario, variant);
    EXPECT_NEAR(recorded.last("CPOS - MAPOS"), variant.at("final CPOS - MAPOS").get<double>(), 2.0)
        << variant;
    for (const Json& one : scenario.at("expect")) expect_one(recorded, one);
  }
}

TEST(Mco305Synchronizing, S08WindowsOfMarkers) {
  expect_all("S08");
  const Json& scenario = mco305_scenario("S08");
  for (Json variant : scenario.at("variants")) {
    variant["duration_ms"] = 4000;  // so long that the master gets there
    Recorded recorded(scenario, variant);
    const std::size_t step = change_of(recorded, "SYNCSTAT & 32", true);
    EXPECT_NEAR(recorded.at("MAPOS", step), variant.at("MMERR at MAPOS").get<double>(), 40.0) << variant;
  }
}

TEST(Mco305Synchronizing, S09ReadyAndFault) {
  expect_all("S09");
}

/// Between a pair and the next one.
double midway(Recorded& recorded, std::size_t pair) {
  const std::size_t step = (recorded.slave_marks().at(pair - 1) + recorded.slave_marks().at(pair)) / 2;
  return recorded.at("CPOS - MAPOS", step);
}

TEST(Mco305Synchronizing, S10Slip) {
  const Json& scenario = mco305_scenario("S10");
  const auto difference = [&](const Json& variant) {
    Recorded recorded(scenario, variant);
    return midway(recorded, 22) - midway(recorded, 2);
  };
  EXPECT_NEAR(difference(Json::object()), scenario.at("expect")[0].at("value").get<double>(), 5.0);
  for (const Json& variant : scenario.at("variants"))
    EXPECT_NEAR(difference(variant), variant.at("difference").get<double>(),
                variant.at("tolerance").get<double>())
        << variant;
}

TEST(Mco305Synchronizing, S11SpreadCorrection) {
  expect_all("S11");
}

TEST(Mco305Synchronizing, S12MarkerFilter) {
  expect_all("S12");
  const Json& scenario = mco305_scenario("S12");
  for (const Json& variant : scenario.at("variants")) {
    Recorded recorded(scenario, variant);
    Json mean = scenario.at("expect")[1];
    mean["tolerance"] = variant.at("tolerance");
    mean["value"] = variant.at("mean");
    expect_one(recorded, mean);
  }
}

TEST(Mco305Synchronizing, S18VirtualMaster) {
  expect_all("S18");
  const Json& scenario = mco305_scenario("S18");
  Recorded off(scenario, scenario.at("variants")[0]);
  EXPECT_EQ(off.last("SYSVAR[4110]"), 0.0);
}

}  // namespace
}  // namespace synchronizing_scenario_test
}  // namespace lockstep
