#include "scheduler/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "scheduler/program.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/values.hpp"

namespace lockstep::expression_test {
namespace {

using test::integer;
using test::real;

template <class T>
Signal signal_of(T& place) {
  return {&place, type_of<T>(), -1};
}

/// `operation` on two tags, on a tag and a constant, and on two constants.
template <class T>
class Forms {
 public:
  Forms(Operation operation, Type result) : operation_(operation), result_(result) {
    ExpressionBuilder tags;
    tags.signal(signal_of(left_));
    tags.signal(signal_of(right_));
    EXPECT_TRUE(tags.apply(operation, type_of<T>()));
    tags_ = std::move(tags).finish(result);
  }

  std::int64_t of_tags(T left, T right, EvaluationCounters& counters) {
    left_ = left;
    right_ = right;
    return tags_.evaluate(counters).i;
  }
  std::int64_t with_constant(T left, T right, EvaluationCounters& counters) {
    left_ = left;
    ExpressionBuilder code;
    code.signal(signal_of(left_));
    code.constant(integer(right));
    EXPECT_TRUE(code.apply(operation_, type_of<T>()));
    return std::move(code).finish(result_).evaluate(counters).i;
  }
  std::int64_t of_constants(T left, T right, EvaluationCounters& counters) const {
    ExpressionBuilder code;
    code.constant(integer(left));
    code.constant(integer(right));
    EXPECT_TRUE(code.apply(operation_, type_of<T>()));
    return std::move(code).finish(result_).evaluate(counters).i;
  }

