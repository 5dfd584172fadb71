#include "projects/load_drive.hpp"

namespace lockstep {
namespace {

constexpr double kMost = 1e12;
constexpr double kLeast = 1e-12;  // of what has to be greater than 0

void load_fixed_stop(const JsonValue& json, MachinePlantSettings& plant, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kFixedStop, problems);
  const auto position = read_number(fields["position"], -kMost, kMost, problems);
  const auto stiffness = read_number(fields["stiffness"], kLeast, kMost, problems);
  const JsonValue* const direction = fields["direction"];
  const auto word = direction == nullptr ? std::optional<std::size_t>{0}
                                         : read_word(direction, words::kDirections, problems);
  if (!position || !stiffness || !word) return;
  plant.has_stop = true;
  plant.stop = {*position, *word == 0 ? 1 : -1, *stiffness};
}

const bool* read_cause(const JsonValue* json, const Loading& loading) {
  if (json == nullptr) return nullptr;
  const auto tag = read_string(json, loading.problems);
  if (!tag) return nullptr;
  const auto found = loading.find(*json, *tag);
  if (!found) return nullptr;
  if (found->tag == nullptr || found->signal.type != Type::BOOL) {
    loading.problems.report(*json, json->shown() + " is not allowed here; allowed: the name of a BOOL tag");
    return nullptr;
  }
  return static_cast<const bool*>(found->signal.address);
}

}  // namespace

void load_plant(const JsonValue& json, SimulatedDriveSettings& drive, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kPlant, problems);
  MachinePlantSettings& plant = drive.plant;
  if (const auto inertia = read_number(fields["inertia"], kLeast, kMost, problems)) plant.inertia = *inertia;
  if (const auto friction = read_number(fields["friction"], 0.0, kMost, problems)) plant.friction = *friction;
  if (const auto torque = read_number(fields["load_torque"], -kMost, kMost, problems))
    plant.load_torque = *torque;
  if (const auto torque = read_number(fields["maximum_torque"], kLeast, kMost, problems))
    plant.maximum_torque = *torque;
  if (const JsonValue* const stop = fields["fixed_stop"]) load_fixed_stop(*stop, plant, loading);
}

void load_faults(const JsonValue& json, SimulatedFaults& faults, const Loading& loading) {
  const Fields fields(json, keys::kFaults, loading.problems);
  faults.drive = read_cause(fields["drive"], loading);
  faults.encoder = read_cause(fields["encoder"], loading);
  faults.communication = read_cause(fields["communication"], loading);
  faults.blocked = read_cause(fields["blocked"], loading);
}

}  // namespace lockstep
