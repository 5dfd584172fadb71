/// The view of the monitor: a pure function from model, time and size to lines.
#pragma once

#include <string>
#include <vector>

#include "cli/monitor/model.hpp"
#include "cli/monitor/plot.hpp"

namespace lockstep::cli {

/// How a line looks.
enum class Look : std::uint8_t { plain, title, heading, chosen, alarm, panel, keys };

struct ViewLine {
  std::string text;  ///< UTF-8, no wider than the view, without control characters
  Look look = Look::plain;
};

struct ViewSize {
  std::size_t width = 80;
  std::size_t height = 24;
};

/// As many lines as the view is high. In ASCII there is no other character.
std::vector<ViewLine> view(const Model& model, Model::Clock::time_point now, ViewSize size,
                           Characters characters);

/// How many signals a page of the table has, for a key that turns it.
std::size_t page_of(const Model& model, ViewSize size);

}  // namespace lockstep::cli
