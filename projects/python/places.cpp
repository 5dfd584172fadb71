#include "projects/python/places.hpp"

#include <fmt/format.h>

#include <unordered_set>
#include <utility>

#include "projects/expressions/own_variables.hpp"
#include "projects/json/problem.hpp"
#include "projects/loader/mco305_panel.hpp"
#include "projects/python/raise.hpp"
#include "projects/python/values.hpp"
#include "tech_objects/data_blocks/variable.hpp"

namespace py = pybind11;

namespace lockstep::python {
namespace {

template <class... Cases>
struct Each : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Each(Cases...) -> Each<Cases...>;

std::string unit_of(const Operand& place) {
  return lockstep::unit_of(NamedSignal{"", place.signal, place.unit, place.object, place.instance});
}

const Range& range_of(const Operand& place) {
  return place.variable != nullptr ? place.variable->range : kAny;
}

/// Of what Python calls meanwhile nothing is there but the object: the sequence may close the project.
std::vector<Value> elements_from(py::handle object, const ElementPath& elements, const Range& range,
                                 std::string_view path) {
  const bool is_text = py::isinstance<py::str>(object) || py::isinstance<py::bytes>(object);
  if (is_text || PySequence_Check(object.ptr()) == 0)
    throw py::type_error(fmt::format("{} is of type {}; allowed: a sequence of {} values", path,
                                     elements.type, elements.count()));
  const auto sequence = py::reinterpret_borrow<py::sequence>(object);
  if (const std::size_t size = sequence.size(); size != elements.count())
    throw py::value_error(fmt::format("{} has {} elements, not {}", path, elements.count(), size));
  std::vector<Value> values;
  for (std::int64_t index = elements.first; index <= elements.last; ++index)
    values.push_back(from_python(sequence[static_cast<std::size_t>(index - elements.first)],
                                 elements.place.signal.value_type(), range, elements.name_of(index)));
  return values;
}

/// All are read before the list is made: making it may call what closes the project.
py::list read_elements(const ElementPath& elements) {
  std::vector<Value> read;
  for (std::int64_t index = elements.first; index <= elements.last; ++index)
    read.push_back(elements.signal_of(index).load());
  const Type type = elements.place.signal.value_type();
  py::list values;
  for (const Value value : read) values.append(to_python(value, type));
  return values;
}

std::string problems_of(const std::vector<ExpressionError>& errors, std::string_view text) {
  std::string problems;
  for (const ExpressionError& error : errors)
    problems += fmt::format("{}{}, column {}: {}", problems.empty() ? "" : "\n", quote(text), error.column,
                            error.message);
  return problems;
}

}  // namespace

Place find_place(const Project& project, std::string_view path) {
  if (const StringTag* const text = project.names.find_string(path)) return text;
  FoundElements several = find_several(project.names, path);
  if (several.elements && several.elements->place.signal.type < Type::AXIS)
    return std::move(*several.elements);
  if (!several.problem.empty()) raise("PathError", several.problem);
  const FoundOperand found = project.names.find(path);
  if (!found.place) raise("PathError", found.problem);
  if (found.place->signal.type >= Type::AXIS)
    raise("PathError", fmt::format("'{}' stands for an object, a tag or an array and has no value", path));
  return *found.place;
}

py::object read_place(const Place& place) {
  return std::visit(Each{[](const Operand& value) {
                           if (value.object != nullptr) bring_up_to_date(*value.object);
                           return to_python(value.signal.load(), value.signal.value_type());
                         },
                         [](const StringTag* text) -> py::object { return text_to_python(text->text); },
                         [](const ElementPath& elements) -> py::object { return read_elements(elements); }},
                    place);
}

NewValues values_for(const Place& place, py::handle object, std::string_view path) {
  if (const std::string reason = why_read_only(place); !reason.empty())
    raise("ReadOnly", fmt::format("'{}' cannot be written: {}", path, reason));
  // From here on Python runs; what is in the project is copied before.
  return std::visit(Each{[&](const Operand& value) -> NewValues {
                           const Range range = range_of(value);
                           return std::vector{from_python(object, value.signal.value_type(), range, path)};
                         },
                         [&](const StringTag* text) -> NewValues {
                           return text_from_python(object, text->text.capacity, path);
                         },
                         [&](const ElementPath& elements) -> NewValues {
                           const Range range = range_of(elements.place);
                           return elements_from(object, elements, range, path);
                         }},
                    place);
}

void store(const Place& place, const NewValues& values) {
  std::visit(Each{[&](const Operand& value) {
                    expect_writes(value);
                    value.signal.store(std::get<std::vector<Value>>(values).front());
                  },
                  [&](const StringTag* text) { text->text.assign(std::get<std::string>(values)); },
                  [&](const ElementPath& elements) {
                    const auto& all = std::get<std::vector<Value>>(values);
                    for (std::size_t k = 0; k < all.size(); ++k)
                      elements.signal_of(elements.first + static_cast<std::int64_t>(k)).store(all[k]);
                  }},
             place);
}

std::string why_read_only(const Place& place) {
  return std::visit(Each{[](const Operand& value) { return why_not_writable(value); },
                         [](const StringTag*) { return std::string(); },
                         [](const ElementPath& elements) { return why_not_writable(elements.place); }},
                    place);
}

std::string type_of_place(const Place& place) {
  return std::visit(
      Each{[](const Operand& value) { return std::string(type_name(value.signal.value_type())); },
           [](const StringTag* text) { return text_type_name(text->text.capacity); },
           [](const ElementPath& elements) { return elements.type; }},
      place);
}

std::string unit_of_place(const Place& place) {
  return std::visit(Each{[](const Operand& value) { return unit_of(value); },
                         [](const StringTag*) { return std::string(); },
                         [](const ElementPath& elements) { return unit_of(elements.place); }},
                    place);
}

std::vector<NamedSignal> signals_of(const Project& project, const std::vector<std::string>& paths) {
  std::vector<NamedSignal> signals;
  std::unordered_set<std::string> seen;
  for (const std::string& path : paths) {
    const Place place = find_place(project, path);
    const Operand* const value = std::get_if<Operand>(&place);
    if (value == nullptr)
      raise("PathError",
            fmt::format("'{}' is of type {}, which a trace does not record; allowed: single numbers, "
                        "bits and durations",
                        path, type_of_place(place)));
    if (seen.insert(path).second)
      signals.push_back({path, value->signal, value->unit, value->object, value->instance});
  }
  return signals;
}

std::vector<std::string> all_paths(const Project& project) {
  const Controller& controller = *project.controller;
  std::vector<std::string> paths;
  for (const Tag& tag : controller.tags) paths.push_back(tag.name);
  for (const ArrayTag& tag : controller.arrays) paths.push_back(tag.name);
  for (const StringTag& tag : controller.strings) paths.push_back(tag.name);
  for (const Instance& instance : controller.instances) {
    if (project.names.find_entity(instance.name) == nullptr) continue;  // no path leads to it
    for (const Pin& pin : instance.type->pins)
      if (pin.type < Type::AXIS) paths.push_back(instance.name + "." + std::string(pin.name));
  }
  for (const auto& object : controller.objects)
    for (const auto list : data_block_of(object->kind).lists())
      for (const Variable& variable : list)
        if (variable.count == 0 && variable.type < Type::AXIS)
          paths.push_back(object->name + "." + std::string(variable.path));
  return paths;
}

py::object evaluate(const Project& project, std::string_view text) {
  // What an expression is of nobody has said: the first type that takes it, whole numbers before others.
  for (const Type type : {Type::LINT, Type::ULINT, Type::BOOL, Type::TIME, Type::LWORD}) {
    const CompiledExpression compiled = compile_expression(text, type, project.names);
    EvaluationCounters counters;
    if (compiled.errors.empty()) return to_python(compiled.expression->evaluate(counters), type);
  }
  const CompiledExpression compiled = compile_expression(text, Type::LREAL, project.names);
  if (!compiled.errors.empty()) raise("ExpressionError", problems_of(compiled.errors, text));
  EvaluationCounters counters;
  return to_python(compiled.expression->evaluate(counters), Type::LREAL);
}

Expression compile_condition(const Project& project, std::string_view text) {
  CompiledExpression compiled = compile_expression(text, Type::BOOL, project.names);
  if (!compiled.errors.empty()) raise("ExpressionError", problems_of(compiled.errors, text));
  return std::move(*compiled.expression);
}

}  // namespace lockstep::python
