// lockstep plot: which signal goes where.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "cli/plot/picture.hpp"
#include "fb/block.hpp"
#include "tech_objects/data_blocks/choices.hpp"
#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep::cli {
namespace {

constexpr int kBins = 1500;                    // of the time, about a pixel each
constexpr std::size_t kMaximumIntervals = 60;  // of a state, beyond which it is drawn as a curve

/// What a signal is, as far as that is known.
struct Kind {
  Type type = Type::LREAL;
  std::string unit;
};

std::string_view object_of(std::string_view name) {
  return name.substr(0, name.find('.'));
}

/// The last part of a path, without index.
std::string_view quantity_of(std::string_view name) {
  const auto point = name.rfind('.');
  if (point != name.npos) name.remove_prefix(point + 1);
  return name.substr(0, name.find('['));
}

/// Type and unit of a pin's name, if all blocks agree on its type.
std::optional<Kind> kind_of_pin(std::string_view name) {
  std::optional<Kind> kind;
  for (const BlockType& type : block_types()) {
    const Pin* const pin = type.find_pin(name);
    if (pin == nullptr) continue;
    if (kind && kind->type != pin->type) return std::nullopt;
    kind = Kind{pin->type, std::string(unit_text(pin->unit))};
  }
  return kind;
}

std::optional<Kind> kind_of_name(std::string_view name) {
  const auto point = name.find('.');
  if (point == name.npos) return std::nullopt;
  const std::string_view path = name.substr(point + 1);
  for (const ObjectKindText& known : kObjectKinds)
    if (const VariableAddress place = find_variable(known.kind, path); place.variable != nullptr)
      return place.bit >= 0 ? Kind{Type::BOOL, ""}
                            : Kind{place.variable->type, std::string(unit_text(place.variable->unit))};
  return kind_of_pin(path);
}

/// Whether it is a unit of positions: that of any object, or one that a project may choose.
bool is_length(std::string_view unit) {
  return unit == "u" || std::any_of(std::begin(kUnitsLengthUnit), std::end(kUnitsLengthUnit),
                                    [unit](const Choice& choice) { return choice.text == unit; });
}

/// What the values of an unknown signal look like.
Kind kind_of_values(const std::vector<double>& values, const PlotRange& range) {
  bool flag = true, whole = true;
  for (std::size_t i = range.first; i < range.last; ++i) {
    flag = flag && (values[i] == 0.0 || values[i] == 1.0);
    whole = whole && values[i] == std::floor(values[i]);
  }
  return {flag ? Type::BOOL : whole ? Type::DINT : Type::LREAL, ""};
}

/// Until when the values of a row stand: to the next row, after the last one for as long as before it.
double end_of(const TraceTable& trace, std::size_t row) {
  if (row + 1 < trace.t.size()) return trace.t[row + 1];
  return row == 0 ? trace.t[row] : trace.t[row] + (trace.t[row] - trace.t[row - 1]);
}

std::vector<Interval> intervals_of(const TraceTable& trace, const std::vector<double>& values,
                                   const PlotRange& range) {
  std::vector<Interval> intervals;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const double end = end_of(trace, i);
    if (!intervals.empty() && intervals.back().value == values[i])
      intervals.back().end = end;
    else
      intervals.push_back({trace.t[i], end, values[i]});
  }
  return intervals;
}

/// The times in which a flag is TRUE; gaps that nobody could see are closed.
std::vector<Interval> true_times(const std::vector<Interval>& intervals, double gap) {
  std::vector<Interval> result;
  for (const Interval& interval : intervals) {
    if (interval.value == 0.0) continue;
    if (!result.empty() && interval.begin - result.back().end < gap)
      result.back().end = interval.end;
    else
      result.push_back(interval);
  }
  return result;
}

/// Builds the picture signal by signal.
class Arrangement {
 public:
  Arrangement(const TraceTable& trace, const PlotRange& range) : trace_(trace), range_(range) {
    picture_.begin = trace.t[range.first];
    picture_.end = end_of(trace, range.last - 1);
    if (!(picture_.end > picture_.begin)) picture_.end = picture_.begin + 1e-3;
  }

