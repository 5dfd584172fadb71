/// A folder of which pages may name files: what lies in it or below, by its plain name.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "projects/studio/open_file.hpp"

namespace lockstep {

/// No name leads out of it: neither `..` nor a link, at any place of it. Any thread.
class DeskFolder {
 public:
  /// @param path of the folder, which may itself be reached by links; empty: there is none, and no file
  explicit DeskFolder(std::string path = "") : path_(std::move(path)) {}

  const std::string& path() const noexcept { return path_; }
  /// A name as it is used here: a path that begins with that of the folder is told from there on.
  std::string_view name_of(std::string_view path) const noexcept;
  /// Whether a name may be used at all: not absolute, without `..`, of printable characters.
  /// @throws studio_api::BadRequest 403
  void check_name(std::string_view name) const;
  /// Whether there is something of this name, of any kind.
  bool has(std::string_view name) const;
  /// A regular file that is there, open for reading: whoever puts a link in its place later changes nothing.
  /// @throws studio_api::BadRequest 403 beyond the folder, a link or no file, 404
  OpenFile open(std::string_view name) const;
  /// Its content, at most so many bytes. @throws as `open`; 413
  std::string read(std::string_view name, std::size_t maximum) const;
  /// Writes beside it, and gives it the name once all of it is on the disk.
  /// @throws studio_api::BadRequest 403, 404 its folder is not there, 409 it cannot be written
  void write(std::string_view name, std::string_view content) const;

 private:
  std::string path_;
};

}  // namespace lockstep
