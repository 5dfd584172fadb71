#include "bench/machine.hpp"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

namespace lockstep::bench {
namespace {

/// Cycles after which every machine runs as it is to: the leading axis is up to speed in a tenth of that.
constexpr int kWarmUp = 2000;

std::string axis_name(int number) {
  return "Axis" + std::to_string(number);
}

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

std::string in_quotes(std::string_view text) {
  return joined({"\"", text, "\""});
}

bool follows(const MachinePlan& plan) {
  return plan.motion == Motion::gear || plan.motion == Motion::shifted || plan.motion == Motion::cam;
}

/// A parabola up and down that begins and ends alike.
std::string cam_object(int number_of_points) {
  std::string points;
  for (int i = 0; i < number_of_points; ++i) {
    const double x = 360.0 * i / (number_of_points - 1);
    points +=
        (i == 0 ? "[" : ", [") + std::to_string(x) + ", " + std::to_string(x * (360.0 - x) / 400.0) + "]";
  }
  return joined(
      {R"("Cam": { "type": "TO_Cam_10k", "config": { "InterpolationSettings": { "InterpolationMode": 1 } },
  "points": [ )",
       points, " ] }"});
}

std::string axis_object(const MachinePlan& plan, int number) {
  const bool gear = follows(plan);
  return joined({in_quotes(axis_name(number)), R"(: { "type": )",
                 in_quotes(gear ? "TO_SynchronousAxis" : "TO_PositioningAxis"), R"(, "config": { )",
                 plan.drives ? "" : R"("VirtualAxis": { "Mode": 1 }, )", R"("Modulo": { "Enable": )",
                 number % 2 == 0 ? "true" : "false", R"( }, "PositioningMonitoring": { "MinDwellTime": 0.0 },
  "DynamicDefaults": { "Velocity": 1000.0, "Acceleration": 1.0E4, "Deceleration": 1.0E4, "Jerk": 1.0E5 } })",
                 plan.drives ? R"(,
  "drive": { "model": "simulated", "time_constant": "2ms", "dead_time": "1ms" })"
                             : "",
                 gear ? R"(, "leading_values": [ { "to": "Leading" } ])" : "", " }"});
}

constexpr std::string_view kLeadingObject =
    R"("Leading": { "type": "TO_PositioningAxis",
  "config": { "VirtualAxis": { "Mode": 1 }, "Modulo": { "Enable": true } } })";

constexpr std::string_view kLeadingCalls =
    R"({ "fb": "MC_Power", "name": "power", "in": { "Axis": "Leading", "Enable": true } },
{ "fb": "MC_MoveVelocity", "name": "run",
  "in": { "Axis": "Leading", "Execute": "power.Status", "Velocity": 314.0 } })";

/// One call: the block, the name of its instance, its axis, and its other inputs.
std::string call(std::string_view block, const std::string& instance, std::string_view axis_pin,
                 const std::string& axis, std::string_view inputs) {
  return joined({R"({ "fb": )", in_quotes(block), R"(, "name": )", in_quotes(instance), R"(, "in": { )",
                 in_quotes(axis_pin), ": ", in_quotes(axis), ", ", inputs, " } }"});
}

std::string axis_calls(const MachinePlan& plan, int number) {
  const std::string n = std::to_string(number);
  const std::string axis = axis_name(number);
  const std::string enabled = "power" + n + ".Status";
  const std::string power = call("MC_Power", "power" + n, "Axis", axis, R"("Enable": true)");
  if (plan.motion == Motion::idle) return power;
  if (plan.motion == Motion::gear || plan.motion == Motion::shifted) {
    const std::string inputs =
        joined({R"("Master": "Leading", "RatioNumerator": )", number % 2 == 0 ? "3" : "-7",
                R"(, "RatioDenominator": )", std::to_string(1 + number % 11), R"(, "Execute": )",
                in_quotes(enabled)});
    const std::string gear = call("MC_GearIn", "gear" + n, "Slave", axis, inputs);
    if (plan.motion == Motion::gear) return joined({power, ",\n", gear});
    const std::string phase =
        call("MC_PhasingRelative", "phase" + n, "Slave", axis,
             joined({R"("Master": "Leading", "PhaseShift": 5.0, "ProfileReference": 0, "Execute": )",
                     in_quotes("gear" + n + ".InGear")}));
    const std::string offset =
        call("MC_OffsetRelative", "offset" + n, "Slave", axis,
             joined({R"("Offset": 1000.0, "ProfileReference": 1, "OffsetDistance": 1.0E9, "Execute": )",
                     in_quotes("phase" + n + ".Done")}));
    return joined({power, ",\n", gear, ",\n", phase, ",\n", offset});
  }
  if (plan.motion == Motion::cam) {
    const std::string inputs = joined(
        {R"("Master": "Leading", "Cam": "Cam", "SyncProfileReference": 2, "ApplicationMode": 1, "SlaveScaling": 0.)",
         std::to_string(1 + number % 9), R"(, "Execute": )", in_quotes(enabled)});
    return joined({power, ",\n", call("MC_CamIn", "cam" + n, "Slave", axis, inputs)});
  }
  const std::string forth = "forth" + n;
  const std::string back = "back" + n;
  const std::string distance = std::to_string(400 + 13 * (number % 31));
  const std::string go_forth = joined({enabled, " AND NOT ", back, ".Busy AND NOT ", forth, ".Done"});
  const auto move = [&](const std::string& name, std::string_view sign, const std::string& execute) {
    return call("MC_MoveRelative", name, "Axis", axis,
                joined({R"("Distance": )", sign, distance, R"(, "Execute": )", in_quotes(execute)}));
  };
  return joined({power, ",\n", move(forth, "", go_forth), ",\n", move(back, "-", forth + ".Done")});
}

