// Functions, operators, conversions and types of expressions, from the tables by which the compiler works.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "projects/expressions/functions.hpp"
#include "projects/expressions/habits.hpp"
#include "projects/expressions/operators.hpp"
#include "projects/expressions/type_table.hpp"
#include "projects/json/problem.hpp"
#include "projects/literals/types.hpp"

namespace lockstep::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string result_text(const Example& example) {
  return std::string(example.result) + (example.counted ? ", counted as an error" : "");
}

std::string examples_text(std::span<const Example> examples, std::size_t width) {
  Table table({"Example", "In a place of", "Gives"});
  for (const Example& example : examples)
    if (!example.expression.empty())
      table.row(
          {std::string(example.expression), std::string(type_name(example.place)), result_text(example)});
  return table.text(2, width);
}

Json examples_json(std::span<const Example> examples) {
  Json list = Json::array();
  for (const Example& example : examples) {
    if (example.expression.empty()) continue;
    Json json{{"expression", example.expression}, {"place", type_name(example.place)}};
    if (example.result == kRefused)
      json["refused"] = true;
    else
      json["result"] = example.result;
    if (example.counted) json["counted"] = true;
    list.push_back(std::move(json));
  }
  return list;
}

/// What a function and an operator have in common.
template <class Told>
std::string told_text(const std::string& heading, const Told& told, std::size_t width) {
  Table facts({"", ""});
  facts.row({"Takes", std::string(told.takes)});
  facts.row({"Gives", std::string(told.gives)});
  if (!told.edges.empty()) facts.row({"Edges", std::string(told.edges)});
  return heading + "\n" + paragraph(told.meaning, 2, width) + facts.text(2, width) + "\n" +
         examples_text(told.examples, width);
}

template <class Told>
void add_told(Json& json, const Told& told) {
  json["text"] = told.meaning;
  json["takes"] = told.takes;
  json["gives"] = told.gives;
  if (!told.edges.empty()) json["edges"] = told.edges;
  json["examples"] = examples_json(told.examples);
}

Json function_json(const StandardFunction& function) {
  Json json{{"kind", "function"}, {"name", function.name}, {"signature", signature(function)}};
  add_told(json, function);
  return json;
}

Json operator_json(const ExpressionOperator& one) {
  Json json{{"kind", "operator"}, {"name", one.text}, {"operands", one.operands}, {"strength", one.strength}};
  add_told(json, one);
  return json;
}

std::string operator_text(const ExpressionOperator& one, std::size_t width) {
  return told_text(std::string(one.text) + (one.operands == 1 ? " before its operand" : ""), one, width);
}

std::string rules_text(std::size_t width) {
  std::string text;
  for (const std::string_view rule : conversion_rules()) text += paragraph(rule, 2, width);
  return text;
}

std::string functions_text(std::size_t width) {
  Table table({"Function", ""});
  for (const StandardFunction& function : standard_functions())
    table.row({signature(function), std::string(function.meaning)});
  table.row({"TO_type(IN)", "the input as a value of that type; describe TO_INT"});
  table.row({"type_TO_type(IN)", "the same of a value of the first type"});
  return table.text(0, width);
}

Json functions_json() {
  Json json{{"kind", "functions"}};
  auto& list = json["functions"] = Json::array();
  for (const StandardFunction& function : standard_functions()) list.push_back(function_json(function));
  auto& conversions = json["conversions"] = Json::object();
  conversions["rules"] = conversion_rules();
  conversions["examples"] = examples_json(conversion_examples());
  return json;
}

std::string operators_text(std::size_t width) {
  Table table({"Operator", "Strength", ""});
  for (const ExpressionOperator& one : expression_operators())
    table.row({std::string(one.text) + (one.operands == 1 ? " a" : ""), std::to_string(one.strength),
               std::string(one.meaning)});
  return table.text(0, width);
}

Json operators_json(std::string_view text) {
  Json list = Json::array();
  for (const ExpressionOperator& one : expression_operators())
    if (text.empty() || same_name(one.text, text)) list.push_back(operator_json(one));
  return {{"kind", "operators"}, {"operators", list}};
}

Json names_json(std::span<const Type> types) {
  Json list = Json::array();
  for (const Type type : types) list.push_back(type_name(type));
  return list;
}

Json type_json(const TypeText& type) {
  return {{"kind", "type"},
          {"name", type_name(type.type)},
          {"text", type.meaning},
          {"range", range_of_type(type.type)},
          {"literal", type.literal.expression},
          {"widens_to", names_json(wider_types(type.type))},
          {"converts_to", names_json(conversions_of(type.type))}};
}

std::string types_text(std::size_t width) {
  Table types({"Type", ""});
  for (const TypeText& type : elementary_types())
    types.row({std::string(type_name(type.type)), std::string(type.meaning)});
  for (const OtherType& type : other_types()) types.row({std::string(type.name), std::string(type.meaning)});
  Table forms({"Literal", ""});
  for (const LiteralForm& form : literal_forms())
    forms.row({std::string(form.form), std::string(form.meaning)});
  return types.text(0, width) + "\n" + forms.text(0, width);
}