 private:
  Operation operation_;
  Type result_;
  T left_{};
  T right_{};
  Expression tags_;
};

template <class T>
std::int64_t reference(Operation operation, int a, int b) {
  switch (operation) {
    case Operation::kAdd:
      return static_cast<T>(a + b);
    case Operation::kSubtract:
      return static_cast<T>(a - b);
    case Operation::kMultiply:
      return static_cast<T>(a * b);
    case Operation::kDivide:
      return b == 0 ? 0 : static_cast<T>(a / b);
    case Operation::kModulo:
      return b == 0 ? 0 : static_cast<T>(a % b);
    case Operation::kMinimum:
      return a < b ? a : b;
    case Operation::kMaximum:
      return a > b ? a : b;
    case Operation::kLess:
      return a < b;
    case Operation::kLessEqual:
      return a <= b;
    case Operation::kGreater:
      return a > b;
    case Operation::kGreaterEqual:
      return a >= b;
    case Operation::kEqual:
      return a == b;
    default:
      return a != b;
  }
}

/// Every pair of values of an 8-bit type.
template <class T>
void check_every_pair() {
  for (const Operation operation :
       {Operation::kAdd, Operation::kSubtract, Operation::kMultiply, Operation::kDivide, Operation::kModulo,
        Operation::kMinimum, Operation::kMaximum, Operation::kLess, Operation::kLessEqual,
        Operation::kGreater, Operation::kGreaterEqual, Operation::kEqual, Operation::kUnequal}) {
    Forms<T> forms(operation, type_of<T>());
    EvaluationCounters counters;
    for (int a = std::numeric_limits<T>::min(); a <= std::numeric_limits<T>::max(); ++a)
      for (int b = std::numeric_limits<T>::min(); b <= std::numeric_limits<T>::max(); ++b) {
        const std::int64_t expected = reference<T>(operation, a, b);
        const auto left = static_cast<T>(a);
        const auto right = static_cast<T>(b);
        ASSERT_EQ(forms.of_tags(left, right, counters), expected) << a << " and " << b;
        if (a % 7 != 0) continue;
        ASSERT_EQ(forms.with_constant(left, right, counters), expected) << a << " and " << b;
        ASSERT_EQ(forms.of_constants(left, right, counters), expected) << a << " and " << b;
      }
    const bool division = operation == Operation::kDivide || operation == Operation::kModulo;
    EXPECT_EQ(counters.integer_divisions_by_zero > 0, division);
  }
}

TEST(Expression, SignedArithmeticWrapsForEveryPairOfEightBits) {
  check_every_pair<SINT>();
}
TEST(Expression, UnsignedArithmeticWrapsForEveryPairOfEightBits) {
  check_every_pair<USINT>();
}

TEST(Expression, TheLeastIntegerDividedByMinusOneWraps) {
  EvaluationCounters counters;
  const auto check = [&]<class T>(T minimum) {
    EXPECT_EQ((Forms<T>(Operation::kDivide, type_of<T>()).of_tags(minimum, T{-1}, counters)), minimum);
    EXPECT_EQ((Forms<T>(Operation::kModulo, type_of<T>()).of_tags(minimum, T{-1}, counters)), 0);
  };
  check(std::numeric_limits<SINT>::min());
  check(std::numeric_limits<INT>::min());
  check(std::numeric_limits<DINT>::min());
  check(std::numeric_limits<LINT>::min());
  EXPECT_EQ(counters.integer_divisions_by_zero, 0u);
}

TEST(Expression, AnUnsignedValueOfSixtyFourBitsIsNotTakenForANegativeOne) {
  EvaluationCounters counters;
  Forms<ULINT> less(Operation::kLess, Type::BOOL);
  EXPECT_EQ(less.of_tags(~ULINT{0}, 1, counters), 0);
  Forms<ULINT> quotient(Operation::kDivide, Type::ULINT);
  EXPECT_EQ(quotient.of_tags(~ULINT{0}, 2, counters), std::numeric_limits<std::int64_t>::max());
}

TEST(Expression, OperationsExistForTheTypesThatTheirDeclarationNamesOnly) {
  for (int t = 0; t <= static_cast<int>(Type::TAG); ++t) {
    const auto type = static_cast<Type>(t);
    const auto exists = [&](Operation operation) {
      ExpressionBuilder code;
      code.constant(integer(1));
      code.constant(integer(1));
      return code.apply(operation, type);
    };
    const bool value = type <= Type::DB_ANY;
    const bool number = value && type != Type::BOOL;
    EXPECT_EQ(exists(Operation::kEqual), value) << type_name(type);
    EXPECT_EQ(exists(Operation::kLess), number) << type_name(type);
    EXPECT_EQ(exists(Operation::kModulo), number && !is_real(type)) << type_name(type);
    EXPECT_EQ(exists(Operation::kPower), is_real(type)) << type_name(type);
    EXPECT_EQ(exists(Operation::kSine), is_real(type)) << type_name(type);
    EXPECT_EQ(exists(Operation::kNegate), number) << type_name(type);
    if (is_signed_integer(type) || is_real(type)) {
      EXPECT_FALSE(exists(Operation::kAnd)) << type_name(type);
      EXPECT_FALSE(exists(Operation::kNot)) << type_name(type);
      EXPECT_FALSE(exists(Operation::kRotateLeft)) << type_name(type);
    }
  }
}

TEST(Expression, RealIsRoundedToSinglePrecisionAfterEachOperation) {
  REAL a = 16777216.0f;
  EvaluationCounters counters;
  ExpressionBuilder code;
  code.signal(signal_of(a));
  code.constant(real(1.0));
  ASSERT_TRUE(code.apply(Operation::kAdd, Type::REAL));
  code.constant(real(1.0));
  ASSERT_TRUE(code.apply(Operation::kAdd, Type::REAL));
  EXPECT_EQ(std::move(code).finish(Type::REAL).evaluate(counters).r, 16777216.0);
  for (const Operation operation : {Operation::kSquareRoot, Operation::kSine, Operation::kNaturalLog}) {
    a = 0.7f;
    ExpressionBuilder function;
    function.signal(signal_of(a));
    ASSERT_TRUE(function.apply(operation, Type::REAL));
    const double result = std::move(function).finish(Type::REAL).evaluate(counters).r;
    EXPECT_EQ(result, static_cast<double>(static_cast<float>(result)));
  }
}

TEST(Expression, RealsBecomeTheNearestIntegerOfTheRange) {
  const double infinity = std::numeric_limits<double>::infinity();
  EvaluationCounters counters;
  double place = 0.0;
  const auto converted = [&](double number, Type to) {
    place = number;
    ExpressionBuilder code;
    code.signal(signal_of(place));
    code.convert(Type::LREAL, to);
    return std::move(code).finish(to).evaluate(counters);
  };
  for (const Type type : {Type::SINT, Type::INT, Type::DINT, Type::LINT, Type::USINT, Type::UINT, Type::UDINT,
                          Type::ULINT, Type::TIME}) {
    const double scale = type == Type::TIME ? 1e-6 : 1.0;  // milliseconds to nanoseconds
    EXPECT_EQ(converted(infinity, type).u, highest(type)) << type_name(type);
    EXPECT_EQ(converted(-infinity, type).i, lowest(type)) << type_name(type);
    EXPECT_EQ(converted(std::numeric_limits<double>::quiet_NaN(), type).u, 0u) << type_name(type);
    EXPECT_EQ(converted(std::ldexp(scale, 64), type).u, highest(type)) << type_name(type);
    EXPECT_EQ(converted(2.5 * scale, type).i, 2) << type_name(type);
    EXPECT_EQ(converted(3.5 * scale, type).i, 4) << type_name(type);
    EXPECT_EQ(converted(-0.5 * scale, type).i, 0) << type_name(type);
  }
  EXPECT_EQ(converted(127.49, Type::SINT).i, 127);
  EXPECT_EQ(converted(-128.5, Type::SINT).i, -128);
  EXPECT_EQ(converted(9007199254740993.0, Type::LINT).i, 9007199254740992);
  EXPECT_EQ(converted(9223372036854774784.0, Type::LINT).i, 9223372036854774784);
  EXPECT_EQ(converted(18446744073709549568.0, Type::ULINT).u, 18446744073709549568u);
}

TEST(Expression, LargeIntegersBecomeTheNearestRealInOneRounding) {
  // Rounded to LREAL first, this would come out half an ulp of REAL too low.
  LINT number = (LINT{1} << 54) + (LINT{1} << 30) + 1;
  EvaluationCounters counters;
  ExpressionBuilder code;
  code.signal(signal_of(number));
  code.convert(Type::LINT, Type::REAL);
  EXPECT_EQ(std::move(code).finish(Type::REAL).evaluate(counters).r,
            static_cast<double>(static_cast<float>(number)));
}

TEST(Expression, SignalsOfEveryTypeAndBitAreLoadedAsTheyAre) {
  EvaluationCounters counters;
  SINT sint = -3;
  UDINT udint = 0xFFFFFFFF;
  REAL real = -0.1f;
  BOOL flag = true;
  LWORD lword{0x8000000000000000};
  EXPECT_EQ(Expression(signal_of(sint)).evaluate(counters).i, -3);
  EXPECT_EQ(Expression(signal_of(udint)).evaluate(counters).u, 0xFFFFFFFFu);
  EXPECT_EQ(Expression(signal_of(real)).evaluate(counters).r, static_cast<double>(-0.1f));
  EXPECT_EQ(Expression(signal_of(flag)).evaluate(counters).u, 1u);
  for (int bit = 0; bit < 64; ++bit) {
    const Expression expression(Signal{&lword, Type::LWORD, static_cast<std::int8_t>(bit)});
    EXPECT_EQ(expression.evaluate(counters).u, bit == 63 ? 1u : 0u);
    EXPECT_EQ(expression.type(), Type::BOOL);
  }
}

TEST(Expression, AConstantSaysSo) {
  EvaluationCounters counters;
  EXPECT_TRUE(Expression().constant());
  EXPECT_EQ(Expression().evaluate(counters).u, 0u);
  const Expression constant(Type::LREAL, real(2.5));
  EXPECT_TRUE(constant.constant());
  EXPECT_EQ(constant.type(), Type::LREAL);
  EXPECT_EQ(constant.evaluate(counters).r, 2.5);
  DINT zero = 0;
  EXPECT_FALSE(Expression(signal_of(zero)).constant());
}

TEST(Expression, AWholeBoolAndNothingElseIsAFlag) {
  bool flag = true;
  DINT number = 1;
  std::uint8_t word = 1;
  EXPECT_EQ(Expression(signal_of(flag)).flag(), &flag);
  EXPECT_EQ(Expression(signal_of(number)).flag(), nullptr);
  EXPECT_EQ(Expression(Signal{&word, Type::BYTE, 0}).flag(), nullptr) << "a bit";
  EXPECT_EQ(Expression(Type::BOOL, integer(1)).flag(), nullptr) << "a constant";
  ExpressionBuilder inverted;
  inverted.signal(signal_of(flag));
  ASSERT_TRUE(inverted.apply(Operation::kNot, Type::BOOL));
  EXPECT_EQ(std::move(inverted).finish(Type::BOOL).flag(), nullptr);
}

TEST(Program, CopiesAFlagIntoAFlag) {
  bool from = true;
  bool to = false;
  Program program("Main", Ob::Main, 0, 0);
  program.add_assignment(Expression(signal_of(from)), signal_of(to));
  EvaluationCounters counters;
  program.run(0, counters);
  EXPECT_TRUE(to);
  from = false;
  program.run(1, counters);
  EXPECT_FALSE(to);
}

/// Counts its calls, and those that found its input TRUE.
struct Counting final : Block {
  bool input = false;
  int calls = 0;
  int found_true = 0;

