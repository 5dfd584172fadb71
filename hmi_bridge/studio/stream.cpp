#include "hmi_bridge/studio/stream.hpp"

#include <algorithm>

#include "hmi_bridge/studio/frames.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t kRowsAtOnce = 65'536;  // that are looked at, of which some are sent

/// The first number from one on that another divides.
std::uint64_t multiple_from(std::uint64_t number, std::uint64_t of) noexcept {
  return (number + of - 1) / of * of;
}

/// Each so manieth element, from the first on.
template <class Value>
void thin_out(std::vector<Value>& values, std::uint64_t every) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += every) values[kept++] = values[i];
  values.resize(kept);
}

void thin_out(TraceWindow& window, std::uint64_t every) {
  if (every == 1) return;
  thin_out(window.t, every);
  thin_out(window.tick, every);
  for (TraceWindow::Column& column : window.columns) thin_out(column.first, every);
}

}  // namespace

void StudioStream::subscribe(std::uint32_t id, std::vector<std::size_t> signals, const TraceStore& store,
                             std::uint64_t every) {
  unsubscribe(id);
  every = std::clamp<std::uint64_t>(every, 1, kSparsest);
  const std::uint64_t first = multiple_from(store.end(), every);
  subscriptions_.push_back({id, std::move(signals), first, 0, store.end(), every});
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
    subscription.row = multiple_from(store.begin(), subscription.every);
  }
  for (const TraceStore::Gap& gap : store.gaps())
    if (gap.row >= subscription.counted && gap.row <= subscription.row) subscription.dropped += gap.missing;
  subscription.counted = std::max(subscription.counted, subscription.row + 1);
}

std::vector<std::uint8_t> StudioStream::frame_of(Subscription& subscription, const TraceStore& store) {
  count_gaps(subscription, store);
  std::uint64_t end = store.end();
  const std::uint64_t every = subscription.every;
  const std::uint64_t rows = (end - subscription.row + every - 1) / every;
  StudioFrameHead head{StudioFrameKind::rows, subscription.id, ++frame_, subscription.dropped};
  TraceWindow window;
  if (rows > kRows) {
    head.kind = StudioFrameKind::coarse;
    window =
        store.coarse(subscription.signals, subscription.row, end, (rows + kPoints - 1) / kPoints * every);
  } else {
    if (every > 1) end = std::min(end, subscription.row + kRowsAtOnce);
    // Rows are joined by the page within a frame only where none is missing.
    for (const TraceStore::Gap& gap : store.gaps())
      if (gap.row > subscription.row) end = std::min(end, gap.row);
    window = store.rows(subscription.signals, subscription.row, end);
    thin_out(window, every);
  }
  subscription.row = multiple_from(end, every);
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
