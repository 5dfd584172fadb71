// Any expression: it is compiled and evaluated, or is refused. The first byte says for what type.
#include "projects/expressions/compiler.hpp"
#include "tests/fuzz/texts.hpp"

namespace lockstep::fuzz::expression_target {
namespace {

/// A variable of each type, named as its type; and one with a path.
class OneOfEach final : public Scope {
 public:
  OneOfEach() {
    for (std::size_t i = 0; i < kTypes; ++i) values_[i].i = static_cast<std::int64_t>(3 * i);
    values_[static_cast<std::size_t>(Type::REAL)].r = 1.5;
    values_[static_cast<std::size_t>(Type::LREAL)].r = -2.25;
    for (std::size_t i = 0; i < kTypes; ++i) signal(i).store(values_[i]);
  }
  Reference resolve(std::string_view name, std::string_view path) const override {
    if (!path.empty() && path != "Path[1]") return {std::nullopt, "no such path"};
    for (std::size_t i = 0; i < kTypes; ++i)
      if (name == "v" + std::string(type_name(static_cast<Type>(i)))) return {signal(i), ""};
    return {std::nullopt, "no such name"};
  }

 private:
  static constexpr std::size_t kTypes = static_cast<std::size_t>(Type::TIME) + 1;
  Signal signal(std::size_t i) const { return {&memory_[i], static_cast<Type>(i), -1}; }
  Value values_[kTypes]{};
  mutable Value memory_[kTypes]{};
};

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const char* text :
       {"vBOOL AND NOT vWORD.X3 OR (vDINT > 3)", "vLREAL * 2.5E3 - vREAL ** 2", "vINT MOD 7 + vSINT / 0",
        "LIMIT(0, vDINT, 16#FF) + MAX(1, 2, vDINT)", "SEL(vBOOL, T#1s500ms, vTIME)",
        "SQRT(ABS(-vLREAL)) + SIN(0.5)", "TO_INT(vLREAL) XOR TO_INT(vREAL)", "vLREAL.Path[1] <> 3.0 & TRUE",
        "NOT vBYTE OR 2#1010_1010", "((((vULINT))))", "-vLINT <= 9223372036854775807 (* comment *)",
        "TO_REAL(vUDINT) = 1e38"})
    for (const char type : {'\0', '\3', '\xE'}) texts.push_back(type + std::string(text));
  return texts;
}

int take(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const OneOfEach scope;
  const auto type = static_cast<Type>(data[0] % (static_cast<int>(Type::TIME) + 1));
  const CompiledExpression compiled = compile_expression(text_of(data + 1, size - 1), type, scope);
  require(compiled.expression.has_value() == compiled.errors.empty(), "an expression or errors");
  if (!compiled.expression) return 0;
  EvaluationCounters counters;
  const Value value = compiled.expression->evaluate(counters);
  if (is_integer(type) && is_signed_integer(type))
    require(value.i >= lowest(type) && value.i <= static_cast<std::int64_t>(highest(type)),
            "the value is in the range of its type");
  if (is_unsigned_integer(type) || is_bit_string(type))
    require(value.u <= highest(type), "the value is in the range of its type");
  if (type == Type::BOOL) require(value.u <= 1, "a BOOL is 0 or 1");
  return 0;
}

}  // namespace lockstep::fuzz::expression_target
