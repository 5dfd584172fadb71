/// Markers on what a device moves or is led by, as a sensor sees them: every so many counts, and with what
/// these machines suffer from.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "tech_objects/mco305/units.hpp"

namespace lockstep::mco305 {

/// All in qc of the encoder on whose side the sensor is. The tags are BOOLs; nullptr: never, of `slips`
/// always.
struct MarkerTrackSettings {
  double position = 0.0;           ///< of one of them
  double period = 0.0;             ///< from each to the next; 0: there are none
  double noise = 0.0;              ///< ≥ 0, by how much one may lie off, to either side
  std::int64_t seed = 1;           ///< of that
  double slip = 0.0;               ///< part of the motion that does not get through to the markers, below 1
  const bool* slips = nullptr;     ///< while TRUE
  const bool* missing = nullptr;   ///< while TRUE none is seen
  const bool* spurious = nullptr;  ///< while TRUE there is another one between any two
  const bool* twice = nullptr;     ///< while TRUE each is seen once more a tenth of the period behind it
};

/// Where a marker lies depends on its number alone, so it is there whenever it is passed. Thread: the cycle.
class MarkerTrack {
 public:
  void configure(const MarkerTrackSettings& settings) noexcept {
    settings_ = settings;
    plain_ = settings.slip == 0.0 && settings.missing == nullptr && settings.spurious == nullptr &&
             settings.twice == nullptr;
    free_to_ = exists() ? 0.0 : std::numeric_limits<double>::infinity();
    free_from_ = -free_to_;
  }
  bool exists() const noexcept { return settings_.period > 0.0; }
  /// On the way from one place of the encoder to another, each as long as the last one's end.
  /// @param found is given where the encoder is at each marker, in their order
  template <class Found>
  void pass(double from, double to, Found&& found) noexcept {
    if (!stays_free(to - from)) look_for_marks(from, to, found);
  }
  /// Its first part. Most steps are between the same two markers as the one before, where it is while there
  /// is such a stretch; so it has to be seen only that it does not leave it.
  bool stays_free(double by) noexcept {
    const double carried = carried_ + by;
    if (!plain_ || !(carried > free_from_ && carried < free_to_)) [[unlikely]]
      return false;
    carried_ = carried;
    return true;
  }
  template <class Found>
  [[gnu::noinline]] void look_for_marks(double from, double to, Found&& found) noexcept {
    if (!exists() || from == to) return;
    if (!begun_) carried_ = from;
    begun_ = true;
    const double part = slips() ? 1.0 - settings_.slip : 1.0;
    const double begin = carried_;
    carried_ += (to - from) * part;
    if (on(settings_.missing) || is_free(begin, carried_)) return;
    constexpr int kInATick = 8;  // no sensor is faster
    double at = begin;
    for (int i = 0; i < kInATick; ++i) {
      const std::optional<double> mark = between(at, carried_);
      if (!mark) break;
      found(from + (*mark - begin) / part);
      at = *mark;
    }
    note_free();
  }

 private:
  static constexpr double kBetween = 0.45, kBehind = 0.1;  // of a period

  static bool on(const bool* tag) noexcept { return tag != nullptr && *tag; }
  bool slips() const noexcept {
    return settings_.slip != 0.0 && (settings_.slips == nullptr || *settings_.slips);
  }
  /// Place of a marker, where what bears the markers is.
  double place(double number) const noexcept {
    return settings_.position + number * settings_.period + settings_.noise * noise(number);
  }
  double number_below(double carried) const noexcept {
    return whole_below((carried - settings_.position) / settings_.period);
  }
  /// The first one met on the way; one where it begins is none.
  std::optional<double> between(double from, double to) const noexcept {
    const double step = from < to ? 1.0 : -1.0, last = number_below(to) + step;
    constexpr int kMany = 64;  // periods of a tick
    std::optional<double> met;
    double number = number_below(from) - step;
    for (int i = 0; i < kMany; ++i, number += step) {
      const auto look = [&](double there) noexcept {
        const bool passed = from < to ? from < there && there <= to : to <= there && there < from;
        if (passed && (!met || (there < *met) == (from < to))) met = there;
      };
      look(place(number));
      if (on(settings_.spurious))
        look(settings_.position + number * settings_.period + kBetween * settings_.period);
      if (on(settings_.twice)) look(place(number) + step * kBehind * settings_.period);
      if (number == last) break;
    }
    return met;
  }
  /// Whether a step lies between the same two markers as the one before, of a track with tags, too: it takes
  /// no division to know.
  bool is_free(double from, double to) const noexcept {
    return from > free_from_ && from < free_to_ && to > free_from_ && to < free_to_ &&
           !on(settings_.spurious) && !on(settings_.twice);
  }
  /// The markers between which it is. Of those that may lie less than half a period off these are among the
  /// next ones to both sides.
  void note_free() noexcept {
    free_from_ = free_to_ = 0.0;
    if (!(settings_.noise < 0.5 * settings_.period)) return;
    constexpr double kFar = 1e9;  // periods: from there on rounding counts
    const double number = number_below(carried_);
    if (!(std::abs(number) < kFar)) return;
    double begin = -std::numeric_limits<double>::infinity(), end = -begin;
    for (int i = -2; i <= 3; ++i) {
      const double one = place(number + i);
      if (one <= carried_) begin = std::max(begin, one);
      if (one >= carried_) end = std::min(end, one);
    }
    free_from_ = begin;
    free_to_ = end;
  }
  /// -1 … 1, of a marker of this number.
  double noise(double number) const noexcept {
    if (settings_.noise == 0.0) return 0.0;
    constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15ULL;
    auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(number)) +
                kOdd * (1 + static_cast<std::uint64_t>(settings_.seed));
    bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9ULL;
    bits = (bits ^ bits >> 27) * 0x94D049BB133111EBULL;
    bits ^= bits >> 31;
    constexpr double kUnit = 1.0 / 9007199254740992.0;  // 2^-53
    return 2.0 * static_cast<double>(bits >> 11) * kUnit - 1.0;
  }

  bool begun_ = false;
  bool plain_ = true;                       // nothing but period and noise
  double carried_ = 0.0;                    // where what bears the markers is
  double free_from_ = 0.0, free_to_ = 0.0;  // between these there is no marker; the same: nothing is known
  MarkerTrackSettings settings_;
};

}  // namespace lockstep::mco305
