// lockstep plot: a picture as a script of gnuplot.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/describe/table.hpp"
#include "cli/plot/picture.hpp"

namespace lockstep::cli {
namespace {

// Colours that the colour-blind can tell apart, dark enough on white.
constexpr std::string_view kColors[] = {"#0072B2", "#D55E00", "#009E73", "#B0528A",
                                        "#B8860B", "#3FA0D8", "#4D4D4D", "#8C564B"};
// Their dark shades, for further curves of the same object.
constexpr std::string_view kShades[] = {"#002B45", "#5A2700", "#003D2C", "#451C36",
                                        "#4A3604", "#123F57", "#000000", "#3A211C"};
static_assert(std::size(kColors) == std::size(kShades));
constexpr int kDashes[] = {1, 2, 4, 3, 5};  // of gnuplot: solid, dashed, dash-dotted, dotted ...

// Sizes in pixels.
constexpr double kWidth = 1400;
constexpr double kTop = 46;
constexpr double kBottom = 58;
constexpr double kLeft = 104;
constexpr double kLabel = 16;  // of the axis, from the left
constexpr double kDiagram = 210;
constexpr double kGap = 16;
constexpr double kLegendGap = 10;
constexpr double kThin = 1.6;   // of the topmost line
constexpr double kThick = 3.4;  // of the lowest one, so that one that is covered is seen
constexpr double kLane = 25;
constexpr double kCharacter = 7.2;  // width of one in the legend
constexpr double kStateCharacter = 8.0;

/// A text as a string of gnuplot. Nothing in it can end the string: names come from files.
std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (const char c : printable(text)) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

/// Writes the script from top to bottom of the picture.
class Script {
 public:
  Script(const Picture& picture, PictureFormat format) : picture_(picture) {
    const auto panels = static_cast<double>(picture.diagrams.size() + (picture.lanes.empty() ? 0 : 1));
    lanes_height_ = static_cast<double>(picture.lanes.size()) * kLane;
    height_ = kTop + kBottom + static_cast<double>(picture.diagrams.size()) * kDiagram + lanes_height_ +
              (panels - 1) * kGap;
    right_ = legend_width();
    begin(format);
  }

  std::string write() {
    double top = kTop;
    for (const Diagram& diagram : picture_.diagrams) {
      const bool lowest = picture_.lanes.empty() && &diagram == &picture_.diagrams.back();
      panel(top, kDiagram, lowest);
      write_diagram(diagram);
      top += kDiagram + kGap;
    }
    if (!picture_.lanes.empty()) {
      panel(top, lanes_height_, true);
      write_lanes();
    }
    return text_ + "unset multiplot\n";
  }

 private:
  double legend_width() const {
    std::size_t longest = 8;
    for (const Diagram& diagram : picture_.diagrams)
      for (const Curve& curve : diagram.curves) longest = std::max(longest, shown_width(curve.name));
    for (const Lane& lane : picture_.lanes) longest = std::max(longest, shown_width(lane.name));
    return std::min(70.0 + kCharacter * static_cast<double>(longest), kWidth / 2);
  }

  template <class... T>
  void add(fmt::format_string<T...> format, T&&... values) {
    text_ += fmt::format(format, std::forward<T>(values)...) + "\n";
  }

  void begin(PictureFormat format) {
    if (format == PictureFormat::png)
      add("set terminal pngcairo noenhanced size {},{} font 'DejaVu Sans,10' background '#FFFFFF'", kWidth,
          height_);
    else
      add("set terminal svg noenhanced size {},{} dynamic font 'DejaVu Sans,12' background '#FFFFFF'", kWidth,
          height_);
    add("set multiplot");
    add("set label 1 {} at screen {},{} left font ',14'", in_quotes(picture_.title), kLeft / kWidth,
        1.0 - 0.5 * kTop / height_);
    add("set xrange [{}:{}]\nset lmargin at screen {}\nset rmargin at screen {}", picture_.begin,
        picture_.end, kLeft / kWidth, (kWidth - right_) / kWidth);
    add("set border lw 1 lc rgb '#808080'\nset tics textcolor rgb '#202020' nomirror scale 0.6");
    add("set grid xtics ytics lt 1 lw 0.6 lc rgb '#DDDDDD'");
    add("set style fill solid 1.0 noborder");
  }

