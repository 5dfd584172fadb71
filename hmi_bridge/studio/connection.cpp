#include "hmi_bridge/studio/connection.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <limits>
#include <utility>

#include "hmi_bridge/studio/assets.hpp"
#include "hmi_bridge/studio/page.hpp"
#include "hmi_bridge/studio/url.hpp"

namespace lockstep::studio_net {
namespace {

constexpr std::string_view kUploads = "/api/traces";  // to which files are sent

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
  forget_upload();
  listener_.leave(*this);
}

template <class Call>
void Connection::attempt(Call call) {
  try {
    call();
  } catch (...) {
    ++listener_.counters().faults;
    refuse(500, "bad_request", "an internal fault, which was survived");
  }
}

void Connection::read() {
  head_.reset();
  parser_.reset();
  upload_.reset();
  head_parser_.emplace();
  head_parser_->header_limit(StudioLimits::kHeaderBytes);
  head_parser_->body_limit(std::numeric_limits<std::uint64_t>::max());  // which depends on what it is for
  stream_.expires_after(listener_.options().request_time);
  http::async_read_header(stream_, buffer_, *head_parser_,
                          [self = shared_from_this()](beast::error_code error, std::size_t) {
                            if (error) return self->fail(error);
                            self->attempt([&] { self->take_head(); });
                          });
}

/// What the body is to become depends on what it is for.
void Connection::take_head() {
  head_ = head_parser_->get().base();
  keeps_alive_ = head_parser_->get().keep_alive();
  StudioUrl url;
  const bool is_upload = head_->method() == http::verb::post && view(head_->target()).starts_with(kUploads) &&
                         is_studio_upload(header(http::field::content_type));
  if (!is_upload) return read_body();
  // Nobody fills a disk who may not ask.
  if (!is_heard(url)) return;
  if (head_parser_->content_length().value_or(0) > StudioLimits::kUploadBytes) return refuse_size(true);
  if (!listener_.handler().takes_uploads())
    return refuse(403, "not_allowed", "files are taken at the desk alone, with lockstep studio");
  if (!begin_upload(listener_.options().upload_folder))
    return refuse(503, "busy", "no file can be made for what is sent");
  read_upload();
}

void Connection::read_body() {
  // A parser looks at the length while it reads the head alone.
  if (head_parser_->content_length().value_or(0) > StudioLimits::kBodyBytes) return refuse_size(false);
  parser_.emplace(std::move(*head_parser_));
  parser_->body_limit(StudioLimits::kBodyBytes);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](beast::error_code error, std::size_t) {
                     if (error) return self->fail(error);
                     self->stream_.expires_never();
                     self->attempt([&] { self->answer(); });
                   });
}

bool Connection::begin_upload(const std::string& folder) {
  std::string name = folder + "/lockstep-studio-XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) return false;
  ::close(file);
  upload_path_ = name;
  upload_.emplace(std::move(*head_parser_));
  upload_->body_limit(StudioLimits::kUploadBytes);
  beast::error_code error;
  upload_->get().body().open(name.c_str(), beast::file_mode::write, error);
  return !error;
}

/// Piece by piece: it may take long, but not stand still.
void Connection::read_upload() {
  if (upload_->is_done()) {  // a body without a byte is there with its head
    upload_->get().body().close();
    stream_.expires_never();
    return attempt([&] { answer(); });
  }
  stream_.expires_after(listener_.options().request_time);
  http::async_read_some(stream_, buffer_, *upload_,
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          if (error) return self->fail(error);
                          self->read_upload();
                        });
}

void Connection::close() noexcept {
  beast::error_code ignored;
  stream_.socket().close(ignored);
}

void Connection::fail(beast::error_code error) {
  forget_upload();
  if (error == http::error::header_limit)
    refuse(431, "too_large", "headers may have 8 KiB");
  else if (error == http::error::body_limit)
    refuse_size(upload_.has_value());
  else if (error.category() == http::make_error_code(http::error::end_of_stream).category() &&
           error != http::error::end_of_stream && error != http::error::partial_message)
    refuse(400, "bad_request", "this is no HTTP");
}

void Connection::refuse_size(bool is_file) {
  refuse(413, "too_large", is_file ? "a file may have 2 GiB" : "a body may have 16 MiB");
}

