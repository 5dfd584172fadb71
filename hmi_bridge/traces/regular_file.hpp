/// Opens files that are read to their end.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace lockstep {

/// A regular file, open for reading, or why there is none.
struct RegularFile {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream{nullptr, &std::fclose};
  std::string problem;  ///< without the path; empty if it is open

  std::int64_t size() const noexcept;  ///< now: another program may write to it [byte]
};

/// Opens a file if its end is known: a pipe, a device or a socket is refused, without waiting for who might
/// write to it. What is looked at is what has been opened, so that nobody can put something else there in
/// between. Threads: any. Waits for nothing but the disk.
RegularFile open_regular_file(const std::string& path);

}  // namespace lockstep
