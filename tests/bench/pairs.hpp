/// What happens beside ticks, measured next to ticks beside which nothing happens.
#pragma once

#include <functional>
#include <vector>

#include "bench/flooded_machine.hpp"

namespace lockstep::bench {

/// A median, and the interval in which the true one lies by 95 %.
struct Interval {
  double median, low, high;
};
Interval median_of(std::vector<double> values);

/// What happens beside the machine, and what was measured then and next to it.
struct Company {
  const char* name;
  std::function<TickTimes()> run{};
  std::vector<TickTimes> times{}, alone{};

  /// Another pair. @param first whether `alone` is measured before
  void measure(const std::function<TickTimes()>& next_to_it, bool first);
  /// Another pair, of ticks by turns.
  void add(const TurnTimes& pair);
};

/// Medians of both and of their ratio, of the middle ones of the ticks and of their means.
void print(const Company& company);

}  // namespace lockstep::bench
