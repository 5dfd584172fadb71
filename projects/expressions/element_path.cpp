#include "projects/expressions/element_path.hpp"

#include <charconv>
#include <utility>

#include "projects/json/problem.hpp"

namespace lockstep {
namespace {

/// The index of a path that stands for several: where its text begins and ends.
struct Brackets {
  std::size_t open, close;
};

bool is_range(std::string_view index) {
  return index == "*" || index.find("..") != index.npos;
}

std::optional<Brackets> range_in(std::string_view path, std::size_t from) {
  for (std::size_t open = path.find('[', from); open != path.npos; open = path.find('[', open + 1)) {
    const std::size_t close = path.find(']', open);
    if (close == path.npos) return std::nullopt;
    if (is_range(path.substr(open + 1, close - open - 1))) return Brackets{open, close};
  }
  return std::nullopt;
}

std::optional<std::int64_t> number(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  std::int64_t result = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return result;
}

std::string span_text(std::int64_t first, std::int64_t last) {
  return std::to_string(first) + ".." + std::to_string(last);
}

/// Reads "2..5" into the elements; what is wrong with it, else nothing.
std::string take_range(std::string_view index, std::string_view path, ElementPath& elements) {
  const std::string allowed =
      "; allowed: [*], or a range within [" + span_text(elements.first, elements.last) + "]";
  const std::size_t dots = index.find("..");
  const auto first = number(index.substr(0, dots));
  const auto last = number(index.substr(dots + 2));
  if (!first || !last || *last < *first)
    return "[" + std::string(index) + "] in " + quote(path) + " is no range of elements" + allowed;
  if (*first < elements.first || *last > elements.last)
    return quote(path) + " goes beyond the elements that there are" + allowed;
  elements.place.signal.address = static_cast<char*>(elements.place.signal.address) +
                                  static_cast<std::size_t>(*first - elements.first) * elements.stride;
  elements.first = *first;
  elements.last = *last;
  return "";
}

}  // namespace

Signal ElementPath::signal_of(std::int64_t index) const noexcept {
  Signal signal = place.signal;
  signal.address = static_cast<char*>(signal.address) + static_cast<std::size_t>(index - first) * stride;
  return signal;
}

FoundElements find_several(const Names& names, std::string_view path) {
  auto brackets = range_in(path, 0);
  std::string open_path(path);
  std::string_view index = "*";
  if (brackets) {
    index = path.substr(brackets->open + 1, brackets->close - brackets->open - 1);
    if (range_in(path, brackets->close))
      return {std::nullopt, "only one index of " + quote(path) + " may stand for several elements", false};
    open_path.erase(brackets->open + 1, index.size());
  } else {
    const Names::Entity* const entity =
        path.find_first_of(".[") == path.npos ? names.find_entity(path) : nullptr;
    if (entity == nullptr || !std::holds_alternative<const ArrayTag*>(*entity)) return {};
    open_path += "[]";
    brackets = Brackets{path.size(), path.size() + 1};
  }
  FoundOperand found = names.find_elements(open_path);
  if (!found.place) return {std::nullopt, std::move(found.problem), found.known_problem};
  const ElementRange range = found.place->elements;
  if (range.count == 0)
    return {std::nullopt, quote(path) + " does not name several elements; allowed: one of them", false};
  ElementPath elements;
  elements.before = open_path.substr(0, brackets->open + 1);
  elements.behind = open_path.substr(brackets->open + 1);
  elements.first = range.lower;
  elements.last = range.lower + std::int64_t{range.count} - 1;
  elements.is_all = index == "*";
  elements.place = *found.place;
  elements.stride = range.stride;
  const std::int64_t lower = elements.first;
  const std::int64_t upper = elements.last;
  if (!elements.is_all)
    if (std::string problem = take_range(index, path, elements); !problem.empty())
      return {std::nullopt, std::move(problem), false};
  const bool is_whole_tag = elements.place.array != nullptr && elements.behind == "]" &&
                            elements.first == lower && elements.last == upper;
  const std::string span = span_text(elements.first, elements.last);
  elements.name = is_whole_tag ? elements.before.substr(0, elements.before.size() - 1)
                               : elements.before + span + elements.behind;
  elements.type = "ARRAY[" + span + "] OF " + std::string(type_name(elements.place.signal.value_type()));
  return {std::move(elements), "", false};
}

}  // namespace lockstep
