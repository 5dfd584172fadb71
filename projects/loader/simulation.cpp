#include "projects/loader/simulation.hpp"

#include <cmath>

#include "projects/loader/mco305_panel.hpp"

namespace lockstep {
namespace {

Project valid(LoadedProject loaded) {
  if (loaded.project) return std::move(*loaded.project);
  std::string text = "the project is not valid";
  for (const Problem& problem : loaded.problems) text += "\n" + problem.place + ": " + problem.text;
  throw InvalidProject(text);
}

/// The value as its type holds it; throws if it does not.
Value converted(double value, Type type) {
  Value result{};
  if (is_real(type)) {
    result.r = value;
    if (std::isfinite(value)) return result;
  } else if (type == Type::TIME) {
    const double nanoseconds = std::round(value * 1e9);
    result.i = static_cast<std::int64_t>(nanoseconds);
    if (std::abs(nanoseconds) < 9.2e18) return result;
  } else if (value == std::floor(value) && value >= static_cast<double>(lowest(type)) &&
             value <= static_cast<double>(highest(type)) && std::abs(value) <= 9007199254740992.0) {
    result.i = static_cast<std::int64_t>(value);
    return result;
  }
  throw std::domain_error(std::to_string(value) + " does not fit a value of type " +
                          std::string(type_name(type)));
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
  const Signal signal = operand_at(project, path).signal;
  return as_double(signal.load(), signal.value_type());
}

void write_value_of(Project& project, std::string_view path, double value) {
  const Operand place = operand_at(project, path);
  if (const std::string reason = why_not_writable(place); !reason.empty()) throw std::out_of_range(reason);
  if (place.variable != nullptr && !place.variable->range.allows(value))
    throw std::domain_error(std::string(path) + " may not be " + std::to_string(value));
  expect_writes(place);
  place.signal.store(converted(value, place.signal.value_type()));
}

}  // namespace lockstep
