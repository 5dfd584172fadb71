#include "projects/studio/powers.hpp"

namespace lockstep::studio_api {
namespace {

bool may_command(const StudioPowers& powers) {
  return powers.why_no_command.empty() && powers.desk != nullptr &&
         powers.desk->has_axes(CommandRoute::studio);
}

}  // namespace

Json rights_json(const StudioPowers& powers) {
  return {{"write", powers.why_no_write.empty()},
          {"command", may_command(powers)},
          {"files", powers.why_no_files.empty()},
          {"simulation", powers.simulation != nullptr}};
}

Json reasons_json(const StudioPowers& powers) {
  Json reasons = Json::object();
  if (!powers.why_no_write.empty()) reasons["write"] = powers.why_no_write;
  if (!powers.why_no_command.empty())
    reasons["command"] = powers.why_no_command;
  else if (!may_command(powers))
    reasons["command"] = "no axis takes commands of the studio; 'studio.commands' of the project names them";
  if (!powers.why_no_files.empty()) reasons["files"] = powers.why_no_files;
  if (powers.simulation == nullptr) reasons["simulation"] = "this run goes on by itself";
  return reasons;
}

std::string_view mode_name(StudioMode mode) noexcept {
  if (mode == StudioMode::desk) return "desk";
  return mode == StudioMode::files ? "files" : "machine";
}

}  // namespace lockstep::studio_api
