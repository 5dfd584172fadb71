#include "hmi_bridge/traces/store.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr std::size_t kMaximumGaps = 1000;
constexpr std::uint64_t kRowsPerPoint = 4;  // from which on extremes say more than the rows themselves

const double kNoNumber = std::numeric_limits<double>::quiet_NaN();

bool is_less(Value a, Value b, Type type) noexcept {
  if (is_real(type)) return a.r < b.r;
  return lowest(type) < 0 ? a.i < b.i : a.u < b.u;
}

Value as_real(Value value, Type type) noexcept {
  Value real{};
  real.r = as_double(value, type);
  return real;
}

Value no_number() noexcept {
  Value value{};
  value.r = kNoNumber;
  return value;
}

}  // namespace

bool TraceStore::is_number(Value value, Type type) noexcept {
  return !is_real(type) || value.r == value.r;
}

/// NaN counts only where there is nothing else.
void TraceStore::widen(Extremes& extremes, const Extremes& by, Type type) noexcept {
  if (!is_number(extremes.minimum, type)) {
    extremes = by;
  } else if (is_number(by.minimum, type)) {
    if (is_less(by.minimum, extremes.minimum, type)) extremes.minimum = by.minimum;
    if (is_less(extremes.maximum, by.maximum, type)) extremes.maximum = by.maximum;
  }
}

const TraceStore::Column* TraceStore::Portion::column(std::size_t signal) const noexcept {
  if (signal >= column_of.size() || column_of[signal] == kNoColumn) return nullptr;
  return &columns[column_of[signal]];
}

TraceStore::TraceStore(const TraceTable& table) {
  set_signals(table.signals);
  std::vector<Value> values(table.signals.size());
  for (std::size_t row = 0; row < table.t.size(); ++row) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double number = table.columns[i][row];
      const Type type = table.signals[i].type;
      if (is_real(type))
        values[i].r = number;
      else if (type == Type::TIME)
        values[i].i = std::llround(number * 1e9);
      else if (lowest(type) < 0)
        values[i].i = static_cast<std::int64_t>(number);
      else
        values[i].u = static_cast<std::uint64_t>(number);
    }
    append(std::llround(table.t[row] * 1e9), row, values);
  }
}

std::optional<std::size_t> TraceStore::find(std::string_view name) const noexcept {
  for (std::size_t i = 0; i < signals_.size(); ++i)
    if (signals_[i].name == name) return i;
  return {};
}

void TraceStore::set_signals(std::span<const TraceSignal> signals) {
  current_.clear();
  for (const TraceSignal& signal : signals) {
    const std::optional<std::size_t> known = find(signal.name);
    current_.push_back(known.value_or(signals_.size()));
    if (!known) signals_.push_back(signal);
  }
  opens_ = true;
}

std::size_t TraceStore::bytes_of(const Portion& portion) noexcept {
  std::size_t bytes = sizeof(Portion) + portion.t.capacity() * 16 + portion.column_of.capacity() * 4;
  for (const Column& column : portion.columns) {
    bytes += sizeof(Column) + column.values.capacity() * sizeof(Value);
    for (const std::vector<Extremes>& level : column.pyramid) bytes += level.capacity() * sizeof(Extremes);
  }
  return bytes;
}

std::size_t TraceStore::bytes() const noexcept {
  return closed_bytes_ + (portions_.empty() ? 0 : bytes_of(portions_.back()));
}

void TraceStore::open_portion() {
  if (!portions_.empty()) {
    Portion& last = portions_.back();
    last.t.shrink_to_fit();
    last.tick.shrink_to_fit();
    for (Column& column : last.columns) column.values.shrink_to_fit();
    last.bytes = bytes_of(last);
    closed_bytes_ += last.bytes;
  }
  Portion& portion = portions_.emplace_back();
  portion.begin = end_;
  portion.column_of.assign(signals_.size(), kNoColumn);
  for (const std::size_t signal : current_) {
    portion.column_of[signal] = static_cast<std::uint32_t>(portion.columns.size());
    portion.columns.push_back({signals_[signal].type, {}, {}});
  }
  opens_ = false;
}

