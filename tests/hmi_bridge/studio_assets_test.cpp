// The page as it is served: whole, from the program alone, strict, and small.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <utility>

#include "hmi_bridge/studio/assets.hpp"
#include "hmi_bridge/studio/server.hpp"
#include "tests/hmi_bridge/studio_client.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::studio_assets_test {
namespace {

using test::HttpAnswer;
using test::StudioConnection;

class Nobody final : public StudioHandler {
 public:
  void answer(const StudioRequest&, Done done) override {
    StudioAnswer nothing;
    nothing.status = 404;
    done(std::move(nothing));
  }
  void opened(StudioClient&) override {}
  void text(StudioClient&, std::string_view) override {}
  void closed(StudioClient&) noexcept override {}
  void look() override {}
  void ended() noexcept override {}
};

class Server {
 public:
  explicit Server(std::string token = "") {
    StudioServerOptions options;
    options.listen.port = 0;
    options.token = std::move(token);
    server = std::make_unique<StudioServer>(std::move(options), nobody);
    EXPECT_EQ(server->start(), "");
  }
  HttpAnswer get(const std::string& path, const std::string& headers = "") const {
    return StudioConnection(server->endpoint().port).get(path, headers);
  }

  Nobody nobody;
  std::unique_ptr<StudioServer> server;
};

/// What index.html asks for.
std::set<std::string> wanted_by(const std::string& index) {
  std::set<std::string> paths;
  const std::regex attribute("(?:src|href)=\"([^\"]+)\"");
  for (std::sregex_iterator found(index.begin(), index.end(), attribute), end; found != end; ++found)
    paths.insert("/" + (*found)[1].str());
  return paths;
}

TEST(StudioAssets, AreWhatThePageAsksForAndNothingElse) {
  const Server server;
  const HttpAnswer index = server.get("/");
  ASSERT_EQ(index.status, 200);
  EXPECT_EQ(index.header("Content-Type"), "text/html; charset=utf-8");
  std::set<std::string> there;
  for (const StudioAsset& asset : studio_assets())
    if (asset.path != "/") there.insert(std::string(asset.path));
  EXPECT_EQ(wanted_by(index.body), there);
  ASSERT_EQ(there.size(), 3u);
  for (const std::string& path : there) {
    const HttpAnswer asset = server.get(path);
    EXPECT_EQ(asset.status, 200) << path;
    if (path.ends_with(".svg")) {
      EXPECT_EQ(asset.header("Content-Type"), "image/svg+xml");
      EXPECT_EQ(asset.header("Cache-Control"), "no-cache");
    } else {
      const std::string type = path.ends_with(".js") ? "javascript" : "css";
      EXPECT_EQ(asset.header("Content-Type"), "text/" + type + "; charset=utf-8");
      EXPECT_EQ(asset.header("Cache-Control"), "public, max-age=31536000, immutable") << path;
      EXPECT_GT(asset.body.size(), 1000u) << path;
    }
  }
  EXPECT_EQ(server.get("/assets/other.js").status, 404);
  EXPECT_EQ(server.get("/assets/../studio.ts").status, 404);
}

TEST(StudioAssets, AreAskedForAnewOnlyWhereTheyMayHaveChanged) {
  const Server server;
  const HttpAnswer index = server.get("/");
  EXPECT_EQ(index.header("Cache-Control"), "no-cache");
  ASSERT_NE(index.header("ETag"), "");
  const HttpAnswer again = server.get("/", "If-None-Match: " + index.header("ETag") + "\r\n");
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(server.get("/", "If-None-Match: \"0\"\r\n").status, 200);
}

TEST(StudioAssets, NeedNoTokenAndCannotBeWritten) {
  const Server server(std::string(32, 'x'));
  EXPECT_EQ(server.get("/").status, 200) << "the page itself knows nothing";
  EXPECT_EQ(server.get("/assets/other.js").status, 401);
  EXPECT_EQ(StudioConnection(server.server->endpoint().port).post("/", "{}").status, 401);
}

TEST(StudioAssets, HoldToTheirOwnPolicyAndNameNoOtherServer) {
  for (const StudioAsset& asset : studio_assets()) {
    const std::string text(asset.content);
    if (asset.path == "/") {
      EXPECT_EQ(text.find("<style"), std::string::npos);
      EXPECT_EQ(text.find(" style="), std::string::npos);
      EXPECT_FALSE(std::regex_search(text, std::regex("<script[^>]*>[^<]"))) << "a script in the page";
      EXPECT_FALSE(std::regex_search(text, std::regex(" on[a-z]+="))) << "a script in an attribute";
    }
    const std::regex address("https?://[a-zA-Z0-9./]+");
    for (std::sregex_iterator found(text.begin(), text.end(), address), end; found != end; ++found)
      EXPECT_EQ(found->str(), "http://www.w3.org/2000/svg") << asset.path;
  }
}

TEST(StudioAssets, AreSmall) {
  const test::Directory directory;
  std::size_t sum = 0;
  for (const StudioAsset& asset : studio_assets()) {
    const std::string path = directory.file("asset");
    std::ofstream(path, std::ios::binary) << asset.content;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> gzip(
        popen(("gzip -9c " + path + " | wc -c").c_str(), "r"), &pclose);
    ASSERT_NE(gzip, nullptr);
    unsigned long size = 0;
    ASSERT_EQ(std::fscanf(gzip.get(), "%lu", &size), 1);
    EXPECT_GT(size, 100u) << asset.path;
    sum += size;
  }
  EXPECT_LE(sum, std::size_t{200} << 10);
  RecordProperty("gzip_bytes", static_cast<int>(sum));
}

}  // namespace
}  // namespace lockstep::studio_assets_test
