/// The keys of a network that carries leading values between processes.
#pragma once

#include <cstdint>
#include <string>

#include "projects/json/addresses.hpp"
#include "projects/json/key.hpp"
#include "scheduler/shared_clock.hpp"

namespace lockstep {

/// How telegrams travel in real time.
struct NetworkConfig {
  /// URL. With a time to live of 0 nothing leaves the machine.
  std::string lcm = "udpm://239.255.76.67:7667?ttl=0";
  SharedClockKind clock = SharedClockKind::monotonic;
  std::int64_t clock_error = 2'000'000;  ///< largest one of a clock that PTP disciplines [ns]
  std::string key_file;                  ///< with which telegrams are signed; empty: they are not
  std::string
      controller;  ///< by which others know this one, if there is no system; empty: the project's name
};

namespace keys {

inline constexpr Word kSharedClocks[] = {{"monotonic", static_cast<int>(SharedClockKind::monotonic)},
                                         {"tai", static_cast<int>(SharedClockKind::tai)}};

inline constexpr auto kNetwork = key_table<NetworkConfig>(
    key::text<&NetworkConfig::lcm>("lcm", "network on which telegrams travel")
        .of_form(kLcmUrlForm)
        .otherwise_is("udpm://239.255.76.67:7667?ttl=0, which stays on this machine"),
    key::word<&NetworkConfig::clock>("clock", kSharedClocks, "that all controllers share"),
    key::duration<&NetworkConfig::clock_error>("clock_error", {1'000, 1e9},
                                               "with 'tai': largest error of the clock with which it counts"),
    key::title<&NetworkConfig::key_file>(
        "key_file", "file of a key with which telegrams are signed, relative to this one")
        .otherwise_is("they are not signed"));
/// Of a project that belongs to no system.
inline constexpr auto kProjectNetwork =
    joined(kNetwork, key_table<NetworkConfig>(
                         key::title<&NetworkConfig::controller>("controller", "by which others know this one")
                             .otherwise_is("the name of the project")));

}  // namespace keys
}  // namespace lockstep
