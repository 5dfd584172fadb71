#include "hmi_bridge/studio/page.hpp"

#include <stdexcept>
#include <utility>

namespace lockstep::studio_net {
namespace {

constexpr std::size_t kQueuedBytes = std::size_t{16} << 20;  // of a page that takes nothing

void name_ourselves(websocket::response_type& response) {
  response.set(http::field::sec_websocket_protocol, beast_view(kProtocol));
  response.set(http::field::server, "lockstep");
}

}  // namespace

Page::Page(Listener& listener, beast::tcp_stream stream, std::string peer)
    : listener_(listener),
      seat_(listener),
      peer_(std::move(peer)),
      stream_(std::move(stream)),
      authorised_(!listener.guard().needs_token()) {
  listener_.enter_page(*this);
}

Page::~Page() {
  leave();
}

void Page::accept(const Request& request) {
  beast::get_lowest_layer(stream_).expires_never();
  websocket::stream_base::timeout timeout{};
  timeout.handshake_timeout = listener_.options().request_time;
  timeout.idle_timeout = 2 * listener_.options().silence;  // asked half-way whether it is there
  timeout.keep_alive_pings = true;
  stream_.set_option(timeout);
  stream_.set_option(websocket::stream_base::decorator(name_ourselves));
  stream_.read_message_max(StudioLimits::kMessageBytes);
  stream_.auto_fragment(false);
  stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
    if (error) return;
    self->open_ = true;
    self->attempt([&] { self->listener_.handler().opened(*self); });
    self->read();
  });
}

bool Page::authorise(std::string_view token) noexcept {
  authorised_ = authorised_ || listener_.guard().is_token(token);
  return authorised_;
}

void Page::close() noexcept {
  beast::error_code ignored;
  beast::get_lowest_layer(stream_).socket().close(ignored);
}

template <class Call>
void Page::attempt(Call call) noexcept {
  try {
    call();
  } catch (...) {
    ++listener_.counters().faults;
    close();
  }
}

void Page::leave() noexcept {
  if (listener_.leave_page(*this) && open_) listener_.handler().closed(*this);
}

void Page::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->leave();
    self->attempt([&] { self->take(); });
    self->read();
  });
}

void Page::take() {
  if (!stream_.got_text()) throw std::runtime_error("a page sends text");
  const std::string message = beast::buffers_to_string(buffer_.data());
  buffer_.consume(buffer_.size());
  listener_.handler().text(*this, message);
}

void Page::send(Message message) {
  queued_ += message.bytes.size();
  if (queued_ > kQueuedBytes) return close();
  queue_.push_back(std::move(message));
  if (queue_.size() == 1) write();
}

void Page::write() {
  stream_.binary(queue_.front().is_binary);
  stream_.async_write(asio::buffer(queue_.front().bytes),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (error) return self->leave();
                        self->queued_ -= self->queue_.front().bytes.size();
                        self->queue_.pop_front();
                        if (!self->queue_.empty()) self->write();
                      });
}

}  // namespace lockstep::studio_net
