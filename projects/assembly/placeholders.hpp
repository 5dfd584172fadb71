/// What stands between ${ and } in the texts of a template: a parameter, or an expression of parameters.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "projects/json/document.hpp"

namespace lockstep {

/// The parameters of an instance by their names in lower case.
using TemplateParameters = std::map<std::string, const JsonValue*, std::less<>>;

/// Puts the values of parameters into a text, or into what is only a placeholder: then it becomes a number or
/// a truth value as its parameter is one. "$$" stays as it is, so that 'it$$' of an expression is none.
/// @param value a string; otherwise it stays as it is
/// @return what is wrong, and what is allowed; empty: nothing
std::string fill_placeholders(JsonValue& value, const TemplateParameters& parameters);

/// A text, such as a key, with the values of parameters in place of what stands for them.
/// @param problem what is wrong; empty: nothing
std::string filled_text(std::string_view text, const TemplateParameters& parameters, std::string& problem);

}  // namespace lockstep
