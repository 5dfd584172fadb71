/// The keys of a system file: the controllers of a machine, and how their leading values travel.
/// @source S7-1500T synchronous operation V7, chapter 10
#pragma once

#include <cstdint>
#include <string>

#include "projects/keys/network.hpp"
#include "projects/keys/parts.hpp"

namespace lockstep {

/// What lies between the controllers of a simulated system. Each telegram travels by itself: for `latency`,
/// more or less by up to `jitter`, evenly spread; never into the past.
struct SimulatedNetwork {
  std::int64_t latency = 0;  ///< [ns]
  std::int64_t jitter = 0;   ///< [ns]
  double loss = 0.0;         ///< share that does not arrive
  double duplicates = 0.0;   ///< share that arrives twice
  double reordering = 0.0;   ///< share that arrives up to four cycles of its source later
  std::uint64_t seed = 1;
};

namespace keys {

inline constexpr double kLongestTransfer = 10e9;  // [ns]
inline constexpr int kSystemVersions[] = {1};

inline constexpr auto kSystemController =
    key_table<void>(key::title("project", "its project file, relative to this one").needed(),
                    key::duration("phase", {0, 1e9},
                                  "of its ticks behind whole cycles of the common time, in a simulation; "
                                  "less than its servo cycle")
                        .otherwise_is("0ns"),
                    key::text("address", "in real time: from which its telegrams come, or several of them")
                        .of_form(kSenderForm)
                        .one_or_list()
                        .otherwise_is("any"));
inline constexpr auto kSystemArea = key_table<void>(
    key::text("from", "CONTROLLER.OBJECT that provides its leading value").needed(),
    key::integer("interface", {1.0, 8.0}, "which CrossPlcSynchronousOperation.Interface of it provides it")
        .otherwise_is("1"),
    key::text("to", "CONTROLLER.PROXY that takes it, or several of them").one_or_list().needed());
inline constexpr auto kSimulatedNetwork = key_table<SimulatedNetwork>(
    key::duration<&SimulatedNetwork::latency>("latency", {0, kLongestTransfer}, "of a telegram"),
    key::duration<&SimulatedNetwork::jitter>("jitter", {0, kLongestTransfer},
                                             "by which that is more or less"),
    key::number<&SimulatedNetwork::loss>("loss", {0.0, 1.0}, "", "share of telegrams that do not arrive"),
    key::number<&SimulatedNetwork::duplicates>("duplicates", {0.0, 1.0}, "", "share that arrives twice"),
    key::number<&SimulatedNetwork::reordering>("reordering", {0.0, 1.0}, "",
                                               "share that arrives up to four cycles of its source later"),
    key::integer<&SimulatedNetwork::seed>("seed", {0, 4294967295.0}, "of what is by chance"));
inline constexpr auto kDelays = key_table<void>(
    key::text("fixed", "CONTROLLER.OBJECT whose delay stays as it is configured").list(),
    key::text("left_out", "CONTROLLER.AXIS whose interconnection with a proxy does not count").list());

inline constexpr auto kSystem = key_table<void>(
    kSchema, key::one_of("lockstep_system", kSystemVersions, "version of the format").needed(),
    key::title("name", "name of the system").needed(), key::text("description", "what the system does"),
    key::structure("controllers", kSystemController, "name: controller, which runs one project")
        .named()
        .needed(),
    key::structure("transfer_areas", kSystemArea, "name: path of a leading value to proxies").named(),
    key::structure("network", kNetwork, "by which telegrams travel in real time"),
    key::structure("simulated_network", kSimulatedNetwork,
                   "what lies between the controllers in a simulation"),
    key::structure("delays", kDelays, "what the calculation of delays leaves out"));

}  // namespace keys
}  // namespace lockstep
