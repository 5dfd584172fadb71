#include "projects/expressions/names.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "projects/expressions/letters.hpp"
#include "projects/expressions/own_variables.hpp"
#include "projects/json/problem.hpp"

namespace lockstep {
namespace {

/// Keywords of IEC 61131-3, sorted; none of them is an identifier.
/// @source IEC 61131-3:2013, 6.1.3, and the reserved words of its grammar that a program of Lockstep could
/// hold
constexpr auto kKeywords = std::to_array<std::string_view>({"action",
                                                            "and",
                                                            "any",
                                                            "array",
                                                            "at",
                                                            "bool",
                                                            "by",
                                                            "byte",
                                                            "case",
                                                            "configuration",
                                                            "constant",
                                                            "continue",
                                                            "date",
                                                            "dint",
                                                            "do",
                                                            "dword",
                                                            "else",
                                                            "elsif",
                                                            "end_action",
                                                            "end_case",
                                                            "end_configuration",
                                                            "end_for",
                                                            "end_function",
                                                            "end_function_block",
                                                            "end_if",
                                                            "end_program",
                                                            "end_repeat",
                                                            "end_resource",
                                                            "end_step",
                                                            "end_struct",
                                                            "end_transition",
                                                            "end_type",
                                                            "end_var",
                                                            "end_while",
                                                            "exit",
                                                            "false",
                                                            "for",
                                                            "function",
                                                            "function_block",
                                                            "if",
                                                            "int",
                                                            "lint",
                                                            "lreal",
                                                            "lword",
                                                            "mod",
                                                            "not",
                                                            "of",
                                                            "or",
                                                            "program",
                                                            "real",
                                                            "repeat",
                                                            "resource",
                                                            "retain",
                                                            "return",
                                                            "sint",
                                                            "string",
                                                            "struct",
                                                            "task",
                                                            "then",
                                                            "time",
                                                            "time_of_day",
                                                            "to",
                                                            "transition",
                                                            "true",
                                                            "type",
                                                            "udint",
                                                            "uint",
                                                            "ulint",
                                                            "until",
                                                            "usint",
                                                            "var",
                                                            "var_input",
                                                            "var_output",
                                                            "while",
                                                            "with",
                                                            "word",
                                                            "wstring",
                                                            "xor"});
static_assert(std::is_sorted(kKeywords.begin(), kKeywords.end()));

/// Takes `.Xn` off the end of a path; the number, or -1 if there is none.
int take_bit(std::string_view& path) {
  const auto x = path.find_last_of("xX");
  if (x == path.npos || path.size() - x < 2 || path.size() - x > 3 || (x > 0 && path[x - 1] != '.'))
    return -1;
  int number = 0;
  for (const char c : path.substr(x + 1)) {
    if (!is_digit(c)) return -1;
    number = number * 10 + (c - '0');
  }
  path = path.substr(0, x == 0 ? 0 : x - 1);
  return number;
}

FoundOperand refuse(std::string problem) {
  return {std::nullopt, std::move(problem), false};
}

/// The place, or one bit of it.
FoundOperand with_bit(Operand place, int bit, std::string_view name) {
  if (bit < 0) return {place, "", false};
  const Type type = place.signal.type;
  if (!is_integer(type) && !is_bit_string(type))
    return refuse(quote(name) + " is of type " + std::string(type_name(type)) + ", which has no bits");
  const int width = 8 * size_of(type);
  if (bit >= width)
    return refuse("bit X" + std::to_string(bit) + " does not exist: " + quote(name) + " is of type " +
                  std::string(type_name(type)) + "; allowed: X0 to X" + std::to_string(width - 1));
  place.signal.bit = static_cast<std::int8_t>(bit);
  return {place, "", false};
}

FoundOperand find_pin(const Instance& instance, std::string_view path) {
  const std::string_view whole = path;
  int bit = -1;
  const Pin* pin = instance.type->find_pin(path);
  if (pin == nullptr) {
    bit = take_bit(path);
    pin = instance.type->find_pin(path);
  }
  if (pin == nullptr) {
    std::vector<std::string_view> names;
    for (const Pin& candidate : instance.type->pins)
      if (candidate.type != Type::AXIS && candidate.type != Type::ARRAY) names.push_back(candidate.name);
    const std::string what = "'" + instance.name + "' is an instance of " + std::string(instance.type->name);
    if (whole.empty()) return refuse(what + "; one of its pins has to follow: " + list_of(names));
    return refuse(what + ", which has no pin " + quote(whole) + did_you_mean(whole, names) +
                  "; allowed: " + list_of(names));
  }
  if (pin->type == Type::ARRAY)
    return refuse("the pin '" + std::string(pin->name) + "' takes an array and has no value");
  if (pin->type == Type::AXIS)
    return refuse("the pin '" + std::string(pin->name) + "' takes a technology object and has no value");
  return with_bit(
      {.signal = pin->signal(*instance.block), .unit = pin->unit, .pin = pin, .instance = &instance}, bit,
      path);
}

/// What follows the index of an array: a member, and perhaps a bit.
FoundOperand find_member(const ArrayTag& tag, Operand place, std::string_view path) {
  const ElementType& element = *tag.array.element;
  const std::string what = "'" + tag.name + "' is an " + array_type_name(tag.array);
  int bit = -1;
  if (element.members.empty()) {
    if (path.starts_with('.')) {
      std::string_view rest = path.substr(1);
      bit = take_bit(rest);
      if (bit >= 0 && rest.empty()) path = "";
    }
    if (!path.empty()) return refuse(what + ", whose elements have no part " + quote(path));
    return with_bit(place, bit, tag.name + "[]");
  }
  std::vector<std::string_view> names;
  for (const ElementMember& member : element.members) names.push_back(member.name);
  if (!path.starts_with('.'))
    return refuse(what + "; one of the members of an element has to follow: " + list_of(names));
  const ElementMember* const member = element.find(path.substr(1));
  if (member == nullptr)
    return refuse(what + ", whose elements have no member " + quote(path.substr(1)) +
                  did_you_mean(path.substr(1), names) + "; allowed: " + list_of(names));
  place.signal.address = static_cast<char*>(place.signal.address) + member->offset;
  place.signal.type = member->type;
  place.unit = member->unit;
  return {place, "", false};
}

FoundOperand find_element(const ArrayTag& tag, std::string_view path) {
  const Array& array = tag.array;
  const std::string what = "'" + tag.name + "' is an " + array_type_name(array);
  const auto close = path.find(']');
  if (!path.starts_with('[') || close == path.npos)
    return refuse(what + "; an index has to follow, as in " + tag.name + "[" + std::to_string(array.lower) +
                  "]");
  const std::string_view text = path.substr(1, close - 1);
  Operand place{.signal = {array.memory, array.element->type}, .array = &tag};
  if (text.empty()) {
    place.elements = {array.lower, static_cast<std::uint32_t>(array.count()),
                      static_cast<std::uint32_t>(array.element->size)};
    return find_member(tag, place, path.substr(close + 1));
  }
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc{} || end != text.data() + text.size() || !array.holds(index))
    return refuse(what + " and has no element [" + shown(text) +
                  "]; allowed: " + std::to_string(array.lower) + " to " + std::to_string(array.upper));
  place.signal.address = array.at(index);
  return find_member(tag, place, path.substr(close + 1));
}

/// The elements of a variable of which a path with "[]" leaves the index open.
FoundOperand find_variable_of(TechnologyObject& object, std::string_view path);
FoundOperand find_variables_of(TechnologyObject& object, std::string_view path, std::size_t brackets) {
  std::string first(path);
  first.insert(brackets + 1, "1");
  FoundOperand found = find_variable_of(object, first);
  if (found.place && found.place->variable != nullptr)
    found.place->elements = {1, static_cast<std::uint32_t>(found.place->variable->count),
                             static_cast<std::uint32_t>(found.place->variable->stride)};
  return found;
}

/// The element of an array that one object alone has. @param index "[3]"
FoundOperand find_own_element(const OwnVariable& own, TechnologyObject& object, std::string_view path,
                              std::string_view index) {
  const Variable& variable = own.declaration;
  std::size_t number = 0;
  const char* const last = index.data() + index.size() - 1;
  const auto [end, error] = std::from_chars(index.data() + 1, last, number);
  if (error != std::errc{} || end != last || number < 1 || number > variable.count)
    return refuse("'" + object.name + "." + std::string(path) + "' is no element of an array of " +
                  std::to_string(variable.count) + "; allowed: [1] to [" + std::to_string(variable.count) +
                  "]");
  return {Operand{.signal = {static_cast<char*>(own.address) + (number - 1) * variable.stride, variable.type},
                  .unit = variable.unit,
                  .variable = &variable,
                  .object = &object},
          "", false};
}

/// Of the variables that this object alone has.
std::optional<FoundOperand> find_own_variable(TechnologyObject& object, std::string_view path) {
  const std::size_t open = std::min(path.find('['), path.size());
  for (const OwnVariable& own : own_variables(object)) {
    const Variable& variable = own.declaration;
    const bool array = variable.count > 0;
    if (array != (open < path.size())) continue;
    if (fold(variable.path.substr(0, variable.path.find('['))) != fold(path.substr(0, open))) continue;
    if (array && !path.ends_with(']')) return std::nullopt;  // a bit of an element, if anything
    if (array) return find_own_element(own, object, path, path.substr(open));
    return FoundOperand{Operand{.signal = {own.address, variable.type},
                                .unit = variable.unit,
                                .variable = &variable,
                                .object = &object},
                        "", false};
  }
  return std::nullopt;
}

FoundOperand find_variable_of(TechnologyObject& object, std::string_view path) {
  if (const auto brackets = path.find("[]"); brackets != path.npos)
    return find_variables_of(object, path, brackets);
  void* const data = object.data_block();
  const VariableAddress place = find_variable(object.kind, path);
  if (place.variable != nullptr) {
    if (place.variable->type == Type::TAG) return refuse(quote(path) + " names a tag and has no value");
    expect_reads(object, *place.variable);
    return {Operand{.signal = place.signal(data),
                    .unit = place.variable->unit,
                    .variable = place.variable,
                    .object = &object},
            "", false};
  }
  if (auto own = find_own_variable(object, path)) return std::move(*own);
  std::string_view word = path;
  if (const int bit = take_bit(word); bit >= 0) {
    if (const VariableAddress whole = find_variable(object.kind, word); whole.variable != nullptr)
      return with_bit({.signal = whole.signal(data)}, bit, word);
    if (auto own = find_own_variable(object, word))
      return own->place ? with_bit(*own->place, bit, word) : std::move(*own);
  }
  const std::string what =
      "'" + object.name + "' is a technology object (" + std::string(kind_name(object.kind)) + ")";
  if (path.empty())
    return refuse(what + "; one of its variables has to follow, as in " + object.name + ".StatusWord");
  std::vector<std::string_view> names;
  for (const auto list : data_block_of(object.kind).lists())
    for (const Variable& variable : list) names.push_back(variable.path);
  for (const OwnVariable& own : own_variables(object)) names.push_back(own.declaration.path);
  return refuse(what + ", which has no variable " + quote(path) + did_you_mean(path, names));
}

}  // namespace

