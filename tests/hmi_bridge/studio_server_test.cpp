// Who is heard by the studio and who is not: each refusal has its test.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "hmi_bridge/studio/server.hpp"
#include "tests/hmi_bridge/studio_client.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::studio_server_test {
namespace {

using test::Directory;
using test::HttpAnswer;
using test::StudioConnection;

const std::string kToken = "0123456789abcdef0123456789abcdef";

/// Answers what it was asked, and counts.
class Echo final : public StudioHandler {
 public:
  void answer(const StudioRequest& request, Done done) override {
    ++asked;
    if (request.path == "/fault") throw std::runtime_error("on purpose");
    StudioAnswer answer;
    answer.body = std::string(request.method) + " " + request.path + " " + std::string(request.value("q")) +
                  " " + std::string(request.body.substr(0, 100));
    if (request.path == "/known")
      answer.body = std::string(request.if_match) + " " + std::string(request.if_none_match);
    answer.etag = "\"1\"";
    done(answer);
  }
  void opened(StudioClient&) override { ++open; }
  void text(StudioClient& client, std::string_view message) override {
    if (message == "fault") throw std::runtime_error("on purpose");
    client.authorise(message);
    client.send_text((client.is_authorised() ? "known " : "unknown ") + std::string(message));
  }
  void closed(StudioClient&) noexcept override { --open; }
  void look() override { ++looks; }
  void ended() noexcept override { has_ended = true; }

  std::atomic<int> asked{0}, open{0}, looks{0};
  std::atomic<bool> has_ended{false};
};

class Server {
 public:
  explicit Server(StudioServerOptions options = {}) {
    options.listen = {"127.0.0.1", 0};
    server = std::make_unique<StudioServer>(std::move(options), echo);
    EXPECT_EQ(server->start(), "");
  }
  std::uint16_t port() const { return server->endpoint().port; }
  HttpAnswer raw(const std::string& bytes) const {
    StudioConnection client(port());
    client.send(bytes);
    return client.answer();
  }
  /// A request with these headers, each with its end of line.
  HttpAnswer with(const std::string& line, const std::string& headers, const std::string& body = "") const {
    return raw(line + " HTTP/1.1\r\n" + headers + "Content-Length: " + std::to_string(body.size()) +
               "\r\n\r\n" + body);
  }
  std::string host() const { return "127.0.0.1:" + std::to_string(port()); }
  std::string host_line() const { return "Host: " + host() + "\r\n"; }
  std::string origin_line() const { return "Origin: http://" + host() + "\r\n"; }

