// What a command line says with nothing in it.
#include <CLI/App.hpp>

#include "cli/command/command.hpp"

namespace lockstep::cli {

void refuse_empty_texts(CLI::App& app) {
  for (CLI::Option* const option : app.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // a flag
    // Before all other checks, which would say less.
    option->transform(CLI::Validator(
        [what = option->get_description()](const std::string& text) {
          return text.empty() ? "an empty text is no value; needed: " + what : std::string();
        },
        ""));
  }
  for (CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
    refuse_empty_texts(*command);
}

std::vector<std::string> with_empty_texts(const std::vector<std::string>& words) {
  std::vector<std::string> result;
  bool options = true;
  for (const std::string& word : words) {
    options = options && word != "--";
    if (options && word.starts_with("--") && word.find('=') == word.size() - 1) {
      result.push_back(word.substr(0, word.size() - 1));
      result.emplace_back();
    } else {
      result.push_back(word);
    }
  }
  return result;
}

}  // namespace lockstep::cli
