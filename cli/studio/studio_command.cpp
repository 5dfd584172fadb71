// lockstep studio: a simulation and traces in a browser.
#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/command/command.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/command/whole_file.hpp"
#include "cli/describe/subject.hpp"
#include "cli/run/ending.hpp"
#include "hmi_bridge/lcm/trace_reader.hpp"
#include "hmi_bridge/studio/server.hpp"
#include "hmi_bridge/traces/csv_reader.hpp"
#include "projects/json/addresses.hpp"
#include "projects/json/document.hpp"
#include "projects/json/text_file.hpp"
#include "projects/runtime/desk_run.hpp"
#include "projects/studio/history.hpp"
#include "projects/studio/trace_exports.hpp"

namespace lockstep::cli {
namespace {

constexpr std::uint16_t kUsualPort = 8780;
constexpr int kPortsTried = 20;  // where none is given

struct StudioOptions {
  std::vector<std::string> files;
  std::string listen;
  std::string token_file;
  std::vector<std::string> names;
  std::vector<std::string> allow;
  std::string export_file;
  bool read_only = false;
};

/// What was asked for cannot be done; the text says why.
struct CannotServe : std::runtime_error {
  using std::runtime_error::runtime_error;
};

bool is_trace(const std::string& file) {
  return file.ends_with(".csv") || file.ends_with(".lcm");
}

bool is_cam(const std::string& file) {
  return file.ends_with(".cam.json");
}

/// The cam files among the files, which have to be there.
std::vector<std::string> cams_among(const std::vector<std::string>& files) {
  std::vector<std::string> cams;
  for (const std::string& file : files)
    if (is_cam(file)) {
      read_text_file(file, JsonDocument::kLongest);  // which tells that it is not there
      cams.push_back(file);
    }
  return cams;
}

/// A token for this start: 256 bits by chance, as hexadecimal digits.
std::string made_token() {
  std::random_device chance;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (int word = 0; word < 8; ++word)
    for (std::uint32_t bits = chance(), digit = 0; digit < 8; ++digit, bits >>= 4)
      token += kDigits[bits & 15u];
  return token;
}

/// The project among the files; empty: there are only traces.
std::string project_among(const StudioOptions& options) {
  std::string project;
  for (const std::string& file : options.files) {
    if (is_trace(file) || is_cam(file)) continue;
    if (!project.empty()) throw CannotServe(file + ": one project is allowed, and " + project + " is one");
    project = file;
  }
  return project;
}

/// Of the project, or else the one in which the studio was started: below it pages name traces.
std::string folder_of(const std::string& project) {
  const std::filesystem::path path(project);
  std::error_code error;
  const std::filesystem::path folder =
      std::filesystem::absolute(path.parent_path().empty() ? "." : path.parent_path(), error);
  return error ? "." : folder.lexically_normal().string();
}

StudioServerOptions server_options(const StudioOptions& options) {
  StudioServerOptions wanted;
  std::string problem;
  if (!options.listen.empty()) {
    const std::optional<Endpoint> endpoint = parse_endpoint(options.listen, problem);
    if (!endpoint) throw CannotServe("--listen: " + problem);
    wanted.listen = *endpoint;
  }
  wanted.names = options.names;
  for (const std::string& text : options.allow) {
    const std::optional<IpNetwork> network = IpNetwork::parse(text, problem);
    if (!network) throw CannotServe("--allow: '" + text + "' is no network; " + problem);
    wanted.allow.push_back(*network);
  }
  if (!options.token_file.empty()) {
    wanted.token = read_studio_token(options.token_file, problem);
    if (wanted.token.empty()) throw CannotServe("--token-file: " + problem);
  } else if (!is_loopback(wanted.listen.host)) {
    throw CannotServe("--listen: whoever reaches " + to_string(wanted.listen) +
                      " could use the studio; allowed without --token-file: 127.0.0.1, [::1] and localhost");
  } else {
    // Other users of the machine are strangers too.
    wanted.token = made_token();
  }
  if (const char* const folder = std::getenv("TMPDIR"); folder != nullptr && *folder != '\0')
    wanted.upload_folder = folder;
  return wanted;
}

/// A server that listens; where no port was asked for, on the next that is free.
std::unique_ptr<StudioServer> started(StudioServerOptions wanted, bool port_is_given,
                                      StudioHandler& handler) {
  std::string problem;
  for (int i = 0; i < (port_is_given ? 1 : kPortsTried); ++i, ++wanted.listen.port) {
    auto server = std::make_unique<StudioServer>(wanted, handler);
    problem = server->start();
    if (problem.empty()) return server;
  }
  throw CannotServe("--listen: " + problem);
}

/// A signal has asked for the end.
class Wait {
 public:
  void stop() {
    const std::lock_guard lock(mutex_);
    over_ = true;
    wake_.notify_all();
  }
  void wait() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return over_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
};

int serve(const StudioOptions& options) {
  Ending ending;
  const std::string project = project_among(options);
  if (!project.empty()) {
    int status = kOk;
    if (!load_or_tell(project, status, {}, Warnings::told, LoadedFor::looking)) return status;
  }
  StudioServerOptions wanted = server_options(options);
  const std::string token = wanted.token;
  DeskHandler handler({.file = project,
                       .folder = folder_of(project),
                       .cams = cams_among(options.files),
                       .read_only = options.read_only,
                       .describe = [](const std::string& path) { return describe_as_json(path); }});
  for (const std::string& file : options.files)
    if (is_trace(file) && !handler.add_trace(file))
      throw CannotServe(file + ": too many traces; allowed: 32");
  const std::unique_ptr<StudioServer> server = started(std::move(wanted), !options.listen.empty(), handler);
  write_message("studio on http://" + to_string(server->endpoint()) + "/" +
                (options.token_file.empty() ? "#token=" + token : "") + "\n");
  Wait wait;
  ending.run([&wait] { wait.stop(); });
  wait.wait();
  server->stop();
  ending.finished();
  return kOk;
}

/// A trace with what has happened meanwhile, where its file tells.
struct KeptTrace {
  TraceStore store;
  StudioHistory history;
};

KeptTrace trace_of(const std::string& file) {
  if (file.ends_with(".csv")) return {TraceStore(read_csv_trace(file)), {}};
  KeptTrace trace{TraceStore(TraceStoreLimits{}), {}};
  LcmTraceReader reader(file);
  reader.hear_events([&trace](TraceEvent event) { trace.history.add(std::move(event)); });
  trace.store.set_signals(reader.signals());
  while (reader.next()) trace.store.append(reader.row().t, reader.row().tick, reader.row().values);
  return trace;
}

/// The trace as a page that opens without a server.
int export_page(const StudioOptions& options) {
  if (options.files.size() != 1 || !is_trace(options.files[0]))
    throw CannotServe("--export takes one trace; allowed: FILE.csv or FILE.lcm");
  const KeptTrace trace = trace_of(options.files[0]);
  const TraceStore& store = trace.store;
  studio_api::TracePart part{{}, store.begin(), store.end()};
  for (std::size_t i = 0; i < store.signals().size(); ++i) part.columns.push_back(i);
  const std::string name = options.files[0].substr(options.files[0].rfind('/') + 1);
  const std::string page = studio_api::trace_page(store, part, trace.history, name);
  try {
    write_whole_file(options.export_file, page);
  } catch (const std::runtime_error& error) {
    throw CannotServe(std::string("--export: ") + error.what());
  }
  return kOk;
}

int run_studio(const StudioOptions& options) {
  try {
    return options.export_file.empty() ? serve(options) : export_page(options);
  } catch (const CannotServe& error) {
    tell(error.what(), Severity::error);
  } catch (const TraceFormatError& error) {
    tell(error.what(), Severity::error);
  } catch (const UnreadableFile& error) {
    tell(error.what(), Severity::error);
  }
  return kCouldNotStart;
}

}  // namespace

void add_studio_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("studio", "A simulation and traces in a browser, at the desk");
  auto options = std::make_shared<StudioOptions>();
  command->add_option("FILE", options->files,
                      "a project, which is simulated and stands still at first, traces (.csv, .lcm), and cam "
                      "files (.cam.json)");
  command->add_option("--listen", options->listen,
                      "HOST:PORT to listen on; without it 127.0.0.1:8780, or the next port that is free");
  command->add_option("--token-file", options->token_file,
                      "file of the token that it asks for, which is needed beyond this machine; without it "
                      "each start has a token of its own, in the address that it prints");
  command->add_option("--host", options->names,
                      "a further name by which it may be called, such as that of a proxy");
  command->add_option("--allow", options->allow,
                      "address or network from which clients may come, such as 192.168.1.0/24");
  command->add_flag("--read-only", options->read_only, "pages only look");
  command->add_option("--export", options->export_file,
                      "write a trace as one page that opens without a server, FILE.html, and end");
  command->footer(
      "It prints one line with the address of the page and ends with Ctrl-C. A project that runs already is\n"
      "looked at with lockstep run FILE --studio HOST:PORT.\n"
      "Exit status: 0 ended as asked, 1 project not valid, 2 could not start, such as a port that is taken");
  command->callback([&action, options] { action = [options] { return run_studio(*options); }; });
}

}  // namespace lockstep::cli
