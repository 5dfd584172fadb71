// lockstep describe: what has to do with a word.
#include "cli/describe/search.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "cli/describe/table.hpp"
#include "cli/describe/values.hpp"
#include "projects/expressions/functions.hpp"
#include "projects/expressions/operators.hpp"
#include "projects/expressions/type_table.hpp"
#include "projects/json/problem.hpp"
#include "projects/keys/texts.hpp"
#include "projects/literals/types.hpp"

namespace lockstep::cli {
namespace {

constexpr std::size_t kShortest = 3;  // letters of a word that is searched for
constexpr std::size_t kShown = 24;    // findings, so that they fit on a screen

/// Something that may be found.
struct Finding {
  std::string_view kind;
  std::string name;  ///< by which `describe` tells more
  std::string text;
  std::size_t own = 0;  ///< where the part of the name begins that is its own; before it stands its owner
  int rank = 0;         ///< the higher, the nearer
};

bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
}

/// Whether a capital begins a word within a name, as in MC_GearIn; the text is not folded.
bool begins_word(std::string_view text, std::size_t at) noexcept {
  if (at == 0) return true;
  const char c = text[at], before = text[at - 1];
  const bool capital = c >= 'A' && c <= 'Z', after_capital = before >= 'A' && before <= 'Z';
  return !is_letter(fold(std::string(1, before))[0]) || (capital && !after_capital);
}

/// How well a word fits a text: 3 it is a word of it or all of it, 2 it begins one, 1 it stands within, 0
/// not.
int fit(std::string_view word, std::string_view text) {
  const std::string folded = fold(text);
  int best = 0;
  for (auto at = folded.find(word); at != folded.npos; at = folded.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool ends = end == folded.size() || !is_letter(folded[end]) || begins_word(text, end);
    best = std::max(best, !begins_word(text, at) ? 1 : ends ? 3 : 2);
  }
  return best;
}

/// A name counts for more than what is said of it or whose it is; 0 if a word is nowhere.
int rank_of(const std::vector<std::string>& words, const Finding& finding) {
  int rank = 0;
  for (const std::string& word : words) {
    const std::string_view name = finding.name;
    const int in_name = fit(word, name.substr(finding.own));
    const int in_text = fit(word, finding.text);
    const int in_owner = fit(word, name.substr(0, finding.own)) < 2 ? 0 : 1;
    // Within another word of a sentence a word means something else, as "cam" in "became".
    const int fits = std::max({4 * in_name, in_text < 2 ? 0 : in_text, in_owner});
    if (fits == 0) return 0;
    rank += fits;
  }
  return rank;
}

void add_blocks(std::vector<Finding>& all) {
  std::unordered_set<std::string> seen;
  for (const BlockType& type : block_types()) {
    all.push_back({"block", std::string(type.name), std::string(type.text)});
    for (const Pin& pin : type.pins)
      // Pins that many blocks share are told once, of the first.
      if (seen.insert(std::string(pin.name) + "\n" + std::string(pin.text)).second)
        all.push_back({"pin", std::string(type.name) + "." + std::string(pin.name), std::string(pin.text),
                       type.name.size() + 1});
  }
}

void add_variables(std::vector<Finding>& all) {
  std::unordered_set<std::string_view> seen;
  for (const ObjectKindText& object : kObjectKinds) {
    all.push_back({"object", std::string(object.name), std::string(object.text)});
    for (const auto list : data_block_of(object.kind).lists())
      for (const Variable& variable : list)
        if (seen.insert(variable.path).second)
          all.push_back({"variable", std::string(variable.path), std::string(variable.text)});
  }
}

void add_alarms(std::vector<Finding>& all) {
  for (const Alarm& alarm : alarms())
    all.push_back({"alarm", std::to_string(alarm.number),
                   std::string(alarm.text) + (alarm.cause.empty() ? "" : ": " + std::string(alarm.cause))});
  for (const ErrorText& error : error_texts())
    all.push_back({"error", error_literal(static_cast<unsigned>(error.id)), std::string(error.text)});
}

void add_keys(std::vector<Finding>& all) {
  const Key& comment = comment_key();
  all.push_back({"key", "keys " + std::string(comment.name), std::string(comment.text), 5});
  std::unordered_set<std::string> seen;
  for (const KeySection& section : all_key_sections())
    for (const Key& key : section.keys) {
      std::string path = (section.path.empty() ? "" : section.path + ".") + std::string(key.name);
      if (seen.insert(path).second) {
        const std::size_t own = 5 + path.size() - key.name.size();
        all.push_back({"key", "keys " + path, std::string(meaning_text(key)), own});
      }
    }
}

/// What expressions are made of.
void add_language(std::vector<Finding>& all) {
  for (const StandardFunction& function : standard_functions())
    all.push_back({"function", std::string(function.name), std::string(function.meaning)});
  for (const ExpressionOperator& one : expression_operators())
    all.push_back({"operator", std::string(one.text), std::string(one.meaning)});
  for (const TypeText& type : elementary_types()) {
    const std::string name(type_name(type.type));
    all.push_back({"type", name, std::string(type.meaning)});
    all.push_back({"function", "TO_" + name, "converts its input, a conversion to " + name});
  }
  for (const OtherType& type : other_types())
    all.push_back({"type", std::string(type.name), std::string(type.meaning)});
}

void add_mco305(std::vector<Finding>& all) {
  for (Mco305Finding& one : mco305_findings())
    all.push_back({one.kind, std::move(one.name), std::move(one.text)});
}

/// Best first; of the same rank as they stand in their tables.
std::vector<Finding> find_all(const std::vector<std::string>& words) {
  std::vector<Finding> all;
  add_blocks(all);
  add_variables(all);
  add_alarms(all);
  add_keys(all);
  add_language(all);
  add_mco305(all);
  for (Finding& finding : all) finding.rank = rank_of(words, finding);
  std::erase_if(all, [](const Finding& finding) { return finding.rank == 0; });
  std::stable_sort(all.begin(), all.end(),
                   [](const Finding& a, const Finding& b) { return a.rank > b.rank; });
  return all;
}

std::string findings_text(const std::vector<Finding>& found, const std::string& title, std::size_t width) {
  std::string text = title + "\n";
  Table table({"Found", "", "lockstep describe …"});
  for (std::size_t i = 0; i < std::min(found.size(), kShown); ++i)
    table.row({std::string(found[i].kind), found[i].name, found[i].text});
  text += table.text(2, width);
  if (found.size() > kShown)
    text += paragraph("… and " + std::to_string(found.size() - kShown) +
                          " more; a further word narrows it down, --json has them all",
                      2, width);
  return text;
}

nlohmann::ordered_json findings_json(const std::vector<Finding>& found) {
  nlohmann::ordered_json json{{"kind", "search"}};
  auto& list = json["found"] = nlohmann::ordered_json::array();
  for (const Finding& one : found)
    list.push_back({{"kind", one.kind}, {"name", one.name}, {"text", one.text}});
  return json;
}

}  // namespace

Subject search_subject(const std::vector<std::string>& words) {
  std::vector<std::string> folded;
  std::string title = "What has to do with";
  for (const std::string& word : words) {
    if (shown_width(word) < kShortest) return {};
    folded.push_back(fold(word));
    title += " " + quote(word);
  }
  auto found = find_all(folded);
  if (found.empty()) return {};
  return {[found, title](std::size_t width) { return findings_text(found, title, width); },
          [found] { return findings_json(found); }};
}

}  // namespace lockstep::cli
