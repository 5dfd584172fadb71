#include "projects/studio/trace_answers.hpp"

#include "hmi_bridge/studio/frames.hpp"
#include "projects/studio/api_values.hpp"
#include "projects/studio/trace_analysis.hpp"
#include "projects/studio/trace_exports.hpp"
#include "projects/studio/trace_part.hpp"

namespace lockstep::studio_api {
namespace {

/// The signals that are named: by `signals=A,B`, or one by one by `signal=A`, as paths with a comma need it.
std::vector<std::string> paths_of(const StudioRequest& request) {
  std::vector<std::string> paths = split(request.value("signals"));
  for (const auto& [key, value] : request.query)
    if (key == "signal") paths.push_back(value);
  return paths;
}

std::vector<std::size_t> columns_of(const StudioRequest& request, const TraceStore& store, Wrong& wrong) {
  std::vector<std::size_t> columns;
  for (const std::string& path : paths_of(request))
    if (const auto column = store.find(path))
      columns.push_back(*column);
    else
      wrong.add("not_found", "'" + path + "' is not in this trace", {{"path", path}});
  if (wrong.errors.empty() && (columns.empty() || columns.size() > kWindowSignals))
    throw BadRequest(422, "bad_request", "'signals' has to name 1 to 512 of the trace, by commas");
  return columns;
}

StudioAnswer window(const StudioRequest& request, const TraceStore& store, const TracePart& part) {
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

StudioAnswer statistics(const TraceStore& store, const TracePart& part) {
  return answer_of(array_of(part.columns, [&](std::size_t column) {
    return statistics_json(store.signals()[column].name, store.statistics(column, part.first, part.behind));
  }));
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

StudioAnswer trace_answer(const StudioRequest& request, std::string_view what, const TraceStore& store,
                          const StudioHistory& history) {
  TracePart part = trace_part(request, store);
  if (what == "spectrum") return spectrum_answer(request, store, part);
  Wrong wrong{422};
  part.columns = columns_of(request, store, wrong);
  if (!wrong.errors.empty()) return answer_of(wrong);
  if (what == "window") return window(request, store, part);
  if (what == "statistics") return statistics(store, part);
  if (what == "export") return export_answer(request, store, part, history);
  return error_answer(404, "not_found",
                      "a trace has no '" + std::string(what) +
                          "'; allowed: window, statistics, spectrum, xy, export, events");
}

}  // namespace lockstep::studio_api
