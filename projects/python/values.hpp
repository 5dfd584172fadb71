/// Values of the project as Python has them, and back.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

#include "scheduler/text.hpp"
#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep::python {

/// BOOL as bool; integers, bit strings and DB_ANY as int; REAL and LREAL as float; TIME as float [s].
pybind11::object to_python(Value value, Type type);

/// The value as its type holds it. BOOL takes bool (or a NumPy bool), integers and bit strings what is whole
/// (not bool), REAL and LREAL any number (not bool), TIME a number [s] or a `datetime.timedelta`.
/// @param path of the place, for messages
/// @throws TypeError for another type, lockstep.OutOfRange (a ValueError) for what the type or `range` has
/// not
Value from_python(pybind11::handle object, Type type, const Range& range, std::string_view path);

/// A text of ISO 8859-1 as str, and back.
pybind11::str text_to_python(const Text& text);
/// @throws TypeError for what is no str, lockstep.OutOfRange for one that is too long, or with characters
///   that are not printable ones of ISO 8859-1
std::string text_from_python(pybind11::handle object, std::size_t capacity, std::string_view path);

}  // namespace lockstep::python
