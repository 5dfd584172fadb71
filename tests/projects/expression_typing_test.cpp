#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/projects/expression_scope.hpp"

namespace lockstep::expression_typing_test {
namespace {

using ExpressionTyping = ExpressionTest;

struct Tag {
  std::string name;
  Type type;
};

const std::vector<Tag> kTags = {
    {"flag", Type::BOOL},   {"sint", Type::SINT},   {"int_", Type::INT},    {"dint", Type::DINT},
    {"lint", Type::LINT},   {"usint", Type::USINT}, {"uint_", Type::UINT},  {"udint", Type::UDINT},
    {"ulint", Type::ULINT}, {"byte_", Type::BYTE},  {"word", Type::WORD},   {"dword", Type::DWORD},
    {"lword", Type::LWORD}, {"real", Type::REAL},   {"lreal", Type::LREAL}, {"time", Type::TIME}};

/// For each type what it widens to besides itself, written out by hand from the contract.
std::string wider(Type type) {
  switch (type) {
    case Type::SINT:
      return " INT DINT LINT REAL LREAL ";
    case Type::INT:
      return " DINT LINT REAL LREAL ";
    case Type::DINT:
      return " LINT LREAL ";
    case Type::USINT:
      return " UINT UDINT ULINT INT DINT LINT REAL LREAL ";
    case Type::UINT:
      return " UDINT ULINT DINT LINT REAL LREAL ";
    case Type::UDINT:
      return " ULINT LINT LREAL ";
    case Type::REAL:
      return " LREAL ";
    case Type::BYTE:
      return " WORD DWORD LWORD ";
    case Type::WORD:
      return " DWORD LWORD ";
    case Type::DWORD:
      return " LWORD ";
    default:
      return " ";
  }
}

bool may_widen(Type from, Type to) {
  return from == to || wider(from).find(" " + std::string(type_name(to)) + " ") != std::string::npos;
}

TEST_F(ExpressionTyping, ValuesWidenAlongTheChainsAndNowhereElse) {
  for (const Tag& tag : kTags)
    for (const Tag& place : kTags) {
      EXPECT_EQ(accepts(tag.name, place.type), may_widen(tag.type, place.type))
          << type_name(tag.type) << " to " << type_name(place.type);
      if (!may_widen(tag.type, place.type)) {
        const std::string message = error(tag.name, place.type);
        EXPECT_EQ(message.find("1: " + std::string(type_name(tag.type)) + " does not fit where " +
                               std::string(type_name(place.type)) + " is expected"),
                  0u)
            << message;
      }
    }
}

TEST_F(ExpressionTyping, WideningKeepsTheValue) {
  EXPECT_EQ(integer("sint"), -7);
  EXPECT_EQ(real("sint", Type::REAL), -7.0);
  EXPECT_EQ(real("udint"), 4.0e9);
  EXPECT_EQ(real("dint"), -70000.0);
  EXPECT_EQ(real("real"), 1.5);
  EXPECT_EQ(integer("udint"), 4'000'000'000);
  EXPECT_EQ(bits("byte_"), 0xA5u);
}

/// The smallest type that both become, by hand: an integer before a real one.
std::string meeting(Type a, Type b) {
  for (const Type type :
       {Type::BOOL, Type::SINT, Type::USINT, Type::INT, Type::UINT, Type::DINT, Type::UDINT, Type::LINT,
        Type::ULINT, Type::REAL, Type::LREAL, Type::BYTE, Type::WORD, Type::DWORD, Type::LWORD, Type::TIME})
    if (may_widen(a, type) && may_widen(b, type)) return std::string(type_name(type));
  return "";
}

TEST_F(ExpressionTyping, TwoOperandsMeetAtTheSmallestCommonType) {
  for (const Tag& a : kTags)
    for (const Tag& b : kTags) {
      const std::string common = meeting(a.type, b.type);
      EXPECT_EQ(accepts(a.name + " = " + b.name, Type::BOOL), !common.empty()) << a.name << " = " << b.name;
      EXPECT_EQ(accepts(a.name + " < " + b.name, Type::BOOL), !common.empty() && common != "BOOL")
          << a.name << " < " << b.name;
      const bool numbers = is_numeric(a.type) && is_numeric(b.type) && !common.empty();
      const std::string sum = a.name + " + " + b.name;
      if (!numbers) {
        const bool durations = a.type == Type::TIME && b.type == Type::TIME;
        for (const Tag& place : kTags)
          EXPECT_EQ(accepts(sum, place.type), durations && place.type == Type::TIME) << sum;
        continue;
      }
      for (const Tag& place : kTags)
        EXPECT_EQ(accepts(sum, place.type), may_widen(*tag_type(common), place.type))
            << sum << " for " << type_name(place.type);
    }
}

TEST_F(ExpressionTyping, LogicTakesBoolsAndBitStringsOnly) {
  for (const Tag& a : kTags)
    for (const Tag& b : kTags)
      for (const std::string logic : {" AND ", " & ", " OR ", " XOR "}) {
        const bool bools = a.type == Type::BOOL && b.type == Type::BOOL;
        const bool strings = is_bit_string(a.type) && is_bit_string(b.type);
        EXPECT_EQ(accepts(a.name + logic + b.name, bools ? Type::BOOL : Type::LWORD), bools || strings)
            << a.name << logic << b.name;
      }
  for (const Tag& a : kTags)
    EXPECT_EQ(accepts("NOT " + a.name, a.type), a.type == Type::BOOL || is_bit_string(a.type)) << a.name;
  EXPECT_EQ(bits("NOT byte_", Type::BYTE), 0x5Au);
  EXPECT_EQ(bits("NOT byte_", Type::WORD), 0x5Au);  // inverted as a BYTE, then widened
  EXPECT_EQ(bits("word AND 16#FF", Type::WORD), 0x34u);
  EXPECT_EQ(bits("byte_ OR 16#100", Type::WORD), 0x1A5u);
  EXPECT_EQ(bits("word XOR 16#FFFF", Type::DWORD), 0xEDCBu);
  EXPECT_EQ(bits("NOT 16#0", Type::WORD), 0xFFFFu);
  EXPECT_TRUE(truth("word = 16#1234 AND byte_ > 16#A0"));
}

TEST_F(ExpressionTyping, SignsAndModuloTakeTheirTypesOnly) {
  for (const Tag& a : kTags) {
    const bool signs = is_numeric(a.type) || a.type == Type::TIME;
    EXPECT_EQ(accepts("-" + a.name, a.type), signs) << a.name;
    EXPECT_EQ(accepts("+" + a.name, a.type), signs) << a.name;
    EXPECT_EQ(accepts(a.name + " MOD " + a.name, a.type), is_integer(a.type)) << a.name;
    EXPECT_EQ(accepts("ABS(" + a.name + ")", a.type), is_numeric(a.type)) << a.name;
    EXPECT_EQ(accepts("SEL(flag, " + a.name + ", " + a.name + ")", a.type), true) << a.name;
    EXPECT_EQ(accepts("MAX(" + a.name + ", " + a.name + ")", a.type), a.type != Type::BOOL) << a.name;
  }
}

TEST_F(ExpressionTyping, AnIntegerLiteralFitsUpToTheEndsOfTheType) {
  for (const Tag& place : kTags) {
    if (!is_integer(place.type) && !is_bit_string(place.type)) continue;
    const std::string low = std::to_string(lowest(place.type));
    const std::string high = std::to_string(highest(place.type));
    EXPECT_EQ(integer(low, place.type), lowest(place.type)) << low;
    EXPECT_EQ(bits(high, place.type), highest(place.type)) << high;
    const std::string name(type_name(place.type));
    EXPECT_EQ(bits(name + "#" + high, place.type), highest(place.type)) << name;
    EXPECT_EQ(integer(name + "#" + low, place.type), lowest(place.type)) << name;
    for (const std::string& text : {low + " - 1", high + " + 1"}) {
      const std::string message = error(text, place.type);
      EXPECT_NE(message.find(" does not fit " + name + " (" + low + " to " + high + ")"), std::string::npos)
          << message;
    }
    EXPECT_FALSE(accepts("1.0", place.type)) << name;
    EXPECT_FALSE(accepts("TRUE", place.type)) << name;
  }
  EXPECT_EQ(error("300", Type::USINT), "1: 300 does not fit USINT (0 to 255)");
  EXPECT_EQ(error("dint > -1 AND 70_000 = INT#70_000", Type::BOOL),
            "24: 70000 does not fit INT (-32768 to 32767)");
}

TEST_F(ExpressionTyping, LiteralsAreReadInEveryNotation) {
  EXPECT_EQ(integer("1_000"), 1000);
  EXPECT_EQ(integer("16#FF"), 255);
  EXPECT_EQ(integer("16#ff_FF"), 65535);
  EXPECT_EQ(integer("2#1010_0101"), 0xA5);
  EXPECT_EQ(integer("8#17"), 15);
  EXPECT_EQ(bits("WORD#16#FF", Type::WORD), 0xFFu);
  EXPECT_EQ(integer("int#-5", Type::INT), -5);
  EXPECT_EQ(integer("INT#+5", Type::INT), 5);
  EXPECT_EQ(real("1.5E3"), 1500.0);
  EXPECT_EQ(real("1.5e-3"), 1.5e-3);
  EXPECT_EQ(real("2E+2"), 200.0);
  EXPECT_EQ(real("1_0.2_5"), 10.25);
  EXPECT_EQ(real("REAL#0.1", Type::REAL), static_cast<double>(0.1f));
  EXPECT_EQ(real("REAL#0.1"), static_cast<double>(0.1f));
  EXPECT_EQ(real("LREAL#-7"), -7.0);
  EXPECT_TRUE(truth("BOOL#1 AND NOT BOOL#0 AND BOOL#TRUE AND NOT bool#false"));
  EXPECT_EQ(integer("T#1s500ms", Type::TIME), 1'500'000'000);
  EXPECT_EQ(integer("TIME#-10ms", Type::TIME), -10'000'000);
  EXPECT_EQ(integer("t#1D2h3m4s5ms6us7ns", Type::TIME), 93'784'005'006'007);
  EXPECT_EQ(integer("T#1d_2h_0.5m", Type::TIME), 93'630'000'000'000);
  for (const std::string text :
       {"INT#1.0", "BOOL#2", "BOOL#TRUEX", "TIME#5", "T#", "T#1s1m", "T#1.5m1s", "REAL#TRUE", "INT#",
        "LTIME#5s", "INT#--1", "BYTE#-1", "REAL#1E39", "WORD#TRUE", "T#1q", "BOOL#BOOL#1", "INT#DINT#1"})
    for (const Tag& place : kTags) EXPECT_FALSE(accepts(text, place.type)) << text << " " << place.name;
}

TEST_F(ExpressionTyping, ALiteralTakesTheTypeOfItsPlace) {
  EXPECT_EQ(real("3"), 3.0);
  EXPECT_EQ(real("3", Type::REAL), 3.0);
  EXPECT_EQ(real("16#FF"), 255.0);
  EXPECT_EQ(real("0.1", Type::REAL), static_cast<double>(0.1f));
  EXPECT_EQ(real("16777217", Type::REAL), 16777216.0);
  EXPECT_EQ(real("lreal * 2"), 4.5);
  EXPECT_EQ(real("real * 0.1", Type::REAL), static_cast<double>(1.5f * 0.1f));
  EXPECT_EQ(real("int_ * 0.1"), 300 * 0.1);  // the place is LREAL, so the literal is
  EXPECT_EQ(real("int_ * 0.1", Type::REAL), static_cast<double>(300.0f * 0.1f));
  EXPECT_EQ(real("100_000 * 100_000 * 100_000"), 1e15);
  EXPECT_EQ(real("1.0 / 3", Type::REAL), static_cast<double>(1.0f / 3.0f));
  EXPECT_EQ(integer("sint + 1000", Type::INT), 993);  // 1000 is no SINT: both become INT
  EXPECT_EQ(integer("usint + -1", Type::INT), 199);
  EXPECT_TRUE(truth("usint > -1"));
  EXPECT_TRUE(truth("uint_ < 100_000"));
  EXPECT_TRUE(truth("-1 < 4_000_000_000"));
  EXPECT_TRUE(truth("0.1 + 0.2 <> 0.3"));  // without a place a real literal is an LREAL
  EXPECT_FALSE(accepts("ulint > -1", Type::BOOL));
  EXPECT_FALSE(accepts("-1 < 18_446_744_073_709_551_615", Type::BOOL));
  EXPECT_FALSE(accepts("lint + 0.5", Type::LREAL));
  EXPECT_EQ(error("1E39", Type::REAL), "1: the literal is out of the range of REAL (1.2E-38 to 3.4E38)");
  EXPECT_EQ(error("1E-50", Type::REAL), "1: the literal is out of the range of REAL (1.2E-38 to 3.4E38)");
  EXPECT_TRUE(accepts("1E39", Type::LREAL));
  EXPECT_EQ(error("1E400", Type::LREAL), "1: '1E400' is out of the range of LREAL (2.3E-308 to 1.7E308)");
  EXPECT_EQ(error("1", Type::BOOL),
            "1: the literal 1 does not fit where BOOL is expected; allowed are TRUE and FALSE");
  EXPECT_EQ(error("10", Type::TIME),
            "1: the literal 10 does not fit where TIME is expected; a duration is written T#10ms");
  EXPECT_EQ(error("2.5", Type::INT),
            "1: a REAL or LREAL number does not fit where INT is expected; TO_INT(…) converts it");
}

TEST_F(ExpressionTyping, PowersAreReal) {
  EXPECT_EQ(error("dint ** 2", Type::DINT),
            "6: LREAL does not fit where DINT is expected; TO_DINT(…) converts it");
  EXPECT_TRUE(accepts("real ** 2", Type::REAL));
  EXPECT_TRUE(accepts("int_ ** 2", Type::REAL));
  EXPECT_FALSE(accepts("real ** dint", Type::REAL));
  EXPECT_TRUE(accepts("real ** dint", Type::LREAL));
  EXPECT_FALSE(accepts("lint ** 2", Type::LREAL));
}

TEST_F(ExpressionTyping, WrongTypesAreNamedWithTheirPlace) {
  EXPECT_EQ(error("lreal", Type::INT), "1: LREAL does not fit where INT is expected; TO_INT(…) converts it");
  EXPECT_EQ(error("flag AND lreal", Type::BOOL).substr(0, 45),
            "6: AND has no meaning for BOOL and LREAL; all");
  EXPECT_EQ(error("1 + flag", Type::DINT).substr(0, 48), "3: + has no meaning for the literal 1 and BOOL; ");
  EXPECT_EQ(error("(flag < other)", Type::BOOL),
            "7: < has no meaning for BOOL and BOOL; BOOL is compared with = and <>");
  EXPECT_EQ(error("SEL(1, 2, 3)", Type::DINT),
            "5: the literal 1 does not fit where BOOL is expected; allowed are TRUE and FALSE");
  EXPECT_FALSE(accepts("MUX(lreal, 1, 2)", Type::DINT));
  EXPECT_FALSE(accepts("5", Type::AXIS));
}

TEST_F(ExpressionTyping, AnIntegerDivisionForARealPlaceIsWarnedOf) {
  EXPECT_EQ(warning("dint / 2", Type::LREAL), 6);
  EXPECT_EQ(warning("int_ / 2", Type::REAL), 6);
  EXPECT_EQ(warning("7 / 2", Type::LREAL), 3);
  EXPECT_EQ(real("7 / 2"), 3.0);
  EXPECT_EQ(real("7 / 2 + 0.5"), 3.5);
  EXPECT_EQ(warning("7 / 2 + 0.5", Type::LREAL), 3);
  EXPECT_EQ(warning("lreal * (dint / 2)", Type::LREAL), 15);
  EXPECT_EQ(warning("-(dint / 2) + 1", Type::LREAL), 8);
  EXPECT_EQ(warning("MAX(dint / 2, 5)", Type::LREAL), 10);
  EXPECT_EQ(warning("SEL(flag, int_ / 2, 5)", Type::LREAL), 16);
  EXPECT_EQ(warning("SEL(flag, 3, 5) / 2", Type::LREAL), 17);
  EXPECT_EQ(real("SEL(flag, 3, 5) / 2"), 2.0);
  EXPECT_EQ(warning("SQRT(dint / 2)", Type::LREAL), 11);
  EXPECT_EQ(warning("lreal > dint / 3", Type::BOOL), 14);
  EXPECT_EQ(warning("dint / 2", Type::LINT), 0);
  EXPECT_EQ(warning("dint / 2.0", Type::LREAL), 0);
  EXPECT_EQ(warning("TO_LREAL(dint) / 2", Type::LREAL), 0);
  EXPECT_EQ(warning("TO_LREAL(dint / 2)", Type::LREAL), 0);  // asked for
  EXPECT_EQ(warning("dint MOD 2", Type::LREAL), 0);
  EXPECT_EQ(warning("dint / 2 > 3", Type::BOOL), 0);
  EXPECT_EQ(warning("time / 3", Type::TIME), 0);
  const auto two = compile_expression("dint / 2 + 1.5 * (dint / 3)", Type::LREAL, scope);
  ASSERT_EQ(two.warnings.size(), 2u);
  EXPECT_EQ(two.warnings[1].column, 24);
  EXPECT_EQ(
      two.warnings[0].message,
      "the integer division truncates before its result becomes LREAL; TO_LREAL of an operand keeps the "
      "fraction");
}

TEST_F(ExpressionTyping, ConversionsExistBetweenTheTypesThatTheStandardNames) {
  for (const Tag& from : kTags)
    for (const Tag& to : kTags) {
      const std::string name(type_name(to.type));
      bool exists = true;
      if (is_real(from.type) && is_bit_string(to.type)) exists = size_of(from.type) == size_of(to.type);
      if (is_bit_string(from.type) && is_real(to.type)) exists = size_of(from.type) == size_of(to.type);
      if (from.type == Type::TIME) exists = is_numeric(to.type) || to.type == Type::TIME;
      if (to.type == Type::TIME) exists = is_numeric(from.type) || from.type == Type::TIME;
      EXPECT_EQ(accepts("TO_" + name + "(" + from.name + ")", to.type), exists)
          << from.name << " to " << name;
      EXPECT_EQ(accepts(std::string(type_name(from.type)) + "_TO_" + name + "(" + from.name + ")", to.type),
                exists)
          << from.name << " to " << name;
    }
  EXPECT_FALSE(accepts("INT_TO_REAL(dint)", Type::REAL));
  EXPECT_TRUE(accepts("DINT_TO_REAL(int_)", Type::REAL));
  EXPECT_FALSE(accepts("TO_STRING(dint)", Type::DINT));
  EXPECT_FALSE(accepts("X_TO_INT(dint)", Type::INT));
}

TEST_F(ExpressionTyping, ConversionsWrapIntegersAndSaturateReals) {
  EXPECT_EQ(integer("TO_SINT(int_)", Type::SINT), 44);
  EXPECT_EQ(integer("TO_USINT(sint)", Type::USINT), 249);
  EXPECT_EQ(integer("TO_INT(uint_)", Type::INT), 60000 - 65536);
  EXPECT_EQ(integer("TO_LINT(ulint)"), -1);
  EXPECT_EQ(real("TO_LREAL(ulint)"), 18446744073709551616.0);
  EXPECT_EQ(bits("TO_WORD(sint)", Type::WORD), 0xF9u);  // filled with zeros
  EXPECT_EQ(bits("TO_BYTE(int_)", Type::BYTE), 44u);
  EXPECT_EQ(integer("TO_INT(16#FFFF)", Type::INT), -1);
  EXPECT_EQ(integer("WORD_TO_DINT(16#FFFF)", Type::DINT), 65535);
  EXPECT_EQ(integer("TO_INT(flag)", Type::INT), 1);
  EXPECT_EQ(real("BOOL_TO_LREAL(flag)"), 1.0);
  EXPECT_TRUE(truth("TO_BOOL(word) AND TO_BOOL(lreal) AND NOT TO_BOOL(0) AND NOT TO_BOOL(-0.0)"));
  EXPECT_EQ(bits("REAL_TO_DWORD(real)", Type::DWORD), 0x3FC00000u);
  EXPECT_EQ(bits("LREAL_TO_LWORD(1.0)"), 0x3FF0000000000000u);
  EXPECT_EQ(real("DWORD_TO_REAL(16#3FC00000)", Type::REAL), 1.5);
  EXPECT_EQ(real("LWORD_TO_LREAL(16#3FF0000000000000)"), 1.0);
  EXPECT_EQ(integer("TO_INT(1.5)", Type::INT), 2);
  EXPECT_EQ(integer("TO_INT(2.5)", Type::INT), 2);  // a half goes to the even one
  EXPECT_EQ(integer("TO_INT(-3.5)", Type::INT), -4);
  EXPECT_EQ(integer("TO_INT(32767.4)", Type::INT), 32767);
  EXPECT_EQ(integer("TO_INT(1E9)", Type::INT), 32767);
  EXPECT_EQ(integer("TO_USINT(-0.6)", Type::USINT), 0);
  EXPECT_EQ(integer("TO_LINT(1E30)"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(integer("TO_LINT(-1E30)"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(bits("TO_ULINT(1E30)", Type::ULINT), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(integer("TO_DINT(0.0 / 0.0)", Type::DINT), 0);
  EXPECT_EQ(real("TO_REAL(0.1)", Type::REAL), static_cast<double>(0.1f));
  EXPECT_EQ(real("TO_REAL(lint)", Type::REAL), static_cast<double>(5e9f));
}

TEST_F(ExpressionTyping, DurationsConvertInMilliseconds) {
  EXPECT_EQ(integer("TIME_TO_DINT(time)", Type::DINT), 1500);
  EXPECT_EQ(integer("TO_INT(T#-1999us)", Type::INT), -1);
  EXPECT_EQ(real("TIME_TO_LREAL(T#1500us)"), 1.5);
  EXPECT_EQ(real("TO_REAL(T#100us)", Type::REAL), static_cast<double>(0.1f));
  EXPECT_EQ(integer("TO_TIME(250)", Type::TIME), 250'000'000);
  EXPECT_EQ(integer("TO_TIME(0.25)", Type::TIME), 250'000);
  EXPECT_EQ(integer("TO_TIME(usint)", Type::TIME), 200'000'000);
  EXPECT_EQ(integer("TO_TIME(1E300)", Type::TIME), std::numeric_limits<std::int64_t>::max());
}

}  // namespace
}  // namespace lockstep::expression_typing_test
