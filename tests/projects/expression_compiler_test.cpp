#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "projects/expressions/compiler.hpp"
#include "projects/expressions/habits.hpp"
#include "tests/projects/expression_scope.hpp"

namespace lockstep::expression_compiler_test {
namespace {

using ExpressionCompiler = ExpressionTest;

TEST_F(ExpressionCompiler, APlainTagIsReadEachTimeByOneInstruction) {
  const auto compiled = compile_expression("LReal", Type::LREAL, scope);
  ASSERT_TRUE(compiled.expression);
  EXPECT_EQ(compiled.expression->evaluate(counters).r, 2.25);
  scope.lreal = -1.0;
  EXPECT_EQ(compiled.expression->evaluate(counters).r, -1.0);
  EXPECT_FALSE(compiled.expression->constant());
  EXPECT_EQ(compiled.expression->instructions(), 1u);
}

TEST_F(ExpressionCompiler, WhatDependsOnNoTagIsComputedWhileLoading) {
  for (const std::string text : {"3", "1.5 * 2 + 4", "SQRT(16.0) - 1", "LIMIT(0, 5, 3)", "SEL(TRUE, 1, 2)",
                                 "TO_LREAL(T#3s)", "DINT#7 / DINT#2", "MUX(1, 3, 4, 5)"}) {
    const auto compiled = compile_expression(text, Type::LREAL, scope);
    ASSERT_TRUE(compiled.expression) << text;
    EXPECT_TRUE(compiled.expression->constant()) << text;
    EXPECT_EQ(compiled.expression->instructions(), 1u) << text;
  }
  EXPECT_EQ(compile_expression("lreal * (2 + 3 * 4)", Type::LREAL, scope).expression->instructions(), 3u);
}

TEST_F(ExpressionCompiler, OperatorsBindAsTheStandardSays) {
  EXPECT_EQ(integer("2 + 3 * 4"), 14);
  EXPECT_EQ(integer("(2 + 3) * 4"), 20);
  EXPECT_EQ(real("-2 ** 2"), 4.0);
  EXPECT_EQ(real("2 ** -1"), 0.5);
  EXPECT_EQ(real("2 ** 3 ** 2"), 64.0);
  EXPECT_EQ(real("3 * 2 ** 3"), 24.0);
  EXPECT_EQ(integer("20 - 5 - 3"), 12);
  EXPECT_EQ(integer("100 / 5 / 2"), 10);
  EXPECT_EQ(integer("17 MOD 5 * 2"), 4);
  EXPECT_EQ(integer("- 3 + 5"), 2);
  EXPECT_EQ(integer("+3 - -5"), 8);
  EXPECT_TRUE(truth("TRUE OR TRUE AND FALSE"));
  EXPECT_TRUE(truth("TRUE OR TRUE XOR TRUE"));
  EXPECT_TRUE(truth("TRUE XOR TRUE AND FALSE"));
  EXPECT_TRUE(truth("TRUE XOR TRUE & FALSE"));
  EXPECT_TRUE(truth("1 + 1 = 2 AND 3 > 2"));
  EXPECT_TRUE(truth("FALSE = 2 < 1"));  // comparisons bind stronger than = and <>
  EXPECT_TRUE(truth("1 < 2 = TRUE"));
  EXPECT_FALSE(truth("NOT TRUE OR FALSE"));
  EXPECT_FALSE(truth("NOT FALSE AND FALSE"));
  EXPECT_FALSE(truth("NOT FALSE = FALSE"));  // NOT binds strongest
  EXPECT_TRUE(truth("NOT (FALSE AND TRUE)"));
  EXPECT_TRUE(
      truth("FALSE AND TRUE = FALSE"
            " OR TRUE"));
}

TEST_F(ExpressionCompiler, NamesAndKeywordsAreReadInAnyCase) {
  EXPECT_TRUE(truth("FLAG and not OTHER"));
  EXPECT_TRUE(truth("Gear.Done Or false"));
  EXPECT_EQ(integer("dint mod 7", Type::DINT), 0);
  EXPECT_EQ(real("sqrt(16.0)"), 4.0);
  EXPECT_EQ(integer("to_int(2.0)", Type::INT), 2);
}

TEST_F(ExpressionCompiler, BlanksAndCommentsSeparateWordsOnly) {
  EXPECT_EQ(integer("(* a (* nested *) one *) 2\n\t+ // to the end of the line\r\n 3(**)"), 5);
  EXPECT_EQ(real("Knife . Sensor [ 1 ] . Position"), 2.25);
  EXPECT_TRUE(truth("1<>2"));
  EXPECT_EQ(integer("7(*)*)-2"), 5);
}

TEST_F(ExpressionCompiler, ReferencesReachMembersElementsAndBits) {
  EXPECT_EQ(real("Knife.Sensor[1].Position"), 2.25);
  EXPECT_TRUE(truth("Knife.StatusWord.X0"));
  EXPECT_FALSE(truth("knife.statusword.x1"));
  EXPECT_TRUE(truth("knife.statusword.X31 AND NOT knife.statusword.X30"));
  EXPECT_TRUE(truth("int_.X5"));
  EXPECT_TRUE(truth("sint.X7"));
  EXPECT_TRUE(truth("lword.X63"));
  EXPECT_TRUE(truth("number.X1"));
  EXPECT_EQ(integer("knife.X5"), 5'000'000'000);  // a variable of that name comes before a bit
  EXPECT_TRUE(truth("number = 3 AND number < udint"));
  EXPECT_EQ(bits("number", Type::DB_ANY), 3u);
}

TEST_F(ExpressionCompiler, BitsEndWithTheWidthOfTheType) {
  EXPECT_EQ(error("flag.X0", Type::BOOL), "1: 'flag' is of type BOOL and has no bits, not .X0");
  EXPECT_EQ(error("lreal.X0", Type::BOOL), "1: 'lreal' is of type LREAL and has no bits, not .X0");
  EXPECT_EQ(error("time.X0", Type::BOOL), "1: 'time' is of type TIME and has no bits, not .X0");
  const std::vector<std::pair<std::string, int>> widths = {
      {"sint", 8},  {"usint", 8},  {"byte_", 8},  {"int_", 16}, {"uint_", 16}, {"word", 16},
      {"dint", 32}, {"udint", 32}, {"dword", 32}, {"lint", 64}, {"ulint", 64}, {"lword", 64}};
  for (const auto& [tag, width] : widths) {
    EXPECT_TRUE(accepts(tag + ".X" + std::to_string(width - 1), Type::BOOL)) << tag;
    EXPECT_NE(error(tag + ".X" + std::to_string(width), Type::BOOL)
                  .find("has the bits .X0 to .X" + std::to_string(width - 1)),
              std::string::npos)
        << tag;
  }
  EXPECT_FALSE(accepts("word.X999", Type::BOOL));
}

TEST_F(ExpressionCompiler, UnknownNamesCarryTheirPlaceAndTheScopesAdvice) {
  EXPECT_EQ(error("flag AND stat", Type::BOOL), "10: 'stat' is unknown; did you mean 'flag'?");
  EXPECT_EQ(error("  knife.Velocity", Type::LREAL), "3: 'knife.velocity' is unknown; did you mean 'flag'?");
  EXPECT_EQ(error("stat.X3", Type::BOOL), "1: 'stat' is unknown; did you mean 'flag'?");
  EXPECT_EQ(error("knife.object", Type::LREAL),
            "1: 'knife.object' is a reference to an object or a tag, not a value");
}

TEST_F(ExpressionCompiler, EveryErrorIsReportedNotOnlyTheFirst) {
  const auto compiled = compile_expression("nothing > 1 AND flag + 2 = 3 AND void", Type::BOOL, scope);
  ASSERT_EQ(compiled.errors.size(), 3u);
  EXPECT_EQ(compiled.errors[0].column, 1);
  EXPECT_EQ(compiled.errors[1].column, 22);
  EXPECT_EQ(compiled.errors[2].column, 34);
}

TEST_F(ExpressionCompiler, SyntaxErrorsNameColumnAndWhatIsExpected) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "1: the expression is empty"},
      {"  (* *) ", "9: the expression is empty"},
      {"1 +", "4: the end of the expression found where a value is expected"},
      {"1 2", "3: a literal found where an operator or the end is expected"},
      {"(1", "3: the end of the expression found where ')' is expected"},
      {"1)", "2: ')' found where an operator or the end is expected"},
      {"flag AND", "9: the end of the expression found where a value is expected"},
      {"AND flag", "1: 'AND' found where a value is expected"},
      {"flag.", "6: the end of the expression found where the name of a variable or a bit .X0 is expected"},
      {"knife.sensor[].position", "14: ']' found where an index is expected"},
      {"knife.sensor[dint][dint]", "19: only one index may be an expression"},
      {"flag == other", "6: '==' has no meaning here; equal is ="},
      {"flag.%X0", "6: '%' has no meaning here; a remainder is MOD, a bit is .X0"},
      {"dint @ 2", "6: '@' has no meaning in an expression"},
      {"SQRT()", "6: ')' found where an input of SQRT is expected"},
      {"SQRT(1.0", "9: the end of the expression found where ')' is expected"},
      {"(* open", "1: the comment that begins here has no end *)"},
      {"1.", "2: a digit has to follow the decimal point"},
      {"1..2", "2: a digit has to follow the decimal point"},
      {".5", "1: '.' found where a value is expected"},
      {"12abc", "3: 'a' may not follow the literal that begins at column 1"},
      {"1.5.2", "4: '.' may not follow the literal that begins at column 1"},
      {"1E", "3: a digit of the exponent is missing"},
      {"1__0", "3: a digit of the number is missing"},
      {"7#12", "1: the base '7' is unknown; allowed are 2#, 8# and 16#"},
      {"2#12", "4: '2' may not follow the literal that begins at column 1"},
      {"8#8", "3: a digit of the number in base 8 is missing"},
      {"16#", "4: a digit of the number in base 16 is missing"}};
  for (const auto& [text, message] : cases) EXPECT_EQ(error(text, Type::LREAL), message) << text;
}

