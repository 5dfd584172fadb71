#include "projects/cam_files/table.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <span>
#include <utility>

#include "projects/cam_files/fields.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMaximumProblems = 1000;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // of UTF-8, as spreadsheets begin a file

/// What parts the numbers of a table, by its first row: tab, else semicolon, else comma.
char separator_of(std::string_view text) {
  while (!text.empty() && (text.front() == '#' || text.front() == '\r' || text.front() == '\n'))
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);  // what a comment holds tells nothing
  text = text.substr(0, text.find('\n'));
  for (const char separator : {'\t', ';'})
    if (text.find(separator) != text.npos) return separator;
  return ',';
}

std::string text_of(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(std::begin(buffer), std::end(buffer), value);
  return {buffer, end};
}

struct Cell {
  std::string_view text;
  std::size_t column;  // from 1
};

/// Whether a row has numbers only, and the letters that go with them.
bool has_numbers_only(std::string_view row) {
  return row.find_first_not_of("ISP+-.,;0123456789eE \t\r\"") == row.npos;
}

/// Whether two neighbours of a row with commas may be one number with a decimal comma: whole digits, a comma,
/// and digits right behind it.
bool may_be_one(const Cell& left, const Cell& right) {
  constexpr std::string_view kDigits = "0123456789";
  if (left.text.empty() || right.text.empty() || right.column != left.column + left.text.size() + 1)
    return false;
  const std::size_t sign = left.text.front() == '-' || left.text.front() == '+' ? 1 : 0;
  return left.text.size() > sign && left.text.find_first_not_of(kDigits, sign) == left.text.npos &&
         kDigits.find(right.text.front()) != kDigits.npos &&
         right.text.find_first_not_of("0123456789eE+-") == right.text.npos;
}

/// A row as it reads with so many decimal commas, the other commas being between numbers.
std::string reading(std::span<const Cell> cells, std::size_t decimal, bool from_behind) {
  std::vector<std::string> numbers;
  std::vector<bool> joined(cells.size() + 1);  // to the one before
  for (std::size_t k = 1; decimal > 0 && k < cells.size(); ++k) {
    const std::size_t i = from_behind ? cells.size() - k : k;
    joined[i] = !joined[i - 1] && !joined[i + 1] && may_be_one(cells[i - 1], cells[i]);
    if (joined[i]) --decimal;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (joined[i])
      numbers.back().append(".").append(cells[i].text);
    else
      numbers.emplace_back(cells[i].text);
  }
  std::string text;
  for (const std::string& number : numbers) text += (text.empty() ? "" : " | ") + number;
  return text;
}

/// One pass over a table that knows where it is.
class TableReader {
 public:
  TableReader(std::string_view text, CamDefinition& definition, std::vector<Problem>& problems,
              std::vector<Problem>& warnings)
      : text_(text.starts_with(kByteOrderMark) ? text.substr(kByteOrderMark.size()) : text),
        separator_(separator_of(text_)),
        definition_(definition),
        problems_(problems),
        warnings_(warnings) {
    find_decimal_point();
  }

