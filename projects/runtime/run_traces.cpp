// What a run records: traces, the flight recorder, events.
#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/traces/channel.hpp"
#include "hmi_bridge/traces/csv_trace.hpp"
#include "projects/runtime/run_files.hpp"
#include "projects/runtime/run_surroundings.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kTraceRows = 1 << 14;  // of the ring: seconds of a trace that a slow disk may hold up
constexpr std::size_t kTelegramsKept = std::size_t{1} << 17;  // of a flight recorder at most, 80 MiB
constexpr std::size_t kTraceValues = std::size_t{1} << 23;    // in the ring at most, 64 MiB

/// Gives events to whoever hears the messages. Thread: the recorder's.
class ToldEvents final : public TraceSink {
 public:
  explicit ToldEvents(Messages& messages) : messages_(messages) {}

  void begin(std::span<const TraceSignal> /*signals*/) override {}
  void row(const TraceRow& /*row*/) override {}
  void event(const TraceEvent& event) override { messages_.event(event); }
  void flush() override {}
  void end() override {}
  std::string_view name() const noexcept override { return "messages"; }

 private:
  Messages& messages_;
};

}  // namespace

void RunSurroundings::choose_signals() {
  if (options_.signals.empty()) {
    signals_ = project_.trace.signals;
    return;
  }
  for (const std::string& name : options_.signals) {
    const FoundOperand found = project_.names.find(name);
    if (!found.place) throw CouldNotStart(named("signals") + found.problem);
    const Type type = found.place->signal.type;
    if (type >= Type::AXIS) throw CouldNotStart(named("signals") + name + " has no value to record");
    signals_.push_back(
        {name, found.place->signal, found.place->unit, found.place->object, found.place->instance});
  }
}

LcmTraceIdentity RunSurroundings::identity(const std::string& channel) const {
  LcmTraceIdentity named = identity();
  named.channel = channel;
  return named;
}

LcmTraceIdentity RunSurroundings::identity() const {
  return {.project = project_.name,
          .channel = project_.trace.channel.empty() ? "LOCKSTEP" : project_.trace.channel,
          .period = project_.controller->clock.interpolator_cycle(),
          .epoch = options_.simulate ? 0 : epoch_};
}

/// A sink that gets the signals of the trace.
void RunSurroundings::add_whole(std::unique_ptr<TraceSink> sink) {
  sinks_.push_back(std::make_unique<TraceChannel>(std::move(sink), columns_.of(signals_)));
}

void RunSurroundings::add_part(std::unique_ptr<TraceSink> sink, const TraceChannelConfig& config) {
  std::optional<std::size_t> occasion;
  if (config.occasion) occasion = columns_.of(*config.occasion);
  sinks_.push_back(std::make_unique<TraceChannel>(std::move(sink), columns_.of(config.signals),
                                                  config.selection, occasion));
}

void RunSurroundings::add_trace_file() {
  const std::string& path = options_.trace;
  if (path.empty()) return;
  try {
    if (path.ends_with(".csv")) {
      add_whole(std::make_unique<CsvTrace>(path));
    } else if (path.ends_with(".lcm")) {
      auto log = std::make_unique<LcmLog>(path, identity());
      for (const TraceChannelConfig& channel : project_.trace.channels)
        add_part(log->add_channel(identity(channel.channel)), channel);
      add_whole(std::move(log));
      project_.controller->tell_jobs();
      jobs_told_ = true;
    } else {
      throw CouldNotStart(named("trace") + "'" + path + "' has to end in .csv or .lcm");
    }
  } catch (const std::system_error& error) {
    throw CouldNotStart(named("trace") + error.what());
  }
}

void RunSurroundings::add_lcm() {
  const bool asked = !options_.lcm.empty();
  const bool wanted = asked || (!options_.simulate && !options_.no_lcm && !project_.trace.url.empty());
  if (!wanted) return;
  const std::string url = asked ? options_.lcm : project_.trace.url;
  try {
    add_whole(std::make_unique<LcmPublisher>(url, identity()));
    for (const TraceChannelConfig& channel : project_.trace.channels)
      add_part(std::make_unique<LcmPublisher>(url, identity(channel.channel), false), channel);
    if (!jobs_told_) project_.controller->tell_jobs();
    jobs_told_ = true;
  } catch (const std::exception& error) {
    if (asked) throw CouldNotStart(named("lcm") + error.what());
    messages_.warn(std::string("no traces over LCM: ") + error.what());
  }
}

void RunSurroundings::add_flight_recorder() {
  if (!project_.flight_recorder) return;
  const FlightRecorderConfig& config = *project_.flight_recorder;
  FlightRecorderOptions recording = config.options;
  recording.file = path_of_run(options_.file, recording.file);
  if (const std::string problem = Recordings(recording.file).problem(); !problem.empty())
    messages_.warn("the flight recorder cannot write: " + problem);
  add_telegram_recorder(recording);
  auto recorder = std::make_unique<FlightRecorder>(std::move(recording), columns_.of(config.signals),
                                                   project_.controller->clock.interpolator_cycle());
  flight_ = recorder.get();
  sinks_.push_back(std::move(recorder));
}

/// As much as there may be in the time that is recorded, within a limit.
void RunSurroundings::add_telegram_recorder(const FlightRecorderOptions& recording) {
  if (exchanges_.empty()) return;
  double rate = 0.0;
  for (const auto& exchange : exchanges_) rate += exchange->rate();
  const double time = static_cast<double>(recording.before + recording.after) * 1e-9;
  const double wanted = 1.5 * rate * time + 100.0;
  telegrams_ = std::make_unique<TelegramMemory>(
      static_cast<std::size_t>(std::min(wanted, static_cast<double>(kTelegramsKept))));
  for (const auto& exchange : exchanges_) exchange->keep_in(*telegrams_);
  auto recorder = std::make_unique<TelegramRecorder>(recording, *telegrams_);
  telegram_flight_ = recorder.get();
  sinks_.push_back(std::move(recorder));
}

/// Alarms are told in any case; rows are recorded only for somebody.
void RunSurroundings::start_trace() {
  add_trace_file();
  add_lcm();
  add_flight_recorder();
  if (studio_ && !jobs_told_) {
    project_.controller->tell_jobs();
    jobs_told_ = true;
  }
  if (!jobs_told_) project_.controller->tell_jobs(JobsTold::failures);
  project_.controller->epoch = options_.simulate ? 0 : epoch_;
  const bool rows = !sinks_.empty();
  sinks_.insert(sinks_.begin(), std::make_unique<ToldEvents>(messages_));
  if (studio_) sinks_.push_back(studio_->sink());
  std::vector<Signal> places = columns_.places();
  const std::size_t fitting = kTraceValues / (places.size() + 1);
  ring_ = std::make_unique<TraceRing>(std::move(places),
                                      rows ? std::clamp<std::size_t>(fitting, 1 << 10, kTraceRows) : 2);
  if (rows) project_.controller->trace = ring_.get();
  project_.controller->events = &events_;
  recorder_ = std::make_unique<TraceRecorder>(
      *ring_, columns_.described(), std::move(sinks_),
      EventSource{&events_, EventTexts(*project_.controller, project_.controller->epoch), rows});
}

void RunSurroundings::tell_recordings() const {
  for (const std::string& file : flight_->written()) messages_.inform("flight recorder: wrote " + file);
  if (telegram_flight_ != nullptr)
    for (const std::string& file : telegram_flight_->written())
      messages_.inform("flight recorder: wrote " + file);
  for (const std::string& problem : flight_->not_removed()) messages_.warn("flight recorder: " + problem);
}

}  // namespace lockstep
