/// The parts of `lockstep cam`.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "cli/command/command.hpp"
#include "cli/plot/picture.hpp"
#include "projects/cam_files/definition.hpp"
#include "projects/cam_files/facts.hpp"

namespace lockstep::cli {

/// The cam that a command works on.
struct CamInput {
  std::string file;
  std::string name;    ///< --cam
  bool large = false;  ///< --10k
};

/// Adds FILE, --cam and --10k to a command.
void add_cam_input(CLI::App& command, CamInput& input);

/// What the user asked for cannot be done with this cam; the text says why.
struct CannotDo : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Loads the cam and tells its problems and warnings on standard error.
/// @param status the exit status if there is none
std::optional<CamDefinition> load_cam_or_tell(const CamInput& input, int& status);

/// Loads the cam and does something with it; gives the exit status.
/// @param work takes the definition, gives the exit status; may throw CannotDo
template <class Work>
int with_cam(const CamInput& input, const Work& work) {
  int status = kOk;
  const auto definition = load_cam_or_tell(input, status);
  if (!definition) return status;
  try {
    return work(*definition);
  } catch (const std::runtime_error& error) {
    tell(error.what(), Severity::error);
    return kCouldNotStart;
  }
}

/// Writes to a file, or to standard output for an empty path. @throws std::runtime_error, OutputFailed
void write_output(const std::string& path, const std::string& text);

/// The four diagrams: following value, velocity, acceleration and jerk over the leading value.
Picture cam_picture(const CamDefinition& definition, const std::string& title);

void add_cam_info(CLI::App& cam, Action& action);
void add_cam_sample(CLI::App& cam, Action& action);
void add_cam_check(CLI::App& cam, Action& action);
void add_cam_convert(CLI::App& cam, Action& action);
void add_cam_plot(CLI::App& cam, Action& action);

}  // namespace lockstep::cli
