#include "projects/runtime/run_files.hpp"

#include <cstdlib>
#include <filesystem>

namespace lockstep {

namespace fs = std::filesystem;

std::string state_directory() {
  const char* const state = std::getenv("STATE_DIRECTORY");
  if (state == nullptr) return "";
  // Several directories are separated by colons; the first one is ours.
  const std::string directories = state;
  return directories.substr(0, directories.find(':'));
}

std::string path_of_run(const std::string& project_file, const std::string& name) {
  const std::string state = state_directory();
  // What is absolute stays what it is.
  return ((state.empty() ? fs::path(project_file).parent_path() : fs::path(state)) / name).string();
}

}  // namespace lockstep
