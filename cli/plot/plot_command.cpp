// lockstep plot: draws a trace.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>

#include "cli/command/command.hpp"
#include "cli/command/whole_file.hpp"
#include "cli/plot/picture.hpp"
#include "hmi_bridge/lcm/trace_reader.hpp"
#include "hmi_bridge/traces/csv_reader.hpp"
#include "projects/literals/duration.hpp"

namespace lockstep::cli {
namespace {

struct PlotOptions {
  std::string trace;
  std::string picture;
  std::vector<std::string> signals;
  std::string from, to;
  std::string channel;
  std::string title;
  std::string project;
};

/// What the user asked for cannot be drawn; the text says why.
struct CannotPlot : std::runtime_error {
  using std::runtime_error::runtime_error;
};

PictureFormat format_of(const std::string& path) {
  if (path.ends_with(".svg")) return PictureFormat::svg;
  if (path.ends_with(".png")) return PictureFormat::png;
  throw CannotPlot("-o: '" + path + "' has to end in .svg or .png");
}

TraceTable read_trace(const PlotOptions& options) {
  if (options.trace.ends_with(".csv")) return read_csv_trace(options.trace);
  if (options.trace.ends_with(".lcm")) return read_lcm_trace(options.trace, options.channel);
  throw CannotPlot("'" + options.trace + "' is no trace; it has to end in .csv or .lcm");
}

/// Which signals have a known type and unit: all of an LCM trace, which tells them, else those of the
/// project.
std::vector<bool> know_signals(const PlotOptions& options, TraceTable& trace) {
  std::vector<bool> known(trace.signals.size(), options.trace.ends_with(".lcm"));
  if (options.project.empty()) return known;
  int status = kOk;
  const std::optional<Project> project = load_or_tell(options.project, status, {}, Warnings::kept);
  if (!project) throw CannotPlot("--project: the units and types of the signals cannot be taken from there");
  for (std::size_t i = 0; i < trace.signals.size(); ++i) {
    TraceSignal& signal = trace.signals[i];
    const FoundOperand found = project->names.find(signal.name);
    if (!found.place) continue;
    const Operand& place = *found.place;
    signal.type = place.signal.value_type();
    signal.unit = unit_of(NamedSignal{signal.name, place.signal, place.unit, place.object, place.instance});
    known[i] = true;
  }
  return known;
}

/// Signals of the picture that the project does not know: it may be another one than that of the trace.
void tell_unknown(const PlotOptions& options, const TraceTable& trace, const PlotRange& range,
                  const std::vector<bool>& known) {
  std::vector<std::string_view> unknown;
  for (const std::size_t signal : range.signals)
    if (!known[signal]) unknown.push_back(trace.signals[signal].name);
  if (!unknown.empty())
    tell("warning: --project: " + quote(options.project) + " knows " +
             (unknown.size() == range.signals.size() ? "none of these signals: " : "nothing of: ") +
             list_of(unknown) + "; their units and types are guessed",
         Severity::warning);
}

/// A time of the trace [s]: a number of seconds or a duration; `open` for an empty text.
double time_of(const char* option, const std::string& text, double open) {
  if (text.empty()) return open;
  double seconds = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error == std::errc{} && end == text.data() + text.size() && seconds == seconds) return seconds;
  std::string problem;
  if (const auto duration = parse_duration(text, problem)) return static_cast<double>(*duration) * 1e-9;
  throw CannotPlot(std::string(option) + ": " + quote(text) +
                   " is no time; allowed: seconds, as 1.5, or a "
                   "duration, as 200ms");
}

std::vector<std::size_t> chosen_signals(const TraceTable& trace, const std::vector<std::string>& names) {
  std::vector<std::size_t> chosen;
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < trace.signals.size(); ++i) {
    known.push_back(trace.signals[i].name);
    if (names.empty()) chosen.push_back(i);
  }
  for (const std::string& name : names) {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](std::string_view other) { return same_name(name, other); });
    if (found == known.end())
      throw CannotPlot("--signals: the trace has no signal " + quote(name) + did_you_mean(name, known) +
                       "; it has: " + list_of(known));
    chosen.push_back(static_cast<std::size_t>(found - known.begin()));
  }
  if (chosen.empty()) throw CannotPlot("the trace has no signals");
  return chosen;
}

PlotRange chosen_range(const TraceTable& trace, const PlotOptions& options) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const double from = time_of("--from", options.from, -kInfinite);
  const double to = time_of("--to", options.to, kInfinite);
  if (trace.t.empty()) throw CannotPlot("the trace has no rows");
  if (!std::all_of(trace.t.begin(), trace.t.end(), [](double t) { return std::isfinite(t); }))
    throw CannotPlot("a time of the trace is no number");
  if (!std::is_sorted(trace.t.begin(), trace.t.end())) throw CannotPlot("the times of the trace go back");
  const auto first = std::lower_bound(trace.t.begin(), trace.t.end(), from);
  const auto last = std::upper_bound(trace.t.begin(), trace.t.end(), to);
  if (first >= last)
    throw CannotPlot(fmt::format("the trace has no rows in that time; it goes from {} s to {} s",
                                 trace.t.front(), trace.t.back()));
  return {static_cast<std::size_t>(first - trace.t.begin()), static_cast<std::size_t>(last - trace.t.begin()),
          chosen_signals(trace, options.signals)};
}

int plot(const PlotOptions& options) {
  try {
    const PictureFormat format = format_of(options.picture);
    TraceTable trace = read_trace(options);
    if (!trace.remark.empty()) tell("warning: " + trace.remark);
    const std::vector<bool> known = know_signals(options, trace);
    const PlotRange range = chosen_range(trace, options);
    if (!options.project.empty()) tell_unknown(options, trace, range, known);
    Picture picture = arrange(trace, range, known);
    picture.title =
        options.title.empty() ? std::filesystem::path(options.trace).filename().string() : options.title;
    write_whole_file(options.picture, run_gnuplot(plot_script(picture, format)));
    if (options.project.empty() && std::ranges::find(known, true) == known.end())
      tell(
          "a CSV trace does not say its units, so the picture has [u]; --project PROJECT.json takes them, "
          "and "
          "the types of its signals, from the project");
    return kOk;
  } catch (const std::runtime_error& error) {
    tell(error.what(), Severity::error);
    return kCouldNotStart;
  }
}

}  // namespace

void add_plot_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("plot", "Draw a trace as SVG or PNG");
  auto options = std::make_shared<PlotOptions>();
  command->add_option("TRACE", options->trace, "the trace: FILE.csv or FILE.lcm")->required();
  command->add_option("-o,--output", options->picture, "the picture: FILE.svg or FILE.png")->required();
  command->add_option("--signals", options->signals, "draw these signals, comma separated; without it: all")
      ->delimiter(',');
  command->add_option("--from", options->from, "leave out what is before this time, such as 1.5 or 200ms");
  command->add_option("--to", options->to, "leave out what is after this time");
  command->add_option("--channel", options->channel,
                      "trace in an LCM log; without it: the first that has rows");
  command->add_option("--project", options->project,
                      "project of a CSV trace, for the units and types of its signals");
  command->add_option("--title", options->title, "title; without it: the name of the file");
  command->footer(
      "One diagram for each quantity, BOOL and integer states as lanes below, one time axis. The line of a\n"
      "modulo position is broken where it wraps. gnuplot draws (Debian: gnuplot-nox).\n"
      "Exit status: 0 drawn, 2 not drawn");
  command->callback([&action, options] { action = [options] { return plot(*options); }; });
}

}  // namespace lockstep::cli
