#include "hmi_bridge/retain/file.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <system_error>
#include <utility>

namespace lockstep {
namespace {

constexpr int kApplication = 0x4C6B7374;  // "Lkst", in the head of the file
constexpr int kVersion = 1;
constexpr int kPatience = 2000;  // [ms] for a run that is just ending

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

}  // namespace

void RetainFile::Close::operator()(sqlite3* database) const noexcept {
  sqlite3_close_v2(database);
}

RetainFile::RetainFile(RetainFile&&) noexcept = default;
RetainFile::~RetainFile() = default;

RetainFile::RetainFile(std::string path, std::string project, const char* vfs)
    : path_(std::move(path)), project_(std::move(project)) {
  sqlite3* database = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(path_.c_str(), &database, flags, vfs);
  database_.reset(database);
  if (database == nullptr) fail("no memory");
  // The library says neither why nor that it would have made the file.
  if (const int reason = sqlite3_system_errno(database); code == SQLITE_CANTOPEN && reason != 0)
    fail("it can neither be opened nor made: " + std::generic_category().message(reason));
  if (code != SQLITE_OK) fail(sqlite3_errmsg(database));
  sqlite3_extended_result_codes(database, 0);
  sqlite3_busy_timeout(database, kPatience);
  take();
  check();
  read();
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
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) fail("it is in use by another run");
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
  Statement rows(database, "SELECT name, type, value, basis FROM kept WHERE project = ?");
  rows.bind(1, project_);
  while (rows.next()) {
    KeptRow row{rows.text(0), rows.text(1), rows.text(2), rows.text(3)};
    rows_.emplace(folded(row.name), std::move(row));
  }
  if (rows.code() != SQLITE_DONE) fail_damaged(sqlite3_errmsg(database));
  Statement state(database, "SELECT project, count, sum FROM state");
  bool found = false;
  while (state.next()) {
    if (state.text(0) != project_) {
      others_.push_back(state.text(0));
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

const KeptRow* RetainFile::find(std::string_view name) const {
  const auto found = rows_.find(folded(name));
  return found == rows_.end() ? nullptr : &found->second;
}

std::vector<KeptRow> RetainFile::rows() const {
  std::vector<KeptRow> rows;
  for (const auto& [name, row] : rows_) rows.push_back(row);
  return rows;
}

std::string RetainFile::write(std::span<const KeptRow> rows) {
  std::vector<const KeptRow*> fresh;
  std::map<std::string, KeptRow> after = rows_;
  for (const KeptRow& row : rows) {
    const KeptRow* const before = find(row.name);
    if (before != nullptr && *before == row) continue;
    fresh.push_back(&row);
    after.insert_or_assign(folded(row.name), row);
  }
  full_ = false;
  if (fresh.empty()) return "";
  const std::string problem = begin_and_write(fresh, sum_of(project_, after));
  if (!problem.empty()) {
    full_ = problem == sqlite3_errstr(SQLITE_FULL);
    if (sqlite3_get_autocommit(database_.get()) == 0)
      sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    return problem;
  }
  rows_ = std::move(after);
  empty_ = false;
  ++commits_;
  return "";
}

/// @return what went wrong; then the transaction may be open still
std::string RetainFile::begin_and_write(std::span<const KeptRow* const> rows, const std::string& sum) const {
  sqlite3* const database = database_.get();
  const auto run = [database](const char* text) {
    return sqlite3_exec(database, text, nullptr, nullptr, nullptr) == SQLITE_OK;
  };
  if (!run("BEGIN IMMEDIATE") || (empty_ && !run(kTables))) return sqlite3_errmsg(database);
  std::size_t count = rows_.size();
  for (const KeptRow* const row : rows) {
    if (find(row->name) == nullptr) ++count;
    Statement put(database, "REPLACE INTO kept (project, name, type, value, basis) VALUES (?, ?, ?, ?, ?)");
    put.bind(1, project_);
    put.bind(2, row->name);
    put.bind(3, row->type);
    put.bind(4, row->value);
    put.bind(5, row->basis);
    put.next();
    if (put.code() != SQLITE_DONE) return sqlite3_errmsg(database);
  }
  Statement state(database, "REPLACE INTO state (project, count, sum) VALUES (?, ?, ?)");
  state.bind(1, project_);
  state.bind(2, static_cast<std::int64_t>(count));
  state.bind(3, sum);
  state.next();
  if (state.code() != SQLITE_DONE) return sqlite3_errmsg(database);
  return run("COMMIT") ? "" : sqlite3_errmsg(database);
}

}  // namespace lockstep
