/// A file of rows that knows which of them have reached the disk.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// Buffers whole rows and writes them in large blocks. The first failure ends the writing: the file is cut
/// back to its last whole row where it can be, and every row after that counts as lost. Recorder's thread.
class TraceFile {
 public:
  /// @param sink whose losses are counted; outlives this
  /// @param file open for writing, nothing written yet; owned by the caller, who closes it after `close`
  TraceFile(TraceSink& sink, std::FILE* file);

  /// Announces a row (or, with rows = 0, a header) of that many bytes; flushes first if the buffer has no
  /// space for it, so that a block on the disk ends with a whole row.
  /// @return false if writing has ended: the rows are counted as lost and must not be written.
  bool open_row(std::size_t bytes, std::uint64_t rows);
  /// The announced bytes are written into `stream()`, or failed to be.
  void close_row(bool written);
  void flush();
  /// Flushes, asks the system for errors it has not told yet, and discards what cannot be written.
  void close();

  std::FILE* stream() const noexcept { return file_; }

 private:
  struct Mark {
    std::int64_t end;  // offset behind the row
    std::uint64_t rows;
  };
  void fail(int error);

  TraceSink& sink_;
  std::FILE* const file_;
  std::vector<char> buffer_;
  std::vector<Mark> unwritten_;  // what stands in the buffer
  std::int64_t saved_ = 0;       // bytes of whole rows on the disk
  std::int64_t end_ = 0;         // offset behind the last announced row
  bool failed_ = false;
};

}  // namespace lockstep
