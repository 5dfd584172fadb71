// Programs: from JSON calls to compiled sequences.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <unordered_map>

#include "projects/expressions/constant.hpp"
#include "projects/json/fields.hpp"
#include "projects/keys/project.hpp"
#include "projects/loader/call_checks.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/mco305_panel.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

constexpr int kDefaultPriority = 8;

/// What a call is, by the key that only it has.
enum class CallKind { block, set, set_start, branch, unknown };

CallKind kind_of(const JsonValue& call) {
  if (call.find("fb") != nullptr) return CallKind::block;
  if (call.find("set") != nullptr) return CallKind::set;
  if (call.find("set_start") != nullptr) return CallKind::set_start;
  if (call.find("if") != nullptr) return CallKind::branch;
  return CallKind::unknown;
}

const BlockType* read_block_type(const JsonValue* json, Problems& problems) {
  const auto name = read_string(json, problems);
  if (!name) return nullptr;
  const BlockType* const type = find_block_type(*name);
  if (type != nullptr && type->name == *name) return type;
  std::vector<std::string_view> names;
  for (const BlockType& candidate : block_types()) names.push_back(candidate.name);
  problems.report(*json, "unknown function block " + quote(*name) + did_you_mean(*name, names) +
                             "; allowed: what 'lockstep describe' lists");
  return nullptr;
}

/// Adds the instance of a call of a function block. It is there even if its name is not free, so that its
/// pins are looked at.
void declare_instance(const JsonValue& call, const Loading& loading) {
  const BlockType* const type = read_block_type(call.find("fb"), loading.problems);
  const JsonValue* const json = call.find("name");
  const std::string name = json != nullptr && json->kind == JsonKind::string ? json->text : "";
  const bool named = !name.empty() && loading.add_name(*json, name, {});
  if (type == nullptr) return;
  Instance& instance = loading.controller().add_instance(*type, name);
  loading.instances.emplace(&call, &instance);
  if (named) loading.names().define(name, &instance);
}

/// Adds the instances of some calls and of the branches among them.
void declare_calls(const JsonValue* calls, const Loading& loading) {
  if (calls == nullptr || calls->kind != JsonKind::array) return;
  for (const JsonValue* const call : calls->elements) {
    if (call->kind != JsonKind::object) continue;
    if (kind_of(*call) == CallKind::block) declare_instance(*call, loading);
    if (kind_of(*call) != CallKind::branch) continue;
    declare_calls(call->find("then"), loading);
    declare_calls(call->find("else"), loading);
  }
}

/// Column in the text of a value of a mistake in an expression that is all of it, or a part.
std::size_t column_in(const JsonValue& json, std::string_view expression, const ExpressionError& error) {
  const std::string_view whole = json.text;
  const bool is_part = std::less_equal<>()(whole.data(), expression.data()) &&
                       std::less_equal<>()(expression.data(), whole.data() + whole.size());
  return static_cast<std::size_t>(error.column + (is_part ? expression.data() - whole.data() : 0));
}

/// Compiles the calls of one program.
class ProgramLoader {
 public:
  ProgramLoader(Program& program, const Loading& loading)
      : program_(program), loading_(loading), problems_(loading.problems), call_checks_(loading.problems) {}

  void load_calls(const JsonValue* calls);
  /// Behind all calls: what several of them have to do with each other.
  void look_at_all() const { call_checks_.look_at_all(); }

 private:
  void load_call(const JsonValue& json);
  void load_branch(const JsonValue& json);
  void load_set(const JsonValue& json);
  void assign(const JsonValue& to, const Operand& place, std::optional<Expression> index);
  void assign_text(const JsonValue* to, const StringTag& tag);
  void load_set_start(const JsonValue& json);
  struct Target;
  std::optional<Target> read_target(const JsonValue& json, std::string_view path);
  void check_range(const JsonValue& json, const Expression& expression, const Operand& place);
  void load_block(const JsonValue& json);
  void load_pins(const JsonValue* in, const JsonValue& call, Instance& instance);
  void load_pin(const std::string& name, const JsonValue& json, Instance& instance);
  void load_array_pin(const JsonValue& json, const Pin& pin, Instance& instance);
  void load_object_pin(const JsonValue& json, const Pin& pin, Instance& instance);
  void check_constants(const Instance& instance);
  void check_leading_value(const JsonValue& in, Instance& instance);

