#include "cli/run/transcript.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "cli/command/command.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/runtime/run_options.hpp"

namespace lockstep::cli {
namespace {

/// A field of CSV, in quotes where it needs them.
std::string csv_field(const std::string& text) {
  const std::string shown = visible(text);
  if (shown.find_first_of(",\"") == std::string::npos) return shown;
  std::string quoted = "\"";
  for (const char c : shown) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

struct Answered {
  std::size_t line;
  const linmot::ScriptedCommand* command;
};

}  // namespace

Transcript::Transcript(const std::string& path, const Project& project) : path_(path) {
  if (path.empty()) return;
  if (project.ascii_lines.empty())
    throw CouldNotStart("--transcript: the project has no line in 'ascii' of which there could be one");
  file_.open(path, std::ios::binary | std::ios::trunc);
  if (!file_) throw CouldNotStart("--transcript: '" + path + "' cannot be written");
}

bool Transcript::write(const Project& project) {
  if (path_.empty()) return true;
  std::vector<Answered> all;
  for (std::size_t line = 0; line < project.ascii_lines.size(); ++line)
    for (const linmot::ScriptedCommand& command : project.ascii_lines[line].script)
      if (command.answered_at >= 0) all.push_back({line, &command});
  std::ranges::stable_sort(all, {}, [](const Answered& one) { return one.command->answered_at; });
  file_ << "t,line,request,answer\n";
  for (const auto& [line, command] : all)
    file_ << fmt::format("{},{},{},{}\n", static_cast<double>(command->answered_at) / 1e9, line,
                         csv_field(command->text), linmot::ascii_text(command->answer));
  file_.close();
  if (file_) return true;
  tell("--transcript: '" + path_ + "' could not be written to its end", Severity::error);
  return false;
}

}  // namespace lockstep::cli
