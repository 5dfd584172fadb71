#include "cli/describe/table.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "projects/json/problem.hpp"

namespace lockstep::cli {
namespace {

constexpr std::size_t kUsualWidth = 80;
constexpr std::size_t kMinimumLast = 30;  // columns, below which the last column goes on lines of its own
constexpr std::size_t kColumnGap = 2;

void trim_end(std::string& line) {
  line.erase(line.find_last_not_of(' ') + 1);
}

}  // namespace

std::size_t output_width() {
  winsize size{};
  const bool terminal = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return terminal ? std::max<std::size_t>(size.ws_col, 40) : kUsualWidth;
}

std::size_t shown_width(std::string_view text) noexcept {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string printable(std::string_view text) {
  std::string result;
  while (true) {
    const auto end = std::min(text.find(' '), text.size());
    result += shown(text.substr(0, end));
    if (end == text.size()) return result;
    result += ' ';
    text.remove_prefix(end + 1);
  }
}

std::string padded(std::string_view text, std::size_t width) {
  const std::size_t shown = shown_width(text);
  return std::string(text) + std::string(shown < width ? width - shown : 0, ' ');
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (!lines.back().empty() && shown_width(lines.back()) + 1 + shown_width(word) > width)
      lines.emplace_back();
    if (!lines.back().empty()) lines.back() += ' ';
    lines.back() += word;
  }
  return lines;
}

std::string paragraph(std::string_view text, std::size_t indent, std::size_t width) {
  std::string result;
  for (const std::string& line : wrapped(text, width > indent ? width - indent : 1))
    result += std::string(indent, ' ') + line + "\n";
  return result;
}

Table::Table(std::vector<std::string> headings) : headings_(std::move(headings)) {}

void Table::row(std::vector<std::string> cells) {
  Row row{std::move(cells), {}};
  row.last.push_back(std::move(row.cells.back()));
  row.cells.pop_back();
  rows_.push_back(std::move(row));
}

void Table::note(std::string text) {
  auto& last = rows_.back().last;
  if (last.size() == 1 && last.front().empty())
    last.front() = std::move(text);
  else
    last.push_back(std::move(text));
}

std::vector<std::size_t> Table::widths() const {
  std::vector<std::size_t> widths(headings_.size() - 1, 0);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    for (const Row& row : rows_) widths[i] = std::max(widths[i], shown_width(row.cells[i]));
    if (widths[i] != 0) widths[i] = std::max(widths[i], shown_width(headings_[i]));
  }
  return widths;
}

std::string Table::text(std::size_t indent, std::size_t width) const {
  const std::vector<std::size_t> columns = widths();
  std::size_t start = indent;  // of the last column
  for (const std::size_t column : columns) start += column == 0 ? 0 : column + kColumnGap;
  const bool below = start + kMinimumLast > width;
  const std::size_t last_start = below ? indent + 4 : start;
  std::string result;
  const auto add = [&](const std::vector<std::string>& cells, const std::vector<std::string>& last) {
    std::string line(indent, ' ');
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i] != 0) line += padded(cells[i], columns[i] + kColumnGap);
    bool open = !below;  // whether the last column goes on in this line
    for (const std::string& part : last) {
      if (part.empty()) continue;
      for (const std::string& piece : wrapped(part, width > last_start ? width - last_start : 1)) {
        if (!open) {
          trim_end(line);
          result += line + "\n";
          line = std::string(last_start, ' ');
        }
        line += piece;
        open = false;
      }
    }
    trim_end(line);
    result += line + "\n";
  };
  const bool headed =
      std::any_of(headings_.begin(), headings_.end(), [](const std::string& text) { return !text.empty(); });
  if (headed) add(headings_, {below ? std::string() : headings_.back()});
  for (const Row& row : rows_) add(row.cells, row.last);
  return result;
}

}  // namespace lockstep::cli