  /// What the place of a type gets: a JSON boolean or number, or an expression; none if it is reported.
  std::optional<Expression> compile(const JsonValue* json, Type type);
  std::optional<Expression> compile_expression_at(const JsonValue& json, std::string_view expression,
                                                  Type type);
  void report(const JsonValue& json, std::string_view expression, const std::vector<ExpressionError>& errors);
  static std::optional<Value> constant_value(const Expression& expression);

  Program& program_;
  const Loading& loading_;
  Problems& problems_;
  std::vector<std::pair<const Pin*, const JsonValue*>> constants_;  // of the call that is being loaded
  CallChecks call_checks_;
};

void ProgramLoader::load_calls(const JsonValue* calls) {
  if (read_array(calls, problems_) == nullptr) return;
  for (const JsonValue* const call : calls->elements) load_call(*call);
}

void ProgramLoader::load_call(const JsonValue& json) {
  if (read_object(&json, problems_) == nullptr) return;
  switch (kind_of(json)) {
    case CallKind::block:
      return load_block(json);
    case CallKind::set:
      return load_set(json);
    case CallKind::set_start:
      return load_set_start(json);
    case CallKind::branch:
      return load_branch(json);
    case CallKind::unknown:
      return problems_.report(
          json, "one of the keys 'fb', 'set', 'set_start', 'if' is missing, which tell what is to be done");
  }
}

std::optional<Expression> ProgramLoader::compile(const JsonValue* json, Type type) {
  if (json == nullptr) return std::nullopt;
  if (json->kind != JsonKind::string) {
    const auto value = read_plain_constant(*json, type, problems_);
    return value ? std::optional<Expression>(std::in_place, type, *value) : std::nullopt;
  }
  return compile_expression_at(*json, json->text, type);
}

void ProgramLoader::report(const JsonValue& json, std::string_view expression,
                           const std::vector<ExpressionError>& errors) {
  for (const ExpressionError& error : errors)
    if (error.message.find(Names::kKnownProblem) == std::string::npos)
      problems_.report_within(json, column_in(json, expression, error), error.message);
}

std::optional<Expression> ProgramLoader::compile_expression_at(const JsonValue& json,
                                                               std::string_view expression, Type type) {
  CompiledExpression compiled = compile_expression(expression, type, loading_.names());
  report(json, expression, compiled.errors);
  for (const ExpressionError& warning : compiled.warnings)
    problems_.warn_within(json, column_in(json, expression, warning), warning.message);
  return std::move(compiled.expression);
}

std::optional<Value> ProgramLoader::constant_value(const Expression& expression) {
  if (!expression.constant()) return std::nullopt;
  EvaluationCounters counters;
  return expression.evaluate(counters);
}

void ProgramLoader::load_branch(const JsonValue& json) {
  const Fields fields(json, keys::kIf, problems_);
  auto condition = compile(fields["if"], Type::BOOL);
  const std::size_t branch = program_.begin_branch(std::move(condition).value_or(Expression()));
  load_calls(fields["then"]);
  if (fields["else"] == nullptr) return program_.end_branch(branch);
  const std::size_t alternative = program_.begin_alternative(branch);
  load_calls(fields["else"]);
  program_.end_branch(alternative);
}

/// Where something is to be set.
struct ProgramLoader::Target {
  Operand place;
  std::optional<Expression> index;  ///< chooses the element; none: the address is fixed
};

/// An index is a constant, or an expression of any integer type.
std::optional<ProgramLoader::Target> ProgramLoader::read_target(const JsonValue& json,
                                                                std::string_view path) {
  const std::size_t open = path.find('[');
  const std::size_t close = path.rfind(']');
  if (open == path.npos || close == path.npos || open > close) {
    const auto place = loading_.find(json, path);
    if (!place) return std::nullopt;
    return Target{*place, std::nullopt};
  }
  auto index = compile_expression_at(json, path.substr(open + 1, close - open - 1), Type::LINT);
  if (!index) return std::nullopt;
  std::string whole(path.substr(0, open + 1));
  const auto constant = constant_value(*index);
  if (constant) whole += std::to_string(constant->i);
  whole += path.substr(close);
  const auto place = loading_.find_elements(json, whole);
  if (!place) return std::nullopt;
  if (constant) index.reset();
  return Target{*place, std::move(index)};
}

