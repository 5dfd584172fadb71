// lockstep plot: from the rows of a trace to the points that are drawn.
#include <algorithm>
#include <cmath>

#include "cli/plot/picture.hpp"

namespace lockstep::cli {

std::vector<Point> thinned(const std::vector<Point>& points, double begin, double end, int bins) {
  if (points.size() <= 4 * static_cast<std::size_t>(bins)) return points;
  std::vector<Point> result;
  const auto bin_of = [&](const Point& point) {
    return static_cast<int>((point.first - begin) / (end - begin) * bins);
  };
  for (std::size_t first = 0; first < points.size();) {
    std::size_t last = first;  // of the bin
    std::size_t minimum = first, maximum = first;
    while (last + 1 < points.size() && bin_of(points[last + 1]) == bin_of(points[first])) {
      ++last;
      if (points[last].second < points[minimum].second) minimum = last;
      if (points[last].second > points[maximum].second) maximum = last;
    }
    std::size_t kept[] = {first, std::min(minimum, maximum), std::max(minimum, maximum), last};
    for (std::size_t i = 0; i < std::size(kept); ++i)
      if (i == 0 || kept[i] != kept[i - 1]) result.push_back(points[kept[i]]);
    first = last + 1;
  }
  return result;
}

std::vector<std::vector<Point>> pieces_of(const std::vector<double>& t, const std::vector<double>& values,
                                          std::size_t first, std::size_t last, bool wraps) {
  double minimum = INFINITY, maximum = -INFINITY;
  for (std::size_t i = first; i < last; ++i) {
    if (!std::isfinite(values[i])) continue;
    minimum = std::min(minimum, values[i]);
    maximum = std::max(maximum, values[i]);
  }
  const auto step = [&](std::size_t i) { return i > first && i < last ? values[i] - values[i - 1] : 0.0; };
  const auto wraps_at = [&](std::size_t i) {
    const double here = step(i);
    return std::abs(here) > 0.5 * (maximum - minimum) &&
           (step(i - 1) * here < 0.0 || step(i + 1) * here < 0.0);
  };
  std::vector<std::vector<Point>> pieces(1);
  for (std::size_t i = first; i < last; ++i) {
    if (!pieces.back().empty() && (!std::isfinite(values[i]) || (wraps && wraps_at(i))))
      pieces.emplace_back();
    if (std::isfinite(values[i])) pieces.back().emplace_back(t[i], values[i]);
  }
  if (pieces.back().empty()) pieces.pop_back();
  return pieces;
}

}  // namespace lockstep::cli
