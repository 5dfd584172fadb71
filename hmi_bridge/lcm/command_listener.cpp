#include "hmi_bridge/lcm/command_listener.hpp"

#include <poll.h>

#include <algorithm>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr int kBurst = 1000;                   // datagrams taken between two looks at the clock
constexpr LcmBounds kShortOnly{.message = 0};  // a command fits a datagram
constexpr auto kPoll = 20ms;                   // how long the end of a run may wait for this thread

}  // namespace

CommandListener::CommandListener(const std::string& url, LcmTraceIdentity identity, SharedDesk& desk)
    : identity_(std::move(identity)),
      joined_(url, identity_, false),
      receiver_(joined_, identity_.channel + std::string(kCommandSuffix), kShortOnly,
                [this](const LcmMessage& message) { desk_.take(message.data, message.sender); }),
      desk_(desk) {}

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

void CommandListener::listen() noexcept {
  block_write_signals();
  auto due = SharedDesk::Clock::now();
  while (!stop_) {
    const auto now = SharedDesk::Clock::now();
    if (now >= due) {
      due = std::max(due + SharedDesk::kBeat, now);
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

void CommandListener::beat() {
  desk_.beat(SharedDesk::Clock::now());
  const std::string channel = identity_.channel + std::string(kPanelSuffix);
  for (SharedDesk::Panel& panel : desk_.panels(CommandRoute::lcm)) {
    panel.stand.utime = identity_.utime(panel.stand.t);
    const auto bytes = encoded(panel.stand);
    lcm_publish(joined_.instance(), channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size()));
  }
}

}  // namespace lockstep
