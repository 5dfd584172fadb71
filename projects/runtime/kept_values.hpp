/// Values that are kept across runs.
#pragma once

#include <memory>
#include <string>

#include "hmi_bridge/retain/writer.hpp"
#include "projects/loader/project.hpp"
#include "projects/runtime/messages.hpp"
#include "projects/runtime/run_options.hpp"

namespace lockstep {

/// Where the values of a project are kept: as the options say, else the project, else in the state
/// directory that systemd gives to a service, else beside the project file.
std::string retain_path(const Project& project, const RunOptions& options);

/// Gives the kept values back to a project that is being loaded, and tells what came back.
/// @return what keeps them from now on; nullptr if there is nothing to keep or nobody wants it kept
/// @throws RetainFileError if the file cannot be used
std::unique_ptr<RetainWriter> restore_kept(Project& project, const RunOptions& options, Messages& messages);

}  // namespace lockstep
