#include "projects/python/real_time.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "hmi_bridge/network/visible_text.hpp"
#include "projects/python/events.hpp"
#include "projects/python/gil.hpp"
#include "projects/python/places.hpp"
#include "projects/python/problems.hpp"
#include "projects/python/raise.hpp"
#include "projects/python/sealed.hpp"
#include "projects/python/values.hpp"
#include "projects/runtime/kept_values.hpp"
#include "projects/runtime/runtime.hpp"
#include "scheduler/process_image.hpp"

namespace py = pybind11;

namespace lockstep::python {
namespace {

constexpr std::size_t kMessagesKept = 10'000;  // the oldest go first

/// Keeps what a run tells until somebody asks.
class Kept final : public Messages {
 public:
  void inform(const std::string& text) noexcept override { keep("", text); }
  void warn(const std::string& text) noexcept override { keep("warning: ", text); }
  void event(const TraceEvent& event) override {
    const std::lock_guard lock(mutex_);
    add(events_, event);
  }

  std::vector<std::string> messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  std::vector<TraceEvent> events() const {
    const std::lock_guard lock(mutex_);
    return events_;
  }

 private:
  template <class Item>
  static void add(std::vector<Item>& list, Item item) {
    if (list.size() == kMessagesKept) list.erase(list.begin());
    list.push_back(std::move(item));
  }
  void keep(const char* before, const std::string& text) noexcept try {
    const std::lock_guard lock(mutex_);
    add(messages_, before + visible(text));
  } catch (const std::bad_alloc&) {
    return;  // a message is lost, the machine goes on
  }

  mutable std::mutex mutex_;  // the run tells from its threads
  std::vector<std::string> messages_;
  std::vector<TraceEvent> events_;
};

/// A signal that crosses to Python and back.
struct Crossing {
  std::size_t index = 0;  ///< in the image
  Range range;
  std::string read_only;  ///< why nobody may write it; empty if one may
};

/// A run in real time. All but waiting is done under the GIL, so that the image has one thread at a time.
class RealTimeProject {
 public:
  RealTimeProject(RunOptions options, const std::optional<std::vector<std::string>>& signals);
  ~RealTimeProject() { end(); }
  RealTimeProject(const RealTimeProject&) = delete;
  RealTimeProject& operator=(const RealTimeProject&) = delete;

  void stop() { opened().stop(); }
  bool wait(double seconds);
  void close();
  bool closed() const noexcept { return !runtime_ || is_copy(); }

  py::object read(const std::string& path);
  void write(const std::string& path, py::handle value);
  std::vector<std::string> paths() const { return paths_; }

  py::list events() const {
    require_own();
    return listed(kept_->events());
  }
  std::vector<std::string> messages() const {
    require_own();
    return kept_->messages();
  }
  std::string state() const;
  py::dict status();
  std::vector<std::string> modbus_endpoints();
  std::string name() const { return name_; }

 private:
  void end() noexcept;
  /// Whether this process was forked after the start: the threads of the run are not here, whatever they held
  /// stays locked.
  bool is_copy() const noexcept { return process_ != ::getpid(); }
  void require_own() const {
    if (is_copy())
      raise("ClosedError",
            fmt::format("the run is in process {}, of which this one was forked; allowed: to start one here",
                        process_));
  }
  Runtime& opened() {
    require_own();
    if (!runtime_) raise("ClosedError", "the run has been closed");
    return *runtime_;
  }
  const Crossing& crossing(const std::string& path);
  void add_image(Project& project, const std::optional<std::vector<std::string>>& signals);

