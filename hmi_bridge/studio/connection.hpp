/// A connection that asks by HTTP.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hmi_bridge/studio/listener.hpp"
#include "hmi_bridge/studio/url.hpp"

namespace lockstep::studio_net {

/// One request after the other; it lives as long as something of it is under way.
class Connection final : public Connected, public std::enable_shared_from_this<Connection> {
 public:
  Connection(Listener& listener, Tcp::socket socket);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void read();
  void close() noexcept override;
  /// There are too many of them.
  void turn_away() { refuse(503, "too_many", "too many connections at once"); }

 private:
  std::string_view header(http::field name) const { return view((*head_)[name]); }
  StudioCredentials credentials(std::string_view path, std::string_view query) const;
  void take_head();
  void read_body();
  bool begin_upload(const std::string& path);
  void read_upload();
  void answer();
  bool is_heard(StudioUrl& url);
  void become_page();
  void forget_upload() noexcept;
  template <class Call>
  void attempt(Call call);
  void fail(beast::error_code error);
  void refuse_size(bool is_file);
  void refuse(unsigned status, std::string_view code, std::string_view text);
  void write(StudioAnswer answer);
  void send();
  void linger();
  void drop();

  Listener& listener_;
  const Listener::Seat seat_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> head_parser_;
  std::optional<http::request_header<>> head_;                     // of the request at hand
  bool keeps_alive_ = false;                                       // the client wants it
  std::optional<http::request_parser<http::string_body>> parser_;  // of its body, …
  std::optional<http::request_parser<http::file_body>> upload_;    // … or of one that goes into a file
  std::string upload_path_;                                        // empty: there is none
  std::optional<Response> response_;
  std::string local_, peer_;  // addresses of both ends
  std::uint16_t local_port_ = 0;
  bool closes_ = false;
  std::string dropped_;
  std::size_t dropped_bytes_ = 0;
};

}  // namespace lockstep::studio_net
