/// What lies between the controllers of a simulated system.
#pragma once

#include <cstdint>
#include <vector>

#include "projects/keys/system.hpp"
#include "tech_objects/leading_values/telegram.hpp"

namespace lockstep {

/// The telegrams of one leading object on their way to one proxy. What is by chance comes from a generator
/// of its own, so that no link changes another one; the same seed gives the same bits. Times are those that
/// all controllers share.
class SimulatedLink {
 public:
  /// @param index of the link in its system
  SimulatedLink(const SimulatedNetwork& network, std::uint64_t index) noexcept;

  /// A telegram goes out. @param now [ns]
  void send(const LeadingValueTelegram& telegram, std::int64_t now);

  /// Hands what has arrived to `use`, in the order of arrival, and forgets it. What goes out in a tick never
  /// arrives in one of the same time, so that the order of controllers in a tick does not count.
  /// @param now of the tick of the receiver [ns]
  template <class Use>
  void take(std::int64_t now, Use use) {
    while (!in_transit_.empty() && in_transit_.front().arrival <= now && in_transit_.front().sent < now) {
      use(in_transit_.front().telegram);
      in_transit_.erase(in_transit_.begin());
    }
  }

  std::uint64_t lost() const noexcept { return lost_; }

 private:
  struct InTransit {
    std::int64_t arrival;  // [ns]
    std::int64_t sent;     // [ns]
    LeadingValueTelegram telegram;
  };
  double chance() noexcept;
  void put(const LeadingValueTelegram& telegram, std::int64_t now);

  const SimulatedNetwork network_;
  std::uint64_t state_;
  std::vector<InTransit> in_transit_;  // by arrival, then as they went out
  std::uint64_t lost_ = 0;
};

}  // namespace lockstep