std::string identifier_problem(std::string_view name) {
  constexpr std::size_t kLongest = 128;
  constexpr std::string_view kAllowed =
      "; allowed: letters, digits and single underscores, not a digit first or an underscore last";
  bool good = !name.empty() && !is_digit(name.front()) && name.back() != '_';
  for (std::size_t i = 0; i < name.size() && good; ++i) {
    good = is_letter(name[i]) || is_digit(name[i]) || name[i] == '_';
    if (i > 0 && name[i] == '_' && name[i - 1] == '_') good = false;
  }
  if (!good) return quote(name) + " is not a name" + std::string(kAllowed);
  if (name.size() > kLongest)
    return quote(name) + " is too long for a name; allowed: up to " + std::to_string(kLongest) +
           " characters";
  if (std::binary_search(kKeywords.begin(), kKeywords.end(), fold(name)))
    return quote(name) + " is a keyword of IEC 61131-3 and cannot be a name";
  return "";
}

std::string kind_names(ObjectKinds kinds) {
  std::vector<std::string_view> names;
  for (const ObjectKindText& known : kObjectKinds)
    if (among(known.kind, kinds)) names.push_back(known.name);
  return list_of(names);
}

std::string why_not_writable(const Operand& place) {
  if (place.tag != nullptr || place.array != nullptr) return "";
  if (place.pin != nullptr)
    return "a pin cannot be written from outside its call; allowed: tags, and variables that take effect at "
           "run time "
           "(DIR, CAL)";
  const std::string name = "'" + std::string(place.variable->path) + "'";
  if (place.variable->computed) return name + " is computed by the runtime and cannot be written";
  if (place.variable->effect == Effect::RES)
    return name +
           " takes effect only with a restart of the technology object (RES); it is set in 'config', or by "
           "'set_start' and MC_Reset with Restart";
  if (place.variable->effect == Effect::RON)
    return name + " is read-only at run time (RON); it is set in 'config'";
  return "";
}

