// lockstep aposs list: the compiled program beside its source.
#include <CLI/App.hpp>
#include <filesystem>
#include <sstream>

#include "cli/aposs/aposs_command.hpp"
#include "cli/command/standard_streams.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/aposs/listing.hpp"
#include "projects/json/text_file.hpp"

namespace lockstep::cli {
namespace {

constexpr std::size_t kMaximumSize = 1 << 20;

int list(const std::string& path, const aposs::CompilerSettings& settings) {
  int status = kOk;
  const auto program = compile_or_tell(path, settings, status);
  if (!program) return status;
  std::vector<std::string> sources;
  for (const std::string& file : program->files) {
    const std::filesystem::path beside = std::filesystem::path(path).parent_path() / file;
    sources.push_back(read_text_file(sources.empty() ? path : beside.string(), kMaximumSize));
  }
  std::string line, text;
  for (std::istringstream lines(aposs::listing(*program->image, sources)); std::getline(lines, line);)
    text += visible(line) + "\n";
  write_data(text);
  return kOk;
}

}  // namespace

void add_aposs_list(CLI::App& aposs, Action& action) {
  CLI::App* command = aposs.add_subcommand("list", "Show the internal commands of a program below its lines");
  auto file = std::make_shared<std::string>();
  auto settings = std::make_shared<aposs::CompilerSettings>();
  command->add_option("FILE", *file, "a program")->required();
  add_compiler_options(*command, *settings);
  command->footer(
      "t0, t1 … are temporaries, a number as a target is that of an internal command. REST and RESTZ are "
      "jumps back\n"
      "over nothing but reads: they end the share of a step, since nothing changes before the next one.");
  command->callback(
      [&action, file, settings] { action = [file, settings] { return list(*file, *settings); }; });
}

}  // namespace lockstep::cli
