/// Reads text files.
#pragma once

#include <stdexcept>
#include <string>

namespace lockstep {

/// The file cannot be read; the text names it and tells why.
struct UnreadableFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The content of a file, or its first `maximum` + 1 bytes. A pipe or a device is no file: nobody knows when
/// it ends.
/// @throws UnreadableFile
std::string read_text_file(const std::string& path, std::size_t maximum);

}  // namespace lockstep