TEST_F(ExpressionCompiler, WhatOtherLanguagesWriteIsToldAsItIsWrittenHere) {
  for (const Habit& habit : habits()) {
    const std::string written(habit.written);
    const bool sign = written.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == written.npos;
    const std::string told = error(sign ? "dint " + written + " 1" : written + "(1.0, 2.0)", Type::LREAL);
    EXPECT_NE(told.find(habit.here), std::string::npos) << written << ": " << told;
    EXPECT_NE(told.find("'" + written + "'"), std::string::npos) << told;
  }
  const std::pair<std::string, std::string> cases[] = {
      {"dint := 1", R"({ "set": "n", "to": "n + 1" })"},
      {"IF flag THEN", R"({ "if": "…", "then": [ … ], "else": [ … ] })"},
      {"R_TRIG(flag)", R"({ "fb": "R_TRIG", "name": "x", "in": { … } }; its outputs are read as x.Pin)"},
      {"REAL(dint)", "made by TO_REAL(IN)"},
      {"LIMMIT(1, 2, 3)", "(did you mean 'LIMIT'?); there are ABS SQRT"},
      {"norm_x(0.0, 1.0, 2.0)", "(VALUE - MIN) / (MAX - MIN)"}};
  for (const auto& [text, part] : cases)
    EXPECT_NE(error(text, Type::LREAL).find(part), std::string::npos) << error(text, Type::LREAL);
  EXPECT_EQ(error("LIMIT(MN := 0, IN := dint, MX := 9)", Type::DINT), "") << ":= is of this language there";
  EXPECT_EQ(error("dint--1", Type::DINT), "") << "and so are two signs";
}

