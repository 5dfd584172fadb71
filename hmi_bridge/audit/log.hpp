/// The audit log: who has written or commanded what, and with what success.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/audit/file.hpp"
#include "hmi_bridge/audit/queue.hpp"

namespace lockstep {

/// Takes entries from the threads of the bridge and writes them on a thread of its own: neither a slow nor a
/// full disk holds anybody up. What cannot be written is tried again every second, and counted as lost where
/// the queue is full.
class AuditLog {
 public:
  /// Opens the file and notes that a run begins. @throws std::system_error with the name of the file
  /// @param capacity of the queue
  AuditLog(AuditOptions options, const std::string& project, std::size_t capacity = 4096);
  AuditLog(const AuditLog&) = delete;
  AuditLog& operator=(const AuditLog&) = delete;
  ~AuditLog();  ///< stops

  /// Thread: any but the cycle's. Waits for nobody but another one that adds.
  void add(AuditEntry entry) noexcept;

  /// What has begun or ceased to go wrong since the last call, such as a full disk; empty: nothing. Any
  /// thread.
  std::string news();
  /// Writes what there is, as far as that goes, and ends the thread. Once.
  void stop();
  /// Entries that are in no file. Any thread.
  std::uint64_t lost() const;
  const std::string& path() const noexcept { return path_; }

 private:
  void run() noexcept;
  void write(std::unique_lock<std::mutex>& lock);

  const std::string path_;
  AuditFile file_;  // the thread's
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  AuditQueue queue_;  // guarded, as what follows
  std::string news_;
  bool failing_ = false;
  bool stopping_ = false;
  std::vector<AuditLine> unwritten_;  // the thread's: what the file has not taken yet
  std::thread thread_;
};

}  // namespace lockstep
