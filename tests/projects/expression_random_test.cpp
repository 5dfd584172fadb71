/// Random expressions against an evaluator of the test's own: integers exactly in 128 bits and then brought
/// into their width, reals in long double and then rounded.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/projects/expression_scope.hpp"
#include "tests/support/property.hpp"

namespace lockstep::expression_random_test {
namespace {

__extension__ typedef __int128 Exact;
__extension__ typedef unsigned __int128 Unsigned;

/// A random text with its type and the value that it has to have.
struct Case {
  std::string text;
  Type type = Type::DINT;
  Exact integer = 0;  ///< integers, bit strings, BOOL, TIME
  double real = 0.0;
};

class RandomExpressions {
 public:
  RandomExpressions(std::uint64_t seed, TestScope& scope) : random_(seed), scope_(scope) {}

  void new_values() {
    scope_.flag = chance(2);
    scope_.sint = static_cast<SINT>(any());
    scope_.int_ = static_cast<INT>(any());
    scope_.dint = static_cast<DINT>(any());
    scope_.lint = static_cast<LINT>(any());
    scope_.usint = static_cast<USINT>(any());
    scope_.uint_ = static_cast<UINT>(any());
    scope_.udint = static_cast<UDINT>(any());
    scope_.ulint = any();
    scope_.byte_ = static_cast<BYTE>(static_cast<std::uint8_t>(any()));
    scope_.word = static_cast<WORD>(static_cast<std::uint16_t>(any()));
    scope_.dword = static_cast<DWORD>(static_cast<std::uint32_t>(any()));
    scope_.lword = static_cast<LWORD>(any());
    scope_.real = std::ldexp(static_cast<float>(static_cast<std::int32_t>(any())), below(30) - 40);
    scope_.lreal = std::ldexp(static_cast<double>(static_cast<std::int64_t>(any())), below(60) - 80);
    divisions_by_zero = 0;
  }

  Case any_case(int depth) {
    switch (below(5)) {
      case 0:
        return truth(depth);
      case 1:
        return bits(depth);
      case 2:
        return real(depth);
      default:
        return integer(depth);
    }
  }

  /// Integer operators, on operands that meet at the type computed here.
  Case integer(int depth) {
    if (depth == 0) return integer_leaf();
    Case a = integer(depth - 1);
    if (chance(6)) return signed_case(a, "-", -a.integer);
    if (chance(8)) return cast(a);
    Case b = integer(depth - 1);
    const auto type = meet(a.type, b.type);
    if (!type) return a;
    switch (below(7)) {
      case 0:
        return made(a, "+", b, *type, a.integer + b.integer);
      case 1:
        return made(a, "-", b, *type, a.integer - b.integer);
      case 2:
        // 64 bits by 64 bits may leave 128 signed bits; the low ones are right all the same.
        return made(a, "*", b, *type, static_cast<Exact>(Unsigned(a.integer) * Unsigned(b.integer)));
      case 3:
      case 4:
        if (b.integer == 0) ++divisions_by_zero;
        if (chance(2)) return made(a, "/", b, *type, b.integer == 0 ? 0 : a.integer / b.integer);
        return made(a, "MOD", b, *type, b.integer == 0 ? 0 : a.integer % b.integer);
      case 5:
        return called("MIN(" + a.text + ", " + b.text + ")", *type, std::min(a.integer, b.integer));
      default:
        return called("MAX(" + a.text + ", " + b.text + ")", *type, std::max(a.integer, b.integer));
    }
  }

  Case truth(int depth) {
    if (depth == 0) return called(chance(2) ? "flag" : "NOT flag", Type::BOOL, 0, true);
    const int kind = below(5);
    if (kind < 2) {
      const Case a = truth(depth - 1);
      const Case b = truth(depth - 1);
      if (kind == 0) return made(a, "AND", b, Type::BOOL, a.integer & b.integer);
      return chance(2) ? made(a, "OR", b, Type::BOOL, a.integer | b.integer)
                       : made(a, "XOR", b, Type::BOOL, a.integer ^ b.integer);
    }
    if (kind == 2) {
      const Case a = real(depth - 1);
      const Case b = real(depth - 1);
      return chance(2) ? made(a, "<", b, Type::BOOL, a.real < b.real)
                       : made(a, "<>", b, Type::BOOL, a.real != b.real);
    }
    const Case a = integer(depth - 1);
    const Case b = integer(depth - 1);
    if (!meet(a.type, b.type)) return truth(depth - 1);
    switch (below(6)) {
      case 0:
        return made(a, "<", b, Type::BOOL, a.integer < b.integer);
      case 1:
        return made(a, "<=", b, Type::BOOL, a.integer <= b.integer);
      case 2:
        return made(a, ">", b, Type::BOOL, a.integer > b.integer);
      case 3:
        return made(a, ">=", b, Type::BOOL, a.integer >= b.integer);
      case 4:
        return made(a, "=", b, Type::BOOL, a.integer == b.integer);
      default:
        return made(a, "<>", b, Type::BOOL, a.integer != b.integer);
    }
  }

