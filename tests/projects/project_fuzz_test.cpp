// Damaged projects: whatever the text, loading ends with a project or with problems.
#include <gtest/gtest.h>

#include <random>

#include "example_project.hpp"
#include "projects/loader/project.hpp"
#include "tests/support/property.hpp"

namespace lockstep::project_fuzz_test {
namespace {

/// Damages a text in one of several ways.
std::string mutated(std::string text, std::mt19937_64& random) {
  const auto below = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  static const std::string_view kPieces[] = {
      "\"",       "{",    "}",     "[",       "]",       ",",    ":",        "-",    "1e999",
      "0.5",      "null", "true",  "\\u0000", "\\ud800", "\"\"", "{}",       "[]",   "9999999999999999999999",
      "\"T#1s\"", ".X0",  "Knife", "AND",     "(",       "\xff", "\xe2\x82", "1e308"};
  const std::size_t times = 1 + below(4);
  for (std::size_t i = 0; i < times && !text.empty(); ++i) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(text.size() - at, 1 + below(40));
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 3:
        text.insert(at, kPieces[below(std::size(kPieces))]);
        break;
      case 4:
        text.resize(at);
        break;
      default: {  // exchanges a word by another one of the text
        const auto quote = text.find('"', at);
        const auto other = text.find('"', below(text.size()));
        if (quote == text.npos || other == text.npos) break;
        const auto word = text.substr(other, std::min<std::size_t>(text.find('"', other + 1) - other, 60));
        text.replace(quote, std::min<std::size_t>(text.find('"', quote + 1) - quote, 60), word);
        break;
      }
    }
  }
  return text;
}

TEST(DamagedProject, LoadsOrIsRefusedWithAReason) {
  const int cases = test::cases(2'000, 200'000);
  std::mt19937_64 random(test::seed_of_test(20240521));
  int loaded_cases = 0;
  for (int i = 0; i < cases; ++i) {
    const std::string text = mutated(kExampleProject, random);
    LoadedProject loaded = load_project(text);
    ASSERT_NE(loaded.project.has_value(), !loaded.problems.empty()) << text;
    for (const Problem& problem : loaded.problems) {
      ASSERT_FALSE(problem.text.empty());
      ASSERT_LT(problem.text.size(), 1000u) << problem.text;
      ASSERT_EQ((problem.place + problem.text).find_first_of("\n\r\x1b"), std::string::npos) << problem.text;
    }
    if (!loaded.project) continue;
    ++loaded_cases;
    for (int tick = 0; tick < 20; ++tick) loaded.project->controller->tick();
  }
  EXPECT_GT(loaded_cases, 0);
}

}  // namespace
}  // namespace lockstep::project_fuzz_test
