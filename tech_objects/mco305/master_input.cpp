#include "tech_objects/mco305/master_input.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep::mco305 {

void MasterInput::refresh(const ParameterValues& parameters, bool later_edition) noexcept {
  type_ = parameters[kMasterEncoderType];
  if (later_edition && encoder_input_of(type_) != 0) type_ %= 10;
  simulated_ = type_ == kSimulated || (!wired_ && parameters[kMasterEncoderAbsType] == kSimulated);
  resolution_ = parameters[kMasterEncoderAbsRes];
  const MarkerType marker = marker_type_of(parameters[kMarkerTypeMaster], later_edition);
  marker_type_ = marker.type;
  enabling_input_ = marker.input;
  turn_ = 4.0 * parameters.real(kMasterEncoder);
}

void MasterInput::power_up(const ParameterValues& parameters) noexcept {
  absolute_type_ = wired_ ? parameters[kMasterEncoderAbsType] : 0;
  data_bits_ = parameters[kMasterEncoderDatLen];
}

void MasterInput::move(std::int64_t counts) noexcept {
  begun_ = begun_ || counts != 0;
  position_ = within_reach(position_ + counts);
}

/// The zero pulse of the encoder, or the markers that the sensor at input 5 sees.
void MasterInput::pass(double from, double to) noexcept {
  if (from == to) return;
  if (marker_type_ >= 2) return track_.pass(from, to, [this](double place) { latch(place); });
  const bool forward = from < to;
  // Most steps are between two pulses.
  const double begin = whole_below(from / turn_), end = whole_below(to / turn_);
  if (begin == end && (forward || begin * turn_ < to)) return;
  for (std::size_t i = 0; i < kMarks; ++i) {
    const double turns = from / turn_;
    const double place = (forward ? std::floor(turns) + 1.0 : std::ceil(turns) - 1.0) * turn_;
    if (forward ? place > to : place < to) return;
    latch(place);
    from = place;
  }
}

void MasterInput::latch(double place) noexcept {
  if (marker_type_ >= 2 && !enabled_) return;
  latched_ = counts_of(place);
  ++latches_;
  if (next_mark_count_ < kMarks) next_marks_[next_mark_count_++] = static_cast<double>(latched_);
}

void MasterInput::mark(double place) noexcept {
  if (marker_type_ >= 2) latch(place);
}

void MasterInput::turn(double encoder) noexcept {
  const std::int64_t whole = counts_of(encoder);
  const std::int64_t counts = heard_ ? whole - shown_encoder_ : 0;
  const double last = encoder_;
  encoder_ = encoder;
  shown_encoder_ = whole;
  if (!heard_) {
    heard_ = true;
    absolute_.configure(absolute_type_, data_bits_, whole);
    read_ = whole;
    if (absolute_.present()) last_ = position_ = absolute_.position();
    return;
  }
  turned_ += counts;
  if (absolute_.present()) return pass_absolute(last, encoder);
  if (own_.active() || type_ == 0 || type_ == kSimulated || encoder == last) return;
  // Between two counts it is where the encoder is.
  const double begin = static_cast<double>(position_) + (last - whole_below(last));
  move(counts);
  pass(begin, begin + (encoder - last));
}

/// It is read in each millisecond; its markers, which are external ones, are where it is.
void MasterInput::pass_absolute(double from, double to) noexcept {
  if (own_.active() || marker_type_ < 2 || from == to) return;
  const auto beside = static_cast<double>(position_ - read_);
  pass(from + beside, to + beside);
}

void MasterInput::read_absolute() noexcept {
  const std::int64_t before = absolute_.position();
  absolute_.read(shown_encoder_, disturbed_ == nullptr ? 0 : *disturbed_, resolution_);
  read_ = shown_encoder_;
  if (!own_.active()) move(absolute_.position() - before);
}

void MasterInput::exchange(std::int64_t& position, std::int64_t& origin) noexcept {
  const std::int64_t moved = position - position_;
  std::swap(position_, position);
  std::swap(origin_, origin);
  last_ += moved;
  for (std::int64_t& one : positions_) one += moved;
  begun_ = true;
}

void MasterInput::look_at_marker(bool level, bool enabled) noexcept {
  enabled_ = enabled;
  if (marker_type_ >= 2 && level != last_level_ && level == (marker_type_ == 2))
    latch(static_cast<double>(position_));
  last_level_ = level;
}

void MasterInput::set_velocity(std::int32_t value) noexcept {
  own_.set_velocity(value);
  begun_ = true;
}

bool MasterInput::move_to(std::int32_t value) noexcept {
  if (!simulated_) return false;
  move(value - shown());
  return true;
}

void MasterInput::step() noexcept {
  if (absolute_.present()) read_absolute();
  if (own_.active()) {
    const auto begin = static_cast<double>(position_);
    move(own_.step());
    pass(begin, static_cast<double>(position_));
  }
  constexpr std::int64_t kFar = std::int64_t{1} << 30;  // what a gear takes in a step; nothing real is faster
  moved_ = std::clamp(position_ - last_, -kFar, kFar);
  last_ = position_;
  real_velocity_ = static_cast<std::int32_t>(
      std::clamp<std::int64_t>(std::clamp(turned_, -kFar, kFar) * 1000, -2147483648LL, 2147483647LL));
  turned_ = 0;
  mark_count_ = next_mark_count_;
  next_mark_count_ = 0;
  if (mark_count_ != 0) marks_ = next_marks_;
  ++now_;
  positions_[static_cast<std::size_t>(now_) % kRing] = position_;
}

std::int64_t MasterInput::moved_in(std::int64_t milliseconds) const noexcept {
  const std::int64_t window = std::min({milliseconds, now_, std::int64_t{kRing - 1}});
  return window <= 0 ? 0 : position_ - positions_[static_cast<std::size_t>(now_ - window) % kRing];
}

}  // namespace lockstep::mco305