  std::shared_ptr<Kept> kept_ = std::make_shared<Kept>();
  std::unique_ptr<ProcessImage> image_;  // the cycle knows of it, and goes before it
  std::unique_ptr<Runtime> runtime_;
  std::unordered_map<std::string, Crossing> crossings_;  // by path as it was asked for
  std::vector<std::string> paths_;
  std::string name_;
  int waiting_ = 0;  // threads in `wait`
  pid_t process_ = ::getpid();
};

/// Those that were asked for; else every tag that is one value, and what the project's trace has.
std::vector<std::string> chosen(const Project& project,
                                const std::optional<std::vector<std::string>>& signals) {
  if (signals) return *signals;
  std::vector<std::string> paths;
  for (const Tag& tag : project.controller->tags) paths.push_back(tag.name);
  for (const NamedSignal& signal : project.trace.signals) paths.push_back(signal.name);
  return paths;
}

void RealTimeProject::add_image(Project& project, const std::optional<std::vector<std::string>>& signals) {
  const std::vector<NamedSignal> named = signals_of(project, chosen(project, signals));
  for (const NamedSignal& signal : named) {
    const Place place = find_place(project, signal.name);
    const Operand& value = std::get<Operand>(place);
    crossings_[signal.name] = {paths_.size(), value.variable != nullptr ? value.variable->range : kAny,
                               why_read_only(place)};
    paths_.push_back(signal.name);
  }
  image_ = std::make_unique<ProcessImage>(places_of(named));
  project.controller->images.push_back(image_.get());
}

RealTimeProject::RealTimeProject(RunOptions options, const std::optional<std::vector<std::string>>& signals) {
  try {
    std::unique_ptr<RetainWriter> keeper;
    LoadedProject loaded = [&] {
      const WithoutGil without_gil;
      return load_project_file(options.file,
                               [&](Project& project) { keeper = restore_kept(project, options, *kept_); });
    }();
    for (const Problem& warning : loaded.warnings) kept_->warn(to_string(options.file, warning));
    name_ = valid(loaded, {options.file, true}).name;
    runtime_ =
        std::make_unique<Runtime>(std::move(*loaded.project), std::move(keeper), std::move(options), kept_);
    runtime_->prepare();
    add_image(runtime_->project(), signals);
    const WithoutGil without_gil;
    runtime_->start();
  } catch (const CouldNotStart& error) {
    raise("RunError", error.what());
  } catch (const RetainFileError& error) {
    raise("RunError", error.what());
  } catch (const UnreadableFile& error) {
    raise("RunError", error.what());
  }
}

bool RealTimeProject::wait(double seconds) {
  if (!(seconds >= 0.0 && seconds <= 9e9))
    raise("OutOfRange", fmt::format("seconds may not be {}; allowed: 0 to 9e+09", seconds));
  Runtime& runtime = opened();
  struct Waiting {
    int& count;
    explicit Waiting(int& waiting) : count(waiting) { ++count; }
    ~Waiting() { --count; }
  } const waiting(waiting_);
  const WithoutGil without_gil;
  const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(std::llround(seconds * 1e9));
  while (runtime.state() != RuntimeState::ended) {
    const auto left = end - std::chrono::steady_clock::now();
    if (left.count() <= 0) return false;
    const auto slice = std::min<std::chrono::nanoseconds>(left, kBetweenLooks);
    const auto rounded = std::chrono::ceil<std::chrono::milliseconds>(slice);
    if (runtime.wait_for_rest(rounded)) runtime.wait(rounded);
    look_at_signals();
  }
  return true;
}

void RealTimeProject::close() {
  if (is_copy()) return;
  if (waiting_ != 0) raise("BusyError", "another thread waits for the end of this run; stop() ends it");
  end();
}

/// What does not come to its end is left alone, with the image that it may still look into.
void RealTimeProject::end() noexcept {
  if (!runtime_) return;
  if (is_copy()) {  // its threads are not here to be waited for
    static_cast<void>(runtime_.release());
    static_cast<void>(image_.release());
    return;
  }
  const std::unique_ptr<Runtime> runtime = std::move(runtime_);
  const WithoutGil without_gil;
  runtime->stop();
  const bool was_started = runtime->state() != RuntimeState::loaded;
  if (was_started && !runtime->wait()) static_cast<void>(image_.release());
}

const Crossing& RealTimeProject::crossing(const std::string& path) {
  const auto found = crossings_.find(path);
  if (found != crossings_.end()) return found->second;
  std::string names;
  for (const std::string& name : paths_) names += (names.empty() ? "" : ", ") + name;
  if (names.size() > 300) names = names.substr(0, 297) + "…";
  raise("PathError",
        fmt::format("'{}' is not among the signals that cross to Python, which are chosen when the run "
                    "starts (signals=[…]); there are: {}",
                    path, names.empty() ? "none" : names));
}

py::object RealTimeProject::read(const std::string& path) {
  opened();
  const std::size_t index = crossing(path).index;
  image_->refresh();
  return to_python(image_->value(index), image_->type(index));
}

void RealTimeProject::write(const std::string& path, py::handle value) {
  opened();
  const Crossing& place = crossing(path);
  if (!place.read_only.empty())
    raise("ReadOnly", fmt::format("'{}' cannot be written: {}", path, place.read_only));
  const Value converted = from_python(value, image_->type(place.index), place.range, path);
  opened();  // the value, or another thread, may have closed the run meanwhile
  const SignalWrite write{static_cast<std::uint32_t>(place.index), converted, ~0ULL};
  image_->post({&write, 1});
}

std::string RealTimeProject::state() const {
  if (closed()) return "closed";
  switch (runtime_->state()) {
    case RuntimeState::loaded:
      return "loaded";
    case RuntimeState::running:
      return "running";
    case RuntimeState::ending:
      return "ending";
    case RuntimeState::ended:
      break;
  }
  return "ended";
}

py::dict RealTimeProject::status() {
  // All is read before the dictionary is made: making it may call what closes the run.
  const RealTimeStatus& status = opened().status();
  const auto seconds = [](std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) / 1e9; };
  const double time = seconds(status.time.load());
  const auto ticks = status.ticks.load();
  const auto missed_ticks = status.missed_ticks.load();
  const auto overruns = status.overruns.load();
  const double worst_lateness = seconds(status.worst_lateness.load());
  const double longest_tick = seconds(status.longest_tick.load());
  py::dict values;
  values["time"] = time;
  values["ticks"] = ticks;
  values["missed_ticks"] = missed_ticks;
  values["overruns"] = overruns;
  values["worst_lateness"] = worst_lateness;
  values["longest_tick"] = longest_tick;
  return values;
}

std::vector<std::string> RealTimeProject::modbus_endpoints() {
  std::vector<std::string> endpoints;
  for (const Endpoint& endpoint : opened().modbus_endpoints())
    endpoints.push_back(fmt::format("{}:{}", endpoint.host, endpoint.port));
  return endpoints;
}

std::unique_ptr<RealTimeProject> start(const std::string& file,
                                       const std::optional<std::vector<std::string>>& signals,
                                       const py::dict& options) {
  RunOptions wanted;
  wanted.file = file;
  wanted.duration =
      options["duration"].is_none() ? -1 : std::llround(options["duration"].cast<double>() * 1e9);
  wanted.trace = options["trace"].cast<std::string>();
  wanted.stimuli = options["stimuli"].cast<bool>();
  wanted.cpu = options["cpu"].is_none() ? -1 : options["cpu"].cast<int>();
  wanted.modbus = options["modbus"].cast<std::string>();
  wanted.no_modbus = options["no_modbus"].cast<bool>();
  wanted.lcm = options["lcm"].cast<std::string>();
  wanted.no_lcm = options["no_lcm"].cast<bool>();
  wanted.retain = options["retain"].cast<std::string>();
  wanted.no_retain = options["no_retain"].cast<bool>();
  return std::make_unique<RealTimeProject>(std::move(wanted), signals);
}

}  // namespace

void add_real_time_project(py::module_& module) {
  py::class_<RealTimeProject> type(module, "RealTimeProject",
                                   "A project in real time; lockstep.RealTime is its face.");
  seal(type);
  type.def("stop", &RealTimeProject::stop)
      .def("wait", &RealTimeProject::wait, py::arg("seconds"))
      .def("close", &RealTimeProject::close)
      .def_property_readonly("closed", &RealTimeProject::closed)
      .def("read", &RealTimeProject::read, py::arg("path"))
      .def("write", &RealTimeProject::write, py::arg("path"), py::arg("value"))
      .def("paths", &RealTimeProject::paths)
      .def("events", &RealTimeProject::events)
      .def("messages", &RealTimeProject::messages)
      .def("modbus_endpoints", &RealTimeProject::modbus_endpoints)
      .def("status", &RealTimeProject::status)
      .def_property_readonly("state", &RealTimeProject::state)
      .def_property_readonly("name", &RealTimeProject::name);
  module.def("start", &start, py::arg("file"), py::arg("signals"), py::arg("options"),
             "A project in real time, running.");
}

}  // namespace lockstep::python