/// Adds the buckets that its last value has made whole.
void TraceStore::build(Column& column) {
  const std::size_t rows = column.values.size();
  std::size_t size = kFan;
  for (std::size_t level = 0; level < kLevels && rows % size == 0; ++level, size *= kFan) {
    Extremes bucket{};
    for (std::size_t i = 0; i < kFan; ++i) {
      const Value* const row = &column.values[rows - kFan + i];
      const Extremes part = level == 0
                                ? Extremes{*row, *row}
                                : column.pyramid[level - 1][column.pyramid[level - 1].size() - kFan + i];
      if (i == 0)
        bucket = part;
      else
        widen(bucket, part, column.type);
    }
    column.pyramid[level].push_back(bucket);
  }
}

void TraceStore::append(std::int64_t t, std::uint64_t tick, std::span<const Value> values,
                        std::uint64_t missing) {
  if (opens_ || portions_.back().t.size() == kPortion) open_portion();
  Portion& portion = portions_.back();
  portion.t.push_back(t);
  portion.tick.push_back(tick);
  for (std::size_t i = 0; i < portion.columns.size(); ++i) {
    portion.columns[i].values.push_back(values[i]);
    build(portion.columns[i]);
  }
  if (missing > 0) gaps_.push_back({t, end_, missing});
  if (gaps_.size() > kMaximumGaps) gaps_.pop_front();
  ++end_;
  forget_oldest();
}

void TraceStore::forget_oldest() {
  const std::int64_t newest = portions_.back().t.back();
  while (portions_.size() > 1 &&
         (closed_bytes_ > limits_.bytes || newest - portions_.front().t.back() > limits_.history)) {
    closed_bytes_ -= portions_.front().bytes;
    portions_.pop_front();
    begin_ = portions_.front().begin;
  }
  while (!gaps_.empty() && gaps_.front().row < begin_) gaps_.pop_front();
}

/// Of a row that is kept.
std::size_t TraceStore::portion_of(std::uint64_t row) const noexcept {
  const auto behind =
      std::upper_bound(portions_.begin(), portions_.end(), row,
                       [](std::uint64_t wanted, const Portion& portion) { return wanted < portion.begin; });
  return static_cast<std::size_t>(behind - portions_.begin()) - 1;
}

std::int64_t TraceStore::t(std::uint64_t row) const noexcept {
  const Portion& portion = portions_[portion_of(row)];
  return portion.t[row - portion.begin];
}

std::uint64_t TraceStore::row_at(std::int64_t t) const noexcept {
  const auto portion = std::partition_point(portions_.begin(), portions_.end(),
                                            [t](const Portion& one) { return one.t.back() < t; });
  if (portion == portions_.end()) return end_;
  const auto row = std::lower_bound(portion->t.begin(), portion->t.end(), t);
  return portion->begin + static_cast<std::uint64_t>(row - portion->t.begin());
}

/// Of rows of one portion, at least one; by the largest buckets that lie within them.
TraceStore::Extremes TraceStore::extremes_of(const Column& column, std::size_t from,
                                             std::size_t to) noexcept {
  Extremes all{column.values[from], column.values[from]};
  while (from < to) {
    std::size_t level = 0;
    std::size_t size = 1;
    while (level < kLevels && from % (size * kFan) == 0 && from + size * kFan <= to) {
      size *= kFan;
      ++level;
    }
    const Extremes part = level == 0 ? Extremes{column.values[from], column.values[from]}
                                     : column.pyramid[level - 1][from / size];
    widen(all, part, column.type);
    from += size;
  }
  return all;
}

