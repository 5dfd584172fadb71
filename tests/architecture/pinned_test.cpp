// Decisions: what a table of them says it is pinned by is a test, or a source, that is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::pinned_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolders[] = {"tech_objects", "fb", "scheduler", "hmi_bridge", "projects", "cli"};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What there is to pin something: "Suite", "Test", "Suite.Test", "Instance/Suite" and the sources of tests.
using Tests = std::set<std::string>;

/// Takes those of a source; each begins a line.
void add_tests_of(const std::string& source, Tests& tests) {
  const std::regex test("(TEST|TEST_F|TEST_P|INSTANTIATE_TEST_SUITE_P)\\(\\s*(\\w+),\\s*(\\w+)");
  for (std::size_t line = 0; line < source.size();
       line = std::min(source.find('\n', line), source.size()) + 1) {
    if (source.compare(line, 4, "TEST") != 0 && source.compare(line, 4, "INST") != 0) continue;
    std::smatch found;
    if (!std::regex_search(source.begin() + static_cast<std::ptrdiff_t>(line), source.end(), found, test,
                           std::regex_constants::match_continuous))
      continue;
    const std::string first = found[2].str();
    const std::string second = found[3].str();
    if (source[line] == 'I')
      tests.insert(first + "/" + second);
    else
      tests.insert({first, second, first + "." + second});
  }
}

Tests all_tests() {
  Tests tests;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(LOCKSTEP_SOURCE_DIR) / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    tests.insert(entry.path().stem().string());
    add_tests_of(text_of(entry.path()), tests);
  }
  return tests;
}

/// Whether a text is as a pattern has it, in which "…" stands for any part.
bool matches(std::string_view text, std::string_view pattern) {
  constexpr std::string_view kAny = "…";
  const std::size_t gap = pattern.find(kAny);
  if (gap == pattern.npos) return text == pattern;
  if (!text.starts_with(pattern.substr(0, gap))) return false;
  const std::string_view rest = pattern.substr(gap + kAny.size());
  for (std::size_t at = gap; at <= text.size(); ++at)
    if (matches(text.substr(at), rest)) return true;
  return false;
}

/// Whether a test has the name; "Suite.*" are all tests of a suite.
bool is_test(std::string_view name, const Tests& tests) {
  if (name.ends_with(".*")) name.remove_suffix(2);
  return std::any_of(tests.begin(), tests.end(),
                     [&](const std::string& test) { return matches(test, name); });
}

/// The last cell of each row of the tables whose last column is "pinned by".
std::vector<std::string> pins_in(const std::string& readme) {
  std::vector<std::string> pins;
  bool inside = false;
  for (std::size_t begin = 0; begin < readme.size();) {
    const std::size_t end = std::min(readme.find('\n', begin), readme.size());
    const std::string line = readme.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t bar = line.rfind(" | ");
    const bool row = bar != line.npos && line.starts_with("|") && line.ends_with(" |");
    const std::string cell = row ? line.substr(bar + 3, line.size() - bar - 5) : "";
    if (!line.starts_with("|"))
      inside = false;
    else if (cell == "pinned by")
      inside = true;
    else if (inside && row)
      pins.push_back(cell);
  }
  return pins;
}

/// What is wrong with a cell, one a line: nothing named, or names that nothing has.
std::string faults_of(const std::string& pin, const Tests& tests, const fs::path& folder) {
  if (pin == "–") return "";  // nothing that a test could see
  std::string faults;
  int named = 0;
  const std::regex quoted("`([^`]+)`");
  for (std::sregex_iterator found(pin.begin(), pin.end(), quoted); found != std::sregex_iterator(); ++found) {
    const std::string name = (*found)[1].str();
    if (!is_test(name, tests) && !fs::is_regular_file(folder / name)) faults += "no test " + name + "\n";
    ++named;
  }
  return named > 0 ? faults : "names nothing: " + pin + "\n";
}

TEST(Decisions, ArePinnedByTestsThatAreThere) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  const Tests tests = all_tests();
  std::size_t pins = 0;
  for (const char* folder : kFolders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".md") continue;
      for (const std::string& pin : pins_in(text_of(entry.path()))) {
        EXPECT_EQ(faults_of(pin, tests, entry.path().parent_path()), "") << entry.path() << ": " << pin;
        ++pins;
      }
    }
  EXPECT_GT(pins, 250u);
}

// The rule itself.

TEST(DecisionRules, FindNamesThatNoTestHas) {
  Tests tests = {"timers_test"};
  add_tests_of(
      "TEST(Timer, StartsAtOnce) {}\nTEST_F(Gear,\n  Turns) {}\n// TEST(Not, This)\n"
      "INSTANTIATE_TEST_SUITE_P(Cam, Rules, 1);\n",
      tests);
  const fs::path folder = fs::path(LOCKSTEP_SOURCE_DIR) / "tests/architecture";
  const auto faults = [&](const std::string& pin) { return faults_of(pin, tests, folder); };
  EXPECT_EQ(faults("`timers_test`, `Timer`, `Turns`, `Gear.Turns`, `Gear.*`, `Cam/Rules`"), "");
  EXPECT_EQ(faults("`Starts…`, `…AtOnce`, `Ti…Once`, `Gear.T…`, `pinned_test.cpp`, –"), "");
  EXPECT_EQ(faults("`Timers`, `starts…`, `AtOnce…`, `Not`"),
            "no test Timers\nno test starts…\nno test AtOnce…\nno test Not\n");
  EXPECT_EQ(faults("`Start`"), "no test Start\n");
  EXPECT_EQ(faults("scenario tests"), "names nothing: scenario tests\n");
  EXPECT_EQ(faults("–"), "");
}

TEST(DecisionRules, ReadTheLastColumnOfTheirTables) {
  EXPECT_EQ(pins_in("| a | pinned by |\n|---|---|\n| x | `y` |\n\n| b | `z` |\n"),
            (std::vector<std::string>{"`y`"}));
}

}  // namespace
}  // namespace lockstep::pinned_test