TEST_F(ExpressionCompiler, ArithmeticFunctionsComputeWhatTheirNamesSay) {
  const volatile double x = 0.6;  // so that the library is asked, not the compiler
  scope.lreal = x;
  EXPECT_EQ(real("SIN(lreal)"), std::sin(x));
  EXPECT_EQ(real("COS(lreal)"), std::cos(x));
  EXPECT_EQ(real("TAN(lreal)"), std::tan(x));
  EXPECT_EQ(real("ASIN(lreal)"), std::asin(x));
  EXPECT_EQ(real("ACOS(lreal)"), std::acos(x));
  EXPECT_EQ(real("ATAN(lreal)"), std::atan(x));
  EXPECT_EQ(real("ATAN2(lreal, -1.0)"), std::atan2(x, -1.0));
  EXPECT_EQ(real("ATAN2(X := -1.0, Y := lreal)"), std::atan2(x, -1.0));
  EXPECT_EQ(real("SQRT(lreal)"), std::sqrt(x));
  EXPECT_EQ(real("LN(lreal)"), std::log(x));
  EXPECT_EQ(real("LOG(lreal)"), std::log10(x));
  EXPECT_EQ(real("EXP(lreal)"), std::exp(x));
  EXPECT_EQ(real("EXPT(lreal, 3)"), std::pow(x, 3));
  EXPECT_EQ(real("lreal ** 0.5"), std::pow(x, 0.5));
  EXPECT_TRUE(std::isnan(real("SQRT(-lreal)")));
  EXPECT_EQ(real("ABS(-lreal)"), 0.6);
  EXPECT_EQ(integer("ABS(sint)", Type::SINT), 7);
  EXPECT_EQ(integer("ABS(-128)", Type::INT), 128);
  EXPECT_EQ(real("SQRT(real)", Type::REAL), static_cast<double>(std::sqrt(1.5f)));
  EXPECT_EQ(real("real ** 2", Type::REAL), 2.25);
  EXPECT_EQ(real("SQRT(int_)", Type::REAL), static_cast<double>(static_cast<float>(std::sqrt(300.0))));
  EXPECT_EQ(real("SQRT(int_)"), std::sqrt(300.0));
}

