#include "cli/completion/command_shape.hpp"

#include <CLI/App.hpp>
#include <sstream>

namespace lockstep::cli {
namespace {

/// Of "TEXT:{design,data,points}", as CLI11 writes the check of an option.
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}');
  std::vector<std::string> choices;
  if (open == type.npos || close == type.npos) return choices;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(list, choice, ',');) choices.push_back(choice);
  return choices;
}

OptionShape shape_of(const CLI::Option& option) {
  OptionShape shape;
  for (const std::string& name : option.get_lnames()) shape.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) shape.names.push_back("-" + name);
  if (shape.names.empty()) shape.placeholder = option.get_name(true);
  shape.text = option.get_description();
  shape.takes_value = option.get_items_expected_max() > 0;
  shape.choices = choices_in(option.get_type_name());
  return shape;
}

}  // namespace

CommandShape shape_of(const CLI::App& app) {
  CommandShape shape{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) shape.options.push_back(shape_of(*option));
  for (const CLI::App* command : app.get_subcommands(nullptr)) shape.commands.push_back(shape_of(*command));
  return shape;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace lockstep::cli
