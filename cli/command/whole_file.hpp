/// Files that are written whole or not at all.
#pragma once

#include <string>

namespace lockstep::cli {

/// Puts a text into a file, in place of what was there: it is written beside it, under another name, and
/// takes its place when it is whole. Where that is not so the old file stays as it is. A symbolic link goes
/// on pointing to where it does; a pipe or a device gets the text as it is.
/// @throws std::runtime_error that names the path and says why
void write_whole_file(const std::string& path, const std::string& text);

/// Whether there may be such a file, before there is anything to write. Nothing changes.
/// @throws std::runtime_error as above
void require_writable(const std::string& path);

}  // namespace lockstep::cli