  void read() {
    while (!text_.empty() && problems_.size() < kMaximumProblems) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      const std::size_t first = line.find_first_not_of(" \t,;");
      if (first != line.npos && line[first] != '#') read_row(cells_of(line));
    }
    if (problems_.size() == kMaximumProblems)
      tell(1, "there are more problems; the rest of the file is not looked at");
    if (rows_ == 0 && problems_.empty()) tell(1, "the file has no points and no segments");
  }

  /// Where a point (or segment) of the data block comes from.
  std::string place_of(const CamFinding& finding) const {
    const auto& lines = finding.transition ? segment_lines_ : point_lines_;
    return finding.element < lines.size() ? std::to_string(lines[finding.element]) + ":1" : "1:1";
  }

  std::vector<TO_Cam_Struct_PointData> points;
  std::vector<TO_Cam_Struct_SegmentData> segments;

 private:
  enum class Kind { unknown, points, elements };

  /// The first row with a decimal point: from then on it is known what the commas are.
  void find_decimal_point() {
    std::string_view rest = text_;
    for (std::size_t line = 1; !rest.empty() && point_line_ == 0; ++line) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view row = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      const std::size_t first = row.find_first_not_of(" \t,;");
      if (first != row.npos && row[first] != '#' && has_numbers_only(row) && row.find('.') != row.npos)
        point_line_ = line;
    }
  }

  /// Whether a row with commas has one reading alone; if not, that is told with both.
  /// @param maximum decimal commas that such a row may have
  bool is_clear(std::span<const Cell> numbers, std::size_t maximum) {
    bool decimal = false;
    for (std::size_t i = 1; i < numbers.size(); ++i) decimal |= may_be_one(numbers[i - 1], numbers[i]);
    if (!decimal) return true;
    tell(numbers.front().column,
         "the commas may part numbers, " + reading(numbers, 0, false) + ", or some be decimal commas, " +
             reading(numbers, maximum, numbers.size() == 3) +
             "; allowed: ';' or a tab between the numbers, or numbers with a decimal point");
    return false;
  }

  void tell(std::size_t column, std::string text) {
    problems_.push_back(
        {std::to_string(std::max<std::size_t>(line_, 1)) + ":" + std::to_string(column), std::move(text)});
  }

  std::vector<Cell> cells_of(std::string_view line) const {
    std::vector<Cell> cells;
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(separator_, begin), line.size());
      std::string_view cell = line.substr(begin, end - begin);
      std::size_t column = begin + 1;
      while (cell.starts_with(' ')) {
        cell.remove_prefix(1);
        ++column;
      }
      while (cell.ends_with(' ')) cell.remove_suffix(1);
      if (cell.size() >= 2 && cell.starts_with('"') && cell.ends_with('"')) {  // as spreadsheets write texts
        cell = cell.substr(1, cell.size() - 2);
        ++column;
      }
      cells.push_back({cell, column});
      begin = end + 1;
    }
    return cells;
  }

  void read_row(const std::vector<Cell>& cells) {
    const std::string_view first = cells.front().text;
    const bool letter = first == "P" || first == "S" || first == "I";
    if (kind_ == Kind::unknown) {
      kind_ = letter ? Kind::elements : Kind::points;
      if (!letter && !is_number(first)) return read_header(cells);
    }
    ++rows_;
    if (kind_ == Kind::points) return read_point(cells, 0);
    if (first == "P") return read_point(cells, 1);
    if (first == "S") return read_segment(cells);
    if (first == "I") return read_interpolation(cells);
    tell(cells.front().column, "a row of elements begins with " + quote(first) +
                                   "; allowed: P for a point, S for a segment, I for the interpolation");
  }

  bool has_cells(const std::vector<Cell>& cells, std::size_t minimum, std::size_t maximum,
                 std::string_view what) {
    if (cells.size() >= minimum && cells.size() <= maximum) return true;
    const std::size_t at = std::min(cells.size(), maximum + 1) - 1;
    tell(cells[at].column,
         "the row has " + std::to_string(cells.size()) + " values; allowed: " + std::string(what));
    return false;
  }

  /// The names of the columns, which may stand in the first row.
  void read_header(const std::vector<Cell>& cells) {
    named_ = true;
    columns_ = cells.size();
    constexpr std::string_view kColumns[] = {"x", "y"};
    for (std::size_t i = 0; i < std::size(kColumns); ++i)
      if (i >= cells.size() || lower_case(cells[i].text) != kColumns[i])
        return tell(
            cells[std::min(i, cells.size() - 1)].column,
            quote(cells[std::min(i, cells.size() - 1)].text) +
                " is not allowed here; allowed in the first row: numbers, or the names of the columns, "
                "x and y first");
  }

  static std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
  }

  static bool is_number(std::string_view text) {
    return !text.empty() && text.find_first_not_of("+-.,0123456789eE") == text.npos &&
           text.find_first_of("0123456789") != text.npos;
  }

  /// Two numbers are x and y. More of them, parted by commas, are clear where the file has shown what its
  /// commas are: by the names of its columns, or by a decimal point; and where all rows have as many as the
  /// first.
  bool has_point_cells(const std::vector<Cell>& cells) {
    if (columns_ == 0) columns_ = cells.size();
    const bool shown = cells.size() == columns_ && (named_ || point_line_ != 0);
    if (!has_cells(cells, 2, 5, "x,y and perhaps velocity, acceleration and jerk")) return false;
    if (separator_ == ',' && cells.size() > 2 && !shown && !is_clear(cells, cells.size() == 3 ? 1 : 2))
      return false;
    if (separator_ == ',' && cells.size() > 2 && cells.size() != columns_) {
      tell(cells[std::min(cells.size(), columns_ + 1) - 1].column,
           "the row has " + std::to_string(cells.size()) + " values, those before it " +
               std::to_string(columns_) + "; allowed: as many in each row");
      return false;
    }
    if (cells.size() > 2 && !std::exchange(told_of_derivatives_, true))
      warnings_.push_back({std::to_string(line_) + ":" + std::to_string(cells[2].column),
                           "velocity, acceleration and jerk are not read: a cam of points has those of its "
                           "interpolation; segments keep derivatives"});
    return true;
  }

  void read_point(const std::vector<Cell>& cells, std::size_t first) {
    if (first == 0 ? !has_point_cells(cells) : !has_cells(cells, 3, 3, "P,x,y")) return;
    double values[5] = {};
    bool good = true;
    for (std::size_t i = first; i < cells.size(); ++i) good &= read_number(cells[i], values[i - first]);
    if (!good) return;
    points.push_back({values[0], values[1]});
    point_lines_.push_back(line_);
  }

  void read_segment(const std::vector<Cell>& cells) {
    constexpr std::size_t kNumbers = std::size(cam_fields::kSegment);
    if (!has_cells(cells, kNumbers, kNumbers + 1,
                   "S,xmin,xmax,a0,a1,a2,a3,a4,a5,a6,sineAmplitude,sinePeriod,sinePhase and perhaps origin"))
      return;
    // Without an origin there is one number less, and a decimal comma makes it up.
    if (separator_ == ',' && cells.size() > kNumbers && point_line_ == 0 &&
        !is_clear(std::span(cells).subspan(1), 1))
      return;
    TO_Cam_Struct_SegmentData segment;
    bool good = true;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i)
      good &=
          read_number(cells[i + 1],
                      segment.*std::get<double TO_Cam_Struct_SegmentData::*>(cam_fields::kSegment[i].member));
    if (!good) return;
    segments.push_back(segment);
    segment_lines_.push_back(line_);
  }

  void read_interpolation(const std::vector<Cell>& cells) {
    if (!has_cells(cells, 3, 3, "I,InterpolationMode,BoundaryConditions")) return;
    TO_Cam_Struct_InterpolationSettings& settings = definition_.design.interpolation;
    const auto read = [&](const Cell& cell, DINT maximum, DINT& target) {
      DINT value = -1;
      const auto [end, error] = std::from_chars(cell.text.data(), cell.text.data() + cell.text.size(), value);
      if (error == std::errc{} && end == cell.text.data() + cell.text.size() && value >= 0 &&
          value <= maximum)
        target = value;
      else
        tell(cell.column,
             quote(cell.text) + " is not allowed here; allowed: 0 to " + std::to_string(maximum));
    };
    read(cells[1], 2, settings.InterpolationMode);
    read(cells[2], 1, settings.BoundaryConditions);
  }

  /// With tabs or semicolons between the numbers a comma is the decimal sign, if there is no decimal point.
  bool read_number(const Cell& cell, double& target) {
    std::string text(cell.text);
    const auto comma = text.find(',');
    if (comma != text.npos && is_number(text) && point_line_ != 0) {
      tell(cell.column, quote(text) + " has a decimal comma, and line " + std::to_string(point_line_) +
                            " a decimal point; allowed: one of them in the whole file");
      return false;
    }
    if (comma != text.npos) text[comma] = '.';
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), target);
    if (error == std::errc{} && end == text.data() + text.size() && target >= -kLargestCamNumber &&
        target <= kLargestCamNumber)
      return true;
    tell(cell.column,
         quote(cell.text) + " is not allowed here; allowed: a number from -1e12 to 1e12, such as 1.5");
    return false;
  }

  std::string_view text_;
  char separator_;
  CamDefinition& definition_;
  std::vector<Problem>& problems_;
  std::vector<Problem>& warnings_;
  bool told_of_derivatives_ = false;
  std::size_t point_line_ = 0;  // the first with a decimal point; 0: none
  std::size_t columns_ = 0;     // of the first row of points; 0: there was none
  bool named_ = false;          // the first row has their names
  Kind kind_ = Kind::unknown;
  std::size_t line_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::size_t> point_lines_, segment_lines_;
};

}  // namespace