/// A program that homes the axes where they are, once: in a cycle of its own, so that no tick that is
/// measured has its calls. Only what is homed can be led by a cam.
std::string homing_program(const MachinePlan& plan) {
  std::string calls;
  for (int number = 1; number <= plan.axes; ++number) {
    if (number > 1) calls += ",\n";
    calls += call("MC_Home", "home" + std::to_string(number), "Axis", axis_name(number),
                  R"("Mode": 1, "Execute": true)");
  }
  return joined({R"({ "name": "Homing", "ob": "Cyclic", "cycle": "1h", "calls": [)", calls, " ] }"});
}

std::string signal_name(const MachinePlan& plan, int index) {
  static constexpr std::string_view kPaths[] = {".Position",
                                                ".Velocity",
                                                ".ActualPosition",
                                                ".StatusWord.X22",
                                                ".Acceleration",
                                                ".StatusWord",
                                                ".StatusPositioning.Distance",
                                                ".ModuloCycle"};
  const auto paths = static_cast<int>(std::size(kPaths));
  const int axis = 1 + index / paths % plan.axes;
  return axis_name(axis) + std::string(kPaths[static_cast<std::size_t>(index % paths)]);
}

}  // namespace

std::string_view name_of(Motion motion) {
  switch (motion) {
    case Motion::gear:
      return "gear";
    case Motion::shifted:
      return "gear shifted";
    case Motion::cam:
      return "cam";
    case Motion::positioning:
      return "positioning";
    case Motion::idle:
      break;
  }
  return "idle";
}

std::string MachinePlan::name() const {
  return std::string(name_of(motion)) + " " + std::to_string(axes) + (drives ? " drives" : " virtual") +
         " 1:" + std::to_string(ratio) + " " + std::to_string(signals) + " signals" +
         (processors > 1 ? " on " + std::to_string(processors) : "");
}

std::string project_text(const MachinePlan& plan) {
  const bool gear = follows(plan);
  std::string objects(gear ? kLeadingObject : "");
  if (plan.motion == Motion::cam) objects += ",\n" + cam_object(plan.cam_points);
  std::string calls(gear ? kLeadingCalls : "");
  for (int number = 1; number <= plan.axes; ++number) {
    const std::string_view separator = objects.empty() ? "" : ",\n";
    objects += std::string(separator) + axis_object(plan, number);
    calls += std::string(separator) + axis_calls(plan, number);
  }
  return joined({R"({ "lockstep": 1, "name": "bench",
"clock": { "servo_cycle": "1ms", "interpolator_ratio": )",
                 std::to_string(plan.ratio), ", \"processors\": ", std::to_string(plan.processors),
                 " },\n\"technology_objects\": {\n", objects, R"( },
"programs": [ { "name": "Main", "ob": "MC_PreInterpolator", "calls": [
)",
                 calls, " ] }", plan.motion == Motion::cam ? ",\n" + homing_program(plan) : "", " ] }"});
}

Machine::Machine(const MachinePlan& plan) : plan_(plan) {
  LoadedProject loaded = load_project(project_text(plan));
  if (!loaded.project) throw std::runtime_error(to_string(plan.name(), loaded.problems.front()));
  project_ = std::move(*loaded.project);
  if (plan.signals > 0) {
    std::vector<Signal> signals;
    for (int i = 0; i < plan.signals; ++i)
      signals.push_back(project_.names.find(signal_name(plan, i)).place.value().signal);
    trace_ = std::make_unique<TraceRing>(std::move(signals));
    project_.controller->trace = trace_.get();
  }
  project_.controller->employ_processors(plan.processors);
  run(kWarmUp);
  check();
}

void Machine::run(int cycles) {
  constexpr int kRowsAtOnce = 1000;  // far fewer than the ring holds
  while (cycles > 0) {
    const int now = std::min(cycles, kRowsAtOnce);
    for (int tick = 0; tick < now * plan_.ratio; ++tick) project_.controller->tick();
    if (trace_) trace_->pop(trace_->readable());
    cycles -= now;
  }
}

/// What is measured has to be what the plan says.
void Machine::check() const {
  const StatusBit wanted = follows(plan_)                        ? StatusBit::Synchronous
                           : plan_.motion == Motion::positioning ? StatusBit::PositioningCommand
                                                                 : StatusBit::Standstill;
  const auto runs = [&](const AxisData& data) {
    const bool shifts = has_bit(data.StatusWord2, Status2Bit::OffsetCommand) &&
                        data.StatusSynchronizedMotion.PhaseShift != 0.0;
    return has_bit(data.StatusWord, wanted) && (plan_.motion != Motion::shifted || shifts);
  };
  int right = 0;
  for (const auto& axis : project_.controller->axes) {
    if (axis->pending_alarm() != 0) throw std::runtime_error(plan_.name() + ": alarm at " + axis->name);
    if (runs(axis->data)) ++right;
  }
  // While one positioning is over and the next not yet begun, an axis shows none.
  const int minimum = plan_.motion == Motion::positioning ? plan_.axes - plan_.axes / 4 - 1 : plan_.axes;
  if (right < minimum)
    throw std::runtime_error(plan_.name() + ": only " + std::to_string(right) + " axes run as planned");
  if (trace_ && trace_->dropped() != 0) throw std::runtime_error(plan_.name() + ": trace rows are dropped");
}

}  // namespace lockstep::bench
