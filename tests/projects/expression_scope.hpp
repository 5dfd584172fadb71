/// Tags and variables for tests of expressions: one of each type, and a small object.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>

#include "projects/expressions/compiler.hpp"

namespace lockstep {

class TestScope : public Scope {
 public:
  TestScope() {
    add("flag", flag);
    add("other", other);
    add("sint", sint);
    add("int_", int_);
    add("dint", dint);
    add("lint", lint);
    add("usint", usint);
    add("uint_", uint_);
    add("udint", udint);
    add("ulint", ulint);
    add("byte_", byte_);
    add("word", word);
    add("dword", dword);
    add("lword", lword);
    add("real", real);
    add("lreal", lreal);
    add("time", time);
    add("number", number);
    add("gear.done", flag);
    add("knife.statusword", dword);
    add("knife.sensor[1].position", lreal);
    add("knife.x5", lint);
    signals_["knife.object"] = {&object, Type::AXIS, -1};
  }

  Reference resolve(std::string_view name, std::string_view path) const override {
    std::string key(name);
    if (!path.empty()) key += (path.front() == '[' ? "" : ".") + std::string(path);
    for (char& c : key)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const auto found = signals_.find(key);
    if (found == signals_.end()) return {std::nullopt, "'" + key + "' is unknown; did you mean 'flag'?"};
    return {found->second, ""};
  }

  BOOL flag = true;
  BOOL other = false;
  SINT sint = -7;
  INT int_ = 300;
  DINT dint = -70000;
  LINT lint = 5'000'000'000;
  USINT usint = 200;
  UINT uint_ = 60000;
  UDINT udint = 4'000'000'000;
  ULINT ulint = std::numeric_limits<ULINT>::max();
  BYTE byte_{0xA5};
  WORD word{0x1234};
  DWORD dword{0x80000001};
  LWORD lword{0xF000000000000001};
  REAL real = 1.5f;
  LREAL lreal = 2.25;
  TIME time{1'500'000'000};
  DB_ANY number{3};
  void* object = nullptr;

 private:
  template <class T>
  void add(const std::string& name, T& value) {
    signals_[name] = Signal{&value, type_of<T>(), -1};
  }

  std::map<std::string, Signal> signals_;
};

/// Compiles and evaluates texts.
class ExpressionTest : public ::testing::Test {
 protected:
  Value value(const std::string& text, Type wanted) {
    const CompiledExpression compiled = compile_expression(text, wanted, scope);
    for (const ExpressionError& error : compiled.errors)
      ADD_FAILURE() << text << ": column " << error.column << ": " << error.message;
    return compiled.expression ? compiled.expression->evaluate(counters) : Value{};
  }
  double real(const std::string& text, Type wanted = Type::LREAL) { return value(text, wanted).r; }
  std::int64_t integer(const std::string& text, Type wanted = Type::LINT) { return value(text, wanted).i; }
  std::uint64_t bits(const std::string& text, Type wanted = Type::LWORD) { return value(text, wanted).u; }
  bool truth(const std::string& text) { return value(text, Type::BOOL).u != 0; }
  /// The first error as "column: message"; empty if there is none.
  std::string error(const std::string& text, Type wanted) {
    const CompiledExpression compiled = compile_expression(text, wanted, scope);
    EXPECT_NE(compiled.expression.has_value(), !compiled.errors.empty()) << text;
    if (compiled.errors.empty()) return "";
    return std::to_string(compiled.errors.front().column) + ": " + compiled.errors.front().message;
  }
  bool accepts(const std::string& text, Type wanted) { return error(text, wanted).empty(); }
  /// The column of the only warning; 0 if there is none.
  int warning(const std::string& text, Type wanted) {
    const CompiledExpression compiled = compile_expression(text, wanted, scope);
    EXPECT_TRUE(compiled.expression) << text;
    EXPECT_LE(compiled.warnings.size(), 1u) << text;
    return compiled.warnings.empty() ? 0 : compiled.warnings.front().column;
  }

  TestScope scope;
  EvaluationCounters counters;
};

}  // namespace lockstep
