#include "projects/studio/shots.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lockstep {

const StudioShot& StudioShots::add(std::string reason, std::int64_t t, TraceStore store) {
  shots_.push_back({"shot-" + std::to_string(++number_), std::move(reason), t, std::move(store)});
  const auto bytes = [this] {
    return std::accumulate(shots_.begin(), shots_.end(), std::size_t{0},
                           [](std::size_t sum, const StudioShot& shot) { return sum + shot.store.bytes(); });
  };
  while (shots_.size() > kShots || (shots_.size() > 1 && bytes() > kBytes)) shots_.pop_front();
  return shots_.back();
}

const StudioShot* StudioShots::find(std::string_view id) const noexcept {
  const auto found =
      std::find_if(shots_.begin(), shots_.end(), [id](const StudioShot& shot) { return shot.id == id; });
  return found == shots_.end() ? nullptr : &*found;
}

StudioShot* StudioShots::find(std::string_view id) noexcept {
  const auto found = std::ranges::find(shots_, id, &StudioShot::id);
  return found == shots_.end() ? nullptr : &*found;
}

bool StudioShots::remove(std::string_view id) {
  return std::erase_if(shots_, [id](const StudioShot& shot) { return shot.id == id; }) != 0;
}

}  // namespace lockstep
