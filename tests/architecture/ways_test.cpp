// Ways: what a README tells of how a value comes through the sources is there.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "tests/architecture/source_text.hpp"

namespace lockstep::ways_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWithWays[] = {"tech_objects/README.md", "hmi_bridge/README.md"};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The numbered lines of the section "Ways".
std::vector<std::string> steps_of(const std::string& readme) {
  const std::size_t begin = readme.find("\n## Ways\n");
  if (begin == std::string::npos) return {};
  const std::string section = readme.substr(begin, readme.find("\n## ", begin + 1) - begin);
  std::vector<std::string> steps;
  const std::regex numbered("(^|\n)[0-9]+\\. ([^\n]*)");
  for (std::sregex_iterator step(section.begin(), section.end(), numbered); step != std::sregex_iterator();
       ++step)
    steps.push_back((*step)[2].str());
  return steps;
}

// What a step names that is not there, one a line: files, and functions of the file named before.
std::string faults_of(const std::string& step, const fs::path& root) {
  std::string faults;
  std::string file;
  std::string code;
  int functions = 0;
  const std::regex quoted("`([^`]+)`");
  for (std::sregex_iterator name(step.begin(), step.end(), quoted); name != std::sregex_iterator(); ++name) {
    const std::string word = (*name)[1].str();
    if (word.find('/') != std::string::npos) {
      file = word;
      const bool there = fs::is_regular_file(root / file);
      if (!there) faults += "there is no " + file + "\n";
      code = there ? code_of(text_of(root / file), false) : "";
      continue;
    }
    ++functions;
    if (!std::regex_search(code, std::regex("\\b" + word + "\\(")))
      faults += "no " + word + " in " + file + "\n";
  }
  return functions > 0 ? faults : faults + "names no function: " + step + "\n";
}

TEST(Ways, NameFilesAndFunctionsThatAreThere) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  for (const char* readme : kWithWays) {
    const std::vector<std::string> steps = steps_of(text_of(root / readme));
    EXPECT_GE(steps.size(), 20u) << readme;
    for (const std::string& step : steps) EXPECT_EQ(faults_of(step, root), "") << readme << ": " << step;
  }
}

// What CONTRIBUTING.md says has to be touched for something new is there.
TEST(AddingThings, NamesFilesThatAreThere) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  const std::string text = text_of(root / "CONTRIBUTING.md");
  const std::size_t begin = text.find("\n## Adding things\n");
  ASSERT_NE(begin, std::string::npos);
  const std::string chapter = text.substr(begin, text.find("\n## ", begin + 1) - begin);
  const std::regex quoted("`([a-z_]+/[A-Za-z_./]+)`");
  int named = 0;
  for (std::sregex_iterator path(chapter.begin(), chapter.end(), quoted); path != std::sregex_iterator();
       ++path) {
    const std::string name = (*path)[1].str();
    if (name.find("NAME") != std::string::npos) continue;  // the new file
    EXPECT_TRUE(fs::exists(root / name)) << name;
    ++named;
  }
  EXPECT_GE(named, 10);
}

// The rule itself.

TEST(WayRules, FindWhatIsNotThere) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  const std::string here = "`tests/architecture/ways_test.cpp` ";
  EXPECT_EQ(faults_of(here + "`steps_of` reads", root), "");
  EXPECT_EQ(faults_of(here + "`nowhere` reads", root), "no nowhere in tests/architecture/ways_test.cpp\n");
  EXPECT_NE(faults_of("`tests/architecture/no_such.cpp` `steps_of`", root), "");
  EXPECT_NE(faults_of(here, root), "");
  EXPECT_EQ(steps_of("# A\n\n## Ways\n\n1. one\n2. two\n\n## B\n\n3. three\n").size(), 2u);
}

}  // namespace
}  // namespace lockstep::ways_test
