#include "hmi_bridge/studio/listener.hpp"

#include <pthread.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cstring>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep::studio_net {

Listener::Listener(StudioServerOptions options, StudioHandler& handler, Welcome welcome)
    : options_(std::move(options)),
      guard_(options_.names, options_.token),
      handler_(handler),
      welcome_(welcome) {}

void Listener::enter_page(Connected& page) {
  pages_.insert(&page);
  counters_.pages = pages_.size();
}

bool Listener::leave_page(Connected& page) noexcept {
  if (pages_.erase(&page) == 0) return false;
  counters_.pages = pages_.size();
  return true;
}

std::string Listener::start() {
  beast::error_code error;
  const std::string host = options_.listen.host == "localhost" ? "127.0.0.1" : options_.listen.host;
  const asio::ip::address address = asio::ip::make_address(host, error);
  if (error) return options_.listen.host + ": has to be an address, or localhost";
  const Tcp::endpoint endpoint(address, options_.listen.port);
  const auto failed = [&] { return to_string(options_.listen) + ": " + error.message(); };
  acceptor_.open(endpoint.protocol(), error);
  if (error) return failed();
  acceptor_.set_option(asio::socket_base::reuse_address(true), error);
  acceptor_.bind(endpoint, error);
  if (error) return failed();
  acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) return failed();
  port_ = acceptor_.local_endpoint(error).port();
  accept();
  look();
  thread_ = std::thread([this] { run(); });
  return "";
}

void Listener::stop() {
  if (!thread_.joinable()) return;
  asio::post(context_, [this] {
    stopping_ = true;
    beast::error_code ignored;
    acceptor_.close(ignored);
    timer_.cancel();
    context_.stop();
  });
  thread_.join();
}

void Listener::accept() {
  acceptor_.async_accept([this](beast::error_code error, Tcp::socket socket) {
    if (stopping_ || error == asio::error::operation_aborted) return;
    if (!error && !is_allowed(socket)) {
      ++counters_.refused;  // it learns nothing
    } else if (!error) {
      guarded([&] { welcome_(*this, std::move(socket)); });
    }
    accept();
  });
}

bool Listener::is_allowed(const Tcp::socket& socket) const {
  if (options_.allow.empty()) return true;
  beast::error_code error;
  const Tcp::endpoint peer = socket.remote_endpoint(error);
  if (error) return false;
  sockaddr_storage address{};
  std::memcpy(&address, peer.data(), std::min(peer.size(), sizeof address));
  return std::ranges::any_of(options_.allow, [&](const IpNetwork& one) { return one.contains(address); });
}

void Listener::look() {
  timer_.expires_after(StudioLimits::kLook);
  timer_.async_wait([this](beast::error_code error) {
    if (error || stopping_) return;
    guarded([this] { handler_.look(); });
    look();
  });
}

bool Listener::take_change() {
  const auto now = std::chrono::steady_clock::now();
  if (now - second_ >= std::chrono::seconds(1)) {
    second_ = now;
    changes_ = 0;
  }
  return ++changes_ <= StudioLimits::kChangesPerSecond;
}

void Listener::run() noexcept {
  block_write_signals();
  ::pthread_setname_np(::pthread_self(), "studio");  // for top and strace
  while (!stopping_) {
    try {
      context_.run();
      break;
    } catch (...) {
      ++counters_.faults;
    }
  }
  handler_.ended();
  for (Connected* page : pages_) page->close();
  for (Connected* connection : connections_) connection->close();
}

}  // namespace lockstep::studio_net
