// Variables that are declared as having no function yet: no source reads or writes one. What a run shows of
// that, tests/projects/later_variables_test.cpp looks at; this finds what no example comes to.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/architecture/source_text.hpp"

namespace lockstep::later_variables_test {
namespace {

namespace fs = std::filesystem;
using source_text_detail::is_word;

/// A variable as a source declares it.
struct Declaration {
  std::string owner;   ///< the object whose data block it is in
  std::string parent;  ///< structure that it is a member of, empty for none
  std::string name;
  bool later = false;
};

struct Code {
  std::string path;
  std::string owner;  ///< the object that the source makes, empty if it makes none alone
  std::string text;
};

/// What is used and nevertheless rightly without function, since only another object uses it.
struct Exception {
  std::string_view parent, name, reason;
};
constexpr Exception kExceptions[] = {
    {"Units", "VelocityUnit", "counts for speed axes, which declare it themselves"},
    {"TorqueLimiting", "PositionBasedMonitors", "a speed axis has no monitoring of its position"}};

std::string owner_of(const std::string& stem, const std::string& otherwise) {
  constexpr std::pair<std::string_view, std::string_view> kOwners[] = {
      {"axis", "axis"},
      {"external_encoder", "encoder"},
      {"encoder", "encoder"},
      {"measuring_input", "measuring_input"},
      {"output_cam", "output_cam"},
      {"cam_track", "output_cam"},
      {"leading_axis_proxy", "leading_axis_proxy"},
      {"switching", "output_cam"}};
  for (const auto& [beginning, owner] : kOwners)
    if (stem.starts_with(beginning)) return std::string(owner);
  return otherwise;
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The arguments of a call whose parenthesis opens at `open`, without blanks.
std::vector<std::string> arguments(const std::string& text, std::size_t open) {
  std::vector<std::string> list(1);
  int depth = 0;
  for (std::size_t at = open; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '(' && depth++ == 0) continue;
    if (c == ')' && --depth == 0) break;
    if (c == ',' && depth == 1)
      list.emplace_back();
    else if (c != ' ' && c != '\n')
      list.back() += c;
  }
  return list;
}

std::vector<Declaration> declarations_in(const std::string& text, const std::string& owner) {
  std::vector<Declaration> found;
  for (const char* macro : {"VARIABLE(", "COMPUTED(", "ELEMENTS(", "COMPUTED_ELEMENTS("}) {
    const std::string word = macro;
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
      if (at > 0 && is_word(text[at - 1])) continue;
      const auto list = arguments(text, at + word.size() - 1);
      std::string path = list[0];
      if (word.find("ELEMENTS") != word.npos && list.size() > 1) path += "." + list[1];
      const bool later = std::find(list.begin(), list.end(), ".later=true") != list.end();
      const std::size_t dot = path.rfind('.');
      const std::string before = dot == path.npos ? "" : path.substr(0, dot);
      found.push_back({owner, before.substr(before.rfind('.') + 1), path.substr(dot + 1), later});
    }
  }
  return found;
}

/// Whether the access to a member that begins at `at` is one to a member of `parent`, perhaps of an element.
bool is_member_of(const std::string& text, std::size_t at, const std::string& parent) {
  if (at > 0 && text[at - 1] == ']') at = text.rfind('[', at);
  return at != text.npos && at >= parent.size() &&
         text.compare(at - parent.size(), parent.size(), parent) == 0 &&
         (at == parent.size() || !is_word(text[at - parent.size() - 1]));
}

/// Uses of a member, as "path:line: name"; with a parent only as a member of that.
std::string uses(const Code& code, const std::string& name, const std::string& parent) {
  std::string found;
  const std::string& text = code.text;
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if (end < text.size() && is_word(text[end])) continue;
    std::size_t access = at;
    if (at >= 1 && text[at - 1] == '.') access = at - 1;
    if (at >= 2 && text.compare(at - 2, 2, "->") == 0) access = at - 2;
    if (access == at || (!parent.empty() && !is_member_of(text, access, parent))) continue;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    found += code.path + ":" + std::to_string(line) + ": " + parent + "." + name + "\n";
  }
  return found;
}

bool excepted(const Declaration& variable) {
  return std::any_of(std::begin(kExceptions), std::end(kExceptions), [&](const Exception& one) {
    return one.parent == variable.parent && one.name == variable.name;
  });
}

/// All uses of what is declared as having no function. A name that no other variable has tells it alone; a
/// source that is of no object may mean the variable of another one.
std::string uses_of_later(const std::vector<Declaration>& declared, const std::vector<Code>& sources) {
  std::string found;
  for (const Declaration& variable : declared) {
    if (!variable.later || excepted(variable)) continue;
    bool telling = true;
    bool elsewhere = false;
    for (const Declaration& other : declared) {
      if (other.later || other.name != variable.name) continue;
      telling = false;
      elsewhere = elsewhere || other.parent == variable.parent;
    }
    if (!telling && variable.parent.empty()) continue;
    for (const Code& code : sources)
      if (code.owner == variable.owner || (code.owner.empty() && !elsewhere))
        found += uses(code, variable.name, telling ? "" : variable.parent);
  }
  return found;
}

TEST(VariablesOfLater, AreUsedByNoSource) {
  std::vector<Declaration> declared;
  std::vector<Code> sources;
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  for (const char* folder : {"tech_objects", "fb", "scheduler", "hmi_bridge", "projects"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp") continue;
      const std::string stem = entry.path().stem().string();
      const std::string room = entry.path().parent_path().filename().string();
      const std::string text = code_of(content_of(entry.path()), false);
      if (room == "data_blocks") {
        const auto more = declarations_in(text, owner_of(stem, "axis"));
        declared.insert(declared.end(), more.begin(), more.end());
      } else {
        const std::string path = entry.path().lexically_relative(root).string();
        sources.push_back({path, room == "axis" ? room : owner_of(stem, ""), text});
      }
    }
  EXPECT_GT(std::count_if(declared.begin(), declared.end(), [](const auto& one) { return one.later; }), 30);
  EXPECT_EQ(uses_of_later(declared, sources), "");
}

TEST(VariablesOfLater, AreFoundWhereTheyAreUsed) {
  const auto declared = declarations_in(
      "VARIABLE(Units.LengthUnit, RON, \"  \", .later = true),\nCOMPUTED(StatusSensor.State, RON),\n"
      "ELEMENTS(Sensor, Interface.Number, RON, f(1, 2), .later = true), COMPUTED(ErrorDetail.Number, RON)",
      "axis");
  ASSERT_EQ(declared.size(), 4u);
  const auto found = [&](const std::string& text, const std::string& owner = "axis") {
    return uses_of_later(declared, {{"f", owner, text}});
  };
  EXPECT_EQ(found("\nx = data.Units.LengthUnit;"), "f:2: .LengthUnit\n");
  EXPECT_EQ(found("units->LengthUnit = 3;", ""), "f:1: .LengthUnit\n");
  EXPECT_EQ(found("data.Sensor[0].Interface.Number"), "f:1: Interface.Number\n");
  EXPECT_EQ(found("data.ErrorDetail.Number; LengthUnit; my.LengthUnits; StatusSensor[1].State"), "");
  EXPECT_EQ(found("data.Units.LengthUnit", "encoder"), "") << "that object has a variable of its own";
}

}  // namespace
}  // namespace lockstep::later_variables_test
