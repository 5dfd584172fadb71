/// A file that is open: what it is stays the same, whatever its name leads to by now.
#pragma once

#include <unistd.h>

#include <string>
#include <utility>

namespace lockstep {

/// Owns a descriptor, or none.
class OpenFile {
 public:
  OpenFile() = default;
  explicit OpenFile(int number) noexcept : number_(number) {}
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  OpenFile(OpenFile&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int number() const noexcept { return number_; }  ///< -1: there is none
  /// Under which this process finds the file itself once more, from its beginning. @source proc(5)
  std::string path() const { return "/proc/self/fd/" + std::to_string(number_); }

 private:
  int number_ = -1;
};

}  // namespace lockstep
