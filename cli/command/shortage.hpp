/// What the system does not give a command: file descriptors, memory, threads.
#pragma once

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

namespace lockstep::cli {

/// Something is short; the text is a sentence that says what, and what helps. The exit status is 2.
struct Shortage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Looks whether so many file descriptors can be opened beside those that are, and raises the limit of the
/// process for them as far as it may. Better before the axes move than behind it. @throws Shortage
void require_descriptors(std::size_t count);

/// Looks whether so much memory [byte] can be had, as far as that is told beforehand: a limit of the address
/// space tells it, a limit of a control group ends the process later. @throws Shortage
void require_memory(std::size_t bytes);

/// The text with what helps behind it, if it ends with what the system says of something that is short.
std::string with_help(const std::string& text);

/// Tells why a command has failed, on standard error; needs no memory for what is short itself.
/// @return its exit status: 2 where something was short, else 3, an internal fault
int tell_failure(const std::exception& error) noexcept;

}  // namespace lockstep::cli
