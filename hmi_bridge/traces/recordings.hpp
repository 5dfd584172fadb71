/// The files of a flight recorder, those of earlier runs among them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/traces/csv_trace.hpp"

namespace lockstep {

/// One file that a flight recorder has made.
struct Recording {
  std::uint64_t number = 0;  ///< from 1; the newer one has the higher number, whatever the clock has done
  std::string path;
};

/// FILE_20261123T115200Z_17.csv and its like: the time at which it was begun, in UTC, and a number that goes
/// on from run to run. What has no such name is nobody's here. Looks into the folder of FILE, which may take
/// as long as the disk does: not for the thread of the cycle.
class Recordings {
 public:
  /// @param file path and beginning of the names; a relative one is relative to the current directory
  explicit Recordings(std::string file);

  /// Those that are there, the oldest first.
  /// @throws std::filesystem::filesystem_error if the folder cannot be read
  std::vector<Recording> present() const;

  /// Makes the next one, which nothing that is there gives way to.
  /// @throws std::system_error, which names the file, if that fails
  std::unique_ptr<CsvTrace> open_next() const;

  /// Removes the oldest but `keep` [1, …); gives what could not be removed, with the reason.
  std::vector<std::string> remove_oldest(std::size_t keep) const noexcept;

  /// Why nothing can be written into the folder; empty: something can.
  std::string problem() const;

  /// The number in the name of a file of that beginning, of 15 digits at most; 0: it is no recording.
  static std::uint64_t number_of(std::string_view name, std::string_view beginning) noexcept;

 private:
  std::string folder() const;

  const std::string file_;
};

}  // namespace lockstep