std::string why_no_start_value(const Operand& place) {
  if (place.variable == nullptr || place.signal.bit >= 0)
    return "only variables of technology objects have start values that can be changed";
  const std::string name = "'" + std::string(place.variable->path) + "'";
  if (place.variable->computed) return name + " is computed by the runtime and has no start value";
  if (place.variable->effect == Effect::RON)
    return name + " is read-only at run time (RON); it is set in 'config'";
  return "";
}

std::string Names::add(std::string_view name, Entity entity) {
  if (std::string problem = identifier_problem(name); !problem.empty()) return problem;
  const auto [place, added] = entries_.try_emplace(fold(name), Entry{std::string(name), entity});
  if (added) return "";
  Entry& first = place->second;
  first.entity = {};
  first.ambiguous = true;
  if (uses_ != nullptr) uses_->names.insert(fold(name));
  const std::string same = first.name == name ? "" : " (as '" + first.name + "', case does not count)";
  return "the name " + quote(name) + " is taken already" + same +
         "; each name is allowed once among tags, technology objects and instances";
}

void Names::define(std::string_view name, Entity entity) {
  Entry& added = entries_.at(fold(name));
  if (!added.ambiguous) added.entity = entity;
}

const Names::Entry* Names::entry(std::string_view name) const {
  const std::string folded = fold(name);
  const auto found = entries_.find(folded);
  if (found == entries_.end()) return nullptr;
  if (uses_ != nullptr) uses_->names.insert(folded);
  return &found->second;
}

