/// Traces of files that pages have given or named: read by a thread of their own, looked at by all.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "hmi_bridge/lcm/trace_reader.hpp"
#include "hmi_bridge/traces/store.hpp"
#include "projects/studio/history.hpp"
#include "projects/studio/open_file.hpp"

namespace lockstep {

enum class StudioFileState : std::uint8_t { loading, ready, failed };

/// One of them. Once it is ready, it belongs to whoever looks.
struct StudioTraceFile {
  std::string id;    ///< "file-1", and so on
  std::string name;  ///< as it was called
  std::string
      of{};  ///< the one in which it stands besides, of a further trace of a log; empty: it is one by itself
  StudioFileState state = StudioFileState::loading;
  double progress = 0.0;  ///< 0 to 1
  std::string error;      ///< why it has failed
  std::string remark;     ///< what is missing of it; empty: nothing
  TraceStore store{TraceStoreLimits{}};
  StudioHistory history;  ///< events and jobs of an LCM log
};

/// Thread: the server's, but for the reading. A file is read at a time, at the lowest priority.
class StudioTraceFiles {
 public:
  static constexpr std::size_t kFiles = 32;

  StudioTraceFiles() = default;
  ~StudioTraceFiles();  ///< ends the reading
  StudioTraceFiles(const StudioTraceFiles&) = delete;
  StudioTraceFiles& operator=(const StudioTraceFiles&) = delete;

  /// Begins to read a file, .csv or .lcm by its name. Further traces of an LCM log, each on a channel of its
  /// own, become files besides it, called "NAME, CHANNEL". @param name by which it is called
  /// @param is_temporary it is removed when it has been read
  /// @return nullptr: there are too many
  const StudioTraceFile* add(std::string path, std::string name, bool is_temporary);
  /// The same of a file that is open already, which is read whatever its name leads to by then.
  const StudioTraceFile* add(OpenFile file, std::string name);
  /// @return false: there is no such file
  bool remove(std::string_view id);
  const StudioTraceFile* find(std::string_view id) const noexcept;
  StudioTraceFile* find(std::string_view id) noexcept;
  const std::deque<StudioTraceFile>& all() const noexcept { return files_; }

  /// Takes what has been read. Calls `told(const StudioTraceFile&)` for each whose state has changed, and for
  /// one that is being read.
  template <class Told>
  void look(Told told) {
    const std::string id = take();
    if (const StudioTraceFile* file = find(id); file != nullptr) told(*file);
  }

 private:
  struct Job {
    std::string id, path, name;
    bool is_temporary;
    OpenFile file;  // that `path` leads to; none: the path is a name
  };
  struct Read {
    std::string id{};    // of the file; of a further trace that of the file in which it stands
    std::string name{};  // of a further trace
    std::string error{}, remark{};
    TraceStore store{TraceStoreLimits{}};
    StudioHistory history{};
  };

  const StudioTraceFile* queue(std::string path, std::string name, bool is_temporary, OpenFile file);
  std::string take();
  void work() noexcept;
  StudioTraceFile& enter(std::string name);
  Read read(const Job& job, std::vector<std::string>& others);
  Read read_other(const Job& job, const std::string& channel);
  void read_log(LcmTraceReader& reader, const std::string& name, Read& read);
  void read_all(const Job& job, std::vector<Read>& results);
  void check_wanted(double progress);

  std::deque<StudioTraceFile> files_;
  std::uint64_t number_ = 0;
  double told_ = -1.0;  // progress

  std::mutex mutex_;  // guards those below
  std::condition_variable wake_;
  std::deque<Job> jobs_;
  std::deque<Read> finished_;
  std::string current_;  // id that is being read
  bool stop_ = false;

  std::atomic<bool> cancel_{false};  // what is being read is not wanted any more
  std::atomic<double> progress_{0.0};
  std::thread thread_;
};

}  // namespace lockstep
