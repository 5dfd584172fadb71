/// The file that keeps values across runs: a database of SQLite, of which one transaction holds one instant.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/retain/file_on_disk.hpp"
#include "hmi_bridge/retain/kept_value.hpp"

struct sqlite3;

namespace lockstep {

/// Why a retain file cannot be used; the text names the file, what is wrong and what may be done.
struct RetainFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Another run has it.
struct RetainFileInUse : RetainFileError {
  using RetainFileError::RetainFileError;
};

/// One row of a retain file.
struct KeptRow {
  std::string name;
  std::string type;   ///< published name of the type
  std::string value;  ///< as `kept_text` gives it
  std::string basis;
  bool operator==(const KeptRow&) const = default;
};

/// An open retain file; nobody else can open it meanwhile. What it reads is always one of the states that
/// were written, whole: everything else is an error. One thread at a time, never the cycle's.
///
/// What has been written is under the name of the file: one that was deleted, moved, replaced, cut or written
/// to by somebody else is made again with all values, and what stands in its place is put aside under another
/// name. Only what another run has in use is left alone; then writing fails.
class RetainFile {
 public:
  /// Opens the file, or makes one without values, and reads the values of a project. A disk that is full is
  /// no error: the file is made by the first `write` that finds space.
  /// @param vfs name of SQLite's access to files, which is trusted: what happens to files outside of it is
  /// not
  ///   looked for, and an empty file counts as new; nullptr: the usual one
  /// @throws RetainFileError if the file cannot be read or written, is in use by another run, is damaged,
  ///   which one of no bytes is too, or is something else than a retain file of this version
  RetainFile(std::string path, std::string project, const char* vfs = nullptr);
  ~RetainFile();
  RetainFile(RetainFile&&) noexcept;
  RetainFile& operator=(RetainFile&&) noexcept = delete;

  const std::string& path() const noexcept { return path_; }
  /// The row of a name, without regard to case; nullptr: there is none.
  const KeptRow* find(std::string_view name) const;
  /// The rows of the project, by name.
  std::vector<KeptRow> rows() const;
  /// Names of other projects that have values in the file.
  std::vector<std::string> other_projects() const;

  /// Puts rows in the place of those of the same names, all at once; other rows stay. When it returns without
  /// an error, the disk has them, under the name of the file. Does nothing if there is nothing new.
  /// @return what went wrong: then the file is as before; empty: nothing
  std::string write(std::span<const KeptRow> rows);
  /// Reads the rows of the project back from the file. If they differ, the next `write` writes all of them
  /// anew.
  /// @return whether they are what was written
  bool verify();
  /// Makes sure that what was written last is under the name of the file: looks whether somebody has been at
  /// it, and makes it again if so.
  /// @return why it is not there and cannot be; empty: it is there
  std::string hold();
  /// What somebody has done to the file since the last time this was asked, and what was done about it;
  /// empty: nothing.
  std::string remark();
  /// Whether the last `write` went wrong for want of space.
  bool full() const noexcept { return full_; }
  /// How often `write` has changed the file.
  std::uint64_t commits() const noexcept { return commits_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };
  using Rows = std::map<std::string, KeptRow>;  // by folded name
  /// What another project has in the file.
  struct Foreign {
    std::int64_t count = 0;
    std::string sum;
    Rows rows;
    bool operator==(const Foreign&) const = default;
  };

  void make_if_missing();
  void open(const char* vfs);
  void take();
  void check();
  void read();
  std::string write_once(std::span<const KeptRow> rows);
  bool is_untouched() const;
  void look();
  bool is_whole();
  std::string journal() const;
  std::string take_again();
  bool adopt(RetainFile found) noexcept;
  int make_again(bool is_in_the_way, std::string& aside);
  std::vector<std::uint8_t> bytes() const;
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_damaged(const std::string& what) const;
  std::string begin_and_write(std::span<const KeptRow* const> rows, const std::string& sum) const;

  std::string path_;
  std::string project_;
  std::unique_ptr<sqlite3, Close> database_;
  Rows rows_;  // what the file holds
  std::map<std::string, Foreign> others_;
  std::uint64_t commits_ = 0;
  bool full_ = false;
  bool empty_ = false;    // it has no tables yet
  bool differs_ = false;  // what was read back is not what was written
  bool watched_ = false;  // what happens to it under its name
  FileStamp stamp_, journal_;
  std::string remark_;
};

}  // namespace lockstep
