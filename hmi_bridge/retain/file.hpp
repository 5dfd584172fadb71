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

#include "hmi_bridge/retain/kept_value.hpp"

struct sqlite3;

namespace lockstep {

/// Why a retain file cannot be used; the text names the file, what is wrong and what may be done.
struct RetainFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
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
class RetainFile {
 public:
  /// Opens the file, or makes an empty one, and reads the values of a project.
  /// @param vfs name of SQLite's way to files; nullptr: the usual one
  /// @throws RetainFileError if the file cannot be read or written, is in use by another run, is damaged or
  /// is
  ///   something else than a retain file of this version
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
  const std::vector<std::string>& other_projects() const noexcept { return others_; }

  /// Puts rows in the place of those of the same names, all at once; other rows stay. When it returns without
  /// an error, the disk has them. Does nothing if there is nothing new.
  /// @return what went wrong: then the file is as before; empty: nothing
  std::string write(std::span<const KeptRow> rows);
  /// Whether the last `write` went wrong for want of space.
  bool full() const noexcept { return full_; }
  /// How often `write` has changed the file.
  std::uint64_t commits() const noexcept { return commits_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };
  void take();
  void check();
  void read();
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_damaged(const std::string& what) const;
  std::string begin_and_write(std::span<const KeptRow* const> rows, const std::string& sum) const;

  std::string path_;
  std::string project_;
  std::unique_ptr<sqlite3, Close> database_;
  std::map<std::string, KeptRow> rows_;  // what the file holds, by folded name
  std::vector<std::string> others_;
  std::uint64_t commits_ = 0;
  bool full_ = false;
  bool empty_ = false;  // it has no tables yet
};

}  // namespace lockstep
