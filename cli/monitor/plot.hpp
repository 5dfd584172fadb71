/// Curves made of characters.
#pragma once

#include <string>
#include <vector>

#include "cli/monitor/history.hpp"

namespace lockstep::cli {

/// What a terminal can show.
enum class Characters : std::uint8_t { blocks, ascii };

/// A curve of one line, scaled to what is in the window: ▁ is its minimum value, █ its maximum; a blank where
/// nothing has come. In ASCII by `_.-=+*#@`. Each character shows the middle of its time.
std::string sparkline(const History& history, std::int64_t window, std::size_t width, Characters characters);

/// A curve of several lines without axes, from the top; each column shows minimum to maximum of its time.
std::vector<std::string> curve(const History& history, std::int64_t window, std::size_t width,
                               std::size_t height, Characters characters);

}  // namespace lockstep::cli
