// lockstep cam check: what the checks of a cam find.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "cli/cam/cam_command.hpp"

namespace lockstep::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Whose finding it is, for a message.
std::string place_of(const CamDefinition& definition, const CamFinding& finding) {
  for (const CamStretch& stretch : definition.cam.stretches)
    if (stretch.element == finding.element && stretch.transition == finding.transition)
      return fmt::format("{} from {} to {}", stretch_name(definition, stretch), stretch.from, stretch.to);
  return "the cam";
}

/// A cam that closes is probably passed again and again.
void warn_of_wrap(const CamInput& input, const CamDefinition& definition) {
  if (definition.checks.cyclic) return;  // a finding, if continuity asks for it
  for (const CamJoint& joint : joints_of(*definition.cam.function, true, true))
    if (joint.wrap && joint.keeps == Continuity::position)
      tell_line(fmt::format("{}: warning: the cam closes, and {}: passed cyclically, the following axis gets "
                            "a step; \"cyclic\" and \"continuity\" in its checks look for it",
                            input.file, step_text(joint)),
                Severity::warning);
}

int check(const CamInput& input, bool json, const CamDefinition& definition) {
  warn_of_wrap(input, definition);
  const auto findings =
      check_cam(definition.designed ? &definition.design : nullptr, definition.cam, definition.checks);
  Json list = Json::array();
  std::vector<std::string> lines;
  for (const CamFinding& finding : findings) {
    const std::string place = place_of(definition, finding);
    list.push_back({{"place", place}, {"text", finding.text}});
    lines.push_back(input.file + ": " + place + ": " + finding.text);
  }
  if (json)
    write_output("", list.dump(2) + "\n");
  else
    for (const std::string& line : lines) tell_line(line, Severity::error);
  return findings.empty() ? kOk : kNotValid;
}

}  // namespace

void add_cam_check(CLI::App& cam, Action& action) {
  CLI::App* command = cam.add_subcommand("check", "Validate a cam and carry out the checks that it asks for");
  auto input = std::make_shared<CamInput>();
  auto json = std::make_shared<bool>(false);
  add_cam_input(*command, *input);
  command->add_flag("--json", *json, "what the checks find, for programs");
  command->footer(
      "The member \"checks\" of a cam file asks for them:\n"
      "  leading_range, following_range             elements that leave them\n"
      "  leading_velocity with max_velocity, max_acceleration, max_jerk\n"
      "                                             limits of the following axis at that velocity\n"
      "  suitability                                laws that miss velocity or acceleration beside them\n"
      "  continuity                                 joints that are not continuous up to it\n"
      "  cyclic                                     true: the joint from the end to the start counts too;\n"
      "                                             \"closed\": and the cam ends as it begins\n"
      "Exit status: 0 nothing found, 1 not valid or something found, 2 cannot be read");
  command->callback([&action, input, json] {
    action = [input, json] {
      return with_cam(*input,
                      [&](const CamDefinition& definition) { return check(*input, *json, definition); });
    };
  });
}

}  // namespace lockstep::cli
