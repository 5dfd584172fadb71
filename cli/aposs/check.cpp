// lockstep aposs check: tells every problem of programs, and what they need.
#include <CLI/App.hpp>
#include <algorithm>

#include "cli/aposs/aposs_command.hpp"
#include "cli/command/standard_streams.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/aposs/listing.hpp"
#include "projects/aposs/parameter_names.hpp"

namespace lockstep::cli {
namespace {

template <class List, class Text>
std::string listed(const List& list, Text text) {
  std::string result;
  for (const auto& one : list) result += (result.empty() ? "" : ", ") + text(one);
  return result;
}

std::string number_text(std::int32_t number) {
  return std::to_string(number);
}

/// The needs of a program that it tells itself, a line for each kind.
std::string needs_of(const std::string& path, const aposs::CompiledProgram& program) {
  const aposs::Image& image = *program.image;
  std::string text = visible(path) + ": " + std::to_string(image.code.size()) + " internal commands, " +
                     std::to_string(image.variables.size()) + " variables\n";
  const auto line = [&text](const char* what, const std::string& list) {
    if (!list.empty()) text += std::string("  ") + what + " " + list + "\n";
  };
  line("arrays", listed(image.arrays, [](const aposs::ArrayDeclaration& array) {
         return array.name + "[" + std::to_string(array.size) + "]";
       }));
  line("inputs", listed(program.uses.inputs, number_text));
  line("outputs", listed(program.uses.outputs, number_text));
  line("parameters", listed(program.uses.parameters, aposs::parameter_text));
  line("handlers", listed(handlers_of(image), [&image](const aposs::Routine& routine) {
         const auto longest = longest_run(image, routine.entry);
         return routine.name + " (" + (longest ? "at most " + std::to_string(*longest) : "any number of") +
                " internal commands)";
       }));
  return text;
}

int check(const std::vector<std::string>& files, const aposs::CompilerSettings& settings) {
  int worst = kOk;
  for (const std::string& file : files) {
    int status = kOk;
    const auto program = compile_or_tell(file, settings, status);
    if (program)
      write_data(needs_of(file, *program));
    else
      worst = std::max(worst, status);
  }
  return worst;
}

}  // namespace

void add_aposs_check(CLI::App& aposs, Action& action) {
  CLI::App* command = aposs.add_subcommand("check", "Tell every problem of programs, and what they need");
  auto files = std::make_shared<std::vector<std::string>>();
  auto settings = std::make_shared<aposs::CompilerSettings>();
  command->add_option("FILE", *files, "programs")->required();
  add_compiler_options(*command, *settings);
  command->callback(
      [&action, files, settings] { action = [files, settings] { return check(*files, *settings); }; });
}

}  // namespace lockstep::cli
