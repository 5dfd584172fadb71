/// Results of tests as JUnit XML, which systems of continuous integration read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lockstep::cli {

/// What became of one expectation, or of a whole project that could not be simulated.
struct TestCase {
  enum class Result { passed, failed, error };
  std::string name;
  Result result = Result::passed;
  std::string message{};  ///< of what did not pass, on one line
  double seconds = 0.0;   ///< simulated time at which it was looked at
};

/// A project.
struct TestSuite {
  std::string name;
  std::string file;
  std::vector<TestCase> cases{};

  std::size_t count(TestCase::Result result) const;
};

/// The whole document.
std::string junit_xml(const std::vector<TestSuite>& suites);

}  // namespace lockstep::cli
