#include "projects/expressions/array_type.hpp"

#include <charconv>
#include <limits>
#include <string>
#include <vector>

#include "projects/expressions/constant.hpp"
#include "projects/json/fields.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMaximumElements = 100'000;

/// Reads a text from left to right, blanks left out.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  /// Takes a word or sign in any case; whether it was there.
  bool take(std::string_view word) {
    skip_blanks();
    if (!same_name(text_.substr(0, word.size()), word)) return false;
    text_.remove_prefix(word.size());
    return true;
  }
  std::optional<DINT> take_bound() {
    skip_blanks();
    DINT bound = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), bound);
    if (error != std::errc{}) return std::nullopt;
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return bound;
  }
  std::string_view rest() {
    skip_blanks();
    while (text_.ends_with(' ')) text_.remove_suffix(1);
    return text_;
  }

 private:
  void skip_blanks() {
    while (text_.starts_with(' ')) text_.remove_prefix(1);
  }

  std::string_view text_;
};

std::vector<std::string_view> element_names() {
  std::vector<std::string_view> names;
  for (int type = 0; type <= static_cast<int>(Type::TIME); ++type)
    names.push_back(type_name(static_cast<Type>(type)));
  for (const ElementType* structure : structure_types()) names.push_back(structure->name);
  return names;
}

void read_member(const JsonValue& json, const ElementMember& member, char* element, Problems& problems) {
  const auto value = read_constant(json, member.type, problems);
  if (value) Signal{element + member.offset, member.type}.store(*value);
}

void read_structure(const JsonValue& json, const ElementType& type, char* element, Problems& problems) {
  std::vector<std::string_view> names;
  for (const ElementMember& member : type.members) names.push_back(member.name);
  if (json.kind == JsonKind::object) {
    for (const auto& [name, value] : json.members) {
      const ElementMember* const member = type.find(name);
      if (member == nullptr || member->name != name)
        problems.report(*value, "unknown member " + quote(name) + " of " + std::string(type.name) +
                                    did_you_mean(name, names) + "; allowed: " + list_of(names));
      else
        read_member(*value, *member, element, problems);
    }
    return;
  }
  if (json.kind != JsonKind::array)
    return report_kind(
        json, "an object of the members of " + std::string(type.name) + ", or an array of them", problems);
  if (json.elements.size() > type.members.size())
    return problems.report(json, "there are " + std::to_string(json.elements.size()) + " values; a " +
                                     std::string(type.name) + " has " + std::to_string(type.members.size()) +
                                     " members: " + list_of(names));
  for (std::size_t i = 0; i < json.elements.size(); ++i)
    read_member(*json.elements[i], type.members[i], element, problems);
}

}  // namespace

std::string array_type_pattern() {
  std::string names;
  for (const std::string_view name : element_names()) names += (names.empty() ? "" : "|") + std::string(name);
  const std::string bound = " *-?[0-9]+ *";
  return "^[Aa][Rr][Rr][Aa][Yy] *\\[" + bound + "\\.\\." + bound + "\\] *[Oo][Ff] *(" + names + ") *$";
}

bool is_array_type(std::string_view text) noexcept {
  return same_name(text.substr(0, 5), "ARRAY");
}

std::optional<Array> read_array_type(const JsonValue& json, Problems& problems) {
  Reader reader(json.text);
  Array array;
  const bool begins = reader.take("ARRAY") && reader.take("[");
  const auto lower = begins ? reader.take_bound() : std::nullopt;
  const bool dots = lower && reader.take("..");
  const auto upper = dots ? reader.take_bound() : std::nullopt;
  if (!upper || !reader.take("]") || !reader.take("OF")) {
    problems.report(json, json.shown() +
                              " is no type of an array; allowed: ARRAY[lower..upper] OF type, such "
                              "as ARRAY[1..100] OF LREAL");
    return std::nullopt;
  }
  array.lower = *lower;
  array.upper = *upper;
  const std::string_view name = reader.rest();
  array.element = find_element_type(name);
  const auto names = element_names();
  if (array.element == nullptr)
    problems.report(json, "unknown type " + quote(name) + " of elements" + did_you_mean(name, names) +
                              "; allowed: " + list_of(names));
  if (array.upper < array.lower)
    problems.report(json, "the upper bound " + std::to_string(array.upper) +
                              " is less than the lower bound " + std::to_string(array.lower));
  else if (array.count() > kMaximumElements)
    problems.report(json, json.shown() + " has " + std::to_string(array.count()) + " elements; allowed are " +
                              std::to_string(kMaximumElements));
  else if (array.element != nullptr)
    return array;
  return std::nullopt;
}

void read_array_values(const JsonValue& json, const Array& array, Problems& problems) {
  if (read_array(&json, problems) == nullptr) return;
  if (json.elements.size() > array.count())
    return problems.report(json, "there are " + std::to_string(json.elements.size()) +
                                     " values; the array has " + std::to_string(array.count()) + " elements");
  for (std::size_t i = 0; i < json.elements.size(); ++i) {
    char* const element = array.at(std::int64_t{array.lower} + static_cast<std::int64_t>(i));
    if (!array.element->members.empty()) {
      read_structure(*json.elements[i], *array.element, element, problems);
    } else if (const auto value = read_constant(*json.elements[i], array.element->type, problems)) {
      Signal{element, array.element->type}.store(*value);
    }
  }
}

}  // namespace lockstep
