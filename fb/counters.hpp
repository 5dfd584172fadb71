/// Counters. They count rising edges; a first call with the count input TRUE counts, since the memory of the
/// edge starts FALSE. The count stops at the limits of its type and never wraps. While a level input (reset,
/// load) acts, edges are lost: one that rose meanwhile does not count later.
/// @source IEC 61131-3:2013, 6.6.3.5.4, table 45
#pragma once

#include <limits>

#include "fb/block.hpp"

namespace lockstep {

/// Counts up, in an integer type. Q is formed in every call, so it is TRUE with CV = 0 and PV ≤ 0.
template <class Count>
struct UpCounter : Block {
  BOOL CU{};
  BOOL R{};
  Count PV{};
  BOOL Q{};
  Count CV{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.4";
  static constexpr auto kPins = pins(
      in<&UpCounter::CU>("CU", Unit::kNone, kAny, "counts up with its rising edge"),
      in<&UpCounter::R>("R", Unit::kNone, kAny, "holds the count at 0"),
      in<&UpCounter::PV>("PV", Unit::kNone, kAny, "preset that Q compares with"),
      out<&UpCounter::Q>("Q", "the count has reached the preset"), out<&UpCounter::CV>("CV", "the count"));

 private:
  bool cu_memory_ = false;
};

/// Counts down, in an integer type. Before the first load CV is 0 and Q is TRUE from the first call on.
template <class Count>
struct DownCounter : Block {
  BOOL CD{};
  BOOL LD{};
  Count PV{};
  BOOL Q{};
  Count CV{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.4";
  static constexpr auto kPins =
      pins(in<&DownCounter::CD>("CD", Unit::kNone, kAny, "counts down with its rising edge"),
           in<&DownCounter::LD>("LD", Unit::kNone, kAny, "holds the count at PV"),
           in<&DownCounter::PV>("PV", Unit::kNone, kAny, "preset to load"),
           out<&DownCounter::Q>("Q", "the count is 0 or less"), out<&DownCounter::CV>("CV", "the count"));

 private:
  bool cd_memory_ = false;
};

/// Counts both ways, in an integer type. R ranks above LD, LD above counting; edges of CU and CD in one call
/// cancel.
template <class Count>
struct UpDownCounter : Block {
  BOOL CU{};
  BOOL CD{};
  BOOL R{};
  BOOL LD{};
  Count PV{};
  BOOL QU{};
  BOOL QD{};
  Count CV{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.4";
  static constexpr auto kPins = pins(
      in<&UpDownCounter::CU>("CU", Unit::kNone, kAny, "counts up with its rising edge"),
      in<&UpDownCounter::CD>("CD", Unit::kNone, kAny, "counts down with its rising edge"),
      in<&UpDownCounter::R>("R", Unit::kNone, kAny, "holds the count at 0, whatever LD says"),
      in<&UpDownCounter::LD>("LD", Unit::kNone, kAny, "holds the count at PV"),
      in<&UpDownCounter::PV>("PV", Unit::kNone, kAny, "preset to load and that QU compares with"),
      out<&UpDownCounter::QU>("QU", "the count has reached the preset"),
      out<&UpDownCounter::QD>("QD", "the count is 0 or less"), out<&UpDownCounter::CV>("CV", "the count"));

 private:
  bool cu_memory_ = false;
  bool cd_memory_ = false;
};

/// Counts up.
struct CTU final : UpCounter<INT> {
  static constexpr std::string_view kName = "CTU";
  static constexpr std::string_view kText = "Counts up.";
};

/// Counts down.
struct CTD final : DownCounter<INT> {
  static constexpr std::string_view kName = "CTD";
  static constexpr std::string_view kText = "Counts down.";
};

/// Counts both ways.
struct CTUD final : UpDownCounter<INT> {
  static constexpr std::string_view kName = "CTUD";
  static constexpr std::string_view kText = "Counts up and down.";
};

namespace counting {

template <class Count>
Count one_up(Count count) noexcept {
  return count < std::numeric_limits<Count>::max() ? static_cast<Count>(count + 1) : count;
}

template <class Count>
Count one_down(Count count) noexcept {
  return count > std::numeric_limits<Count>::min() ? static_cast<Count>(count - 1) : count;
}

}  // namespace counting

template <class Count>
void UpCounter<Count>::call(std::int64_t /*now*/) noexcept {
  const bool up = CU && !cu_memory_;
  cu_memory_ = CU;
  if (R)
    CV = 0;
  else if (up)
    CV = counting::one_up(CV);
  Q = CV >= PV;
}

template <class Count>
void DownCounter<Count>::call(std::int64_t /*now*/) noexcept {
  const bool down = CD && !cd_memory_;
  cd_memory_ = CD;
  if (LD)
    CV = PV;
  else if (down)
    CV = counting::one_down(CV);
  Q = CV <= 0;
}

template <class Count>
void UpDownCounter<Count>::call(std::int64_t /*now*/) noexcept {
  const bool up = CU && !cu_memory_;
  const bool down = CD && !cd_memory_;
  cu_memory_ = CU;
  cd_memory_ = CD;
  if (R)
    CV = 0;
  else if (LD)
    CV = PV;
  else if (up && !down)
    CV = counting::one_up(CV);
  else if (down && !up)
    CV = counting::one_down(CV);
  QU = CV >= PV;
  QD = CV <= 0;
}

}  // namespace lockstep
