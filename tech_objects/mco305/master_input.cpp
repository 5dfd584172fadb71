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
  free_from_ = free_to_ = 0.0;
}

void MasterInput::power_up(const ParameterValues& parameters) noexcept {
  absolute_type_ = wired_ ? parameters[kMasterEncoderAbsType] : 0;
  data_bits_ = parameters[kMasterEncoderDatLen];
}

void MasterInput::pass_pulses(double from, double to) noexcept {
  if (from == to) return;
  const bool forward = from < to;
  const double begin = whole_below(from / turn_), end = whole_below(to / turn_);
  if (begin == end && (forward || begin * turn_ < to)) return note_free(begin);
  for (std::size_t i = 0; i < kMarks; ++i) {
    const double turns = from / turn_;
    const double place = (forward ? std::floor(turns) + 1.0 : std::ceil(turns) - 1.0) * turn_;
    if (forward ? place > to : place < to) return;
    latch(place);
    from = place;
  }
}

/// Most steps are between the same two pulses as the one before, which takes no division to know. A count to
/// both sides is more than what up to 2⁵⁰ qc is lost by rounding, of the quotient or of the bounds.
void MasterInput::note_free(double turn) noexcept {
  constexpr double kFar = 1125899906842624.0, kMargin = 1.0;  // 2⁵⁰; [qc]
  const double begin = turn * turn_;
  const bool exact = std::abs(begin) < kFar && turn_ < kFar;
  free_from_ = exact ? begin + kMargin : 0.0;
  free_to_ = exact ? begin + turn_ - kMargin : 0.0;
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
    reads_absolute_ = absolute_.present();
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

void MasterInput::set_velocity(std::int32_t value) noexcept {
  own_.set_velocity(value);
  begun_ = true;
}

bool MasterInput::move_to(std::int32_t value) noexcept {
  if (!simulated_) return false;
  move(value - shown());
  return true;
}

void MasterInput::show_velocity() noexcept {
  constexpr std::int64_t kSteps = 1000, kLowest = -2147483648LL, kHighest = 2147483647LL;
  real_velocity_ = static_cast<std::int32_t>(
      std::clamp(std::clamp(turned_, -kFastest, kFastest) * kSteps, kLowest, kHighest));
  turned_ = 0;
}

void MasterInput::hand_over_marks() noexcept {
  mark_count_ = next_mark_count_;
  next_mark_count_ = 0;
  marks_ = next_marks_;
}

std::int64_t MasterInput::moved_in(std::int64_t milliseconds) const noexcept {
  const std::int64_t window = std::min({milliseconds, now_, std::int64_t{kRing - 1}});
  return window <= 0 ? 0 : position_ - positions_[static_cast<std::size_t>(now_ - window) % kRing];
}

}  // namespace lockstep::mco305
