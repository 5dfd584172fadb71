// lockstep describe: tells what function blocks, technology objects, alarms and errors there are and mean.
#include <CLI/App.hpp>
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/command/command.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/describe/search.hpp"
#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "projects/json/problem.hpp"

namespace lockstep::cli {
namespace {

struct Topic {
  std::string_view name, text;
  Subject (*subject)();
};
constexpr Topic kTopics[] = {
    {"alarms", "technology alarms; describe 608: one of them", &alarms_subject},
    {"errors", "error identifiers of blocks; describe 16#8026: one of them", &errors_subject},
    {"override", "what a new job does to those that run; describe override MC_GearInPos", &overrides_subject},
    {"keys", "keys of the project file; describe keys technology_objects.drive",
     [] { return keys_subject(""); }},
    {"functions", "standard functions of expressions; describe SEL, TO_INT: one of them", &functions_subject},
    {"operators", "operators of expressions; describe MOD: one of them", &operators_subject},
    {"types", "types and literals; describe LREAL: one of them", &types_subject},
};

std::string subjects_text(std::size_t width) {
  Table blocks({"Function block", ""});
  for (const BlockType& type : block_types()) blocks.row({std::string(type.name), std::string(type.text)});
  Table objects({"Technology object", ""});
  for (const ObjectKindText& object : kObjectKinds)
    objects.row({std::string(object.name), std::string(object.text)});
  Table topics({"Also", ""});
  for (const Topic& topic : kTopics) topics.row({std::string(topic.name), std::string(topic.text)});
  topics.row({"KPROP", "of an MCO 305: a parameter, also 32-60; POSA a command, error 108, sysvar 4097"});
  topics.row({"ASCII", "of a LinMot controller: commands; MT: of its state table; PROFIBUS: modules"});
  topics.row({"MC_Home.Mode", "a pin of a block"});
  topics.row({"DynamicLimits",
              "a structure of technology objects, or a variable: DynamicLimits.MaxVelocity, "
              "StatusWord.X5"});
  return blocks.text(0, width) + "\n" + objects.text(0, width) + "\n" + topics.text(0, width);
}

nlohmann::ordered_json subjects_json() {
  nlohmann::ordered_json json{{"kind", "overview"}};
  const auto add = [](nlohmann::ordered_json& list, std::string_view name, std::string_view text) {
    list.push_back({{"name", name}, {"text", text}});
  };
  auto& blocks = json["function_blocks"] = nlohmann::ordered_json::array();
  for (const BlockType& type : block_types()) add(blocks, type.name, type.text);
  auto& objects = json["technology_objects"] = nlohmann::ordered_json::array();
  for (const ObjectKindText& object : kObjectKinds) add(objects, object.name, object.text);
  auto& topics = json["topics"] = nlohmann::ordered_json::array();
  for (const Topic& topic : kTopics) add(topics, topic.name, topic.text);
  return json;
}

/// Reads "608", "16#8026", "0x8026"; none for anything else.
std::optional<std::uint32_t> number_of(std::string_view word, bool& hexadecimal) {
  const std::string folded = fold(word);
  std::string_view digits = folded;
  hexadecimal = digits.starts_with("16#") || digits.starts_with("0x");
  if (hexadecimal) digits.remove_prefix(digits[0] == '1' ? 3 : 2);
  std::uint32_t number = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), number, hexadecimal ? 16 : 10);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

/// Of an error: "16#8001", "8001" and "32769" are the same.
std::optional<std::uint32_t> number_of_error(const std::string& word) {
  bool hexadecimal = false;
  const auto number = number_of(word, hexadecimal);
  if (!number || hexadecimal || *number >= 0x8000) return number;
  return number_of("16#" + word, hexadecimal);
}

Subject find_error(std::uint32_t number) {
  const auto id = static_cast<ErrorId>(number);
  return number <= 0xFFFF && !error_text(id).empty() ? error_subject(id) : Subject{};
}

/// Of "error N", which is none of an MCO 305: an identifier of an error, else none.
Subject find_error_of_any(std::string_view word, std::uint32_t number, std::string& problem) {
  if (Subject subject = find_error(number)) return subject;
  std::string all;
  for (const std::string& one : mco305_error_numbers()) all += (all.empty() ? "" : ", ") + one;
  problem = "there is no error " + quote(word) + "; allowed: of an MCO_305 " + all +
            ", or an ErrorID such as 16#8026; lockstep describe errors lists these";
  return {};
}

/// An alarm, or an error whose identifier is shown as a decimal number.
Subject find_number(std::string_view word, bool hexadecimal, std::uint32_t number, std::string& problem) {
  if (!hexadecimal)
    if (const Alarm* const alarm = find_alarm(static_cast<int>(number & 0x7FFFFFFF)))
      return alarm_subject(*alarm);
  if (hexadecimal || number >= 0x8000)
    if (Subject subject = find_error(number)) return subject;
  problem = "there is no " + std::string(hexadecimal ? "error " : "alarm ") + quote(word);
  bool is_hexadecimal = false;
  const std::string as_error = "16#" + std::string(word);
  const auto error = hexadecimal ? std::nullopt : number_of(as_error, is_hexadecimal);
  if (error && find_error(*error)) problem += " (did you mean '" + as_error + "'?)";
  problem += std::string("; lockstep describe ") + (hexadecimal ? "errors" : "alarms") + " lists them";
  return {};
}

/// A block or one of its pins. @param problem is set if the block is there and the pin is not
Subject find_block(std::string_view word, std::string& problem) {
  const auto point = word.find('.');
  const BlockType* const type = find_block_type(word.substr(0, point));
  if (type == nullptr) return {};
  if (point == word.npos) return block_subject(*type, nullptr);
  const std::string_view name = word.substr(point + 1);
  if (const Pin* const pin = type->find_pin(name)) return block_subject(*type, pin);
  std::vector<std::string_view> names;
  for (const Pin& pin : type->pins) names.push_back(pin.name);
  problem = std::string(type->name) + " has no pin " + quote(name) + did_you_mean(name, names);
  return {};
}

/// A type of technology object or some of its variables.
Subject find_object(std::string_view word, std::string& problem) {
  const auto point = word.find('.');
  for (const ObjectKindText& object : kObjectKinds) {
    const std::string_view name = object.name;
    if (!same_name(name, word.substr(0, point))) continue;
    if (point == word.npos) return variables_subject(name, "");
    const std::string_view path = word.substr(point + 1);
    if (Subject subject = path.empty() ? Subject{} : variables_subject(name, path)) return subject;
    problem = std::string(name) + " has no variable " + quote(path) + did_you_mean(path, variable_names());
    return {};
  }
  return word.empty() ? Subject{} : variables_subject("", word);
}

Subject find_keys(std::string_view path, std::string& problem) {
  if (Subject subject = keys_subject(path)) return subject;
  const std::vector<std::string> paths = key_paths();
  problem = "the project file has no keys at " + quote(path) +
            did_you_mean(path, std::vector<std::string_view>(paths.begin(), paths.end())) +
            "; lockstep describe keys lists its structures";
  return {};
}

std::string quoted(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + quote(word);
  return text;
}

std::string unknown(std::string_view word) {
  std::vector<std::string_view> names = variable_names();
  for (const BlockType& type : block_types()) names.push_back(type.name);
  for (const ObjectKindText& object : kObjectKinds) names.emplace_back(object.name);
  for (const Topic& topic : kTopics) names.push_back(topic.name);
  for (const std::string_view name : language_names()) names.push_back(name);
  return "there is nothing called " + quote(word) + did_you_mean(word, names) +
         "; lockstep describe lists what there is";
}

/// Words that came in one pair of quotation marks, as "keys include", are words too.
std::vector<std::string> apart(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  for (const std::string& word : words) {
    std::istringstream stream(word);
    for (std::string one; stream >> one;) all.push_back(one);
  }
  return all;
}

int describe(const std::vector<std::string>& words, bool json) {
  std::string problem;
  const auto single = apart(words);
  const bool quoted_together = single.size() > words.size();
  Subject subject;
  if (quoted_together && single.size() == 2) subject = mco305_subject(single);  // "error 108"
  if (!subject) subject = find_subject(words, problem);
  if (!subject && quoted_together) subject = find_subject(single, problem);
  if (!subject) {
    write_message("lockstep: " + problem + "\n");
    return kNotValid;
  }
  const std::string text = json ? subject.json().dump(2) + "\n" : subject.text(output_width());
  write_data(text);
  return kOk;
}

}  // namespace

