/// Names of the laws and the pairs of tasks they serve.
#include "tech_objects/cam_design/motion_law.hpp"

namespace lockstep {
namespace {

/// Two letters a pair, for start and end: p position, v velocity, a acceleration, j jerk kept; -- not
/// applicable. Columns: start task and end task.
struct Row {
  std::string_view name;
  const char* pairs[16];
};

constexpr Row kTable[kMotionLaws] = {
    // clang-format off
    //                                  RR    RG    RU    RB    GR    GG    GU    GB    UR    UG    UU    UB    BR    BG    BU    BB
    {"line",                            {"pp", "pp", "pp", "pp", "pp", "jj", "pp", "pp", "pp", "pp", "pp", "pp", "pp", "pp", "pp", "pp"}},
    {"quadratic parabola",              {"vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv"}},
    {"sine",                            {"vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv"}},
    {"polynomial",                      {"jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj", "jj"}},
    {"inclined sine",                   {"aa", "aa", "--", "--", "aa", "aa", "--", "--", "--", "--", "--", "--", "--", "--", "--", "--"}},
    {"modified acceleration trapezoid", {"aa", "aa", "av", "av", "aa", "aa", "av", "av", "va", "va", "--", "--", "va", "va", "--", "--"}},
    {"modified sine",                   {"aa", "aa", "--", "--", "aa", "aa", "--", "--", "--", "--", "--", "--", "--", "--", "--", "--"}},
    {"harmonic combination",            {"--", "--", "av", "av", "--", "--", "av", "av", "va", "va", "--", "--", "va", "va", "--", "--"}},
    {"double-harmonic transition",      {"--", "--", "av", "--", "--", "--", "--", "--", "va", "--", "--", "--", "--", "--", "--", "--"}},
    {"sine-line combination",           {"vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv", "vv"}},
    // clang-format on
};

constexpr Continuity continuity(char letter) {
  switch (letter) {
    case 'p':
      return Continuity::position;
    case 'v':
      return Continuity::velocity;
    case 'a':
      return Continuity::acceleration;
    case 'j':
      return Continuity::jerk;
    default:
      return Continuity::not_applicable;
  }
}

}  // namespace

MotionTask motion_task(double velocity, double acceleration) noexcept {
  if (acceleration == 0.0) return velocity == 0.0 ? MotionTask::rest : MotionTask::constant_velocity;
  return velocity == 0.0 ? MotionTask::reversal : MotionTask::motion;
}

char task_letter(MotionTask task) noexcept {
  return "RGUB"[static_cast<std::size_t>(task)];
}

std::string_view motion_law_name(MotionLawKind law) noexcept {
  return kTable[static_cast<std::size_t>(law)].name;
}

Applicability applicability(MotionLawKind law, MotionTask start, MotionTask end) noexcept {
  const std::size_t column = 4 * static_cast<std::size_t>(start) + static_cast<std::size_t>(end);
  const char* pair = kTable[static_cast<std::size_t>(law)].pairs[column];
  return {continuity(pair[0]), continuity(pair[1])};
}

}  // namespace lockstep
