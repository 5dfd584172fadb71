/// What the command line of `lockstep` is made of, read from its declarations.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace lockstep::cli {

struct OptionShape {
  std::vector<std::string> names;    ///< "--output", "-o"; empty: it stands by its position
  std::string placeholder;           ///< of one that stands by its position: "FILE"
  std::string text;                  ///< what `--help` says
  bool takes_value = false;          ///< of one with names
  std::vector<std::string> choices;  ///< the only values that are allowed; empty: any
};

struct CommandShape {
  std::string name;
  std::string text;
  std::vector<OptionShape> options;
  std::vector<CommandShape> commands;
};

CommandShape shape_of(const CLI::App& app);

/// The words with a space between them.
std::string joined(const std::vector<std::string>& words);

/// Scripts that complete the command line, for the shell of their name.
/// @param names what `lockstep describe` can tell about
std::string bash_completion(const CommandShape& program, const std::vector<std::string>& names);
std::string zsh_completion(const CommandShape& program, const std::vector<std::string>& names);
std::string fish_completion(const CommandShape& program, const std::vector<std::string>& names);

}  // namespace lockstep::cli