Subject overview() {
  return {&subjects_text, &subjects_json};
}

std::vector<std::string> describable_names() {
  std::vector<std::string> names;
  for (const Topic& topic : kTopics) names.emplace_back(topic.name);
  for (const BlockType& type : block_types()) names.emplace_back(type.name);
  for (const ObjectKindText& object : kObjectKinds) names.emplace_back(object.name);
  for (const std::string_view name : language_names())
    if (name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == name.npos)
      names.emplace_back(name);
  return names;
}

bool is_topic(const std::string& word) {
  return std::any_of(std::begin(kTopics), std::end(kTopics),
                     [&](const Topic& known) { return same_name(known.name, word); });
}

/// What several words mean, of which the first is a topic or none.
Subject find_by_words(const std::vector<std::string>& words, std::string& problem) {
  const std::string& word = words.front();
  const bool topic = is_topic(word);
  if (words.size() == 2) {
    if (same_name(word, "keys")) return find_keys(words[1], problem);
    if (same_name(word, "override")) {
      if (Subject subject = override_subject(words[1])) return subject;
      problem = "there is no instruction " + quote(words[1]) + " in the override tables" +
                did_you_mean(words[1], override_names()) + "; lockstep describe override lists them";
      return {};
    }
    if (Subject subject = topic ? Subject{} : mco305_subject(words)) return subject;
    // As a run tells them.
    if (same_name(word, "alarm"))
      if (bool hexadecimal = false; const auto number = number_of(words[1], hexadecimal))
        return find_number(words[1], false, *number, problem);
    if (same_name(word, "error") || same_name(word, "ErrorID"))
      if (const auto number = number_of_error(words[1])) return find_error_of_any(words[1], *number, problem);
  }
  if (Subject subject = topic ? Subject{} : search_subject(words)) return subject;
  problem = topic ? quote(word) + (words.size() == 2 ? " takes no second name" : " takes no third name")
                  : "there is nothing that has to do with all of " + quoted(words);
  problem += "; only override and keys take one, as in override MC_GearInPos, keys clock";
  return {};
}

