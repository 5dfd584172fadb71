#include "projects/studio/trace_exports.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <string_view>
#include <vector>

#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/studio/assets.hpp"
#include "hmi_bridge/studio/frames.hpp"
#include "hmi_bridge/traces/csv_number.hpp"
#include "projects/json/text_file.hpp"
#include "projects/studio/api_values.hpp"

namespace lockstep::studio_api {
namespace {

constexpr std::size_t kLongestLog = std::size_t{1} << 30;

/// A part of a trace as `CsvTrace` writes it, to the bit; where a row has none of a signal, "nan".
StudioAnswer comma_separated(const TraceStore& store, const TracePart& part) {
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

/// A file that is there as long as it is needed.
class TemporaryFile {
 public:
  TemporaryFile() {
    const int file = ::mkstemp(name_.data());
    if (file < 0) throw BadRequest(503, "busy", "no file can be made for the log");
    ::close(file);
  }
  ~TemporaryFile() { ::unlink(name_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& name() const noexcept { return name_; }

 private:
  std::string name_ = "/tmp/lockstep-studio-XXXXXX";
};

/// As `--trace FILE.lcm` writes it.
StudioAnswer event_log(const TraceStore& store, const TracePart& part) {
  const TraceWindow seen = store.rows(part.columns, part.first, part.behind);
  std::vector<TraceSignal> signals;
  for (const TraceWindow::Column& column : seen.columns) {
    signals.push_back(store.signals()[column.signal]);
    signals.back().type = column.type;
  }
  const TemporaryFile file;
  {
    const std::int64_t period = seen.t.size() > 1 ? seen.t[1] - seen.t[0] : 0;
    LcmLog log(file.name(), {.project = "studio", .channel = "STUDIO", .period = period, .epoch = 0});
    log.begin(signals);
    std::vector<Value> values(seen.columns.size());
    for (std::size_t row = 0; row < seen.t.size(); ++row) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = seen.columns[i].first[row];
      log.row({seen.t[row], seen.tick[row], 0, values});
    }
    log.end();
    if (log.lost() != 0) throw BadRequest(503, "busy", "the log cannot be written: " + log.reason());
  }
  StudioAnswer answer;
  answer.type = "application/octet-stream";
  answer.file_name = "lockstep.lcm";
  answer.body = read_text_file(file.name(), kLongestLog);
  return answer;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : std::uint32_t{0});
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63u];
  }
  return text;
}

/// What of the page stands under a path that its document names.
std::string_view asset_at(std::string_view path) {
  for (const StudioAsset& asset : studio_assets())
    if (asset.path.substr(1) == path) return asset.content;
  return {};
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

/// Replaces each element that names a file of the page by one that holds it.
void put_in(std::string& page, std::string_view begin, std::string_view end, std::string_view opening,
            std::string_view closing) {
  for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos;) {
    const std::size_t name = at + begin.size();
    const std::size_t quote = page.find('"', name);
    const std::size_t behind = page.find(end, quote);
    if (quote == std::string::npos || behind == std::string::npos) return;
    std::string content(asset_at(page.substr(name, quote - name)));
    // What would end the element early means the same with a backslash, in scripts and in styles.
    replace_all(content, "</", "<\\/");
    const std::string element = std::string(opening) + content + std::string(closing);
    page.replace(at, behind + end.size() - at, element);
    at += element.size();
  }
}

/// Those of the time of the rows, whatever of it.
Json events_within(const StudioHistory& history, std::int64_t from, std::int64_t to) {
  Json events = Json::array();
  for (const TraceEvent& event : history.events())
    if (event.t >= from && event.t <= to) events.push_back(event_json(event));
  return events;
}

Json jobs_within(const StudioHistory& history, std::int64_t from, std::int64_t to) {
  Json jobs = Json::array();
  for (const StudioJob& job : history.jobs())
    if (job.begin <= to && (job.end < 0 || job.end >= from)) jobs.push_back(job_json(job));
  return jobs;
}

}  // namespace

std::string trace_page(const TraceStore& store, const TracePart& part, const StudioHistory& history,
                       const std::string& name) {
  const TraceWindow seen = store.rows(part.columns, part.first, part.behind);
  Json signals = Json::array();
  for (const TraceWindow::Column& column : seen.columns) {
    const TraceSignal& signal = store.signals()[column.signal];
    signals.push_back({{"path", signal.name}, {"type", type_name(column.type)}, {"unit", signal.unit}});
  }
  const Json gaps = array_of(store.gaps(), [](const TraceStore::Gap& gap) {
    return Json{{"t", std::to_string(gap.t)}, {"rows", gap.missing}};
  });
  const std::int64_t from = seen.t.empty() ? 0 : seen.t.front();
  const std::int64_t to = seen.t.empty() ? -1 : seen.t.back();
  std::string data = text_of(Json{{"about", {{"version", LOCKSTEP_VERSION}, {"name", name}}},
                                  {"signals", signals},
                                  {"gaps", gaps},
                                  {"events", events_within(history, from, to)},
                                  {"jobs", jobs_within(history, from, to)},
                                  {"frame", base64(encode_frame({StudioFrameKind::window, 0, 0, 0}, seen))}});
  // Names are text, never markup.
  replace_all(data, "<", "\\u003c");
  std::string page;
  for (const StudioAsset& asset : studio_assets())
    if (asset.path == "/") page = asset.content;
  const std::string script = "<script type=\"application/json\" id=\"lockstep-trace\">" + data + "</script>";
  if (const std::size_t body = page.find("<body"); body != std::string::npos)
    page.insert(page.find('>', body) + 1, script);
  // It asks nobody for anything, not for its icon either.
  if (const std::size_t icon = page.find("<link rel=\"icon\""); icon != std::string::npos)
    page.erase(icon, page.find('>', icon) + 1 - icon);
  put_in(page, "<link rel=\"stylesheet\" href=\"", ">", "<style>", "</style>");
  put_in(page, "<script type=\"module\" src=\"", "</script>", "<script type=\"module\">", "</script>");
  return page;
}

StudioAnswer export_answer(const StudioRequest& request, const TraceStore& store, const TracePart& part,
                           const StudioHistory& history) {
  const std::uint64_t values = (part.behind - part.first) * (part.columns.size() + 1);
  if (values > kExportValues)
    return error_answer(413, "too_large",
                        std::to_string(values) + " values; allowed: " + std::to_string(kExportValues));
  const std::string_view format = request.value("format", "csv");
  if (format == "csv") return comma_separated(store, part);
  if (format == "lcm") return event_log(store, part);
  if (format != "html")
    throw BadRequest(422, "bad_request", "format: '" + std::string(format) + "'; allowed: csv, lcm, html");
  StudioAnswer answer;
  answer.type = "text/html; charset=utf-8";
  answer.file_name = "lockstep.html";
  answer.body = trace_page(store, part, history, std::string(request.value("name", "trace")));
  return answer;
}

}  // namespace lockstep::studio_api