void ProgramLoader::load_set(const JsonValue& json) {
  const Fields fields(json, keys::kSet, problems_);
  const auto path = read_string(fields["set"], problems_);
  if (const StringTag* const tag = path ? loading_.names().find_string(*path) : nullptr)
    return assign_text(fields["to"], *tag);
  auto target = path ? read_target(*fields["set"], *path) : std::nullopt;
  if (!target) return;
  if (const std::string reason = why_not_writable(target->place); !reason.empty())
    return problems_.report(*fields["set"], reason);
  expect_writes(target->place);
  if (fields["to"] != nullptr) assign(*fields["to"], target->place, std::move(target->index));
}

/// Of texts, no longer than the tag's.
void ProgramLoader::assign_text(const JsonValue* to, const StringTag& tag) {
  if (to == nullptr) return;
  if (to->kind != JsonKind::string)
    return report_kind(*to, "a text such as \"'ale'\", or a tag of type STRING", problems_);
  CompiledText compiled = compile_text(to->text, loading_.names());
  report(*to, to->text, compiled.errors);
  if (!compiled.text) return;
  if (compiled.text->capacity() > tag.text.capacity)
    return problems_.report(*to, to->shown() + " may have " + std::to_string(compiled.text->capacity()) +
                                     " characters; allowed for '" + tag.name + "': up to " +
                                     std::to_string(tag.text.capacity));
  program_.add_assignment(*compiled.text, tag.text);
}

/// @param index chooses the element; none: the address is fixed
void ProgramLoader::assign(const JsonValue& to, const Operand& place, std::optional<Expression> index) {
  auto expression = compile(&to, place.signal.value_type());
  if (!expression) return;
  if (place.variable != nullptr) check_range(to, *expression, place);
  if (index)
    program_.add_assignment(std::move(*expression), place.signal, place.variable, std::move(*index),
                            place.elements);
  else if (place.variable == nullptr)
    program_.add_assignment(std::move(*expression), place.signal);
  else
    program_.add_assignment(std::move(*expression), place.signal, *place.variable);
}

/// Warns of a constant that the variable will not take.
void ProgramLoader::check_range(const JsonValue& json, const Expression& expression, const Operand& place) {
  const Variable& variable = *place.variable;
  const auto value = constant_value(expression);
  if (!value || place.signal.bit >= 0) return;
  const std::string problem = range_problem(*value, variable.type, variable.range, variable.choices);
  if (!problem.empty()) problems_.warn(json, problem + "; the variable will not take it");
}

/// Changes a start value, which the object takes over with its next restart.
void ProgramLoader::load_set_start(const JsonValue& json) {
  const Fields fields(json, keys::kSetStart, problems_);
  const auto path = read_string(fields["set_start"], problems_);
  auto target = path ? read_target(*fields["set_start"], *path) : std::nullopt;
  if (!target) return;
  Operand& place = target->place;
  if (const std::string reason = why_no_start_value(place); !reason.empty())
    return problems_.report(*fields["set_start"], reason);
  TechnologyObject& object = *place.object;
  const std::ptrdiff_t offset =
      static_cast<char*>(place.signal.address) - static_cast<char*>(object.data_block());
  place.signal.address = static_cast<char*>(object.start_values()) + offset;
  if (fields["to"] == nullptr) return;
  assign(*fields["to"], place, std::move(target->index));
  program_.add_assignment(Expression(Type::BOOL, Value{.u = 1}), {&object.start_values_changed, Type::BOOL});
}

void ProgramLoader::load_block(const JsonValue& json) {
  const Fields fields(json, keys::kCall, problems_);
  if (const auto name = read_string(fields["name"], problems_); name && name->empty())
    problems_.report(*fields["name"], identifier_problem(*name));
  const auto instance = loading_.instances.find(&json);
  if (instance == loading_.instances.end()) return;  // its type is unknown
  load_pins(fields["in"], json, *instance->second);
  program_.add_call(*instance->second->block);
}

