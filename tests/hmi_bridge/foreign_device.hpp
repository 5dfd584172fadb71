/// A Modbus device on TCP that answers what a test tells it to.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace lockstep {

/// A place at which one may connect; nobody answers unless somebody accepts.
class ListeningSocket {
 public:
  ListeningSocket() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&place), size), 0);
    EXPECT_EQ(::listen(socket_, 5), 0);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&place), &size);
    port_ = ntohs(place.sin_port);
  }
  ~ListeningSocket() { ::close(socket_); }
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  std::uint16_t port() const { return port_; }
  /// The next connection, which is the caller's to close; negative once `end` was called.
  int accept() const { return ::accept(socket_, nullptr, nullptr); }
  void end() const { ::shutdown(socket_, SHUT_RDWR); }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

/// Serves one connection after the other. Ends with the object, once its client has hung up.
class ForeignDevice {
 public:
  using Bytes = std::vector<std::uint8_t>;
  /// Makes the answer to a request, both whole frames with their headers. Called on the device's thread.
  using Answer = std::function<Bytes(const Bytes&)>;

  explicit ForeignDevice(Answer answer) : answer_(std::move(answer)), thread_([this] { run(); }) {}
  ~ForeignDevice() {
    place_.end();
    thread_.join();
  }

  std::uint16_t port() const { return place_.port(); }

  /// What a good device says: registers show their address, of bits each first of eight is set, what is
  /// written is taken.
  static Bytes good_answer(const Bytes& request) {
    Bytes answer(request.begin(), request.begin() + 8);
    const std::size_t address = std::size_t{request[8]} << 8 | request[9];
    const std::size_t count = std::size_t{request[10]} << 8 | request[11];
    if (request[7] <= 2) {
      answer.push_back(static_cast<std::uint8_t>((count + 7) / 8));
      answer.resize(answer.size() + (count + 7) / 8, 1);
    } else if (request[7] <= 4) {
      answer.push_back(static_cast<std::uint8_t>(2 * count));
      for (std::size_t i = address; i < address + count; ++i) {
        answer.push_back(static_cast<std::uint8_t>(i >> 8));
        answer.push_back(static_cast<std::uint8_t>(i));
      }
    } else {
      answer.insert(answer.end(), request.begin() + 8, request.begin() + (request[7] == 22 ? 14 : 12));
    }
    answer[5] = static_cast<std::uint8_t>(answer.size() - 6);
    return answer;
  }

 private:
  void run() {
    for (int client = 0; (client = place_.accept()) >= 0; ::close(client)) serve(client);
  }
  void serve(int client) const {
    for (;;) {
      Bytes request(6);
      if (::recv(client, request.data(), 6, MSG_WAITALL) != 6) return;
      const std::size_t rest = request[5];
      request.resize(6 + rest);
      if (::recv(client, request.data() + 6, rest, MSG_WAITALL) != static_cast<ssize_t>(rest)) return;
      const Bytes answer = answer_(request);
      if (::send(client, answer.data(), answer.size(), MSG_NOSIGNAL) < 0) return;
    }
  }

  const ListeningSocket place_;
  const Answer answer_;
  std::thread thread_;
};

}  // namespace lockstep
