#include "hmi_bridge/traces/csv_reader.hpp"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <memory>
#include <system_error>

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
      if (progress_ && line_ % kLinesPerLook == 0)
        progress_(1.0 - static_cast<double>(text_.size()) / static_cast<double>(whole_));
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

  void values(std::string_view line) {
    std::size_t begin = 0;
    for (std::size_t column = 0; begin <= line.size(); ++column) {
      if (column > table_.columns.size()) fail(begin + 1, "more values than names: " + expected());
      const std::size_t end = std::min(line.find(',', begin), line.size());
      const std::string_view text = line.substr(begin, end - begin);
      const double value = number(text, begin + 1);
      if (column > 0 && text.find_first_of(".einEIN") != text.npos) table_.reals[column - 1] = true;
      (column == 0 ? table_.t : table_.columns[column - 1]).push_back(value);
      begin = end + 1;
      if (end == line.size() && column < table_.columns.size())
        fail(line.size() + 1, "fewer values than names: " + expected());
    }
  }

  double number(std::string_view text, std::size_t column) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range)
      fail(column, "\"" + std::string(text) + "\" is outside the range of a double");
    if (error != std::errc{} || end != text.data() + text.size())
      fail(column, "\"" + std::string(text) + "\" is not a number");
    return value;
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

std::string read_all(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), std::fclose);
  const auto fail = [&path] { throw TraceFormatError(path + ": " + std::generic_category().message(errno)); };
  if (!file) fail();
  std::string text;
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  for (std::size_t got = kBlock; got == kBlock;) {
    const std::size_t size = text.size();
    text.resize(size + kBlock);
    got = std::fread(text.data() + size, 1, kBlock, file.get());
    text.resize(size + got);
  }
  if (std::ferror(file.get()) != 0) fail();
  return text;
}

}  // namespace

TraceTable parse_csv_trace(std::string_view text, const std::string& name) {
  const std::function<void(double)> nobody;
  return Parser(text, name, nobody).parse();
}

TraceTable read_csv_trace(const std::string& path, const std::function<void(double)>& progress) {
  const std::string text = read_all(path);
  return Parser(text, path, progress).parse();
}

}  // namespace lockstep
