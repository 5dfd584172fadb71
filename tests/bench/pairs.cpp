#include "bench/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lockstep::bench {
namespace {

std::vector<double> column(const std::vector<TickTimes>& times, double TickTimes::*member) {
  std::vector<double> values;
  for (const TickTimes& time : times) values.push_back(time.*member);
  return values;
}

void print(const Company& company, double TickTimes::*member) {
  const std::vector<double> times = column(company.times, member);
  const std::vector<double> alone = column(company.alone, member);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < times.size(); ++i) ratios.push_back(times[i] / alone[i]);
  const Interval ratio = median_of(ratios);
  std::printf("  %6.2f %6.2f  %5.3f (%5.3f-%5.3f)", median_of(alone).median, median_of(times).median,
              ratio.median, ratio.low, ratio.high);
}

}  // namespace

/// Of how many values lie below the median the deviation is half the root of their number.
Interval median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double middle = 0.5 * static_cast<double>(values.size() - 1);
  const double reach = 0.98 * std::sqrt(static_cast<double>(values.size()));
  const auto at = [&](double place) {
    return values[static_cast<std::size_t>(std::clamp(place, 0.0, 2.0 * middle))];
  };
  return {at(middle), at(std::floor(middle - reach)), at(std::ceil(middle + reach))};
}

void Company::measure(const std::function<TickTimes()>& next_to_it, bool first) {
  if (first) alone.push_back(next_to_it());
  times.push_back(run());
  if (!first) alone.push_back(next_to_it());
}

void Company::add(const TurnTimes& pair) {
  times.push_back(pair.with);
  alone.push_back(pair.without);
}

void print(const Company& company) {
  std::printf("  %-16s", company.name);
  print(company, &TickTimes::median);
  print(company, &TickTimes::mean);
  std::printf("\n");
}

}  // namespace lockstep::bench
