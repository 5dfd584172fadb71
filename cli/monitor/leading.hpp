/// Leading values that cross between controllers, as they are heard on a network.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "hmi_bridge/lcm/leading_values.hpp"

namespace lockstep::cli {

/// A source: what came last of one transfer area.
struct HeardSource {
  leading_value_t value;
  std::uint64_t telegrams = 0;
  std::uint64_t missing = 0;  ///< numbers that have been left out, less those that came late
  std::chrono::steady_clock::time_point last;
};

/// The proxies of one controller on an area, with what has come to them.
struct HeardProxies {
  leading_proxies_t told;
  std::chrono::steady_clock::time_point last;
};

/// All of a network, by channel. Anything may come: there is an end to their number.
class HeardLeadingValues {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMaximum = 200;          ///< sources, and as many proxies
  static constexpr std::size_t kLongestMessage = 4096;  ///< [byte]

  /// Takes any message of the network. @return whether it is one of these
  bool accept(const std::string& channel, std::span<const std::uint8_t> bytes, Clock::time_point now);

  bool empty() const noexcept { return sources_.empty() && proxies_.empty(); }
  const std::map<std::string, HeardSource>& sources() const noexcept { return sources_; }
  const std::map<std::string, HeardProxies>& proxies() const noexcept { return proxies_; }

 private:
  bool accept_source(const std::string& channel, leading_value_t value, Clock::time_point now);
  bool accept_proxies(const std::string& channel, leading_proxies_t told, Clock::time_point now);

  std::map<std::string, HeardSource> sources_;   // by area
  std::map<std::string, HeardProxies> proxies_;  // by area and controller
};

/// Sources and proxies as lines of a table, none longer than `width` columns; none: nothing was heard.
std::vector<std::string> leading_lines(const HeardLeadingValues& values,
                                       HeardLeadingValues::Clock::time_point now, std::size_t width);

}  // namespace lockstep::cli
