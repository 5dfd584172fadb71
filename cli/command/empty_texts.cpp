// What a command line says with nothing in it.
#include <CLI/App.hpp>

#include "cli/command/command.hpp"

namespace lockstep::cli {

void refuse_empty_texts(CLI::App& command) {
  for (CLI::Option* const option : command.get_options())
    if (option->get_items_expected_max() > 0)
      option->check(CLI::Validator(
          [](const std::string& text) {
            return text.empty() ? std::string("an empty text is no value") : "";
          },
          ""));
}

}  // namespace lockstep::cli
