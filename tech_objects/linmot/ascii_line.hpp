/// A line on which a master talks to one or several controllers.
/// @source LinMot release 1.3 addendum, 8.1 to 8.5
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tech_objects/linmot/ascii.hpp"

namespace lockstep {

class LinMotController;

namespace linmot {

inline constexpr int kControllersOnLine = 6;

/// A command of a simulation, and what became of it.
struct ScriptedCommand {
  std::int64_t at = 0;  ///< [ns]
  std::string text;
  AsciiRequest request;
  AsciiAnswer answer;
  std::int64_t answered_at = -1;  ///< [ns]; -1: not yet
};

/// One command is under way at a time: each is carried out in the input phase of a servo tick. Thread: that
/// of the cycle, but for what says otherwise.
class AsciiLine {
 public:
  enum class Mode : std::uint8_t { rs232, rs485 };

  // ---- While loading
  Mode mode = Mode::rs232;
  std::array<LinMotController*, kControllersOnLine> controllers{};
  std::vector<ScriptedCommand> script;  ///< by time
  const bool* applies = nullptr;        ///< whether the script counts

  /// Carries out what is due. @param now time of the tick [ns]
  void step(std::int64_t now) noexcept;
  AsciiAnswer carry_out(const AsciiRequest& request) noexcept;

 private:
  struct Addressed {
    LinMotController* controller = nullptr;
    std::size_t motor = 0;
    bool is_motor = false;
  };
  int find(const AsciiRequest& request, Addressed& addressed) const noexcept;

  std::size_t next_ = 0;
};

}  // namespace linmot
}  // namespace lockstep
