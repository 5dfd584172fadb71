#include "projects/studio/trace_analysis.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "hmi_bridge/studio/frames.hpp"
#include "projects/studio/api_values.hpp"
#include "projects/studio/spectrum.hpp"

namespace lockstep::studio_api {
namespace {

constexpr std::int64_t kLongestShift = 1'000'000'000'000'000;  // [ns]
constexpr double kUneven = 1e-3;                               // of a cycle, by which rows may be apart

std::size_t column_of(const StudioRequest& request, const TraceStore& store, const char* key) {
  const std::string path(request.value(key));
  const auto column = store.find(path);
  if (!column) throw BadRequest(422, "not_found", std::string(key) + ": '" + path + "' is not in this trace");
  return *column;
}

double number_of(const StudioRequest& request, std::string_view key, double otherwise) {
  const std::string_view text = request.value(key);
  if (text.empty()) return otherwise;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number))
    throw BadRequest(422, "wrong_type",
                     std::string(key) + ": '" + std::string(text) + "' has to be a number");
  return number;
}

std::int64_t shift_of(const StudioRequest& request) {
  const std::int64_t shift = whole_number(request, "shift", 0);
  if (std::abs(static_cast<double>(shift)) > static_cast<double>(kLongestShift))
    throw BadRequest(422, "out_of_range", "shift: allowed are 1000000 s either way");
  return shift;
}

std::vector<double> values_of(const TraceWindow& rows, std::size_t column) {
  std::vector<double> values;
  values.reserve(rows.t.size());
  for (const Value value : rows.columns[column].first)
    values.push_back(as_double(value, rows.columns[column].type));
  return values;
}

/// A transform of rows needs all of them, at equal distances.
void require_even(const TraceStore& store, const TracePart& part, const TraceWindow& rows) {
  for (const TraceStore::Gap& gap : store.gaps())
    if (gap.row > part.first && gap.row < part.behind)
      throw BadRequest(409, "conflict",
                       std::to_string(gap.missing) + " rows are missing before " + std::to_string(gap.t) +
                           " ns; allowed: a time without gaps");
  // That of most rows, so that it is the place of the gap that is told.
  std::vector<std::int64_t> distances;
  distances.reserve(rows.t.size() - 1);
  for (std::size_t i = 1; i < rows.t.size(); ++i) distances.push_back(rows.t[i] - rows.t[i - 1]);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  const auto distance = static_cast<double>(*middle);
  for (std::size_t i = 1; i < rows.t.size(); ++i)
    if (std::abs(static_cast<double>(rows.t[i] - rows.t[i - 1]) - distance) > kUneven * distance + 1.0 ||
        rows.t[i] == rows.t[i - 1])
      throw BadRequest(409, "conflict",
                       "the rows are not at equal distances at " + std::to_string(rows.t[i]) +
                           " ns; allowed: a time in which they are");
}

void require_numbers(const std::vector<double>& values, const TraceWindow& rows) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw BadRequest(409, "conflict",
                       "the signal has no number at " + std::to_string(rows.t[i]) +
                           " ns; allowed: a time in which it has");
}

Json spectrum_json(const Spectrum& spectrum) {
  const std::size_t width = (spectrum.amplitude.size() + kSpectrumValues - 1) / kSpectrumValues;
  Json amplitude = Json::array();
  for (std::size_t i = 0; i < spectrum.amplitude.size(); i += std::max<std::size_t>(width, 1)) {
    const auto begin = spectrum.amplitude.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = begin + static_cast<std::ptrdiff_t>(std::min(width, spectrum.amplitude.size() - i));
    amplitude.push_back(number_json(*std::max_element(begin, end)));
  }
  return {{"n", spectrum.rows},
          {"step", spectrum.step},
          {"width", width},
          {"amplitude", amplitude},
          {"peaks", array_of(spectrum.peaks, [](const Spectrum::Peak& peak) {
             return Json{{"at", peak.at}, {"amplitude", peak.amplitude}};
           })}};
}

