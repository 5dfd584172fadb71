#include "cli/monitor/inbox.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep::cli {
namespace {

constexpr int kBurst = 1000;
constexpr int kLook = 100;  // between two looks whether to end [ms]

int make_event() {
  const int fd = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), "no eventfd");
  return fd;
}

}  // namespace

Inbox::Inbox(LcmPublisher& joined)
    : event_(make_event()),
      receiver_(joined, "", LcmBounds{}, [this](const LcmMessage& message) { put(message); }),
      thread_([this] { listen(); }) {}

Inbox::~Inbox() {
  stop_ = true;
  thread_.join();
  ::close(event_);
}

void Inbox::listen() noexcept {
  block_write_signals();
  while (!stop_) {
    pollfd source{receiver_.descriptor(), POLLIN, 0};
    if (poll(&source, 1, kLook) <= 0) continue;
    try {
      receiver_.take(kBurst);
    } catch (...) {  // no memory for a message
      ++dropped_;
    }
  }
}

void Inbox::put(const LcmMessage& message) {
  Letter letter{std::string(message.channel), {message.data.begin(), message.data.end()}};
  const std::lock_guard lock(mutex_);
  if (letters_.size() >= kMaximumMessages || bytes_ + letter.data.size() > kMaximumBytes) {
    ++dropped_;
    return;
  }
  bytes_ += letter.data.size();
  letters_.push_back(std::move(letter));
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(event_, &one, sizeof one);  // it can only be set already
}

/// @return false if there is none; then the descriptor is not readable any more
bool Inbox::pop(Letter& letter) {
  const std::lock_guard lock(mutex_);
  if (letters_.empty()) {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto size = ::read(event_, &count, sizeof count);
    return false;
  }
  letter = std::move(letters_.front());
  letters_.pop_front();
  bytes_ -= letter.data.size();
  return true;
}

void Inbox::take(std::size_t maximum,
                 const std::function<void(const std::string&, std::span<const std::uint8_t>)>& handler) {
  Letter letter;
  for (std::size_t i = 0; i < maximum && pop(letter); ++i) handler(letter.channel, letter.data);
}

}  // namespace lockstep::cli
