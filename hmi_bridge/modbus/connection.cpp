#include "hmi_bridge/modbus/connection.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace lockstep {
namespace {

bool is_passing(int error) noexcept {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

ModbusConnection::ModbusConnection(int socket, Clock::time_point now) noexcept
    : socket_(socket), last_progress_(now) {}

ModbusConnection::~ModbusConnection() {
  ::close(socket_);
}

short ModbusConnection::events() const noexcept {
  if (sent_ != to_send_) return POLLOUT;
  return has_ended_ || filled_ == in_.size() ? short{0} : short{POLLIN};
}

bool ModbusConnection::receive(Clock::time_point now) noexcept {
  if (has_ended_ || filled_ == in_.size()) return true;
  const ssize_t count = ::recv(socket_, in_.data() + filled_, in_.size() - filled_, 0);
  if (count < 0) return is_passing(errno);
  if (count == 0) has_ended_ = true;
  if (filled_ == 0) last_progress_ = now;
  filled_ += static_cast<std::size_t>(count);
  return true;
}

std::span<const std::uint8_t> ModbusConnection::request() const noexcept {
  if (sent_ != to_send_) return {};
  const std::size_t length = modbus_frame_length(received()).value_or(0);
  return length <= filled_ ? received().first(length) : received().first(0);
}

bool ModbusConnection::reply(std::span<const std::uint8_t> answer, Clock::time_point now) noexcept {
  const std::size_t answered = request().size();
  std::copy(in_.begin() + static_cast<std::ptrdiff_t>(answered),
            in_.begin() + static_cast<std::ptrdiff_t>(filled_), in_.begin());
  filled_ -= answered;
  last_progress_ = now;
  std::copy(answer.begin(), answer.end(), out_.begin());
  to_send_ = answer.size();
  sent_ = 0;
  return flush();
}

bool ModbusConnection::flush() noexcept {
  const ssize_t count = ::send(socket_, out_.data() + sent_, to_send_ - sent_, MSG_NOSIGNAL);
  if (count < 0) return is_passing(errno);
  sent_ += static_cast<std::size_t>(count);
  return true;
}

}  // namespace lockstep
