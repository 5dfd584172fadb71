// What stands along the way of a simulated machine: marks, switches, limits.
#include "projects/loader/drive.hpp"

namespace lockstep {
namespace {

constexpr double kFurthest = 1e12;  // place on the scale of a machine [u]

std::optional<double> read_place(const JsonValue* json, Problems& problems) {
  return read_number(json, -kFurthest, kFurthest, problems);
}

/// [from, to] with from ≤ to.
std::optional<PositionRange> read_range(const JsonValue* json, Problems& problems) {
  if (json == nullptr) return std::nullopt;
  constexpr std::string_view kAllowed = "two positions [from, to], from not greater than to";
  if (json->kind != JsonKind::array || json->elements.size() != 2) {
    report_kind(*json, kAllowed, problems);
    return std::nullopt;
  }
  const auto from = read_place(json->elements[0], problems);
  const auto to = read_place(json->elements[1], problems);
  if (!from || !to) return std::nullopt;
  if (*from > *to) {
    problems.report(*json, std::string("from is greater than to; allowed: ") + std::string(kAllowed));
    return std::nullopt;
  }
  return PositionRange{*from, *to};
}

void load_zero_marks(const JsonValue& json, MachineSignals& signals, const Loading& loading) {
  const Fields fields(json, keys::kZeroMarks, loading.problems);
  const auto position = read_place(fields["position"], loading.problems);
  const auto period = read_number(fields["period"], 0.0, kFurthest, loading.problems);
  if (position) signals.zero_marks = ZeroMarks{*position, period.value_or(0.0)};
}

void load_limit_switches(const JsonValue& json, MachineSignals& signals, const Loading& loading) {
  const Fields fields(json, keys::kLimitSwitches, loading.problems);
  signals.limit_min = read_place(fields["min"], loading.problems);
  signals.limit_max = read_place(fields["max"], loading.problems);
  if (signals.limit_min && signals.limit_max && *signals.limit_min >= *signals.limit_max)
    loading.problems.report(json, "min has to be less than max");
}

void load_digital_input(const JsonValue& json, MachineSignals& signals, const Loading& loading) {
  const Fields fields(json, keys::kDigitalInput, loading.problems);
  const auto range = read_range(fields["range"], loading.problems);
  const auto tag = read_string(fields["tag"], loading.problems);
  if (!tag) return;
  const auto found = loading.find(*fields["tag"], *tag);
  if (!found) return;
  if (found->tag == nullptr || found->signal.type != Type::BOOL)
    return loading.problems.report(
        *fields["tag"], fields["tag"]->shown() + " is not allowed here; allowed: the name of a BOOL tag");
  if (range) signals.digital_inputs.push_back({static_cast<bool*>(found->signal.address), *range});
}

}  // namespace

void load_homing_marks(const Fields& fields, MachineSignals& signals, const Loading& loading) {
  if (const JsonValue* const marks = fields["zero_marks"]) load_zero_marks(*marks, signals, loading);
  signals.reference_cam = read_range(fields["reference_cam"], loading.problems);
}

void load_signals(const Fields& fields, MachineSignals& signals, const Loading& loading) {
  Problems& problems = loading.problems;
  if (const auto position = read_place(fields["start_position"], problems))
    signals.start_position = *position;
  load_homing_marks(fields, signals, loading);
  if (const JsonValue* const limits = fields["limit_switches"])
    load_limit_switches(*limits, signals, loading);
  const JsonValue* const inputs = fields["digital_inputs"];
  if (read_array(inputs, problems) == nullptr) return;
  for (const JsonValue* const input : inputs->elements) load_digital_input(*input, signals, loading);
}

}  // namespace lockstep
