// How fast programs in APOSS run: ./dev bench aposs [--quick]
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

#include "bench/measure.hpp"
#include "projects/aposs/compiler.hpp"
#include "scheduler/aposs/machine.hpp"
#include "scheduler/aposs/plain_device.hpp"

namespace lockstep::bench {
namespace {

struct Case {
  const char* name;
  const char* text;   ///< runs for ever
  double statements;  ///< simple ones, a turn of the loop
};

// Of each turn the statements are counted as they are written: assignments, comparisons with their jump,
// jumps.
constexpr Case kCases[] = {
    {"assignments, comparison, jump",
     "a = 1\nb = 2\nagain:\na = b\nb = a + 1\nc = b - a\nIF c > 100 THEN\nc = 0\nENDIF\nGOTO again\n", 5},
    {"arithmetic",
     "a = 1\nagain:\na = a * 3 + 7\nb = a % 5 - a mod 7\nc = (a ^ b) & 0xFF\nd = c << 3 | 1\nGOTO again\n",
     5},
    {"elements of an array",
     "DIM f[100]\ni = 1\nagain:\nf[i] = f[i] + i\ni = i + 1\nIF i > 100 THEN\ni = 1\nENDIF\nGOTO again\n", 4},
    {"calls of a subprogram",
     "n = 0\nagain:\nGOSUB s\nGOTO again\nSUBMAINPROG\nSUBPROG s\nn = n + 1\nRETURN\nENDPROG\n", 4},
    {"reading an input", "again:\nIF (IN 1 == 1) AND (n == 0) THEN\nn = 1\nENDIF\nn = 0\nGOTO again\n", 3},
};

void measure_case(const Case& one, bool quick) {
  const aposs::CompiledProgram compiled = aposs::compile_program(one.name, one.text);
  if (!compiled.image) throw std::runtime_error("not compiled: " + std::string(one.name));
  aposs::PlainDevice device;
  aposs::Arrays arrays;
  aposs::Machine machine(device, arrays);
  if (machine.load(*compiled.image) != 0) throw std::runtime_error("not loaded");
  constexpr int kBudget = 1000;
  const Timing timing = measure(
      [&machine, &device](int calls) {
        for (int i = 0; i < calls; ++i) {
          machine.step(kBudget);
          device.advance(1);
        }
      },
      {.runs = quick ? 1 : 7, .calls = quick ? 10 : 2000});
  // The internal commands between the first label and the jump back to it.
  const auto& code = compiled.image->code;
  std::size_t begin = 0, end = 0;
  for (std::size_t i = 0; i < code.size() && end == 0; ++i)
    if (code[i].operation == aposs::Operation::kJump && code[i].a <= i) begin = code[i].a, end = i + 1;
  double turn = static_cast<double>(end - begin);
  if (std::strstr(one.text, "IF")) turn -= 1.0;       // what stands within is left out nearly always
  if (std::strstr(one.text, "GOSUB s")) turn += 2.0;  // the subprogram
  const double command = timing.mean / kBudget;
  std::printf("%-32s %8.2f ns a command %8.2f ns a statement %8.1f million statements/s\n", one.name, command,
              command * turn / one.statements, 1000.0 * one.statements / (command * turn));
}

}  // namespace
}  // namespace lockstep::bench

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
  try {
    for (const auto& one : lockstep::bench::kCases) lockstep::bench::measure_case(one, quick);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