  Echo echo;
  std::unique_ptr<StudioServer> server;
};

const std::string kJson = "Content-Type: application/json\r\n";

TEST(StudioServer, AnswersSeveralRequestsOfAConnection) {
  Server server;
  StudioConnection client(server.port());
  EXPECT_EQ(client.get("/api/x%20y?q=a+b&r=1").body, "GET /api/x y a b ");
  EXPECT_EQ(client.post("/api", "{}").body, "POST /api  {}");
  const HttpAnswer again = client.get("/api", "If-None-Match: \"1\"\r\n");
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(client.get("/api").header("Cache-Control"), "no-store");
}

TEST(StudioServer, TellsBrowsersToBeStrict) {
  Server server;
  const HttpAnswer answer = StudioConnection(server.port()).get("/");
  EXPECT_EQ(answer.header("Content-Security-Policy").substr(0, 18), "default-src 'none'");
  EXPECT_EQ(answer.header("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(answer.header("Referrer-Policy"), "no-referrer");
  EXPECT_EQ(answer.header("Cross-Origin-Opener-Policy"), "same-origin");
  EXPECT_EQ(answer.header("Cross-Origin-Resource-Policy"), "same-origin");
  EXPECT_EQ(answer.header("Access-Control-Allow-Origin"), "");
}

TEST(StudioServer, RefusesAForeignHost) {
  Server server;
  for (const std::string host : {"evil.example", "evil.example:80", "127.0.0.1", "127.0.0.1:1", "", "[", ":"})
    EXPECT_EQ(server.with("GET /api", "Host: " + host + "\r\n").status, 403) << host;
  EXPECT_EQ(server.with("GET /api", "").status, 400) << "none";
  EXPECT_EQ(server.with("GET /api", server.host_line() + "Host: evil.example\r\n").status, 400) << "two";
  EXPECT_EQ(server.echo.asked, 0);
  const std::string port = std::to_string(server.port());
  EXPECT_EQ(server.with("GET /api", "Host: LocalHost:" + port + "\r\n").status, 200);
  EXPECT_EQ(server.with("GET /api", server.host_line()).status, 200);
}

TEST(StudioServer, HearsTheNamesThatItWasGiven) {
  StudioServerOptions options;
  options.names = {"machine.example"};
  Server server(options);
  EXPECT_EQ(server.with("GET /api", "Host: Machine.Example\r\n").status, 200);
  EXPECT_EQ(server.with("GET /api", "Host: machine.example:8443\r\n").status, 200);
  EXPECT_EQ(server.with("GET /api", "Host: other.example\r\n").status, 403);
}

TEST(StudioServer, RefusesChangesFromForeignPages) {
  Server server;
  const std::string host = server.host_line() + kJson;
  EXPECT_EQ(server.with("POST /api", host, "{}").status, 403) << "no origin";
  for (const std::string origin : {"http://evil.example", "null", "http://127.0.0.1", "127.0.0.1"})
    EXPECT_EQ(server.with("POST /api", host + "Origin: " + origin + "\r\n", "{}").status, 403) << origin;
  EXPECT_EQ(server.with("DELETE /api", host + "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(server.with("POST /api", host + server.origin_line() + server.origin_line(), "{}").status, 400);
  EXPECT_EQ(server.echo.asked, 0);
  EXPECT_EQ(server.with("POST /api", host + server.origin_line(), "{}").status, 200);
}

TEST(StudioServer, RefusesWhatAFormCouldSend) {
  Server server;
  const std::string known = server.host_line() + server.origin_line();
  for (const std::string type :
       {"text/plain", "application/x-www-form-urlencoded", "multipart/form-data", "application/jsonx"})
    EXPECT_EQ(server.with("POST /api", known + "Content-Type: " + type + "\r\n", "{}").status, 403) << type;
  EXPECT_EQ(server.with("POST /api", known, "{}").status, 403) << "none";
  EXPECT_EQ(server.echo.asked, 0);
  EXPECT_EQ(
      server.with("POST /api", known + "Content-Type: application/json; charset=utf-8\r\n", "{}").status,
      200);
}

TEST(StudioServer, AsksForItsToken) {
  StudioServerOptions options;
  options.token = kToken;
  Server server(options);
  StudioConnection client(server.port());
  const HttpAnswer none = client.get("/api");
  EXPECT_EQ(none.status, 401);
  EXPECT_EQ(none.header("WWW-Authenticate"), "Bearer");
  for (const std::string& wrong :
       std::vector<std::string>{"Bearer ", "Bearer x", "Bearer " + kToken + "0", "Bearer " + kToken.substr(1),
                                "Basic " + kToken, kToken})
    EXPECT_EQ(client.get("/api", "Authorization: " + wrong + "\r\n").status, 401) << wrong;
  EXPECT_EQ(client.get("/api?token=" + kToken).status, 400) << "never in an address";
  EXPECT_EQ(StudioConnection(server.port()).get("/api?q=1&token=" + kToken).status, 400);
  EXPECT_EQ(server.echo.asked, 0);
  StudioConnection other(server.port());
  EXPECT_EQ(other.get("/api", "Authorization: Bearer " + kToken + "\r\n").status, 200);
  EXPECT_EQ(other.get("/").status, 200) << "the page itself knows nothing";
}

TEST(StudioServer, ReadsATokenOnlyFromAFileOfItsOwner) {
  Directory directory;
  const std::string path = directory.file("token");
  const auto write = [&](const std::string& text, mode_t mode) {
    std::ofstream(path) << text;
    ::chmod(path.c_str(), mode);
  };
  std::string problem;
  EXPECT_EQ(read_studio_token(path, problem), "");
  EXPECT_NE(problem.find("No such file"), std::string::npos);
  write(kToken + "\n", 0600);
  EXPECT_EQ(read_studio_token(path, problem), kToken);
  write(kToken + "\n", 0640);
  EXPECT_EQ(read_studio_token(path, problem), "");
  EXPECT_NE(problem.find("chmod 600"), std::string::npos);
  for (const std::string& bad :
       {std::string("short"), std::string(300, 'x'), kToken + " " + kToken, kToken + "\n\n", std::string()}) {
    write(bad, 0600);
    EXPECT_EQ(read_studio_token(path, problem), "") << bad;
  }
  EXPECT_EQ(read_studio_token(directory.file("."), problem), "") << "no file";
}

TEST(StudioServer, RefusesWhatIsTooLarge) {
  Server server;
  const std::string known = server.host_line() + server.origin_line() + kJson;
  EXPECT_EQ(server.with("GET /api", known + "X: " + std::string(9000, 'x') + "\r\n").status, 431);
  const HttpAnswer large = server.raw("POST /api HTTP/1.1\r\n" + known + "Content-Length: 16777217\r\n\r\n");
  EXPECT_EQ(large.status, 413);
  EXPECT_NE(large.body.find("a body may have 16 MiB"), std::string::npos) << large.body;
  const HttpAnswer chunked =
      server.raw("POST /api HTTP/1.1\r\n" + known + "Transfer-Encoding: chunked\r\n\r\n1000001\r\n");
  EXPECT_EQ(chunked.status, 413);
  EXPECT_NE(chunked.body.find("a body may have 16 MiB"), std::string::npos) << chunked.body;
  EXPECT_EQ(server.echo.asked, 0);
  EXPECT_EQ(server.with("POST /api", known, std::string(1 << 20, ' ')).status, 200);
}

TEST(StudioServer, HandsOnWhatTheClientKnows) {
  Server server;
  const std::string known = server.host_line() + server.origin_line() + kJson;
  EXPECT_EQ(server.with("PUT /known", known + "If-Match: \"7\"\r\n", "{}").body, "\"7\" ");
  EXPECT_EQ(server.with("PUT /known", known + "If-None-Match: *\r\n", "{}").body, " *");
  EXPECT_EQ(server.with("GET /known", known + "If-None-Match: \"1\"\r\n").status, 304);
  EXPECT_EQ(server.with("GET /known", known + "If-None-Match: \"2\"\r\n").status, 200);
}

TEST(StudioServer, RefusesWhatIsNoHttp) {
  Server server;
  EXPECT_EQ(server.raw(std::string("\x16\x03\x01\x02\x00\x01\r\n\r\n", 10)).status, 400);
  for (const std::string target : {"/api%", "/api%2", "/api%zz", "/api%00", "/api?q=%0a", "?q=1", "api", "*"})
    EXPECT_EQ(server.with("GET " + target, server.host_line()).status, 400) << target;
  EXPECT_EQ(server.echo.asked, 0);
}

TEST(StudioServer, HangsUpOnThoseWhoTakeTheirTime) {
  StudioServerOptions options;
  options.request_time = std::chrono::milliseconds(200);
  Server server(options);
  StudioConnection slow(server.port());
  slow.send("GET /api HTTP/1.1\r\nHost:");
  EXPECT_TRUE(slow.is_closed());
  EXPECT_EQ(server.echo.asked, 0);
}

TEST(StudioServer, SurvivesFaultsBehindIt) {
  Server server;
  EXPECT_EQ(StudioConnection(server.port()).get("/fault").status, 500);
  StudioConnection page(server.port());
  ASSERT_EQ(page.upgrade(), 101);
  page.say("fault");
  EXPECT_FALSE(page.hear().is_there) << "the page is closed";
  EXPECT_EQ(server.server->counters().faults, 2u);
  EXPECT_EQ(StudioConnection(server.port()).get("/api").status, 200);
}

TEST(StudioServer, HearsFiftyChangesASecond) {
  Server server;
  StudioConnection client(server.port());
  // At once, so that they come faster than that on any machine.
  constexpr int kMany = 400;
  std::string all;
  for (int i = 0; i < kMany; ++i)
    all += "POST /api HTTP/1.1\r\n" + server.host_line() + server.origin_line() + kJson +
           "Content-Length: 2\r\n\r\n{}";
  client.send(all);
  int refused = 0;
  for (int i = 0; i < kMany; ++i) {
    const HttpAnswer answer = client.answer();
    if (answer.status == 200) continue;
    ASSERT_EQ(answer.status, 429);
    EXPECT_EQ(answer.header("Retry-After"), "1");
    ++refused;
  }
  EXPECT_GT(refused, 0);
  EXPECT_EQ(client.get("/api").status, 200) << "who only looks is heard";
}

TEST(StudioServer, HearsReadingsThatHaveTheirPathsInABody) {
  Server server;
  StudioConnection client(server.port());
  constexpr int kMany = 400;
  std::string all;
  for (int i = 0; i < kMany; ++i)
    all += "POST /api/read HTTP/1.1\r\n" + server.host_line() + server.origin_line() + kJson +
           "Content-Length: 2\r\n\r\n{}";
  client.send(all);
  for (int i = 0; i < kMany; ++i)
    ASSERT_EQ(client.answer().status, 200) << i << ": a reading changes nothing";
  EXPECT_EQ(server.with("POST /api/read", server.host_line() + kJson, "{}").status, 403)
      << "but it comes from the page, as every POST does";
}

TEST(StudioServer, TurnsConnectionsAwayThatAreTooMany) {
  Server server;
  std::vector<std::unique_ptr<StudioConnection>> clients;
  for (std::size_t i = 0; i < StudioServer::kConnections; ++i) {
    clients.push_back(std::make_unique<StudioConnection>(server.port()));
    ASSERT_EQ(clients.back()->get("/api").status, 200);
  }
  StudioConnection more(server.port());
  EXPECT_EQ(more.answer().status, 503);
  EXPECT_EQ(clients.front()->get("/api").status, 200) << "the others go on";
}

TEST(StudioPages, TalkAndAreKnownByTheirToken) {
  StudioServerOptions options;
  options.token = kToken;
  Server server(options);
  StudioConnection page(server.port());
  ASSERT_EQ(page.upgrade(), 101);
  page.say("x");
  EXPECT_EQ(page.hear().bytes, "unknown x");
  page.say(kToken);
  EXPECT_EQ(page.hear().bytes, "known " + kToken);
  page.say(std::string(70'000, 'y'));
  EXPECT_EQ(page.hear().bytes.size(), 70'006u);
}

TEST(StudioPages, AreRefusedFromElsewhere) {
  Server server;
  const std::string protocol = "Sec-WebSocket-Protocol: lockstep.1\r\n";
  EXPECT_EQ(StudioConnection(server.port()).upgrade(protocol), 403) << "no origin";
  EXPECT_EQ(StudioConnection(server.port()).upgrade(protocol + "Origin: http://evil.example\r\n"), 403);
  EXPECT_EQ(StudioConnection(server.port()).upgrade(server.origin_line()), 400) << "no subprotocol";
  EXPECT_EQ(server.with("GET /ws", server.host_line() + server.origin_line()).status, 400) << "no upgrade";
  EXPECT_EQ(server.echo.open, 0);
}

TEST(StudioPages, AreEightAtMost) {
  Server server;
  std::vector<std::unique_ptr<StudioConnection>> pages;
  for (std::size_t i = 0; i < StudioServer::kPages; ++i) {
    pages.push_back(std::make_unique<StudioConnection>(server.port()));
    ASSERT_EQ(pages.back()->upgrade(), 101);
  }
  EXPECT_EQ(StudioConnection(server.port()).upgrade(), 503);
  pages[0]->say("x");
  EXPECT_EQ(pages[0]->hear().bytes, "known x");
}

TEST(StudioPages, AreClosedForAMessageThatIsTooLarge) {
  Server server;
  StudioConnection page(server.port());
  ASSERT_EQ(page.upgrade(), 101);
  page.say(std::string(StudioServer::kMessageBytes + 1, 'x'));
  EXPECT_FALSE(page.hear().is_there);
}

TEST(StudioPages, AreAskedWhetherTheyAreThereAndClosedWhenTheyAreNot) {
  EXPECT_EQ(StudioServerOptions{}.silence, std::chrono::seconds(30));
  StudioServerOptions options;
  options.silence = std::chrono::seconds(1);
  Server server(options);
  StudioConnection silent(server.port()), there(server.port());
  ASSERT_EQ(silent.upgrade(), 101);
  ASSERT_EQ(there.upgrade(), 101);
  ASSERT_TRUE(there.answer_ping()) << "it is asked";
  const std::string told = silent.all();
  EXPECT_TRUE(told.starts_with("\x89")) << "it was asked, too, and then closed";
  there.say("still");
  EXPECT_EQ(there.hear_text("still"), "known still");
  EXPECT_EQ(server.server->counters().pages, 1u);
}

TEST(StudioPages, AreLetGoWhenTheServerStops) {
  Server server;
  StudioConnection page(server.port());
  ASSERT_EQ(page.upgrade(), 101);
  page.say("x");
  ASSERT_TRUE(page.hear().is_there);
  server.server->stop();
  EXPECT_TRUE(server.echo.has_ended);
  EXPECT_TRUE(page.is_closed());
  server.server.reset();
  EXPECT_EQ(server.echo.open, 0);
}

TEST(StudioServer, TellsThatAPortIsTaken) {
  Server server;
  Echo echo;
  StudioServerOptions options;
  options.listen = {"127.0.0.1", server.port()};
  StudioServer second(options, echo);
  EXPECT_NE(second.start().find("Address already in use"), std::string::npos);
  options.listen.host = "no.address";
  StudioServer nowhere(options, echo);
  EXPECT_EQ(nowhere.start(), "no.address: has to be an address, or localhost");
}

}  // namespace
}  // namespace lockstep::studio_server_test
