// Any bytes on a connection to the studio's server: requests, and what comes behind one that has become a
// WebSocket. Lines end as HTTP has them; `@` at the begin of one stands for the headers that are asked for.
#include <poll.h>

#include <string_view>

#include "hmi_bridge/studio/server.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/hmi_bridge/studio_client.hpp"

namespace lockstep::fuzz::studio_server_target {
namespace {

/// Answers everything with what it was asked, and says what is said.
class Echo final : public StudioHandler {
 public:
  void answer(const StudioRequest& request, Done done) override {
    require(request.path.starts_with('/'), "a request has a path");
    StudioAnswer answer;
    answer.type = "text/plain";
    answer.body = std::string(request.method) + " " + request.path + " " + std::string(request.body);
    for (const auto& [name, value] : request.query) answer.body += "\n" + name + "=" + value;
    done(std::move(answer));
  }
  void opened(StudioClient& client) override { client.send_text("opened"); }
  void text(StudioClient& client, std::string_view message) override {
    client.send_text(std::string(message));
  }
  void closed(StudioClient& /*client*/) noexcept override {}
  void look() override {}
  void ended() noexcept override {}
};

/// One for all inputs: it has to outlive whatever is done to it.
struct Studio {
  Echo echo;
  StudioServer server{options(), echo};

  static StudioServerOptions options() {
    StudioServerOptions options;
    options.listen = {"127.0.0.1", 0};
    options.names = {"studio.example"};
    options.token = std::string(32, 't');
    options.request_time = std::chrono::milliseconds(2000);
    return options;
  }

  Studio() { require(server.start().empty(), "it listens"); }
  std::uint16_t port() const { return server.endpoint().port; }
};

std::string masked(std::string_view text, char code) {
  std::string frame{static_cast<char>(0x80 | code), static_cast<char>(0x80 | text.size())};
  frame.append(4, '\0');
  return frame.append(text);
}

constexpr std::string_view kHeads =
    "Host: studio.example\r\nOrigin: http://studio.example\r\nContent-Type: "
    "application/json\r\nAuthorization: Bearer tttttttttttttttttttttttttttttttt\r\n";

/// With the headers put in.
std::string written_out(std::string_view input) {
  std::string text;
  for (std::size_t i = 0; i < input.size(); ++i) {
    if (input[i] == '@' && i > 0 && input[i - 1] == '\n')
      text += kHeads;
    else
      text += input[i];
  }
  return text;
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string upgrade =
      "GET /ws HTTP/1.1\r\n@Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: "
      "13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
      "Sec-WebSocket-Protocol: lockstep.1\r\n\r\n";
  const std::string two_readings =
      "POST /api/read HTTP/1.1\r\n@Content-Length: 2\r\n\r\n{}"
      "POST /api/read HTTP/1.1\r\n@Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n";
  const std::string upload =
      "POST /api/traces?name=a.csv HTTP/1.1\r\nHost: studio.example\r\nOrigin: http://studio.example\r\n"
      "Content-Type: text/csv\r\nAuthorization: Bearer tttttttttttttttttttttttttttttttt\r\n"
      "Content-Length: 4\r\n\r\nt,a\n";
  return {
      "GET /api?q=a%20b&x HTTP/1.1\r\n@\r\n",
      "GET / HTTP/1.1\r\n@If-None-Match: \"x\"\r\n\r\nGET /assets/none HTTP/1.1\r\n@\r\n",
      "HEAD /api HTTP/1.1\r\n@\r\nGET /api HTTP/1.0\r\n@\r\n",
      two_readings,
      upload,
      "PUT /api/files/a HTTP/1.1\r\n@If-Match: \"x\"\r\nContent-Length: 2\r\nExpect: 100-continue\r\n\r\n{}",
      "DELETE /api/traces/a HTTP/1.1\r\n@\r\n",
      "GET /api HTTP/1.1\r\nHost: 127.0.0.1:1\r\nHost: x\r\n\r\n",
      "GET /api?token=tttt HTTP/1.1\r\n@\r\n",
      upgrade + masked("{\"type\":\"hello\"}", 1) + masked("again", 1) + masked("", 9) +
          masked("\x03\xe8", 8),
      upgrade + masked("binary", 2),
      upgrade + masked("\xff\xfe", 1)};
}

int take(const std::uint8_t* data, std::size_t size) {
  static Studio studio;
  test::StudioConnection connection(studio.port());
  require(connection.is_connected(), "it is there for the next");
  connection.send(written_out({reinterpret_cast<const char*>(data), size}));
  connection.finish();
  const std::string answer = connection.all();
  require(answer.empty() || answer.starts_with("HTTP/1.1 "), "what is answered is HTTP");
  require(answer.find("HTTP/1.1 500") == std::string::npos, "no internal fault");
  require(studio.server.counters().faults == 0, "no internal fault");
  return 0;
}

}  // namespace lockstep::fuzz::studio_server_target
