#include "cli/monitor/view.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <ctime>

#include "cli/describe/table.hpp"
#include "projects/json/problem.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"

namespace lockstep::cli {
namespace {

using Lines = std::vector<ViewLine>;
using Time = Model::Clock::time_point;

constexpr std::size_t kValue = 13;
constexpr std::size_t kUnit = 5;
constexpr std::size_t kLimit = 10;        // columns of a minimum or maximum value
constexpr std::size_t kPlotHeight = 6;    // of a curve
constexpr std::size_t kListHeight = 4;    // of a list below the table
constexpr std::size_t kMinimumTable = 4;  // lines that the table keeps when panes are open

constexpr const char* kHelp[] = {
    "arrows PgUp PgDn Home End  choose a signal",
    "/   search part of a name; Enter ends, Esc shows all again",
    "s   order: as the trace has it, by name, moving ones first",
    "g   larger plot of the chosen signal",
    "+ - window of all curves: 5 s to 60 s",
    "j a running and ended jobs; alarms",
    "l   leading values between controllers: sources and proxies",
    "p   pause: the picture stands, recording goes on",
    "r   record everything heard to a file of LCM; r again ends it",
    "?   this page        q or Ctrl-C  end",
    "",
    "With --panel, where the project allows commands:",
    "Tab next axis        e d  enable, disable",
    "left right           jog while the key is held (< > velocity)",
    "Space                stop jogging",
    "h x n                set the position (home); reset alarms; start a program",
    "[ ]                  override -10 %, +10 %"};

std::string number(double value) {
  return fmt::format("{:.5g}", value);
}

double seconds(std::int64_t t) {
  return static_cast<double>(t) * 1e-9;
}

/// What is not ASCII becomes what is.
std::string in_ascii(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80)
      result += c;
    else if ((byte & 0xC0) != 0x80)
      result += '?';
  }
  return result;
}

std::string title(const Model& model) {
  std::string text = "lockstep monitor";
  if (const std::size_t pending = model.shown().events.pending(); pending != 0)
    text += fmt::format("  {} ALARM{}", pending, pending == 1 ? "" : "S");
  if (model.paused()) text += "  PAUSED, p goes on";
  if (!model.record.empty())
    text += fmt::format("  REC {} ({} messages)", printable(model.record), model.recorded);
  return text + "  " + printable(model.url);
}

/// Widths of the columns of the table.
struct Columns {
  std::size_t name, curve;

  Columns(const Model& model, const std::vector<SignalRow>& rows, std::size_t width) {
    constexpr std::size_t kMinimumCurve = 10;
    constexpr std::size_t kGaps = 8;
    const std::size_t others = kValue + kUnit + 2 * kLimit + kGaps;
    name = 8;
    for (const SignalRow& row : rows) name = std::max(name, shown_width(printable(model.signal(row).name)));
    const std::size_t capacity = width > others + kMinimumCurve + 8 ? width - others - kMinimumCurve : 8;
    name = std::min(name, capacity);
    curve = width > others + name ? std::min<std::size_t>(width - others - name, 60) : 0;
  }
};

std::string table_line(const Model& model, const SignalRow& row, const Columns& columns, bool chosen,
                       Characters characters) {
  const TraceSignal& signal = model.signal(row);
  const auto value = model.value(row);
  std::string line = chosen ? "> " : "  ";
  line += padded(cut_to(printable(signal.name), columns.name), columns.name);
  line += fmt::format(" {:>{}} ", value ? signal_value_text(*value, signal.type) : "-", kValue);
  line += padded(cut_to(printable(signal.unit), kUnit), kUnit) + " ";
  const History* const history = model.history(row);
  if (history == nullptr) return line;
  line += sparkline(*history, model.window(), columns.curve, characters);
  const auto span = history->whole(model.window());
  if (span)
    line += fmt::format(" {:>{}} {:>{}}", number(span->minimum), kLimit, number(span->maximum), kLimit);
  return line;
}

