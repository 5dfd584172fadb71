/// The files of a project that pages read and write at the desk: the project itself and its cams.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"
#include "projects/studio/api.hpp"
#include "projects/studio/desk_folder.hpp"

namespace lockstep {

/// A file is changed only by who knows what is in it: by the ETag of what he has read. Thread: the server's.
class StudioProjectFiles {
 public:
  /// There are none.
  StudioProjectFiles() = default;
  /// @param project path of the file  @param cams names of files that it has, as it has them
  StudioProjectFiles(const std::string& project, std::vector<std::string> cams);

  bool are_there() const noexcept { return !project_.empty(); }
  /// The names, for pages.
  studio_api::Json names() const;
  /// `GET` and `PUT /api/files/{name}`. @throws studio_api::BadRequest
  StudioAnswer answer(const StudioRequest& request, std::string_view name) const;

 private:
  bool is_held(std::string_view name) const noexcept;
  StudioAnswer put(const StudioRequest& request, std::string_view name) const;

  DeskFolder folder_;
  std::string project_;  // its name
  std::vector<std::string> cams_;
};

}  // namespace lockstep
