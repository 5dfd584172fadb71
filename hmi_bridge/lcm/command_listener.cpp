#include "hmi_bridge/lcm/command_listener.hpp"

#include <poll.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr int kQueue = 1000;  // messages that wait, beyond which LCM drops them
constexpr int kBurst = 100;   // messages taken between two looks at the clock
constexpr auto kPoll = 20ms;  // how long the end of a run may wait for this thread

std::int64_t number_by_chance() {
  std::random_device chance;
  return static_cast<std::int64_t>(std::uint64_t{chance()} << 32 | chance());
}

/// LCM takes the channel of a subscription for a pattern.
std::string as_pattern(const std::string& channel) {
  std::string pattern;
  for (const char c : channel) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       c == '_' || static_cast<unsigned char>(c) >= 0x80;
    if (!plain) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

}  // namespace

CommandListener::CommandListener(const std::string& url, LcmTraceIdentity identity,
                                 std::vector<CommandAxis> axes, ProcessImage& image, std::int64_t servo_cycle,
                                 Answers answers)
    : identity_(std::move(identity)),
      joined_(url, identity_, false),
      image_(image),
      desk_(std::move(axes), image, number_by_chance()),
      servo_cycle_(servo_cycle),
      answers_(std::move(answers)) {
  const std::string pattern = as_pattern(identity_.channel + std::string(kCommandSuffix));
  auto* const subscription = lcm_subscribe(joined_.instance(), pattern.c_str(), &CommandListener::take, this);
  if (subscription == nullptr) throw std::runtime_error("LCM on " + url + ": cannot be subscribed to");
  lcm_subscription_set_queue_capacity(subscription, kQueue);
}

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

void CommandListener::take(const lcm_recv_buf_t* buffer, const char* /*channel*/, void* self) noexcept {
  auto& listener = *static_cast<CommandListener*>(self);
  try {
    const auto answer = listener.desk_.accept(
        {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size}, CommandDesk::Clock::now());
    if (answer) listener.tell(*answer);
  } catch (...) {
    ++listener.faults_;
  }
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
    pollfd source{lcm_get_fileno(joined_.instance()), POLLIN, 0};
    poll(&source, 1, static_cast<int>(std::clamp<std::int64_t>(left.count(), 1, kPoll.count())));
    for (int i = 0; i < kBurst && source.revents != 0; ++i)
      if (lcm_handle_timeout(joined_.instance(), 0) <= 0) break;
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
  event.source = answer.axis;
  event.type = answer.action;
  event.text = answer.reason;
  answers_(std::move(event));
}

}  // namespace lockstep
