/// What masters sent on the lines to LinMot controllers, and what was answered.
#pragma once

#include <fstream>
#include <string>

#include "projects/loader/project.hpp"

namespace lockstep::cli {

/// A CSV file: t,line,request,answer, in the order of the answers. What is no letter that can be shown is
/// "?".
class Transcript {
 public:
  /// Without a name nothing is written. @throws CouldNotStart if the file cannot be written, or the project
  /// has no line
  Transcript(const std::string& path, const Project& project);
  /// At the end of a run. @return whether all of it is written
  bool write(const Project& project);

 private:
  std::string path_;
  std::ofstream file_;
};

}  // namespace lockstep::cli
