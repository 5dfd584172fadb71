/// Paths of a project, read and written from Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hmi_bridge/traces/columns.hpp"
#include "projects/expressions/element_path.hpp"
#include "projects/loader/project.hpp"

namespace lockstep::python {

/// What a path leads to: one value, a text, or several elements of an array.
using Place = std::variant<Operand, const StringTag*, ElementPath>;

/// @throws lockstep.PathError (a KeyError) with what is wrong with the path, and what is allowed
Place find_place(const Project& project, std::string_view path);

/// The value there; of several elements, a list of their values.
pybind11::object read_place(const Place& place);

/// What a place shall have: a text, or as many values as it has elements.
using NewValues = std::variant<std::vector<Value>, std::string>;

/// Converts what a tag, a text, elements, or a variable that a program may set shall have; all of it before
/// any is written. Python runs meanwhile, such as `__index__` of the object or another thread, and may close
/// the project: look again whether it is there before `store`.
/// @throws lockstep.ReadOnly, lockstep.OutOfRange, TypeError; ValueError for another number of elements
NewValues values_for(const Place& place, pybind11::handle object, std::string_view path);
/// Writes them; nothing of Python runs. The project of the place has to be there.
void store(const Place& place, const NewValues& values);

/// Why nobody may write there; empty if one may.
std::string why_read_only(const Place& place);
/// Name of the type: "LREAL", "STRING[20]", "ARRAY[1..4] OF LREAL".
std::string type_of_place(const Place& place);
/// Its unit as the project has it, such as "mm/s"; empty for none.
std::string unit_of_place(const Place& place);

/// What a trace records under these names, each once.
/// @throws lockstep.PathError for a path that leads nowhere, or to what a trace cannot record
std::vector<NamedSignal> signals_of(const Project& project, const std::vector<std::string>& paths);

/// Every path there is without an index of one's own: tags, pins of instances, variables of objects.
std::vector<std::string> all_paths(const Project& project);

/// The value of an expression in Structured Text, as it stands now.
/// @throws lockstep.ExpressionError with what is wrong, and where in the text
pybind11::object evaluate(const Project& project, std::string_view text);

/// Compiles a condition.
/// @throws lockstep.ExpressionError
Expression compile_condition(const Project& project, std::string_view text);

}  // namespace lockstep::python
