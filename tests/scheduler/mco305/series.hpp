/// Signals of a run as a scenario names them: MAPOS, SYSVAR[4097], v(x), "mean of v(x) over 20 ms".
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace lockstep {

/// One value for each step.
using Series = std::vector<double>;

/// Reads an expression over recorded signals.
class SeriesReader {
 public:
  explicit SeriesReader(const std::map<std::string, Series>& signals) : signals_(signals) {}

  Series read(const std::string& text) {
    const std::string prefix = "mean of ";
    if (text.starts_with(prefix)) {
      const std::size_t over = text.find(" over ");
      const Series whole = read(text.substr(prefix.size(), over - prefix.size()));
      return mean(whole, std::stoul(text.substr(over + 6)));
    }
    text_ = text;
    at_ = 0;
    const Series result = comparison();
    EXPECT_EQ(at_, text_.size()) << text;
    return result;
  }

 private:
  static Series mean(const Series& of, std::size_t steps) {
    Series result(of.size());
    for (std::size_t i = steps - 1; i < of.size(); ++i) {
      double sum = 0.0;
      for (std::size_t k = 0; k < steps; ++k) sum += of[i - k];
      result[i] = sum / static_cast<double>(steps);
    }
    return result;
  }
  template <class Operation>
  static Series each(const Series& a, const Series& b, Operation operation) {
    Series result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) result[i] = operation(a[i], b[i]);
    return result;
  }
  bool accept(char symbol) {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (at_ == text_.size() || text_[at_] != symbol) return false;
    ++at_;
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return true;
  }
  Series comparison() {
    Series left = masked();
    if (accept('<')) return each(left, masked(), [](double a, double b) { return a < b ? 1.0 : 0.0; });
    if (accept('>')) return each(left, masked(), [](double a, double b) { return a > b ? 1.0 : 0.0; });
    return left;
  }
  Series masked() {
    Series left = sum();
    if (!accept('&')) return left;
    return each(left, sum(), [](double a, double b) {
      return static_cast<double>(static_cast<long>(a) & static_cast<long>(b));
    });
  }
  Series sum() {
    Series left = product();
    for (;;) {
      if (accept('+'))
        left = each(left, product(), [](double a, double b) { return a + b; });
      else if (accept('-'))
        left = each(left, product(), [](double a, double b) { return a - b; });
      else
        return left;
    }
  }
  Series product() {
    Series left = primary();
    while (accept('/')) left = each(left, primary(), [](double a, double b) { return a / b; });
    return left;
  }
  Series primary() {
    if (accept('-')) return each(constant(0.0), primary(), [](double a, double b) { return a - b; });
    std::size_t end = at_;
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) != 0 ||
                                  text_[end] == '.' || text_[end] == '_'))
      ++end;
    std::string name = text_.substr(at_, end - at_);
    at_ = end;
    if (!name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) != 0)
      return constant(std::stod(name));
    if (accept('(')) {
      Series inner = sum();
      accept(')');
      if (name == "abs") {
        for (double& value : inner) value = std::abs(value);
      } else {
        EXPECT_EQ(name, "v");
        Series change(inner.size());
        for (std::size_t i = 1; i < inner.size(); ++i) change[i] = inner[i] - inner[i - 1];
        inner = change;
      }
      return inner;
    }
    if (accept('[')) {
      const std::size_t close = text_.find(']', at_);
      name += "[" + text_.substr(at_, close - at_) + "]";
      at_ = close + 1;
    }
    const auto found = signals_.find(name);
    EXPECT_NE(found, signals_.end()) << name << " of " << text_;
    return found == signals_.end() ? constant(0.0) : found->second;
  }
  Series constant(double value) const { return Series(signals_.begin()->second.size(), value); }

  const std::map<std::string, Series>& signals_;
  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace lockstep
