/// Traces on an LCM network.
#pragma once

#include <lcm/lcm.h>

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "hmi_bridge/lcm/messages.hpp"
#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// Publishes a trace on the network of a URL: the rows on the channel, the header on CHANNEL_HEADER before
/// the first row and then every second. Nobody has to listen. What cannot be sent is counted and not sent
/// again.
class LcmPublisher final : public TraceSink {
 public:
  static constexpr std::chrono::seconds kHeaderPeriod{1};

  /// Joins the network. Any thread; all publishing is then on the recorder's.
  /// @param url `udpm://ADDRESS:PORT?ttl=N`, or `memq://` for subscribers of `instance()` alone
  /// @throws std::runtime_error that names the URL: no multicast route, an address that is none;
  ///     std::invalid_argument for a channel that is empty or too long
  /// @param events whether events are published as well, on CHANNEL_EVENTS
  LcmPublisher(const std::string& url, LcmTraceIdentity identity, bool events = true);

  void begin(std::span<const TraceSignal> signals) override;
  void row(const TraceRow& row) override;
  void event(const TraceEvent& event) override;
  void flush() override;
  void end() override;
  std::string_view name() const noexcept override { return url_; }

  /// The LCM instance, to subscribe on; LCM's own functions are thread-safe.
  lcm_t* instance() noexcept { return lcm_.get(); }

 private:
  struct Destroy {
    void operator()(lcm_t* lcm) const noexcept { lcm_destroy(lcm); }
  };
  void publish(const std::string& channel, std::span<const std::uint8_t> bytes, std::uint64_t rows);
  void publish_header();

  const std::string url_;
  const LcmTraceIdentity identity_;
  const std::string header_channel_;
  const std::string events_channel_;
  const std::string detail_channel_;
  const bool events_;
  const std::unique_ptr<lcm_t, Destroy> lcm_;
  std::optional<LcmEncoder> encoder_;
  std::chrono::steady_clock::time_point next_header_;
};

}  // namespace lockstep
