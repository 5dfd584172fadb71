// The script for zsh: a function for each command, which the one above calls.
#include "cli/completion/command_shape.hpp"

namespace lockstep::cli {
namespace {

/// In single quotes; what _arguments reads has its own marks.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'')
      result += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      result += std::string("\\") + c;
    else
      result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string values_of(const std::string& placeholder, const std::vector<std::string>& words) {
  if (words.empty()) return ":" + escaped(placeholder) + ":_files";
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : " ") + escaped(word);
  return ":" + escaped(placeholder) + ":(" + list + ")";
}

std::string argument_of(const CommandShape& command, const OptionShape& option,
                        const std::vector<std::string>& names) {
  if (option.names.empty())
    return "'*" + values_of(option.placeholder, command.name == "describe" ? names : option.choices) +
           "' \\\n    ";
  std::string text;
  for (const std::string& name : option.names)
    text += "'" + name + "[" + escaped(option.text) + "]" +
            (option.takes_value ? values_of("value", option.choices) : "") + "' \\\n    ";
  return text;
}

void add_for_zsh(std::string& text, const CommandShape& command, const std::string& function,
                 const std::vector<std::string>& names) {
  std::string arguments, list, branches;
  for (const OptionShape& option : command.options) arguments += argument_of(command, option, names);
  for (const CommandShape& below : command.commands) {
    list += "      '" + below.name + ":" + escaped(below.text) + "'\n";
    branches += "      " + below.name + ") " + function + "_" + below.name + " ;;\n";
    add_for_zsh(text, below, function + "_" + below.name, names);
  }
  text += function + "() {\n";
  if (command.commands.empty()) {
    text += "  _arguments \\\n    " + arguments + "&& return 0\n}\n";
    return;
  }
  text += "  local line state\n  _arguments -C \\\n    " + arguments +
          "'1: :->command' '*:: :->rest' && return 0\n"
          "  case $state in\n  command)\n    local -a commands=(\n" +
          list + "    )\n    _describe command commands\n    ;;\n  rest)\n    case $line[1] in\n" + branches +
          "    esac\n    ;;\n  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const CommandShape& program, const std::vector<std::string>& names) {
  std::string text =
      "#compdef lockstep\n# Completion of lockstep for zsh, made by: lockstep completion zsh\n";
  add_for_zsh(text, program, "_lockstep", names);
  return text + "_lockstep \"$@\"\n";
}

}  // namespace lockstep::cli
