#include "cli/run/ending.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <memory>
#include <system_error>
#include <utility>

#include "cli/command/command.hpp"

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kLook = 20ms;        // how often the watch looks while time counts
constexpr auto kLongestWords = 1s;  // for telling what is not finished

/// Those that ask for the end. A loss of power that is announced is one; so is a limit of processor time,
/// which is followed by SIGKILL.
constexpr int kAsking[] = {SIGINT, SIGTERM, SIGQUIT, SIGPWR, SIGXCPU};
/// Those that would end or stop the process with its axes in motion, and have no meaning for a run.
constexpr int kIgnored[] = {SIGHUP,    SIGPIPE, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF,
                            SIGSTKFLT, SIGIO,   SIGXFSZ, SIGTSTP, SIGTTIN, SIGTTOU};

void set_action(int signal, void (*handler)(int)) noexcept {
  struct sigaction action {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

sigset_t asking() noexcept {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kAsking) sigaddset(&set, signal);
  return set;
}

}  // namespace

Ending::Ending() {
  const sigset_t set = asking();
  for (const int signal : kIgnored) set_action(signal, SIG_IGN);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) set_action(signal, SIG_IGN);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  // One that the parent ignores would not be seen.
  for (const int signal : kAsking) set_action(signal, SIG_DFL);
  signals_in_ = ::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
  wake_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  const int error = signals_in_ < 0 || wake_ < 0 ? errno : 0;
  if (error != 0) throw std::system_error(error, std::generic_category(), "signals cannot be taken");
  thread_ = std::thread([this] { watch(); });
}

Ending::~Ending() {
  over_ = true;
  if (wake_ >= 0) ::eventfd_write(wake_, 1);
  if (thread_.joinable()) thread_.join();
  ::close(wake_);
  ::close(signals_in_);
}

void Ending::run(std::function<void()> stop) {
  {
    const std::lock_guard lock(mutex_);
    stop_ = std::move(stop);
    if (requested() && stop_) stop_();
  }
  enter(Stage::running);
}

void Ending::limit(std::function<std::vector<std::string>()> lost) {
  {
    const std::lock_guard lock(mutex_);
    stop_ = nullptr;
    lost_ = std::move(lost);
  }
  enter(Stage::ending);
}

void Ending::finished() {
  const std::lock_guard lock(mutex_);
  stop_ = nullptr;
  lost_ = nullptr;
}

void Ending::enter(Stage stage) {
  spent_ = 0;
  stage_ = stage;
  ::eventfd_write(wake_, 1);
}

/// What the stage may take; negative: it has no limit.
std::chrono::milliseconds Ending::limit_now() const noexcept {
  const Stage stage = stage_;
  if (stage == Stage::running) return requested() ? kLongestBraking : -1ms;
  if (stage == Stage::starting && !requested()) return -1ms;
  return signals_ > 1 ? kShortPatience : kPatience;
}

/// Time counts while this thread runs only: a process that was stopped for long has its time left when it
/// goes on.
void Ending::watch() noexcept {
  auto last = std::chrono::steady_clock::now();
  while (!over_) {
    const bool counts = limit_now() >= 0ms;
    pollfd sources[] = {{signals_in_, POLLIN, 0}, {wake_, POLLIN, 0}};
    ::poll(sources, 2, counts ? static_cast<int>(kLook.count()) : -1);
    eventfd_t woken = 0;
    ::eventfd_read(wake_, &woken);
    take_signal();
    const auto now = std::chrono::steady_clock::now();
    const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(now - last);
    if (passed < 1ms) continue;
    last = now;
    if (counts) spent_ += std::min(passed, 5 * kLook).count();
    const auto limit = limit_now();
    if (limit >= 0ms && counts && spent_ >= limit.count() && !over_) leave();
  }
}

void Ending::take_signal() noexcept {
  signalfd_siginfo info;
  if (::read(signals_in_, &info, sizeof info) != sizeof info) return;
  const std::lock_guard lock(mutex_);
  ++signals_;
  if (stop_) std::exchange(stop_, nullptr)();
}

void Ending::tell_lost() {
  if (stage_ == Stage::starting)
    return tell("was asked to end while it starts, and something holds that up", Severity::error);
  tell(stage_ == Stage::running ? "the run does not come to its end: nothing brakes its axes now"
                                : "the end is not finished in time; it ends without waiting any longer",
       Severity::error);
  // Held on to, so that what it asks is not taken apart meanwhile.
  const std::lock_guard lock(mutex_);
  if (!lost_) return;
  for (const std::string& text : lost_()) tell("warning: " + text);
}

/// Telling may block too, so somebody else does it.
void Ending::leave() noexcept {
  struct Words {
    std::mutex mutex;
    std::condition_variable said;
    bool over = false;
  };
  try {
    const auto words = std::make_shared<Words>();
    std::thread([this, words] {
      tell_lost();
      const std::lock_guard lock(words->mutex);
      words->over = true;
      words->said.notify_one();
    }).detach();
    std::unique_lock lock(words->mutex);
    words->said.wait_for(lock, kLongestWords, [&] { return words->over; });
  } catch (...) {
    // Without memory for words it ends without any.
  }
  ::_exit(stage_ == Stage::starting ? kCouldNotStart : kStoppedByFault);
}

}  // namespace lockstep::cli
