// Every file of tests/data says where it comes from, and a copy is what its origin is.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

namespace lockstep::data_origins_test {
namespace {

namespace fs = std::filesystem;

const fs::path kData = LOCKSTEP_TEST_DATA;
/// The documents that the copies were taken from, where they lie beside the sources.
const fs::path kDocuments = fs::path(LOCKSTEP_SOURCE_DIR).parent_path() / "shared";

nlohmann::json origins() {
  return nlohmann::json::parse(std::ifstream(kData / "origins.json"));
}

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(DataOrigins, AreToldOfEveryFileAndOfNoOther) {
  std::set<std::string> there;
  for (const auto& entry : fs::recursive_directory_iterator(kData))
    if (entry.is_regular_file() && entry.path().filename() != "origins.json")
      there.insert(entry.path().lexically_relative(kData));
  std::set<std::string> told;
  const nlohmann::json all = origins();
  for (const auto& [name, origin] : all.items()) {
    told.insert(name);
    EXPECT_EQ(origin.size(), 1u) << name;
    EXPECT_NE(origin.contains("copy_of"), origin.contains("made")) << name;
  }
  EXPECT_EQ(told, there);
}

TEST(DataOrigins, AreWhatTheirCopiesAre) {
  int compared = 0;
  const nlohmann::json all = origins();
  for (const auto& [name, origin] : all.items()) {
    if (!origin.contains("copy_of")) continue;
    const fs::path original = kDocuments / origin.at("copy_of").get<std::string>();
    if (!fs::exists(original)) continue;
    EXPECT_TRUE(content(kData / name) == content(original)) << name << " is no longer a copy of " << original;
    ++compared;
  }
  std::printf("%d copies compared with %s\n", compared, kDocuments.c_str());
}

}  // namespace
}  // namespace lockstep::data_origins_test
