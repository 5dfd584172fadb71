// The one source that includes Boost.Beast: everything runs on one thread, without a lock.
#include "hmi_bridge/studio/server.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <optional>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

constexpr std::string_view kProtocol = "lockstep.1";
constexpr std::size_t kQueuedBytes = std::size_t{16} << 20;  // of a page that takes nothing
constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

std::string_view view(beast::string_view text) noexcept {
  return {text.data(), text.size()};
}

/// Without percent signs; false: they are not what they should be, or hide a character of control.
bool decode_url(std::string_view text, bool plus_is_blank, std::string& decoded) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  decoded.clear();
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '+' && plus_is_blank) c = ' ';
    if (c == '%') {
      const int high = i + 2 < text.size() ? digit(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? digit(text[i + 2]) : -1;
      if (high < 0 || low < 0) return false;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    }
    if (static_cast<unsigned char>(c) < 0x20) return false;
    decoded += c;
  }
  return true;
}

bool decode_query(std::string_view text, std::vector<std::pair<std::string, std::string>>& query) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('&'), text.size());
    const std::string_view part = text.substr(0, end);
    const std::size_t equals = std::min(part.find('='), part.size());
    std::string name;
    std::string value;
    if (!decode_url(part.substr(0, equals), true, name)) return false;
    if (!decode_url(part.substr(std::min(equals + 1, part.size())), true, value)) return false;
    query.emplace_back(std::move(name), std::move(value));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return true;
}

std::string refusal_body(std::string_view code, std::string_view text) {
  return "{\"error\":{\"code\":\"" + std::string(code) + "\",\"message\":\"" + std::string(text) + "\"}}\n";
}

std::string address_text(const asio::ip::address& address) {
  return address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
}

bool is_public(std::string_view path) noexcept {
  return path == "/" || path.starts_with("/assets/");
}

}  // namespace

class StudioServer::Core {
 public:
  Core(StudioServerOptions options, StudioHandler& handler)
      : options_(std::move(options)), guard_(options_.names, options_.token), handler_(handler) {}

  std::string start();
  void stop();
  Endpoint endpoint() const { return {options_.listen.host, port_}; }
  const StudioCounters& counters() const noexcept { return counters_; }

 private:
  class Connection;
  class Page;

  void accept();
  void look();
  void run() noexcept;
  bool take_change();
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
  StudioCounters counters_;
  std::uint16_t port_ = 0;
  std::size_t connections_ = 0;
  std::set<Page*> pages_;
  std::set<Connection*> asking_;
  asio::io_context context_{1};  // whose end ends connections, which know of what is above
  Tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_};
  std::chrono::steady_clock::time_point second_;
  int changes_ = 0;  // in that second
  bool stopping_ = false;
  std::thread thread_;
};

/// One page. It lives as long as something of it is under way.
class StudioServer::Core::Page final : public StudioClient, public std::enable_shared_from_this<Page> {
 public:
  Page(Core& core, beast::tcp_stream stream) : core_(core), stream_(std::move(stream)) {
    ++core_.connections_;
    core_.pages_.insert(this);
    core_.counters_.pages = core_.pages_.size();
    authorised_ = !core_.guard_.needs_token();
  }
  ~Page() override {
    leave();
    --core_.connections_;
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  void accept(const Request& request) {
    beast::get_lowest_layer(stream_).expires_never();
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = core_.options_.request_time;
    timeout.idle_timeout = std::chrono::seconds(60);  // asked half-way whether it is there
    timeout.keep_alive_pings = true;
    stream_.set_option(timeout);
    stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol,
                   beast::string_view(kProtocol.data(), kProtocol.size()));
      response.set(http::field::server, "lockstep");
    }));
    stream_.read_message_max(kMessageBytes);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->open_ = true;
      self->attempt([&] { self->core_.handler_.opened(*self); });
      self->read();
    });
  }

  void send_text(std::string text) override { send({std::move(text), false}); }
  void send_bytes(std::vector<std::uint8_t> bytes) override {
    send({std::string(bytes.begin(), bytes.end()), true});
  }
  bool is_idle() const noexcept override { return queue_.size() < 2; }
  bool authorise(std::string_view token) noexcept override {
    authorised_ = authorised_ || core_.guard_.is_token(token);
    return authorised_;
  }
  bool is_authorised() const noexcept override { return authorised_; }

  void close() noexcept {
    beast::error_code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

 private:
  struct Message {
    std::string bytes;
    bool is_binary;
  };

  template <class Call>
  void attempt(Call call) noexcept {
    try {
      call();
    } catch (...) {
      ++core_.counters_.faults;
      close();
    }
  }

  void leave() noexcept {
    if (core_.pages_.erase(this) == 0) return;
    core_.counters_.pages = core_.pages_.size();
    if (open_) core_.handler_.closed(*this);
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->leave();
      self->attempt([&] {
        if (!self->stream_.got_text()) throw std::runtime_error("a page sends text");
        const std::string message = beast::buffers_to_string(self->buffer_.data());
        self->buffer_.consume(self->buffer_.size());
        self->core_.handler_.text(*self, message);
      });
      self->read();
    });
  }

  void send(Message message) {
    queued_ += message.bytes.size();
    if (queued_ > kQueuedBytes) return close();
    queue_.push_back(std::move(message));
    if (queue_.size() == 1) write();
  }

  void write() {
    stream_.binary(queue_.front().is_binary);
    stream_.async_write(asio::buffer(queue_.front().bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          if (error) return self->leave();
                          self->queued_ -= self->queue_.front().bytes.size();
                          self->queue_.pop_front();
                          if (!self->queue_.empty()) self->write();
                        });
  }

  Core& core_;
  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_;
  std::deque<Message> queue_;
  std::size_t queued_ = 0;
  bool open_ = false;
  bool authorised_ = false;
};

