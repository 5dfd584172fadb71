// What a tick of many axes takes on several processors, of what it takes on one: ./dev bench processors.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>
#include <thread>
#include <vector>

#include "bench/machine.hpp"

namespace lockstep::bench {
namespace {

constexpr int kAxes = 10'000;
constexpr double kTarget = 0.6;  // of one processor, with two

struct Plan {
  int axes = kAxes;
  int rounds = 40;
  int cycles = 25;  // of each machine in a round
};

// Of one cycle, as a clock on the wall sees it [us].
double time_of(Machine& machine, int cycles) {
  const auto begin = std::chrono::steady_clock::now();
  machine.run(cycles);
  const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
  return time.count() / cycles;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Both machines by turns, so that what disturbs the one disturbs the other.
void compare(const Plan& plan, int processors) {
  Machine alone({.motion = Motion::gear, .axes = plan.axes});
  Machine together({.motion = Motion::gear, .axes = plan.axes, .processors = processors});
  std::vector<double> of_one;
  std::vector<double> of_several;
  std::vector<double> shares;
  for (int round = 0; round < plan.rounds; ++round) {
    of_one.push_back(time_of(alone, plan.cycles));
    of_several.push_back(time_of(together, plan.cycles));
    shares.push_back(of_several.back() / of_one.back());
  }
  std::printf("%d axes in gear: a tick takes %.1f us on one processor, %.1f us on %d\n", plan.axes,
              median(of_one), median(of_several), processors);
  std::printf("%.3f of one by the median of %d rounds, %.3f in the best%s\n", median(shares), plan.rounds,
              *std::min_element(shares.begin(), shares.end()),
              processors == 2 && plan.axes == kAxes
                  ? (median(shares) <= kTarget ? "; at most 0.6 is wanted, and held"
                                               : "; at most 0.6 is wanted, and missed")
                  : "");
}

int run(int count, char** arguments) {
  Plan plan;
  int processors = 2;
  if (count == 2 && std::string_view(arguments[1]) == "--quick") {
    plan = {.axes = 200, .rounds = 3, .cycles = 10};
  } else if (count == 2 && std::atoi(arguments[1]) >= 2) {
    processors = std::atoi(arguments[1]);
  } else if (count > 1) {
    std::fputs("usage: processors_bench [PROCESSORS, 2 if not given, at least 2 | --quick]\n", stderr);
    return 2;
  }
  const auto there = static_cast<int>(std::thread::hardware_concurrency());
  if (there < processors) {
    std::printf("this machine has %d processors: %d cannot be compared\n", there, processors);
    return plan.axes == kAxes ? 1 : 0;
  }
  compare(plan, processors);
  return 0;
}

}  // namespace
}  // namespace lockstep::bench

int main(int count, char** arguments) {
  try {
    return lockstep::bench::run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "processors_bench: %s\n", error.what());
    return 1;
  }
}