void ProgramLoader::load_pins(const JsonValue* in, const JsonValue& call, Instance& instance) {
  constants_.clear();
  if (read_object(in, problems_) != nullptr)
    for (const auto& [name, json] : in->members) load_pin(name, *json, instance);
  for (const Pin& pin : instance.type->pins)
    if (pin.type == Type::AXIS && (in == nullptr || in->find(pin.name) == nullptr))
      problems_.report(in == nullptr ? call : *in,
                       "the key '" + std::string(pin.name) +
                           "' is missing: it takes a technology object and has no default");
  if (in == nullptr) return;
  check_constants(instance);
  check_leading_value(*in, instance);
  call_checks_.add(*in, instance, constants_);
}

void ProgramLoader::load_pin(const std::string& name, const JsonValue& json, Instance& instance) {
  const BlockType& type = *instance.type;
  const Pin* const pin = type.find_pin(name);
  if (pin == nullptr || pin->name != name || pin->pin_class == PinClass::output) {
    std::vector<std::string_view> inputs;
    for (const Pin& candidate : type.pins)
      if (candidate.pin_class != PinClass::output) inputs.push_back(candidate.name);
    if (pin != nullptr && pin->pin_class == PinClass::output)
      return problems_.report_key(json, quote(name) + " is an output of " + std::string(type.name) +
                                            "; it is read as " + instance.name + "." +
                                            std::string(pin->name) + "; allowed: " + list_of(inputs));
    return problems_.report_key(json, std::string(type.name) + " has no input " + quote(name) +
                                          did_you_mean(name, inputs) + "; allowed: " + list_of(inputs));
  }
  if (pin->type == Type::AXIS) return load_object_pin(json, *pin, instance);
  if (pin->type == Type::ARRAY) return load_array_pin(json, *pin, instance);
  auto expression = compile(&json, pin->type);
  if (!expression) return;
  if (const auto value = constant_value(*expression)) {
    constants_.emplace_back(pin, &json);
    return pin->signal(*instance.block).store(*value);
  }
  program_.add_assignment(std::move(*expression), pin->signal(*instance.block));
}

void ProgramLoader::load_object_pin(const JsonValue& json, const Pin& pin, Instance& instance) {
  if (json.kind != JsonKind::string) return report_kind(json, "the name of a technology object", problems_);
  TechnologyObject* const object = loading_.find_object(&json, pin.objects);
  if (object == nullptr) return;
  Value address{};
  address.u = reinterpret_cast<std::uintptr_t>(object);
  pin.signal(*instance.block).store(address);
}

void ProgramLoader::load_array_pin(const JsonValue& json, const Pin& pin, Instance& instance) {
  if (json.kind != JsonKind::string) return report_kind(json, "the name of an array tag", problems_);
  const Names::FoundArray found = loading_.names().find_array(json.text);
  if (!found.problem.empty()) problems_.report(json, found.problem);
  if (found.array == nullptr) return;
  const Array& array = found.array->array;
  if (array.element != pin.element)
    return problems_.report(json, json.shown() + " is an " + array_type_name(array) +
                                      "; allowed: ARRAY[…] OF " + std::string(pin.element->name));
  Value address{};
  address.u = reinterpret_cast<std::uintptr_t>(&array);
  pin.signal(*instance.block).store(address);
}

void ProgramLoader::check_constants(const Instance& instance) {
  for (const auto& [pin, json] : constants_) {
    if (pin->allows(*instance.block)) continue;
    const Value value = pin->signal(*instance.block).load();
    std::string problem = range_problem(value, pin->type, pin->range, pin->choices);
    if (problem.empty()) problem = value_text(value, pin->type) + " is not permitted";  // infinity, NaN
    problems_.warn(*json, problem + "; the block will report an error");
  }
}

/// Warns of a leading axis with which the following axis is not interconnected: the job will fail.
void ProgramLoader::check_leading_value(const JsonValue& in, Instance& instance) {
  const JsonValue* const master = in.find("Master");
  const JsonValue* const slave = in.find("Slave");
  if (master == nullptr || slave == nullptr || master->kind != JsonKind::string ||
      slave->kind != JsonKind::string)
    return;
  const TechnologyObject* const leading = loading_.names().find_object(master->text, kLeading).object;
  const TechnologyObject* const following =
      loading_.names().find_object(slave->text, kSynchronousAxis).object;
  if (leading == nullptr || following == nullptr) return;
  const auto& values = loading_.leading_values_of(*following);
  if (std::any_of(values.begin(), values.end(),
                  [&](const LeadingValue& value) { return value.source == leading; }))
    return;
  problems_.warn(*master, master->shown() + " is not among the leading_values of '" + following->name +
                              "'; the job of '" + instance.name + "' will fail");
}