TEST_F(ExpressionCompiler, FunctionsThatChooseGiveTheChosenInput) {
  EXPECT_EQ(integer("MIN(3, 1, 2)"), 1);
  EXPECT_EQ(integer("MAX(3, dint, int_)"), 300);
  EXPECT_EQ(real("MAX(real, lreal)"), 2.25);
  EXPECT_EQ(integer("MIN(time, T#2s)", Type::TIME), 1'500'000'000);
  EXPECT_EQ(bits("MAX(word, 16#2000)", Type::WORD), 0x2000u);
  EXPECT_EQ(integer("LIMIT(0, 5, 10)"), 5);
  EXPECT_EQ(integer("LIMIT(0, -5, 10)"), 0);
  EXPECT_EQ(integer("LIMIT(0, 15, 10)"), 10);
  EXPECT_EQ(integer("LIMIT(MX := 10, MN := 0, IN := int_)"), 10);
  EXPECT_EQ(integer("LIMIT(20, 15, 10)"), 10);  // limits the wrong way round: the upper one holds
  EXPECT_EQ(integer("SEL(flag, 1, 2)"), 2);
  EXPECT_EQ(integer("SEL(other, 1, 2)"), 1);
  EXPECT_TRUE(truth("SEL(G := other, IN1 := FALSE, IN0 := flag)"));
  EXPECT_EQ(real("SEL(flag, 1, 2.5)"), 2.5);
  EXPECT_EQ(integer("SEL(flag, 100, 200)", Type::USINT), 200);
  scope.int_ = 2;
  EXPECT_EQ(integer("MUX(int_, 10, 20, 30)"), 30);
  scope.int_ = 3;
  EXPECT_EQ(integer("MUX(int_, 10, 20, 30)"), 30);
  scope.int_ = -1;
  EXPECT_EQ(integer("MUX(K := int_, IN1 := 20, IN0 := 10, IN2 := 30)"), 10);
  EXPECT_EQ(real("lreal + MUX(1, lreal, lreal * 2, 0.0) * 2"), 2.25 + 9.0);
}

TEST_F(ExpressionCompiler, ANaNIsNeverHiddenByAChoice) {
  scope.lreal = std::numeric_limits<double>::quiet_NaN();
  for (const std::string text : {"MIN(lreal, 1.0)", "MIN(1.0, lreal)", "MAX(lreal, 1.0)", "MAX(1.0, lreal)",
                                 "LIMIT(0.0, lreal, 1.0)", "LIMIT(lreal, 0.5, 1.0)"})
    EXPECT_TRUE(std::isnan(real(text))) << text;
  for (const std::string text : {"<", "<=", ">", ">=", "="}) {
    EXPECT_FALSE(truth("lreal " + text + " lreal")) << text;
    EXPECT_FALSE(truth("lreal " + text + " 1.0")) << text;
  }
  EXPECT_TRUE(truth("lreal <> lreal"));
}

TEST_F(ExpressionCompiler, OperatorsHaveFunctionsToo) {
  EXPECT_EQ(integer("ADD(1, int_, 3)"), 304);
  EXPECT_EQ(integer("MUL(2, 3, 4)"), 24);
  EXPECT_EQ(integer("SUB(2, 3)"), -1);
  EXPECT_EQ(integer("DIV(-7, 2)"), -3);
  EXPECT_TRUE(truth("GT(2, 1) AND GE(2, 2) AND EQ(3, 3) AND LE(1, 1) AND LT(1, 2) AND NE(1, 2)"));
  EXPECT_EQ(real("MOVE(lreal)"), 2.25);
}

TEST_F(ExpressionCompiler, FunctionsTellWhatTheyTake) {
  EXPECT_EQ(error("SQRT(1.0, 2.0)", Type::LREAL), "1: SQRT takes 1 input (IN), not 2");
  EXPECT_EQ(error("LIMIT(1, 2)", Type::LREAL), "1: LIMIT takes 3 inputs (MN,IN,MX), not 2");
  EXPECT_EQ(error("MIN(1)", Type::LREAL), "1: MIN takes 2 to 32 inputs (IN1,IN2), not 1");
  EXPECT_EQ(error("LIMIT(MN := 1, IN := 2, MAX := 3)", Type::LREAL),
            "1: LIMIT needs its input MX; its inputs are MN,IN,MX");
  EXPECT_EQ(error("SEL(G := flag, IN0 := 1, IN0 := 2)", Type::LREAL),
            "1: SEL needs its input IN1; its inputs are G,IN0,IN1");
  EXPECT_EQ(error("LIMIT(MN := 1, 2, 3)", Type::LREAL), "16: either all inputs of LIMIT are named or none");
  EXPECT_EQ(error("LIMIT(1 := 1, 2, 3)", Type::LREAL), "9: ':=' found where ',' or ')' is expected");
  EXPECT_EQ(error("1 + XYZ(2.0)", Type::LREAL).substr(0, 58),
            "5: the function 'XYZ' is unknown; there are ABS SQRT LN LO");
  EXPECT_EQ(error("SQRT(flag)", Type::LREAL).substr(0, 32), "1: SQRT has no meaning for BOOL;");
}

TEST_F(ExpressionCompiler, RoundingFunctionsGiveTheIntegerOfTheirPlace) {
  scope.lreal = -2.5;
  EXPECT_EQ(integer("TRUNC(lreal)", Type::SINT), -2);
  EXPECT_EQ(integer("ROUND(lreal)", Type::DINT), -2);
  EXPECT_EQ(integer("FLOOR(lreal)"), -3);
  EXPECT_EQ(integer("CEIL(lreal)"), -2);
  EXPECT_EQ(real("FLOOR(lreal)"), -3.0);
  EXPECT_EQ(integer("TRUNC(real) + 1", Type::INT), 2);
  EXPECT_EQ(real("TRUNC(real)", Type::REAL), 1.0);
  EXPECT_EQ(real("TRUNC(2.75)", Type::REAL), 2.0);
  scope.lreal = 1.0e10;
  EXPECT_EQ(real("TRUNC(lreal)"), 1.0e10);
  EXPECT_EQ(integer("TRUNC(lreal)"), 10'000'000'000);
  EXPECT_EQ(integer("TO_LINT(TRUNC(lreal))"), 10'000'000'000);
  EXPECT_EQ(integer("TRUNC(lreal)", Type::DINT), 2147483647);  // out of range: the nearest end
  EXPECT_TRUE(truth("TRUNC(lreal) > 5"));
}

TEST_F(ExpressionCompiler, ShiftsAndRotationsKeepTheWidth) {
  EXPECT_EQ(bits("SHL(word, 4)", Type::WORD), 0x2340u);
  EXPECT_EQ(bits("SHR(word, 4)", Type::WORD), 0x0123u);
  EXPECT_EQ(bits("ROL(word, 4)", Type::WORD), 0x2341u);
  EXPECT_EQ(bits("ROR(word, int_)", Type::WORD), 0x2341u);  // 300 = 18 · 16 + 12
  EXPECT_EQ(bits("SHL(word, 16)", Type::WORD), 0u);
  EXPECT_EQ(bits("SHR(lword, 64)"), 0u);
  EXPECT_EQ(bits("SHL(lword, 63)"), 0x8000000000000000u);
  EXPECT_EQ(bits("ROL(byte_, 8)", Type::BYTE), 0xA5u);
  EXPECT_EQ(bits("SHL(word, -1)", Type::WORD), 0x1234u);
  EXPECT_EQ(bits("SHL(16#1, 12)", Type::WORD), 0x1000u);
  EXPECT_FALSE(accepts("SHL(dint, 1)", Type::DINT));
  EXPECT_FALSE(accepts("SHL(flag, 1)", Type::BOOL));
  EXPECT_FALSE(accepts("SHL(word, 1.0)", Type::WORD));
}

TEST_F(ExpressionCompiler, DurationsAddAndScale) {
  EXPECT_EQ(integer("time + T#500ms", Type::TIME), 2'000'000'000);
  EXPECT_EQ(integer("-time - T#1s", Type::TIME), -2'500'000'000);
  EXPECT_EQ(integer("time * 3", Type::TIME), 4'500'000'000);
  EXPECT_EQ(integer("2 * time", Type::TIME), 3'000'000'000);
  EXPECT_EQ(integer("time / 4", Type::TIME), 375'000'000);
  EXPECT_EQ(integer("time * 0.5", Type::TIME), 750'000'000);
  EXPECT_EQ(integer("lreal * time", Type::TIME), 3'375'000'000);
  EXPECT_EQ(integer("time / lreal", Type::TIME), 666'666'667);
  EXPECT_EQ(integer("time * (dint / 70000)", Type::TIME), -1'500'000'000);
  EXPECT_TRUE(truth("time > T#1s AND time <= T#1500ms AND time <> T#1s"));
  for (const std::string text : {"time + 5", "time * time", "1 / time", "5 - time", "time / T#1s",
                                 "time MOD 2", "time * ulint", "time * flag", "time AND time", "ABS(time)"})
    EXPECT_FALSE(accepts(text, Type::TIME)) << text;
  EXPECT_FALSE(accepts("time", Type::LINT));
  EXPECT_FALSE(accepts("time > 5", Type::BOOL));
}

TEST_F(ExpressionCompiler, DivisionsByZeroGiveZeroAndAreCounted) {
  scope.dint = 0;
  scope.time = TIME{5};
  EXPECT_EQ(integer("lint / dint"), 0);
  EXPECT_EQ(counters.integer_divisions_by_zero, 1u);
  EXPECT_EQ(integer("lint MOD dint"), 0);
  EXPECT_EQ(integer("time / dint", Type::TIME), 0);
  EXPECT_EQ(counters.integer_divisions_by_zero, 3u);
  EXPECT_EQ(integer("1 / 0 + 2 MOD 0 + 7"),
            7);  // literals alone divide while loading, and count when evaluated
  EXPECT_EQ(counters.integer_divisions_by_zero, 5u);
  EXPECT_EQ(integer("DINT#1 / DINT#0"), 0);
  EXPECT_EQ(counters.integer_divisions_by_zero, 6u);
  EXPECT_FALSE(compile_expression("1 / 0", Type::DINT, scope).expression->constant());
  EXPECT_EQ(warning("3 + 1 / 0", Type::DINT), 7);
  // A literal 0 divides by zero whatever it divides; a real has infinities.
  EXPECT_EQ(warning("dint / 0", Type::DINT), 6);
  EXPECT_EQ(warning("dint MOD 0", Type::DINT), 6);
  EXPECT_EQ(warning("dint / (3 - 3)", Type::DINT), 6);
  EXPECT_EQ(warning("dint / DINT#0", Type::DINT), 6);
  EXPECT_EQ(warning("DINT#1 / DINT#0", Type::DINT), 8);
  EXPECT_EQ(warning("DIV(dint, 0)", Type::DINT), 1);
  EXPECT_EQ(warning("time / 0", Type::TIME), 6);
  EXPECT_EQ(warning("dint / 1", Type::DINT), 0);
  EXPECT_EQ(warning("dint / dint", Type::DINT), 0);
  EXPECT_EQ(warning("0 / dint", Type::DINT), 0);
  EXPECT_EQ(warning("lreal / 0", Type::LREAL), 0);
  EXPECT_EQ(warning("dint / 0.0", Type::LREAL), 0);
  EXPECT_EQ(warning("time / 0.0", Type::TIME), 0);
  EXPECT_EQ(real("1.0 / 0"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(real("0.0 / (lreal - lreal)")));
  EXPECT_EQ(counters.integer_divisions_by_zero, 6u);
}

}  // namespace
}  // namespace lockstep::expression_compiler_test
