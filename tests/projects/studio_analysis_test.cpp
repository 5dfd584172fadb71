// What the studio computes of traces, against what the curves in them are known to have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/projects/studio_files.hpp"

namespace lockstep::studio_analysis_test {
namespace {

using Json = nlohmann::json;
using test::csv_of;
using test::DecodedFrame;
using test::exact;

constexpr double kTurn = 2.0 * std::numbers::pi;

class Studio : public test::StudioOfFiles {
 public:
  std::string open_text(const std::string& name, const std::string& text) {
    return open(folder.write(name, text));
  }
  Json spectrum(const std::string& id, std::vector<std::pair<std::string, std::string>> query) {
    const StudioAnswer answer = ask("GET", "/api/traces/" + id + "/spectrum", std::move(query));
    EXPECT_EQ(answer.status, 200u) << answer.body;
    return Json::parse(answer.body);
  }

  test::StudioFolder folder;
};

/// 1000 rows of a mean of 3, 2 at 50 Hz and 0.5 at 120 Hz.
std::string two_sines() {
  return csv_of("v", 1000, [](int i) {
    const double t = i * 1e-3;
    return exact(3.0 + 2.0 * std::sin(kTurn * 50.0 * t) + 0.5 * std::cos(kTurn * 120.0 * t));
  });
}

TEST(StudioSpectrum, HasTheAmplitudesOfSinesAtTheirFrequenciesInEachWindow) {
  Studio studio;
  const std::string id = studio.open_text("sines.csv", two_sines());
  for (const std::string window : {"hann", "rectangle", "flattop"}) {
    const Json json = studio.spectrum(id, {{"signal", "v"}, {"window", window}});
    EXPECT_EQ(json.at("axis"), "Hz");
    EXPECT_EQ(json.at("n"), 1000);
    EXPECT_EQ(json.at("width"), 1);
    EXPECT_NEAR(json.at("step").get<double>(), 1.0, 1e-9) << "one by the second that it lasts";
    const Json& lines = json.at("amplitude");
    ASSERT_EQ(lines.size(), 501u) << "from 0 to half of the rate";
    EXPECT_NEAR(lines[0].get<double>(), 3.0, 1e-9) << window;
    EXPECT_NEAR(lines[50].get<double>(), 2.0, 1e-6) << window;
    EXPECT_NEAR(lines[120].get<double>(), 0.5, 1e-6) << window;
    EXPECT_LT(lines[80].get<double>(), 1e-6) << window;
    ASSERT_GE(json.at("peaks").size(), 2u);
    EXPECT_NEAR(json.at("peaks")[0].at("at").get<double>(), 50.0, 0.01) << window;
    EXPECT_NEAR(json.at("peaks")[0].at("amplitude").get<double>(), 2.0, 1e-3) << window;
    EXPECT_NEAR(json.at("peaks")[1].at("at").get<double>(), 120.0, 0.01) << window;
  }
}

TEST(StudioSpectrum, FindsASineBetweenTwoLines) {
  Studio studio;
  const std::string id = studio.open_text(
      "between.csv", csv_of("v", 1000, [](int i) { return exact(2.0 * std::sin(kTurn * 50.4 * i * 1e-3)); }));
  const Json flat = studio.spectrum(id, {{"signal", "v"}, {"window", "flattop"}});
  EXPECT_NEAR(flat.at("peaks")[0].at("at").get<double>(), 50.4, 0.5);
  EXPECT_NEAR(flat.at("peaks")[0].at("amplitude").get<double>(), 2.0, 0.02) << "what the window is for";
  const Json hann = studio.spectrum(id, {{"signal", "v"}});
  EXPECT_EQ(hann.at("window"), "hann");
  EXPECT_NEAR(hann.at("peaks")[0].at("at").get<double>(), 50.4, 0.1);
}

TEST(StudioSpectrum, CountsByTurnsOfALeadingAxisThatGainsSpeed) {
  Studio studio;
  // Ten turns ever faster, wrapped at one; three waves to each.
  const auto turns = [](int i) { return 10.0 * (0.5 * i / 4999.0 + 0.5 * (i / 4999.0) * (i / 4999.0)); };
  const std::string id = studio.open_text("orders.csv", csv_of("p,v", 5000, [&](int i) {
                                            return exact(std::fmod(turns(i), 1.0)) + "," +
                                                   exact(1.5 * std::sin(kTurn * 3.0 * turns(i)));
                                          }));
  const Json json = studio.spectrum(id, {{"signal", "v"}, {"order", "p"}});
  EXPECT_EQ(json.at("axis"), "order");
  EXPECT_NEAR(json.at("peaks")[0].at("at").get<double>(), 3.0, 0.03);
  EXPECT_NEAR(json.at("peaks")[0].at("amplitude").get<double>(), 1.5, 0.02);
}

TEST(StudioSpectrum, IsRefusedWhereItWouldTellNothing) {
  Studio studio;
  const std::string uneven = studio.open_text("uneven.csv", "t,v\n0,1\n1,2\n2,3\n4,4\n5,5\n");
  const std::string holes = studio.open_text("holes.csv", "t,v\n0,1\n1,nan\n2,3\n3,4\n4,5\n");
  const std::string back = studio.open_text("back.csv", "t,p,v\n0,0,1\n1,1,2\n2,2,3\n3,1.5,4\n4,1,5\n");
  const auto refused = [&](const std::string& id, std::vector<std::pair<std::string, std::string>> query) {
    const StudioAnswer answer = studio.ask("GET", "/api/traces/" + id + "/spectrum", std::move(query));
    return std::pair(answer.status, answer.body);
  };
  const auto uneven_answer = refused(uneven, {{"signal", "v"}});
  EXPECT_EQ(uneven_answer.first, 409u);
  EXPECT_NE(uneven_answer.second.find("4000000000 ns"), std::string::npos)
      << "where: " << uneven_answer.second;
  const auto hole_answer = refused(holes, {{"signal", "v"}});
  EXPECT_EQ(hole_answer.first, 409u);
  EXPECT_NE(hole_answer.second.find("1000000000 ns"), std::string::npos) << hole_answer.second;
  EXPECT_EQ(refused(holes, {{"signal", "v"}, {"from", "2000000000"}}).first, 416u) << "three rows";
  EXPECT_EQ(refused(back, {{"signal", "v"}, {"order", "p"}}).first, 409u) << "it turns back";
  EXPECT_EQ(refused(back, {{"signal", "v"}, {"order", "q"}}).first, 422u);
  EXPECT_EQ(refused(back, {{"signal", "w"}}).first, 422u);
  EXPECT_EQ(refused(back, {}).first, 422u);
  EXPECT_EQ(refused(back, {{"signal", "v"}, {"window", "hamming"}}).first, 422u);
  EXPECT_EQ(refused(back, {{"signal", "v"}, {"from", "soon"}}).first, 422u);
  EXPECT_EQ(refused(back, {{"signal", "v"}, {"from", "4"}, {"to", "3"}}).first, 416u);
}

TEST(StudioXy, PairsRowsOfTheSameTimeAlsoOfTwoTraces) {
  Studio studio;
  const std::string a = studio.open_text(
      "a.csv", csv_of("x,y", 200, [](int i) { return std::to_string(i) + "," + std::to_string(i * i); }));
  const std::string b = studio.open_text("b.csv", csv_of("y", 150, [](int i) { return std::to_string(-i); }));
  const DecodedFrame one(studio.ask("GET", "/api/traces/" + a + "/xy", {{"x", "x"}, {"y", "y"}}).body);
  ASSERT_TRUE(one.is_whole);
  EXPECT_EQ(one.kind, 3);
  ASSERT_EQ(one.t.size(), 200u);
  for (std::size_t i = 0; i < one.t.size(); ++i) {
    EXPECT_EQ(one.t[i], static_cast<std::int64_t>(i) * 1'000'000);
    EXPECT_EQ(one.columns[0].real(0, i), static_cast<double>(i));
    EXPECT_EQ(one.columns[1].real(0, i), static_cast<double>(i * i));
  }
  // A row of the other, 10 ms later.
  const DecodedFrame two(
      studio
          .ask("GET", "/api/traces/" + a + "/xy",
               {{"x", "x"}, {"y", "y"}, {"with", b}, {"shift", "10000000"}, {"from", "20000000"}})
          .body);
  ASSERT_TRUE(two.is_whole);
  ASSERT_EQ(two.t.size(), 120u) << "from row 20 to the end of the other, row 139";
  EXPECT_EQ(two.columns[0].real(0, 0), 20.0);
  EXPECT_EQ(two.columns[1].real(0, 0), -30.0);
  EXPECT_EQ(two.columns[1].real(0, 119), -149.0);
}

TEST(StudioXy, KeepsSinglePeaksOfBothAlsoBehindRowsWithoutANumber) {
  Studio studio;
  const std::string id =
      studio.open_text("peaks.csv", csv_of("x,y", 10000, [](int i) {
                         if (i % 1000 == 0) return std::string("nan,nan");
                         return std::string(i == 2345 ? "7" : "0") + "," + (i == 6789 ? "-9" : "0");
                       }));
  const DecodedFrame frame(
      studio.ask("GET", "/api/traces/" + id + "/xy", {{"x", "x"}, {"y", "y"}, {"points", "10"}}).body);
  ASSERT_TRUE(frame.is_whole);
  EXPECT_LE(frame.t.size(), 60u);
  double highest = 0.0, lowest = 0.0;
  for (std::size_t i = 0; i < frame.t.size(); ++i) {
    highest = std::max(highest, frame.columns[0].real(0, i));
    lowest = std::min(lowest, frame.columns[1].real(0, i));
  }
  EXPECT_EQ(highest, 7.0);
  EXPECT_EQ(lowest, -9.0);
}

TEST(StudioXy, IsRefusedWithoutSignalsOrRows) {
  Studio studio;
  const std::string a = studio.open_text("a.csv", "t,x\n0,1\n1,2\n");
  const std::string b = studio.open_text("b.csv", "t,x\n10,1\n11,2\n");
  const auto status = [&](std::vector<std::pair<std::string, std::string>> query) {
    return studio.ask("GET", "/api/traces/" + a + "/xy", std::move(query)).status;
  };
  EXPECT_EQ(status({{"x", "x"}}), 422u);
  EXPECT_EQ(status({{"x", "x"}, {"y", "z"}}), 422u);
  EXPECT_EQ(status({{"x", "x"}, {"y", "x"}, {"with", "file-9"}}), 404u);
  EXPECT_EQ(status({{"x", "x"}, {"y", "x"}, {"with", b}}), 416u);
  EXPECT_EQ(status({{"x", "x"}, {"y", "x"}, {"with", b}, {"shift", "10000000000"}}), 200u);
  EXPECT_EQ(status({{"x", "x"}, {"y", "x"}, {"shift", "9223372036854775807"}}), 422u);
  EXPECT_EQ(status({{"x", "x"}, {"y", "x"}, {"points", "0"}}), 422u);
  EXPECT_EQ(status({{"x", "x"}, {"y", "x"}, {"points", "20001"}}), 422u);
}

TEST(StudioCompare, TellsTheFirstRowThatDiffersAndTheGreatestDifference) {
  Studio studio;
  const std::string a =
      studio.open_text("a.csv", csv_of("p,q,r", 100, [](int i) { return std::to_string(i) + ",5,1"; }));
  const std::string b = studio.open_text("b.csv", csv_of("q,p,s", 90, [](int i) {
                                           const double p = i == 40 ? 40.25 : i == 60 ? 57.0 : i;
                                           return std::string(i >= 30 ? "5.5" : "5") + "," + exact(p) + ",1";
                                         }));
  const Json json = studio.get("/api/compare", {{"a", a}, {"b", b}});
  EXPECT_EQ(json.at("rows"), 90);
  EXPECT_EQ(json.at("only_a"), 10);
  EXPECT_EQ(json.at("only_b"), 0);
  ASSERT_EQ(json.at("signals").size(), 2u) << "those that both have";
  const Json& p = json.at("signals")[0];
  EXPECT_EQ(p.at("path"), "p");
  EXPECT_EQ(p.at("different"), 2);
  EXPECT_EQ(p.at("first").at("t"), "40000000");
  EXPECT_EQ(p.at("first").at("a"), 40.0);
  EXPECT_EQ(p.at("first").at("b"), 40.25);
  EXPECT_EQ(p.at("maximum").at("difference"), 3.0);
  EXPECT_EQ(p.at("maximum").at("t"), "60000000");
  EXPECT_EQ(json.at("signals")[1].at("different"), 60);
  EXPECT_EQ(json.at("first").at("path"), "q");
  EXPECT_EQ(json.at("first").at("t"), "30000000");
  EXPECT_EQ(json.at("first").at("tick"), "30");
  const Json rough = studio.get("/api/compare", {{"a", a}, {"b", b}, {"tolerance", "0.5"}});
  EXPECT_EQ(rough.at("signals")[0].at("different"), 1);
  EXPECT_EQ(rough.at("signals")[1].at("different"), 0);
  EXPECT_EQ(rough.at("first").at("t"), "60000000");
  const Json same = studio.get("/api/compare", {{"a", a}, {"b", a}});
  EXPECT_TRUE(same.at("first").is_null());
  const Json shifted =
      studio.get("/api/compare", {{"a", a}, {"b", a}, {"signals", "p"}, {"shift", "1000000"}});
  EXPECT_EQ(shifted.at("rows"), 99);
  EXPECT_EQ(shifted.at("signals")[0].at("different"), 99);
  EXPECT_EQ(shifted.at("signals")[0].at("maximum").at("difference"), 1.0);
}

TEST(StudioCompare, KeepsTheGreatestDifferenceBehindRowsWithoutANumber) {
  Studio studio;
  const std::string a = studio.open_text("a.csv", "t,v,w\n0,0,nan\n1,0,1\n2,0,1\n3,0,1\n");
  const std::string b = studio.open_text("b.csv", "t,v,w\n0,nan,nan\n1,5,1\n2,nan,1\n3,0.5,1\n");
  const Json json = studio.get("/api/compare", {{"a", a}, {"b", b}});
  EXPECT_EQ(json.at("signals")[0].at("different"), 4);
  EXPECT_EQ(json.at("signals")[0].at("first").at("b"), "nan");
  EXPECT_EQ(json.at("signals")[0].at("maximum").at("difference"), 5.0);
  EXPECT_EQ(json.at("signals")[0].at("maximum").at("t"), "1000000000");
  EXPECT_EQ(json.at("signals")[1].at("different"), 0) << "no number on both sides is the same";
}

// Two neighbours of this size are the same real number.
TEST(StudioCompare, ComparesWholeNumbersToTheirLastDigit) {
  test::StudioMachine machine(
      Simulation::from_text(R"({ "lockstep": 1, "name": "wide", "clock": { "servo_cycle": "1ms" },
    "technology_objects": {}, "tags": { "wide": { "type": "LINT", "init": 1152921504606846976 } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [ { "set": "wide", "to": "wide + 1" } ] } ] })"));
  test::StudioPage page;
  machine.session.opened(page);
  machine.session.text(page, R"({"type":"hello"})");
  machine.session.text(page, R"({"type":"subscribe","id":1,"paths":["wide"]})");
  machine.run(20);
  const Json json = machine.get("/api/compare", {{"a", "live"}, {"b", "live"}, {"shift", "1000000"}});
  ASSERT_GT(json.at("rows").get<int>(), 5);
  const Json& wide = json.at("signals")[0];
  EXPECT_EQ(wide.at("different"), json.at("rows"));
  EXPECT_EQ(wide.at("maximum").at("difference"), "1");
  EXPECT_EQ(std::stoll(wide.at("first").at("b").get<std::string>()),
            std::stoll(wide.at("first").at("a").get<std::string>()) + 1);
  const Json rough =
      machine.get("/api/compare", {{"a", "live"}, {"b", "live"}, {"shift", "1000000"}, {"tolerance", "1"}});
  EXPECT_EQ(rough.at("signals")[0].at("different"), 0);
  machine.session.closed(page);
}

TEST(StudioCompare, IsRefusedWithoutSomethingToCompare) {
  Studio studio;
  const std::string a = studio.open_text("a.csv", "t,x\n0,1\n1,2\n");
  const std::string b = studio.open_text("b.csv", "t,y\n0,1\n1,2\n");
  const auto status = [&](std::vector<std::pair<std::string, std::string>> query) {
    query.emplace_back("a", a);
    return studio.ask("GET", "/api/compare", std::move(query)).status;
  };
  EXPECT_EQ(status({{"b", b}}), 422u);
  EXPECT_EQ(status({{"b", a}, {"signals", "y"}}), 422u);
  EXPECT_EQ(status({{"b", "file-9"}}), 404u);
  EXPECT_EQ(status({{"b", a}, {"tolerance", "-1"}}), 422u);
  EXPECT_EQ(status({{"b", a}, {"tolerance", "inf"}}), 422u);
  EXPECT_EQ(status({{"b", a}, {"shift", "1e3"}}), 422u);
}

/// The values of a derived signal of a trace.
std::vector<double> derived(Studio& studio, const std::string& id, const std::string& signal) {
  const StudioAnswer made =
      studio.ask("POST", "/api/traces/" + id + "/derived", {}, Json{{"signal", signal}}.dump());
  EXPECT_EQ(made.status, 200u) << made.body;
  const DecodedFrame frame(
      studio.ask("GET", "/api/traces/" + id + "/window", {{"signal", signal}, {"pixels", "20000"}}).body);
  std::vector<double> values;
  if (!frame.is_whole || frame.columns.empty()) return values;
  for (std::size_t i = 0; i < frame.t.size(); ++i) values.push_back(frame.columns[0].real(0, i));
  return values;
}

TEST(StudioDerivedSignals, AreComputedOfTheRowsOfATrace) {
  Studio studio;
  constexpr int kRows = 9000;  // of three portions of the store
  const std::string id = studio.open_text("s.csv", csv_of("p,q", kRows, [](int i) {
                                            return exact(std::sin(i * 1e-3)) + "," + std::to_string(i % 7);
                                          }));
  const std::vector<double> sum = derived(studio, id, "=p + 2.0 * q");
  const std::vector<double> slope = derived(studio, id, "=derivative(p)");
  const std::vector<double> area = derived(studio, id, "= integral( p )");
  const std::vector<double> mean = derived(studio, id, "=mean(q, 7ms)");
  for (const std::vector<double>* values : {&sum, &slope, &area, &mean})
    ASSERT_EQ(values->size(), static_cast<std::size_t>(kRows));
  EXPECT_TRUE(std::isnan(slope[0])) << "nothing comes before it";
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double t = static_cast<double>(i) * 1e-3;
    ASSERT_DOUBLE_EQ(sum[i], std::sin(t) + 2.0 * static_cast<double>(i % 7)) << i;
    if (i > 0) {
      ASSERT_NEAR(slope[i], std::cos(t - 0.5e-3), 1e-6) << i;
    }
    ASSERT_NEAR(area[i], 1.0 - std::cos(t), 1e-6) << i;
    if (i >= 6) {
      ASSERT_DOUBLE_EQ(mean[i], 3.0) << i;
    }
  }
  EXPECT_DOUBLE_EQ(mean[2], 1.0) << "of the rows that there are: 0, 1, 2";
  const Json told = studio.told(id);
  EXPECT_EQ(told.at("signals").size(), 6u);
  EXPECT_EQ(told.at("rows"), kRows);
}

