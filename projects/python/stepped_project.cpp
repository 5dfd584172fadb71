#include "projects/python/stepped_project.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "projects/python/events.hpp"
#include "projects/python/gil.hpp"
#include "projects/python/places.hpp"
#include "projects/python/problems.hpp"
#include "projects/python/raise.hpp"
#include "projects/python/sealed.hpp"
#include "projects/python/trace_arrays.hpp"
#include "projects/runtime/stepped_run.hpp"

namespace py = pybind11;

namespace lockstep::python {
namespace {

constexpr std::uint64_t kTicksAtOnce = 32;
constexpr double kLongest = 9e9;  // [s], which nanoseconds in 64 bits hold

/// A run in virtual time. Its state is guarded by the GIL, which is let go while ticks run; whoever comes
/// then is refused, so that two threads never touch one controller. Whatever runs Python, such as converting
/// a value or making a list, may let another thread in or call back here: what has been fetched of the
/// project before is fetched, or checked, again.
class SteppedProject {
 public:
  SteppedProject(std::string_view text, const std::string& folder, const TextSource& source,
                 const std::optional<std::vector<std::string>>& signals, bool jobs);

  void close() {
    if (run_) require_idle();
    run_.reset();
  }
  bool closed() const noexcept { return !run_; }

  void step(std::uint64_t ticks);
  bool run(double seconds, const std::optional<std::string>& until);

  py::object read(std::string_view path) { return read_place(find_place(project(), path)); }
  void write(std::string_view path, py::handle value) {
    const Place place = find_place(project(), path);
    const NewValues values = values_for(place, value, path);
    idle();  // the value, or another thread, may have closed the project or run it meanwhile
    store(place, values);
  }
  py::object evaluate(std::string_view text) { return python::evaluate(project(), text); }
  std::vector<std::string> paths() { return all_paths(project()); }
  py::tuple describe(std::string_view path) {
    const Place place = find_place(project(), path);
    return py::make_tuple(type_of_place(place), unit_of_place(place), why_read_only(place));
  }

  TraceView trace() { return TraceView(idle().trace()); }
  py::list events() {
    const std::vector<TraceEvent> events = idle().events();  // listing them may call what closes the project
    return python::listed(events);
  }
  py::list warnings() const { return warnings_; }
  std::string name() const { return name_; }
  std::string description() const { return description_; }
  double now() { return static_cast<double>(project().controller->now()) / 1e9; }
  std::uint64_t ticks() { return project().controller->counters().ticks; }
  double servo_cycle() { return static_cast<double>(project().controller->clock.servo_cycle) / 1e9; }

 private:
  /// Says for its lifetime that ticks run, and lets the GIL go.
  class Running {
   public:
    explicit Running(SteppedProject& owner) : owner_(owner) { owner_.running_ = true; }
    ~Running() { owner_.running_ = false; }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

   private:
    SteppedProject& owner_;
  };

  void require_idle() const {
    if (running_)
      raise("BusyError", "another thread runs this project; each thread has a Project of its own");
  }
  SteppedRun& idle() {
    if (!run_) raise("ClosedError", "the project has been closed");
    require_idle();
    return *run_;
  }
  Project& project() { return idle().project(); }
  bool run_ticks(std::uint64_t ticks, const Expression* until);

