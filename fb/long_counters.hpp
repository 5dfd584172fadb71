/// Counters of the type DINT, for counts beyond 32,767: of parts, of millimetres of material. They count as
/// those of INT do, to the limits of DINT, without wrapping.
/// @source IEC 61131-3:2013, 6.6.3.5.4, table 45
#pragma once

#include "fb/counters.hpp"

namespace lockstep {

/// Counts up, to 2,147,483,647.
struct CTU_DINT final : UpCounter<DINT> {
  static constexpr std::string_view kName = "CTU_DINT";
  static constexpr std::string_view kText = "Counts up, in DINT.";
};

/// Counts down, to -2,147,483,648.
struct CTD_DINT final : DownCounter<DINT> {
  static constexpr std::string_view kName = "CTD_DINT";
  static constexpr std::string_view kText = "Counts down, in DINT.";
};

/// Counts both ways, within DINT.
struct CTUD_DINT final : UpDownCounter<DINT> {
  static constexpr std::string_view kName = "CTUD_DINT";
  static constexpr std::string_view kText = "Counts up and down, in DINT.";
};

}  // namespace lockstep