/// Of rows that are kept, at least one.
TraceStore::Point TraceStore::point_of(std::size_t signal, std::uint64_t from,
                                       std::uint64_t to) const noexcept {
  Point point{};
  Extremes all{};
  for (std::size_t i = portion_of(from); i < portions_.size() && portions_[i].begin < to; ++i) {
    const Portion& portion = portions_[i];
    const Column* const column = portion.column(signal);
    if (column == nullptr) continue;
    const std::size_t first = std::max(from, portion.begin) - portion.begin;
    const std::size_t behind = std::min(to, portion.end()) - portion.begin;
    const Extremes part = extremes_of(*column, first, behind);
    if (!point.is_present) {
      point.first = column->values[first];
      all = part;
    } else {
      widen(all, part, column->type);
    }
    point.last = column->values[behind - 1];
    point.is_present = true;
  }
  point.minimum = all.minimum;
  point.maximum = all.maximum;
  return point;
}

/// Whether some row of a range has no value of a signal.
bool TraceStore::is_missing(std::size_t signal, std::uint64_t from, std::uint64_t to) const noexcept {
  if (from >= to) return false;
  for (std::size_t i = portion_of(from); i < portions_.size() && portions_[i].begin < to; ++i)
    if (portions_[i].column(signal) == nullptr) return true;
  return false;
}

std::pair<std::uint64_t, std::uint64_t> TraceStore::kept(std::uint64_t from,
                                                         std::uint64_t to) const noexcept {
  const std::uint64_t first = std::clamp(from, begin_, end_);
  return {first, std::clamp(to, first, end_)};
}

/// A point for the rows between each two borders, which rise and are kept.
TraceWindow TraceStore::points(std::span<const std::size_t> signals,
                               std::span<const std::uint64_t> borders) const {
  TraceWindow window;
  window.is_coarse = true;
  for (const std::size_t signal : signals) {
    TraceWindow::Column& column = window.columns.emplace_back();
    const bool missing = is_missing(signal, borders.front(), borders.back());
    column.signal = signal;
    column.type = missing ? Type::LREAL : signals_[signal].type;
    const auto shown = [&](const Point& point, Value value) {
      if (!point.is_present) return no_number();
      return missing ? as_real(value, signals_[signal].type) : value;
    };
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
      const Point point = point_of(signal, borders[i], borders[i + 1]);
      column.first.push_back(shown(point, point.first));
      column.minimum.push_back(shown(point, point.minimum));
      column.maximum.push_back(shown(point, point.maximum));
      column.last.push_back(shown(point, point.last));
    }
  }
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const Portion& portion = portions_[portion_of(borders[i])];
    window.t.push_back(portion.t[borders[i] - portion.begin]);
    window.tick.push_back(portion.tick[borders[i] - portion.begin]);
  }
  return window;
}

TraceWindow TraceStore::rows(std::span<const std::size_t> signals, std::uint64_t from,
                             std::uint64_t to) const {
  const auto [first, behind] = kept(from, to);
  TraceWindow window;
  for (const std::size_t signal : signals) {
    TraceWindow::Column& column = window.columns.emplace_back();
    const bool missing = is_missing(signal, first, behind);
    column.signal = signal;
    column.type = missing ? Type::LREAL : signals_[signal].type;
    for (std::uint64_t row = first; row < behind;) {
      const Portion& portion = portions_[portion_of(row)];
      const Column* const values = portion.column(signal);
      for (; row < std::min(behind, portion.end()); ++row) {
        const Value value = values != nullptr ? values->values[row - portion.begin] : no_number();
        column.first.push_back(missing && values != nullptr ? as_real(value, values->type) : value);
      }
    }
  }
  for (std::uint64_t row = first; row < behind;) {
    const Portion& portion = portions_[portion_of(row)];
    for (; row < std::min(behind, portion.end()); ++row) {
      window.t.push_back(portion.t[row - portion.begin]);
      window.tick.push_back(portion.tick[row - portion.begin]);
    }
  }
  return window;
}

