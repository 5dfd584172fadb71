/// A compiled program for people: its source beside its internal commands, and what it needs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/aposs/compiler.hpp"

namespace lockstep::aposs {

/// One internal command: "MUL t0, speed, 2".
std::string instruction_text(const Image& image, std::size_t instruction);
/// All of them, each line of the source above those that it became. `sources` are the texts of the files.
std::string listing(const Image& image, const std::vector<std::string>& sources);

/// The most internal commands from an entry to its RETURN; none where a loop may make it any number.
std::optional<std::size_t> longest_run(const Image& image, std::uint16_t entry);
/// Subprograms that interrupts call.
std::vector<Routine> handlers_of(const Image& image);

}  // namespace lockstep::aposs
