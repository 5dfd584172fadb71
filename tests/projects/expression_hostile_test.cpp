#include <random>
#include <string>

#include "projects/expressions/parser.hpp"
#include "tests/projects/expression_scope.hpp"
#include "tests/support/property.hpp"

namespace lockstep::expression_hostile_test {
namespace {

using HostileExpression = ExpressionTest;

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  text.reserve(part.size() * times);
  for (std::size_t i = 0; i < times; ++i) text += part;
  return text;
}

TEST_F(HostileExpression, EndlessTextsAreRefusedByTheirLength) {
  constexpr std::size_t kMillion = 1'000'000;
  for (const std::string part :
       {"(", ")", "a", "9", "-", "NOT ", "[", "(*", "SQRT(", "1+", "T#", "16#", "\x01"})
    EXPECT_NE(error(repeated(part, kMillion), Type::LREAL).find("allowed are 4096"), std::string::npos)
        << part;
  EXPECT_FALSE(accepts(std::string(kMillion, '\0'), Type::LREAL));
  EXPECT_EQ(error(std::string(4097, ' '), Type::BOOL), "1: the expression has 4097 bytes; allowed are 4096");
}

TEST_F(HostileExpression, NestingHasALimit) {
  const auto nested = [&](const std::string& open, const std::string& close, std::size_t depth) {
    return error(repeated(open, depth) + "lreal" + repeated(close, depth), Type::LREAL);
  };
  EXPECT_EQ(nested("(", ")", 64), "");
  EXPECT_EQ(nested("(", ")", 65), "65: the expression nests deeper than 64");
  EXPECT_EQ(nested("-", "", 64), "");
  EXPECT_EQ(nested("-", "", 65), "65: the expression nests deeper than 64");
  EXPECT_EQ(nested("ABS(", ")", 64), "");
  EXPECT_NE(nested("ABS(", ")", 65), "");
  EXPECT_NE(nested("(", ")", 2000), "");
  EXPECT_NE(error(repeated("(", 4096), Type::LREAL), "");
  EXPECT_NE(error(repeated("NOT ", 1000) + "flag", Type::BOOL), "");
}

TEST_F(HostileExpression, LongChainsHaveALimit) {
  EXPECT_TRUE(accepts("dint" + repeated("+1", 500), Type::DINT));
  EXPECT_NE(error("dint" + repeated("+1", 2000), Type::DINT).find("chains more than 512 operators"),
            std::string::npos);
}

TEST_F(HostileExpression, IntermediateValuesHaveALimit) {
  // Each level keeps as many values as there are strengths of operators.
  const std::string level = "1.0+lreal*lreal**(";
  const std::string text = repeated(level, 40) + "lreal" + repeated(")", 40);
  EXPECT_NE(error(text, Type::LREAL).find("more than 64 intermediate values"), std::string::npos);
  EXPECT_TRUE(accepts(repeated(level, 20) + "lreal" + repeated(")", 20), Type::LREAL));
}

TEST_F(HostileExpression, BytesThatAreNoTextAreNamed) {
  EXPECT_EQ(error(std::string("1 \0 2", 5), Type::DINT), "3: the byte 16#00 has no meaning in an expression");
  EXPECT_EQ(error("1\xC3\xA4", Type::DINT), "2: the byte 16#C3 has no meaning in an expression");
  EXPECT_EQ(error("\x7F", Type::DINT), "1: the byte 16#7F has no meaning in an expression");
  EXPECT_EQ(error(std::string("flag\0", 5), Type::BOOL), "5: the byte 16#00 has no meaning in an expression");
  EXPECT_EQ(error("\"text\"", Type::BOOL),
            "1: '\"' has no meaning here; a name stands without quotation marks, a text in apostrophes");
}

TEST_F(HostileExpression, NumbersBeyondEveryTypeAreRefused) {
  EXPECT_EQ(error(std::string(4000, '9'), Type::LREAL), "1: the number has more than 400 digits");
  EXPECT_EQ(error(std::string(300, '9'), Type::LREAL),
            "1: the integer is larger than any type; LREAL holds it as 1.0E30");
  EXPECT_FALSE(accepts("16#" + std::string(300, 'F'), Type::LWORD));
  EXPECT_FALSE(accepts("1E99999999999999999999", Type::LREAL));
  EXPECT_FALSE(accepts("18446744073709551616", Type::ULINT));
  EXPECT_FALSE(accepts("T#99999999999999999999d", Type::TIME));
  std::string squares = "99999999999999999999999999999999999999 * 99999999999999999999999999999999999999";
  EXPECT_EQ(error(squares, Type::LREAL), "40: the result is larger than any integer type");
  EXPECT_FALSE(accepts("lreal + " + repeated("4294967296 * ", 6) + "1", Type::LREAL));
  EXPECT_FALSE(accepts("knife.sensor[99999999999999999999].position", Type::LREAL));
}

TEST_F(HostileExpression, LongNamesAreShortenedInMessages) {
  const std::string name(4000, 'f');
  EXPECT_LT(error(name + "(1)", Type::LREAL).size(), 600u);
  EXPECT_LT(error("1 " + name, Type::LREAL).size(), 200u);
}

TEST_F(HostileExpression, RandomWordsNeverDoMoreThanFail) {
  std::mt19937 random(test::seed_of_test(20240611));
  const std::vector<std::string> words = {
      "flag", "lreal", "dint",  "word", "time", "1",       "2.5",  "16#FF", "T#1s", "(",   ")",
      ",",    "+",     "-",     "*",    "/",    "MOD",     "**",   "AND",   "OR",   "NOT", "<",
      "=",    "<>",    "SQRT(", "MAX(", "SEL(", "TO_INT(", "ROL(", ".X1",   "[1]",  ":=",  "IN",
      "TRUE", "INT#5", "(*",    "*)",   "\x01", "TRUNC(",  "MUX(", "LIMIT("};
  std::size_t compiled = 0;
  for (int i = 0; i < test::cases(100'000, 10'000'000); ++i) {
    std::string text;
    const std::size_t length = 1 + random() % 12;
    for (std::size_t k = 0; k < length; ++k) text += words[random() % words.size()] + " ";
    const auto wanted = static_cast<Type>(random() % 19);
    const CompiledExpression result = compile_expression(text, wanted, scope);
    ASSERT_NE(result.expression.has_value(), !result.errors.empty()) << text;
    for (const ExpressionError& problem : result.errors) {
      ASSERT_GE(problem.column, 1) << text;
      ASSERT_LE(problem.column, static_cast<int>(text.size()) + 1) << text;
      ASSERT_FALSE(problem.message.empty()) << text;
    }
    if (!result.expression) continue;
    ++compiled;
    result.expression->evaluate(counters);
  }
  EXPECT_GT(compiled, 300u);
}

}  // namespace
}  // namespace lockstep::expression_hostile_test