/// The table with a heading for each trace; scrolled so that the chosen signal is in it.
Lines table(const Model& model, Time now, ViewSize size, Characters characters) {
  const std::vector<SignalRow> rows = model.rows();
  const std::size_t chosen = model.chosen(rows);
  const Columns columns(model, rows, size.width);
  Lines all;
  std::size_t chosen_line = 0;
  for (const auto& [channel, trace] : model.shown().traces.all()) {
    all.push_back({trace_heading(channel, trace, model.time(now)), Look::heading});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].channel != channel) continue;
      const bool is_chosen = i == chosen;
      if (is_chosen) chosen_line = all.size();
      all.push_back({table_line(model, rows[i], columns, is_chosen, characters),
                     is_chosen ? Look::chosen : Look::plain});
    }
  }
  if (all.empty()) all.push_back({"no trace heard yet; is a project running with lcm in its trace?"});
  if (rows.empty() && !model.search.empty())
    all.push_back({"  no signal has '" + model.search + "' in its name"});
  // The heading of the first trace stays in sight as long as it can.
  const std::size_t top = chosen_line < size.height ? 0 : chosen_line + 1 - size.height;
  Lines page(all.begin() + static_cast<std::ptrdiff_t>(top),
             all.begin() + static_cast<std::ptrdiff_t>(std::min(top + size.height, all.size())));
  page.resize(size.height);
  return page;
}

Lines plot(const Model& model, std::size_t width, Characters characters) {
  Lines lines;
  const std::vector<SignalRow> rows = model.rows();
  const History* const history = rows.empty() ? nullptr : model.history(rows[model.chosen(rows)]);
  const auto span = history != nullptr ? history->whole(model.window()) : std::nullopt;
  if (!span) {
    lines.push_back({"-- plot: nothing heard of a signal yet", Look::heading});
    lines.resize(kPlotHeight + 2);
    return lines;
  }
  const TraceSignal& signal = model.signal(rows[model.chosen(rows)]);
  std::string head = "-- " + printable(signal.name);
  if (!signal.unit.empty()) head += " [" + printable(signal.unit) + "]";
  lines.push_back(
      {head + fmt::format("  min {}  max {}", number(span->minimum), number(span->maximum)), Look::heading});
  constexpr std::size_t kAxis = 12;
  const std::size_t capacity = width > kAxis ? width - kAxis : 1;
  const auto drawn = curve(*history, model.window(), capacity, kPlotHeight, characters);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const std::string label = i == 0                  ? number(span->maximum)
                              : i + 1 == drawn.size() ? number(span->minimum)
                                                      : "";
    lines.push_back({fmt::format("{:>10} |", label) + drawn[i]});
  }
  const std::string from = fmt::format("-{} s", model.window() / 1'000'000'000);
  lines.push_back({std::string(kAxis, ' ') + padded(from, capacity > 3 ? capacity - 3 : 1) + "now"});
  return lines;
}

constexpr std::size_t kBesideTime = 14;  // columns before the text of an event

std::string time_text(const event_t& event) {
  return fmt::format("{:>10.3f} s  ", seconds(event.t));
}

/// For a log book: of a run in real time the clock on the wall, and the tick.
std::string moment_text(const event_t& event) {
  const std::string tick = fmt::format("tick {}", event.tick);
  constexpr std::int64_t kEnd = 253'402'300'800;  // [s] of the year 9999: a message may have any number
  const std::int64_t since_1970 = event.utime / 1'000'000;
  if (event.utime == event.t / 1000 || since_1970 <= 0 || since_1970 >= kEnd) return tick;
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC, ", fmt::gmtime(static_cast<std::time_t>(since_1970))) + tick;
}

Lines jobs(const Model& model, std::size_t height) {
  const HeardEvents& events = model.shown().events;
  Lines lines;
  lines.push_back({fmt::format("-- jobs heard of: {} running", events.running().size()), Look::heading});
  for (const auto& [key, event] : events.running())
    lines.push_back(
        {time_text(event) + printable(event.source) + "  " + printable(event.type) + "  running"});
  for (const ToldEvent& told : events.ended()) {
    std::string line = time_text(told.event) + printable(told.event.source) + "  " +
                       printable(told.event.type) + "  " + printable(told.event.kind.substr(4));
    if (told.event.number != 0)
      line +=
          fmt::format(" 16#{:04X} {}", static_cast<unsigned>(told.event.number), printable(told.event.text));
    for (const std::string& detail : told.details) line += ", " + printable(detail);
    lines.push_back({line, told.event.kind == "job failed" ? Look::alarm : Look::plain});
  }
  lines.resize(height);
  return lines;
}