TEST(StudioDerivedSignals, OfAComparisonAreTrueOrFalseAndAreMadeOnce) {
  Studio studio;
  const std::string id = studio.open_text("s.csv", "t,p\n0,1\n1,2\n2,3\n");
  const std::string ask = Json{{"signal", "=p > 1.5"}}.dump();
  const Json made = Json::parse(studio.ask("POST", "/api/traces/" + id + "/derived", {}, ask).body);
  EXPECT_EQ(made.at("type"), "BOOL") << made;
  EXPECT_EQ(studio.ask("POST", "/api/traces/" + id + "/derived", {}, ask).status, 200u);
  EXPECT_EQ(studio.told(id).at("signals").size(), 2u);
  EXPECT_EQ(studio.ask("GET", "/api/traces/" + id + "/export", {{"signal", "=p > 1.5"}}).body,
            "t,=p > 1.5\n0,0\n1,1\n2,1\n");
}

TEST(StudioDerivedSignals, AreRefusedWithTheReasonAndLeaveTheTraceAsItIs) {
  Studio studio;
  const std::string id = studio.open_text("s.csv", "t,p\n0,1\n1,2\n");
  const auto refused = [&](const std::string& body) {
    const StudioAnswer answer = studio.ask("POST", "/api/traces/" + id + "/derived", {}, body);
    EXPECT_FALSE(Json::parse(answer.body).at("error").at("message").get<std::string>().empty()) << body;
    return answer.status;
  };
  for (const std::string signal : {"=q", "=p +", "=", "p", "=mean(p)", "=mean(p, 0ms)", "=mean(p, soon)",
                                   "=derivative()", "=p; p", "=integral(derivative(p))", "=p := 1"})
    EXPECT_EQ(refused(Json{{"signal", signal}}.dump()), 422u) << signal;
  EXPECT_EQ(refused("{}"), 422u);
  EXPECT_EQ(refused("[]"), 422u);
  EXPECT_EQ(refused(R"({"signal":7})"), 422u);
  EXPECT_EQ(refused(R"({"signal")"), 422u);
  EXPECT_EQ(refused(Json{{"signal", "=" + std::string(100'000, '(') + "p"}}.dump()), 422u);
  EXPECT_EQ(studio.told(id).at("signals").size(), 1u);
  const std::string good = Json{{"signal", "=p"}}.dump();
  EXPECT_EQ(studio.ask("POST", "/api/traces/live/derived", {}, good).status, 409u);
  EXPECT_EQ(studio.ask("POST", "/api/traces/file-9/derived", {}, good).status, 404u);
}

}  // namespace
}  // namespace lockstep::studio_analysis_test
