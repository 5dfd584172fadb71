// The script for bash: which words may stand behind which command.
#include "cli/completion/command_shape.hpp"

namespace lockstep::cli {
namespace {

/// What is said of each command, by its path: "cam info".
struct Cases {
  std::string paths, words, values;

  void add(const CommandShape& command, const std::string& path, const std::string& names) {
    std::vector<std::string> options, commands;
    for (const OptionShape& option : command.options) {
      for (const std::string& name : option.names) {
        options.push_back(name);
        if (!option.takes_value) continue;
        const std::string given = option.choices.empty() ? "-f" : "-W '" + joined(option.choices) + "'";
        values += "    '" + path + " " + name + "') COMPREPLY=($(compgen " + given +
                  " -- \"$current\")); return ;;\n";
      }
      if (option.names.empty() && !option.choices.empty())
        commands.insert(commands.end(), option.choices.begin(), option.choices.end());
    }
    for (const CommandShape& below : command.commands) {
      commands.push_back(below.name);
      const std::string inner = path.empty() ? below.name : path + " " + below.name;
      paths += "      '" + path + " " + below.name + "') path='" + inner + "' ;;\n";
      add(below, inner, names);
    }
    std::string plain = joined(commands);
    if (path == "describe") plain = names;
    words += "    '" + path + "') options='" + joined(options) + "' words='" + plain + "' ;;\n";
  }
};

}  // namespace

std::string bash_completion(const CommandShape& program, const std::vector<std::string>& names) {
  Cases cases;
  cases.add(program, "", joined(names));
  return "# Completion of lockstep for bash, made by: lockstep completion bash\n"
         "_lockstep() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
         "  local path='' options='' words='' i\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    case \"$path ${COMP_WORDS[i]}\" in\n" +
         cases.paths +
         "    esac\n"
         "  done\n"
         "  case \"$path $previous\" in\n" +
         cases.values +
         "  esac\n"
         "  case \"$path\" in\n" +
         cases.words +
         "  esac\n"
         "  if [[ $current == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
         "  elif [[ -n $words ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "  else\n"
         "    COMPREPLY=($(compgen -f -- \"$current\"))\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _lockstep lockstep\n";
}

}  // namespace lockstep::cli
