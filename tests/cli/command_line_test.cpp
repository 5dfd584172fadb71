// What all commands have in common: --help, --version, exit statuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::command_line_test {
namespace {

constexpr const char* kCommands[] = {"check", "run",  "test",    "describe", "tags",  "read",
                                     "write", "plot", "monitor", "doctor",   "studio"};

TEST(CommandLine, EveryCommandHasAHelpThatNamesItsExitStatuses) {
  const Ended all = lockstep({"--help"});
  EXPECT_EQ(all.status, 0);
  for (const char* command : kCommands) {
    EXPECT_NE(all.out.find(std::string("\n  ") + command), std::string::npos) << command;
    const Ended help = lockstep({command, "--help"});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_NE(help.out.find("Exit status"), std::string::npos) << command;
    EXPECT_EQ(help.err, "") << command;
  }
}

TEST(CommandLine, TheVersionIsTold) {
  const Ended version = lockstep({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.substr(0, 9), "lockstep ");
}

TEST(CommandLine, AWrongOneExitsWith2AndSaysSoOnStandardError) {
  const std::vector<std::vector<std::string>> wrong = {{},
                                                       {"descripe"},
                                                       {"plot"},
                                                       {"tags"},
                                                       {"plot", "a.csv"},
                                                       {"monitor", "extra"},
                                                       {"read", "127.0.0.1:1"},
                                                       {"write", "127.0.0.1:1", "--project", "p.json"},
                                                       {"tags", "p.json", "--json", "--csv"},
                                                       {"describe", "--jason"}};
  for (const auto& arguments : wrong) {
    const Ended ended = lockstep(arguments);
    EXPECT_EQ(ended.status, 2) << (arguments.empty() ? "nothing" : arguments.back());
    EXPECT_NE(ended.err, "");
    EXPECT_EQ(ended.out, "");
  }
}

/// What a script gives whose variable is not set is not as if nothing had been asked for.
TEST(CommandLine, AnEmptyTextIsNotTakenForAnOptionThatIsNotThere) {
  const Directory folder;
  const std::string project = folder.write(
      "p.json", R"({ "lockstep": 1, "name": "p", "clock": { "servo_cycle": "1ms" }, "duration": "2ms",
                     "expectations": [ { "at": "1ms", "expect": "TRUE" } ] })");
  const std::string trace = folder.write("t.csv", "t,a\n0,1\n1,2\n"), picture = folder.file("t.svg");
  const std::vector<std::vector<std::string>> commands = {
      {"run", project, "--simulate", "--duration"},
      {"run", project, "--simulate", "--duration", "2ms", "--trace"},
      {"run", project, "--simulate", "--duration", "2ms", "--transcript"},
      {"run", project, "--simulate", "--duration", "2ms", "--lcm"},
      {"run", project, "--duration", "2ms", "--no-retain", "--modbus"},
      {"run", project, "--duration", "2ms", "--retain"},
      {"run", project, "--duration", "2ms", "--no-retain", "--controller"},
      {"run", project, "--duration", "2ms", "--no-retain", "--studio"},
      {"test", project, "--junit"},
      {"plot", trace, "-o", picture, "--project"},
      {"plot", trace, "-o", picture, "--from"},
      {"doctor", "--duration", "10ms", "--servo-cycle"},
      {"check"},
      {"tags"}};
  for (std::vector<std::string> words : commands) {
    const std::string last = words.back();
    words.emplace_back("");
    const Ended ended = lockstep(words);
    EXPECT_EQ(ended.status, 2) << last;
    EXPECT_EQ(ended.out, "") << last;
    EXPECT_NE(ended.err.find("an empty text is no value"), std::string::npos) << last << ": " << ended.err;
  }
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(CommandLine, TheFileOfASystemIsToldAsSuchWhereAProjectIsAskedFor) {
  const std::string system = LOCKSTEP_SOURCE_DIR "/projects/12_two_presses/system.json";
  const Directory folder;
  const std::string trace = folder.write("t.csv", "t,a\n0,1\n1,2\n");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"tags", system},
                                             {"test", system},
                                             {"doctor", system},
                                             {"plot", trace, "-o", folder.file("t.svg"), "--project", system},
                                             {"read", "127.0.0.1:1", "--project", system}}) {
    const Ended ended = lockstep(words);
    EXPECT_NE(ended.status, 0) << words[0];
    EXPECT_NE(ended.err.find("/lockstep_system: this is the file of a system of several controllers; "),
              std::string::npos)
        << words[0] << ": " << ended.err;
    EXPECT_EQ(ended.err.find("unknown key"), std::string::npos) << "one thing in place of all its keys";
  }
}

/// The commands that a help lists, behind "Subcommands:".
std::vector<std::string> commands_in(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help.substr(std::min(help.find("Subcommands:\n"), help.size())));
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line) && line.starts_with("  ");)
    names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

/// The options that take a value; "" stands for a command's own argument.
std::vector<std::string> with_a_value(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help);
  const std::regex option(R"(^  (?:-\w,)?(--[\w-]+) (?:TEXT|INT|UINT|FLOAT|NUMBER|ENUM).*)");
  const std::regex argument(R"(^  [A-Z]+ (?:TEXT|INT|UINT|FLOAT).*)");
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, match, option)) names.push_back(match[1]);
    if (std::regex_match(line, argument)) names.emplace_back();
  }
  return names;
}

