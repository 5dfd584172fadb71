#include "projects/runtime/run_surroundings.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "hmi_bridge/lcm/url.hpp"
#include "projects/runtime/run_files.hpp"

namespace lockstep {

RunSurroundings::RunSurroundings(Project& project, const RunOptions& options,
                                 std::unique_ptr<RetainWriter> keeper, Messages& messages)
    : project_(project), options_(options), messages_(messages), keeper_(std::move(keeper)) {
  choose_signals();
  join_others();
  start_audit();
  make_studio();
  start_trace();
  start_modbus();
  start_clients();
  make_commands();
  start_commands();
  if (keeper_) project_.controller->images.push_back(&keeper_->image());
  if (keeper_) keeper_->start();
  start_studio();
  for (const auto& exchange : exchanges_) exchange->start();
}

void RunSurroundings::wait_no_more() {
  ring_->close();
  events_.close();
}

void RunSurroundings::take_no_more() {
  hear_no_more();
  if (server_) server_->refuse_writes();
}

void RunSurroundings::hear_no_more() {
  if (commands_) commands_->end();
}

void RunSurroundings::look() {
  if (audit_)
    if (const std::string news = audit_->news(); !news.empty()) messages_.warn(news);
  for (const auto& exchange : exchanges_) exchange->look();
  if (!keeper_) return;
  for (std::string news; !(news = keeper_->news()).empty();) messages_.warn(news);
}

void RunSurroundings::end() {
  part_ = Part::values;
  if (keeper_) keeper_->stop();  // the values of the last tick
  part_ = Part::leading;
  for (const auto& exchange : exchanges_) exchange->end();
  part_ = Part::server;
  if (server_) server_->stop();
  part_ = Part::clients;
  for (const auto& client : clients_) client->stop();
  part_ = Part::studio;
  if (studio_server_) studio_server_->stop();
  part_ = Part::trace;
  hear_no_more();
  recorder_->stop();
  part_ = Part::audit;
  if (audit_) audit_->stop();
  part_ = Part::none;
}

void RunSurroundings::tell_losses() {
  look();
  if (keeper_ && keeper_->failing()) messages_.warn("the last values are not kept");
  if (audit_ && audit_->lost() != 0)
    messages_.warn(fmt::format("audit log {}: {} entries are lost", audit_->path(), audit_->lost()));
  if (server_) tell_refused_clients();
  for (const auto& client : clients_) tell_failures(*client);
  if (commands_) commands_->tell_counters();
  for (const auto& exchange : exchanges_) exchange->tell_losses();
  if (studio_server_ && studio_server_->counters().faults != 0)
    messages_.warn(
        fmt::format("studio: {} internal faults survived", studio_server_->counters().faults.load()));
  if (flight_ != nullptr) tell_recordings();
  for (const std::string& loss : recorder_->losses()) messages_.warn(loss);
}

bool RunSurroundings::trace_is_incomplete() const {
  return !options_.trace.empty() && recorder_->has_lost(options_.trace);
}

std::vector<std::string> RunSurroundings::unfinished() const {
  std::vector<std::string> texts = recorder_->losses();
  if (std::string held_up = recorder_->held_up(); !held_up.empty()) texts.push_back(std::move(held_up));
  const Part part = part_;
  if (part == Part::leading) texts.emplace_back("the exchange of leading values does not end");
  if (part == Part::values)
    texts.push_back("retain file " + keeper_->path() +
                    ": writing does not end; the last values are not kept");
  if (part == Part::server) texts.emplace_back("the Modbus server does not end");
  if (part == Part::clients) texts.emplace_back("a Modbus client does not end");
  if (part == Part::studio) texts.emplace_back("the studio does not end");
  if (part == Part::audit)
    texts.push_back("audit log " + audit_->path() + ": writing does not end; the last entries are lost");
  return texts;
}

std::optional<std::int64_t> RunSurroundings::clock_offset() const {
  if (exchanges_.empty()) return std::nullopt;
  return exchanges_.front()->clock_offset();
}

void RunSurroundings::tell_start(std::int64_t start) {
  for (const auto& exchange : exchanges_) messages_.inform(exchange->started(start));
}

/// In virtual time there are no others.
void RunSurroundings::join_others() {
  if (options_.simulate) return;
  for (const NetworkCoupling& coupling : project_.couplings)
    exchanges_.push_back(std::make_unique<LeadingValueExchange>(project_, coupling, messages_));
}

/// In virtual time only where somebody asks for it, as the others that look out.
void RunSurroundings::start_audit() {
  AuditOptions wanted = project_.audit.value_or(AuditOptions{});
  wanted.file = path_of_run(options_.file, wanted.file);
  if (!options_.audit.empty())
    wanted.file = options_.audit;
  else if (options_.simulate || !project_.audit)
    return;
  try {
    audit_ = std::make_unique<AuditLog>(std::move(wanted), project_.name);
  } catch (const std::system_error& error) {
    throw CouldNotStart(std::string("audit log: ") + error.what());
  }
  messages_.inform("writes and commands from outside are told in " + audit_->path());
}

/// The desk of all who command: over LCM, where nobody does so in virtual time, and pages of the studio.
void RunSurroundings::make_commands() {
  if (project_.commands.axes.empty()) return;
  const bool over_lcm = !options_.simulate && !options_.no_lcm;
  if (!over_lcm && !studio_) return;
  commands_ = std::make_unique<PanelCommands>(
      project_, [this](TraceEvent answer) { recorder_->tell(std::move(answer)); }, audit_.get(), messages_);
}

void RunSurroundings::start_commands() {
  if (!commands_ || options_.simulate || options_.no_lcm || !commands_->desk().has_axes(CommandRoute::lcm))
    return;
  const std::string url = options_.lcm.empty() ? project_.trace.url : options_.lcm;
  try {
    commands_->hear(url, identity());
    // Of the project's own network the loader has warned.
    if (!options_.lcm.empty() && lcm_leaves_machine(url))
      messages_.warn(named("lcm") + std::string(kLcmCommandsWarning));
  } catch (const std::exception& error) {
    messages_.warn(std::string("no commands over LCM: ") + error.what());
  }
}

}  // namespace lockstep
