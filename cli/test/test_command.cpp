// lockstep test: simulates projects and tells whether they come to what they expect.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <functional>
#include <stdexcept>

#include "cli/command/command.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/command/whole_file.hpp"
#include "cli/run/told.hpp"
#include "cli/test/junit.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "projects/runtime/judge.hpp"

namespace lockstep::cli {
namespace {

constexpr int kPatience = 500;  // [ms] how long a message waits for its reader

struct TestOptions {
  std::vector<std::string> files;
  std::string junit;
};

double seconds_of(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) * 1e-9;
}

TestCase case_of(const Judgement& judgement) {
  const Expectation& expectation = *judgement.expectation;
  TestCase one{.name = title_of(expectation), .seconds = seconds_of(judgement.at)};
  if (judgement.holds) return one;
  one.result = TestCase::Result::failed;
  one.message = "is " + judgement.actual;
  if (expectation.value || !expectation.text.empty()) {
    Expectation plain = expectation;
    plain.text.clear();
    one.message = "expected: " + title_of(plain) + "; " + one.message;
  }
  return one;
}

std::string line_of(const std::string& file, const Judgement& judgement, const TestCase& one) {
  const Expectation& expectation = *judgement.expectation;
  const std::string place =
      fmt::format("{}:{}", expectation.file.empty() ? file : expectation.file, expectation.line);
  const std::string actual = judgement.holds ? "is " + judgement.actual : one.message;
  return fmt::format("{}  {:.6f} s  {}: {}: {}\n", judgement.holds ? "pass" : "FAIL", one.seconds, place,
                     one.name, actual);
}

/// Its lines go to standard output, what happened in the run to standard error before.
TestSuite test(const std::string& file, int& status) {
  TestSuite suite{.name = file, .file = file, .cases = {}};
  int loading = kOk;
  std::optional<Project> project = load_or_tell(file, loading, {}, Warnings::kept);
  if (!project) {
    status = std::max(status, loading);
    suite.cases.push_back(
        {.name = "check",
         .result = TestCase::Result::error,
         .message = loading == kNotValid ? "the project is not valid" : "the file cannot be read"});
    return suite;
  }
  suite.name = project->name;
  if (project->expectations.list.empty()) write_data(visible(file) + ": no expectations\n");
  ToldOnStandardError told(kPatience);
  const auto judgements = judge(*project, [&told](const TraceEvent& event) { told.event(event); });
  told.tell_rest();
  tell_counters(*project->controller);
  for (const Judgement& judgement : judgements) {
    suite.cases.push_back(case_of(judgement));
    write_data(line_of(visible(file), judgement, suite.cases.back()));
    if (!judgement.holds) status = std::max<int>(status, kNotValid);
  }
  return suite;
}

/// Of a forgotten name the next word of the command line, a project, would be taken and written over.
bool is_xml(const std::string& path) {
  if (path.empty() || path.ends_with(".xml")) return true;
  tell("--junit: '" + path + "' has to end in .xml", Severity::error);
  return false;
}

/// Does what writes the results, or looks whether they may be written.
bool junit_is_well(const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const std::runtime_error& error) {
    tell(std::string("--junit: ") + error.what(), Severity::error);
    return false;
  }
}

/// A green result of nothing would be believed.
int tell_nothing_checked() {
  tell(
      "nothing was checked: no project has \"expectations\", such as [ { \"at\": \"2s\", \"expect\": "
      "\"Axis.Position\", \"value\": 100.0, \"tolerance\": 0.1 } ]; lockstep describe expectations tells "
      "more",
      Severity::error);
  return kCouldNotStart;
}

int run_tests(const TestOptions& options) {
  const std::string& junit = options.junit;
  if (!is_xml(junit)) return kCouldNotStart;
  // Better now than behind simulations that may take long.
  if (!junit.empty() && !junit_is_well([&] { require_writable(junit); })) return kCouldNotStart;
  int status = kOk;
  std::vector<TestSuite> suites;
  std::size_t cases = 0, passed = 0, not_tested = 0;
  for (const std::string& file : options.files) {
    const TestSuite& suite = suites.emplace_back(test(file, status));
    const std::size_t untested = suite.count(TestCase::Result::error);
    cases += suite.cases.size() - untested;
    passed += suite.count(TestCase::Result::passed);
    not_tested += untested;
  }
  const std::size_t empty =
      std::ranges::count_if(suites, [](const auto& suite) { return suite.cases.empty(); });
  std::string rest;
  const auto count = [&](std::size_t number, const char* what) {
    if (number > 0) rest += fmt::format("; {} of {} projects {}", number, options.files.size(), what);
  };
  count(not_tested, "could not be tested");
  count(empty, "have no expectations");
  write_data(fmt::format("{} of {} expectations hold{}\n", passed, cases, rest));
  if (status == kOk && cases == 0) status = tell_nothing_checked();
  if (!junit.empty() && !junit_is_well([&] { write_whole_file(junit, junit_xml(suites)); }))
    return kCouldNotStart;
  return status;
}

}  // namespace

void add_test_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("test", "Simulate projects and tell whether their expectations hold");
  auto options = std::make_shared<TestOptions>();
  command->add_option("FILE", options->files, "project files")->required();
  command->add_option("--junit", options->junit, "write the results to this file (*.xml), as JUnit XML");
  command->footer(
      "Each project is simulated in virtual time, with its stimuli, to its last expectation or for its "
      "\"duration\";\n"
      "Modbus, LCM and kept values are off. Results go to standard output, one a line with the values that "
      "there\n"
      "were, problems of a project, alarms and failed jobs to standard error.\n"
      "Exit status: 0 all expectations hold, 1 one does not or a project is not valid, 2 a file cannot be "
      "read or\n"
      "written, or nothing was checked because no project has \"expectations\"");
  command->callback([&action, options] { action = [options] { return run_tests(*options); }; });
}

}  // namespace lockstep::cli