/// Keeps of each stretch of rows the extremes of both signals, its first and its last row.
std::vector<std::size_t> outline(const std::vector<double>& x, const std::vector<double>& y,
                                 std::size_t stretches) {
  std::vector<std::size_t> kept;
  const std::size_t size = (x.size() + stretches - 1) / stretches;
  for (std::size_t from = 0; from < x.size(); from += size) {
    const std::size_t to = std::min(from + size, x.size());
    std::array<std::size_t, 6> rows{from, from, from, from, from, to - 1};
    for (std::size_t i = from; i < to; ++i) {
      // What is no number gives way to each that is one.
      if (x[i] < x[rows[1]] || std::isnan(x[rows[1]])) rows[1] = i;
      if (x[i] > x[rows[2]] || std::isnan(x[rows[2]])) rows[2] = i;
      if (y[i] < y[rows[3]] || std::isnan(y[rows[3]])) rows[3] = i;
      if (y[i] > y[rows[4]] || std::isnan(y[rows[4]])) rows[4] = i;
    }
    std::ranges::sort(rows);
    for (const std::size_t row : rows)
      if (kept.empty() || kept.back() != row) kept.push_back(row);
  }
  return kept;
}

/// Whole numbers of 64 bits, of which many have no real number of their own.
bool is_wide(Type type) noexcept {
  return type == Type::LINT || type == Type::ULINT || type == Type::LWORD || type == Type::TIME;
}

/// What lies between two whole numbers of a type of 64 bits.
std::uint64_t distance_of(Value a, Value b, Type type) noexcept {
  const bool is_signed = type == Type::LINT || type == Type::TIME;
  const bool is_more = is_signed ? a.i > b.i : a.u > b.u;
  return is_more ? a.u - b.u : b.u - a.u;
}

/// Whether a whole number is no more than a real one, to the last digit.
bool is_within(std::uint64_t whole, double tolerance) noexcept {
  return tolerance >= 0x1p64 || whole <= static_cast<std::uint64_t>(tolerance);
}

/// How two runs differ in a signal.
struct Difference {
  Type type = Type::LREAL;  // of both, if they are the same whole numbers of 64 bits
  std::uint64_t different = 0;
  std::int64_t first_t = 0, maximum_t = 0;
  std::uint64_t first_tick = 0;
  Value first_a{}, first_b{};
  double maximum = 0.0;
  std::uint64_t wide_maximum = 0;

  /// Of values of the type.
  void add(Value a, Value b, std::int64_t t, std::uint64_t tick, double tolerance) {
    const std::uint64_t wide = is_wide(type) ? distance_of(a, b, type) : 0;
    const bool same = is_wide(type)
                          ? is_within(wide, tolerance)
                          : a.r == b.r || (a.r != a.r && b.r != b.r) || std::abs(a.r - b.r) <= tolerance;
    if (same) return;
    if (different++ == 0) {
      first_t = t;
      first_tick = tick;
      first_a = a;
      first_b = b;
    }
    // A row without a number on one side is no distance: it is told only if there is no other.
    const double apart = is_wide(type) ? 0.0 : std::abs(a.r - b.r);
    if (apart > maximum || wide > wide_maximum || std::isnan(maximum) || different == 1) {
      maximum = apart;
      wide_maximum = wide;
      maximum_t = t;
    }
  }
  Json json(const std::string& path) const {
    Json json = {{"path", path}, {"different", different}};
    if (different == 0) return json;
    json["first"] = {{"t", std::to_string(first_t)},
                     {"tick", std::to_string(first_tick)},
                     {"a", value_json(first_a, type)},
                     {"b", value_json(first_b, type)}};
    json["maximum"] = {
        {"difference", is_wide(type) ? Json(std::to_string(wide_maximum)) : number_json(maximum)},
        {"t", std::to_string(maximum_t)}};
    return json;
  }
};

