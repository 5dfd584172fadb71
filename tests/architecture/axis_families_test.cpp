// The axis: an order of calls over families, each of which is given what it may touch, and none of which
// reaches for the axis or for a family below it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_text.hpp"

namespace lockstep::axis_families_test {
namespace {

namespace fs = std::filesystem;

constexpr std::ptrdiff_t kLongestHeader = 150;

// What knows the axis as a whole: its own sources, and what looks at axes from outside.
const std::set<std::string> kOfTheAxis = {"axis.hpp",           "axis.cpp",          "axis_families.hpp",
                                          "axis_families.cpp",  "jobs.cpp",          "cycle.cpp",
                                          "publish.cpp",        "plain_cycle.cpp",   "coupling_order.hpp",
                                          "coupling_order.cpp", "coupling_chain.cpp"};
constexpr const char* kTheAxis[] = {"tech_objects/axis/axis.hpp", "tech_objects/axis/axis_families.hpp",
                                    "tech_objects/axis/axis_parts.hpp"};

fs::path room() {
  return fs::path(LOCKSTEP_SOURCE_DIR) / "tech_objects" / "axis";
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string matched(const std::string& text, const std::string& pattern) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : "";
}

// The families of an axis as they are declared: "  Reactions reactions_;".
std::vector<std::string> families_declared(const std::string& header) {
  std::vector<std::string> families;
  const std::regex member("\n  [A-Z]\\w+ (\\w+_);");
  for (std::sregex_iterator found(header.begin(), header.end(), member); found != std::sregex_iterator();
       ++found)
    families.push_back((*found)[1].str());
  return families;
}

// Families that are given one that is not above them, one a line.
std::string faults_of(const std::vector<std::string>& families, const std::string& source) {
  std::string faults;
  for (std::size_t i = 0; i < families.size(); ++i) {
    const std::string given = matched(source, "[ ,]" + families[i] + "\\(([^()]*)\\)");
    if (given.empty()) faults += families[i] + " is given nothing\n";
    for (std::size_t other = i; other < families.size(); ++other)
      if (std::regex_search(given, std::regex("= " + families[other] + "\\b")))
        faults += families[i] + " is given " + families[other] + "\n";
  }
  return faults;
}

TEST(AxisHeaders, FitOnFewScreens) {
  int headers = 0;
  for (const fs::path& place : {room(), room().parent_path() / "synchronous"})
    for (const fs::directory_entry& entry : fs::directory_iterator(place)) {
      if (entry.path().extension() != ".hpp") continue;
      const std::string text = text_of(entry.path());
      EXPECT_LE(std::count(text.begin(), text.end(), '\n'), kLongestHeader) << entry.path();
      ++headers;
    }
  EXPECT_GE(headers, 60);
}

TEST(AxisFamilies, DoNotReachForTheAxis) {
  for (const fs::directory_entry& entry : fs::directory_iterator(room())) {
    const std::string name = entry.path().filename().string();
    if (kOfTheAxis.count(name) != 0) continue;
    for (const Include& include : includes_of(text_of(entry.path())))
      for (const std::string whole : kTheAxis)
        EXPECT_NE(include.path, whole) << entry.path() << ':' << include.line;
  }
}

TEST(AxisFamilies, AreGivenFamiliesAboveThemAlone) {
  const std::vector<std::string> families = families_declared(text_of(room() / "axis_families.hpp"));
  EXPECT_GE(families.size(), 20u);
  EXPECT_EQ(faults_of(families, text_of(room() / "axis_families.cpp")), "");
}

// The rules themselves, on families that break them.

TEST(AxisFamilyRules, FindOneThatIsGivenAnotherBelowIt) {
  const std::vector<std::string> families =
      families_declared("class A {\n  Upper upper_;\n  // Not one.\n  Lower lower_;\n};\n");
  EXPECT_EQ(families, (std::vector<std::string>{"upper_", "lower_"}));
  EXPECT_EQ(faults_of(families, " upper_({.data = data}),\n lower_({.upper_ = upper_})"), "");
  EXPECT_EQ(faults_of(families, " upper_({.lower_ = lower_}),\n lower_({.data = data})"),
            "upper_ is given lower_\n");
  EXPECT_EQ(faults_of(families, " upper_({.data = data})"), "lower_ is given nothing\n");
}

}  // namespace
}  // namespace lockstep::axis_families_test