StudioCredentials Connection::credentials(std::string_view path, std::string_view query) const {
  StudioCredentials known;
  known.host = header(http::field::host);
  known.origin = header(http::field::origin);
  known.content_type = header(http::field::content_type);
  known.authorization = header(http::field::authorization);
  known.query = query;
  known.local_address = local_;
  known.local_port = local_port_;
  known.is_socket = path == "/ws";
  known.takes_files = head_->method() == http::verb::post && path == kUploads;
  known.changes =
      known.is_socket || (head_->method() != http::verb::get && head_->method() != http::verb::head);
  known.is_public = !known.changes && is_studio_asset(path);
  return known;
}

/// Whether the request is to be looked at; if not, it has been refused.
bool Connection::is_heard(StudioUrl& url) {
  const std::string_view target = view(head_->target());
  const auto refused = [this](unsigned status, std::string_view code, std::string_view text) {
    refuse(status, code, text);
    return false;
  };
  if (!parse_url(target, url))
    return refused(400, "bad_request", "the address is not written as it has to be");
  const StudioCredentials known = credentials(url.path, query_of(target));
  // The count of a header says more than its value, of which only the first is looked at.
  if (head_->count(http::field::host) != 1 || head_->count(http::field::origin) > 1)
    return refused(400, "bad_request", "the header Host has to be there once, Origin at most once");
  if (const StudioRefusal refusal = listener_.guard().judge(known); refusal.status != 0)
    return refused(refusal.status, refusal.code, refusal.text);
  // A reading has its paths in its body, and changes nothing.
  if (!known.changes || known.is_socket || url.path == "/api/read") return true;
  if (listener_.take_change()) return true;
  return refused(429, "too_many", "50 changing requests a second are heard");
}

void Connection::answer() {
  StudioUrl url;
  // One that goes into a file has been heard before.
  if (upload_path_.empty() ? !is_heard(url) : !parse_url(view(head_->target()), url)) return;
  if (url.path == "/ws") return become_page();
  const bool only_looks = head_->method() == http::verb::get || head_->method() == http::verb::head;
  if (only_looks && is_studio_asset(url.path)) return write(studio_asset(url.path));
  ++listener_.counters().requests;
  StudioRequest asked;
  asked.method = view(head_->method_string());
  asked.path = std::move(url.path);
  asked.query = std::move(url.query);
  asked.peer = peer_;
  asked.if_match = header(http::field::if_match);
  asked.if_none_match = header(http::field::if_none_match);
  if (parser_) asked.body = parser_->get().body();
  asked.body_file = std::exchange(upload_path_, "");
  listener_.handler().answer(
      asked, [self = shared_from_this()](StudioAnswer answer) { self->write(std::move(answer)); });
}

void Connection::forget_upload() noexcept {
  if (!upload_path_.empty()) ::unlink(upload_path_.c_str());
  upload_path_.clear();
}

void Connection::become_page() {
  const Request& request = parser_->get();
  if (!websocket::is_upgrade(request) ||
      header(http::field::sec_websocket_protocol).find(kProtocol) == std::string_view::npos)
    return refuse(400, "bad_request", "/ws is a WebSocket of the subprotocol lockstep.1");
  if (!listener_.has_space_for_page()) return refuse(503, "too_many", "eight pages are open already");
  std::make_shared<Page>(listener_, std::move(stream_), peer_)->accept(request);
}

void Connection::refuse(unsigned status, std::string_view code, std::string_view text) {
  forget_upload();
  ++listener_.counters().refused;
  StudioAnswer answer;
  answer.status = status;
  answer.body = refusal_body(code, text);
  // What is left of a body would be taken for the next request.
  closes_ = !parser_ || (status != 401 && status != 403 && status != 429);
  write(std::move(answer));
}

void Connection::write(StudioAnswer answer) {
  response_.emplace(static_cast<http::status>(answer.status), 11);
  Response& response = *response_;
  const bool is_known = head_.has_value();
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
  response.keep_alive(!closes_ && is_known && keeps_alive_);
  response.body() = std::move(answer.body);
  response.prepare_payload();
  if (is_known && head_->method() == http::verb::head) response.body().clear();
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
                            if (!error && self->dropped_bytes_ < StudioLimits::kBodyBytes) self->drop();
                          });
}

}  // namespace lockstep::studio_net
