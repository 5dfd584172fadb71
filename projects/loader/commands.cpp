// The panel: for each axis that takes commands, over LCM or from a page of the studio, ordinary function
// blocks that carry them out, and a program that calls them. They have names that no identifier can be, so
// that no project refers to them.
#include <array>
#include <map>
#include <memory>
#include <stdexcept>

#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/looked_at_axis.hpp"
#include "projects/loader/read_keys.hpp"
#include "scheduler/mco305/mco305.hpp"
#include "scheduler/units.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kDeadman = 300'000'000;  // [ns] after which a jog ends that is not asked for again

/// The names within the program of one axis: `p.…` its inputs, `jog.…`, `home.…` the pins of its instances.
class PanelScope final : public Scope {
 public:
  void add(const std::string& name, Signal signal) { signals_[fold(name)] = signal; }
  void add(const std::string& name, const Instance& instance) {
    for (const Pin& pin : instance.type->pins)
      add(name + "." + std::string(pin.name), pin.signal(*instance.block));
  }
  Signal at(const std::string& name) const { return signals_.at(fold(name)); }
  Reference resolve(std::string_view name, std::string_view path) const override {
    const auto found = signals_.find(fold(std::string(name) + "." + std::string(path)));
    if (found == signals_.end()) return {std::nullopt, "unknown"};
    return {found->second, ""};
  }

 private:
  std::map<std::string, Signal> signals_;
};

/// Writes the program of one axis.
class PanelProgram {
 public:
  PanelProgram(Program& program, const Loading& loading, Axis& axis)
      : program_(program), loading_(loading), axis_(axis) {}

  void build(PanelInputs& inputs, bool enables, const Operand& speed) {
    add_inputs(inputs);
    jog();
    if (enables) enable();
    if (axis_.has_position())
      once("home", "MC_Home", "p.Homings", "p.SeenHomings", {{"Position", "p.HomePosition"}});
    once("reset", "MC_Reset", "p.Resets", "p.SeenResets", {});
    const std::size_t branch = program_.begin_branch(compiled("p.Overrides <> p.SeenOverrides", Type::BOOL));
    set("p.SeenOverrides", "p.Overrides");
    program_.add_assignment(compiled("p.Override", Type::LREAL), speed.signal, *speed.variable);
    program_.end_branch(branch);
    tell_control(enables);
  }

 private:
  void add_inputs(PanelInputs& inputs) {
    const auto add = [this](const char* name, auto& value, Type type) {
      scope_.add(std::string("p.") + name, Signal{&value, type, -1});
    };
    add("Enable", inputs.Enable, Type::BOOL);
    add("Forward", inputs.Forward, Type::BOOL);
    add("Backward", inputs.Backward, Type::BOOL);
    add("Beat", inputs.Beat, Type::UDINT);
    add("Homings", inputs.Homings, Type::UDINT);
    add("Resets", inputs.Resets, Type::UDINT);
    add("Overrides", inputs.Overrides, Type::UDINT);
    add("JogVelocity", inputs.JogVelocity, Type::LREAL);
    add("HomePosition", inputs.HomePosition, Type::LREAL);
    add("Override", inputs.Override, Type::LREAL);
    add("SeenBeat", inputs.SeenBeat, Type::UDINT);
    add("SeenHomings", inputs.SeenHomings, Type::UDINT);
    add("SeenResets", inputs.SeenResets, Type::UDINT);
    add("SeenOverrides", inputs.SeenOverrides, Type::UDINT);
  }

  Instance& instance(const std::string& name, std::string_view type) {
    Instance& made =
        loading_.controller().add_instance(*find_block_type(type), "panel." + axis_.name + "." + name);
    if (const Pin* const pin = made.type->find_pin("Axis")) {
      Value address{};
      address.u = reinterpret_cast<std::uintptr_t>(static_cast<TechnologyObject*>(&axis_));
      pin->signal(*made.block).store(address);
    }
    scope_.add(name, made);
    return made;
  }

  Expression compiled(std::string_view text, Type type) const {
    CompiledExpression expression = compile_expression(text, type, scope_);
    if (!expression.expression) throw std::logic_error("panel: " + expression.errors.at(0).message);
    return std::move(*expression.expression);
  }
  void set(const std::string& place, std::string_view text) {
    const Signal signal = scope_.at(place);
    program_.add_assignment(compiled(text, signal.value_type()), signal);
  }