/// Tries every option of a command, and of those below it, with an empty value. @return how many
std::size_t try_empty_values(const std::vector<std::string>& command) {
  std::vector<std::string> asking = command;
  asking.emplace_back("--help");
  const std::string help = lockstep(asking).out;
  std::size_t tried = 0;
  for (const std::string& name : with_a_value(help)) {
    ++tried;
    const std::vector<std::vector<std::string>> forms =
        name.empty() ? std::vector<std::vector<std::string>>{{""}}
                     : std::vector<std::vector<std::string>>{{name, ""}, {name + "=", "x"}};
    for (const std::vector<std::string>& form : forms) {
      std::vector<std::string> words = command;
      words.insert(words.end(), form.begin(), form.end());
      const Ended ended = lockstep(words);
      EXPECT_EQ(ended.status, 2) << command.back() << " " << form[0];
      EXPECT_NE(ended.err.find(name + ": an empty text is no value; needed: "), std::string::npos)
          << command.back() << " " << form[0] << ": " << ended.err;
      EXPECT_EQ(ended.out, "");
    }
  }
  for (const std::string& below : commands_in(help)) {
    std::vector<std::string> deeper = command;
    deeper.push_back(below);
    tried += try_empty_values(deeper);
  }
  return tried;
}

// An empty one is that of a variable that is not set; a studio without the token that was asked for would be
// open.
TEST(CommandLine, EveryOptionRefusesAnEmptyValueAndSaysWhatItNeeds) {
  std::size_t tried = 0;
  for (const std::string& command : commands_in(lockstep({"--help"}).out))
    tried += try_empty_values({command});
  EXPECT_GT(tried, 80U);
}

TEST(CommandLine, ARunWithoutTheTokenThatWasAskedForDoesNotBegin) {
  const std::string project = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";
  const Ended ended = lockstep({"run", project, "--no-retain", "--no-modbus", "--no-lcm", "--duration", "1ms",
                                "--studio", "127.0.0.1:0", "--studio-write", "--studio-token-file", ""});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("file of the token"), std::string::npos) << ended.err;
}

// The loop of position control leaves ever less of a deviation, 1e-200 in the end.
TEST(CommandLine, ARunShowsAnAxisThatHasComeToRestAtZeroThere) {
  const std::string project = LOCKSTEP_SOURCE_DIR "/projects/09_flying_saw/project.json";
  const Ended ended = lockstep({"run", project, "--simulate", "--duration", "20s", "--no-retain"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find("  Saw       standing       at 0 mm;"), std::string::npos) << ended.err;
}

TEST(CommandLine, ARunShowsHowFastASpeedAxisTurnsSinceItHasNoPosition) {
  const Directory folder;
  const std::string file = folder.write("project.json", R"({
    "lockstep": 1, "name": "fans", "clock": { "servo_cycle": "1ms" },
    "technology_objects": {
      "Fan": { "type": "TO_SpeedAxis", "drive": { "model": "simulated" } },
      "Pump": { "type": "TO_SpeedAxis", "drive": { "model": "simulated" }, "config": { "Units": { "VelocityUnit": 1082 } } } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
      { "fb": "MC_Power", "name": "power_fan", "in": { "Axis": "Fan", "Enable": true } },
      { "fb": "MC_Power", "name": "power_pump", "in": { "Axis": "Pump", "Enable": true } },
      { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Fan", "Execute": "power_fan.Status", "Velocity": 1500.0 } } ] } ] })");
  const Ended ended = lockstep({"run", file, "--simulate", "--duration", "5s", "--no-retain"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find("  Fan   turning        at 1500 1/min\n"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("  Pump  standing       at 0 1/s\n"), std::string::npos) << ended.err;
}

TEST(CommandLine, ARunTellsHowManyIntegersWereDividedByZeroAndWhenFirst) {
  const Directory folder;
  const std::string file = folder.write("project.json", R"({
    "lockstep": 1, "name": "divided", "clock": { "servo_cycle": "1ms" },
    "tags": { "a": { "type": "DINT" }, "n": { "type": "DINT", "init": -5 } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
      { "set": "a", "to": "7 / n" }, { "set": "n", "to": "n + 1" } ] } ] })");
  const Ended ended = lockstep({"run", file, "--simulate", "--duration", "10ms"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find("1 integer divisions by zero gave 0, the first at 0.005 s\n"), std::string::npos)
      << ended.err;
}

TEST(CommandLine, ARunTellsHowManyIndicesWereOutOfRange) {
  const Directory folder;
  const std::string file = folder.write("project.json", R"({
    "lockstep": 1, "name": "outside", "clock": { "servo_cycle": "1ms" },
    "tags": { "a": { "type": "ARRAY[1..2] OF INT" }, "i": { "type": "INT", "init": 3 } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
      { "set": "a[i]", "to": "a[i + 1]" } ] } ] })");
  const Ended ended = lockstep({"run", file, "--simulate", "--duration", "10ms"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.err.find("20 indices of arrays were out of range"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace lockstep::cli::command_line_test
