// What is told of functions, operators, types and conversions is what the compiler does.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>

#include "projects/expressions/functions.hpp"
#include "projects/expressions/habits.hpp"
#include "projects/expressions/language_document.hpp"
#include "projects/expressions/operators.hpp"
#include "projects/expressions/type_table.hpp"
#include "projects/literals/types.hpp"
#include "tests/projects/expression_scope.hpp"

namespace lockstep {
namespace {

double number_of(std::string_view result) {
  if (result == "NaN") return std::numeric_limits<double>::quiet_NaN();
  return (result.front() == '-' ? -1.0 : 1.0) * std::numeric_limits<double>::infinity();
}

/// Runs an example; what it gives otherwise than is told, else nothing.
std::string fault_of(const Example& example) {
  const TestScope scope;
  const std::string text =
      std::string(example.expression) + " as " + std::string(type_name(example.place)) + ": ";
  const CompiledExpression compiled = compile_expression(example.expression, example.place, scope);
  if (example.result == kRefused) return compiled.expression ? text + "is not refused" : "";
  if (!compiled.expression) return text + compiled.errors.front().message;
  EvaluationCounters counters;
  const Value value = compiled.expression->evaluate(counters);
  if ((counters.integer_divisions_by_zero > 0) != example.counted)
    return text + std::to_string(counters.integer_divisions_by_zero) + " divisions by zero are counted";
  Value told{};
  if (example.result == "NaN" || example.result.ends_with("infinity")) {
    told.r = number_of(example.result);
    if (std::isnan(told.r) && std::isnan(value.r)) return "";
  } else {
    const CompiledExpression result = compile_expression(example.result, example.place, scope);
    if (!result.expression) return text + "the result " + result.errors.front().message;
    told = result.expression->evaluate(counters);
  }
  const bool same = is_real(example.place) ? told.r == value.r : told.u == value.u;
  const std::string real = is_real(example.place) ? std::to_string(value.r) : std::to_string(value.i);
  return same ? "" : text + real + " instead of " + std::string(example.result);
}

template <class Told>
std::size_t expect_examples(const Told& told) {
  std::size_t examples = 0;
  for (const Example& example : told.examples)
    if (!example.expression.empty()) {
      EXPECT_EQ(fault_of(example), "");
      ++examples;
    }
  return examples;
}

TEST(LanguageExamples, OfEachFunctionGiveWhatIsTold) {
  for (const StandardFunction& function : standard_functions()) {
    EXPECT_GE(expect_examples(function), 2u) << function.name;
    EXPECT_FALSE(function.meaning.empty() || function.edges.empty()) << function.name;
    for (const Example& example : function.examples) {
      if (example.expression.empty()) continue;
      EXPECT_NE(example.expression.find(std::string(function.name) + "("), std::string::npos)
          << example.expression;
    }
  }
}

TEST(LanguageExamples, OfEachOperatorGiveWhatIsTold) {
  int strength = kStrongest;
  for (const ExpressionOperator& one : expression_operators()) {
    EXPECT_GE(expect_examples(one), 1u) << one.text;
    EXPECT_LE(one.strength, strength) << one.text << " stands behind a weaker one";
    strength = one.strength;
  }
}

TEST(LanguageExamples, OfConversionsGiveWhatIsTold) {
  for (const Example& example : conversion_examples()) EXPECT_EQ(fault_of(example), "");
}

TEST(LanguageExamples, OfTypesAndLiteralsGiveWhatIsTold) {
  std::set<Type> types;
  for (const TypeText& type : elementary_types()) {
    EXPECT_EQ(fault_of(type.literal), "");
    types.insert(type.type);
  }
  EXPECT_EQ(types.size(), static_cast<std::size_t>(Type::TIME) + 1) << "each elementary type is told";
  for (const LiteralForm& form : literal_forms()) EXPECT_EQ(fault_of(form.example), "");
}

TEST(LanguageExamples, OfWhatIsWrittenOtherwiseGiveWhatIsTold) {
  for (const Habit& habit : habits()) {
    if (!habit.example.expression.empty()) {
      EXPECT_EQ(fault_of(habit.example), "") << habit.written;
    }
    EXPECT_EQ(find_function(habit.written), nullptr) << "it is of this language: " << habit.written;
    EXPECT_FALSE(tag_type(habit.written)) << habit.written;
  }
}

TEST(LanguageExamples, StandInTheDocument) {
  const std::string path = LOCKSTEP_SOURCE_DIR "/projects/FUNCTIONS.md";
  if (std::getenv("LOCKSTEP_UPDATE") != nullptr) std::ofstream(path) << functions_document();
  std::ifstream file(path, std::ios::binary);
  const std::string written{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(written == functions_document())
      << "a table has changed: run LOCKSTEP_UPDATE=1 projects_tests --gtest_filter='Language*'";
}

TEST(LanguageExamples, AWrongResultIsFound) {
  EXPECT_NE(fault_of({"7 / 2", Type::INT, "4"}), "");
  EXPECT_NE(fault_of({"7.0 / 0.0", Type::LREAL, "NaN"}), "");
  EXPECT_NE(fault_of({"INT#7 / INT#0", Type::INT, "0"}), "") << "not told as counted";
  EXPECT_NE(fault_of({"7 / 2", Type::INT, kRefused}), "");
  EXPECT_NE(fault_of({"7 / ", Type::INT, "3"}), "");
}

}  // namespace
}  // namespace lockstep