  void call(std::int64_t /*now*/) noexcept override {
    ++calls;
    found_true += input ? 1 : 0;
  }
};

Expression inverse_of(bool& flag) {
  ExpressionBuilder code;
  code.signal(signal_of(flag));
  EXPECT_TRUE(code.apply(Operation::kNot, Type::BOOL));
  return std::move(code).finish(Type::BOOL);
}

TEST(Program, ACallFollowsTheExpressionAtItsInput) {
  bool off = true;
  Counting block;
  Program program("Main", Ob::Main, 0, 0);
  program.add_assignment(inverse_of(off), signal_of(block.input));
  program.add_call(block);
  EvaluationCounters counters;
  program.run(0, counters);
  EXPECT_EQ(block.found_true, 0);
  off = false;
  program.run(1, counters);
  EXPECT_EQ(block.found_true, 1);
  EXPECT_EQ(block.calls, 2);
}

TEST(Program, ACallBehindABranchIsMadeWhetherOrNotTheBranchIsTaken) {
  bool off = false;
  bool taken = true;
  Counting block;
  Program program("Main", Ob::Main, 0, 0);
  const std::size_t mark = program.begin_branch(Expression(signal_of(taken)));
  program.add_assignment(inverse_of(off), signal_of(block.input));
  program.end_branch(mark);
  program.add_call(block);
  EvaluationCounters counters;
  program.run(0, counters);
  EXPECT_EQ(block.calls, 1);
  EXPECT_EQ(block.found_true, 1);
  taken = false;
  block.input = false;
  program.run(1, counters);
  EXPECT_EQ(block.calls, 2);
  EXPECT_EQ(block.found_true, 1);
}

TEST(Program, AnAlternativeJumpsToWhatFollows) {
  bool off = false;
  bool chosen = true;
  Counting one;
  Counting other;
  Counting last;
  Program program("Main", Ob::Main, 0, 0);
  std::size_t mark = program.begin_branch(Expression(signal_of(chosen)));
  program.add_assignment(inverse_of(off), signal_of(one.input));
  program.add_call(one);
  mark = program.begin_alternative(mark);
  program.add_call(other);
  program.end_branch(mark);
  program.add_call(last);
  EvaluationCounters counters;
  for (const bool choice : {true, false, false}) {
    chosen = choice;
    program.run(0, counters);
  }
  EXPECT_EQ(one.calls, 1);
  EXPECT_EQ(other.calls, 2);
  EXPECT_EQ(last.calls, 3);
}

TEST(Expression, ValuesMayRestUpToTheLimit) {
  DINT one = 1;
  EvaluationCounters counters;
  for (const std::size_t resting :
       {ExpressionBuilder::kMaximumValues, ExpressionBuilder::kMaximumValues + 1}) {
    ExpressionBuilder code;
    for (std::size_t i = 0; i <= resting; ++i) code.signal(signal_of(one));
    for (std::size_t i = 0; i < resting; ++i) ASSERT_TRUE(code.apply(Operation::kAdd, Type::DINT));
    ASSERT_EQ(code.fits(), resting <= ExpressionBuilder::kMaximumValues);
    if (code.fits()) {
      EXPECT_EQ(std::move(code).finish(Type::DINT).evaluate(counters).i,
                static_cast<std::int64_t>(resting) + 1);
    }
  }
}

TEST(Expression, EvaluationTakesNothingFromTheHeap) {
  LREAL speed = 2.0;
  WORD status{0x0101};
  DINT number = 7;
  EvaluationCounters counters;
  std::vector<Expression> expressions;
  ExpressionBuilder product;
  product.signal(signal_of(speed));
  product.constant(real(1.5));
  ASSERT_TRUE(product.apply(Operation::kMultiply, Type::LREAL));
  product.signal(signal_of(speed));
  ASSERT_TRUE(product.apply(Operation::kSine, Type::LREAL));
  ASSERT_TRUE(product.apply(Operation::kPower, Type::LREAL));
  product.convert(Type::LREAL, Type::TIME);
  expressions.push_back(std::move(product).finish(Type::TIME));
  ExpressionBuilder choice;
  for (int i = 0; i < 3; ++i) choice.signal(signal_of(number));
  choice.signal(signal_of(number));
  choice.constant(integer(0));
  ASSERT_TRUE(choice.apply(Operation::kDivide, Type::DINT));
  choice.multiplex(3);
  expressions.push_back(std::move(choice).finish(Type::DINT));
  expressions.emplace_back(Signal{&status, Type::WORD, 8});
  const test::CountAllocations count;
  const std::uint64_t before = test::allocations_counted();
  std::uint64_t sum = 0;
  for (int i = 0; i < 1000; ++i)
    for (const Expression& expression : expressions) sum += expression.evaluate(counters).u;
  EXPECT_EQ(test::allocations_counted(), before);
  EXPECT_EQ(counters.integer_divisions_by_zero, 1000u);
  EXPECT_NE(sum, 0u);
  const Expression copy = expressions.front();  // shows that the counter counts
  EXPECT_GT(test::allocations_counted(), before);
  EXPECT_EQ(copy.evaluate(counters).i, expressions.front().evaluate(counters).i);
}

}  // namespace
TEST(Texts, AreComparedAndAssignedWithoutAllocation) {
  std::string memory(20, '\0');
  const Text kind{memory.data(), memory.size()};
  ExpressionBuilder builder;
  builder.compare_texts({{kind, {}}, {std::nullopt, "a pale ale of some length"}, true});
  builder.compare_texts({{kind, {}}, {kind, {}}, true});
  ASSERT_TRUE(builder.apply(Operation::kOr, Type::BOOL));
  std::optional<Expression> either = std::move(builder).finish(Type::BOOL);
  const Expression copy = *either;
  either.reset();  // a copy does not need what it is of
  Program program("P", Ob::Main, 1, 0);
  program.add_assignment(TextSource{std::nullopt, "a pale ale of some length"}, kind);
  EvaluationCounters counters;
  const test::CountAllocations count;
  const std::uint64_t before = test::allocations_counted();
  for (int i = 0; i < 1000; ++i) {
    program.run(0, counters);
    EXPECT_EQ(copy.evaluate(counters).u, 1u);
  }
  EXPECT_EQ(test::allocations_counted(), before);
  EXPECT_EQ(kind.view(), "a pale ale of some l") << "what has no room is cut off";
}

}  // namespace lockstep::expression_test
