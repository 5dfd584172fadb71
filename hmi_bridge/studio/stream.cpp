#include "hmi_bridge/studio/stream.hpp"

#include <algorithm>

#include "hmi_bridge/studio/frames.hpp"

namespace lockstep {

void StudioStream::subscribe(std::uint32_t id, std::vector<std::size_t> signals, const TraceStore& store) {
  unsubscribe(id);
  subscriptions_.push_back({id, std::move(signals), store.end(), 0, store.end()});
}

void StudioStream::unsubscribe(std::uint32_t id) {
  std::erase_if(subscriptions_, [id](const Subscription& one) { return one.id == id; });
}

void StudioStream::acknowledge(std::uint32_t frame) noexcept {
  const auto is_drawn = [this, frame](const Sent& one) {
    return frame <= frame_ && static_cast<std::int32_t>(one.frame - frame) <= 0;
  };
  while (!sent_.empty() && is_drawn(sent_.front())) {
    bytes_ -= sent_.front().bytes;
    sent_.pop_front();
  }
}

/// What the store has forgotten, and what never came, before the next row.
void StudioStream::count_gaps(Subscription& subscription, const TraceStore& store) {
  if (subscription.row < store.begin()) {
    subscription.dropped += store.begin() - subscription.row;
    subscription.row = store.begin();
  }
  for (const TraceStore::Gap& gap : store.gaps())
    if (gap.row >= subscription.counted && gap.row <= subscription.row) subscription.dropped += gap.missing;
  subscription.counted = std::max(subscription.counted, subscription.row + 1);
}

std::vector<std::uint8_t> StudioStream::frame_of(Subscription& subscription, const TraceStore& store) {
  count_gaps(subscription, store);
  std::uint64_t end = store.end();
  const std::uint64_t rows = end - subscription.row;
  StudioFrameHead head{StudioFrameKind::rows, subscription.id, ++frame_, subscription.dropped};
  TraceWindow window;
  if (rows > kRows) {
    head.kind = StudioFrameKind::coarse;
    window = store.coarse(subscription.signals, subscription.row, end, (rows + kPoints - 1) / kPoints);
  } else {
    // Rows are joined by the page within a frame only where none is missing.
    for (const TraceStore::Gap& gap : store.gaps())
      if (gap.row > subscription.row) end = std::min(end, gap.row);
    window = store.rows(subscription.signals, subscription.row, end);
  }
  subscription.row = end;
  return encode_frame(head, window);
}

std::optional<std::vector<std::uint8_t>> StudioStream::next(const TraceStore& store) {
  if (sent_.size() >= kFrames || bytes_ >= kBytes) return {};
  for (std::size_t i = 0; i < subscriptions_.size(); ++i) {
    Subscription& subscription = subscriptions_[++turn_ % subscriptions_.size()];
    if (subscription.row >= store.end()) continue;
    std::vector<std::uint8_t> frame = frame_of(subscription, store);
    sent_.push_back({frame_, frame.size()});
    bytes_ += frame.size();
    return frame;
  }
  return {};
}

}  // namespace lockstep
