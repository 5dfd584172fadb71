#include "cli/run/service_manager.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <system_error>

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;

/// The number in a variable of the environment; 0: none.
std::int64_t number_in(const char* variable) noexcept {
  const char* const text = std::getenv(variable);
  if (text == nullptr) return 0;
  const std::string_view digits = text;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc{} && end == digits.data() + digits.size() && number > 0 ? number : 0;
}

/// How often the watchdog wants to be told; 0: never, or it is another process that it watches.
std::chrono::microseconds watchdog_time() noexcept {
  const std::int64_t watched = number_in("WATCHDOG_PID");
  if (watched != 0 && watched != ::getpid()) return 0us;
  return std::chrono::microseconds(number_in("WATCHDOG_USEC"));
}

/// The length of the address; 0: the name is none of a socket here.
socklen_t set_address(sockaddr_un& address, std::string_view name) noexcept {
  const bool is_abstract = name.starts_with('@');
  if (name.size() < 2 || name.size() >= sizeof address.sun_path || (!is_abstract && name[0] != '/')) return 0;
  address.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), address.sun_path);
  if (is_abstract) address.sun_path[0] = '\0';
  // The zero at the end belongs to a path; in an abstract address it would be one more character.
  return static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size() + (is_abstract ? 0 : 1));
}

}  // namespace

ServiceManager::ServiceManager(std::int64_t servo_cycle)
    : timeout_(2 * servo_cycle), advanced_(std::chrono::steady_clock::now()) {
  const char* const name = std::getenv("NOTIFY_SOCKET");
  size_ = name == nullptr ? 0 : set_address(address_, name);
  if (size_ == 0) return;
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket_ < 0)
    throw std::system_error(errno, std::generic_category(), "systemd cannot be told how the run goes");
  // Four times as often, so that a late look or a message that is not taken at once is no fault.
  period_ = watchdog_time() / 4;
}

ServiceManager::~ServiceManager() {
  if (socket_ >= 0) ::close(socket_);
}

std::chrono::milliseconds ServiceManager::interval(std::chrono::milliseconds usual) const noexcept {
  if (period_ == 0us) return usual;
  return std::clamp(std::chrono::duration_cast<std::chrono::milliseconds>(period_), 1ms, usual);
}

bool ServiceManager::send(std::string_view message) const noexcept {
  return ::sendto(socket_, message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&address_), size_) >= 0;
}

void ServiceManager::look(std::uint64_t ticks) noexcept {
  if (socket_ < 0) return;
  const Time now = std::chrono::steady_clock::now();
  if (ticks != ticks_) {
    ticks_ = ticks;
    advanced_ = now;
    advances_ = true;
  }
  if (!ready_ && ticks > 0) ready_ = send("READY=1");
  if (period_ == 0us || !ready_ || now - sent_ < period_) return;
  // With a slow clock there may be no new tick between two messages.
  if (!advances_ && now - advanced_ > timeout_) return;
  if (!send("WATCHDOG=1")) return;
  sent_ = now;
  advances_ = false;
}

void ServiceManager::stopping() noexcept {
  if (socket_ < 0 || stopping_) return;
  stopping_ = send("STOPPING=1");
}

}  // namespace lockstep::cli
