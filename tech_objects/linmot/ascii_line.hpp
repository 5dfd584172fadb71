/// A line on which a master talks to one or several controllers.
/// @source LinMot release 1.3 addendum, 8.1 to 8.5
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tech_objects/linmot/ascii.hpp"
#include "tech_objects/linmot/line.hpp"

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
  std::int64_t answered_at = -1;  ///< when the answer is there [ns]; -1: not yet
};

/// One command is under way at a time: each is carried out in the input phase of a servo tick, the first one
/// when its last character is there. Thread: that of the cycle, but for what says otherwise.
class AsciiLine final : public Line {
 public:
  enum class Mode : std::uint8_t { rs232, rs485 };

  // ---- While loading
  Mode mode = Mode::rs232;
  std::array<LinMotController*, kControllersOnLine> controllers{};
  std::vector<ScriptedCommand> script;  ///< by time
  const bool* applies = nullptr;        ///< whether the script counts
  bool pace = false;                    ///< characters take their time, 9600 baud

  void step(std::int64_t now) noexcept override;
  AsciiAnswer carry_out(const AsciiRequest& request) noexcept;

 private:
  struct Addressed {
    LinMotController* controller = nullptr;
    std::size_t motor = 0;
    bool is_motor = false;
  };
  int find(const AsciiRequest& request, Addressed& addressed) const noexcept;
  std::int64_t time_of(std::size_t characters) const noexcept;

  std::size_t next_ = 0;
  std::int64_t free_at_ = 0;  // when the last answer is there [ns]
};

}  // namespace linmot
}  // namespace lockstep
