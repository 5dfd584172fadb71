#include "scheduler/mco305/program_values.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {
namespace {

Value zero(const Variable&, std::size_t) {
  return {.i = 0};
}

}  // namespace

void ProgramValues::add(std::string path, void* address, std::size_t count, const char* text) {
  all_.push_back({{.path = names_.emplace_back(std::move(path)),
                   .type = Type::DINT,
                   .offset = 0,
                   .count = count,
                   .stride = count > 0 ? sizeof(DINT) : 0,
                   .effect = Effect::RON,
                   .computed = true,
                   .unit = Unit::kNone,
                   .range = kAny,
                   .text = text,
                   .start = &zero},
                  address});
}

/// A device knows its arrays by their order; a name that programs have given to the same one stands for it.
/// Behind an array whose programs do not agree on its size nothing has a place that stays.
void ProgramValues::add_arrays(std::span<const aposs::Image* const> programs, aposs::Arrays& arrays) {
  std::size_t first = 0;
  for (std::size_t i = 0;; ++i) {
    std::uint32_t size = 0;
    for (const aposs::Image* const program : programs) {
      if (i >= program->arrays.size()) continue;
      if (size != 0 && program->arrays[i].size != size) return;
      size = program->arrays[i].size;
    }
    if (size == 0 || first + size > arrays.memory().size()) return;
    for (const aposs::Image* const program : programs) {
      if (i >= program->arrays.size()) continue;
      std::string path = "Arr." + program->arrays[i].name + "[]";
      if (std::find(names_.begin(), names_.end(), path) == names_.end())
        add(std::move(path), &arrays.memory()[first], size, "array of its programs");
    }
    first += size;
  }
}

void ProgramValues::declare(std::span<const aposs::Image* const> programs, aposs::Machine& machine,
                            aposs::Arrays& arrays) {
  std::size_t cells = 0;
  for (const aposs::Image* const program : programs) {
    cells = std::max(cells, program->cells());
    arrays.reserve(program->arrays);
  }
  machine.reserve(cells);
  if (programs.empty()) return;
  const std::vector<std::string>& variables = programs.front()->variables;
  for (const aposs::Image* const program : programs)
    if (program->variables != variables) return;
  for (std::size_t i = 0; i < variables.size(); ++i)
    add("Var." + variables[i], machine.variable_address(i), 0,
        "variable of its programs; 0 where they have it not");
  add_arrays(programs, arrays);
}

}  // namespace lockstep
