#include "projects/runtime/runtime.hpp"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "projects/loader/simulation.hpp"
#include "projects/runtime/kept_values.hpp"
#include "projects/runtime/run_surroundings.hpp"
#include "projects/runtime/system_facts.hpp"
#include "scheduler/processor.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr auto kLook = 100ms;             // at what goes wrong
constexpr auto kLookWhileBraking = 10ms;  // whether the axes are at rest

class Unheard final : public Messages {
 public:
  void inform(const std::string& /*text*/) noexcept override {}
  void warn(const std::string& /*text*/) noexcept override {}
};

}  // namespace

/// What goes on, and all that it needs.
class Runtime::Run {
 public:
  Run(RunOptions options, std::shared_ptr<Messages> messages)
      : options_(std::move(options)),
        messages_(messages ? std::move(messages) : std::make_shared<Unheard>()) {
    if (options_.simulate)
      throw CouldNotStart(options_.mark + "simulate: a run in virtual time is stepped by its owner");
  }

  void load();
  void take(Project project, std::unique_ptr<RetainWriter> keeper) {
    project_ = std::move(project);
    keeper_ = std::move(keeper);
  }

  Project& project() noexcept { return *project_; }
  const std::vector<Endpoint>& modbus_endpoints() const noexcept { return modbus_endpoints_; }
  std::optional<Endpoint> studio_endpoint() const { return studio_endpoint_; }
  const std::vector<NamedSignal>& trace_signals() const noexcept { return trace_signals_; }
  std::vector<std::string> unfinished() const {
    return state() == RuntimeState::ending ? surroundings_->unfinished() : std::vector<std::string>{};
  }

  const RealTimeStatus& status() const {
    if (!cycle_) throw std::logic_error("a runtime that has not been started has no status");
    return cycle_->status();
  }

  RuntimeState state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }

  void leave_processor();
  void prepare();
  /// Up to the first tick.
  void start();
  void stop() noexcept;
  bool wait(std::chrono::milliseconds timeout);
  bool wait_for_rest(std::chrono::milliseconds time);
  /// From the first tick to the end.
  void look_after() noexcept;

 private:
  void look_until_at_rest();
  void enter(RuntimeState state) noexcept;
  template <class Call>
  void attempt(Call call) noexcept;

  const RunOptions options_;
  const std::shared_ptr<Messages> messages_;
  std::optional<Project> project_;
  std::unique_ptr<RetainWriter> keeper_;
  std::unique_ptr<RunSurroundings> surroundings_;
  std::unique_ptr<RealTimeRun> cycle_;
  std::vector<Endpoint> modbus_endpoints_;
  std::optional<Endpoint> studio_endpoint_;
  std::vector<NamedSignal> trace_signals_;
  bool left_ = false;  // the processor of the cycle
  bool prepared_ = false;
  bool started_ = false;
  mutable std::mutex mutex_;  // guards those below
  std::condition_variable changed_;
  RuntimeState state_ = RuntimeState::loaded;
  bool stops_ = false;  // has been asked to
};

void Runtime::Run::load() {
  LoadedProject loaded = load_project_file(
      options_.file, [this](Project& project) { keeper_ = restore_kept(project, options_, *messages_); });
  if (!loaded.project) {
    std::string text = "the project is not valid";
    for (const Problem& problem : loaded.problems) text += "\n" + to_string(options_.file, problem);
    throw InvalidProject(text);
  }
  for (const Problem& warning : loaded.warnings) messages_->warn(to_string(options_.file, warning));
  project_ = std::move(loaded.project);
}

void Runtime::Run::leave_processor() {
  if (options_.cpu < 0 || std::exchange(left_, true)) return;
  if (const std::string problem = lockstep::leave_processor(options_.cpu); !problem.empty())
    throw CouldNotStart(options_.mark + "cpu: " + problem);
}

void Runtime::Run::prepare() {
  if (std::exchange(prepared_, true)) throw std::logic_error("a runtime is prepared once");
  leave_processor();
  project_->controller->apply_stimuli = options_.stimuli;
  surroundings_ = std::make_unique<RunSurroundings>(*project_, options_, std::move(keeper_), *messages_);
  modbus_endpoints_ = surroundings_->modbus_endpoints();
  studio_endpoint_ = surroundings_->studio_endpoint();
  trace_signals_ = surroundings_->signals();
}

