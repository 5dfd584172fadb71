#include "cli/test/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "hmi_bridge/network/visible_text.hpp"

namespace lockstep::cli {
namespace {

/// The text, with "?" for U+FFFE and U+FFFF, which are no characters of XML.
std::string xml_characters(std::string text) {
  for (const std::string_view none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (std::size_t at = 0; (at = text.find(none, at)) != text.npos;) text.replace(at, none.size(), "?");
  return text;
}

/// A text as the value of an attribute, in its quotes. XML has no control characters, not even escaped ones.
std::string attribute(std::string_view text) {
  std::string result = "\"";
  for (const char c : xml_characters(visible(text))) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      default:
        result += c;
    }
  }
  return result + "\"";
}

std::string counts(std::size_t tests, std::size_t failures, std::size_t errors) {
  return fmt::format(R"(tests="{}" failures="{}" errors="{}")", tests, failures, errors);
}

std::string xml_of(const TestCase& one, const TestSuite& suite) {
  std::string text = fmt::format("    <testcase name={} classname={} time=\"{:.6f}\"", attribute(one.name),
                                 attribute(suite.name), one.seconds);
  if (one.result == TestCase::Result::passed) return text + "/>\n";
  const char* const tag = one.result == TestCase::Result::failed ? "failure" : "error";
  return text + fmt::format(">\n      <{} message={}/>\n    </testcase>\n", tag, attribute(one.message));
}

}  // namespace

std::size_t TestSuite::count(TestCase::Result result) const {
  return static_cast<std::size_t>(std::ranges::count(cases, result, &TestCase::result));
}

std::string junit_xml(const std::vector<TestSuite>& suites) {
  std::string text;
  std::size_t tests = 0, failures = 0, errors = 0;
  for (const TestSuite& suite : suites) {
    const std::size_t failed = suite.count(TestCase::Result::failed);
    const std::size_t wrong = suite.count(TestCase::Result::error);
    tests += suite.cases.size();
    failures += failed;
    errors += wrong;
    text += fmt::format("  <testsuite name={} file={} {}>\n", attribute(suite.name), attribute(suite.file),
                        counts(suite.cases.size(), failed, wrong));
    for (const TestCase& one : suite.cases) text += xml_of(one, suite);
    text += "  </testsuite>\n";
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts(tests, failures, errors) +
         ">\n" + text + "</testsuites>\n";
}

}  // namespace lockstep::cli