/// A connection that asks by HTTP, one request after the other.
class StudioServer::Core::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Core& core, Tcp::socket socket) : core_(core), stream_(std::move(socket)) {
    ++core_.connections_;
    core_.asking_.insert(this);
    beast::error_code ignored;
    stream_.socket().set_option(Tcp::no_delay(true), ignored);
    const auto local = stream_.socket().local_endpoint(ignored);
    local_ = address_text(local.address());
    local_port_ = local.port();
    const auto peer = stream_.socket().remote_endpoint(ignored);
    peer_ = address_text(peer.address()) + ":" + std::to_string(peer.port());
  }
  ~Connection() {
    core_.asking_.erase(this);
    --core_.connections_;
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(kHeaderBytes);
    parser_->body_limit(kBodyBytes);
    stream_.expires_after(core_.options_.request_time);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (error) return self->fail(error);
                       self->stream_.expires_never();
                       try {
                         self->answer();
                       } catch (...) {
                         ++self->core_.counters_.faults;
                         self->refuse(500, "bad_request", "an internal fault, which was survived");
                       }
                     });
  }
  void close() noexcept {
    beast::error_code ignored;
    stream_.socket().close(ignored);
  }
  /// There are too many of them.
  void turn_away() { refuse(503, "too_many", "too many connections at once"); }

 private:
  void fail(beast::error_code error) {
    if (error == http::error::header_limit)
      refuse(431, "too_large", "headers may have 8 KiB");
    else if (error == http::error::body_limit)
      refuse(413, "too_large", "a body may have 16 MiB");
    else if (error.category() == http::make_error_code(http::error::end_of_stream).category() &&
             error != http::error::end_of_stream && error != http::error::partial_message)
      refuse(400, "bad_request", "this is no HTTP");
  }

  std::string_view header(http::field name) const { return view(parser_->get()[name]); }

  StudioCredentials credentials(std::string_view path, std::string_view query) const {
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
    known.is_public = is_public(path);
    return known;
  }

  void answer() {
    Request& request = parser_->get();
    const std::string_view target = view(request.target());
    const std::size_t mark = std::min(target.find('?'), target.size());
    const std::string_view query = target.substr(std::min(mark + 1, target.size()));
    StudioRequest asked;
    asked.method = view(request.method_string());
    asked.peer = peer_;
    asked.body = request.body();
    if (!decode_url(target.substr(0, mark), false, asked.path) || !decode_query(query, asked.query))
      return refuse(400, "bad_request", "the address is not written as it has to be");
    const StudioCredentials known = credentials(asked.path, query);
    // The count of a header says more than its value, of which only the first is looked at.
    if (request.count(http::field::host) != 1 || request.count(http::field::origin) > 1)
      return refuse(400, "bad_request", "the header Host has to be there once, Origin at most once");
    if (const StudioRefusal refusal = core_.guard_.judge(known); refusal.status != 0)
      return refuse(refusal.status, refusal.code, refusal.text);
    if (known.is_socket) return become_page();
    if (known.changes && !core_.take_change())
      return refuse(429, "too_many", "50 changing requests a second are heard");
    ++core_.counters_.requests;
    core_.handler_.answer(
        asked, [self = shared_from_this()](StudioAnswer answer) { self->write(std::move(answer)); });
  }

  void become_page() {
    const Request& request = parser_->get();
    if (!websocket::is_upgrade(request) ||
        header(http::field::sec_websocket_protocol).find(kProtocol) == std::string_view::npos)
      return refuse(400, "bad_request", "/ws is a WebSocket of the subprotocol lockstep.1");
    if (core_.pages_.size() >= kPages) return refuse(503, "too_many", "eight pages are open already");
    std::make_shared<Page>(core_, std::move(stream_))->accept(request);
  }

  void refuse(unsigned status, std::string_view code, std::string_view text) {
    ++core_.counters_.refused;
    StudioAnswer answer;
    answer.status = status;
    answer.body = refusal_body(code, text);
    closes_ = status != 401 && status != 403 && status != 429;
    write(std::move(answer));
  }

  void write(StudioAnswer answer) {
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
    response.set(http::field::server, "lockstep");
    response.set(http::field::content_type, answer.type);
    response.set(http::field::cache_control, answer.cache);
    response.set("Content-Security-Policy", beast::string_view(kPolicy.data(), kPolicy.size()));
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    if (answer.status == 429 || answer.status == 503) response.set(http::field::retry_after, "1");
    if (answer.status == 401) response.set(http::field::www_authenticate, "Bearer");
    response.keep_alive(!closes_ && is_known && parser_->get().keep_alive());
    response.body() = std::move(answer.body);
    response.prepare_payload();
    if (is_known && parser_->get().method() == http::verb::head) response.body().clear();
    stream_.expires_after(core_.options_.request_time);
    http::async_write(stream_, response, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return;
      if (self->response_->keep_alive()) return self->read();
      self->linger();
    });
  }

  /// Ends what is sent and takes what still comes, for a moment: a connection that is closed with something
  /// unread loses the answer.
  void linger() {
    beast::error_code ignored;
    stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
    stream_.expires_after(std::chrono::seconds(1));
    drop();
  }
  void drop() {
    dropped_.resize(1 << 14);
    stream_.async_read_some(asio::buffer(dropped_),
                            [self = shared_from_this()](beast::error_code error, std::size_t size) {
                              self->dropped_bytes_ += size;
                              if (!error && self->dropped_bytes_ < kBodyBytes) self->drop();
                            });
  }

  Core& core_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<Response> response_;
  std::string local_, peer_;
  std::string dropped_;
  std::size_t dropped_bytes_ = 0;
  std::uint16_t local_port_ = 0;
  bool closes_ = false;
};