Lines alarms(const Model& model, std::size_t height) {
  const HeardEvents& events = model.shown().events;
  Lines lines;
  lines.push_back({fmt::format("-- alarms heard of: {} not acknowledged, {} overruns", events.pending(),
                               events.overruns()),
                   Look::heading});
  for (const ToldEvent& told : events.alarms()) {
    const event_t& event = told.event;
    if (event.kind == "alarm")
      lines.push_back({time_text(event) + printable(event.source) +
                           fmt::format("  {}: {}", event.number, printable(event.text)) +
                           (event.reaction_text.empty() ? "" : " (" + printable(event.reaction_text) + ")") +
                           "  " + moment_text(event),
                       Look::alarm});
    else
      lines.push_back({time_text(event) + printable(event.source) + "  acknowledged"});
    for (const std::string& detail : told.details)
      lines.push_back({std::string(kBesideTime, ' ') + printable(detail)});
  }
  lines.resize(height);
  return lines;
}

Lines leading(const Model& model, Time now, std::size_t width, std::size_t height) {
  Lines lines{{"-- leading values between controllers", Look::heading}};
  std::vector<std::string> heard = leading_lines(model.shown().leading, model.time(now), width);
  if (heard.empty()) heard = {"", "  none heard of"};
  for (std::size_t i = 1; i < heard.size(); ++i) lines.push_back({heard[i]});
  lines.resize(height);
  return lines;
}

std::string axis_text(const PanelAxis& axis, Time now) {
  if (now - axis.heard > Panel::kSilent) return "SILENT";
  const auto has = [&](StatusBit bit) { return has_bit(static_cast<DWORD>(axis.state.status_word), bit); };
  std::string text = has(StatusBit::Enable) ? "enabled" : "not enabled";
  if (axis.state.enables == 0) text += " by a program";
  if (has(StatusBit::HomingDone)) text += ", homed";
  if (axis.state.alarm != 0) text += fmt::format(", ALARM {}", axis.state.alarm);
  return text;
}

/// Position, velocity, override and what a jog would be.
std::string motion_text(const PanelAxis& axis, int percent) {
  const panel_t& state = axis.state;
  const std::string unit = printable(state.velocity_unit);
  const std::string_view length = std::string_view(unit).substr(0, unit.rfind("/s"));
  return (state.has_position != 0 ? fmt::format("{:.4f} {}  ", state.position, length) : "") +
         fmt::format("{:.3f} {}  ovr {:.0f} %  jog {} % ({} {})", state.velocity, unit, state.speed, percent,
                     number(state.jog_velocity * percent / 100.0), unit);
}

/// How many lines state and answer of the panel have each: always as many, so that nothing jumps.
std::size_t panel_height(std::size_t width) {
  constexpr std::size_t kWide = 110;
  return width < kWide ? 2 : 1;
}

/// A text on a number of lines, the later ones indented; broken at a gap if there is one that fits.
void add_broken(Lines& lines, std::string text, const std::string& gap, std::size_t width, Look look) {
  const std::size_t height = panel_height(width);
  for (std::size_t line = 1; line < height; ++line) {
    std::size_t end = text.size();
    while (end != std::string::npos && shown_width(text.substr(0, end)) > width)
      end = end == 0 ? std::string::npos : text.rfind(gap, end - 1);
    if (end == std::string::npos || text.find_first_not_of(' ') >= end) end = text.size();
    lines.push_back({text.substr(0, end), look});
    text = end < text.size() ? "    " + text.substr(end + gap.size()) : "";
  }
  lines.push_back({text, look});
}

