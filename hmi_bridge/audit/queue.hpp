/// Entries of the audit log on their way to its file.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "hmi_bridge/audit/entry.hpp"

namespace lockstep {

/// A line of the log, and what is missing when it is not written.
struct AuditLine {
  std::string text;           ///< with its end of line
  std::uint64_t entries = 1;  ///< that are missing without it
};

/// Puts together what repeats, and holds what waits, both bounded. The first access of a source to a subject
/// is a line at once. What follows within a second is one line, with the value before all of it, the last one
/// and their number; the same value again is one line a minute. What there is no capacity for is counted and
/// told in the log itself. Knows no clock. One thread at a time.
class AuditQueue {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kApart{1};       ///< between two lines of one source and subject
  static constexpr std::chrono::seconds kSameApart{60};  ///< between two lines whose values are the same

  /// @param capacity lines that wait, and pairs of source and subject that are known, at most
  explicit AuditQueue(std::size_t capacity = 4096) : capacity_(capacity) {}

  void add(AuditEntry entry, Clock::time_point now);
  /// A line that stands for itself.
  void add_line(std::string text);

  /// Moves what waits, and what is due by then, behind `lines`, oldest first.
  void take(Clock::time_point now, std::vector<AuditLine>& lines);
  /// Moves whatever there is behind `lines` at the end: what was put together is due then.
  void take_all(std::vector<AuditLine>& lines);
  bool empty() const noexcept { return waiting_.empty() && lost_ == 0; }

  /// Entries that have found no capacity, or no disk, and are told with the next `take`.
  void lose(std::uint64_t entries) noexcept {
    lost_ += entries;
    all_lost_ += entries;
  }
  /// All that were lost so far.
  std::uint64_t lost() const noexcept { return all_lost_; }

 private:
  struct Told {
    Clock::time_point at;
    std::string value;                  // of the last line
    std::optional<AuditEntry> pending;  // the last entry that has been put together since
    std::string before;                 // of the first of them
    std::uint64_t count = 0;            // of them
    bool differs = false;               // whether they have changed the value

    Clock::time_point due() const noexcept { return at + (differs ? kApart : kSameApart); }
  };
  using Table = std::unordered_map<std::string, Told>;

  void push(std::string text, std::uint64_t entries);
  void tell(Told& told, Clock::time_point now);
  void tell_due(Clock::time_point now);
  void forget_old(Clock::time_point now);

  const std::size_t capacity_;
  std::deque<AuditLine> waiting_;
  Table table_;
  Clock::time_point due_ = Clock::time_point::max();  // of the first of what has been put together
  Clock::time_point swept_{};                         // when that was looked at
  Clock::time_point looked_{};                        // for what is old
  std::uint64_t lost_ = 0, all_lost_ = 0;
};

}  // namespace lockstep
