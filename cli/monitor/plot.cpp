#include "cli/monitor/plot.hpp"

#include <algorithm>
#include <string_view>

namespace lockstep::cli {
namespace {

constexpr std::size_t kLevels = 8;
constexpr std::string_view kBlocks[kLevels] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::string_view kAscii[kLevels] = {"_", ".", "-", "=", "+", "*", "#", "@"};

std::string_view mark(std::size_t level, Characters characters) {
  return characters == Characters::blocks ? kBlocks[level] : kAscii[level];
}

/// Which of so many equal steps from minimum to maximum; the middle one where there is no distance between
/// them.
std::size_t step_of(double value, const History::Span& whole, std::size_t steps) {
  const double span = whole.maximum - whole.minimum;
  if (!(span > 0.0)) return steps / 2;
  // Halves, so that the difference of the largest numbers does not overflow.
  const double share = (value / 2.0 - whole.minimum / 2.0) / (whole.maximum / 2.0 - whole.minimum / 2.0);
  const double step = std::clamp(share * static_cast<double>(steps), 0.0, static_cast<double>(steps - 1));
  return static_cast<std::size_t>(step);
}

}  // namespace

std::string sparkline(const History& history, std::int64_t window, std::size_t width, Characters characters) {
  const auto whole = history.whole(window);
  std::string line;
  for (const auto& part : history.parts(window, width)) {
    if (part)
      line += mark(step_of(part->minimum / 2.0 + part->maximum / 2.0, *whole, kLevels), characters);
    else
      line += ' ';
  }
  return line;
}

std::vector<std::string> curve(const History& history, std::int64_t window, std::size_t width,
                               std::size_t height, Characters characters) {
  std::vector<std::string> lines(height);
  const auto whole = history.whole(window);
  const std::size_t fine = characters == Characters::blocks ? kLevels : 1;
  for (const auto& part : history.parts(window, width)) {
    const std::size_t from = part ? step_of(part->minimum, *whole, height * fine) : 0;
    const std::size_t to = part ? step_of(part->maximum, *whole, height * fine) : 0;
    for (std::size_t line = 0; line < height; ++line) {
      const std::size_t cell = height - 1 - line;  // from the bottom
      if (!part || from / fine > cell || to / fine < cell)
        lines[line] += ' ';
      else if (fine == 1)
        lines[line] += '*';
      else
        lines[line] += kBlocks[to / fine > cell ? kLevels - 1 : to % fine];
    }
  }
  return lines;
}

}  // namespace lockstep::cli
