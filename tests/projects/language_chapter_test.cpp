// Each project of LANGUAGE.md does what stands behind it.
#include <gtest/gtest.h>

#include <charconv>
#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "projects/keys/project.hpp"
#include "projects/loader/simulation.hpp"
#include "tests/support/marked_blocks.hpp"

namespace lockstep {
namespace {

std::string chapter() {
  std::ifstream file(LOCKSTEP_SOURCE_DIR "/projects/LANGUAGE.md", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// "15ms", "2s".
std::chrono::nanoseconds duration_of(const std::string& text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  EXPECT_EQ(error, std::errc{}) << text;
  return std::string(end) == "s" ? std::chrono::nanoseconds(std::chrono::seconds(number))
                                 : std::chrono::nanoseconds(std::chrono::milliseconds(number));
}

void expect_values(const Simulation& machine, const std::string& told) {
  std::istringstream lines(told);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t sign = line.find(" = ");
    ASSERT_NE(sign, line.npos) << line;
    EXPECT_NEAR(machine.read(line.substr(0, sign)), std::stod(line.substr(sign + 3)), 1e-9) << line;
  }
}

std::string problems_of(const std::string& project) {
  try {
    Simulation::from_text(project);
  } catch (const InvalidProject& invalid) {
    return invalid.what();
  }
  return "";
}

TEST(LanguageChapter, ItsProjectsDoWhatItSays) {
  std::optional<Simulation> machine;
  std::string refused;
  int values = 0;
  for (const test::Block& block : test::marked_blocks(chapter())) {
    if (block.mark == "project") {
      machine.emplace(Simulation::from_text(block.text));
    } else if (block.mark == "refused") {
      refused = problems_of(block.text);
      EXPECT_NE(refused, "") << block.text;
    } else if (block.mark == "problems") {
      std::istringstream lines(block.text);
      for (std::string line; std::getline(lines, line); ++values)
        EXPECT_NE(refused.find(line), std::string::npos) << line << "\n" << refused;
    } else {
      ASSERT_EQ(block.mark.rfind("after ", 0), 0u) << block.mark;
      ASSERT_TRUE(machine);
      machine->run_for(duration_of(block.mark.substr(6)));
      expect_values(*machine, block.text);
      ++values;
    }
  }
  EXPECT_GE(values, 8);
}

TEST(LanguageChapter, NamesEachOrganizationBlockAndKindOfCall) {
  const std::string text = chapter();
  for (const Word& ob : keys::kObs)
    EXPECT_NE(text.find("`" + std::string(ob.word) + "` ["), std::string::npos) << ob.word;
  for (const Keys kind : {Keys(keys::kCall), Keys(keys::kSet), Keys(keys::kSetStart), Keys(keys::kIf)})
    for (const Key& key : kind)
      EXPECT_NE(text.find("\"" + std::string(key.name) + "\":"), std::string::npos) << key.name;
}

}  // namespace
}  // namespace lockstep
