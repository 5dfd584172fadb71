#include "projects/studio/derived.hpp"

#include <algorithm>
#include <limits>

#include "projects/literals/duration.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMaximumOfMean = 1'000'000;  // rows
const double kNone = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed(std::string_view text) noexcept {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

/// What stands between the brackets of a call that is the whole text; none: it is no such call.
std::optional<std::string_view> inside_of(std::string_view text, std::string_view name) {
  if (!text.starts_with(name)) return {};
  std::string_view rest = trimmed(text.substr(name.size()));
  if (!rest.starts_with('(') || !rest.ends_with(')')) return {};
  int depth = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '(') ++depth;
    if (rest[i] == ')' && --depth == 0 && i + 1 != rest.size()) return {};
  }
  return depth == 0 ? std::optional(rest.substr(1, rest.size() - 2)) : std::nullopt;
}

}  // namespace

/// Gives each path that is named a cell of its own, which a row fills.
class StudioDerived::Cells final : public Scope {
 public:
  Cells(StudioDerived& derived, const TypeAt& type_at) : derived_(derived), type_at_(type_at) {}

  Reference resolve(std::string_view name, std::string_view path) const override {
    std::string whole(name);
    if (!path.empty() && path.front() != '[') whole += '.';
    whole += path;
    const auto known = std::ranges::find(derived_.operands_, whole);
    if (known != derived_.operands_.end())
      return {signal(static_cast<std::size_t>(known - derived_.operands_.begin())), ""};
    const std::optional<Type> type = type_at_(whole);
    if (!type) return {std::nullopt, "is no value that there is; allowed: paths of signals"};
    derived_.operands_.push_back(whole);
    derived_.cells_.push_back({0, *type});
    return {signal(derived_.cells_.size() - 1), ""};
  }

 private:
  Signal signal(std::size_t index) const {
    Cell& cell = derived_.cells_[index];
    return {&cell.memory, cell.type, -1};
  }

  StudioDerived& derived_;
  const TypeAt& type_at_;
};

std::unique_ptr<StudioDerived> StudioDerived::compile(std::string_view text, const TypeAt& type_at,
                                                      std::string& problem) {
  auto derived = std::make_unique<StudioDerived>();
  if (is_one(text)) text.remove_prefix(1);
  text = trimmed(text);
  if (const auto rate = inside_of(text, "derivative")) {
    derived->over_ = Over::derivative;
    text = *rate;
  } else if (const auto sum = inside_of(text, "integral")) {
    derived->over_ = Over::integral;
    text = *sum;
  } else if (const auto mean = inside_of(text, "mean")) {
    derived->over_ = Over::mean;
    const std::size_t comma = mean->rfind(',');
    const std::string duration(comma == mean->npos ? "" : trimmed(mean->substr(comma + 1)));
    const auto time = parse_duration(duration, problem);
    if (!time || *time <= 0) {
      problem = "mean(EXPRESSION, 100ms) needs a duration above 0 behind its last comma";
      return nullptr;
    }
    derived->time_ = *time;
    text = mean->substr(0, comma);
  }
  const Cells cells(*derived, type_at);
  for (const Type wanted : {Type::LREAL, Type::BOOL}) {
    CompiledExpression compiled = compile_expression(text, wanted, cells);
    if (compiled.expression) {
      derived->expression_ = std::move(*compiled.expression);
      derived->type_ = derived->over_ == Over::nothing ? wanted : Type::LREAL;
      problem.clear();
      return derived;
    }
    // The first reason is that of a number, which is what is wanted as a rule.
    if (problem.empty() && !compiled.errors.empty()) problem = compiled.errors.front().message;
  }
  return nullptr;
}

double StudioDerived::over_time(double value, std::int64_t t, bool follows) {
  const double seconds = static_cast<double>(t - last_t_) * 1e-9;
  switch (over_) {
    case Over::derivative:
      return follows && seconds > 0.0 ? (value - last_) / seconds : kNone;
    case Over::integral:
      sum_ += follows ? 0.5 * (value + last_) * seconds : 0.0;
      return sum_;
    case Over::mean: {
      if (!follows) window_.clear();
      window_.emplace_back(t, value);
      while (window_.front().first <= t - time_ || window_.size() > kMaximumOfMean) window_.pop_front();
      // Summed anew, so that nothing of what has left it stays in the last digits.
      double sum = 0.0;
      for (const auto& [at, one] : window_) sum += one;
      return sum / static_cast<double>(window_.size());
    }
    default:
      return value;
  }
}

Value StudioDerived::value(std::span<const Value> operands, std::int64_t t, bool follows) noexcept {
  for (std::size_t i = 0; i < cells_.size(); ++i)
    Signal{&cells_[i].memory, cells_[i].type, -1}.store(operands[i]);
  Value value = expression_.evaluate(counters_);
  if (over_ == Over::nothing) return value;
  const double number = expression_.type() == Type::BOOL ? static_cast<double>(value.u) : value.r;
  try {
    value.r = over_time(number, t, follows);
  } catch (...) {
    value.r = kNone;
  }
  last_t_ = t;
  last_ = number;
  return value;
}

}  // namespace lockstep