std::string StudioServer::Core::start() {
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

void StudioServer::Core::stop() {
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

void StudioServer::Core::accept() {
  acceptor_.async_accept([this](beast::error_code error, Tcp::socket socket) {
    if (stopping_ || error == asio::error::operation_aborted) return;
    if (!error) {
      guarded([&] {
        const auto connection = std::make_shared<Connection>(*this, std::move(socket));
        if (connections_ > kConnections)
          connection->turn_away();
        else
          connection->read();
      });
    }
    accept();
  });
}

void StudioServer::Core::look() {
  timer_.expires_after(kLook);
  timer_.async_wait([this](beast::error_code error) {
    if (error || stopping_) return;
    guarded([this] { handler_.look(); });
    look();
  });
}

bool StudioServer::Core::take_change() {
  const auto now = std::chrono::steady_clock::now();
  if (now - second_ >= std::chrono::seconds(1)) {
    second_ = now;
    changes_ = 0;
  }
  return ++changes_ <= kChangesPerSecond;
}

void StudioServer::Core::run() noexcept {
  block_write_signals();
  while (!stopping_) {
    try {
      context_.run();
      break;
    } catch (...) {
      ++counters_.faults;
    }
  }
  handler_.ended();
  for (Page* page : pages_) page->close();
  for (Connection* connection : asking_) connection->close();
}

StudioServer::StudioServer(StudioServerOptions options, StudioHandler& handler)
    : core_(std::make_unique<Core>(std::move(options), handler)) {}

StudioServer::~StudioServer() {
  stop();
}

std::string StudioServer::start() {
  return core_->start();
}

void StudioServer::stop() {
  core_->stop();
}

Endpoint StudioServer::endpoint() const {
  return core_->endpoint();
}

const StudioCounters& StudioServer::counters() const noexcept {
  return core_->counters();
}

}  // namespace lockstep
