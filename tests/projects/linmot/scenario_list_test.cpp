// Every scenario of this stage is run, each of its expectations looked at, and by what they are known it is
// told.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>

#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_scenario_list_test {
namespace {

constexpr const char* kTell = "LOCKSTEP_TELL_EXPECTATIONS";
constexpr const char* kMark = "looked at: ";

/// In the process that runs the scenarios: tells at its end what has been looked at.
class Teller : public testing::Environment {
 public:
  void TearDown() override {
    if (std::getenv(kTell) == nullptr) return;
    for (const auto& [scenario, what] : looked_at()) std::cout << kMark << scenario << " " << what << "\n";
  }
};
const testing::Environment* const kTeller = testing::AddGlobalTestEnvironment(new Teller);

struct Ran {
  int status = -1;
  std::set<std::string> looked_at;  // "L01 expect 0"
  std::string output;
};

/// Runs the scenarios of this program in a process of their own.
Ran run_scenarios() {
  char path[4096] = {};
  const ssize_t length = ::readlink("/proc/self/exe", path, sizeof path - 1);
  EXPECT_GT(length, 0);
  const std::string command = "env -u GTEST_OUTPUT -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX " +
                              std::string(kTell) + "=1 '" + path + "' --gtest_filter='LinMotScenario.*' 2>&1";
  Ran ran;
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return ran;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) ran.output += buffer;
  ran.status = ::pclose(pipe);
  std::istringstream lines(ran.output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(kMark)) ran.looked_at.insert(line.substr(std::string(kMark).size()));
  return ran;
}

/// Of this stage, and what of it is for a later one.
bool is_of_this_stage(const std::string& scenario) {
  return scenario <= "L16";
}
const std::set<std::string> kLater = {"L12 expect 2",   // the diagnosis
                                      "L15 expect 4",   // a slave
                                      "L15 expect 5"};  // a stepper

std::string basis_of(const Json& entry) {
  const std::string basis = entry.value("basis", "derived");
  for (const char* const word :
       {"printed", "derived", "closed form", "simulated", "decision", "bits printed"})
    if (basis.starts_with(word)) return basis.starts_with("bits") ? "printed" : word;
  return "derived";
}

TEST(LinMotScenarios, AreAllRunAndLookedAt) {
  const Ran ran = run_scenarios();
  ASSERT_EQ(ran.status, 0) << ran.output;
  std::map<std::string, int> passed;
  int scenarios = 0;
  for (const Json& scenario : linmot_document("scenarios").at("scenarios")) {
    const std::string id = scenario.at("id");
    if (!is_of_this_stage(id)) continue;
    ++scenarios;
    for (std::size_t i = 0; i < scenario.at("expect").size(); ++i) {
      const std::string name = id + " expect " + std::to_string(i);
      if (kLater.contains(name)) continue;
      EXPECT_TRUE(ran.looked_at.contains(name)) << name << " " << scenario.at("expect")[i];
      ++passed[basis_of(scenario.at("expect")[i])];
    }
    for (std::size_t i = 0; i < scenario.at("steps").size(); ++i) {
      if (!scenario.at("steps")[i].contains("basis")) continue;
      EXPECT_TRUE(ran.looked_at.contains(id + " steps " + std::to_string(i))) << id << " " << i;
      ++passed[basis_of(scenario.at("steps")[i])];
    }
  }
  EXPECT_EQ(scenarios, 16);
  for (const auto& [basis, count] : passed) std::cout << basis << ": " << count << " passed\n";
  EXPECT_GE(passed["printed"], 30);
}

}  // namespace
}  // namespace lockstep::linmot_scenario_list_test