  void add(std::size_t signal, bool typed) {
    const TraceSignal& known = trace_.signals[signal];
    const auto& values = trace_.columns[signal];
    const bool real = signal < trace_.reals.size() && trace_.reals[signal];
    Kind kind{known.type, known.unit};
    if (!typed)
      kind = kind_of_name(known.name).value_or(real ? Kind{Type::LREAL, ""} : kind_of_values(values, range_));
    if (is_real(kind.type) || kind.type == Type::TIME) {
      if (kind.type == Type::TIME) kind.unit = "s";
      return add_curve(known.name, kind.unit, values, false);
    }
    std::vector<Interval> intervals = intervals_of(trace_, values, range_);
    if (kind.type == Type::BOOL)
      picture_.lanes.push_back(
          {known.name, true, true_times(intervals, (picture_.end - picture_.begin) / (2 * kBins))});
    else if (intervals.size() <= kMaximumIntervals)
      picture_.lanes.push_back({known.name, false, std::move(intervals)});
    else
      add_curve(known.name, kind.unit, values, true);
  }

  Picture finish() {
    for (auto& [rank, diagram] : diagrams_) {
      set_range(diagram);
      picture_.diagrams.push_back(std::move(diagram));
    }
    return std::move(picture_);
  }

 private:
  /// The diagram of a quantity: positions, velocities, accelerations and jerks first.
  Diagram& diagram_of(const std::string& name, const std::string& unit) {
    std::string quantity(quantity_of(name));
    int rank = 4;
    constexpr std::pair<std::string_view, std::string_view> kKnown[] = {
        {"", "position"}, {"/s", "velocity"}, {"/s²", "acceleration"}, {"/s³", "jerk"}};
    const std::string_view length = std::string_view(unit).substr(0, unit.find("/s"));
    const std::string_view rate = std::string_view(unit).substr(length.size());
    for (int i = 0; i < static_cast<int>(std::size(kKnown)) && is_length(length); ++i) {
      const bool position = i == 0;
      if (rate != kKnown[i].first || (position && !quantity.ends_with("Position"))) continue;
      quantity = kKnown[i].second;
      rank = i;
    }
    const std::string label = unit.empty() ? quantity : quantity + " [" + unit + "]";
    const auto [place, added] = places_.try_emplace(label, rank, static_cast<int>(places_.size()));
    Diagram& diagram = diagrams_[place->second];
    diagram.label = label;
    return diagram;
  }

  void add_curve(const std::string& name, const std::string& unit, const std::vector<double>& values,
                 bool steps) {
    Curve curve;
    curve.name = name;
    curve.steps = steps;
    const bool wraps = quantity_of(name).ends_with("Position");
    auto pieces = pieces_of(trace_.t, values, range_.first, range_.last, wraps);
    // With several wraps in a pixel nobody sees one.
    if (pieces.size() > kBins) pieces = pieces_of(trace_.t, values, range_.first, range_.last, false);
    for (const auto& piece : pieces)
      curve.pieces.push_back(thinned(piece, picture_.begin, picture_.end, kBins));
    const std::string_view object = object_of(name);
    curve.color = colors_.try_emplace(std::string(object), static_cast<int>(colors_.size())).first->second;
    Diagram& diagram = diagram_of(name, unit);
    curve.dash = static_cast<int>(
        std::count_if(diagram.curves.begin(), diagram.curves.end(),
                      [object](const Curve& other) { return object_of(other.name) == object; }));
    diagram.curves.push_back(std::move(curve));
  }

  const TraceTable& trace_;
  const PlotRange& range_;
  Picture picture_;
  std::map<std::string, std::pair<int, int>> places_;  // of labels: rank, then order
  std::map<std::pair<int, int>, Diagram> diagrams_;
  std::map<std::string, int> colors_;  // of objects
};

}  // namespace

void set_range(Diagram& diagram) {
  double minimum = INFINITY, maximum = -INFINITY;
  for (const Curve& curve : diagram.curves)
    for (const auto& piece : curve.pieces)
      for (const Point& point : piece) {
        minimum = std::min(minimum, point.second);
        maximum = std::max(maximum, point.second);
      }
  if (minimum > maximum) minimum = maximum = 0.0;
  const double span = maximum - minimum;
  const double margin = span > 0.0 ? 0.06 * span : std::max(0.1 * std::abs(maximum), 1e-9);
  diagram.lowest = std::max(minimum - margin, -1e300);
  diagram.highest = std::min(maximum + margin, 1e300);
}

Picture arrange(const TraceTable& trace, const PlotRange& range, const std::vector<bool>& typed) {
  Arrangement arrangement(trace, range);
  for (const std::size_t signal : range.signals) arrangement.add(signal, typed[signal]);
  return arrangement.finish();
}

}  // namespace lockstep::cli
