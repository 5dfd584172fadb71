// Pairs: a header and its source are one thing, and two things do not need each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tests/architecture/source_text.hpp"

namespace lockstep::pairs_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolders[] = {"tech_objects", "fb", "scheduler", "hmi_bridge", "projects", "cli"};

// Of each pair, by its path without an extension, those that it includes.
using Pairs = std::map<std::string, std::set<std::string>>;

std::string pair_of(const std::string& path) {
  return fs::path(path).replace_extension().string();
}

void take(Pairs& pairs, const std::string& path, const std::string& text) {
  std::set<std::string>& included = pairs[pair_of(path)];
  for (const Include& include : includes_of(text))
    if (include.quoted && pair_of(include.path) != pair_of(path)) included.insert(pair_of(include.path));
}

std::set<std::string> reached_from(const Pairs& pairs, const std::string& begin) {
  std::set<std::string> reached;
  std::set<std::string> open = {begin};
  while (!open.empty()) {
    const auto found = pairs.find(open.extract(open.begin()).value());
    if (found == pairs.end()) continue;
    for (const std::string& next : found->second)
      if (reached.insert(next).second) open.insert(next);
  }
  return reached;
}

// The pairs that reach themselves through others.
std::set<std::string> in_circles(const Pairs& pairs) {
  std::set<std::string> circles;
  for (const auto& [pair, included] : pairs)
    if (reached_from(pairs, pair).contains(pair)) circles.insert(pair);
  return circles;
}

TEST(Pairs, DoNotNeedEachOther) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  Pairs pairs;
  for (const char* const folder : kFolders)
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") {
        std::ifstream file(entry.path(), std::ios::binary);
        take(pairs, entry.path().lexically_relative(root).string(),
             {std::istreambuf_iterator<char>(file), {}});
      }
  EXPECT_GE(pairs.size(), 500u);
  for (const std::string& pair : in_circles(pairs))
    ADD_FAILURE() << pair << " includes itself through others";
}

// The rule itself.

TEST(PairRules, FindWhatIncludesItselfThroughOthers) {
  Pairs pairs;
  take(pairs, "a/x.hpp", "#include \"a/x_state.hpp\"\n");
  take(pairs, "a/x.cpp", "#include \"a/x.hpp\"\n#include \"a/y.hpp\"\n");
  take(pairs, "a/z.cpp", "#include \"a/x.hpp\"\n");
  EXPECT_EQ(in_circles(pairs), std::set<std::string>{});
  take(pairs, "a/y.cpp", "#include \"a/x.hpp\"\n");
  EXPECT_EQ(in_circles(pairs), (std::set<std::string>{"a/x", "a/y"}));
}

}  // namespace
}  // namespace lockstep::pairs_test
