// Traces on a real network, with LCM's own programs: over UDP multicast, in a network of its own that each
// test makes, so that no network of the machine is needed and none is disturbed.
#include <gtest/gtest.h>
#include <lcm/lcm.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <thread>

#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/lcm/trace_reader.hpp"
#include "tests/hmi_bridge/own_network.hpp"
#include "tests/hmi_bridge/trace_samples.hpp"

namespace lockstep::lcm_network_test {
namespace {

constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0";
// A receiver asks for a larger socket buffer (the system grants what it allows): a burst has to wait there.
constexpr char kReceiveUrl[] = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";

const std::vector<TraceSignal> kSignals(24, {"x", Type::LREAL, "u"});  // a row is a message of 256 bytes
const LcmTraceIdentity kIdentity{"rotary_knife", "KNIFE", 100'000, 0};

std::vector<Value> row_values(std::uint64_t tick) {
  std::vector<Value> values;
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    values.push_back(real(static_cast<double>(tick * 100 + i) / 7.0));
  return values;
}

/// Hears everything on the network, as a stranger's program does.
class Listener {
 public:
  Listener() : lcm_(lcm_create(kReceiveUrl)) {
    auto* subscription = lcm_subscribe(lcm_, "KNIFE.*", on_message, this);
    lcm_subscription_set_queue_capacity(subscription, 0);  // no limit: LCM's own is 30 messages
  }
  ~Listener() { lcm_destroy(lcm_); }
  /// Takes what comes until nothing has come for some time.
  void listen(int milliseconds) {
    while (lcm_handle_timeout(lcm_, milliseconds) > 0) continue;
  }

  LcmDecoder decoder;
  std::uint64_t headers = 0;
  std::uint64_t rows = 0;
  std::uint64_t wrong = 0;

 private:
  static void on_message(const lcm_recv_buf_t* buffer, const char*, void* self) {
    auto& listener = *static_cast<Listener*>(self);
    const auto message =
        listener.decoder.accept({static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
    if (message == LcmDecoder::Message::kHeader) ++listener.headers;
    if (message != LcmDecoder::Message::kRow) return;
    const TraceRow row = listener.decoder.row();
    const std::vector<Value> expected = row_values(row.tick);
    ++listener.rows;
    for (std::size_t i = 0; i < expected.size(); ++i) listener.wrong += row.values[i].u != expected[i].u;
  }

  lcm_t* lcm_;
};

TEST(LcmNetwork, WithoutAMulticastRouteTheReasonIsGivenAndNothingIsPrinted) {
  in_own_network([] {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    std::string reason;
    try {
      LcmPublisher publisher(kUrl, kIdentity);
    } catch (const std::runtime_error& error) {
      reason = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(reason, std::string("LCM on ") + kUrl + ": no multicast route: Network is unreachable");
  });
}

/// The last bytes of a file that grows.
std::string tail(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (size <= 0) return "";
  std::string text(static_cast<std::size_t>(std::min<std::streamoff>(size, 1000)), '\0');
  file.seekg(size - static_cast<std::streamoff>(text.size()));
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

// The rows go out in bursts of twenty, each when the logger has written the one before: multicast has no way
// to hold a sender back, and the logger's subscription holds 30 messages.
TEST(LcmNetwork, LcmLoggerRecordsEveryRow) {
  in_own_network([] {
    bring_up_network();
    constexpr std::uint64_t kRows = 2000;
    constexpr std::uint64_t kBurst = 20;
    const Directory directory;
    const std::string path = directory.file("logged.lcm");
    LcmPublisher publisher(kUrl, kIdentity);
    ForeignProgram logger(
        {"lcm-logger", "-q", "--flush-interval=1", std::string("--lcm-url=") + kReceiveUrl, path});
    // Sends a mark until it stands in the file, and all that was sent before it with it. The logger looks
    // whether to write its file out whenever a message comes.
    const auto logged = [&](std::uint64_t number) {
      const std::string mark = "MARK_" + std::to_string(number) + ".";
      return wait_until([&] {
        lcm_publish(publisher.instance(), mark.c_str(), "?", 1);
        return tail(path).find(mark) != std::string::npos || !logger.running();
      });
    };
    ASSERT_TRUE(logged(0));
    publisher.begin(kSignals);
    for (std::uint64_t tick = 0; tick < kRows; ++tick) {
      publisher.row({static_cast<std::int64_t>(tick) * 100'000, tick, 0, row_values(tick)});
      ASSERT_TRUE((tick + 1) % kBurst != 0 || logged(tick + 1));
      ASSERT_TRUE(logger.running()) << "lcm-logger has ended with " << logger.status();
    }
    EXPECT_EQ(publisher.reason(), "");
    logger.interrupt();
    logger.status();

    LcmTraceReader reader(path, "KNIFE");
    std::uint64_t rows = 0;
    for (; reader.next(); ++rows) {
      const std::vector<Value> expected = row_values(rows);
      ASSERT_EQ(reader.row().tick, rows);
      for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(reader.row().values[i].u, expected[i].u);
    }
    EXPECT_EQ(rows, kRows);
  });
}

// Rows that a subscriber hears of 10,000 sent in a second.
std::uint64_t heard_in_a_second() {
  constexpr std::uint64_t kRows = 10'000;
  Listener listener;
  LcmPublisher publisher(kUrl, kIdentity);
  publisher.begin(kSignals);
  auto due = std::chrono::steady_clock::now();
  for (std::uint64_t tick = 0; tick < kRows; ++tick) {
    due = std::max(due + std::chrono::microseconds(100),
                   std::chrono::steady_clock::now() - std::chrono::milliseconds(2));
    std::this_thread::sleep_until(due);
    publisher.row({0, tick, 0, row_values(tick)});
  }
  listener.listen(500);
  EXPECT_EQ(publisher.reason(), "");
  EXPECT_EQ(listener.wrong, 0u);
  return listener.rows;
}

// Other work on the machine may keep the receiver from its socket for longer than its buffer lasts, so one
// second out of five has to be without loss.
TEST(LcmNetwork, TenThousandMessagesOf256BytesASecondArrive) {
  in_own_network([] {
    bring_up_network();
    std::uint64_t heard = 0;
    for (int attempt = 0; attempt < 5 && heard < 10'000; ++attempt) heard = heard_in_a_second();
    EXPECT_EQ(heard, 10'000u);
  });
}

TEST(LcmNetwork, LcmLogplayerReplaysALogToASubscriber) {
  in_own_network([] {
    bring_up_network();
    constexpr std::uint64_t kRows = 1500;  // 1.5 s of virtual time
    const Directory directory;
    const std::string path = directory.file("run.lcm");
    LcmLog log(path, kIdentity);
    log.begin(kSignals);
    for (std::uint64_t tick = 0; tick < kRows; ++tick)
      log.row({static_cast<std::int64_t>(tick) * 1'000'000, tick, 0, row_values(tick)});
    log.end();
    ASSERT_EQ(log.reason(), "");

    Listener listener;
    ForeignProgram player({"lcm-logplayer", std::string("--lcm-url=") + kUrl, path});
    EXPECT_TRUE(wait_until([&] {
      listener.listen(100);
      return !player.running();
    }));
    EXPECT_EQ(player.status(), 0);
    listener.listen(1000);
    EXPECT_EQ(listener.rows, kRows);
    EXPECT_EQ(listener.headers, 2u);
    EXPECT_EQ(listener.wrong, 0u);
  });
}

}  // namespace
}  // namespace lockstep::lcm_network_test