void Runtime::Run::start() {
  if (std::exchange(started_, true)) throw std::logic_error("a runtime is started once");
  if (!prepared_) prepare();
  if (!surroundings_) throw std::logic_error("a runtime that could not be prepared cannot be started");
  const OverrunPolicy policy = project_->stop_on_overrun ? OverrunPolicy::stop : OverrunPolicy::report;
  cycle_ = std::make_unique<RealTimeRun>(*project_->controller, policy, options_.duration, options_.cpu);
  if (const auto offset = surroundings_->clock_offset())
    cycle_->align(project_->controller->clock.interpolator_cycle(), *offset);
  try {
    const std::vector<std::string> warnings = cycle_->start();
    messages_->inform(system_text(read_system_facts(), cycle_->rights(), options_.cpu));
    for (const std::string& warning : warnings) messages_->warn(warning);
  } catch (...) {
    cycle_.reset();
    surroundings_.reset();
    throw;
  }
  surroundings_->tell_status(cycle_->status());
  const std::lock_guard lock(mutex_);
  state_ = RuntimeState::running;
  if (stops_) cycle_->stop();
}

void Runtime::Run::stop() noexcept {
  const std::lock_guard lock(mutex_);
  stops_ = true;
  if (state_ == RuntimeState::running) cycle_->stop();
  changed_.notify_all();
}

bool Runtime::Run::wait(std::chrono::milliseconds timeout) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return state_ != RuntimeState::running; });
  return changed_.wait_for(lock, timeout, [this] { return state_ != RuntimeState::ending; });
}

bool Runtime::Run::wait_for_rest(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  if (state_ == RuntimeState::running) changed_.wait_for(lock, time);
  return state_ != RuntimeState::running;
}

void Runtime::Run::enter(RuntimeState state) noexcept {
  const std::lock_guard lock(mutex_);
  state_ = state;
  changed_.notify_all();
}

/// What fails here is no reason to leave out what comes after it.
template <class Call>
void Runtime::Run::attempt(Call call) noexcept {
  try {
    call();
  } catch (const std::exception& error) {
    messages_->warn(std::string("internal fault: ") + error.what());
  }
}

void Runtime::Run::look_until_at_rest() {
  bool told = false;
  while (!cycle_->status().at_rest.load(std::memory_order_acquire)) {
    bool stops = false;
    {
      std::unique_lock lock(mutex_);
      if (stops_)
        changed_.wait_for(lock, kLookWhileBraking);
      else
        changed_.wait_for(lock, kLook, [this] { return stops_; });
      stops = stops_;
    }
    if (stops) surroundings_->hear_no_more();
    surroundings_->look();
    if (const std::int64_t start = cycle_->status().start.load(); start != 0 && !std::exchange(told, true))
      surroundings_->tell_start(start);
  }
}

void Runtime::Run::look_after() noexcept {
  attempt([this] { look_until_at_rest(); });
  // For a look that has failed: the axes are at rest otherwise.
  cycle_->stop();
  enter(RuntimeState::ending);
  // What is acknowledged up to here is taken by the tick that comes before the end.
  attempt([this] { surroundings_->take_no_more(); });
  cycle_->wait();
  attempt([this] { surroundings_->end(); });
  attempt([this] { surroundings_->tell_losses(); });
  enter(RuntimeState::ended);
}

Runtime::Runtime(RunOptions options, std::shared_ptr<Messages> messages)
    : run_(std::make_shared<Run>(std::move(options), std::move(messages))) {
  run_->load();
}

Runtime::Runtime(Project project, std::unique_ptr<RetainWriter> keeper, RunOptions options,
                 std::shared_ptr<Messages> messages)
    : run_(std::make_shared<Run>(std::move(options), std::move(messages))) {
  run_->take(std::move(project), std::move(keeper));
}

Runtime::~Runtime() {
  if (!thread_.joinable()) return;
  stop();
  if (wait())
    thread_.join();
  else
    thread_.detach();
}

void Runtime::leave_processor() {
  run_->leave_processor();
}

void Runtime::prepare() {
  run_->prepare();
}

void Runtime::start() {
  run_->start();
  try {
    thread_ = std::thread([run = run_] { run->look_after(); });
  } catch (...) {
    run_->stop();
    run_->look_after();
    throw;
  }
}

void Runtime::stop() noexcept {
  run_->stop();
}

bool Runtime::wait(std::chrono::milliseconds timeout) {
  return run_->wait(timeout);
}

bool Runtime::wait_for_rest(std::chrono::milliseconds time) {
  return run_->wait_for_rest(time);
}

RuntimeState Runtime::state() const {
  return run_->state();
}

const RealTimeStatus& Runtime::status() const {
  return run_->status();
}

std::vector<std::string> Runtime::unfinished() const {
  return run_->unfinished();
}

std::vector<Endpoint> Runtime::modbus_endpoints() const {
  return run_->modbus_endpoints();
}

std::optional<Endpoint> Runtime::studio_endpoint() const {
  return run_->studio_endpoint();
}

const std::vector<NamedSignal>& Runtime::trace_signals() const {
  return run_->trace_signals();
}

Project& Runtime::project() noexcept {
  return run_->project();
}

}  // namespace lockstep
