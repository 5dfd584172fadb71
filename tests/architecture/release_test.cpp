// What belongs to a version, and what an image is built with, says the same everywhere.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace lockstep {
namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(std::filesystem::path(LOCKSTEP_SOURCE_DIR) / path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string first_match(const std::string& text, const std::string& pattern) {
  std::smatch found;
  return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : "";
}

TEST(Release, OfTheBuildIsTheNewestOneOfTheChangelog) {
  const std::string version =
      first_match(content_of("CMakeLists.txt"), R"(project\(lockstep VERSION ([0-9.]+))");
  ASSERT_NE(version, "");
  EXPECT_EQ(version, first_match(content_of("CHANGELOG.md"),
                                 R"(\n## \[([0-9]+\.[0-9]+\.[0-9]+)\] - 20\d\d-\d\d-\d\d\n)"));
  EXPECT_EQ(version, first_match(content_of("README.md"), R"(lockstep_([0-9.]+)_amd64\.deb)"));
}

/// The steps of an image are those of ./dev, and what it runs is no administrator.
TEST(Image, IsBuiltByTheStepsOfDevAndRunsWithoutPrivileges) {
  const std::string image = content_of("Dockerfile");
  const std::string dev = content_of("dev");
  const std::regex step(R"(\./dev ([a-z]+))");
  std::size_t steps = 0;
  for (std::sregex_iterator one(image.begin(), image.end(), step), end; one != end; ++one, ++steps)
    EXPECT_NE(dev.find("\ndev_" + (*one)[1].str() + "() {"), std::string::npos) << one->str();
  EXPECT_GE(steps, 2u);
  const std::size_t user = image.find("\nUSER lockstep\n");
  ASSERT_NE(user, std::string::npos);
  EXPECT_LT(user, image.find("\nENTRYPOINT [\"lockstep\"]\n"));
  EXPECT_EQ(image.find("\nUSER root"), std::string::npos);
  const std::string project = first_match(image, R"x("/usr/share/lockstep/(projects/[^"]+)")x");
  const std::string port = first_match(image, R"(\nEXPOSE ([0-9]+)\n)");
  EXPECT_NE(content_of(project).find("\"modbus\""), std::string::npos) << project;
  EXPECT_NE(image.find(":" + port + "\"]"), std::string::npos)
      << "the port of its Modbus server is the one exposed";
}

TEST(Image, DoesNotTakeWhatIsBuiltOutside) {
  EXPECT_NE(content_of(".dockerignore").find("\nbuild\n"), std::string::npos);
}

}  // namespace
}  // namespace lockstep
