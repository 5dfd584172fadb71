/// Text laid out for a terminal: aligned columns and wrapped paragraphs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::cli {

/// Columns of the terminal that standard output is; 80 if it is none.
std::size_t output_width();

/// Columns that a UTF-8 text takes; a character counts as one.
std::size_t shown_width(std::string_view text) noexcept;

/// A text from a file or a network on one line, without what a terminal cannot show; overlong words are cut.
std::string printable(std::string_view text);

/// The text with spaces up to a width.
std::string padded(std::string_view text, std::size_t width);

/// The words of a text in lines of at most `width` columns; a longer word has a line of its own.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// A paragraph with its end of line, each line indented.
std::string paragraph(std::string_view text, std::size_t indent, std::size_t width);

/// Rows of aligned cells. The last column is wrapped; where little space is left for it, it goes below.
class Table {
 public:
  /// @param headings of the columns; empty texts: no line of headings
  explicit Table(std::vector<std::string> headings);

  void row(std::vector<std::string> cells);
  /// Adds a line to the last column of the last row.
  void note(std::string text);

  bool empty() const noexcept { return rows_.empty(); }
  /// All lines with their ends. Columns that are empty in every row are left out.
  std::string text(std::size_t indent, std::size_t width) const;

 private:
  struct Row {
    std::vector<std::string> cells;
    std::vector<std::string> last;  // lines of the last column, not yet wrapped
  };
  std::vector<std::size_t> widths() const;

  std::vector<std::string> headings_;
  std::vector<Row> rows_;
};

}  // namespace lockstep::cli
