// What every example project has, besides the project.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace lockstep::examples_test {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Examples, HaveAReadmeThatShowsAPictureOfTheirs) {
  const std::regex picture(R"(!\[[^\]]+\]\(([^)/]+)\))");
  int examples = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(LOCKSTEP_SOURCE_DIR) / "projects")) {
    if (!fs::exists(entry.path() / "project.json") && !fs::exists(entry.path() / "system.json")) continue;
    ++examples;
    const std::string readme = content_of(entry.path() / "README.md");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(readme, found, picture)) << entry.path();
    EXPECT_TRUE(fs::exists(entry.path() / found[1].str())) << entry.path() << found[1];
  }
  EXPECT_GE(examples, 11);
}

}  // namespace
}  // namespace lockstep::examples_test