  Case bits(int depth) {
    if (depth == 0) {
      switch (below(4)) {
        case 0:
          return called("byte_", Type::BYTE, static_cast<Exact>(scope_.byte_));
        case 1:
          return called("word", Type::WORD, static_cast<Exact>(scope_.word));
        case 2:
          return called("dword", Type::DWORD, static_cast<Exact>(scope_.dword));
        default:
          return called("lword", Type::LWORD, static_cast<Exact>(scope_.lword));
      }
    }
    const Case a = bits(depth - 1);
    if (chance(4)) return called("NOT " + a.text, a.type, static_cast<Exact>(highest(a.type)) - a.integer);
    if (chance(4)) {
      const int n = below(70);
      const Exact moved = n > 63 ? 0 : static_cast<Exact>(static_cast<std::uint64_t>(a.integer)) << n;
      return called("SHL(" + a.text + ", " + std::to_string(n) + ")", a.type, moved);
    }
    const Case b = bits(depth - 1);
    const Type type = size_of(a.type) > size_of(b.type) ? a.type : b.type;
    if (chance(2)) return made(a, "XOR", b, type, a.integer ^ b.integer);
    return chance(2) ? made(a, "&", b, type, a.integer & b.integer)
                     : made(a, "OR", b, type, a.integer | b.integer);
  }

  /// Reals: REAL operations in long double rounded to float, LREAL ones in double.
  Case real(int depth) {
    if (depth == 0) {
      if (chance(4)) return Case{"int_", Type::INT, scope_.int_, static_cast<double>(scope_.int_)};
      return chance(2) ? Case{"real", Type::REAL, 0, static_cast<double>(scope_.real)}
                       : Case{"lreal", Type::LREAL, 0, scope_.lreal};
    }
    const Case a = real(depth - 1);
    Case b = real(depth - 1);
    if (is_integer(a.type) && is_integer(b.type)) b = Case{"lreal", Type::LREAL, 0, scope_.lreal};
    const Type type = a.type == Type::LREAL || b.type == Type::LREAL ? Type::LREAL : Type::REAL;
    const long double x = a.real;
    const long double y = b.real;
    switch (below(5)) {
      case 0:
        return rounded(a, "+", b, type, type == Type::REAL ? x + y : a.real + b.real);
      case 1:
        return rounded(a, "-", b, type, type == Type::REAL ? x - y : a.real - b.real);
      case 2:
        return rounded(a, "*", b, type, type == Type::REAL ? x * y : a.real * b.real);
      case 3:
        return rounded(a, "/", b, type, type == Type::REAL ? x / y : a.real / b.real);
      default:
        return Case{"SEL(flag, " + a.text + ", " + b.text + ")", type, 0, scope_.flag ? b.real : a.real};
    }
  }

  std::uint64_t divisions_by_zero = 0;

 private:
  /// Numbers of every magnitude: small ones and the ends of ranges are as frequent as large ones.
  std::uint64_t any() {
    const std::uint64_t wide = (std::uint64_t{random_()} << 32) | random_();
    switch (below(4)) {
      case 0:
        return wide >> below(64);
      case 1:
        return ~(wide >> below(64));
      case 2:
        return (std::uint64_t{1} << below(64)) - 1;
      default:
        return std::uint64_t{0} - (std::uint64_t{1} << below(64));
    }
  }
  int below(int limit) { return static_cast<int>(random_() % static_cast<std::uint32_t>(limit)); }
  bool chance(int one_in) { return below(one_in) == 0; }

  Case integer_leaf() {
    switch (below(8)) {
      case 0:
        return called("sint", Type::SINT, scope_.sint);
      case 1:
        return called("int_", Type::INT, scope_.int_);
      case 2:
        return called("dint", Type::DINT, scope_.dint);
      case 3:
        return called("lint", Type::LINT, scope_.lint);
      case 4:
        return called("usint", Type::USINT, scope_.usint);
      case 5:
        return called("uint_", Type::UINT, scope_.uint_);
      case 6:
        return called("udint", Type::UDINT, scope_.udint);
      default:
        return called("ulint", Type::ULINT, static_cast<Exact>(scope_.ulint));
    }
  }

  /// The smallest integer type for both, written as the chains of the contract read.
  static std::optional<Type> meet(Type a, Type b) {
    const auto width = [](Type type) { return 8 * size_of(type); };
    const bool sa = is_signed_integer(a);
    const bool sb = is_signed_integer(b);
    if (sa == sb) return width(a) >= width(b) ? a : b;
    // A signed type has to be wider than the unsigned one.
    const int needed = std::max(width(sa ? a : b), 2 * width(sa ? b : a));
    for (const Type type : {Type::INT, Type::DINT, Type::LINT})
      if (width(type) == needed) return type;
    return std::nullopt;
  }

  static Exact wrapped(Exact value, Type type) {
    const Exact modulus = static_cast<Exact>(1) << (8 * size_of(type));
    Exact low = value % modulus;
    if (low < 0) low += modulus;
    return is_signed_integer(type) && low > static_cast<Exact>(highest(type)) ? low - modulus : low;
  }

