/// Writes computed delay times into project files.
#pragma once

#include <string>
#include <vector>

#include "projects/system/connections.hpp"

namespace lockstep {

/// A file with its delays changed.
struct ChangedFile {
  std::string path;
  std::string text;
  int delays = 0;  ///< that are others now
};

/// What `with_delays` gives: nothing is to be written if there are problems.
struct ChangedFiles {
  std::vector<ChangedFile> files;
  std::vector<std::string> problems;
};

/// The project files of a system, and those that they include, with the computed delays in place of the
/// configured ones; no other byte of them changes. A delay that is not there yet is put at the beginning of
/// the structure to which it belongs. What is fixed, recursive or as it should be stays.
ChangedFiles with_delays(const System& system, const Connections& connections);

/// Puts a text in place of a file, whole or not at all; a symbolic link goes on pointing to where it does.
/// @throws std::system_error
void replace_file(const std::string& named, const std::string& text);

}  // namespace lockstep
