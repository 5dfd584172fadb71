/// A reverse proxy for one studio, below a path of its own: what the example for nginx in STUDIO.md does,
/// without TLS.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace lockstep::test {

/// Each connection carries one request, or a WebSocket.
class Proxy {
 public:
  /// @param path such as "/lockstep", taken off before the request is handed on
  Proxy(std::uint16_t studio, std::string path) : studio_(studio), path_(std::move(path)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof address;
    if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listener_, 64) != 0 ||
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      throw std::runtime_error("no proxy");
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { accept(); });
  }
  ~Proxy() {
    stop_ = true;
    thread_.join();
    for (std::thread& one : connections_) one.join();
    ::close(listener_);
  }
  Proxy(const Proxy&) = delete;
  Proxy& operator=(const Proxy&) = delete;

  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  static constexpr int kLook = 50;  // [ms]

  static sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }

  void accept() {
    while (!stop_) {
      pollfd waiting{listener_, POLLIN, 0};
      if (::poll(&waiting, 1, kLook) <= 0) continue;
      const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      if (client >= 0) connections_.emplace_back([this, client] { serve(client); });
    }
  }

  /// The head of a request as it is handed on; empty: it is for somebody else.
  std::string changed(std::string head) const {
    const std::size_t at = head.find(' ') + 1;
    if (head.compare(at, path_.size() + 1, path_ + "/") != 0) return "";
    head.erase(at, path_.size());
    const std::size_t kept = head.find("Connection: keep-alive");
    if (kept != std::string::npos)
      head.replace(kept, std::string_view("Connection: keep-alive").size(), "Connection: close");
    return head;
  }

  void serve(int client) {
    std::string head;
    char bytes[1 << 14];
    std::size_t end = std::string::npos;
    while (!stop_ && (end = head.find("\r\n\r\n")) == std::string::npos) {
      pollfd waiting{client, POLLIN, 0};
      if (::poll(&waiting, 1, kLook) <= 0) continue;
      const ssize_t got = ::recv(client, bytes, sizeof bytes, 0);
      if (got <= 0) break;
      head.append(bytes, static_cast<std::size_t>(got));
    }
    const std::string request = end == std::string::npos ? "" : changed(std::move(head));
    const int studio = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(studio_);
    if (!request.empty() &&
        ::connect(studio, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
      ::send(studio, request.data(), request.size(), MSG_NOSIGNAL);
      hand_on(client, studio);
    }
    ::close(studio);
    ::close(client);
  }

  void hand_on(int client, int studio) const {
    char bytes[1 << 16];
    const auto pass = [&bytes](int from, int to) {
      const ssize_t got = ::recv(from, bytes, sizeof bytes, 0);
      for (ssize_t sent = 0; sent < got;) {
        const ssize_t part = ::send(to, bytes + sent, static_cast<std::size_t>(got - sent), MSG_NOSIGNAL);
        if (part <= 0) return false;
        sent += part;
      }
      return got > 0;
    };
    while (!stop_) {
      pollfd waiting[2] = {{client, POLLIN, 0}, {studio, POLLIN, 0}};
      if (::poll(waiting, 2, kLook) <= 0) continue;
      if (waiting[0].revents != 0 && !pass(client, studio)) return;
      if (waiting[1].revents != 0 && !pass(studio, client)) return;
    }
  }

  const std::uint16_t studio_;
  const std::string path_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<bool> stop_{false};
  std::list<std::thread> connections_;
  std::thread thread_;
};

}  // namespace lockstep::test