/// The signals that are compared: those named, else all that both have.
std::vector<std::string> compared_signals(const StudioRequest& request, const TraceStore& a,
                                          const TraceStore& b) {
  std::vector<std::string> paths = split(request.value("signals"));
  for (const auto& [key, value] : request.query)
    if (key == "signal") paths.push_back(value);
  if (paths.empty())
    for (const TraceSignal& signal : a.signals())
      if (b.find(signal.name)) paths.push_back(signal.name);
  for (const std::string& path : paths)
    if (!a.find(path) || !b.find(path))
      throw BadRequest(422, "not_found", "'" + path + "' is not in both traces");
  if (paths.empty()) throw BadRequest(422, "not_found", "the traces have no signal in common");
  return paths;
}

}  // namespace

StudioAnswer spectrum_answer(const StudioRequest& request, const TraceStore& store, const TracePart& part) {
  const std::string_view name = request.value("window", "hann");
  const std::optional<SpectrumWindow> window = spectrum_window(name);
  if (!window)
    throw BadRequest(422, "bad_request",
                     "window: '" + std::string(name) + "'; allowed: hann, rectangle, flattop");
  std::vector<std::size_t> columns = {column_of(request, store, "signal")};
  const bool has_order = !request.value("order").empty();
  if (has_order) columns.push_back(column_of(request, store, "order"));
  const std::uint64_t count = part.behind - part.first;
  if (count > kSpectrumRows)
    return error_answer(413, "too_large",
                        std::to_string(count) + " rows; allowed: " + std::to_string(kSpectrumRows));
  if (count < 4) throw BadRequest(416, "out_of_range", "a spectrum needs four rows at least");
  const TraceWindow rows = store.rows(columns, part.first, part.behind);
  if (rows.t.size() < 4) throw BadRequest(416, "out_of_range", "a spectrum needs four rows at least");
  require_even(store, part, rows);
  std::vector<double> values = values_of(rows, 0);
  require_numbers(values, rows);
  double distance =
      static_cast<double>(rows.t.back() - rows.t.front()) * 1e-9 / static_cast<double>(rows.t.size() - 1);
  if (has_order) {
    const std::vector<double> position = values_of(rows, 1);
    require_numbers(position, rows);
    values = by_order(position, values, distance);
    if (values.empty())
      throw BadRequest(409, "conflict", "the leading axis stands or turns back within this time");
  }
  Json json = {{"signal", store.signals()[columns[0]].name}, {"unit", store.signals()[columns[0]].unit},
               {"axis", has_order ? "order" : "Hz"},         {"window", name},
               {"from", std::to_string(rows.t.front())},     {"to", std::to_string(rows.t.back())}};
  json.update(spectrum_json(spectrum_of(values, distance, *window)));
  return answer_of(json);
}

StudioAnswer xy_answer(const StudioRequest& request, const TraceStore& store, const TraceStore& other) {
  const std::int64_t points = whole_number(request, "points", 2000);
  if (points < 1 || points > static_cast<std::int64_t>(kWindowPoints))
    throw BadRequest(422, "out_of_range", "points: " + std::to_string(points) + "; allowed: 1 to 20000");
  const std::int64_t shift = shift_of(request);
  const TracePart part = trace_part(request, store);
  const std::array<std::size_t, 1> x_column{column_of(request, store, "x")};
  const std::array<std::size_t, 1> y_column{column_of(request, other, "y")};
  if (part.behind - part.first > kComparedRows)
    return error_answer(413, "too_large", "allowed: " + std::to_string(kComparedRows) + " rows");
  TraceWindow rows = store.rows(x_column, part.first, part.behind);
  if (rows.t.empty()) throw BadRequest(416, "out_of_range", "there are no rows in this time");
  const std::uint64_t first = other.row_at(rows.t.front() + shift);
  const std::uint64_t behind = other.row_at(rows.t.back() + shift + 1);
  const TraceWindow others = other.rows(y_column, first, behind);
  std::vector<double> x, y;
  std::vector<std::size_t> of_row;
  const std::vector<double> all_x = values_of(rows, 0), all_y = values_of(others, 0);
  for (std::size_t i = 0, k = 0; i < rows.t.size(); ++i) {
    while (k < others.t.size() && others.t[k] < rows.t[i] + shift) ++k;
    if (k >= others.t.size() || others.t[k] != rows.t[i] + shift) continue;
    x.push_back(all_x[i]);
    y.push_back(all_y[k]);
    of_row.push_back(i);
  }
  if (x.empty()) throw BadRequest(416, "out_of_range", "the two have no rows of the same time");
  TraceWindow outlined;
  outlined.columns.resize(2);
  outlined.columns[0].signal = x_column[0];
  outlined.columns[1].signal = y_column[0];
  for (const std::size_t i : outline(x, y, static_cast<std::size_t>(points))) {
    outlined.t.push_back(rows.t[of_row[i]]);
    outlined.tick.push_back(rows.tick[of_row[i]]);
    outlined.columns[0].first.push_back(Value{.r = x[i]});
    outlined.columns[1].first.push_back(Value{.r = y[i]});
  }
  StudioAnswer answer;
  answer.type = "application/octet-stream";
  const std::vector<std::uint8_t> bytes = encode_frame({StudioFrameKind::window, 0, 0, 0}, outlined);
  answer.body.assign(bytes.begin(), bytes.end());
  return answer;
}