Json types_json() {
  Json json{{"kind", "types"}};
  auto& list = json["types"] = Json::array();
  for (const TypeText& type : elementary_types()) list.push_back(type_json(type));
  auto& others = json["others"] = Json::array();
  for (const OtherType& type : other_types()) others.push_back({{"name", type.name}, {"text", type.meaning}});
  auto& literals = json["literals"] = Json::array();
  for (const LiteralForm& form : literal_forms())
    literals.push_back({{"form", form.form}, {"text", form.meaning}, {"example", form.example.expression}});
  return json;
}

std::string type_text(const TypeText& type, std::size_t width) {
  Table facts({"", ""});
  facts.row({"Range", range_of_type(type.type)});
  facts.row({"Literal", std::string(type.literal.expression)});
  facts.row({"Widens to", names_of(wider_types(type.type))});
  facts.row({"TO_type", names_of(conversions_of(type.type))});
  return std::string(type_name(type.type)) + "\n" + paragraph(type.meaning, 2, width) + facts.text(2, width);
}

Subject type_subject(std::string_view word) {
  for (const TypeText& type : elementary_types())
    if (same_name(type_name(type.type), word))
      return {[&type](std::size_t width) { return type_text(type, width); },
              [&type] { return type_json(type); }};
  return {};
}

/// A type that is made from others, by its name as it is written or by the word with which that begins.
Subject made_type_subject(std::string_view word) {
  for (const OtherType& type : other_types()) {
    const auto bracket = type.name.find('[');
    const std::string_view own = type.name.substr(0, bracket);
    if (bracket == type.name.npos || !same_name(own, word.substr(0, word.find('[')))) continue;
    return {[&type](std::size_t width) {
              return std::string(type.name) + "\n" + paragraph(type.meaning, 2, width);
            },
            [&type] {
              return Json{{"kind", "type"}, {"name", type.name}, {"text", type.meaning}};
            }};
  }
  return {};
}

/// A conversion: those of the examples that show it, and the rules of all.
Subject conversion_subject(std::string_view word) {
  const std::string name = upper_case(word);
  const auto found = conversion_named(name);
  if (!found || (found->from && !convertible(*found->from, found->to))) return {};
  const auto shown = [found] {
    std::vector<Example> examples;
    for (const Example& example : conversion_examples())
      if (example.place == found->to) examples.push_back(example);
    return examples;
  };
  const std::string from = found->from ? std::string(type_name(*found->from)) : "any type that allows it";
  const std::string meaning = "a value of " + from + " as one of " + std::string(type_name(found->to));
  return {[=](std::size_t width) {
            return name + "(IN)\n" + paragraph(meaning, 2, width) + "\n" + rules_text(width) + "\n" +
                   examples_text(shown(), width);
          },
          [=] {
            return Json{{"kind", "conversion"},
                        {"name", name},
                        {"text", meaning},
                        {"rules", conversion_rules()},
                        {"examples", examples_json(shown())}};
          }};
}

Subject operator_subject(std::string_view word) {
  const auto is_it = [word](const ExpressionOperator& one) { return same_name(one.text, word); };
  if (!std::ranges::any_of(expression_operators(), is_it)) return {};
  const std::string name(word);
  return {[name](std::size_t width) {
            std::string text;
            for (const ExpressionOperator& one : expression_operators())
              if (same_name(one.text, name)) text += (text.empty() ? "" : "\n") + operator_text(one, width);
            return text;
          },
          [name] { return operators_json(name); }};
}

}  // namespace

Subject functions_subject() {
  return {&functions_text, &functions_json};
}

Subject operators_subject() {
  return {&operators_text, [] { return operators_json(""); }};
}

Subject types_subject() {
  return {&types_text, &types_json};
}

Subject language_subject(std::string_view word) {
  if (const StandardFunction* const found = find_function(upper_case(word)))
    return {[found](std::size_t width) { return told_text(signature(*found), *found, width); },
            [found] { return function_json(*found); }};
  if (Subject subject = type_subject(word)) return subject;
  if (Subject subject = made_type_subject(word)) return subject;
  if (Subject subject = operator_subject(word)) return subject;
  return conversion_subject(word);
}

Subject habit_subject(std::string_view word) {
  const Habit* const habit = habit_of(upper_case(word));
  if (habit == nullptr) return {};
  return {
      [habit](std::size_t width) {
        return std::string(habit->written) + "\n" +
               paragraph("not of this language; here: " + std::string(habit->here), 2, width) + "\n" +
               (habit->example.expression.empty() ? "" : examples_text(std::span(&habit->example, 1), width));
      },
      [habit] {
        Json json{{"kind", "written otherwise"}, {"name", habit->written}, {"text", habit->here}};
        json["examples"] = examples_json(std::span(&habit->example, 1));
        return json;
      }};
}

std::vector<std::string_view> language_names() {
  std::vector<std::string_view> names;
  for (const StandardFunction& function : standard_functions()) names.push_back(function.name);
  for (const ExpressionOperator& one : expression_operators()) names.push_back(one.text);
  for (const TypeText& type : elementary_types()) names.push_back(type_name(type.type));
  for (const OtherType& type : other_types())
    if (const auto bracket = type.name.find('['); bracket != type.name.npos)
      names.push_back(type.name.substr(0, bracket));
  return names;
}

}  // namespace lockstep::cli