  void panel(double top, double height, bool lowest) {
    add("set tmargin at screen {}\nset bmargin at screen {}", 1.0 - top / height_,
        1.0 - (top + height) / height_);
    add("set key at screen {},{} left top vertical Left reverse samplen 2.4 spacing 1.15",
        (kWidth - right_ + kLegendGap) / kWidth, 1.0 - (top + 2) / height_);
    if (lowest)
      add("set format x '%g'\nset xlabel {}", in_quotes(picture_.axis_label));
    else
      add("set format x ''\nunset xlabel");
  }

  void write_diagram(const Diagram& diagram) {
    add("set label 2 {} at screen {},graph 0.5 center rotate by 90", in_quotes(diagram.label),
        kLabel / kWidth);
    add("set yrange [{}:{}]\nset format y '%g'", diagram.lowest, diagram.highest);
    std::string plots;
    for (const Curve& curve : diagram.curves) {
      const std::string data = fmt::format("$d{}", blocks_++);
      text_ += data + " << EOD\n";
      for (const auto& piece : curve.pieces) {
        for (const Point& point : piece) add("{} {}", point.first, point.second);
        text_ += "\n";
      }
      text_ += "EOD\n";
      const auto color = static_cast<std::size_t>(curve.color) % std::size(kColors);
      const auto above = static_cast<double>(&diagram.curves.back() - &curve);
      const auto others = std::max<double>(static_cast<double>(diagram.curves.size()) - 1.0, 2.0);
      plots += (plots.empty() ? "plot " : ", ") + (curve.pieces.empty() ? std::string("NaN") : data) +
               fmt::format(" with {} lw {} dt {} lc rgb '{}' title {}", curve.steps ? "steps" : "lines",
                           kThin + (kThick - kThin) * above / others,
                           kDashes[static_cast<std::size_t>(curve.dash) % std::size(kDashes)],
                           curve.dash == 0 ? kColors[color] : kShades[color], in_quotes(curve.name));
    }
    add("{}", plots);
    add("unset label");
  }

  /// The rectangle of an interval, as boxxyerror wants it.
  void write_box(const Interval& interval, double low, double high) {
    add("{} {} {} {} {} {}", interval.begin, low, interval.begin, interval.end, low, high);
  }

  void write_lanes() {
    const auto count = static_cast<double>(picture_.lanes.size());
    add("set yrange [0:{}]\nunset ytics\nunset key", count);
    std::string flags = "$flags << EOD\n", states = "$states << EOD\n";
    double low = count;
    std::string tics;
    for (const Lane& lane : picture_.lanes) {
      low -= 1.0;
      tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", in_quotes(lane.name), low + 0.5);
      add("set arrow from graph 0,first {} to graph 1,first {} nohead lw 0.6 lc rgb '#DDDDDD' back", low,
          low);
      std::swap(text_, lane.flag ? flags : states);
      for (const Interval& interval : lane.intervals) write_box(interval, low + 0.18, low + 0.82);
      std::swap(text_, lane.flag ? flags : states);
      if (!lane.flag) write_values(lane, low + 0.5);
    }
    add("set y2range [0:{}]\nset y2tics ({}) scale 0\nset grid noytics", count, tics);
    // A row that is outside keeps gnuplot from complaining of a list without rows.
    const std::string outside = fmt::format("{0} -2 {0} {0} -2 -1\nEOD\n", picture_.begin);
    text_ += flags + outside + states + outside;
    add("plot $flags with boxxyerror fc rgb '#4F7CAC' notitle, "
        "$states with boxxyerror fc rgb '#E4EBF2' fs solid 1.0 border lc rgb '#8899AA' notitle");
  }

  /// The values of a state, where there is space for them.
  void write_values(const Lane& lane, double middle) {
    const double pixel = (picture_.end - picture_.begin) / (kWidth - kLeft - right_);
    for (const Interval& interval : lane.intervals) {
      const std::string value = fmt::format("{}", interval.value);
      if ((interval.end - interval.begin) / pixel < kStateCharacter * static_cast<double>(value.size() + 1))
        continue;
      add("set label {} at first {},{} center front font ',9'", in_quotes(value),
          0.5 * (interval.begin + interval.end), middle);
    }
  }

  const Picture& picture_;
  double height_ = 0.0;
  double lanes_height_ = 0.0;
  double right_ = 0.0;
  int blocks_ = 0;
  std::string text_;
};

}  // namespace

std::string plot_script(const Picture& picture, PictureFormat format) {
  return Script(picture, format).write();
}

}  // namespace lockstep::cli