StudioAnswer compare_answer(const StudioRequest& request, const TraceStore& a, const TraceStore& b) {
  const std::int64_t shift = shift_of(request);
  const double tolerance = number_of(request, "tolerance", 0.0);
  if (tolerance < 0.0) throw BadRequest(422, "out_of_range", "tolerance: allowed are 0 and above");
  const TracePart part = trace_part(request, a);
  const std::vector<std::string> paths = compared_signals(request, a, b);
  if ((part.behind - part.first) * paths.size() > kComparedRows)
    return error_answer(413, "too_large",
                        "allowed: " + std::to_string(kComparedRows) + " rows times signals");
  std::vector<std::size_t> columns_a, columns_b;
  for (const std::string& path : paths) {
    columns_a.push_back(*a.find(path));
    columns_b.push_back(*b.find(path));
  }
  const TraceWindow of_a = a.rows(columns_a, part.first, part.behind);
  if (of_a.t.empty()) throw BadRequest(416, "out_of_range", "there are no rows in this time");
  const TraceWindow of_b =
      b.rows(columns_b, b.row_at(of_a.t.front() + shift), b.row_at(of_a.t.back() + shift + 1));
  std::vector<Difference> differences(paths.size());
  for (std::size_t c = 0; c < paths.size(); ++c)
    if (of_a.columns[c].type == of_b.columns[c].type && is_wide(of_a.columns[c].type))
      differences[c].type = of_a.columns[c].type;
  std::uint64_t rows = 0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < of_a.t.size(); ++i) {
    while (k < of_b.t.size() && of_b.t[k] < of_a.t[i] + shift) ++k;
    if (k >= of_b.t.size() || of_b.t[k] != of_a.t[i] + shift) continue;
    ++rows;
    for (std::size_t c = 0; c < paths.size(); ++c) {
      const Type type = differences[c].type;
      const auto value = [type](const TraceWindow& window, std::size_t column, std::size_t row) {
        const Value given = window.columns[column].first[row];
        return is_wide(type) ? given : Value{.r = as_double(given, window.columns[column].type)};
      };
      differences[c].add(value(of_a, c, i), value(of_b, c, k), of_a.t[i], of_a.tick[i], tolerance);
    }
  }
  Json signals = Json::array();
  Json first;
  std::int64_t first_t = 0;
  for (std::size_t c = 0; c < paths.size(); ++c) {
    signals.push_back(differences[c].json(paths[c]));
    if (differences[c].different == 0 || (!first.is_null() && differences[c].first_t >= first_t)) continue;
    first_t = differences[c].first_t;
    first = {{"path", paths[c]},
             {"t", std::to_string(first_t)},
             {"tick", std::to_string(differences[c].first_tick)}};
  }
  return answer_of(Json{{"rows", rows},
                        {"only_a", of_a.t.size() - rows},
                        {"only_b", of_b.t.size() - std::min<std::uint64_t>(rows, of_b.t.size())},
                        {"first", first},
                        {"signals", signals}});
}

}  // namespace lockstep::studio_api
