/// What triggers have caught: traces of their own, the newest of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "hmi_bridge/traces/store.hpp"

namespace lockstep {

/// A part of a run around an occasion.
struct StudioShot {
  std::string id;      ///< "shot-1", and so on
  std::string reason;  ///< what the trigger waited for
  std::int64_t t = 0;  ///< of the occasion [ns]
  TraceStore store;
};

/// Not for several threads at once.
class StudioShots {
 public:
  static constexpr std::size_t kShots = 50;
  static constexpr std::size_t kBytes = std::size_t{128} << 20;  ///< of all, but for the newest

  const StudioShot& add(std::string reason, std::int64_t t, TraceStore store);
  const StudioShot* find(std::string_view id) const noexcept;
  StudioShot* find(std::string_view id) noexcept;
  /// @return false: there is no such shot
  bool remove(std::string_view id);
  const std::deque<StudioShot>& all() const noexcept { return shots_; }

 private:
  std::deque<StudioShot> shots_;
  std::uint64_t number_ = 0;
};

}  // namespace lockstep
