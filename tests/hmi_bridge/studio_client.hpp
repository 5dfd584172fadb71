/// A client of the studio by sockets alone, for tests: HTTP and WebSocket as RFC 9112 and RFC 6455 have them.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::test {

/// What came back.
struct HttpAnswer {
  int status = 0;  ///< 0: none
  std::string head;
  std::string body;

  /// Value of a header; empty: it is not there.
  std::string header(std::string_view name) const {
    const std::size_t at = head.find("\r\n" + std::string(name) + ": ");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + name.size() + 4;
    return head.substr(begin, head.find("\r\n", begin) - begin);
  }
};

class StudioConnection {
 public:
  /// Every wait ends after a generous time; then the test fails for want of an answer.
  explicit StudioConnection(std::uint16_t port) : port_(port), socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const timeval timeout{120, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~StudioConnection() { ::close(socket_); }
  StudioConnection(const StudioConnection&) = delete;
  StudioConnection& operator=(const StudioConnection&) = delete;

  bool is_connected() const { return is_connected_; }
  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  std::string origin() const { return "http://" + host(); }

  void send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  /// More bytes into `waiting_`; false: nothing comes any more.
  bool receive() {
    char bytes[1 << 16];
    const ssize_t got = ::recv(socket_, bytes, sizeof bytes, 0);
    if (got <= 0) return false;
    waiting_.append(bytes, static_cast<std::size_t>(got));
    return true;
  }
  /// Nothing more will be sent.
  void finish() { ::shutdown(socket_, SHUT_WR); }
  /// All that comes until the other side ends it.
  std::string all() {
    while (receive()) {
    }
    return waiting_;
  }
  bool is_closed() {
    while (receive()) waiting_.clear();
    return true;
  }

  HttpAnswer answer() {
    HttpAnswer answer;
    std::size_t end = 0;
    while ((end = waiting_.find("\r\n\r\n")) == std::string::npos)
      if (!receive()) return answer;
    answer.head = waiting_.substr(0, end + 2);
    waiting_.erase(0, end + 4);
    answer.status = std::atoi(answer.head.c_str() + std::strlen("HTTP/1.1 "));
    const auto size = static_cast<std::size_t>(std::atoll(answer.header("Content-Length").c_str()));
    const bool has_body = answer.status != 304 && answer.status != 101;
    while (has_body && waiting_.size() < size)
      if (!receive()) return answer;
    answer.body = waiting_.substr(0, has_body ? size : 0);
    waiting_.erase(0, answer.body.size());
    return answer;
  }

  /// @param headers further ones, each with its end of line
  HttpAnswer get(const std::string& target, const std::string& headers = "") {
    send("GET " + target + " HTTP/1.1\r\nHost: " + host() + "\r\n" + headers + "\r\n");
    return answer();
  }
  HttpAnswer post(const std::string& target, const std::string& body, const std::string& headers = "") {
    send("POST " + target + " HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: " + origin() +
         "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" +
         headers + "\r\n" + body);
    return answer();
  }

  /// Becomes a WebSocket. @return status of the answer, 101 if it is one now
  int upgrade(const std::string& headers) {
    send("GET /ws HTTP/1.1\r\nHost: " + host() +
         "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
         headers + "\r\n");
    return answer().status;
  }
  int upgrade() { return upgrade("Origin: " + origin() + "\r\nSec-WebSocket-Protocol: lockstep.1\r\n"); }

  void say(const std::string& text) {
    std::string frame("\x81", 1);
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else if (text.size() < 65536) {
      frame += static_cast<char>(0x80 | 126);
      for (int shift = 8; shift >= 0; shift -= 8) frame += static_cast<char>(text.size() >> shift);
    } else {
      frame += static_cast<char>(0x80 | 127);
      for (int shift = 56; shift >= 0; shift -= 8) frame += static_cast<char>(text.size() >> shift);
    }
    frame.append(4, '\0');  // a mask that changes nothing
    send(frame + text);
  }

  struct Message {
    bool is_there = false;
    bool is_binary = false;
    std::string bytes;
  };
  /// The next message; pings and the like are left out.
  Message hear() {
    for (;;) {
      if (!have(2)) return {};
      const int code = waiting_[0] & 15;
      std::size_t size = static_cast<unsigned char>(waiting_[1]) & 127u;
      std::size_t head = 2;
      if (size >= 126) {
        const std::size_t digits = size == 126 ? 2 : 8;
        if (!have(2 + digits)) return {};
        size = 0;
        for (std::size_t i = 0; i < digits; ++i)
          size = size << 8 | static_cast<unsigned char>(waiting_[2 + i]);
        head += digits;
      }
      if (!have(head + size)) return {};
      Message message{true, code == 2, waiting_.substr(head, size)};
      waiting_.erase(0, head + size);
      if (code == 8) return {};
      if (code == 1 || code == 2) return message;
    }
  }
  /// Answers a ping that is the next that comes; false: something else has come, or nothing.
  bool answer_ping() {
    if (!have(2) || (waiting_[0] & 15) != 9) return false;
    const std::size_t size = static_cast<unsigned char>(waiting_[1]) & 127u;
    if (!have(2 + size)) return false;
    send("\x8a" + std::string(1, static_cast<char>(0x80 | size)) + std::string(4, '\0') +
         waiting_.substr(2, size));
    waiting_.erase(0, 2 + size);
    return true;
  }
  /// The next text message that has a part; empty: none comes.
  std::string hear_text(std::string_view part) {
    for (Message message = hear(); message.is_there; message = hear())
      if (!message.is_binary && message.bytes.find(part) != std::string::npos) return message.bytes;
    return "";
  }

 private:
  bool have(std::size_t size) {
    while (waiting_.size() < size)
      if (!receive()) return false;
    return true;
  }

  std::uint16_t port_;
  int socket_;
  bool is_connected_ = false;
  std::string waiting_;
};

/// A frame, decoded by itself and by nothing of the product.
struct DecodedFrame {
  struct Column {
    int type = 0;
    std::vector<std::vector<std::uint64_t>> arrays;  ///< the bits of the values
    double real(std::size_t array, std::size_t row) const {
      double value = 0.0;
      std::memcpy(&value, &arrays[array][row], sizeof value);
      return value;
    }
  };
  bool is_whole = false;  ///< every byte is accounted for
  int kind = 0;
  std::uint32_t subscription = 0, frame = 0;
  std::uint64_t dropped = 0;
  std::vector<std::int64_t> t;
  std::vector<std::uint64_t> tick;
  std::vector<Column> columns;

