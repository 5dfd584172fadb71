/// A TCP client that sends what bytes it likes, for the tests of the Modbus server.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <utility>
#include <vector>

namespace lockstep {

class RawClient {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// Every wait of this client ends after a generous time; then the test fails for want of an answer.
  explicit RawClient(std::uint16_t port, int family = AF_INET) : socket_(::socket(family, SOCK_STREAM, 0)) {
    const timeval timeout{120, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
    const int at_once = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
    if (family == AF_INET6) {
      sockaddr_in6 six{};
      six.sin6_family = AF_INET6;
      six.sin6_port = htons(port);
      six.sin6_addr = in6addr_loopback;
      is_connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&six), sizeof six) == 0;
      return;
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawClient() { ::close(socket_); }
  RawClient(RawClient&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), is_connected_(other.is_connected_) {}
  RawClient& operator=(RawClient&&) = delete;

  bool is_connected() const { return is_connected_; }
  int socket() const { return socket_; }

  bool send(const Bytes& bytes) {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  void end_sending() { ::shutdown(socket_, SHUT_WR); }

  /// Exactly this many bytes; fewer if the server hangs up or keeps silent.
  Bytes receive(std::size_t count) {
    Bytes bytes(count);
    const ssize_t got = ::recv(socket_, bytes.data(), count, MSG_WAITALL);
    bytes.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    return bytes;
  }

  /// True once the server has closed the connection; what it sent before is dropped.
  bool is_hung_up_on() {
    std::uint8_t bytes[4096];
    ssize_t got = 0;
    do got = ::recv(socket_, bytes, sizeof bytes, 0);
    while (got > 0);
    return got == 0 || errno == ECONNRESET;
  }

 private:
  int socket_;
  bool is_connected_ = false;
};

}  // namespace lockstep