  std::unique_ptr<SteppedRun> run_;
  std::string name_, description_;
  py::list warnings_;
  bool running_ = false;
};

SteppedProject::SteppedProject(std::string_view text, const std::string& folder, const TextSource& source,
                               const std::optional<std::vector<std::string>>& signals, bool jobs) {
  LoadedProject loaded = [&] {
    const WithoutGil without_gil;
    return load_project(text, folder);
  }();
  Project& project = valid(loaded, source);
  SteppedRun::Options options{signals ? signals_of(project, *signals) : project.trace.signals, jobs};
  name_ = project.name;
  description_ = project.description;
  warnings_ = listed(loaded.warnings, source);
  run_ = std::make_unique<SteppedRun>(std::move(project), options);
}

/// @return whether the condition ended it
bool SteppedProject::run_ticks(std::uint64_t ticks, const Expression* until) {
  SteppedRun& run = idle();
  const Running running(*this);
  const WithoutGil without_gil;
  auto next_look = std::chrono::steady_clock::now() + kBetweenLooks;
  EvaluationCounters counters;
  while (ticks != 0) {
    const std::uint64_t now = until != nullptr ? 1 : std::min(ticks, kTicksAtOnce);
    run.step(now);
    ticks -= now;
    if (until != nullptr && until->evaluate(counters).u != 0) return true;
    if (const auto time = std::chrono::steady_clock::now(); time >= next_look) {
      look_at_signals();
      next_look = time + kBetweenLooks;
    }
  }
  return false;
}

void SteppedProject::step(std::uint64_t ticks) {
  const Controller& controller = *project().controller;
  const auto limit = static_cast<std::uint64_t>(
      (std::numeric_limits<std::int64_t>::max() - controller.now()) / controller.clock.servo_cycle);
  if (ticks > limit) raise("OutOfRange", fmt::format("n may not be {}; allowed: 0 to {}", ticks, limit));
  run_ticks(ticks, nullptr);
}

bool SteppedProject::run(double seconds, const std::optional<std::string>& until) {
  const Controller& controller = *project().controller;
  const double limit = kLongest - now();
  if (!(seconds >= 0.0 && seconds <= limit))
    raise("OutOfRange", fmt::format("seconds may not be {}; allowed: 0 to {:g}", seconds, limit));
  const std::int64_t cycle = controller.clock.servo_cycle;
  const std::int64_t span = std::llround(seconds * 1e9);
  const auto ticks = static_cast<std::uint64_t>(span / cycle + (span % cycle != 0 ? 1 : 0));
  std::optional<Expression> condition;
  if (until) condition = compile_condition(project(), *until);
  EvaluationCounters counters;
  if (condition && condition->evaluate(counters).u != 0) return true;
  return run_ticks(ticks, condition ? &*condition : nullptr);
}

py::tuple check(std::string_view text, const std::string& folder, std::string file, bool as_written) {
  const TextSource source{std::move(file), as_written};
  const LoadedProject loaded = [&] {
    const WithoutGil without_gil;
    return load_project(text, folder, {}, LoadedFor::looking);
  }();
  return py::make_tuple(listed(loaded.problems, source), listed(loaded.warnings, source));
}

std::unique_ptr<SteppedProject> load(std::string_view text, const std::string& folder, std::string file,
                                     bool as_written, const std::optional<std::vector<std::string>>& signals,
                                     bool jobs) {
  return std::make_unique<SteppedProject>(text, folder, TextSource{std::move(file), as_written}, signals,
                                          jobs);
}

}  // namespace

void add_stepped_project(py::module_& module) {
  module.def("check", &check, py::arg("text"), py::arg("folder"), py::arg("file"), py::arg("as_written"),
             "(problems, warnings), each (place, text, file, line, column, owner).");
  py::class_<SteppedProject> type(module, "SteppedProject",
                                  "A project in virtual time; lockstep.Project is its face.");
  seal(type);
  type.def("close", &SteppedProject::close)
      .def_property_readonly("closed", &SteppedProject::closed)
      .def("step", &SteppedProject::step, py::arg("ticks"))
      .def("run", &SteppedProject::run, py::arg("seconds"), py::arg("until"))
      .def("read", &SteppedProject::read, py::arg("path"))
      .def("write", &SteppedProject::write, py::arg("path"), py::arg("value"))
      .def("evaluate", &SteppedProject::evaluate, py::arg("expression"))
      .def("paths", &SteppedProject::paths)
      .def("describe", &SteppedProject::describe, py::arg("path"))
      .def("trace", &SteppedProject::trace)
      .def("events", &SteppedProject::events)
      .def("warnings", &SteppedProject::warnings)
      .def_property_readonly("name", &SteppedProject::name)
      .def_property_readonly("description", &SteppedProject::description)
      .def_property_readonly("now", &SteppedProject::now)
      .def_property_readonly("ticks", &SteppedProject::ticks)
      .def_property_readonly("servo_cycle", &SteppedProject::servo_cycle);
  module.def("load", &load, py::arg("text"), py::arg("folder"), py::arg("file"), py::arg("as_written"),
             py::arg("signals"), py::arg("jobs"), "A project in virtual time, at its beginning.");
}

}  // namespace lockstep::python
