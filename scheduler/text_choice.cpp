#include "scheduler/text_choice.hpp"

#include <algorithm>

namespace lockstep {

std::string_view TextSource::view(EvaluationCounters& counters) const noexcept {
  const TextSource* source = this;
  while (!source->tag && source->choice != nullptr) source = &source->choice->chosen(counters);
  return source->tag ? source->tag->view() : std::string_view(source->literal);
}

std::size_t TextSource::capacity() const noexcept {
  if (tag) return tag->capacity;
  if (choice == nullptr) return literal.size();
  std::size_t capacity = 0;
  for (const TextSource& input : choice->inputs) capacity = std::max(capacity, input.capacity());
  return capacity;
}

const TextSource& TextChoice::chosen(EvaluationCounters& counters) const noexcept {
  const Value value = chooser.evaluate(counters);
  const auto last = static_cast<std::int64_t>(inputs.size()) - 1;
  const std::int64_t index =
      chooser.type() == Type::BOOL ? std::int64_t{value.u != 0} : std::clamp<std::int64_t>(value.i, 0, last);
  return inputs[static_cast<std::size_t>(index)];
}

}  // namespace lockstep
