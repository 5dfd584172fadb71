// lockstep describe: what has to do with a word.
#include "cli/describe/search.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "cli/describe/table.hpp"
#include "cli/describe/values.hpp"
#include "projects/expressions/functions.hpp"
#include "projects/expressions/operators.hpp"
#include "projects/expressions/type_table.hpp"
#include "projects/json/problem.hpp"
#include "projects/keys/texts.hpp"
#include "projects/literals/types.hpp"
#include "tech_objects/alarms/error_remedies.hpp"
#include "tech_objects/cam_design/motion_law.hpp"

namespace lockstep::cli {
namespace {

constexpr std::size_t kShortest = 3;  // letters of a word that is searched for
constexpr std::size_t kShown = 24;    // findings, so that they fit on a screen

/// Something that may be found.
struct Finding {
  std::string_view kind;
  std::string name;  ///< by which `describe` tells more
  std::string text;
  std::size_t own = 0;   ///< where the part of the name begins that is its own; before it stands its owner
  std::string more{};    ///< what else is said of it, and is not shown
  bool titled = false;   ///< it is known by its text: its name is a number
  bool dialect = false;  ///< of an MCO 305 or a LinMot controller
  int rank = 0;          ///< the higher, the nearer
};

/// Of the same rank the first is told first.
constexpr std::string_view kKinds[] = {"block",    "alarm",    "error", "object", "key",
                                       "function", "operator", "type",  "pin",    "variable"};

std::size_t order_of(const Finding& finding) {
  return static_cast<std::size_t>(std::ranges::find(kKinds, finding.kind) - std::begin(kKinds));
}

/// What people call what has another name here.
struct Synonym {
  std::string_view word;
  std::vector<std::string_view> here;
};
const std::vector<Synonym>& synonyms() {
  static const std::vector<Synonym> kSynonyms = {
      {"timer", {"ton", "tof", "tp"}},
      {"counter", {"ctu", "ctd", "ctud", "ctu_dint", "ctd_dint", "ctud_dint", "counts"}},
      {"reset", {"r"}},
      {"latch", {"sr", "rs"}},
      {"flipflop", {"sr", "rs"}},
      {"reference", {"home", "homing"}},
      {"division", {"div", "divided", "quotient"}},
      {"divide", {"div", "divided", "quotient"}},
      {"zero", {"0"}},
      {"halt", {"rest", "standstill", "stop"}},
      {"stop", {"rest", "standstill", "halt"}},
      {"master", {"leading"}},
      {"slave", {"following"}},
      {"lag", {"following"}},
      {"string", {"text", "texts"}},
      {"speed", {"velocity"}},
      {"metre", {"lengthunit"}},
      {"meter", {"lengthunit"}},
      {"millimetre", {"lengthunit"}},
      {"millimeter", {"lengthunit"}},
      {"inch", {"lengthunit"}},
      {"degree", {"lengthunit"}}};
  return kSynonyms;
}

/// Words that tell nothing.
constexpr std::string_view kFilling[] = {"a",  "an", "and", "by", "do", "for", "how", "i",   "in",
                                         "is", "my", "of",  "on", "or", "the", "to",  "with"};

/// What is not described here, and where it is.
constexpr std::pair<std::string_view, std::string_view> kElsewhere[] = {
    {"sweep",
     "a project with many values, on all processors: lockstep.sweep of the Python package, "
     "projects/python/README.md"}};

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

/// A name counts for more than what is said of it or whose it is; 0 if the word is nowhere.
int fit_of(std::string_view word, const Finding& finding) {
  const std::string_view name = finding.name;
  const int in_name = fit(word, name.substr(finding.own));
  // Within another word of a sentence a word means something else, as "cam" in "became".
  const auto in_sentence = [word](std::string_view text) {
    const int found = fit(word, text);
    return found < 2 ? 0 : found;
  };
  const int in_text = (finding.titled ? 4 : 1) * in_sentence(finding.text);
  const int in_rest = in_sentence(finding.more) + in_sentence(name.substr(0, finding.own)) > 0 ? 1 : 0;
  return std::max({4 * in_name, in_text, in_rest});
}

/// How well a finding fits all of some words; another name of one counts, but only where it is a whole word.
int rank_of(const std::vector<std::string>& words, const Finding& finding) {
  int rank = 0;
  for (const std::string& word : words) {
    int fits = fit_of(word, finding);
    const auto found = std::ranges::find(synonyms(), word, &Synonym::word);
    if (found != synonyms().end())
      for (const std::string_view other : found->here) {
        const bool whole =
            std::max({fit(other, finding.name), fit(other, finding.text), fit(other, finding.more)}) == 3;
        if (whole) fits = std::max(fits, fit_of(other, finding));
      }
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

/// Whether it is of a motor of a LinMot controller but its first, which has the same.
bool is_further_motor(std::string_view path) {
  return path.size() > 2 && path[1] == '.' && path[0] >= 'B' && path[0] <= 'D';
}

std::string words_of(std::span<const Choice> choices) {
  std::string text;
  for (const Choice& choice : choices) text += std::string(choice.text) + "; ";
  return text;
}

void add_variables(std::vector<Finding>& all) {
  std::unordered_set<std::string_view> seen;
  for (const ObjectKindText& object : kObjectKinds) {
    const std::string_view type = object.name;
    const bool dialect = type == "MCO_305" || type == "LinMot_Controller";
    all.push_back({"object", std::string(type), std::string(object.text)});
    for (const auto list : data_block_of(object.kind).lists())
      for (const Variable& variable : list) {
        if (!seen.insert(variable.path).second || (dialect && is_further_motor(variable.path))) continue;
        const bool of_motor = dialect && variable.path.starts_with("A.");
        all.push_back({.kind = "variable",
                       .name = std::string(variable.path),
                       .text = std::string(variable.text) + (of_motor ? "; of B, C, D too" : ""),
                       .more = words_of(variable.choices),
                       .dialect = dialect});
      }
  }
}

void add_alarms(std::vector<Finding>& all) {
  for (const Alarm& alarm : alarms())
    all.push_back({.kind = "alarm",
                   .name = std::to_string(alarm.number),
                   .text = std::string(alarm.text),
                   .more = std::string(alarm.cause) + "; " + std::string(alarm.remedy),
                   .titled = true});
  for (const ErrorText& error : error_texts())
    all.push_back({.kind = "error",
                   .name = error_literal(static_cast<unsigned>(error.id)),
                   .text = std::string(error.text),
                   .more = std::string(error_remedy(error.id))});
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
    all.push_back({.kind = "function",
                   .name = std::string(function.name),
                   .text = std::string(function.meaning),
                   .more = std::string(function.takes) + "; " + std::string(function.edges)});
  for (const ExpressionOperator& one : expression_operators())
    all.push_back({.kind = "operator",
                   .name = std::string(one.text),
                   .text = std::string(one.meaning),
                   .more = std::string(one.takes) + "; " + std::string(one.edges)});
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
    all.push_back(
        {.kind = one.kind, .name = std::move(one.name), .text = std::move(one.text), .dialect = true});
}

void add_elsewhere(std::vector<Finding>& all) {
  for (std::size_t i = 0; i < kMotionLaws; ++i)
    all.push_back({"cam law", std::string(motion_law_name(static_cast<MotionLawKind>(i))),
                   "motion law of a transition of a cam, its \"law\"; projects/CAMS.md"});
  for (const auto& [name, text] : kElsewhere)
    all.push_back({"elsewhere", std::string(name), std::string(text)});
}

/// Best first, dialects behind; of the same rank by kind, then as they stand in their tables.
std::vector<Finding> find_all(const std::vector<std::string>& words) {
  std::vector<Finding> all;
  add_blocks(all);
  add_variables(all);
  add_alarms(all);
  add_keys(all);
  add_language(all);
  add_mco305(all);
  add_elsewhere(all);
  for (Finding& finding : all) finding.rank = rank_of(words, finding);
  std::erase_if(all, [](const Finding& finding) { return finding.rank == 0; });
  std::ranges::stable_sort(all, {}, [](const Finding& finding) {
    return std::tuple(finding.dialect, -finding.rank, order_of(finding));
  });
  return all;
}

/// Those that tell something, in lower case; all where none does.
std::vector<std::string> telling(const std::vector<std::string>& words) {
  std::vector<std::string> all, some;
  for (const std::string& word : words) {
    all.push_back(fold(word));
    if (std::ranges::find(kFilling, all.back()) == std::end(kFilling)) some.push_back(all.back());
  }
  return some.empty() ? all : some;
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
  const std::vector<std::string> folded = telling(words);
  if (std::ranges::any_of(folded, [](const std::string& word) { return shown_width(word) < kShortest; }))
    return {};
  std::string title = "What has to do with";
  for (const std::string& word : words) title += " " + quote(word);
  auto found = find_all(folded);
  if (found.empty()) return {};
  return {[found, title](std::size_t width) { return findings_text(found, title, width); },
          [found] { return findings_json(found); }};
}

Subject with_namesakes(const Subject& subject, const std::string& word) {
  constexpr std::size_t kNamesakes = 8;
  constexpr int kNear = 8;  // at least the beginning of a name
  std::vector<Finding> found = find_all({fold(word)});
  std::erase_if(found, [](const Finding& one) { return one.dialect || one.rank < kNear; });
  if (found.empty()) return subject;
  if (found.size() > kNamesakes) found.resize(kNamesakes);
  const std::string title = "What else has to do with " + quote(word);
  return {[subject, found, title](std::size_t width) {
            return subject.text(width) + "\n" + findings_text(found, title, width);
          },
          [subject, found] {
            nlohmann::ordered_json json = subject.json();
            json["also"] = findings_json(found)["found"];
            return json;
          }};
}

}  // namespace lockstep::cli
