// Words that CONTRIBUTING.md has a term of the field for: no identifier is made of them, and no comment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/source_text.hpp"

namespace lockstep::names_test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolders[] = {"tech_objects", "fb", "scheduler", "hmi_bridge", "projects", "cli"};

// distance, maximum, minimum are said instead.
const std::set<std::string> kNotTheTerm = {"way", "ways", "greatest", "most", "least", "fewest"};
// Of the language, or with another meaning.
const std::set<std::string> kAllowed = {"at_most", "at_least", "is_in_the_way", "on_the_way"};

// The words of an identifier, in lower case: of `kMostWays` and `most_ways` both "most", "ways".
std::vector<std::string> words_of(std::string_view identifier) {
  std::vector<std::string> words(1);
  for (const char c : identifier) {
    if (c == '_' || std::isupper(static_cast<unsigned char>(c)) != 0) words.emplace_back();
    if (c != '_') words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return words;
}

bool is_of_the_field(const std::string& identifier) {
  if (kAllowed.contains(identifier)) return true;
  const std::vector<std::string> words = words_of(identifier);
  return std::none_of(words.begin(), words.end(),
                      [](const auto& word) { return kNotTheTerm.contains(word); });
}

std::set<std::string> identifiers_of(const std::string& code) {
  std::set<std::string> identifiers;
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (auto from = code.begin(); from != code.end();) {
    from = std::find_if(from, code.end(), is_word);
    const auto to = std::find_if_not(from, code.end(), is_word);
    if (from != to && std::isdigit(static_cast<unsigned char>(*from)) == 0) identifiers.emplace(from, to);
    from = to;
  }
  return identifiers;
}

// Of these comments may speak otherwise: what is on its way, and rooms of the house.
constexpr std::string_view kIdioms[] = {
    "under way",  "on its way",  "in its way",    "on their way", "on the way",    "in the way",
    "the way in", "the way out", "the way back",  "way round",    "the other way", "either way",
    "both ways",  "which way",   "whichever way", "gives way",    "give way",      "given way",
    "half-way",   "at least",    "two at least",  "one at least", "or its least",  "other rooms"};
const std::set<std::string> kNotInComments = {"way", "ways", "room", "rooms", "least", "greatest", "fewest"};

// The comments of a source as running text.
std::string comments_of(const std::string& text) {
  const std::string code = code_of(text, true);
  std::string comments;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_blank = code[i] == text[i] || text[i] == '/' || text[i] == ' ';
    if (!is_blank) comments += text[i];
    if (is_blank && !comments.empty() && comments.back() != ' ') comments += ' ';
  }
  return comments;
}

std::string in_lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Where comments say such a word otherwise, one a line.
std::string faults_of_comments(const std::string& text) {
  std::string comments = in_lower_case(comments_of(text));
  for (const std::string_view idiom : kIdioms)
    for (std::size_t at = comments.find(idiom); at != std::string::npos; at = comments.find(idiom, at))
      comments.replace(at, idiom.size(), "…");
  std::string faults;
  std::istringstream words(comments);
  std::string before;
  for (std::string word; words >> word; before = word) {
    std::string bare = word;
    bare.erase(bare.find_last_not_of(".,;:?!)\"'") + 1);
    if (kNotInComments.contains(bare)) faults += "… " + before + " " + word + "\n";
  }
  return faults;
}

std::string text_of(const fs::path& source) {
  std::ifstream file(source, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string faults_of(const fs::path& source) {
  const std::string text = text_of(source);
  std::string faults;
  for (const std::string& identifier : identifiers_of(code_of(text, false)))
    if (!is_of_the_field(identifier)) faults += source.string() + ": " + identifier + "\n";
  const std::string said = faults_of_comments(text);
  return said.empty() ? faults : faults + source.string() + ":\n" + said;
}

TEST(Names, AreMadeOfTheTermsOfTheField) {
  std::string faults;
  for (const std::string_view folder : kFolders)
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(fs::path(LOCKSTEP_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp")
        faults += faults_of(entry.path());
  EXPECT_EQ(faults, "") << "CONTRIBUTING.md, Words, says which terms these have";
}

// Comments that only who has read the one above can understand.
constexpr std::string_view kLeaning[] = {"… ",    "the same\n", "the same;", "likewise",
                                         "ditto", "see above",  "as above"};
// Their own sources tell it so for now.
constexpr std::string_view kLeanOn[] = {"/mco305/", "/linmot/", "/studio/"};

// The comments of a source that begin so, one a line.
std::string leaning_comments(const std::string& text) {
  std::string faults;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t slashes = line.rfind("//");
    if (slashes == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of("/<! ", slashes);
    if (begin == std::string::npos) continue;
    const std::string said = line.substr(begin) + "\n";
    const std::string comment = in_lower_case(said);
    if (said.starts_with("The same") ||
        std::ranges::any_of(kLeaning, [&](std::string_view one) { return comment.starts_with(one); }))
      faults += comment;
  }
  return faults;
}

TEST(Comments, CanBeReadByThemselves) {
  for (const std::string_view folder : kFolders)
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(fs::path(LOCKSTEP_SOURCE_DIR) / folder)) {
      const std::string path = entry.path().string();
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      if (std::ranges::any_of(kLeanOn, [&](std::string_view room) { return path.find(room) != path.npos; }))
        continue;
      EXPECT_EQ(leaning_comments(text_of(entry.path())), "") << path;
    }
}

TEST(Comments, AreFoundThatLeanOnTheOneAbove) {
  EXPECT_EQ(leaning_comments("int a;  ///< first\nint b;  ///< … second\n// the same\n/// the same of all\n"),
            "… second\nthe same\n");
  EXPECT_EQ(leaning_comments("/// The same for a file, of which\n/// the same is true.\nvoid f();\n"),
            "the same for a file, of which\n");
}

TEST(Names, AreTakenApartIntoWords) {
  EXPECT_FALSE(is_of_the_field("kMostClients"));
  EXPECT_FALSE(is_of_the_field("way_to_rest_"));
  EXPECT_TRUE(is_of_the_field("at_most"));
  EXPECT_TRUE(is_of_the_field("always"));
  EXPECT_EQ(identifiers_of("int way2 = 0x1f; f(a_b);"), (std::set<std::string>{"int", "way2", "f", "a_b"}));
}

TEST(Names, AreLookedForInCommentsToo) {
  EXPECT_EQ(faults_of_comments("int way; // The shortest way\n// there.\n"), "… shortest way\n");
  EXPECT_EQ(faults_of_comments("/* of the least\n degree */ f(\"room\");"), "… the least\n");
  EXPECT_EQ(faults_of_comments("/// It is on its way, at least\n/// half-way.\n"), "");
  EXPECT_EQ(faults_of_comments("// the other\n// way round\n"), "");
}

}  // namespace
}  // namespace lockstep::names_test