void read_cam_table(std::string_view text, CamDefinition& definition, std::vector<Problem>& problems,
                    std::vector<Problem>& warnings) {
  TableReader reader(text, definition, problems, warnings);
  reader.read();
  if (!problems.empty()) return;
  definition.cam = interpolated_cam(std::move(reader.points), std::move(reader.segments),
                                    definition.design.interpolation, definition.capacity);
  for (const CamFinding& problem : definition.cam.problems)
    problems.push_back({reader.place_of(problem), problem.text});
  for (const CamFinding& warning : definition.cam.warnings)
    warnings.push_back({reader.place_of(warning), warning.text});
}

namespace {

/// A table whose rows have more than two numbers shows by a decimal point what its commas are.
std::string with_decimal_point(std::string text, char separator) {
  if (separator != ',' || text.find('.') != text.npos) return text;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::string_view row = std::string_view(text).substr(begin, end - begin);
    if (std::count(row.begin(), row.end(), ',') > 2) {
      const std::size_t last = begin + row.rfind(',') + 1;
      const std::size_t exponent = text.find('e', last);
      return text.insert(std::min(exponent, end), ".0");
    }
    begin = end + 1;
  }
  return text;
}

}  // namespace

std::string cam_element_table(const CamDefinition& definition, char separator) {
  const TO_Cam_Struct_InterpolationSettings& settings = definition.design.interpolation;
  std::string text = std::string("I") + separator + std::to_string(settings.InterpolationMode) + separator +
                     std::to_string(settings.BoundaryConditions) + "\n";
  for (const TO_Cam_Struct_SegmentData& segment : definition.cam.segments) {
    text += 'S';
    for (const auto& number : cam_fields::kSegment)
      text += separator + text_of(segment.*std::get<double TO_Cam_Struct_SegmentData::*>(number.member));
    text += '\n';
  }
  for (const TO_Cam_Struct_PointData& point : definition.cam.points)
    text += std::string("P") + separator + text_of(point.x) + separator + text_of(point.y) + "\n";
  return with_decimal_point(std::move(text), separator);
}

std::vector<CamSample> sampled(const CamFunction& cam, double from, double to, std::size_t count) {
  std::vector<CamSample> samples;
  std::size_t piece = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count - 1);
    const double x = k + 1 < count ? from + part * (to - from) : to;
    while (piece + 1 < cam.piece_count() && cam.piece_start(piece + 1) <= x) ++piece;
    samples.push_back({x, cam.piece_value(piece, x)});
    samples.back().value.position = cam.value(x).position;  // at the end the defined one to the last bit
  }
  return samples;
}

std::string cam_point_table(const std::vector<CamSample>& samples, bool derivatives, char separator) {
  std::string text;
  for (const CamSample& sample : samples) {
    text += text_of(sample.x) + separator + text_of(sample.value.position);
    if (derivatives)
      for (const double value : {sample.value.first, sample.value.second, sample.value.third})
        text += separator + text_of(value);
    text += '\n';
  }
  return with_decimal_point(std::move(text), separator);
}

}  // namespace lockstep
