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
    free_from_ = free_to_ = 0.0;
    constexpr int kInATick = 8;  // no sensor is faster
    double at = begin;
    for (int i = 0; i < kInATick; ++i) {
      const std::optional<double> mark = between(at, carried_);
      if (!mark) break;
      found(from + (*mark - begin) / part);
      at = *mark;
    }
    if (!(carried_ > free_from_ && carried_ < free_to_)) free_from_ = free_to_ = 0.0;
  }

 private:
  static constexpr double kBetween = 0.45, kBehind = 0.1;  // of a period
  static constexpr double kNear = 1e-3;                    // [qc]

  static bool on(const bool* tag) noexcept { return tag != nullptr && *tag; }
  bool slips() const noexcept {
    return settings_.slip != 0.0 && (settings_.slips == nullptr || *settings_.slips);
  }
  /// The first one met on the way; one where it begins is none.
  std::optional<double> between(double from, double to) noexcept {
    const double period = settings_.period;
    const double turns = (from - settings_.position) / period, end = (to - settings_.position) / period;
    const double first = whole_below(turns), last = whole_below(end);
    constexpr double kPrecision = 1e-14;
    const double rounding = kNear + kPrecision * (std::abs(from) + std::abs(settings_.position));
    if (first == last && far_from_any(turns - first, rounding) && far_from_any(end - first, rounding)) {
      note_free(first, 2.0 * rounding);
      return std::nullopt;
    }
    const double step = from < to ? 1.0 : -1.0;
    constexpr int kMany = 64;  // periods of a tick
    std::optional<double> met;
    double number = first - step;
    for (int i = 0; i < kMany; ++i, number += step) {
      const auto look = [&](double place) noexcept {
        const bool passed = from < to ? from < place && place <= to : to <= place && place < from;
        if (passed && (!met || (place < *met) == (from < to))) met = place;
      };
      const double base = settings_.position + number * period;
      const double mark = base + settings_.noise * noise(number);
      look(mark);
      if (on(settings_.spurious)) look(base + kBetween * period);
      if (on(settings_.twice)) look(mark + kBehind * period);
      if (number == last + step) break;
    }
    return met;
  }
  /// Whether a step lies between the same two markers as the one before, of a track with tags, too: it takes
  /// no division to know.
  bool is_free(double from, double to) const noexcept {
    return from > free_from_ && from < free_to_ && to > free_from_ && to < free_to_ &&
           !on(settings_.spurious) && !on(settings_.twice);
  }
  /// @param number of a marker, behind which there is none until the next  @param margin [qc] to both
  void note_free(double number, double margin) noexcept {
    const double begin = settings_.position + number * settings_.period;
    free_from_ = begin + (settings_.noise + margin);
    free_to_ = begin + settings_.period - (settings_.noise + margin);
  }
  /// Most steps are between two markers, and have nothing to look for. @param part of a period, 0 … 1
  bool far_from_any(double part, double rounding) const noexcept {
    if (on(settings_.spurious) || on(settings_.twice)) return false;
    const double distance = std::min(part, 1.0 - part) * settings_.period;
    return distance > settings_.noise + rounding;
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
