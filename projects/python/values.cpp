#include "projects/python/values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "projects/python/raise.hpp"

namespace py = pybind11;

namespace lockstep::python {
namespace {

std::string repr_of(py::handle object) {
  const std::string text = py::repr(object);
  if (text.size() <= 60) return text;
  std::size_t end = 57;
  while ((static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // a character stays whole
  return text.substr(0, end) + "…";
}

[[noreturn]] void wrong_type(py::handle object, std::string_view path, std::string_view type,
                             std::string_view allowed) {
  throw py::type_error(
      fmt::format("{} is of type {}: {} of type {} does not fit; allowed: {}", path, type, repr_of(object),
                  py::str(py::type::of(object).attr("__name__")).cast<std::string>(), allowed));
}

[[noreturn]] void outside(std::string_view path, py::handle object, std::string_view allowed) {
  raise("OutOfRange", fmt::format("{} may not be {}; allowed: {}", path, repr_of(object), allowed));
}

std::string range_text(const Range& range) {
  std::string text;
  if (std::isfinite(range.lowest) && std::abs(range.lowest) < 1e300)
    text = fmt::format("from {}", range.lowest);
  if (std::isfinite(range.highest) && range.highest < 1e300)
    text += fmt::format("{}to {}", text.empty() ? "" : " ", range.highest);
  if (range.lowest > 0.0 && range.lowest < 1e-300)
    text = "above 0" + text.substr(std::min(text.find(" to"), text.size()));
  if (!std::isnan(range.excluded)) text += fmt::format("{}not {}", text.empty() ? "" : ", ", range.excluded);
  return text.empty() ? "a finite number" : text;
}

/// A number that is none of bool; a NumPy scalar is one too.
bool is_number(py::handle object) {
  return PyBool_Check(object.ptr()) == 0 && PyNumber_Check(object.ptr()) != 0 &&
         !py::isinstance<py::str>(object) &&
         (py::isinstance<py::float_>(object) || PyIndex_Check(object.ptr()) != 0 ||
          py::hasattr(object, "__float__"));
}

double number_from(py::handle object, std::string_view path, Type type) {
  if (!is_number(object)) wrong_type(object, path, type_name(type), "a number");
  const double number = PyFloat_AsDouble(object.ptr());
  if (PyErr_Occurred() != nullptr) {
    if (PyErr_ExceptionMatches(PyExc_OverflowError) == 0) throw py::error_already_set();
    PyErr_Clear();
    outside(path, object, "a finite number");
  }
  return number;
}

Value bool_from(py::handle object, std::string_view path) {
  static const char* const kNumPyBool = "bool_";
  const bool is_bool = PyBool_Check(object.ptr()) != 0 ||
                       py::str(py::type::of(object).attr("__name__")).cast<std::string>() == kNumPyBool;
  if (!is_bool) wrong_type(object, path, "BOOL", "True, False");
  Value value{};
  const int is_true = PyObject_IsTrue(object.ptr());
  if (is_true < 0) throw py::error_already_set();
  value.u = is_true == 1 ? 1 : 0;
  return value;
}

Value real_from(py::handle object, Type type, std::string_view path, const Range& range) {
  Value value{};
  value.r = number_from(object, path, type);
  if (type == Type::REAL) value.r = static_cast<double>(static_cast<float>(value.r));
  if (!std::isfinite(value.r) || !range.allows(value.r)) outside(path, object, range_text(range));
  return value;
}

Value time_from(py::handle object, std::string_view path) {
  const py::object type = py::module_::import("datetime").attr("timedelta");
  const py::object seconds = py::isinstance(object, type) ? object.attr("total_seconds")()
                                                          : py::reinterpret_borrow<py::object>(object);
  const double nanoseconds = std::round(number_from(seconds, path, Type::TIME) * 1e9);
  if (!(std::abs(nanoseconds) < 9.2e18)) outside(path, object, "-9.2e9 to 9.2e9 seconds");
  Value value{};
  value.i = static_cast<std::int64_t>(nanoseconds);
  return value;
}

Value integer_from(py::handle object, Type type, std::string_view path, const Range& range) {
  if (PyBool_Check(object.ptr()) != 0 || PyIndex_Check(object.ptr()) == 0)
    wrong_type(object, path, type_name(type), "a whole number (int)");
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
  if (!whole) throw py::error_already_set();
  const py::int_ lowest_value(lowest(type));
  const py::int_ highest_value(highest(type));
  if (whole < lowest_value || whole > highest_value)
    outside(path, object, fmt::format("{} to {}", lowest(type), highest(type)));
  Value value{};
  if (lowest(type) < 0)
    value.i = whole.cast<std::int64_t>();
  else
    value.u = whole.cast<std::uint64_t>();
  if (!range.allows(as_double(value, type))) outside(path, object, range_text(range));
  return value;
}

/// What the loader takes of a text as well.
bool is_printable(unsigned char c) {
  return (c >= 0x20 && c < 0x7f) || c >= 0xa0;
}

}  // namespace

py::object to_python(Value value, Type type) {
  if (type == Type::BOOL) return py::bool_(value.u != 0);
  if (is_real(type)) return py::float_(value.r);
  if (type == Type::TIME) return py::float_(as_double(value, type));
  if (is_signed_integer(type)) return py::int_(value.i);
  return py::int_(value.u);
}

Value from_python(py::handle object, Type type, const Range& range, std::string_view path) {
  if (type == Type::BOOL) return bool_from(object, path);
  if (is_real(type)) return real_from(object, type, path, range);
  if (type == Type::TIME) return time_from(object, path);
  return integer_from(object, type, path, range);
}

py::str text_to_python(const Text& text) {
  const std::string_view view = text.view();
  const auto decoded = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeLatin1(view.data(), static_cast<Py_ssize_t>(view.size()), nullptr));
  if (!decoded) throw py::error_already_set();
  return py::str(decoded);
}

std::string text_from_python(py::handle object, std::size_t capacity, std::string_view path) {
  const std::string type = text_type_name(capacity);
  if (!py::isinstance<py::str>(object)) wrong_type(object, path, type, "a str");
  const auto encoded = py::reinterpret_steal<py::object>(PyUnicode_AsLatin1String(object.ptr()));
  if (!encoded) PyErr_Clear();
  const std::string text = encoded ? encoded.cast<std::string>() : "\n";
  for (const char c : text)
    if (!is_printable(static_cast<unsigned char>(c)))
      outside(path, object, "printable characters of ISO 8859-1");
  if (text.size() > capacity) outside(path, object, fmt::format("up to {} characters ({})", capacity, type));
  return text;
}

}  // namespace lockstep::python
