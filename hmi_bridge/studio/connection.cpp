#include "hmi_bridge/studio/connection.hpp"

#include <utility>

#include "hmi_bridge/studio/assets.hpp"
#include "hmi_bridge/studio/page.hpp"
#include "hmi_bridge/studio/url.hpp"

namespace lockstep::studio_net {
namespace {

constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

std::string refusal_body(std::string_view code, std::string_view text) {
  return "{\"error\":{\"code\":\"" + std::string(code) + "\",\"message\":\"" + std::string(text) + "\"}}\n";
}

std::string address_text(const asio::ip::address& address) {
  return address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
}

/// What a browser has to hold to, whatever the answer is.
void set_policy(Response& response) {
  response.set(http::field::server, "lockstep");
  response.set("Content-Security-Policy", beast_view(kPolicy));
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
}

}  // namespace

Connection::Connection(Listener& listener, Tcp::socket socket)
    : listener_(listener), seat_(listener), stream_(std::move(socket)) {
  listener_.enter(*this);
  beast::error_code ignored;
  stream_.socket().set_option(Tcp::no_delay(true), ignored);
  const auto local = stream_.socket().local_endpoint(ignored);
  local_ = address_text(local.address());
  local_port_ = local.port();
  const auto peer = stream_.socket().remote_endpoint(ignored);
  peer_ = address_text(peer.address()) + ":" + std::to_string(peer.port());
}

Connection::~Connection() {
  listener_.leave(*this);
}

void Connection::read() {
  parser_.emplace();
  parser_->header_limit(StudioServer::kHeaderBytes);
  parser_->body_limit(StudioServer::kBodyBytes);
  stream_.expires_after(listener_.options().request_time);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](beast::error_code error, std::size_t) {
                     if (error) return self->fail(error);
                     self->stream_.expires_never();
                     try {
                       self->answer();
                     } catch (...) {
                       ++self->listener_.counters().faults;
                       self->refuse(500, "bad_request", "an internal fault, which was survived");
                     }
                   });
}

void Connection::close() noexcept {
  beast::error_code ignored;
  stream_.socket().close(ignored);
}

void Connection::fail(beast::error_code error) {
  if (error == http::error::header_limit)
    refuse(431, "too_large", "headers may have 8 KiB");
  else if (error == http::error::body_limit)
    refuse(413, "too_large", "a body may have 16 MiB");
  else if (error.category() == http::make_error_code(http::error::end_of_stream).category() &&
           error != http::error::end_of_stream && error != http::error::partial_message)
    refuse(400, "bad_request", "this is no HTTP");
}

StudioCredentials Connection::credentials(std::string_view path, std::string_view query) const {
  const Request& request = parser_->get();
  StudioCredentials known;
  known.host = header(http::field::host);
  known.origin = header(http::field::origin);
  known.content_type = header(http::field::content_type);
  known.authorization = header(http::field::authorization);
  known.query = query;
  known.local_address = local_;
  known.local_port = local_port_;
  known.is_socket = path == "/ws";
  known.changes =
      known.is_socket || (request.method() != http::verb::get && request.method() != http::verb::head);
  known.is_public = !known.changes && is_studio_asset(path);
  return known;
}

void Connection::answer() {
  Request& request = parser_->get();
  const std::string_view target = view(request.target());
  StudioUrl url;
  if (!parse_url(target, url))
    return refuse(400, "bad_request", "the address is not written as it has to be");
  const StudioCredentials known = credentials(url.path, query_of(target));
  // The count of a header says more than its value, of which only the first is looked at.
  if (request.count(http::field::host) != 1 || request.count(http::field::origin) > 1)
    return refuse(400, "bad_request", "the header Host has to be there once, Origin at most once");
  if (const StudioRefusal refusal = listener_.guard().judge(known); refusal.status != 0)
    return refuse(refusal.status, refusal.code, refusal.text);
  if (known.is_socket) return become_page();
  if (known.changes && !listener_.take_change())
    return refuse(429, "too_many", "50 changing requests a second are heard");
  if (known.is_public) return write(studio_asset(url.path));
  ++listener_.counters().requests;
  const StudioRequest asked{view(request.method_string()), std::move(url.path), std::move(url.query),
                            request.body(), peer_};
  listener_.handler().answer(
      asked, [self = shared_from_this()](StudioAnswer answer) { self->write(std::move(answer)); });
}

void Connection::become_page() {
  const Request& request = parser_->get();
  if (!websocket::is_upgrade(request) ||
      header(http::field::sec_websocket_protocol).find(kProtocol) == std::string_view::npos)
    return refuse(400, "bad_request", "/ws is a WebSocket of the subprotocol lockstep.1");
  if (!listener_.has_space_for_page()) return refuse(503, "too_many", "eight pages are open already");
  std::make_shared<Page>(listener_, std::move(stream_))->accept(request);
}

void Connection::refuse(unsigned status, std::string_view code, std::string_view text) {
  ++listener_.counters().refused;
  StudioAnswer answer;
  answer.status = status;
  answer.body = refusal_body(code, text);
  closes_ = status != 401 && status != 403 && status != 429;
  write(std::move(answer));
}

void Connection::write(StudioAnswer answer) {
  response_.emplace(static_cast<http::status>(answer.status), 11);
  Response& response = *response_;
  const bool is_known = parser_ && parser_->is_header_done();
  if (is_known && !answer.etag.empty()) {
    response.set(http::field::etag, answer.etag);
    if (header(http::field::if_none_match) == answer.etag && answer.status == 200) {
      response.result(http::status::not_modified);
      answer.body.clear();
    }
  }
  set_policy(response);
  response.set(http::field::content_type, answer.type);
  response.set(http::field::cache_control, answer.cache);
  if (!answer.file_name.empty())
    response.set(http::field::content_disposition, "attachment; filename=\"" + answer.file_name + "\"");
  if (answer.status == 429 || answer.status == 503) response.set(http::field::retry_after, "1");
  if (answer.status == 401) response.set(http::field::www_authenticate, "Bearer");
  response.keep_alive(!closes_ && is_known && parser_->get().keep_alive());
  response.body() = std::move(answer.body);
  response.prepare_payload();
  if (is_known && parser_->get().method() == http::verb::head) response.body().clear();
  send();
}

void Connection::send() {
  stream_.expires_after(listener_.options().request_time);
  http::async_write(stream_, *response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return;
    if (self->response_->keep_alive()) return self->read();
    self->linger();
  });
}

/// Ends what is sent and takes what still comes, for a moment: a connection that is closed with something
/// unread loses the answer.
void Connection::linger() {
  beast::error_code ignored;
  stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
  stream_.expires_after(std::chrono::seconds(1));
  drop();
}

void Connection::drop() {
  dropped_.resize(1 << 14);
  stream_.async_read_some(asio::buffer(dropped_),
                          [self = shared_from_this()](beast::error_code error, std::size_t size) {
                            self->dropped_bytes_ += size;
                            if (!error && self->dropped_bytes_ < StudioServer::kBodyBytes) self->drop();
                          });
}

}  // namespace lockstep::studio_net
