// Blocks reach an axis in two ways, by jobs and by claims. Whatever else they have of it they only look at.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <string_view>

#include "tests/architecture/source_text.hpp"

namespace lockstep::blocks_and_axes_test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kJobs = "submit";
/// Requests with an owner, which one instance at a time writes.
const std::set<std::string, std::less<>> kClaims = {"power", "additive_request", "simulation_request",
                                                    "forces"};
/// What stands open to be read.
const std::set<std::string, std::less<>> kRead = {"data", "kind"};

/// The headers that say what there is of an axis.
constexpr const char* kHeaders[] = {"tech_objects/axis/axis.hpp", "tech_objects/axis/axis_parts.hpp",
                                    "tech_objects/objects/leading_object.hpp",
                                    "tech_objects/objects/technology_object.hpp"};

/// The names by which blocks have an axis in their hands.
constexpr const char* kNames = "Axis|Slave|Master|axis|slave|target";

std::string code_in(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return code_of(std::string{std::istreambuf_iterator<char>(file), {}}, false);
}

/// Functions that change nothing: those declared const.
std::set<std::string> looks_declared(const std::string& code) {
  const std::regex declaration(R"((\w+)\([^()]*\)\s*const\b)");
  std::set<std::string> names;
  for (std::sregex_iterator found(code.begin(), code.end(), declaration); found != std::sregex_iterator();
       ++found)
    names.insert((*found)[1].str());
  return names;
}

std::set<std::string> looks_of_an_axis() {
  std::set<std::string> all;
  for (const char* header : kHeaders)
    all.merge(looks_declared(code_in(fs::path(LOCKSTEP_SOURCE_DIR) / header)));
  return all;
}

std::string at(const std::string& path, const std::string& code, std::ptrdiff_t place) {
  return path + ":" + std::to_string(1 + std::count(code.begin(), code.begin() + place, '\n')) + ": ";
}

/// What a source does with an axis besides, one a line.
std::string faults_of(const std::string& path, const std::string& code, const std::set<std::string>& looks) {
  const std::string names = kNames;
  const std::regex use("\\b(?:" + names + ")\\b(?:\\(\\))?\\)?\\s*(?:->|\\.)\\s*(\\w+)(\\s*\\()?");
  const std::regex write("\\b(?:" + names +
                         R"()\b\)?\s*(?:->|\.)\s*data\b[\w.\[\]]*\s*(?:=[^=]|[-+*/|&]=|\+\+|--))");
  const std::regex other_name(R"(\b(?:Axis|LeadingObject|TechnologyObject)\s*[*&]\s*(\w+))");
  std::string faults;
  for (std::sregex_iterator one(code.begin(), code.end(), use); one != std::sregex_iterator(); ++one) {
    const std::string member = (*one)[1].str();
    const bool called = (*one)[2].matched;
    if (member == kJobs || kClaims.contains(member) || kRead.contains(member)) continue;
    if (!called || !looks.contains(member)) faults += at(path, code, one->position()) + member + "\n";
  }
  for (std::sregex_iterator one(code.begin(), code.end(), write); one != std::sregex_iterator(); ++one)
    faults += at(path, code, one->position()) + "writes data\n";
  const std::regex known(names);
  for (std::sregex_iterator one(code.begin(), code.end(), other_name); one != std::sregex_iterator(); ++one)
    if (!std::regex_match((*one)[1].str(), known))
      faults += at(path, code, one->position()) + "another name of it, " + (*one)[1].str() + "\n";
  return faults;
}

TEST(Blocks, ReachAnAxisByJobsAndByClaimsAlone) {
  const std::set<std::string> looks = looks_of_an_axis();
  ASSERT_GT(looks.size(), 20u);
  int sources = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(LOCKSTEP_SOURCE_DIR) / "fb")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    EXPECT_EQ(faults_of("fb/" + entry.path().filename().string(), code_in(entry.path()), looks), "");
    ++sources;
  }
  EXPECT_GT(sources, 50);
}

// The rule itself, on sources that break it.

TEST(WaysToAnAxis, AreJobsClaimsAndLooking) {
  const std::set<std::string> looks = looks_declared(
      "bool enabled() const noexcept;\nconst Clamping& clamping() const noexcept { return clamping_; }\n"
      "ErrorId set_sensor(int sensor) noexcept;\nErrorId refusal(Mode mode) const;");
  EXPECT_EQ(looks, (std::set<std::string>{"enabled", "clamping", "refusal"}));
  const auto faults = [&](const std::string& code) { return faults_of("f", code, looks); };
  EXPECT_EQ(faults("Axis->submit(job); target()->submit(job); if (Axis->enabled()) Slave->power = {};"), "");
  EXPECT_EQ(faults("Axis->forces().range.lower = 1.0; x = slave->data.Modulo.Enable == true;"), "");
  EXPECT_EQ(faults("\nAxis->set_sensor(1);"), "f:2: set_sensor\n");
  EXPECT_EQ(faults("static_cast<lockstep::Axis*>(Axis)->set_sensor(1);"), "f:1: set_sensor\n");
  EXPECT_EQ(faults("(*Axis).set_sensor(1);"), "f:1: set_sensor\n");
  EXPECT_EQ(faults("Slave->awaited_axis_in_order = true;"), "f:1: awaited_axis_in_order\n");
  EXPECT_EQ(faults("Axis->data.Override.Velocity = 0.0;"), "f:1: writes data\n");
  EXPECT_EQ(faults("lockstep::Axis& moved = *Axis;"), "f:1: another name of it, moved\n");
}

}  // namespace
}  // namespace lockstep::blocks_and_axes_test
