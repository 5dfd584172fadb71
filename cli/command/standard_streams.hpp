/// Standard input, output and error as a command finds them.
#pragma once

#include <stdexcept>
#include <string>

namespace lockstep::cli {

/// Standard output does not take what it is given; the text says why. The exit status is 2.
struct OutputFailed : std::runtime_error {
  explicit OutputFailed(int error);
  int error;  ///< errno; 0: not known any more
};

/// Opens those of 0, 1, 2 that are closed on /dev/null, in the direction that is of no use: else the next
/// file or socket that is opened would be one of them, and what is printed would go there. What a command
/// writes to such a standard output fails. First thing in the program.
void open_missing_streams() noexcept;

/// Writes data to standard output, at once. @throws OutputFailed
void write_data(const std::string& text);

/// At the end: whether all that was written has been taken. @throws OutputFailed
void finish_output();

}  // namespace lockstep::cli