  Case called(const std::string& text, Type type, Exact value, bool is_flag = false) const {
    if (is_flag) return Case{text, type, (text == "flag") == scope_.flag ? 1 : 0, 0.0};
    return Case{text, type, type == Type::BOOL ? value : wrapped(value, type), 0.0};
  }
  Case made(const Case& a, const std::string& sign, const Case& b, Type type, Exact value) const {
    return called("(" + a.text + " " + sign + " " + b.text + ")", type, value);
  }
  Case signed_case(const Case& a, const std::string& sign, Exact value) const {
    return called("(" + sign + a.text + ")", a.type, value);
  }
  static Case rounded(const Case& a, const std::string& sign, const Case& b, Type type, long double value) {
    const double result =
        type == Type::REAL ? static_cast<double>(static_cast<float>(value)) : static_cast<double>(value);
    return Case{"(" + a.text + " " + sign + " " + b.text + ")", type, 0, result};
  }
  Case cast(const Case& a) {
    const Type types[] = {Type::SINT,  Type::INT,  Type::DINT,  Type::LINT,
                          Type::USINT, Type::UINT, Type::UDINT, Type::ULINT};
    const Type to = types[below(8)];
    return called("TO_" + std::string(type_name(to)) + "(" + a.text + ")", to, a.integer);
  }

  std::mt19937 random_;
  TestScope& scope_;
};

TEST(RandomExpressions, AgreeWithAnIndependentEvaluator) {
  TestScope scope;
  RandomExpressions random(test::seed_of_test(31415), scope);
  int reals = 0;
  std::uint64_t divisions = 0;
  for (int i = 0; i < test::cases(60'000, 6'000'000); ++i) {
    random.new_values();
    const Case expected = random.any_case(1 + i % 5);
    const CompiledExpression compiled = compile_expression(expected.text, expected.type, scope);
    ASSERT_TRUE(compiled.expression) << expected.text << " as " << type_name(expected.type) << ": "
                                     << compiled.errors.front().message;
    EvaluationCounters counters;
    const Value value = compiled.expression->evaluate(counters);
    if (is_real(expected.type)) {
      ++reals;
      if (std::isnan(expected.real))
        ASSERT_TRUE(std::isnan(value.r)) << expected.text;
      else
        ASSERT_EQ(value.r, expected.real) << expected.text;
    } else if (is_signed_integer(expected.type)) {
      ASSERT_EQ(value.i, static_cast<std::int64_t>(expected.integer)) << expected.text;
    } else {
      ASSERT_EQ(value.u, static_cast<std::uint64_t>(expected.integer)) << expected.text;
    }
    divisions += counters.integer_divisions_by_zero;
    // Operands that were thrown away by the generator may have divided, so the count is only an upper bound.
    ASSERT_LE(counters.integer_divisions_by_zero, random.divisions_by_zero) << expected.text;
  }
  EXPECT_GT(reals, 5000);
  EXPECT_GT(divisions, 100u);
}

/// The same text with literals in place of tags is computed while loading, and comes to the same.
TEST(RandomExpressions, ComputeTheSameWhileLoadingAndInTheCycle) {
  TestScope scope;
  RandomExpressions random(test::seed_of_test(27182), scope);
  const auto literal = [](const std::string& type, auto value) { return type + "#" + std::to_string(value); };
  for (int i = 0; i < test::cases(20'000, 2'000'000); ++i) {
    random.new_values();
    const Case integer = random.integer(1 + i % 4);
    std::string text;
    for (std::size_t at = 0; at < integer.text.size();) {
      const std::vector<std::pair<std::string, std::string>> tags = {
          {"usint", literal("USINT", scope.usint)}, {"uint_", literal("UINT", scope.uint_)},
          {"udint", literal("UDINT", scope.udint)}, {"ulint", literal("ULINT", scope.ulint)},
          {"sint", literal("SINT", scope.sint)},    {"int_", literal("INT", scope.int_)},
          {"dint", literal("DINT", scope.dint)},    {"lint", literal("LINT", scope.lint)}};
      bool found = false;
      for (const auto& [tag, value] : tags)
        if (!found && integer.text.compare(at, tag.size(), tag) == 0) {
          text += value;
          at += tag.size();
          found = true;
        }
      if (!found) text += integer.text[at++];
    }
    const CompiledExpression folded = compile_expression(text, integer.type, scope);
    const CompiledExpression loaded = compile_expression(integer.text, integer.type, scope);
    ASSERT_TRUE(folded.expression && loaded.expression) << text;
    EvaluationCounters first;
    EvaluationCounters second;
    ASSERT_EQ(folded.expression->evaluate(first).u, loaded.expression->evaluate(second).u) << text;
    ASSERT_EQ(first.integer_divisions_by_zero, second.integer_divisions_by_zero) << text;
    ASSERT_EQ(folded.expression->constant(), second.integer_divisions_by_zero == 0) << text;
  }
}

}  // namespace
}  // namespace lockstep::expression_random_test
