/// What the pages of a run want to see, on its path from the cycle into a store.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hmi_bridge/traces/columns.hpp"
#include "hmi_bridge/traces/store.hpp"
#include "projects/studio/derived.hpp"
#include "projects/studio/units.hpp"
#include "scheduler/signal_tap.hpp"

namespace lockstep {

/// Keeps the ring of a tap to what is wanted, and the store to what has come. Thread: the server's, but for
/// the tap's other side.
class StudioFeed {
 public:
  static constexpr std::size_t kSignals = 1024;                  ///< at once
  static constexpr std::size_t kBytes = std::size_t{256} << 20;  ///< of what is kept

  /// @param project, units outlive this  @param history that is kept [ns]
  StudioFeed(const Project& project, const StudioUnits& units, std::int64_t history)
      : project_(project), units_(units), store_({history, kBytes}) {}

  /// What is wanted from now on, at most `kSignals`; each name once.
  void want(std::vector<NamedSignal> signals);
  /// Hands over what is wanted as soon as the cycle takes it, and fetches rows.
  void look();

  std::size_t wanted() const noexcept { return wanted_.size(); }
  SignalTap& tap() noexcept { return tap_; }
  const TraceStore& store() const noexcept { return store_; }
  /// Index of a signal in the store, which is made for it if nobody has wanted it yet.
  std::size_t index(const NamedSignal& signal);
  /// Whether the newest row has a signal.
  bool is_in_newest(std::size_t index) const noexcept;
  std::uint64_t dropped() const noexcept { return dropped_; }  ///< rows that found the tap's ring full

 private:
  /// A signal that is computed of the ring's.
  struct Computed {
    std::shared_ptr<StudioDerived> derived;
    std::vector<std::size_t> operands;  // columns of the ring
  };
  /// What a ring holds, and what comes of it.
  struct Ring {
    std::vector<TraceSignal> signals;  // computed ones behind the others
    std::vector<Computed> computed;
  };

  void take(const SignalTap::Row& row);
  void add_computed(const NamedSignal& signal, std::vector<NamedSignal>& plain, Ring& ring);
  TraceSignal described(const NamedSignal& signal) const;

  const Project& project_;
  const StudioUnits& units_;
  SignalTap tap_;
  TraceStore store_;
  std::vector<NamedSignal> wanted_;
  bool handed_over_ = true;                                        // what is wanted
  std::map<std::uint64_t, Ring> rings_;                            // not read to their end, by number
  std::map<std::string, std::shared_ptr<StudioDerived>> derived_;  // that are wanted, by path
  std::vector<Value> values_;                                      // of the row at hand
  std::vector<std::size_t> newest_;                                // signals of the newest row
  std::uint64_t ring_ = 0;                                         // whose signals the store has been told
  std::uint64_t dropped_ = 0;
};

}  // namespace lockstep
