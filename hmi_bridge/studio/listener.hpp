/// What the connections of the studio's server share. It includes Boost.Beast, so it is for the server's own
/// sources.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <set>
#include <string>
#include <string_view>
#include <thread>

#include "hmi_bridge/studio/handler.hpp"
#include "hmi_bridge/studio/server_options.hpp"

namespace lockstep::studio_net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

inline constexpr std::string_view kProtocol = "lockstep.1";  // of a WebSocket

inline std::string_view view(beast::string_view text) noexcept {
  return {text.data(), text.size()};
}
inline beast::string_view beast_view(std::string_view text) noexcept {
  return {text.data(), text.size()};
}

/// Somebody who is connected, by HTTP or as a page.
class Connected {
 public:
  virtual void close() noexcept = 0;

 protected:
  ~Connected() = default;
};

/// Listens, and knows who is connected. Thread: the server's, but for `start`, `stop`, `endpoint` and
/// reading the counters.
class Listener {
 public:
  /// One of the connections that are counted, held as long as it has a socket.
  class Seat {
   public:
    explicit Seat(Listener& listener) noexcept : listener_(listener) { ++listener_.seats_; }
    ~Seat() { --listener_.seats_; }
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

   private:
    Listener& listener_;
  };

  /// Takes a connection that has come; whether there is a seat for it says `has_seat`.
  using Welcome = void (*)(Listener&, Tcp::socket);

  Listener(StudioServerOptions options, StudioHandler& handler, Welcome welcome);

  std::string start();
  void stop();
  Endpoint endpoint() const { return {options_.listen.host, port_}; }

  const StudioServerOptions& options() const noexcept { return options_; }
  const StudioGuard& guard() const noexcept { return guard_; }
  StudioHandler& handler() noexcept { return handler_; }
  StudioCounters& counters() noexcept { return counters_; }

  void enter(Connected& connection) { connections_.insert(&connection); }
  void leave(Connected& connection) noexcept { connections_.erase(&connection); }
  void enter_page(Connected& page);
  /// @return false: it had left before
  bool leave_page(Connected& page) noexcept;
  bool has_space_for_page() const noexcept { return pages_.size() < StudioLimits::kPages; }
  bool has_seat() const noexcept { return seats_ <= StudioLimits::kConnections; }
  /// Whether one more request that changes something is heard in this second.
  bool take_change();

 private:
  bool is_allowed(const Tcp::socket& socket) const;
  void accept();
  void look();
  void run() noexcept;
  template <class Call>
  void guarded(Call call) noexcept {
    try {
      call();
    } catch (...) {
      ++counters_.faults;
    }
  }

  const StudioServerOptions options_;
  const StudioGuard guard_;
  StudioHandler& handler_;
  const Welcome welcome_;
  StudioCounters counters_;
  std::uint16_t port_ = 0;
  std::size_t seats_ = 0;
  std::set<Connected*> pages_;
  std::set<Connected*> connections_;  // those that ask by HTTP
  asio::io_context context_{1};       // whose end ends connections, which know of what is above
  Tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_};
  std::chrono::steady_clock::time_point second_;
  int changes_ = 0;  // in that second
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace lockstep::studio_net
