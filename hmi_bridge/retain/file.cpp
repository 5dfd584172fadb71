#include "hmi_bridge/retain/file.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

namespace lockstep {
namespace {

constexpr int kApplication = 0x4C6B7374;  // "Lkst", in the head of the file
constexpr int kVersion = 1;
constexpr int kPatience = 2000;  // [ms] for a run that is just ending
constexpr mode_t kMode = 0644;
constexpr std::int64_t kNever = -1;  // time of change that no file has

constexpr const char* kTables =
    "PRAGMA application_id = 1282110324; PRAGMA user_version = 1;"
    "CREATE TABLE kept (project TEXT NOT NULL, name TEXT NOT NULL COLLATE NOCASE, type TEXT NOT NULL,"
    " value TEXT NOT NULL, basis TEXT NOT NULL, PRIMARY KEY (project, name)) STRICT, WITHOUT ROWID;"
    "CREATE TABLE state (project TEXT NOT NULL PRIMARY KEY, count INTEGER NOT NULL, sum TEXT NOT NULL)"
    " STRICT, WITHOUT ROWID;";
static_assert(kApplication == 1282110324 && kVersion == 1);

std::string folded(std::string_view name) {
  std::string text(name);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// A prepared statement.
class Statement {
 public:
  Statement(sqlite3* database, const char* text) {
    code_ = sqlite3_prepare_v2(database, text, -1, &statement_, nullptr);
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int place, std::string_view text) {
    if (code_ == SQLITE_OK)
      code_ =
          sqlite3_bind_text(statement_, place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void bind(int place, std::int64_t number) {
    if (code_ == SQLITE_OK) code_ = sqlite3_bind_int64(statement_, place, number);
  }
  /// Turns to the next row; false: there is none, or something is wrong, which `code` tells.
  bool next() {
    if (code_ != SQLITE_OK && code_ != SQLITE_ROW) return false;
    code_ = sqlite3_step(statement_);
    return code_ == SQLITE_ROW;
  }
  std::string text(int column) const {
    const auto* const bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return bytes == nullptr
               ? ""
               : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
  }
  std::int64_t number(int column) const { return sqlite3_column_int64(statement_, column); }
  /// SQLITE_DONE when all rows have been seen.
  int code() const { return code_; }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int code_ = SQLITE_OK;
};

/// Of all the rows of a project in the order of their names: the FNV-1a hash. A changed, missing or foreign
/// row gives another one.
std::string sum_of(const std::string& project, const std::map<std::string, KeptRow>& rows) {
  std::uint64_t sum = 14695981039346656037ULL;
  const auto add = [&sum](std::string_view text) {
    for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    sum *= 1099511628211ULL;  // the end of a text, as a byte 0
  };
  add(project);
  for (const auto& [name, row] : rows)
    for (const std::string_view text :
         std::initializer_list<std::string_view>{row.name, row.type, row.value, row.basis})
      add(text);
  return std::to_string(sum);
}

bool damage(int code) {
  return code == SQLITE_CORRUPT || code == SQLITE_NOTADB || code == SQLITE_FORMAT;
}

bool is_full(int error) {
  return error == ENOSPC || error == EDQUOT;
}

/// Whether the file that is open is not the one of its name any more.
bool has_moved(sqlite3* database) {
  int moved = 0;
  return sqlite3_file_control(database, "main", SQLITE_FCNTL_HAS_MOVED, &moved) != SQLITE_OK || moved != 0;
}

bool run(sqlite3* database, const char* text) {
  return sqlite3_exec(database, text, nullptr, nullptr, nullptr) == SQLITE_OK;
}

bool put(sqlite3* database, const std::string& project, const KeptRow& row) {
  Statement statement(database,
                      "REPLACE INTO kept (project, name, type, value, basis) VALUES (?, ?, ?, ?, ?)");
  statement.bind(1, project);
  statement.bind(2, row.name);
  statement.bind(3, row.type);
  statement.bind(4, row.value);
  statement.bind(5, row.basis);
  statement.next();
  return statement.code() == SQLITE_DONE;
}

bool clear(sqlite3* database, const std::string& project) {
  Statement statement(database, "DELETE FROM kept WHERE project = ?");
  statement.bind(1, project);
  statement.next();
  return statement.code() == SQLITE_DONE;
}

bool put_state(sqlite3* database, const std::string& project, std::size_t count, const std::string& sum) {
  Statement statement(database, "REPLACE INTO state (project, count, sum) VALUES (?, ?, ?)");
  statement.bind(1, project);
  statement.bind(2, static_cast<std::int64_t>(count));
  statement.bind(3, sum);
  statement.next();
  return statement.code() == SQLITE_DONE;
}

}  // namespace

void RetainFile::Close::operator()(sqlite3* database) const noexcept {
  sqlite3_close_v2(database);
}

RetainFile::RetainFile(RetainFile&&) noexcept = default;
RetainFile::~RetainFile() = default;

RetainFile::RetainFile(std::string path, std::string project, const char* vfs)
    : path_(std::move(path)), project_(std::move(project)), watched_(vfs == nullptr) {
  if (watched_) make_if_missing();
  if (!full_) open(vfs);
}

/// A file that is made is there with its tables or not at all, so that one without anything is damage.
void RetainFile::make_if_missing() {
  const FileStamp found = stamp_of(path_);
  if (found.exists && !found.is_regular()) fail("it is no file, but a directory, a device or a pipe");
  // To the library, one of a single byte is one of none.
  if (found.exists && found.size <= 1) fail_damaged("it is empty");
  if (found.exists) return;
  std::string fresh;
  int error = write_beside(path_, bytes(), kMode, fresh);
  if (error == 0) error = give_name(fresh, path_);
  full_ = is_full(error);
  if (error != 0 && error != EEXIST && !full_)
    fail("it can neither be opened nor made: " + std::generic_category().message(error));
}

void RetainFile::open(const char* vfs) {
  sqlite3* database = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | (watched_ ? 0 : SQLITE_OPEN_CREATE);
  const int code = sqlite3_open_v2(path_.c_str(), &database, flags, vfs);
  database_.reset(database);
  if (database == nullptr) fail("no memory");
  // The library does not say why.
  if (const int reason = sqlite3_system_errno(database); code == SQLITE_CANTOPEN && reason != 0)
    fail("it cannot be opened: " + std::generic_category().message(reason));
  if (code != SQLITE_OK) fail(sqlite3_errmsg(database));
  sqlite3_extended_result_codes(database, 0);
  sqlite3_busy_timeout(database, kPatience);
  take();
  check();
  read();
  look();
}

void RetainFile::fail(const std::string& what) const {
  throw RetainFileError("retain file " + path_ + ": " + what);
}

void RetainFile::fail_damaged(const std::string& what) const {
  fail(
      "it is damaged (" + what +
      "). Put back a copy, or move it away to begin with the init values and to home absolute encoders anew");
}

/// From here on nobody else can open it.
void RetainFile::take() {
  sqlite3* const database = database_.get();
  // A commit is on the disk before it is told; the journal of a run that was killed is rolled back here.
  int code = sqlite3_exec(database,
                          "PRAGMA locking_mode = EXCLUSIVE; PRAGMA synchronous = EXTRA;"
                          "PRAGMA journal_mode = DELETE; PRAGMA trusted_schema = OFF;"
                          "PRAGMA temp_store = MEMORY; BEGIN EXCLUSIVE;",
                          nullptr, nullptr, nullptr);
  if (code == SQLITE_OK) {
    const bool read_only = sqlite3_db_readonly(database, "main") == 1;
    code = sqlite3_exec(database, "ROLLBACK", nullptr, nullptr, nullptr);
    if (read_only) fail("it cannot be written: permission denied");
  }
  // An empty file cannot even be begun on a full disk; that is for the first write to tell.
  if (code == SQLITE_OK || code == SQLITE_FULL) return;
  const std::string text = sqlite3_errmsg(database);
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED)
    throw RetainFileInUse("retain file " + path_ + ": it is in use by another run");
  if (damage(code)) fail_damaged(text);
  fail(text);
}

void RetainFile::check() {
  sqlite3* const database = database_.get();
  const auto number = [&](const char* pragma) {
    Statement statement(database, pragma);
    const std::int64_t value = statement.next() ? statement.number(0) : -1;
    if (damage(statement.code())) fail_damaged(sqlite3_errmsg(database));
    if (statement.code() != SQLITE_ROW) fail(sqlite3_errmsg(database));
    return value;
  };
  Statement quick(database, "PRAGMA quick_check(1)");
  const std::string verdict = quick.next() ? quick.text(0) : sqlite3_errmsg(database);
  if (verdict != "ok") fail_damaged(verdict);
  const std::int64_t application = number("PRAGMA application_id");
  empty_ = application == 0 && number("SELECT count(*) FROM sqlite_schema") == 0;
  if (empty_) return;
  if (application != kApplication)
    fail("it is a database of another program. Name another file with --retain or in the project");
  if (const std::int64_t version = number("PRAGMA user_version"); version != kVersion)
    fail("it has version " + std::to_string(version) + ", this program knows version " +
         std::to_string(kVersion));
}

void RetainFile::read() {
  if (empty_) return;
  sqlite3* const database = database_.get();
  Statement rows(database, "SELECT project, name, type, value, basis FROM kept");
  while (rows.next()) {
    KeptRow row{rows.text(1), rows.text(2), rows.text(3), rows.text(4)};
    Rows& own = rows.text(0) == project_ ? rows_ : others_[rows.text(0)].rows;
    own.emplace(folded(row.name), std::move(row));
  }
  if (rows.code() != SQLITE_DONE) fail_damaged(sqlite3_errmsg(database));
  Statement state(database, "SELECT project, count, sum FROM state");
  bool found = false;
  while (state.next()) {
    if (state.text(0) != project_) {
      Foreign& other = others_[state.text(0)];
      other.count = state.number(1);
      other.sum = state.text(2);
      continue;
    }
    found = true;
    if (state.number(1) != static_cast<std::int64_t>(rows_.size()) ||
        state.text(2) != sum_of(project_, rows_))
      fail_damaged("its values are not those that were written last");
  }
  if (state.code() != SQLITE_DONE) fail_damaged(sqlite3_errmsg(database));
  if (!found && !rows_.empty()) fail_damaged("it has values without their sum");
}

/// A file of everything that is known, as it stands on a disk.
std::vector<std::uint8_t> RetainFile::bytes() const {
  sqlite3* opened = nullptr;
  bool good = sqlite3_open(":memory:", &opened) == SQLITE_OK;
  const std::unique_ptr<sqlite3, Close> memory(opened);
  good = good && run(opened, kTables) && run(opened, "BEGIN");
  for (const auto& [name, row] : rows_) good = good && put(opened, project_, row);
  if (!rows_.empty()) good = good && put_state(opened, project_, rows_.size(), sum_of(project_, rows_));
  for (const auto& [project, other] : others_) {
    for (const auto& [name, row] : other.rows) good = good && put(opened, project, row);
    good = good && put_state(opened, project, static_cast<std::size_t>(other.count), other.sum);
  }
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> content(
      good && run(opened, "COMMIT") ? sqlite3_serialize(opened, "main", &size, 0) : nullptr, &sqlite3_free);
  if (content == nullptr) fail("no memory");
  return {content.get(), content.get() + size};
}

const KeptRow* RetainFile::find(std::string_view name) const {
  const auto found = rows_.find(folded(name));
  return found == rows_.end() ? nullptr : &found->second;
}

std::vector<KeptRow> RetainFile::rows() const {
  std::vector<KeptRow> rows;
  for (const auto& [name, row] : rows_) rows.push_back(row);
  return rows;
}

std::vector<std::string> RetainFile::other_projects() const {
  std::vector<std::string> names;
  for (const auto& [name, other] : others_) names.push_back(name);
  return names;
}

std::string RetainFile::write(std::span<const KeptRow> rows) {
  constexpr int kTries = 2;  // the second one after the file has been made again
  std::string problem;
  for (int i = 0; i < kTries; ++i) {
    full_ = false;
    if (problem = hold(); !problem.empty()) return problem;
    const std::uint64_t before = commits_;
    problem = write_once(rows);
    if (problem.empty() && (commits_ == before || is_whole())) return "";
    if (!problem.empty() && is_untouched()) return problem;
  }
  return problem.empty() ? "somebody else changes it again and again" : problem;
}

std::string RetainFile::write_once(std::span<const KeptRow> rows) {
  std::vector<const KeptRow*> fresh;
  Rows after = rows_;
  for (const KeptRow& row : rows) {
    const KeptRow* const before = find(row.name);
    if (before != nullptr && *before == row) continue;
    fresh.push_back(&row);
    after.insert_or_assign(folded(row.name), row);
  }
  if (differs_) {
    fresh.clear();
    for (const auto& [name, row] : after) fresh.push_back(&row);
  }
  if (fresh.empty()) return "";
  const std::string problem = begin_and_write(fresh, sum_of(project_, after));
  if (!problem.empty()) {
    full_ = problem == sqlite3_errstr(SQLITE_FULL);
    if (sqlite3_get_autocommit(database_.get()) == 0) run(database_.get(), "ROLLBACK");
    return problem;
  }
  rows_ = std::move(after);
  empty_ = false;
  differs_ = false;
  ++commits_;
  return "";
}

/// @return what went wrong; then the transaction may be open still
std::string RetainFile::begin_and_write(std::span<const KeptRow* const> rows, const std::string& sum) const {
  sqlite3* const database = database_.get();
  if (!run(database, "BEGIN IMMEDIATE") || (empty_ && !run(database, kTables)))
    return sqlite3_errmsg(database);
  if (differs_ && !clear(database, project_)) return sqlite3_errmsg(database);
  std::size_t count = rows_.size();
  for (const KeptRow* const row : rows) {
    if (find(row->name) == nullptr) ++count;
    if (!put(database, project_, *row)) return sqlite3_errmsg(database);
  }
  if (!put_state(database, project_, count, sum)) return sqlite3_errmsg(database);
  return run(database, "COMMIT") ? "" : sqlite3_errmsg(database);
}

bool RetainFile::verify() {
  if (empty_ || !database_) return rows_.empty();
  sqlite3_db_release_memory(database_.get());  // pages that it has read or written already
  Statement rows(database_.get(), "SELECT name, type, value, basis FROM kept WHERE project = ?");
  rows.bind(1, project_);
  Rows found;
  while (rows.next()) {
    KeptRow row{rows.text(0), rows.text(1), rows.text(2), rows.text(3)};
    std::string name = folded(row.name);
    found.emplace(std::move(name), std::move(row));
  }
  differs_ = rows.code() != SQLITE_DONE || found != rows_;
  return !differs_;
}

std::string RetainFile::remark() {
  return std::exchange(remark_, "");
}

std::string RetainFile::hold() {
  if (is_untouched()) return "";
  try {
    return take_again();
  } catch (const std::exception& error) {
    return error.what();
  }
}

/// Whether nobody has been at the file since it was looked at last.
bool RetainFile::is_untouched() const {
  if (!watched_) return true;
  if (!database_ || has_moved(database_.get()) || stamp_of(path_) != stamp_) return false;
  return !journal_.exists || stamp_of(journal()).is_file_of(journal_);
}

/// From here on, what others do to it is seen.
void RetainFile::look() {
  if (!watched_) return;
  stamp_ = stamp_of(path_);
  journal_ = stamp_of(journal());
}

/// Looks at the file after a write; false if it cannot be what was written.
bool RetainFile::is_whole() {
  if (!watched_) return true;
  Statement size(database_.get(), "SELECT page_count * page_size FROM pragma_page_count, pragma_page_size");
  const FileStamp now = stamp_of(path_);
  if (size.next() && now.exists && now.size == size.number(0) && !has_moved(database_.get())) {
    stamp_ = now;
    journal_ = stamp_of(journal());
    return true;
  }
  stamp_.changed = kNever;
  return false;
}

std::string RetainFile::journal() const {
  return sqlite3_filename_journal(sqlite3_db_filename(database_.get(), "main"));
}

/// Opens the file again, which somebody has been at: it is the same still, or it is made again.
std::string RetainFile::take_again() {
  const bool was_there = stamp_.exists;
  database_.reset();  // with its locks: another one in this process would not see theirs
  const bool is_in_the_way = stamp_of(path_).exists;
  if (is_in_the_way) try {
      if (adopt(RetainFile(path_, project_))) return "";
    } catch (const RetainFileInUse&) {
      return "another run has a file of this name in use";
    } catch (const RetainFileError&) {
      // Damaged, or something else: it is in the way.
    }
  std::string aside;
  const int error = make_again(is_in_the_way, aside);
  full_ = is_full(error);
  const std::string done = is_in_the_way ? "it was changed, cut or replaced" : "it was deleted or moved";
  const std::string reason = std::generic_category().message(error);
  if (error != 0) return was_there ? done + " and cannot be made again: " + reason : reason;
  if (!adopt(RetainFile(path_, project_))) return "somebody else changes it again and again";
  if (!was_there) return "";
  remark_ = "retain file " + path_ + ": " + done +
            " while it was in use, and has been made again with all values" +
            (is_in_the_way ? "; what stood there is " + aside + " now" : "");
  return "";
}

/// Takes the place of this one if it holds the same.
bool RetainFile::adopt(RetainFile found) noexcept {
  if (!found.database_ || found.rows_ != rows_ || found.others_ != others_) return false;
  database_ = std::move(found.database_);
  stamp_ = found.stamp_;
  journal_ = found.journal_;
  empty_ = found.empty_;
  return true;
}

/// The new one is on the disk before anything is moved for it. @return 0, or errno
int RetainFile::make_again(bool is_in_the_way, std::string& aside) {
  std::string fresh;
  int error = write_beside(path_, bytes(), stamp_.exists ? stamp_.mode & 0777 : kMode, fresh);
  if (error != 0) return error;
  if (is_in_the_way) error = put_aside(path_, aside);
  // A name that is taken after all is left alone, and the new file is removed.
  const int named = give_name(fresh, path_);
  return error != 0 ? error : named;
}

}  // namespace lockstep
