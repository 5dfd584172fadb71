/// Counters. They count rising edges; a first call with the count input TRUE counts, since the memory of the
/// edge starts FALSE. The count stops at the limits of INT and never wraps. While a level input (reset, load)
/// acts, edges are lost: one that rose meanwhile does not count later.
/// @source IEC 61131-3:2013, 6.6.3.5.4, table 45
#pragma once

#include "fb/block.hpp"

namespace lockstep {

/// Counts up. Q is formed in every call, so it is TRUE with CV = 0 and PV ≤ 0.
struct CTU final : Block {
  BOOL CU{};
  BOOL R{};
  INT PV{};
  BOOL Q{};
  INT CV{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "CTU";
  static constexpr std::string_view kText = "Counts up.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.4";
  static constexpr auto kPins =
      pins(in<&CTU::CU>("CU", Unit::kNone, kAny, "counts up with its rising edge"),
           in<&CTU::R>("R", Unit::kNone, kAny, "holds the count at 0"),
           in<&CTU::PV>("PV", Unit::kNone, kAny, "preset that Q compares with"),
           out<&CTU::Q>("Q", "the count has reached the preset"), out<&CTU::CV>("CV", "the count"));

 private:
  bool cu_memory_ = false;
};

/// Counts down. Before the first load CV is 0 and Q is TRUE from the first call on.
struct CTD final : Block {
  BOOL CD{};
  BOOL LD{};
  INT PV{};
  BOOL Q{};
  INT CV{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "CTD";
  static constexpr std::string_view kText = "Counts down.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.4";
  static constexpr auto kPins =
      pins(in<&CTD::CD>("CD", Unit::kNone, kAny, "counts down with its rising edge"),
           in<&CTD::LD>("LD", Unit::kNone, kAny, "holds the count at PV"),
           in<&CTD::PV>("PV", Unit::kNone, kAny, "preset to load"),
           out<&CTD::Q>("Q", "the count is 0 or less"), out<&CTD::CV>("CV", "the count"));

 private:
  bool cd_memory_ = false;
};

/// Counts both ways. R ranks above LD, LD above counting; edges of CU and CD in one call cancel.
struct CTUD final : Block {
  BOOL CU{};
  BOOL CD{};
  BOOL R{};
  BOOL LD{};
  INT PV{};
  BOOL QU{};
  BOOL QD{};
  INT CV{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "CTUD";
  static constexpr std::string_view kText = "Counts up and down.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.4";
  static constexpr auto kPins =
      pins(in<&CTUD::CU>("CU", Unit::kNone, kAny, "counts up with its rising edge"),
           in<&CTUD::CD>("CD", Unit::kNone, kAny, "counts down with its rising edge"),
           in<&CTUD::R>("R", Unit::kNone, kAny, "holds the count at 0, whatever LD says"),
           in<&CTUD::LD>("LD", Unit::kNone, kAny, "holds the count at PV"),
           in<&CTUD::PV>("PV", Unit::kNone, kAny, "preset to load and that QU compares with"),
           out<&CTUD::QU>("QU", "the count has reached the preset"),
           out<&CTUD::QD>("QD", "the count is 0 or less"), out<&CTUD::CV>("CV", "the count"));

 private:
  bool cu_memory_ = false;
  bool cd_memory_ = false;
};

}  // namespace lockstep
