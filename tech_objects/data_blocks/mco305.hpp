/// What others see of an MCO 305: read-outs, parameters, inputs, outputs, process data, program. `mco305.cpp`
/// declares it.
#pragma once

#include <array>
#include <string>

#include "tech_objects/mco305_catalogue/parameters.hpp"
#include "tech_objects/mco305_catalogue/system_variables.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

struct Mco305ReadOuts {
  DINT APOS{}, CPOS{}, IPOS{}, TRACKERR{}, AVEL{}, AXEND{}, STAT{}, ERRNO{};
  DINT MAPOS{}, MIPOS{}, MAVEL{}, SYNCERR{}, SYNCSTAT{};
  DINT SetPosition{}, ActualPosition{};                              ///< SYSVAR 4097, 4096 [qc]
  DINT Reference{}, JerkState{};                                     ///< SYSVAR 4111, 4275
  DINT Inputs{}, Outputs{}, CURVEPOS{}, AlarmWord1{}, AlarmWord2{};  ///< 34-40, 34-41, 34-55, 34-70, 34-71
};

/// What comes from a field bus or a panel and goes there; written between two steps.
struct Mco305Outside {
  static constexpr std::size_t kWords = 10;  ///< of process data, in each direction

  std::array<WORD, kWords> PcdIn{}, PcdOut{};
  DINT Keys{};                        ///< of the panel, as INKEY tells them; 0: none is pressed
  UDINT Starts{}, Stops{}, Resets{};  ///< of a panel, which asks by changing them
  LREAL Program = -1.0;               ///< that it starts; -1: the one that starts by itself
};

struct Mco305Program {
  DINT Number = -1, State{}, Line{};
  ULINT Steps{}, Starved{};  ///< internal commands; steps whose budget was used up
};

/// An error that there has been.
struct Mco305PastError {
  DINT Number{}, Time{};         ///< 0: none; as TIME when it came up [ms]
  DINT Program = -1, Line = -1;  ///< that ran; -1: none
  DINT Value{};                  ///< what belongs to the error
};
inline constexpr std::size_t kMco305PastErrors = 50;
using Mco305ErrorHistory = std::array<Mco305PastError, kMco305PastErrors>;  ///< the newest first

/// The whole data block of an MCO 305.
struct Mco305Data {
  Mco305ReadOuts Read{};
  Mco305Program Program{};
  Mco305Outside Outside{};
  std::array<BOOL, 33> In{};
  std::array<BOOL, 32> Out{};
  std::array<DINT, mco305::kParameterCount> Parameters = mco305::ParameterValues().all();
  Mco305ErrorHistory ErrorHistory{};
  std::array<DINT, mco305::kSystemVariableCount> SystemVariables{};  ///< of which somebody looks at
};

/// Path of a parameter below its device: its mnemonic, or P33_81 of one without.
std::string mco305_parameter_path(const mco305::Parameter& parameter);

}  // namespace lockstep
