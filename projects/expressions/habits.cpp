// What other languages write. The examples are run by `language_examples_test`.
#include "projects/expressions/habits.hpp"

#include <algorithm>
#include <iterator>

#include "projects/expressions/letters.hpp"

namespace lockstep {
namespace {

using enum Type;

constexpr std::string_view kAssignment =
    R"(an assignment is an entry of its own, { "set": "n", "to": "n + 1" }; in an expression = compares)";
constexpr std::string_view kTexts =
    "texts are assigned, compared with = and <> and chosen with SEL and MUX; nothing joins or cuts them";
constexpr Example kText{"SEL(TRUE, 'a', 'b') = 'b'", BOOL, "TRUE"};

constexpr Habit kHabits[] = {
    {"==", "equal is =", {"2 = 2", BOOL, "TRUE"}},
    {"!=", "not equal is <>", {"2 <> 2", BOOL, "FALSE"}},
    {"=<", "less or equal is <=", {"1 <= 2", BOOL, "TRUE"}},
    {"=>", "greater or equal is >=; an output of a block is read as instance.Pin", {"1 >= 2", BOOL, "FALSE"}},
    {"&&", "and is AND, or &", {"TRUE AND FALSE", BOOL, "FALSE"}},
    {"||", "or is OR", {"TRUE OR FALSE", BOOL, "TRUE"}},
    {"|", "or is OR", {"BYTE#1 OR BYTE#2", BYTE, "16#03"}},
    {"!", "not is NOT", {"NOT TRUE", BOOL, "FALSE"}},
    {"~", "not is NOT", {"NOT BYTE#16#0F", BYTE, "16#F0"}},
    {"^", "a power is **, exclusive or is XOR", {"2.0 ** 3", LREAL, "8.0"}},
    {"%", "a remainder is MOD, a bit is .X0", {"7 MOD 4", INT, "3"}},
    {"<<", "a shift is SHL(IN, N)", {"SHL(WORD#1, 4)", WORD, "16#0010"}},
    {">>", "a shift is SHR(IN, N)", {"SHR(WORD#16, 4)", WORD, "16#0001"}},
    {"?", "a choice is SEL(G, IN0, IN1), IN1 where G is TRUE", {"SEL(TRUE, 1, 2)", INT, "2"}},
    {":=", kAssignment, {}},
    {"+=", kAssignment, {}},
    {"-=", kAssignment, {}},
    {"*=", kAssignment, {}},
    {"/=", kAssignment, {}},
    {";", R"(an expression ends without it; each assignment is an entry, { "set": "n", "to": "n + 1" })", {}},
    {"#", "names stand without # before them", {}},
    {"\"", "a name stands without quotation marks, a text in apostrophes", {"'a' = 'a'", BOOL, "TRUE"}},
    {"{", "an array is declared as a tag, and chosen from with [ ] or MUX", {"MUX(1, 5, 6)", INT, "6"}},
    {"NORM_X",
     "(VALUE - MIN) / (MAX - MIN), with TO_LREAL(VALUE) of an integer",
     {"(TO_LREAL(INT#5) - 0.0) / (10.0 - 0.0)", LREAL, "0.5"}},
    {"SCALE_X",
     "VALUE * (MAX - MIN) + MIN, in TO_INT( ) where an integer is wanted",
     {"TO_INT(0.25 * (100.0 - 20.0) + 20.0)", INT, "40"}},
    {"SQR", "IN * IN, or IN ** 2", {"3.0 ** 2", LREAL, "9.0"}},
    {"POW", "EXPT(IN1, IN2), or IN1 ** IN2", {"EXPT(2.0, 3)", LREAL, "8.0"}},
    {"FRAC", "IN - TO_LREAL(TRUNC(IN))", {"2.75 - TO_LREAL(TRUNC(2.75))", LREAL, "0.75"}},
    {"CEILING", "CEIL(IN)", {"CEIL(1.2)", DINT, "2"}},
    {"FABS", "ABS(IN)", {"ABS(-1.5)", LREAL, "1.5"}},
    {"IIF", "SEL(G, IN0, IN1), IN1 where G is TRUE", {"SEL(FALSE, 1, 2)", INT, "1"}},
    {"IF",
     R"(an entry of its own, { "if": "…", "then": [ … ], "else": [ … ] }; within an expression SEL)",
     {"SEL(TRUE, 1, 2)", INT, "2"}},
    {"CONCAT", kTexts, kText},
    {"LEN", kTexts, kText},
    {"LEFT", kTexts, kText},
    {"RIGHT", kTexts, kText},
    {"MID", kTexts, kText},
    {"FIND", kTexts, kText},
    {"INSERT", kTexts, kText},
    {"DELETE", kTexts, kText},
    {"REPLACE", kTexts, kText}};

bool is_sign(const Habit& habit) noexcept {
  return !is_letter(habit.written.front());
}

}  // namespace

std::span<const Habit> habits() noexcept {
  return kHabits;
}

const Habit* habit_sign(std::string_view text) noexcept {
  const Habit* longest = nullptr;
  for (const Habit& habit : kHabits)
    if (is_sign(habit) && text.starts_with(habit.written) &&
        (longest == nullptr || habit.written.size() > longest->written.size()))
      longest = &habit;
  return longest;
}

const Habit* habit_of(std::string_view name) noexcept {
  const auto* const found = std::ranges::find(kHabits, name, &Habit::written);
  return found == std::end(kHabits) ? nullptr : found;
}

}  // namespace lockstep
