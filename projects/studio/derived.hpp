/// Signals that are computed of others, row by row: expressions of the project's language.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "projects/expressions/compiler.hpp"
#include "scheduler/expression.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// `=EXPRESSION`, or `=derivative(EXPRESSION)`, `=integral(EXPRESSION)`, `=mean(EXPRESSION, 100ms)` over
/// time. Of rows in their order; not for several threads at once.
class StudioDerived {
 public:
  /// Type of the value at a path, in any case; none: there is none.
  using TypeAt = std::function<std::optional<Type>(const std::string& path)>;

  static bool is_one(std::string_view path) noexcept { return path.starts_with('='); }
  /// @return nullptr: `problem` says what is wrong
  static std::unique_ptr<StudioDerived> compile(std::string_view text, const TypeAt& type_at,
                                                std::string& problem);

  /// Paths of what it is computed of, each once.
  const std::vector<std::string>& operands() const noexcept { return operands_; }
  /// BOOL or LREAL.
  Type type() const noexcept { return type_; }
  /// The value of a row. @param operands in their order  @param t [ns]  @param follows the row before it
  ///   without a gap
  Value value(std::span<const Value> operands, std::int64_t t, bool follows) noexcept;

 private:
  enum class Over : std::uint8_t { nothing, derivative, integral, mean };
  class Cells;
  struct Cell {
    std::uint64_t memory = 0;
    Type type = Type::LREAL;
  };

  double over_time(double value, std::int64_t t, bool follows);

  std::vector<std::string> operands_;
  std::deque<Cell> cells_;  // of the operands, where the expression reads them
  Expression expression_;
  EvaluationCounters counters_;
  Type type_ = Type::LREAL;
  Over over_ = Over::nothing;
  std::int64_t time_ = 0;  // of a mean [ns]

  // Of the rows before.
  std::int64_t last_t_ = 0;
  double last_ = 0.0;
  double sum_ = 0.0;
  std::deque<std::pair<std::int64_t, double>> window_;
};

}  // namespace lockstep
