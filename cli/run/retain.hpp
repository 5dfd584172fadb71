/// lockstep run: values that are kept across runs.
#pragma once

#include <memory>
#include <string>

#include "cli/run/run_command.hpp"
#include "hmi_bridge/retain/writer.hpp"

namespace lockstep::cli {

/// Where the values of a project are kept: as the command line says, else the project, else in the state
/// directory that systemd gives to a service, else beside the project file.
std::string retain_path(const Project& project, const RunOptions& options);

/// Gives the kept values back to a project that is being loaded, and tells what came back.
/// @return what keeps them from now on; nullptr if there is nothing to keep or nobody wants it kept
/// @throws RetainFileError if the file cannot be used
std::unique_ptr<RetainWriter> restore_kept(Project& project, const RunOptions& options);

}  // namespace lockstep::cli
