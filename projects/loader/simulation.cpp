#include "projects/loader/simulation.hpp"

#include <utility>

#include "projects/expressions/own_variables.hpp"
#include "projects/loader/mco305_panel.hpp"
#include "projects/loader/written_value.hpp"

namespace lockstep {
namespace {

Project valid(LoadedProject loaded) {
  if (loaded.project) return std::move(*loaded.project);
  std::string text = "the project is not valid";
  for (const Problem& problem : loaded.problems) text += "\n" + problem.place + ": " + problem.text;
  throw InvalidProject(text);
}

Operand operand_at(const Project& project, std::string_view path) {
  const FoundOperand found = project.names.find(path);
  if (!found.place) throw std::out_of_range(found.problem);
  return *found.place;
}

}  // namespace

Simulation::Simulation(LoadedProject loaded) : project_(valid(std::move(loaded))) {
  project_.controller->apply_stimuli = true;
}

Simulation::Simulation(const std::string& path) : Simulation(load_project_file(path)) {}

Simulation Simulation::from_text(std::string_view text) {
  return Simulation(load_project(text));
}

void Simulation::run_for(std::chrono::nanoseconds duration) noexcept {
  const std::int64_t end = project_.controller->now() + duration.count();
  while (project_.controller->now() < end) step();
}

double read_value_of(const Project& project, std::string_view path) {
  const Operand place = operand_at(project, path);
  if (place.object != nullptr) bring_up_to_date(*place.object);
  const Signal signal = place.signal;
  return as_double(signal.load(), signal.value_type());
}

void write_value_of(Project& project, std::string_view path, double value) {
  const Operand place = operand_at(project, path);
  const WrittenValue written = written_value(place, value);
  if (written.problem == WriteProblem::not_writable) throw std::out_of_range(written.text);
  if (written.problem != WriteProblem::none) throw std::domain_error(std::string(path) + ": " + written.text);
  expect_writes(place);
  place.signal.store(written.value);
}

}  // namespace lockstep
