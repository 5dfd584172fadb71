#include "hmi_bridge/traces/csv_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "hmi_bridge/traces/regular_file.hpp"

namespace lockstep {
namespace {

/// One pass over the text that knows where it is.
class Parser {
 public:
  Parser(std::string_view text, const std::string& name, const std::function<void(double)>& progress)
      : text_(text), whole_(text.size()), name_(name), progress_(progress) {}

  TraceTable parse() {
    std::string_view line;
    if (!next(line)) fail(1, text_.empty() ? "the file is empty" : "the line of the names has no end");
    names(line);
    while (next(line)) {
      values(line);
      if (line_ % kLinesPerLook != 0) continue;
      if (line_ == kLinesPerLook) reserve();
      if (progress_) progress_(1.0 - static_cast<double>(text_.size()) / static_cast<double>(whole_));
    }
    if (!text_.empty())
      table_.remark = place(line_ + 1, 1) + "the last line has no end: it was cut short and is left out";
    return std::move(table_);
  }

 private:
  std::string place(std::size_t line, std::size_t column) const {
    return name_ + ":" + std::to_string(line) + ":" + std::to_string(column) + ": ";
  }
  [[noreturn]] void fail(std::size_t column, const std::string& what) const {
    throw TraceFormatError(place(line_ == 0 ? 1 : line_, column) + what);
  }

  // Takes the next whole line off the text, without its end.
  bool next(std::string_view& line) {
    const std::size_t end = text_.find('\n');
    if (end == std::string_view::npos) return false;
    line = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++line_;
    return true;
  }

  void names(std::string_view line) {
    std::size_t begin = 0;
    for (bool first = true; begin <= line.size(); first = false) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      const std::string_view name = line.substr(begin, end - begin);
      if (first && name != "t") fail(1, "the first column is '" + std::string(name) + "', it has to be 't'");
      if (name.empty()) fail(begin + 1, "a column has no name");
      if (!first) table_.signals.push_back({std::string(name), Type::LREAL, ""});
      begin = end + 1;
    }
    table_.columns.resize(table_.signals.size());
    table_.reals.resize(table_.signals.size());
  }

  /// Memory for as many lines as there will be, if those to come are as long as those before.
  void reserve() {
    const double lines =
        static_cast<double>(line_) * static_cast<double>(whole_) / static_cast<double>(whole_ - text_.size());
    const auto rows = static_cast<std::size_t>(1.05 * lines);
    table_.t.reserve(rows);
    for (std::vector<double>& column : table_.columns) column.reserve(rows);
  }

  void values(std::string_view line) {
    const char* at = line.data();
    const char* const end = at + line.size();
    const std::size_t width = table_.columns.size();
    for (std::size_t column = 0; column <= width; ++column) {
      double value = 0.0;
      const auto [behind, error] = std::from_chars(at, end, value);
      if (error != std::errc{} || (behind != end && *behind != ',')) refuse(line, at);
      if (column == 0) {
        table_.t.push_back(value);
      } else {
        if (!table_.reals[column - 1]) table_.reals[column - 1] = is_written_as_real({at, behind});
        table_.columns[column - 1].push_back(value);
      }
      if (behind == end) {
        if (column < width) fail(line.size() + 1, "fewer values than names: " + expected());
        return;
      }
      at = behind + 1;
    }
    fail(static_cast<std::size_t>(at - line.data()) + 1, "more values than names: " + expected());
  }

  static bool is_written_as_real(std::string_view text) noexcept {
    return text.find_first_of(".einEIN") != text.npos;
  }

  /// What begins here, up to the next comma, is no number.
  [[noreturn]] void refuse(std::string_view line, const char* at) const {
    const auto begin = static_cast<std::size_t>(at - line.data());
    const std::string text(line.substr(begin, line.find(',', begin) - begin));
    double value = 0.0;
    const bool is_beyond =
        std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc::result_out_of_range;
    fail(begin + 1, '"' + text + (is_beyond ? "\" is outside the range of a double" : "\" is not a number"));
  }

  std::string expected() const {
    return "a line has " + std::to_string(table_.columns.size() + 1) + " values";
  }

  static constexpr std::size_t kLinesPerLook = 4096;

  std::string_view text_;
  const std::size_t whole_;
  const std::string& name_;
  const std::function<void(double)>& progress_;
  std::size_t line_ = 0;
  TraceTable table_;
};

/// A file in memory, which nobody has filled with zeros before.
struct FileText {
  std::unique_ptr<char[]> bytes;
  std::size_t size = 0, capacity = 0;

  void grow(std::size_t wanted) {
    std::unique_ptr<char[]> more = std::make_unique_for_overwrite<char[]>(wanted);
    std::copy_n(bytes.get(), size, more.get());
    bytes = std::move(more);
    capacity = wanted;
  }
};

constexpr std::size_t kReadAtOnce = std::size_t{4} << 20;
constexpr std::size_t kLongestLine = std::size_t{16} << 20;  // far beyond what a trace of thousands has
constexpr std::size_t kSizeBelieved = std::size_t{1} << 30;  // a file of holes says any size

/// Counts lines, so that no memory is filled with what has none.
class LineWatch {
 public:
  /// @return false: a line is too long
  bool look(std::string_view block) noexcept {
    for (std::size_t at = 0; at < block.size();) {
      const std::size_t end = block.find('\n', at);
      length_ += std::min(end, block.size()) - at;
      if (length_ > kLongestLine) return false;
      if (end == block.npos) return true;
      ++line_;
      length_ = 0;
      at = end + 1;
    }
    return true;
  }
  std::size_t line() const noexcept { return line_; }

 private:
  std::size_t line_ = 1, length_ = 0;
};

FileText read_all(const std::string& path) {
  const RegularFile file = open_regular_file(path);
  if (!file.problem.empty()) throw TraceFormatError(path + ": " + file.problem);
  FileText text;
  text.grow(std::min(static_cast<std::size_t>(file.size()), kSizeBelieved) + kReadAtOnce);
  LineWatch lines;
  for (std::size_t got = 1; got != 0;) {
    if (text.capacity - text.size < kReadAtOnce) text.grow(2 * text.capacity);
    char* const at = text.bytes.get() + text.size;
    got = std::fread(at, 1, kReadAtOnce, file.stream.get());
    text.size += got;
    if (!lines.look({at, got}))
      throw TraceFormatError(path + ":" + std::to_string(lines.line()) + ":1: the line is longer than " +
                             std::to_string(kLongestLine >> 20) + " MiB");
  }
  if (std::ferror(file.stream.get()) != 0)
    throw TraceFormatError(path + ": " + std::generic_category().message(errno));
  return text;
}

}  // namespace

TraceTable parse_csv_trace(std::string_view text, const std::string& name) {
  const std::function<void(double)> nobody;
  return Parser(text, name, nobody).parse();
}

TraceTable read_csv_trace(const std::string& path, const std::function<void(double)>& progress) {
  const FileText text = read_all(path);
  return Parser({text.bytes.get(), text.size}, path, progress).parse();
}

}  // namespace lockstep
