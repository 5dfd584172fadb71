// Random programs that come to an end by their making: whatever their budget, with the same variables, within
// what they may take, and without an allocation.
#include <random>

#include "tests/projects/aposs/program_run.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/property.hpp"

namespace lockstep::aposs::random_program_test {
namespace {

/// Loops turn at most three times and stand at most three deep, jumps lead ahead, a subprogram calls only
/// those behind it, from no more than one loop: so each program ends soon.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  std::string program() {
    text_ = "DIM f[7], g[3]\n";
    if (chance(3)) text_ += "ON ERROR GOSUB trouble\n";
    for (const char* name : {"a", "b", "c", "d"}) line(std::string(name) + " = " + number());
    block(0, 0, 12);
    text_ += "SUBMAINPROG\n";
    for (int i = 1; i <= kSubprograms; ++i) {
      text_ += "SUBPROG s" + std::to_string(i) + "\n";
      block(1, i, 3);
      text_ += "RETURN\n";
    }
    return text_ + "SUBPROG trouble\nt = t + ERRNO\nERRCLR\nRETURN\nENDPROG\n";
  }

 private:
  static constexpr int kSubprograms = 3, kDeepest = 3;

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  bool chance(int of) { return below(of) == 0; }
  void line(const std::string& text) { text_ += text + "\n"; }

  std::string number() {
    constexpr const char* kNumbers[] = {"0",    "1",  "3", "7", "100", "0x7FFFFFFF", "(-1)", "(-2147483647)",
                                        "0x80", "'A'"};
    return kNumbers[below(std::size(kNumbers))];
  }
  std::string variable() { return std::string(1, static_cast<char>('a' + below(4))); }
  std::string element() {
    // Now and then outside: error 171, of which the program knows or ends.
    const std::string index = chance(12) ? variable() : std::to_string(1 + below(3));
    return (chance(2) ? "f[" : "g[") + index + "]";
  }
  std::string primary(int deep) {
    switch (below(deep > 3 ? 3 : 6)) {
      case 0:
        return variable();
      case 1:
        return number();
      case 2:
        return element();
      case 3:
        return "(" + expression(deep + 1) + ")";
      case 4:
        return variable() + (chance(2) ? ".b1" : ".3");
      default:
        return (chance(2) ? "ABS " : "~") + variable();
    }
  }
  std::string expression(int deep = 0) {
    constexpr const char* kOperators[] = {"+", "-", "*", "%",  "mod", "rnd", "&", "|",
                                          "^", "<", ">", "==", "!=",  "<<",  ">>"};
    std::string text = primary(deep);
    for (int i = below(3); i > 0; --i)
      text += std::string(" ") + kOperators[below(std::size(kOperators))] + " " + primary(deep);
    return text;
  }
  void statement(int deep, int routine) {
    switch (below(deep >= kDeepest ? 5 : 9)) {
      case 0:
      case 1:
        return line(variable() + " = " + expression());
      case 2:
        return line(element() + " = " + expression());
      case 3:
        return line("PRINT \"x\", " + variable());
      case 4:
        if (routine >= kSubprograms || deep > 1) return line(variable() + ".2 = " + primary(3));
        return line("GOSUB s" + std::to_string(routine + 1 + below(kSubprograms - routine)));
      case 5:
        line("IF " + expression() + " THEN");
        block(deep + 1, routine, 3);
        if (chance(2)) {
          line("ELSE");
          block(deep + 1, routine, 2);
        }
        return line("ENDIF");
      case 6:
        return counted(deep, routine, "WHILE (", ") DO", "ENDWHILE", " < ");
      case 7: {
        const std::string label = "l" + std::to_string(++names_);
        line(label + ":");
        block(deep + 1, routine, 2);
        return line("LOOP " + std::to_string(below(3)) + " " + label);
      }
      default: {
        const std::string label = "l" + std::to_string(++names_);
        line("GOTO " + label);
        block(deep + 1, routine, 2);
        return line(label + ":\nb = b + 1");
      }
    }
  }
  void counted(int deep, int routine, const char* begin, const char* middle, const char* end,
               const char* compare) {
    const std::string counter = "k" + std::to_string(++names_);
    line(counter + " = 0");
    line(begin + counter + compare + std::to_string(below(4)) + middle);
    line(counter + " = " + counter + " + 1");
    block(deep + 1, routine, 3);
    line(end);
  }
  void block(int deep, int routine, int longest) {
    for (int i = 1 + below(longest); i > 0; --i) statement(deep, routine);
  }

  std::mt19937_64 random_;
  std::string text_;
  int names_ = 0;
};

struct Ended {
  std::vector<std::int32_t> cells;
  std::uint64_t commands = 0;
  ProgramState state{};
};

Ended run(const CompiledProgram& program, std::int32_t budget) {
  PlainDevice device;
  Arrays arrays;
  Machine machine(device, arrays);
  EXPECT_EQ(machine.load(*program.image), 0);
  constexpr int kSteps = 2'000'000;
  const std::uint64_t before = test::allocations_counted();
  {
    const test::CountAllocations counting;
    for (int i = 0; i < kSteps && !machine.over(); ++i) {
      const std::uint64_t commands = machine.counters().commands;
      machine.step(budget);
      if (machine.counters().commands - commands > static_cast<std::uint64_t>(budget)) {
        ADD_FAILURE() << "more than its budget";
        break;
      }
      device.advance(1);
    }
  }
  EXPECT_EQ(test::allocations_counted(), before);
  EXPECT_TRUE(machine.over()) << machine.counters().commands << " internal commands";
  Ended ended{{}, machine.counters().commands, machine.state()};
  for (std::size_t i = 0; i < program.image->variables.size(); ++i)
    ended.cells.push_back(machine.variable(i));
  return ended;
}

TEST(AposRandomPrograms, ComeToTheSameEndWithEveryBudget) {
  std::uint64_t longest = 0;
  int with_error = 0;
  const test::Cases cases = test::for_each_seed(1, test::cases(3'000, 100'000), [&](const test::Case& one) {
    const std::string text = Generator(one.seed).program();
    const CompiledProgram compiled = compile_program("x.m", text, {}, {.maximum_variables = 1000});
    ASSERT_TRUE(compiled.image) << to_string(compiled.files, compiled.errors.at(0)) << "\n" << text;
    ASSERT_EQ(compiled.image->fault(), 0);
    const Ended whole = run(compiled, 100'000);
    for (const std::int32_t budget : {1, 2 + static_cast<std::int32_t>(one.seed % 97)}) {
      const Ended parts = run(compiled, budget);
      ASSERT_EQ(parts.cells, whole.cells) << "budget " << budget << "\n" << text;
      ASSERT_EQ(parts.state, whole.state);
      ASSERT_EQ(parts.commands, whole.commands);
    }
    longest = std::max(longest, whole.commands);
    with_error += whole.state == ProgramState::kError ? 1 : 0;
  });
  if (cases.alone) return;
  EXPECT_GT(longest, 1'000u) << "they do something";
  EXPECT_GT(with_error, cases.count / 50) << "some end by an error";
  EXPECT_LT(with_error, cases.count * 3 / 4);
}

}  // namespace
}  // namespace lockstep::aposs::random_program_test
