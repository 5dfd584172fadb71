/// How a project is run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace lockstep {

/// What whoever starts a run wants of it; what is not given is as the project says.
struct RunOptions {
  std::string file{};          ///< of the project; what it names without a path stands relative to it
  bool simulate = false;       ///< virtual time: no Modbus, LCM, retain and audit log unless asked for
  std::int64_t duration = -1;  ///< [ns]; negative: until asked to end
  std::string trace{};         ///< file, .csv or .lcm; empty: none
  std::string transcript{};    ///< file of what is said on lines to LinMot controllers; empty: none
  std::vector<std::string> signals{};  ///< of the trace; empty: the project's
  bool stimuli = false;                ///< those of the project apply in real time too
  int cpu = -1;                        ///< processor of the cycle, from 0; negative: any
  std::string modbus{};                ///< HOST:PORT; port 0: one that is free; empty: as the project says
  bool no_modbus = false;              ///< neither server nor clients
  std::string lcm{};                   ///< URL; empty: as the project says
  bool no_lcm = false;                 ///< neither traces nor commands of panels
  std::string retain{};                ///< file; empty: as the project says
  bool no_retain = false;              ///< begins with the init values and keeps nothing
  std::string audit{};                 ///< file; empty: as the project says
  std::string
      studio{};  ///< HOST:PORT where the run can be looked into; port 0: one that is free; empty: none
  std::string studio_token{};               ///< file of the token that it asks for; empty: none
  std::vector<std::string> studio_names{};  ///< by which it may be called besides its address
  bool studio_write = false;  ///< pages may write, and command the axes that take commands of the studio
  bool no_studio = false;     ///< none, whatever the project says
  /// As `lockstep describe --json` tells it, for the studio; empty: it tells nothing.
  std::function<std::optional<std::string>(const std::string&)> describe{};
  std::string mark{};  ///< stands before the name of an option in messages; "--" on a command line
};

/// A run could not be started; the text says what is wrong and why.
struct CouldNotStart : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lockstep