  /// The deadman: a jog lasts while commands come.
  void jog() {
    Instance& hold = instance("hold", "TOF");
    Instance& jog = instance("jog", "MC_MoveJog");
    hold.type->find_pin("PT")->signal(*hold.block).store(Value{.i = kDeadman});
    set("hold.IN", "p.Beat <> p.SeenBeat");
    set("p.SeenBeat", "p.Beat");
    program_.add_call(*hold.block);
    set("jog.JogForward", "p.Forward AND hold.Q");
    set("jog.JogBackward", "p.Backward AND hold.Q");
    set("jog.Velocity", "p.JogVelocity");
    program_.add_call(*jog.block);
  }

  void enable() {
    Instance& power = instance("power", "MC_Power");
    set("power.Enable", "p.Enable");
    program_.add_call(*power.block);
  }

  /// StatusWord.X4 of the axis: the panel has enabled it, or one of its jobs runs.
  void tell_control(bool enables) {
    scope_.add("axis.Panel", Signal{&axis_.control_panel, Type::BOOL, -1});
    std::string control = "jog.Busy";
    if (enables) control += " OR power.Enable";
    if (axis_.has_position()) control += " OR home.Busy";
    set("axis.Panel", control);
  }

  /// A job for each change of a count; between two there is a call with Execute FALSE.
  void once(const std::string& name, std::string_view type, const std::string& asked, const std::string& seen,
            std::initializer_list<std::pair<const char*, const char*>> pins) {
    Instance& made = instance(name, type);
    set(name + ".Execute", asked + " <> " + seen + " AND NOT " + name + ".Execute");
    const std::size_t branch = program_.begin_branch(compiled(name + ".Execute", Type::BOOL));
    set(seen, asked);
    for (const auto& [pin, value] : pins) set(name + "." + pin, value);
    program_.end_branch(branch);
    program_.add_call(*made.block);
  }

  Program& program_;
  const Loading& loading_;
  Axis& axis_;
  PanelScope scope_;
};

/// The instance of MC_Power that a program has for the axis; empty: none.
std::string power_of(const Controller& controller, const TechnologyObject& axis) {
  for (const Instance& instance : controller.instances)
    if (instance.type->name == "MC_Power" &&
        instance.type->find_pin("Axis")->signal(*instance.block).load().u ==
            reinterpret_cast<std::uintptr_t>(&axis))
      return instance.name;
  return "";
}

/// The signals of the axis in the order of `PanelSignal`.
std::vector<Signal> signals_of(const Axis& axis, PanelInputs& inputs, const Names& names) {
  const auto variable = [&](const char* name) {
    return names.find(axis.name + "." + name).place.value().signal;
  };
  const bool positions = axis.has_position();
  std::vector<Signal> signals = {
      {&inputs.Enable, Type::BOOL, -1},        {&inputs.Forward, Type::BOOL, -1},
      {&inputs.Backward, Type::BOOL, -1},      {&inputs.Beat, Type::UDINT, -1},
      {&inputs.JogVelocity, Type::LREAL, -1},  {&inputs.Homings, Type::UDINT, -1},
      {&inputs.HomePosition, Type::LREAL, -1}, {&inputs.Resets, Type::UDINT, -1},
      {&inputs.Override, Type::LREAL, -1},     {&inputs.Overrides, Type::UDINT, -1},
      {&inputs.Stops, Type::UDINT, -1},        {&inputs.Program, Type::LREAL, -1},
      {&inputs.Starts, Type::UDINT, -1}};
  signals.push_back(variable("StatusWord"));
  signals.push_back(variable("ErrorDetail.Number"));
  signals.push_back(positions ? variable("ActualPosition") : Signal{&inputs.NoPosition, Type::LREAL, -1});
  signals.push_back(variable(positions ? "ActualVelocity" : "ActualSpeed"));
  signals.push_back(variable("Override.Velocity"));
  return signals;
}

/// The signals of a device in the order of `PanelSignal`: it looks at its part of them itself.
std::vector<Signal> signals_of(Mco305& device, PanelInputs& inputs) {
  Mco305Outside& outside = device.data.Outside;
  return {{&inputs.Enable, Type::BOOL, -1},          {&inputs.Forward, Type::BOOL, -1},
          {&inputs.Backward, Type::BOOL, -1},        {&inputs.Beat, Type::UDINT, -1},
          {&inputs.JogVelocity, Type::LREAL, -1},    {&inputs.Homings, Type::UDINT, -1},
          {&inputs.HomePosition, Type::LREAL, -1},   {&outside.Resets, Type::UDINT, -1},
          {&inputs.Override, Type::LREAL, -1},       {&inputs.Overrides, Type::UDINT, -1},
          {&outside.Stops, Type::UDINT, -1},         {&outside.Program, Type::LREAL, -1},
          {&outside.Starts, Type::UDINT, -1},        {&device.data.Read.STAT, Type::DINT, -1},
          {&device.data.Read.ERRNO, Type::DINT, -1}, {&inputs.NoPosition, Type::LREAL, -1},
          {&inputs.NoPosition, Type::LREAL, -1},     {&inputs.NoPosition, Type::LREAL, -1}};
}