const Names::Entity* Names::find_entity(std::string_view name) const {
  const Entry* const found = entry(name);
  return found == nullptr ? nullptr : &found->entity;
}

std::string Names::nearest_name(std::string_view name) const {
  if (uses_ != nullptr && uses_->suggestions_left-- <= 0) return "";
  std::vector<std::string_view> names;
  for (const auto& [folded, entry] : entries_) names.push_back(entry.name);
  std::sort(names.begin(), names.end());
  return did_you_mean(name, names);
}

Names::FoundObject Names::find_object(std::string_view name, ObjectKinds kinds) const {
  const Entity* const entity = find_entity(name);
  if (entity == nullptr)
    return {nullptr, "there is no technology object " + quote(name) + nearest_name(name)};
  if (std::holds_alternative<std::monostate>(*entity)) return {};
  TechnologyObject* const* const object = std::get_if<TechnologyObject*>(entity);
  if (object == nullptr) return {nullptr, quote(name) + " is no technology object"};
  if (among((*object)->kind, kinds)) return {*object, ""};
  return {nullptr, quote(name) + " is a " + std::string(kind_name((*object)->kind)) +
                       "; allowed: " + kind_names(kinds)};
}

FoundOperand Names::unknown(std::string_view name) const {
  return refuse("unknown name " + quote(name) + nearest_name(name));
}