/// The panel is in sight as long as it can move something.
Lines panel(const Model& model, Time now, std::size_t width) {
  Lines lines;
  if (!model.panel) return lines;
  const PanelAxis* const axis = model.panel->chosen();
  std::string text = "PANEL ACTIVE  ";
  if (axis == nullptr)
    text += "no run is heard that takes commands";
  else
    text += printable(axis->state.axis) + ": " + axis_text(*axis, now) + "  " +
            motion_text(*axis, model.panel->percent());
  add_broken(lines, text, "  ", width, Look::panel);
  const auto& answers = model.shown().events.answers();
  std::string last = "no command yet";
  if (!answers.empty()) {
    const event_t& answer = answers.front().event;
    last = time_text(answer) + printable(answer.source) + ": " + printable(answer.type) +
           (answer.kind == "command accepted" ? " accepted" : " REFUSED: ") + printable(answer.text);
  }
  add_broken(lines, last, " ", width, Look::panel);
  return lines;
}

std::string keys(const Model& model) {
  if (!model.prompt.empty()) return model.prompt + ": " + model.answer + "_  (Enter does it, Esc does not)";
  if (model.searching) return "/" + model.search + "_  (Enter ends the search, Esc shows all)";
  if (!model.remark.empty()) return model.remark;
  if (model.panel) return "Tab axis  e d on/off  left right jog  Space stop  h home  x reset  [] ovr ? help";
  constexpr const char* orders[] = {"sort", "sort: by name", "sort: moving first"};
  std::string text = model.search.empty() ? "/ search" : "/" + model.search;
  text += fmt::format("  s {}  g plot  j jobs  a alarms  p pause  r record  ? help  q ends",
                      orders[static_cast<std::size_t>(model.order)]);
  return text;
}

Lines help(std::size_t height) {
  Lines lines;
  for (const char* const line : kHelp) lines.push_back({line});
  lines.resize(height);
  return lines;
}

/// How many lines panes have below the table, if the table keeps enough.
struct Panes {
  std::size_t plot = 0, jobs = 0, alarms = 0, leading = 0;
  std::size_t table = 0;

  Panes(const Model& model, ViewSize size) {
    const std::size_t around = 2 + (model.panel ? 2 * panel_height(size.width) : 0);  // title, keys and panel
    table = size.height > around ? size.height - around : 0;
    const auto open = [&](bool wanted, std::size_t lines) {
      if (!wanted || table < kMinimumTable + lines) return std::size_t{0};
      table -= lines;
      return lines;
    };
    alarms = open(model.alarms, kListHeight + 1);
    jobs = open(model.jobs, kListHeight + 1);
    leading = open(model.leading, kListHeight + 1);
    plot = open(model.plot, kPlotHeight + 2);
  }
};

}  // namespace

std::size_t page_of(const Model& model, ViewSize size) {
  const std::size_t table = Panes(model, size).table;
  return table > 1 ? table - 1 : 1;
}

std::vector<ViewLine> view(const Model& model, Time now, ViewSize size, Characters characters) {
  const Panes panes(model, size);
  Lines lines{{title(model), Look::title}};
  const auto add = [&](Lines more) { lines.insert(lines.end(), more.begin(), more.end()); };
  add(panel(model, now, size.width));
  if (model.help) {
    add(help(size.height > lines.size() ? size.height - lines.size() - 1 : 0));
  } else {
    add(table(model, now, {size.width, panes.table}, characters));
    if (panes.plot != 0) add(plot(model, size.width, characters));
    if (panes.leading != 0) add(leading(model, now, size.width, panes.leading));
    if (panes.jobs != 0) add(jobs(model, panes.jobs));
    if (panes.alarms != 0) add(alarms(model, panes.alarms));
  }
  lines.resize(std::max<std::size_t>(size.height, 1) - (size.height > 1 ? 1 : 0));
  if (size.height > 1) lines.push_back({keys(model), Look::keys});
  for (ViewLine& line : lines) {
    if (characters == Characters::ascii) line.text = in_ascii(line.text);
    line.text = cut_to(visible(line.text), size.width);
  }
  return lines;
}

}  // namespace lockstep::cli
