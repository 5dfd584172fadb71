/// What a plot shows: diagrams of curves above one time axis, and lanes of states below.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_bridge/traces/table.hpp"

namespace lockstep::cli {

/// A point: time [s] and value.
using Point = std::pair<double, double>;

/// A signal drawn as a line. It is broken between its pieces: where a modulo position wraps and where there
/// is no finite value.
struct Curve {
  std::string name;
  std::vector<std::vector<Point>> pieces;
  int color = 0;  ///< the same for all signals of one object
  int dash = 0;   ///< tells curves of the same object in one diagram apart
  bool steps = false;
};

/// Curves of one quantity.
struct Diagram {
  std::string label;  ///< quantity and unit
  std::vector<Curve> curves;
  double lowest = 0.0, highest = 1.0;  ///< of the axis
};

/// A time in which a state holds a value.
struct Interval {
  double begin, end;  ///< [s]
  double value;
};

/// A BOOL, drawn while it is TRUE, or an integer state, drawn with its value.
struct Lane {
  std::string name;
  bool flag = true;
  std::vector<Interval> intervals;
};

struct Picture {
  std::string title;
  std::string axis_label = "t [s]";
  double begin = 0.0, end = 1.0;  ///< of that axis
  std::vector<Diagram> diagrams;
  std::vector<Lane> lanes;
};

/// Part of a trace that is drawn: the rows from `first` to before `last`, the signals by their column.
struct PlotRange {
  std::size_t first, last;
  std::vector<std::size_t> signals;
};

/// Arranges signals into diagrams and lanes. Types and units that a CSV file does not have are taken from the
/// names of variables and pins, or else from the values.
/// @param range not empty  @param typed for each signal whether its type and unit are known
Picture arrange(const TraceTable& trace, const PlotRange& range, const std::vector<bool>& typed);

/// Sets the axis of a diagram so that all its points are within.
void set_range(Diagram& diagram);

/// Fewer points that look the same: of the points of a `bin`-th part of the time, first, last, minimum and
/// maximum.
std::vector<Point> thinned(const std::vector<Point>& points, double begin, double end, int bins);

/// Splits the values of a column where they are not finite and, if `wraps`, where a modulo position wraps:
/// where it goes by more than half its span in one row against its direction before or after.
std::vector<std::vector<Point>> pieces_of(const std::vector<double>& t, const std::vector<double>& values,
                                          std::size_t first, std::size_t last, bool wraps);

/// Formats that a picture may have.
enum class PictureFormat { svg, png };

/// The script that makes gnuplot draw a picture and write it to its standard output.
std::string plot_script(const Picture& picture, PictureFormat format);

/// Runs gnuplot.
/// @return the bytes of the picture
/// @throws std::runtime_error if it is not installed or fails; the text says what to do
std::string run_gnuplot(const std::string& script);

}  // namespace lockstep::cli
