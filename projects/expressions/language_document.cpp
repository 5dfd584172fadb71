#include "projects/expressions/language_document.hpp"

#include <algorithm>
#include <span>

#include "projects/expressions/functions.hpp"
#include "projects/expressions/habits.hpp"
#include "projects/expressions/operators.hpp"
#include "projects/expressions/type_table.hpp"

namespace lockstep {
namespace {

/// A cell of a table: bars would end it.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string code(std::string_view text) {
  return "`" + std::string(text) + "`";
}

std::string result_text(const Example& example) {
  if (example.result == kRefused) return "refused";
  return code(example.result) + (example.counted ? ", counted" : "");
}

std::string examples_table(std::span<const Example> examples) {
  std::string text = "\n| example | in a place of | gives |\n|---|---|---|\n";
  for (const Example& example : examples)
    if (!example.expression.empty())
      text += "| " + code(cell(example.expression)) + " | " + std::string(type_name(example.place)) + " | " +
              result_text(example) + " |\n";
  return text;
}

std::string sentence(std::string_view begin, std::string_view text) {
  return text.empty() ? "" : std::string(begin) + std::string(text) + ".\n";
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

template <class Told>
std::string told(const std::string& heading, const Told& what) {
  return "\n### " + heading + "\n\n" + capital(sentence("", what.meaning)) + sentence("Takes ", what.takes) +
         sentence("Type of the result: ", what.gives) + sentence("At the edges: ", what.edges) +
         examples_table(what.examples);
}

std::string operators_chapter() {
  std::string text =
      "\n## Operators\n\n"
      "The strongest first; of equal ones the left one binds first. Brackets `( )`, calls, indices and `.Xn` "
      "bind stronger than all. Words are written in any case.\n\n"
      "| strength | operator | meaning |\n|---|---|---|\n";
  for (const ExpressionOperator& one : expression_operators())
    text += "| " + std::to_string(one.strength) + " | " + code(cell(one.text)) +
            (one.operands == 1 ? " before its operand" : "") + " | " + cell(one.meaning) + " |\n";
  for (const ExpressionOperator& one : expression_operators())
    text += told("Operator " + code(one.text) + (one.operands == 1 ? " before its operand" : ""), one);
  return text;
}

std::string functions_chapter() {
  std::string text =
      "\n## Functions\n\n"
      "Inputs are given in their order, `LIMIT(0, x, 10)`, or all by name, `LIMIT(MN := 0, IN := x, MX := "
      "10)`. Names of functions and inputs are written in any case. " +
      std::string("A function with … takes up to ") + std::to_string(kMaximumInputs) +
      " inputs.\n\n| function | meaning |\n|---|---|\n";
  for (const StandardFunction& one : standard_functions())
    text +=
        "| [" + code(signature(one)) + "](#" + std::string(one.name) + ") | " + cell(one.meaning) + " |\n";
  for (const StandardFunction& one : standard_functions()) text += told(std::string(one.name), one);
  // The heading is the anchor, in small letters.
  for (std::size_t at = 0; (at = text.find("](#", at)) != text.npos; ++at)
    for (std::size_t i = at + 3; text[i] != ')'; ++i)
      if (text[i] >= 'A' && text[i] <= 'Z') text[i] = static_cast<char>(text[i] - 'A' + 'a');
  return text;
}

std::string conversions_chapter() {
  std::string text =
      "\n## Conversions\n\n"
      "`TO_type(value)` converts a value of any type that allows it, `type_TO_type(value)` of one type. "
      "Without being asked a value only widens.\n\n"
      "| type | widens to | TO_type also makes it |\n|---|---|---|\n";
  for (const TypeText& type : elementary_types()) {
    const std::string wider = names_of(wider_types(type.type));
    text += "| " + std::string(type_name(type.type)) + " | " + (wider.empty() ? "–" : wider) + " | ";
    std::vector<Type> others = conversions_of(type.type);
    std::erase_if(others, [&](Type other) {
      const std::vector<Type> all = wider_types(type.type);
      return std::find(all.begin(), all.end(), other) != all.end();
    });
    text += names_of(others) + " |\n";
  }
  text += "\n";
  for (const std::string_view rule : conversion_rules()) text += "- " + std::string(rule) + ";\n";
  text.replace(text.size() - 2, 2, ".\n");
  return text + examples_table(conversion_examples());
}

std::string types_chapter() {
  std::string text = "\n## Types\n\n| type | range | meaning | example |\n|---|---|---|---|\n";
  for (const TypeText& type : elementary_types())
    text += "| " + std::string(type_name(type.type)) + " | " + range_of_type(type.type) + " | " +
            cell(type.meaning) + " | " + code(type.literal.expression) + " |\n";
  text += "\n| other | meaning |\n|---|---|\n";
  for (const OtherType& type : other_types())
    text += "| " + code(type.name) + " | " + cell(type.meaning) + " |\n";
  return text;
}

std::string literals_chapter() {
  std::string text =
      "\n## Literals\n\n"
      "A literal, and an operation on nothing but literals, takes the type that its place asks for, if it "
      "fits: `300` is an INT in a place of INT and refused in one of USINT. Integer literals are computed "
      "exactly before they take a type. Single underscores may stand between digits.\n\n"
      "| form | is | example |\n|---|---|---|\n";
  for (const LiteralForm& form : literal_forms())
    text +=
        "| " + code(form.form) + " | " + cell(form.meaning) + " | " + code(form.example.expression) + " |\n";
  return text;
}

std::string habits_chapter() {
  std::string text =
      "\n## Written otherwise\n\n"
      "What S7-SCL and other languages write, and what is written here in its place; the message of an "
      "expression with it says the same.\n\n"
      "| elsewhere | here | example |\n|---|---|---|\n";
  for (const Habit& habit : habits())
    text += "| " + code(cell(habit.written)) + " | " + cell(habit.here) + " | " +
            (habit.example.expression.empty()
                 ? ""
                 : code(cell(habit.example.expression)) + " gives " + result_text(habit.example)) +
            " |\n";
  return text;
}

}  // namespace

std::string functions_document() {
  return "# Types, literals, operators and functions\n\n"
         "What an expression of a project file is made of: Structured Text of IEC 61131-3. This file is made "
         "from the tables by which the compiler works (`projects/expressions`), and each example is run by a "
         "test;\n`LOCKSTEP_UPDATE=1 projects_tests --gtest_filter='Language*'` renews it. `lockstep describe "
         "functions`, `operators` and `types` show the same, `lockstep describe SEL` one of them. "
         "[LANGUAGE.md](LANGUAGE.md) says where expressions stand and when they are evaluated.\n" +
         types_chapter() + literals_chapter() + operators_chapter() + functions_chapter() +
         conversions_chapter() + habits_chapter();
}

}  // namespace lockstep
