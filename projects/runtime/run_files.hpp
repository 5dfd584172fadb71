/// Where the files of a run stand that a project names without saying where.
#pragma once

#include <string>

namespace lockstep {

/// The directory that systemd gives a service for what it keeps ($STATE_DIRECTORY, the first one of it);
/// empty: this is no service.
std::string state_directory();

/// Where a file stands that a run writes: a relative name is relative to the state directory, or, without
/// one, to the project file, from wherever the program was started.
std::string path_of_run(const std::string& project_file, const std::string& name);

}  // namespace lockstep
