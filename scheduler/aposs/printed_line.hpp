/// Printed lines for people; outside of the cycle.
#pragma once

#include <span>
#include <string>

#include "scheduler/aposs/print_queue.hpp"

namespace lockstep::aposs {

/// A line of text as it was printed, put together from its items. True where the line has ended.
/// @param texts those of the image
bool append_printed(std::string& line, std::span<const std::string> texts, const Printed& item);

}  // namespace lockstep::aposs
