#include "projects/expression_compiler.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/projects/expression_scope.hpp"

namespace lockstep {
namespace {

class ExpressionCompiler : public ::testing::Test {
 protected:
  Value value(const std::string& text, Type wanted) {
    const CompiledExpression compiled = compile_expression(text, wanted, scope);
    for (const ExpressionError& error : compiled.errors)
      ADD_FAILURE() << text << ": column " << error.column << ": " << error.message;
    return compiled.expression ? compiled.expression->evaluate(counters) : Value{};
  }
  double real(const std::string& text, Type wanted = Type::LREAL) { return value(text, wanted).r; }
  std::int64_t integer(const std::string& text, Type wanted = Type::LINT) { return value(text, wanted).i; }
  std::uint64_t bits(const std::string& text, Type wanted = Type::LWORD) { return value(text, wanted).u; }
  bool truth(const std::string& text) { return value(text, Type::BOOL).u != 0; }
  std::string error(const std::string& text, Type wanted) {
    const CompiledExpression compiled = compile_expression(text, wanted, scope);
    EXPECT_NE(compiled.expression.has_value(), !compiled.errors.empty()) << text;
    if (compiled.errors.empty()) return "";
    return std::to_string(compiled.errors.front().column) + ": " + compiled.errors.front().message;
  }
  bool accepts(const std::string& text, Type wanted) { return error(text, wanted).empty(); }

  TestScope scope;
  EvaluationCounters counters;
};

TEST_F(ExpressionCompiler, APlainTagIsReadEachTime) {
  const auto compiled = compile_expression("LReal", Type::LREAL, scope);
  ASSERT_TRUE(compiled.expression);
  EXPECT_EQ(compiled.expression->evaluate(counters).r, 2.25);
  scope.lreal = -1.0;
  EXPECT_EQ(compiled.expression->evaluate(counters).r, -1.0);
  EXPECT_FALSE(compiled.expression->constant());
  EXPECT_EQ(compiled.expression->instructions(), 1u);
}

TEST_F(ExpressionCompiler, OperatorsBindAsTheStandardSays) {
  EXPECT_EQ(integer("2 + 3 * 4"), 14);
  EXPECT_EQ(integer("(2 + 3) * 4"), 20);
  EXPECT_EQ(real("-2 ** 2"), 4.0);
  EXPECT_EQ(real("2 ** 3 ** 2"), 64.0);
  EXPECT_EQ(integer("20 - 5 - 3"), 12);
  EXPECT_EQ(integer("17 MOD 5 * 2"), 4);
  EXPECT_TRUE(truth("TRUE OR TRUE AND FALSE"));
  EXPECT_FALSE(truth("TRUE XOR TRUE AND TRUE"));
  EXPECT_TRUE(truth("1 + 1 = 2 AND 3 > 2"));
  EXPECT_TRUE(truth("NOT FALSE AND TRUE"));
  EXPECT_TRUE(truth("1 < 2 = TRUE"));
}

}  // namespace
}  // namespace lockstep
