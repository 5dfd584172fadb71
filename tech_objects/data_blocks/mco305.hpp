/// What others see of an MCO 305: read-outs, parameters, inputs, outputs, program. `mco305.cpp` declares it.
#pragma once

#include <array>

#include "tech_objects/mco305_catalogue/parameters.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

struct Mco305ReadOuts {
  DINT APOS{}, CPOS{}, IPOS{}, TRACKERR{}, AVEL{}, AXEND{}, STAT{}, ERRNO{};
  DINT MAPOS{}, MIPOS{}, MAVEL{}, SYNCERR{}, SYNCSTAT{};
  DINT SetPosition{}, ActualPosition{};  ///< SYSVAR 4097, 4096 [qc]
  DINT Reference{}, JerkState{};         ///< SYSVAR 4111, 4275
};

struct Mco305Program {
  DINT Number = -1, State{}, Line{};
  ULINT Steps{}, Starved{};  ///< internal commands; steps whose budget was used up
};

/// The whole data block of an MCO 305.
struct Mco305Data {
  Mco305ReadOuts Read{};
  Mco305Program Program{};
  std::array<BOOL, 33> In{};
  std::array<BOOL, 32> Out{};
  std::array<DINT, mco305::kParameterCount> Parameters = mco305::ParameterValues().all();
};

}  // namespace lockstep
