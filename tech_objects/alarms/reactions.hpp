/// Values of ErrorDetail.Reaction in words.
/// @source S7-1500/S7-1500T alarms and error IDs
#pragma once

#include <cstddef>
#include <iterator>
#include <string_view>

namespace lockstep {

inline constexpr std::string_view kAlarmReactions[] = {"none",
                                                       "stop with the dynamic values of the running job",
                                                       "stop with maximum dynamic values",
                                                       "stop with the emergency ramp",
                                                       "remove the enable",
                                                       "track the setpoints",
                                                       "end the processing of the output cam",
                                                       "end the processing of the cam track",
                                                       "end the processing of the measuring input",
                                                       "end the processing of the cam",
                                                       "end the processing of the external encoder",
                                                       "kinematics: stop on the path",
                                                       "kinematics: stop with maximum dynamics of the axes",
                                                       "end the processing of the leading axis proxy",
                                                       "interpreter: stop the program, diagnostics possible",
                                                       "interpreter: stop and recompile"};

/// Empty for an unknown value.
constexpr std::string_view alarm_reaction_text(int reaction) noexcept {
  const auto index = static_cast<std::size_t>(reaction);
  return reaction >= 0 && index < std::size(kAlarmReactions) ? kAlarmReactions[index] : std::string_view();
}

}  // namespace lockstep