/// A cycle of a program, which is there where its organization block needs one.
std::int64_t read_cycle(const Fields& fields, Ob ob, const Loading& loading) {
  const JsonValue* const json = fields["cycle"];
  const bool cyclic = ob == Ob::Main || ob == Ob::Cyclic;
  if (json == nullptr) {
    if (cyclic)
      loading.problems.report(fields.value(), "the key 'cycle' is missing; a Main or Cyclic program has one");
    return 0;
  }
  if (!cyclic) {
    loading.problems.report(*json,
                            "a program of " + fields["ob"]->shown() +
                                " runs with motion control and has no cycle; allowed with: Main, Cyclic");
    return 0;
  }
  const auto cycle = read_value(json, keys::kProgram["cycle"], loading);
  const std::int64_t servo_cycle = loading.controller().clock.servo_cycle;
  if (cycle && cycle->integer % servo_cycle != 0)
    loading.problems.report(*json, json->shown() +
                                       " is no whole multiple of servo_cycle; allowed: multiples of " +
                                       duration_text(servo_cycle));
  return cycle ? cycle->integer : servo_cycle;
}

int read_priority(const Fields& fields, Ob ob, const Loading& loading) {
  const JsonValue* const json = fields["priority"];
  if (json != nullptr && ob != Ob::Cyclic) {
    loading.problems.report(
        *json, "a program of " + fields["ob"]->shown() + " has no priority; allowed with: Cyclic");
    return 0;
  }
  const auto priority = read_value(json, keys::kProgram["priority"], loading);
  return priority ? static_cast<int>(priority->integer) : kDefaultPriority;
}

class ProgramsLoader {
 public:
  explicit ProgramsLoader(const Loading& loading) : loading_(loading), problems_(loading.problems) {}

  void load(const JsonValue& json) {
    const Fields fields(json, keys::kProgram, problems_);
    if (!fields.usable()) return;
    const std::string name = read_name(fields["name"]);
    const auto read_ob = read_value(fields, keys::kProgram["ob"], loading_);
    const bool known_ob = read_ob.has_value();
    const Ob ob = known_ob ? static_cast<Ob>(read_ob->integer) : kNoOb;
    const std::int64_t cycle = known_ob ? read_cycle(fields, ob, loading_) : 0;
    const int priority = known_ob ? read_priority(fields, ob, loading_) : 0;
    Program& program = loading_.controller().programs.emplace_back(name, ob, cycle, priority);
    ProgramLoader loader(program, loading_);
    loader.load_calls(fields["calls"]);
    loader.look_at_all();
  }

 private:
  static constexpr Ob kNoOb{255};

  std::string read_name(const JsonValue* json) {
    const auto name = read_string(json, problems_);
    if (!name) return "";
    if (const std::string problem = identifier_problem(*name); !problem.empty())
      problems_.report(*json, problem);
    else if (const auto [first, added] = names_.try_emplace(fold(*name), json); !added)
      problems_.report(*json, "there is a program " + quote(*name) + " already" +
                                  other_place(*first->second, *json) + "; each name is allowed once");
    return std::string(*name);
  }

  const Loading& loading_;
  Problems& problems_;
  std::unordered_map<std::string, const JsonValue*> names_;
};

}  // namespace

void declare_instances(const JsonValue& programs, const Loading& loading) {
  if (programs.kind != JsonKind::array) return;
  for (const JsonValue* const program : programs.elements)
    if (program->kind == JsonKind::object) declare_calls(program->find("calls"), loading);
}

void load_programs(const JsonValue& programs, const Loading& loading) {
  if (read_array(&programs, loading.problems) == nullptr) return;
  ProgramsLoader loader(loading);
  for (const JsonValue* const program : programs.elements) loader.load(*program);
}

}  // namespace lockstep
