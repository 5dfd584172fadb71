/// The file of the audit log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "hmi_bridge/audit/queue.hpp"

namespace lockstep {

/// Where the audit log stands and how large it gets.
struct AuditOptions {
  std::string file;
  std::int64_t size =
      16 << 20;    ///< of one file [byte]; with the line that would go beyond it the next one begins
  int files = 10;  ///< in all, ≥ 2: FILE, FILE.1 (the one before it) … ; the oldest gives way
};

/// Lines that are only ever appended. A line stands in it whole, or the next one begins behind an end of
/// line. One thread at a time.
class AuditFile {
 public:
  /// Opens or makes the file, readable by its owner and group alone. @throws std::system_error with its name
  explicit AuditFile(AuditOptions options);
  ~AuditFile();
  AuditFile(const AuditFile&) = delete;
  AuditFile& operator=(const AuditFile&) = delete;

  /// Writes lines and has the system write them to the disk. @return how many stand in the file whole; if not
  /// all, `problem` says why
  std::size_t append(std::span<const AuditLine> lines);
  /// What has gone wrong in the last `append`; empty: nothing.
  const std::string& problem() const noexcept { return problem_; }
  const std::string& path() const noexcept { return options_.file; }

 private:
  int open() noexcept;
  bool is_there() const noexcept;
  void look();
  bool write(const std::string& line);
  void rotate();

  const AuditOptions options_;
  int fd_ = -1;
  std::int64_t size_ = 0;  // since the last attempt to begin the next file
  bool is_cut_ = false;    // the file ends within a line
  std::string problem_;
};

}  // namespace lockstep