TraceWindow TraceStore::coarse(std::span<const std::size_t> signals, std::uint64_t from, std::uint64_t to,
                               std::uint64_t per_point) const {
  const auto [first, behind] = kept(from, to);
  if (first == behind) return rows(signals, first, behind);
  std::vector<std::uint64_t> borders;
  for (std::uint64_t row = first; row < behind; row += std::max<std::uint64_t>(per_point, 1))
    borders.push_back(row);
  borders.push_back(behind);
  return points(signals, borders);
}

TraceWindow TraceStore::window(std::span<const std::size_t> signals, std::uint64_t from, std::uint64_t to,
                               std::size_t points_wanted) const {
  const auto [first, behind] = kept(from, to);
  const std::uint64_t points_allowed = std::max<std::size_t>(points_wanted, 1);
  if (behind - first <= kRowsPerPoint * points_allowed) return rows(signals, first, behind);
  const std::int64_t begin = t(first);
  const double step = static_cast<double>(t(behind - 1) - begin + 1) / static_cast<double>(points_allowed);
  std::vector<std::uint64_t> borders{first};
  for (std::uint64_t i = 1; i < points_allowed; ++i) {
    const auto border = begin + static_cast<std::int64_t>(std::ceil(static_cast<double>(i) * step));
    const std::uint64_t row = std::min(row_at(border), behind);
    if (row > borders.back() && row < behind) borders.push_back(row);
  }
  borders.push_back(behind);
  return points(signals, borders);
}

TraceStatistics TraceStore::statistics(std::size_t signal, std::uint64_t from, std::uint64_t to) const {
  const auto [first, behind] = kept(from, to);
  TraceStatistics result;
  const TraceWindow window = rows(std::span(&signal, 1), first, behind);
  const TraceWindow::Column& column = window.columns[0];
  double squares = 0.0;  // of distances from the mean so far, which loses no digits of large values
  double power = 0.0;
  double before = kNoNumber;
  for (std::size_t i = 0; i < window.t.size(); ++i) {
    const double value = as_double(column.first[i], column.type);
    if (value == value && before == before)
      result.integral += 0.5 * (value + before) * static_cast<double>(window.t[i] - window.t[i - 1]) * 1e-9;
    before = value;
    if (value != value) {
      ++result.nans;
      continue;
    }
    if (result.rows == 0) result.first = value;
    if (result.rows == 0 || value < result.minimum) {
      result.minimum = value;
      result.t_minimum = window.t[i];
    }
    if (result.rows == 0 || value > result.maximum) {
      result.maximum = value;
      result.t_maximum = window.t[i];
    }
    ++result.rows;
    const double distance = value - result.mean;
    result.mean += distance / static_cast<double>(result.rows);
    squares += distance * (value - result.mean);
    power += value * value;
    result.last = value;
  }
  if (result.rows == 0) return result;
  result.deviation = std::sqrt(squares / static_cast<double>(result.rows));
  result.rms = std::sqrt(power / static_cast<double>(result.rows));
  return result;
}

TraceStore TraceStore::copy(std::uint64_t from, std::uint64_t to) const {
  const auto [first, behind] = kept(from, to);
  TraceStore made;
  std::vector<Value> values;
  auto gap = gaps_.begin();
  for (std::uint64_t row = first; row < behind;) {
    const Portion& portion = portions_[portion_of(row)];
    std::vector<TraceSignal> signals(portion.columns.size());
    for (std::size_t i = 0; i < portion.column_of.size(); ++i)
      if (portion.column_of[i] != kNoColumn) signals[portion.column_of[i]] = signals_[i];
    made.set_signals(signals);
    values.resize(portion.columns.size());
    for (; row < std::min(behind, portion.end()); ++row) {
      const std::size_t index = row - portion.begin;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = portion.columns[i].values[index];
      while (gap != gaps_.end() && gap->row < row) ++gap;
      const bool behind_gap = row > first && gap != gaps_.end() && gap->row == row;
      made.append(portion.t[index], portion.tick[index], values, behind_gap ? gap->missing : 0);
    }
  }
  return made;
}

}  // namespace lockstep
