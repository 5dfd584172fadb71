/// What pages are told of a cam: what it is made of, what is wrong with it, its curves.
#pragma once

#include <string>

#include "hmi_bridge/studio/handler.hpp"
#include "projects/cam_files/file.hpp"

namespace lockstep {

/// A cam file that was given to the studio, beside a project or without one.
struct StudioCam {
  std::string name;  ///< of the file
  std::string path;
};

namespace studio_api {

/// The facts of `lockstep cam info --json`, with `problems` and `warnings` by their places; with `curves=N` N
/// samples of the following value and its derivatives, as the product itself computes them.
/// @throws BadRequest `curves` is not from 2 to 10,000
StudioAnswer cam_answer(const StudioRequest& request, const LoadedCam& loaded);

/// `POST /api/cam/design`: of a cam file that is the body. @throws BadRequest 422 it is no JSON
StudioAnswer design_answer(const StudioRequest& request);

}  // namespace studio_api
}  // namespace lockstep