/// A device needs no blocks: its program is stopped and started, and its errors are cleared.
void load_device(Mco305& device, const Fields& fields, CommandRoute route, const Loading& loading) {
  if (fields["jog_velocity"] != nullptr)
    loading.problems.report(*fields["jog_velocity"],
                            "an MCO_305 is moved by its program and not jogged; allowed: {}");
  CommandsConfig& commands = loading.project.commands;
  PanelInputs& inputs = commands.inputs.emplace_back();
  constexpr bool kHasPosition = false, kHasPrograms = true;
  commands.axes.push_back({device.name, 0.0, "", signals_of(device, inputs),
                           std::string(kind_name(device.kind)), "", kHasPosition, kHasPrograms,
                           route == CommandRoute::lcm, route == CommandRoute::studio});
}

/// An axis for the program of one that is looked at; none if it is an axis. The program never runs.
std::unique_ptr<Axis> stand_in_for(TechnologyObject& object, const Loading& loading) {
  if (loading.use == LoadedFor::running) return nullptr;
  auto axis = std::make_unique<Axis>(object.kind, object.name, object.number);
  axis->data = static_cast<LookedAtAxis&>(object).data;
  return axis;
}

/// An axis that takes commands by another route already takes them by this one too.
void add_route(CommandAxis& axis, const JsonValue& json, const KeyValue* limit, CommandRoute route,
               Problems& problems) {
  bool& is_taken = route == CommandRoute::lcm ? axis.by_lcm : axis.by_studio;
  if (is_taken) return problems.report(json, quote(axis.name) + " is there twice; each axis is allowed once");
  is_taken = true;
  if (limit != nullptr && limit->number != axis.jog_velocity)
    problems.report(json, "'jog_velocity' of " + quote(axis.name) +
                              " differs from that of the commands over LCM; allowed: the same, or none");
}

void load_axis(const std::string& name, const JsonValue& json, CommandRoute route, Program& program,
               const Loading& loading) {
  Problems& problems = loading.problems;
  CommandsConfig& commands = loading.project.commands;
  const Fields fields(json, keys::kCommandAxis, problems);
  const auto limit = read_value(fields, keys::kCommandAxis["jog_velocity"], loading);
  const Names::FoundObject found = loading.names().find_object(name, kAnyDrivenAxis | ObjectKind::MCO_305);
  if (!found.problem.empty()) problems.report(json, found.problem);
  if (found.object == nullptr) return;
  for (CommandAxis& other : commands.axes)
    if (other.name == found.object->name)
      return add_route(other, json, limit ? &*limit : nullptr, route, problems);
  if (found.object->kind == ObjectKind::MCO_305)
    return load_device(static_cast<Mco305&>(*found.object), fields, route, loading);
  const std::unique_ptr<Axis> stand_in = stand_in_for(*found.object, loading);
  auto& axis = stand_in ? *stand_in : static_cast<Axis&>(*found.object);
  const Names& names = loading.names();
  const double usual = names.find(axis.name + ".DynamicDefaults.Velocity").place.value().signal.load().r;
  const std::string enabled_by = power_of(loading.controller(), *found.object);
  const Operand speed = names.find(axis.name + ".Override.Velocity").place.value();
  PanelInputs& inputs = commands.inputs.emplace_back();
  constexpr bool kHasPrograms = false;
  commands.axes.push_back({axis.name, limit ? limit->number : usual, enabled_by,
                           signals_of(axis, inputs, names), std::string(kind_name(axis.kind)),
                           unit_of(Unit::kVelocity, axis), axis.has_position(), kHasPrograms,
                           route == CommandRoute::lcm, route == CommandRoute::studio});
  PanelProgram(program, loading, axis).build(inputs, enabled_by.empty(), speed);
}

}  // namespace

void load_commands(const JsonValue& commands, CommandRoute route, const Loading& loading) {
  const Fields fields(commands, keys::kCommands, loading.problems);
  const JsonValue* const axes = fields["axes"];
  if (read_object(axes, loading.problems) == nullptr) return;
  if (axes->members.empty())
    return loading.problems.report(*axes, "no axis is named; without 'commands' none takes any");
  Program*& program = loading.project.panel;
  if (program == nullptr)
    program = &loading.controller().programs.emplace_back("panel", Ob::MC_PreInterpolator, 0, 0);
  for (const auto& [name, json] : axes->members) load_axis(name, *json, route, *program, loading);
}

}  // namespace lockstep