FoundOperand Names::find_within(const Entry& entry, std::string_view path) const {
  if (const auto* tag = std::get_if<const Tag*>(&entry.entity)) {
    const std::string_view whole = path;
    const int bit = take_bit(path);
    if (!path.empty()) return refuse("the tag '" + entry.name + "' has no part " + quote(whole));
    return with_bit({.signal = (*tag)->signal, .tag = *tag}, bit, entry.name);
  }
  if (const auto* array = std::get_if<const ArrayTag*>(&entry.entity)) return find_element(**array, path);
  if (const auto* string = std::get_if<const StringTag*>(&entry.entity)) {
    const std::string what = "'" + entry.name + "' is a " + text_type_name((*string)->text.capacity);
    if (!path.empty()) return refuse(what + ", which has no part " + quote(path));
    return refuse(what + ", a text; allowed here: a number, a bit string, a BOOL or a TIME");
  }
  if (const auto* instance = std::get_if<const Instance*>(&entry.entity)) return find_pin(**instance, path);
  if (TechnologyObject* const* const object = std::get_if<TechnologyObject*>(&entry.entity))
    return find_variable_of(**object, path);
  return {std::nullopt, quote(entry.name) + " " + std::string(kKnownProblem), true};
}

Names::FoundArray Names::find_array(std::string_view name) const {
  const Entity* const entity = find_entity(name);
  if (entity == nullptr) return {nullptr, "there is no tag " + quote(name) + nearest_name(name)};
  if (std::holds_alternative<std::monostate>(*entity)) return {};
  if (const auto* array = std::get_if<const ArrayTag*>(entity)) return {*array, ""};
  return {nullptr, quote(name) + " is no array; allowed: the name of a tag of type ARRAY"};
}

const StringTag* Names::find_string(std::string_view name) const {
  const Entity* const entity = find_entity(name);
  const auto* const string = entity == nullptr ? nullptr : std::get_if<const StringTag*>(entity);
  return string == nullptr ? nullptr : *string;
}

FoundOperand Names::find(std::string_view path) const {
  FoundOperand found = find_elements(path);
  if (found.place && found.place->elements.count > 0)
    return refuse(
        "the index is missing in " + quote(path) +
        "; allowed: " + std::to_string(found.place->elements.lower) + " to " +
        std::to_string(found.place->elements.lower + std::int64_t{found.place->elements.count} - 1));
  return found;
}

FoundOperand Names::find_elements(std::string_view path) const {
  const auto end = path.find_first_of(".[");
  const std::string_view name = path.substr(0, end);
  const Entry* const found = entry(name);
  if (found == nullptr) return unknown(name);
  if (end == path.npos) return find_within(*found, "");
  const std::string_view rest = path.substr(path[end] == '.' ? end + 1 : end);
  if (rest.empty()) return refuse("something has to follow the point in " + quote(path));
  return find_within(*found, rest);
}

Reference Names::resolve(std::string_view name, std::string_view path) const {
  const Entry* const found = entry(name);
  if (const StringTag* const string = path.empty() ? find_string(name) : nullptr)
    return {.signal = std::nullopt, .error = "", .elements = {}, .text = string->text};
  FoundOperand place = found == nullptr ? unknown(name) : find_within(*found, path);
  if (!place.place) return {std::nullopt, std::move(place.problem)};
  return {place.place->signal, "", place.place->elements, {}};
}

}  // namespace lockstep
