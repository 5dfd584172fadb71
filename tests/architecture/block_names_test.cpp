// Who loads projects knows no block by its name: what is special about a block is declared with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/source_text.hpp"

namespace lockstep::block_names_test {
namespace {

namespace fs = std::filesystem;
using source_text_detail::is_word;

/// A source that may name a block, and why.
struct Exception {
  std::string_view path, block, reason;
};
constexpr std::string_view kPanel = "the program of a panel is made of blocks";
constexpr std::string_view kMessage = "a text that tells a user which block does it";
constexpr Exception kExceptions[] = {
    {"projects/loader/commands.cpp", "MC_Home", kPanel},
    {"projects/loader/commands.cpp", "MC_MoveJog", kPanel},
    {"projects/loader/commands.cpp", "MC_Power", kPanel},
    {"projects/loader/commands.cpp", "MC_Reset", kPanel},
    {"projects/loader/commands.cpp", "TOF", kPanel},
    {"projects/expressions/names.cpp", "MC_Reset", kMessage},
    {"projects/keys/drive.hpp", "MC_Power", kMessage},
    {"projects/keys/project.hpp", "MC_Reset", kMessage},
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The blocks of a list of types: block_type<NAME>().
std::vector<std::string> blocks_in(const std::string& list) {
  std::vector<std::string> blocks;
  const std::regex entry("block_type<(\\w+)>");
  for (std::sregex_iterator found(list.begin(), list.end(), entry); found != std::sregex_iterator(); ++found)
    blocks.push_back((*found)[1].str());
  return blocks;
}

/// Those of the names that stand in a source as a word, in code or in a literal.
std::vector<std::string> named_in(const std::string& source, const std::vector<std::string>& names) {
  const std::string code = code_of(source, true);
  std::vector<std::string> found;
  for (const std::string& name : names)
    for (std::size_t at = code.find(name); at != std::string::npos; at = code.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if ((at > 0 && is_word(code[at - 1])) || (end < code.size() && is_word(code[end]))) continue;
      found.push_back(name);
      break;
    }
  return found;
}

TEST(BlockNames, AreNotWhatProjectsAreLoadedBy) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  const std::vector<std::string> blocks = blocks_in(text_of(root / "fb/block_list.cpp"));
  EXPECT_GT(blocks.size(), 50u);
  std::vector<std::string> met;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "projects")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    const std::string path = entry.path().lexically_relative(root).string();
    for (const std::string& block : named_in(text_of(entry.path()), blocks))
      met.push_back(path + ": " + block);
  }
  for (const Exception& exception : kExceptions) {
    const std::string name = std::string(exception.path) + ": " + std::string(exception.block);
    EXPECT_EQ(std::erase(met, name), 1u) << name << " is an exception that nothing needs";
  }
  for (const std::string& fault : met) ADD_FAILURE() << fault;
}

TEST(BlockNames, AreFoundAsWordsOfCodeAndOfLiterals) {
  const std::vector<std::string> names = blocks_in("  block_type<MC_CamIn>(), block_type<SR>(),\n");
  ASSERT_EQ(names, (std::vector<std::string>{"MC_CamIn", "SR"}));
  const auto found = [&](const std::string& source) { return named_in(source, names).size(); };
  EXPECT_EQ(found("if (type.name == MC_CamIn::kName) return;"), 1u);
  EXPECT_EQ(found("if (type.name == \"SR\") return;"), 1u);
  EXPECT_EQ(found("MC_CamInPos SRE xSR; // MC_CamIn, SR\n/* SR */"), 0u);
}

}  // namespace
}  // namespace lockstep::block_names_test
