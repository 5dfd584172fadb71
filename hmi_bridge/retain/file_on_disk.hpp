/// What the file system says of a file's name: which file it is, and how one comes to it whole.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <span>
#include <string>

namespace lockstep {

/// Which file a name leads to, and when it was changed last. Two that are equal are one file that nobody has
/// written to, renamed or cut between the two looks.
struct FileStamp {
  bool exists = false;
  dev_t device = 0;
  ino_t inode = 0;
  mode_t mode = 0;
  off_t size = 0;            ///< [byte]
  std::int64_t changed = 0;  ///< change of content or of what the directory says of it [ns]; no tool sets it
  bool operator==(const FileStamp&) const = default;

  bool is_regular() const noexcept;
  bool is_file_of(const FileStamp& other) const noexcept {
    return exists && other.exists && device == other.device && inode == other.inode;
  }
};

/// Follows links. A name that cannot be looked at, for want of permission too, does not exist.
FileStamp stamp_of(const std::string& path) noexcept;

/// Writes a file beside another one, onto the disk, to be given its name.
/// @param fresh the name that it has until then, of no other process  @return 0, or errno
int write_beside(const std::string& path, std::span<const std::uint8_t> content, mode_t mode,
                 std::string& fresh);

/// Gives such a file its name, so that there is all of it or, after a loss of power too, nothing; or removes
/// it. What is there already is left alone. A link that leads nowhere gets its file there.
/// @return 0, or errno: EEXIST if there is something
int give_name(const std::string& fresh, const std::string& path);

/// Gives what stands under a name, and its journal, another one: PATH.aside-1 or the next that is free.
/// @param aside the new name  @return 0, or errno: EEXIST if 99 of them are there
int put_aside(const std::string& path, std::string& aside);

}  // namespace lockstep
