#include "projects/studio/trace_answers.hpp"

#include <array>
#include <limits>

#include "hmi_bridge/studio/frames.hpp"
#include "hmi_bridge/traces/csv_number.hpp"
#include "projects/studio/api_values.hpp"

namespace lockstep::studio_api {
namespace {

/// What of a trace is asked for.
struct Part {
  std::vector<std::size_t> columns;
  std::uint64_t first, behind;  // rows
};

std::vector<std::size_t> columns_of(const StudioRequest& request, const TraceStore& store, Wrong& wrong) {
  std::vector<std::size_t> columns;
  for (const std::string& path : split(request.value("signals")))
    if (const auto column = store.find(path))
      columns.push_back(*column);
    else
      wrong.add("not_found", "'" + path + "' is not in this trace", {{"path", path}});
  if (wrong.errors.empty() && (columns.empty() || columns.size() > kWindowSignals))
    throw BadRequest(422, "bad_request", "'signals' has to name 1 to 512 of the trace, by commas");
  return columns;
}

StudioAnswer window(const StudioRequest& request, const TraceStore& store, const Part& part) {
  const std::int64_t points = whole_number(request, "pixels", 1000);
  if (points < 1 || points > static_cast<std::int64_t>(kWindowPoints))
    throw BadRequest(422, "out_of_range", "pixels: " + std::to_string(points) + "; allowed: 1 to 20000");
  StudioAnswer answer;
  answer.type = "application/octet-stream";
  const TraceWindow seen =
      store.window(part.columns, part.first, part.behind, static_cast<std::size_t>(points));
  const std::vector<std::uint8_t> bytes = encode_frame({StudioFrameKind::window, 0, 0, 0}, seen);
  answer.body.assign(bytes.begin(), bytes.end());
  return answer;
}

Json statistics_json(const std::string& signal, const TraceStatistics& seen) {
  Json json = {{"signal", signal}, {"n", seen.rows}, {"nans", seen.nans}};
  if (seen.rows == 0) return json;
  const auto add = [&](const char* key, double number) { json[key] = number_json(number); };
  add("minimum", seen.minimum);
  json["t_minimum"] = std::to_string(seen.t_minimum);
  add("maximum", seen.maximum);
  json["t_maximum"] = std::to_string(seen.t_maximum);
  add("mean", seen.mean);
  add("deviation", seen.deviation);
  add("rms", seen.rms);
  add("peak_to_peak", seen.maximum - seen.minimum);
  add("integral", seen.integral);
  add("first", seen.first);
  add("last", seen.last);
  return json;
}

StudioAnswer statistics(const TraceStore& store, const Part& part) {
  return answer_of(array_of(part.columns, [&](std::size_t column) {
    return statistics_json(store.signals()[column].name, store.statistics(column, part.first, part.behind));
  }));
}

/// A part of a trace as `CsvTrace` writes it, to the bit; where a row has none of a signal, "nan".
StudioAnswer comma_separated(const TraceStore& store, const Part& part) {
  const std::uint64_t values = (part.behind - part.first) * (part.columns.size() + 1);
  if (values > kExportValues)
    return error_answer(413, "too_large",
                        std::to_string(values) + " values; allowed: " + std::to_string(kExportValues));
  const TraceWindow seen = store.rows(part.columns, part.first, part.behind);
  StudioAnswer answer;
  answer.type = "text/csv; charset=utf-8";
  answer.file_name = "lockstep.csv";
  answer.body = "t";
  for (const std::size_t column : part.columns) answer.body += ',' + store.signals()[column].name;
  answer.body += '\n';
  std::array<char, kNumberLength> number{};
  for (std::size_t row = 0; row < seen.t.size(); ++row) {
    answer.body.append(number.data(), print_seconds(number.data(), seen.t[row]));
    for (const TraceWindow::Column& column : seen.columns) {
      answer.body += ',';
      answer.body.append(number.data(), print_column_value(number.data(), column.first[row], column.type));
    }
    answer.body += '\n';
  }
  return answer;
}

StudioAnswer exported(const StudioRequest& request, const TraceStore& store, const Part& part) {
  const std::string_view format = request.value("format", "csv");
  if (format != "csv")
    throw BadRequest(422, "bad_request", "format: '" + std::string(format) + "'; allowed: csv");
  return comma_separated(store, part);
}

}  // namespace

Json trace_json(std::string_view id, const TraceStore& store) {
  Json json = {
      {"id", id},
      {"rows", store.end() - store.begin()},
      {"bytes", store.bytes()},
      {"signals",
       array_of(store.signals(),
                [](const TraceSignal& signal) {
                  return Json{{"path", signal.name}, {"type", type_name(signal.type)}, {"unit", signal.unit}};
                })},
      {"gaps", array_of(store.gaps(), [](const TraceStore::Gap& gap) {
         return Json{{"t", std::to_string(gap.t)}, {"rows", gap.missing}};
       })}};
  if (store.end() > store.begin()) {
    json["from"] = std::to_string(store.t(store.begin()));
    json["to"] = std::to_string(store.t(store.end() - 1));
  }
  return json;
}

StudioAnswer trace_answer(const StudioRequest& request, std::string_view what, const TraceStore& store) {
  if (store.end() == store.begin())
    return error_answer(416, "out_of_range", "there are no rows yet: nobody has asked for a signal");
  const std::int64_t from = whole_number(request, "from", store.t(store.begin()));
  const std::int64_t to = whole_number(request, "to", store.t(store.end() - 1));
  if (from > to) throw BadRequest(416, "out_of_range", "'from' has to be before 'to'");
  Wrong wrong{422};
  Part part{columns_of(request, store, wrong), store.row_at(from), store.end()};
  if (!wrong.errors.empty()) return answer_of(wrong);
  if (to < std::numeric_limits<std::int64_t>::max()) part.behind = store.row_at(to + 1);
  if (what == "window") return window(request, store, part);
  if (what == "statistics") return statistics(store, part);
  if (what == "export") return exported(request, store, part);
  return error_answer(404, "not_found",
                      "a trace has no '" + std::string(what) + "'; allowed: window, statistics, export");
}

}  // namespace lockstep::studio_api
