/// Reads text files.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace lockstep {

/// The file cannot be read; the text names it and tells why.
struct UnreadableFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The content of a file, or its first `maximum` + 1 bytes. A pipe or a device is no file: nobody knows when
/// it ends.
/// @throws UnreadableFile
std::string read_text_file(const std::string& path, std::size_t maximum);

/// The text behind the byte order mark of UTF-8 with which spreadsheets begin a file.
inline std::string_view without_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

}  // namespace lockstep
