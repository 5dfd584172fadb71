#include "projects/runtime/kept_values.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "projects/runtime/run_files.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".retain";

/// What the file holds beside what the project keeps.
void tell_strangers(const RetainFile& file, const Project& project, Messages& messages) {
  for (const KeptRow& row : file.rows()) {
    bool known = false;
    for (const KeptValue& value : project.retain.values)
      known |= file.find(value.name) == file.find(row.name);
    if (!known)
      messages.warn(
          fmt::format("retain file {}: {} ({}) is kept there and not in the "
                      "project; it stays in the file",
                      file.path(), row.name, shown(row.value)));
  }
  if (!file.rows().empty()) return;
  for (const std::string& other : file.other_projects())
    messages.warn(
        fmt::format("retain file {}: it has values of project '{}' and none of "
                    "'{}': they begin with their init values",
                    file.path(), other, project.name));
}

}  // namespace

std::string retain_path(const Project& project, const RunOptions& options) {
  if (!options.retain.empty()) return options.retain;
  if (!project.retain.file.empty()) return project.retain.file;
  const fs::path own = fs::path(options.file).replace_extension(kEnding);
  const std::string state = state_directory();
  return state.empty() ? own.string() : (fs::path(state) / own.filename()).string();
}

std::unique_ptr<RetainWriter> restore_kept(Project& project, const RunOptions& options, Messages& messages) {
  if (options.simulate || options.no_retain || project.retain.values.empty()) return nullptr;
  RetainFile file(retain_path(project, options), project.name);
  for (const std::string& remark : restore(file, project.retain.values)) messages.warn(remark);
  tell_strangers(file, project, messages);
  const std::string_view is_new = file.other_projects().empty() ? ", which is new" : "";
  messages.inform(file.rows().empty()
                      ? fmt::format("values are kept in {}{}", file.path(), is_new)
                      : fmt::format("{} kept values from {}", file.rows().size(), file.path()));
  return std::make_unique<RetainWriter>(std::move(file), project.retain.values, project.retain.interval,
                                        &project.controller->encoder_saving);
}

}  // namespace lockstep
