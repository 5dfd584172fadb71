// The script for fish: one line for each command and option.
#include "cli/completion/command_shape.hpp"

namespace lockstep::cli {
namespace {

/// Single quotes of fish know \' and \\.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

void add_for_fish(std::string& text, const CommandShape& command, const std::string& condition,
                  const std::vector<std::string>& names) {
  const std::string begin = "complete -c lockstep -n " + quoted(condition);
  for (const OptionShape& option : command.options) {
    if (option.names.empty()) {
      const std::vector<std::string>& words = command.name == "describe" ? names : option.choices;
      if (!words.empty())
        text += begin + " -f -a " + quoted(joined(words)) + " -d " + quoted(option.placeholder) + "\n";
      continue;
    }
    text += begin;
    for (const std::string& name : option.names)
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (option.takes_value)
      text += option.choices.empty() ? " -r" : " -x -a " + quoted(joined(option.choices));
    text += " -d " + quoted(option.text) + "\n";
  }
  std::string known;
  for (const CommandShape& below : command.commands) known += " " + below.name;
  for (const CommandShape& below : command.commands) {
    const bool first = command.name == "lockstep";
    const std::string not_yet =
        first ? "__fish_use_subcommand" : condition + "; and not __fish_seen_subcommand_from" + known;
    text += "complete -c lockstep -n " + quoted(not_yet) + " -f -a " + below.name + " -d " +
            quoted(below.text) + "\n";
    add_for_fish(text, below,
                 (first ? "" : condition + "; and ") + "__fish_seen_subcommand_from " + below.name, names);
  }
}

}  // namespace

std::string fish_completion(const CommandShape& program, const std::vector<std::string>& names) {
  std::string text = "# Completion of lockstep for fish, made by: lockstep completion fish\n";
  add_for_fish(text, program, "__fish_use_subcommand", names);
  return text;
}

}  // namespace lockstep::cli
