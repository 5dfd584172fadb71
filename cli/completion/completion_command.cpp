// lockstep completion: the scripts by which shells complete its command line.
#include <CLI/App.hpp>

#include "cli/command/command.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/completion/command_shape.hpp"
#include "cli/describe/subject.hpp"

namespace lockstep::cli {

void add_completion_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("completion", "Print the script that completes this command line");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "for which shell")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->footer(
      "The package installs the scripts. By hand:\n"
      "  source <(lockstep completion bash)\n"
      "  lockstep completion zsh > ~/.zfunc/_lockstep          (a folder of fpath)\n"
      "  lockstep completion fish > ~/.config/fish/completions/lockstep.fish");
  command->callback([&app, &action, shell] {
    action = [&app, shell] {
      const CommandShape program = shape_of(app);
      const std::vector<std::string> names = describable_names();
      write_data(*shell == "bash"  ? bash_completion(program, names)
                 : *shell == "zsh" ? zsh_completion(program, names)
                                   : fish_completion(program, names));
      return kOk;
    };
  });
}

}  // namespace lockstep::cli
