#include "projects/aposs/names.hpp"

#include <algorithm>

#include "projects/json/problem.hpp"

namespace lockstep::aposs {
namespace {

constexpr std::string_view kWords[] = {"THEN", "ELSE",    "ELSEIF", "ENDIF",  "DO",       "ENDWHILE", "UNTIL",
                                       "AND",  "OR",      "NOT",    "MOD",    "RND",      "ABS",      "EXP",
                                       "ON",   "OFF",     "CHR",    "DEV",    "ENDPROG",  "RETURN",   "THEN",
                                       "CASE", "DEFAULT", "LONG",   "DOUBLE", "ENDSWITCH"};

const std::map<std::string, NamedCommand, std::less<>>& command_names() {
  static const auto names = [] {
    std::map<std::string, NamedCommand, std::less<>> map;
    const auto words = [](std::string_view name) {
      return 1 + static_cast<std::size_t>(std::count(name.begin(), name.end(), ' '));
    };
    for (const CommandRow& row : commands())
      if (row.kind != CommandKind::kForm) map[folded(row.name)] = {row.command, words(row.name), ""};
    for (const CommandAlias& alias : command_aliases()) {
      const Command usual = map.at(folded(alias.usual)).command;
      map[std::string(alias.name)] = {usual, words(alias.name), alias.equal ? "" : alias.name};
    }
    // The forms of ON, and those with two words that the language reads itself, are found by their first
    // word.
    for (const char* two : {"POSA CURVEPOS", "PRINT DEV", "FUNCTION DEFINITION", "DOUBLE FUNCTIONS"})
      map.erase(two);
    std::erase_if(map, [](const auto& entry) { return entry.first.starts_with("ON "); });
    return map;
  }();
  return names;
}

}  // namespace

std::optional<NamedCommand> command_at(std::span<const Token> tokens) {
  if (tokens.empty() || tokens[0].kind != Token::Kind::kName) return std::nullopt;
  const auto& names = command_names();
  if (tokens.size() > 1 && tokens[1].kind == Token::Kind::kName &&
      tokens[1].place.line == tokens[0].place.line && tokens[1].place.file == tokens[0].place.file) {
    const auto two = names.find(tokens[0].folded + " " + tokens[1].folded);
    if (two != names.end()) return two->second;
  }
  const auto one = names.find(tokens[0].folded);
  return one == names.end() ? std::nullopt : std::optional(one->second);
}

bool is_reserved(std::string_view folded_name) {
  return command_names().contains(folded_name) ||
         std::find(std::begin(kWords), std::end(kWords), folded_name) != std::end(kWords);
}

bool is_no_label(std::string_view folded_name) {
  return folded_name != "WAIT" && is_reserved(folded_name);
}

std::string commands_of_first_word(std::string_view folded_name) {
  std::string all;
  for (const auto& [command, row] : command_names())
    if (command.size() > folded_name.size() && command.starts_with(folded_name) &&
        command[folded_name.size()] == ' ' && row.unusual.empty())
      all += (all.empty() ? "" : ", ") + command;
  return all;
}

std::string nearest_name(std::string_view name, const std::set<std::string>& others) {
  std::vector<std::string_view> names(std::begin(kWords), std::end(kWords));
  for (const auto& [command, row] : command_names()) names.push_back(command);
  names.insert(names.end(), others.begin(), others.end());
  std::erase(names, name);
  return did_you_mean(name, names);
}

std::set<std::string> assigned_names(std::span<const Token> tokens) {
  std::set<std::string> names;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].kind != Token::Kind::kName || (i > 0 && tokens[i - 1].text == ".")) continue;
    const bool selected = tokens[i + 1].text == "." && i + 3 < tokens.size() && tokens[i + 3].text == "=";
    if ((tokens[i + 1].kind == Token::Kind::kSymbol && tokens[i + 1].text == "=") || selected)
      names.insert(tokens[i].folded);
  }
  return names;
}

}  // namespace lockstep::aposs
