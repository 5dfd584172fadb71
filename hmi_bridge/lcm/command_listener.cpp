#include "hmi_bridge/lcm/command_listener.hpp"

#include <poll.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <utility>

#include "hmi_bridge/network/visible_text.hpp"
#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr int kBurst = 1000;                   // datagrams taken between two looks at the clock
constexpr LcmBounds kShortOnly{.message = 0};  // a command fits a datagram
constexpr std::size_t kLongestAxis = 128;      // of a name that is told
constexpr auto kPoll = 20ms;                   // how long the end of a run may wait for this thread

std::int64_t number_by_chance() {
  std::random_device chance;
  return static_cast<std::int64_t>(std::uint64_t{chance()} << 32 | chance());
}

}  // namespace

CommandListener::CommandListener(const std::string& url, LcmTraceIdentity identity,
                                 std::vector<CommandAxis> axes, ProcessImage& image, std::int64_t servo_cycle,
                                 Answers answers)
    : identity_(std::move(identity)),
      joined_(url, identity_, false),
      receiver_(joined_, identity_.channel + std::string(kCommandSuffix), kShortOnly,
                [this](const LcmMessage& message) { take(message); }),
      image_(image),
      desk_(std::move(axes), image, number_by_chance()),
      servo_cycle_(servo_cycle),
      answers_(std::move(answers)) {}

CommandListener::~CommandListener() {
  stop();
}

void CommandListener::start() {
  thread_ = std::thread([this] { listen(); });
}

void CommandListener::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void CommandListener::audit_to(AuditLog& log) {
  desk_.watch([this, &log](const CommandDesk::Judged& judged) {
    AuditEntry entry;
    entry.tick = image_.tick();
    entry.via = "lcm";
    entry.from = sender_.empty() ? "this process" : std::string(sender_);
    entry.source = entry.from.substr(0, entry.from.find(':'));
    entry.before = judged.before;
    entry.after = judged.after;
    entry.accepted = judged.reason.empty();
    entry.why = judged.reason;
    entry.action = "command";
    // Texts and numbers of a stranger are told, but what repeats is not parted by them.
    if (entry.accepted) entry.subject = judged.command->axis;
    for (const auto count :
         {&CommandCounters::malformed, &CommandCounters::stale, &CommandCounters::not_valid,
          &CommandCounters::impossible, &CommandCounters::too_many})
      entry.subject += judged.count == count ? '1' : '0';
    if (judged.command != nullptr) {
      entry.who = "panel " + std::to_string(judged.command->sender);
      entry.target = judged.command->axis.substr(0, kLongestAxis);
      if (const auto action = action_text(judged.command->action); !action.empty()) entry.action = action;
    }
    log.add(std::move(entry));
  });
}

void CommandListener::take(const LcmMessage& message) {
  sender_ = message.sender;
  const auto answer = desk_.accept(message.data, CommandDesk::Clock::now());
  if (answer) tell(*answer);
}

void CommandListener::listen() noexcept {
  block_write_signals();
  auto due = CommandDesk::Clock::now();
  while (!stop_) {
    const auto now = CommandDesk::Clock::now();
    if (now >= due) {
      due = std::max(due + kBeat, now);
      try {
        beat();
      } catch (...) {
        ++faults_;
      }
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(due - now);
    pollfd source{receiver_.descriptor(), POLLIN, 0};
    poll(&source, 1, static_cast<int>(std::clamp<std::int64_t>(left.count(), 1, kPoll.count())));
    try {
      if (source.revents != 0) receiver_.take(kBurst);
    } catch (...) {
      ++faults_;
    }
  }
}

std::int64_t CommandListener::time() const noexcept {
  return std::max<std::int64_t>(image_.tick(), 0) * servo_cycle_;
}

void CommandListener::beat() {
  desk_.beat();
  image_.refresh();
  const std::string channel = identity_.channel + std::string(kPanelSuffix);
  for (std::size_t axis = 0; axis < desk_.axes().size(); ++axis) {
    panel_t panel = desk_.panel(axis);
    panel.t = time();
    panel.utime = identity_.utime(panel.t);
    const auto bytes = encoded(panel);
    lcm_publish(joined_.instance(), channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size()));
  }
}

void CommandListener::tell(const CommandDesk::Answer& answer) {
  image_.refresh();
  TraceEvent event;
  event.kind = answer.accepted ? EventKind::command_accepted : EventKind::command_refused;
  event.t = time();
  event.tick = static_cast<std::uint64_t>(std::max<std::int64_t>(image_.tick(), 0));
  event.source = visible(answer.axis);  // it goes on to panels and logs
  event.type = answer.action;
  event.text = answer.reason;
  answers_(std::move(event));
}

}  // namespace lockstep
