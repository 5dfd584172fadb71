// Every function with every type of every input: a value, or an error with its place, and never anything
// else.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/projects/expression_scope.hpp"

namespace lockstep::expression_functions_test {
namespace {

using ExpressionFunctions = ExpressionTest;

/// A tag of each type, and literals of each kind.
const std::vector<std::string> kInputs = {
    "flag",  "sint",   "int_",    "dint",   "lint",   "usint",   "uint_",     "udint", "ulint", "byte_",
    "word",  "dword",  "lword",   "real",   "lreal",  "time",    "3",         "-3",    "2.5",   "TRUE",
    "INT#5", "UINT#5", "USINT#5", "LINT#5", "REAL#5", "LREAL#5", "BYTE#16#5", "T#5ms", "'text'"};

struct Function {
  const char* name;
  std::size_t inputs;
};
constexpr Function kFunctions[] = {
    {"ABS", 1},     {"SQRT", 1},        {"LN", 1},         {"LOG", 1},      {"EXP", 1},     {"SIN", 1},
    {"COS", 1},     {"TAN", 1},         {"ASIN", 1},       {"ACOS", 1},     {"ATAN", 1},    {"ATAN2", 2},
    {"EXPT", 2},    {"MIN", 2},         {"MAX", 2},        {"LIMIT", 3},    {"SEL", 3},     {"MUX", 3},
    {"TRUNC", 1},   {"ROUND", 1},       {"CEIL", 1},       {"FLOOR", 1},    {"SHL", 2},     {"SHR", 2},
    {"ROL", 2},     {"ROR", 2},         {"ADD", 2},        {"MUL", 2},      {"SUB", 2},     {"DIV", 2},
    {"GT", 2},      {"GE", 2},          {"EQ", 2},         {"LE", 2},       {"LT", 2},      {"NE", 2},
    {"MOVE", 1},    {"TO_INT", 1},      {"TO_LREAL", 1},   {"TO_ULINT", 1}, {"TO_BOOL", 1}, {"TO_TIME", 1},
    {"TO_WORD", 1}, {"INT_TO_REAL", 1}, {"REAL_TO_INT", 1}};

constexpr Type kPlaces[] = {Type::BOOL,  Type::SINT,  Type::INT,   Type::DINT, Type::LINT, Type::USINT,
                            Type::UINT,  Type::UDINT, Type::ULINT, Type::BYTE, Type::WORD, Type::DWORD,
                            Type::LWORD, Type::REAL,  Type::LREAL, Type::TIME};

/// All calls of a function, with inputs of any types.
void for_each_call(const Function& function, const std::function<void(const std::string&)>& look) {
  std::vector<std::size_t> chosen(function.inputs, 0);
  for (;;) {
    std::string call = std::string(function.name) + "(";
    for (std::size_t i = 0; i < chosen.size(); ++i) call += (i == 0 ? "" : ", ") + kInputs[chosen[i]];
    look(call + ")");
    std::size_t i = 0;
    while (i < chosen.size() && ++chosen[i] == kInputs.size()) chosen[i++] = 0;
    if (i == chosen.size()) return;
  }
}

TEST_F(ExpressionFunctions, GiveAValueOrAnErrorWithItsPlaceWhateverTheTypes) {
  std::size_t values = 0, errors = 0;
  for (const Function& function : kFunctions)
    for_each_call(function, [&](const std::string& call) {
      for (const Type place : kPlaces) {
        if (function.inputs == 3 && place != Type::LREAL && place != Type::INT) continue;
        ASSERT_NO_THROW({
          const auto compiled = compile_expression(call, place, scope);
          if (compiled.expression) {
            compiled.expression->evaluate(counters);
            ++values;
          } else {
            ASSERT_FALSE(compiled.errors.empty()) << call;
            ASSERT_GE(compiled.errors.front().column, 1) << call;
            ++errors;
          }
        }) << call;
      }
    });
  EXPECT_GT(values, 10'000u);
  EXPECT_GT(errors, 20'000u);
}

/// The four functions of an integer are the integer, exactly, in a place of any type that holds it.
TEST_F(ExpressionFunctions, ThatRoundLeaveAnIntegerAsItIs) {
  for (const std::string name : {"TRUNC", "ROUND", "CEIL", "FLOOR"}) {
    EXPECT_EQ(integer(name + "(sint)", Type::SINT), -7);
    EXPECT_EQ(integer(name + "(int_)", Type::INT), 300);
    EXPECT_EQ(integer(name + "(dint)", Type::DINT), -70000);
    EXPECT_EQ(integer(name + "(usint)", Type::USINT), 200);
    EXPECT_EQ(integer(name + "(uint_)", Type::UINT), 60000);
    EXPECT_EQ(integer(name + "(udint)", Type::LINT), 4'000'000'000);
    EXPECT_EQ(integer(name + "(INT#5)", Type::INT), 5);
    EXPECT_EQ(integer(name + "(5)", Type::INT), 5);
    EXPECT_EQ(real(name + "(int_)", Type::REAL), 300.0);
    EXPECT_EQ(real(name + "(udint)"), 4'000'000'000.0);
    EXPECT_EQ(integer(name + "(int_) + 1", Type::INT), 301);
    EXPECT_EQ(error(name + "(lint)", Type::LINT).substr(0, 3), "1: ") << "no real number holds all of LINT";
    EXPECT_NE(error(name + "(dint)", Type::REAL), "") << "nor REAL all of DINT";
  }
}

}  // namespace
}  // namespace lockstep::expression_functions_test