std::optional<std::string> describe_as_json(std::string_view path) {
  std::vector<std::string> words;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    if (end > 0) words.emplace_back(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  std::string problem;
  const Subject subject = words.empty() ? overview() : find_subject(words, problem);
  if (!subject) return std::nullopt;
  return subject.json().dump(2) + "\n";
}

Subject find_subject(const std::vector<std::string>& words, std::string& problem) {
  if (words.empty()) return overview();
  const std::string& word = words.front();
  if (Subject subject = linmot_subject(words)) return subject;
  if (words.size() > 1) return find_by_words(words, problem);
  for (const Topic& topic : kTopics)
    if (same_name(topic.name, word)) return topic.subject();
  bool hexadecimal = false;
  if (const auto number = number_of(word, hexadecimal)) {
    if (Subject subject = find_number(word, hexadecimal, *number, problem)) return subject;
    return mco305_subject(words);
  }
  if (Subject subject = language_subject(word)) return subject;
  if (Subject subject = find_block(word, problem)) return subject;
  if (problem.empty())
    if (Subject subject = mco305_subject(words)) return with_namesakes(subject, word);
  if (problem.empty())
    if (Subject subject = find_object(word, problem)) return subject;
  if (!problem.empty()) return {};
  if (Subject subject = habit_subject(word)) return subject;
  if (word.find('.') == word.npos)
    if (Subject subject = search_subject(words)) return subject;
  problem = unknown(word);
  return {};
}

void add_describe_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "describe", "Tell about blocks, objects, variables, alarms, functions, keys; search by a word");
  auto words = std::make_shared<std::vector<std::string>>();
  auto json = std::make_shared<bool>(false);
  command->add_option("NAME", *words, "what to tell about; without it: a list of what there is");
  command->add_flag("--json", *json, "as JSON, for programs");
  command->footer(
      "NAME, without regard to case:\n"
      "  MC_GearInPos, MC_GearInPos.InSync        a function block, one of its pins\n"
      "  TO_SynchronousAxis                       all variables of a technology object\n"
      "  TO_SynchronousAxis.DynamicLimits, DynamicLimits.MaxVelocity, StatusWord, StatusWord.X5\n"
      "                                           some variables, one, one bit\n"
      "  608, alarms                              a technology alarm, all of them\n"
      "  16#8026, errors                          an ErrorID, all of them\n"
      "  alarm 608, ErrorID 16#8026               the same, as a run tells them\n"
      "  override MC_GearInPos                    what such a job does to those that run\n"
      "  keys, keys technology_objects.drive      keys of the project file\n"
      "  functions, operators, types              those of expressions\n"
      "  SEL, TO_INT, MOD, LREAL                  one of them\n"
      "  KPROP, 32-60, POSA, DEF ORIGIN           a parameter, a command of an MCO 305\n"
      "  error 108, sysvar 4097                   an error, a system variable of it\n"
      "  LinMot_Controller \"Max Speed\"            a parameter of a LinMot controller, by name or path\n"
      "  ASCII SP, MT Freeze, PROFIBUS            a command, a module of it; all of them\n"
      "  gear, following error                    what has to do with these words, nearest first\n"
      "Exit status: 0, or 1 if there is nothing of that name");
  command->callback([&action, words, json] { action = [words, json] { return describe(*words, *json); }; });
}

}  // namespace lockstep::cli
