/// A page that is connected by its WebSocket.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/studio/listener.hpp"

namespace lockstep::studio_net {

/// It lives as long as something of it is under way.
class Page final : public StudioClient, public Connected, public std::enable_shared_from_this<Page> {
 public:
  Page(Listener& listener, beast::tcp_stream stream, std::string peer);
  ~Page() override;
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  /// Answers the request that asks for a WebSocket, and begins to hear.
  void accept(const Request& request);
  void close() noexcept override;

  void send_text(std::string text) override { send({std::move(text), false}); }
  void send_bytes(std::vector<std::uint8_t> bytes) override {
    send({std::string(bytes.begin(), bytes.end()), true});
  }
  bool is_idle() const noexcept override { return queue_.size() < 2; }
  bool authorise(std::string_view token) noexcept override;
  bool is_authorised() const noexcept override { return authorised_; }
  std::string_view peer() const noexcept override { return peer_; }

 private:
  struct Message {
    std::string bytes;
    bool is_binary;
  };

  template <class Call>
  void attempt(Call call) noexcept;
  void leave() noexcept;
  void read();
  void take();
  void send(Message message);
  void write();

  Listener& listener_;
  const Listener::Seat seat_;
  const std::string peer_;
  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_;
  std::deque<Message> queue_;
  std::size_t queued_ = 0;  // bytes
  bool open_ = false;
  bool authorised_;
};

}  // namespace lockstep::studio_net
