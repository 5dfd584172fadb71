// Which tests hold which scenario and which feature: the tables in tests/data/mco305/COVERAGE.md.
#include <filesystem>
#include <regex>
#include <set>

#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep::mco305_coverage_test {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::string subject, tests;
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The rows of both tables, without their heads.
std::vector<Row> rows() {
  const std::string text = text_of(fs::path(LOCKSTEP_TEST_DATA) / "mco305" / "COVERAGE.md");
  static const std::regex kRow(R"(\n\| ((?:S\d\d)|(?:\d+ [^|]+)) \| ([^|]+) \|)");
  std::vector<Row> all;
  for (std::sregex_iterator at(text.begin(), text.end(), kRow), end; at != end; ++at)
    all.push_back({(*at)[1], (*at)[2]});
  return all;
}

/// Names such as Suite.Name.
std::vector<std::string> named_in(const std::string& text) {
  static const std::regex kName(R"(\b[A-Z]\w+\.[A-Z]\w+\b)");
  std::vector<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), kName), end; at != end; ++at)
    all.push_back(at->str());
  return all;
}

/// All tests of all folders.
const std::set<std::string>& tests_there_are() {
  static const std::set<std::string> all = [] {
    static const std::regex kTest(R"(\nTEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
    std::set<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(LOCKSTEP_SOURCE_DIR) / "tests")) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string text = text_of(entry.path());
      for (std::sregex_iterator at(text.begin(), text.end(), kTest), end; at != end; ++at)
        found.insert((*at)[1].str() + "." + (*at)[2].str());
    }
    return found;
  }();
  return all;
}

bool runs_here(const std::string& name) {
  const testing::UnitTest& unit = *testing::UnitTest::GetInstance();
  for (int i = 0; i < unit.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *unit.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k)
      if (name == std::string(suite.name()) + "." + suite.GetTestInfo(k)->name()) return true;
  }
  return false;
}

TEST(Mco305Coverage, EveryTestThatIsNamedExists) {
  std::size_t named = 0;
  for (const Row& row : rows())
    for (const std::string& name : named_in(row.tests)) {
      EXPECT_TRUE(tests_there_are().contains(name)) << row.subject << ": " << name;
      ++named;
    }
  EXPECT_GT(named, 80u);
}

TEST(Mco305Coverage, EveryScenarioIsRunButThoseOfCurves) {
  const Json document =
      Json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/mco305/scenarios.json"));
  std::string sources;
  for (const auto& entry : fs::directory_iterator(fs::path(LOCKSTEP_SOURCE_DIR) / "tests/scheduler/mco305"))
    if (entry.path().filename().string().find("scenario_test") != std::string::npos)
      sources += text_of(entry.path());
  std::map<std::string, std::vector<std::string>> tests;
  for (const Row& row : rows())
    if (row.subject[0] == 'S') tests[row.subject] = named_in(row.tests);
  const std::set<std::string> curves = {"S13", "S14", "S15"};
  std::size_t scenarios = 0;
  for (const Json& scenario : document.at("scenarios")) {
    const std::string id = scenario.at("id");
    ++scenarios;
    ASSERT_TRUE(tests.contains(id)) << id;
    EXPECT_EQ(tests[id].empty(), curves.contains(id)) << id;
    for (const std::string& name : tests[id]) {
      EXPECT_NE(name.find("." + id), std::string::npos) << name;
      EXPECT_TRUE(runs_here(name)) << name;
      EXPECT_NE(sources.find("\"" + id + "\""), std::string::npos) << id << " is not read from the file";
    }
  }
  EXPECT_EQ(tests.size(), scenarios);
}

TEST(Mco305Coverage, EverySectionOfTheFeaturesHasATestOrIsNotBuilt) {
  std::set<int> seen;
  const std::set<int> not_built = {21, 22, 23, 24, 25, 26, 38, 39, 40, 41}, elsewhere = {42, 43};
  for (const Row& row : rows()) {
    if (row.subject[0] == 'S') continue;
    const int section = std::stoi(row.subject);
    seen.insert(section);
    const bool has_tests = !named_in(row.tests).empty();
    EXPECT_EQ(has_tests, !not_built.contains(section) && !elsewhere.contains(section)) << row.subject;
  }
  EXPECT_EQ(seen.size(), 43u);
}

}  // namespace
}  // namespace lockstep::mco305_coverage_test