  explicit DecodedFrame(std::string_view bytes) {
    std::size_t at = 0;
    bool is_short = false;
    const auto take = [&](std::size_t size) {
      std::uint64_t value = 0;
      if (at + size > bytes.size()) {
        is_short = true;
        return value;
      }
      for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
      at += size;
      return value;
    };
    kind = static_cast<int>(take(1));
    is_short = take(1) != 1;
    const std::size_t width = take(2);
    subscription = static_cast<std::uint32_t>(take(4));
    const std::size_t rows = take(4);
    frame = static_cast<std::uint32_t>(take(4));
    dropped = take(8);
    if (rows > bytes.size()) return;
    for (std::size_t i = 0; i < rows; ++i) t.push_back(static_cast<std::int64_t>(take(8)));
    for (std::size_t i = 0; i < rows; ++i) tick.push_back(take(8));
    for (std::size_t c = 0; c < width && !is_short; ++c) {
      Column& column = columns.emplace_back();
      column.type = static_cast<int>(take(1));
      column.arrays.resize(take(1));
      at = (at + 7) / 8 * 8;
      for (std::vector<std::uint64_t>& array : column.arrays) {
        for (std::size_t i = 0; i < rows; ++i) array.push_back(take(column.type == 3 ? 1 : 8));
        at = (at + 7) / 8 * 8;
      }
    }
    is_whole = !is_short && at == bytes.size();
  }
};

}  // namespace lockstep::test
