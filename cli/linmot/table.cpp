// lockstep linmot table: the state table of a project, as it counts.
#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "cli/command/linmot_text.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/linmot/linmot_command.hpp"
#include "tech_objects/linmot/controller.hpp"

namespace lockstep::cli {
namespace {

int tell_tables(const std::string& file, bool csv) {
  int status = kOk;
  const auto project = load_or_tell(file, status);
  if (!project) return status;
  for (const auto& object : project->controller->objects)
    if (object->kind == ObjectKind::LinMot_Controller)
      write_data(csv ? linmot_table_csv(static_cast<const LinMotController&>(*object))
                     : linmot_table_text(static_cast<const LinMotController&>(*object)));
  return kOk;
}

}  // namespace

void add_linmot_table(CLI::App& linmot, Action& action) {
  CLI::App* command = linmot.add_subcommand("table", "Tell the state tables of a project, as they count");
  auto file = std::make_shared<std::string>();
  auto csv = std::make_shared<bool>(false);
  command->add_option("FILE", *file, "project")->required();
  command->add_flag("--csv", *csv, "rows as a file of \"state_table\": { \"file\": … } has them");
  command->callback([&action, file, csv] { action = [file, csv] { return tell_tables(*file, *csv); }; });
}

}  // namespace lockstep::cli
