#include "projects/runtime/desk_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"
#include "projects/studio/api_values.hpp"

namespace lockstep {
namespace {

using namespace studio_api;
using namespace std::chrono_literals;

constexpr auto kPaceLook = 2ms;                                  // how often the pace is looked at
constexpr std::int64_t kMaximumSteps = 1'000'000'000;            // ticks of a step
constexpr std::int64_t kLongestRun = 4'000'000'000'000'000'000;  // [ns]

/// There are only traces; nothing of this is shown.
constexpr std::string_view kNoProject =
    R"({ "lockstep": 1, "name": "traces", "clock": { "servo_cycle": "1ms" }, "programs": [] })";

std::unique_ptr<Simulation> simulation_of(const std::string& file) {
  return std::make_unique<Simulation>(file.empty() ? Simulation::from_text(kNoProject) : Simulation(file));
}

/// A whole number of a request. @throws BadRequest
std::int64_t whole_in(const Json& request, const char* key, std::int64_t highest) {
  const auto given = request.find(key);
  if (given == request.end()) return -1;
  std::int64_t number = -1;
  if (given->is_number_integer()) number = given->get<std::int64_t>();
  if (given->is_string()) {
    try {
      number = std::stoll(given->get<std::string>());
    } catch (const std::exception&) {
      number = -1;
    }
  }
  if (number < 0 || number > highest)
    throw BadRequest(422, "out_of_range",
                     std::string("'") + key + "': allowed are 0 to " + std::to_string(highest));
  return number;
}

}  // namespace

DeskRun::DeskRun(const DeskOptions& options, StudioTraceFiles& files, Restart restart)
    : simulation_(simulation_of(options.file)), restart_(std::move(restart)) {
  Controller& controller = *project().controller;
  session_ = std::make_unique<StudioSession>(project(), 0, project().studio.history);
  sink_ = session_->sink();
  controller.tap = &session_->tap();
  controller.events = &events_;
  controller.tell_jobs();
  texts_ = EventTexts(controller);
  make_desk();
  give_powers(options, files);
  if (!options.file.empty()) thread_ = std::thread([this] { run(); });
}

DeskRun::~DeskRun() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  session_->tap().close();
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void DeskRun::make_desk() {
  std::vector<Signal> signals;
  for (const CommandAxis& axis : project().commands.axes)
    signals.insert(signals.end(), axis.signals.begin(), axis.signals.end());
  if (signals.empty()) return;
  image_ = std::make_unique<ProcessImage>(std::move(signals));
  desk_ =
      std::make_unique<SharedDesk>(project().commands.axes, *image_, project().controller->clock.servo_cycle,
                                   [this](const TraceEvent& event) {
                                     if (event.kind == EventKind::command_accepted)
                                       journal_.has_commands = true;
                                     sink_->event(event);
                                   });
  project().controller->images.push_back(image_.get());
}

void DeskRun::give_powers(const DeskOptions& options, StudioTraceFiles& files) {
  StudioPowers powers;
  powers.mode = options.file.empty() ? StudioMode::files : StudioMode::desk;
  const std::string reason = options.read_only      ? "this studio only reads, as --read-only says"
                             : options.file.empty() ? "there is no project, only traces"
                                                    : "";
  powers.why_no_write = powers.why_no_command = reason;
  powers.why_no_files = options.read_only ? reason : "";
  powers.desk = desk_.get();
  powers.tell = [this](TraceEvent event) {
    if (event.t == 0) {
      // What no tick has done, such as a refusal, has happened now.
      const std::lock_guard lock(mutex_);
      event.t = now();
      event.tick = static_cast<std::uint64_t>(event.t / project().controller->clock.servo_cycle);
    }
    sink_->event(event);
  };
  powers.simulation = options.file.empty() ? nullptr : this;
  powers.journal = [this](std::int64_t tick, const std::string& body) {
    journal_.entries.push_back({tick, body});
  };
  powers.files = &files;
  powers.trace_folder = options.folder;
  powers.project_file = options.file;
  powers.project_folder = std::filesystem::path(options.file).parent_path().string();
  for (const std::string& cam : options.cams) powers.cams.push_back({cam.substr(cam.rfind('/') + 1), cam});
  powers.describe = options.describe;
  if (!options.file.empty()) {
    powers.project_text = expanded_project(options.file);
    powers.warnings = load_project_file(options.file, {}, LoadedFor::looking).warnings;
  }
  session_->empower(std::move(powers));
}

Json DeskRun::state() const {
  const std::lock_guard lock(mutex_);
  const std::int64_t cycle = project().controller->clock.servo_cycle;
  Json json = {{"state", !runs_   ? "paused"
                         : stops_ ? "seeking"
                                  : "running"},
               {"t", std::to_string(now())},
               {"tick", std::to_string(now() / cycle)}};
  if (speed_ > 0.0)
    json["speed"] = speed_;
  else
    json["speed"] = "max";
  const std::chrono::duration<double> spent = Clock::now() - from_;
  if (runs_ && spent.count() > 0.0)
    json["real"] = static_cast<double>(now() - from_t_) * 1e-9 / spent.count();
  return json;
}

bool DeskRun::while_paused(const std::function<void(std::int64_t tick)>& act) {
  const std::lock_guard lock(mutex_);
  if (runs_) return false;
  act(now() / project().controller->clock.servo_cycle);
  return true;
}

/// From here and now on.
void DeskRun::set_pace(double speed) {
  speed_ = speed;
  from_t_ = now();
  from_ = Clock::now();
}

void DeskRun::run_to(std::int64_t t) {
  until_ = t;
  stops_ = true;
  runs_ = now() < t;
}

Json DeskRun::obey(const Json& request) {
  const auto given = request.is_object() ? request.find("action") : request.end();
  const std::string action =
      given != request.end() && given->is_string() ? given->get<std::string>() : std::string();
  std::unique_lock lock(mutex_);
  const std::int64_t cycle = project().controller->clock.servo_cycle;
  if (action == "run") {
    stops_ = false;
    runs_ = true;
    set_pace(speed_);
  } else if (action == "pause") {
    runs_ = false;
  } else if (action == "step") {
    const std::int64_t cycles = whole_in(request, "cycles", kMaximumSteps);
    const std::int64_t ticks = whole_in(request, "ticks", kMaximumSteps);
    const std::int64_t ratio = project().controller->clock.interpolator_ratio;
    run_to(now() + cycle * (ticks >= 0 ? ticks : ratio * (cycles >= 0 ? cycles : 1)));
  } else if (action == "speed") {
    const auto speed = request.find("speed");
    const bool is_number = speed != request.end() && speed->is_number();
    const double number = is_number ? speed->get<double>() : 0.0;
    if (!is_number ? speed == request.end() || *speed != "max" : !(number >= kSlowest && number <= kFastest))
      throw BadRequest(422, "out_of_range", "'speed': allowed are 0.01 to 1000, and \"max\"");
    set_pace(number);
  } else if (action == "seek") {
    const std::int64_t t = whole_in(request, "t", kLongestRun);
    if (t >= now()) {
      run_to(t);
    } else if (journal_.has_commands) {
      throw BadRequest(
          409, "conflict",
          "axes of this run were commanded by hand, which cannot be repeated; 'restart' begins it anew");
    } else {
      // Backwards: the same run once more, up to there.
      restart_(t);
      runs_ = false;
      return Json{{"state", "seeking"}, {"t", std::to_string(t)}, {"tick", std::to_string(t / cycle)}};
    }
  } else if (action == "restart") {
    restart_(std::nullopt);
    runs_ = false;
  } else {
    throw BadRequest(422, "bad_request", "'action' is none; allowed: run, pause, step, speed, seek, restart");
  }
  lock.unlock();
  wake_.notify_all();
  return state();
}

bool DeskRun::is_due() const {
  if (stops_ || !(speed_ > 0.0)) return true;  // to a time, it goes as fast as it can
  const std::chrono::duration<double, std::nano> spent = Clock::now() - from_;
  return static_cast<double>(now() - from_t_) <= spent.count() * speed_;
}

DeskJournal DeskRun::journal_before(std::int64_t t) const {
  DeskJournal journal = journal_;
  const std::int64_t cycle = project().controller->clock.servo_cycle;
  std::erase_if(journal.entries, [&](const DeskJournal::Entry& entry) { return entry.tick * cycle >= t; });
  return journal;
}

void DeskRun::repeat(std::int64_t t, DeskJournal journal, const std::vector<std::string>& recorded) {
  for (const DeskJournal::Entry& entry : journal.entries)
    repeated_.emplace_back(entry.tick, session_->chosen_writes(entry.body));
  journal_ = std::move(journal);
  session_->record(recorded);
  session_->look();  // hands over what is to be recorded
  const std::lock_guard lock(mutex_);
  run_to(t);
  wake_.notify_all();
}

void DeskRun::tick() {
  const std::int64_t number = now() / project().controller->clock.servo_cycle;
  for (; next_repeated_ < repeated_.size() && repeated_[next_repeated_].first <= number; ++next_repeated_) {
    repeating_.post(std::move(repeated_[next_repeated_].second));
    repeating_.apply(number);
  }
  simulation_->step();
  const std::size_t count = events_.readable();
  for (std::size_t i = 0; i < count; ++i) sink_->event(texts_.of(events_.event(i), events_.lost()));
  events_.pop(count);
  if (stops_ && now() >= until_) {
    runs_ = stops_ = false;
    set_pace(speed_);
  }
}

void DeskRun::run() noexcept {
  block_write_signals();
  while (true) {
    // Not with the lock: who makes space asks for it too.
    session_->tap().wait_for_space();
    std::unique_lock lock(mutex_);
    if (end_) return;
    if (!runs_) {
      wake_.wait(lock, [this] { return runs_ || end_; });
    } else if (!is_due()) {
      wake_.wait_for(lock, kPaceLook);
    } else {
      try {
        tick();
      } catch (...) {
        runs_ = false;  // there is no memory for what has happened
      }
    }
  }
}

DeskHandler::DeskHandler(DeskOptions options)
    : options_(std::move(options)),
      run_(std::make_unique<DeskRun>(options_, files_,
                                     [this](std::optional<std::int64_t> t) { ask_for_another(t); })) {}

void DeskHandler::ask_for_another(std::optional<std::int64_t> t) {
  next_ = std::make_unique<DeskRun>(options_, files_,
                                    [this](std::optional<std::int64_t> then) { ask_for_another(then); });
  wanted_t_ = t;
}

bool DeskHandler::add_trace(const std::string& path) {
  return files_.add(path, path.substr(path.rfind('/') + 1), false) != nullptr;
}

void DeskHandler::opened(StudioClient& client) {
  clients_.push_back(&client);
  run_->session().opened(client);
}

void DeskHandler::closed(StudioClient& client) noexcept {
  std::erase(clients_, &client);
  run_->session().closed(client);
}

/// A new run in place of the old one; its pages have to say hello again.
void DeskHandler::restart() {
  std::string problem;
  std::unique_ptr<DeskRun> made = std::move(next_);
  try {
    if (wanted_t_) made->repeat(*wanted_t_, run_->journal_before(*wanted_t_), run_->session().recorded());
  } catch (const std::exception& error) {
    problem = error.what();
    made.reset();
  }
  Json told = {{"type", "restarted"}};
  if (!problem.empty()) told = {{"type", "error"}, {"error", {{"code", "conflict"}, {"message", problem}}}};
  if (made) {
    for (StudioClient* const client : clients_) run_->session().closed(*client);
    run_->session().ended();
    run_ = std::move(made);
    for (StudioClient* const client : clients_) run_->session().opened(*client);
  }
  for (StudioClient* const client : clients_)
    if (client->is_authorised()) client->send_text(text_of(told));
}

void DeskHandler::look() {
  if (next_) restart();
  run_->session().look();
}

}  // namespace lockstep
