// The printed programs, where the document lies beside the sources: as printed each has exactly these
// messages, and with the corrections of the print none but the warnings.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "tests/projects/aposs/program_run.hpp"
#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep::aposs::printed_program_test {
namespace {

namespace fs = std::filesystem;

const fs::path kDocument =
    fs::path(LOCKSTEP_SOURCE_DIR).parent_path() / "shared" / "manuals" / "002_751af5590a647f38.txt";

/// The lines of a printed program. Of lines of a table, what stands between "<pre>" and "</pre>"; what is
/// left of the table is no program.
Lines printed_lines(const nlohmann::json& program, const Lines& document) {
  Lines result;
  const auto is_table = [](const std::string& line) {
    return line.starts_with("<b>") || line.find("<p>") != line.npos || line.empty();
  };
  for (const auto& range : program.at("lines"))
    for (std::size_t n = range[0]; n <= range[1].get<std::size_t>(); ++n) {
      std::string line = document.at(n - 1);
      if (const std::size_t begin = line.find("<pre>"); begin != line.npos)
        line = line.substr(begin + 5, line.find("</pre>") - begin - 5);
      else if (is_table(line))
        continue;
      result.push_back(line);
    }
  return result;
}

/// What is put in place of a piece of a line.
struct Correction {
  std::string piece, by;
};
/// What is said of a program, without its file, and what it takes to be read.
struct Expected {
  Lines errors;
  std::vector<Correction> corrections;
  std::string ending;  ///< what follows the printed text
};

const std::map<std::string, Expected>& expected();

std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TEST(AposPrintedPrograms, HaveTheMessagesOfThePrintAndCompileWithItsCorrections) {
  if (!fs::exists(kDocument)) {
    std::printf("%s is not there; nothing was compared\n", kDocument.c_str());
    return;
  }
  Lines document;
  std::ifstream file(kDocument);
  for (std::string line; std::getline(file, line);) document.push_back(line);
  const nlohmann::json catalogue =
      nlohmann::json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/mco305/printed_programs.json"));
  std::set<std::string> seen;
  for (const auto& program : catalogue.at("programs")) {
    const std::string id = program.at("id");
    seen.insert(id);
    ASSERT_TRUE(expected().contains(id)) << id;
    const Expected& wanted = expected().at(id);
    std::string text = joined(printed_lines(program, document));
    const CompiledProgram printed = compile_program(id, text);
    Lines errors;
    for (const Message& error : printed.errors) errors.push_back(to_string(printed.files, error));
    EXPECT_EQ(errors, wanted.errors) << id;
    for (const Correction& correction : wanted.corrections) {
      const std::size_t at = text.find(correction.piece);
      ASSERT_NE(at, text.npos) << id << ": " << correction.piece;
      text.replace(at, correction.piece.size(), correction.by);
    }
    const CompiledProgram corrected = compile_program(id, text + wanted.ending);
    EXPECT_TRUE(corrected.errors.empty())
        << to_string(corrected.files, corrected.errors.empty() ? Message{} : corrected.errors[0]);
  }
  EXPECT_EQ(seen.size(), expected().size());
}

/// The text of a program as the print has to be corrected, where the document is there.
std::optional<std::string> corrected(const std::string& id, const std::vector<Correction>& more) {
  if (!fs::exists(kDocument)) {
    std::printf("%s is not there; nothing was run\n", kDocument.c_str());
    return std::nullopt;
  }
  Lines document;
  std::ifstream file(kDocument);
  for (std::string line; std::getline(file, line);) document.push_back(line);
  const nlohmann::json catalogue =
      nlohmann::json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/mco305/printed_programs.json"));
  for (const auto& program : catalogue.at("programs")) {
    if (program.at("id") != id) continue;
    std::string text = joined(printed_lines(program, document));
    std::vector<Correction> all = expected().at(id).corrections;
    all.insert(all.end(), more.begin(), more.end());
    for (const Correction& correction : all) {
      const std::size_t at = text.find(correction.piece);
      if (at == text.npos) {
        ADD_FAILURE() << id << ": " << correction.piece;
        continue;
      }
      text.replace(at, correction.piece.size(), correction.by);
    }
    return text + expected().at(id).ending;
  }
  return std::nullopt;
}

/// A printed program in a device of 100 qc/ms whose master turns.
class PrintedRun : public DeviceRun {
 public:
  explicit PrintedRun(const std::string& text) {
    for (const auto& [name, value] : {std::pair{"ENCODER", 500.0},
                                      {"MENCODER", 500.0},
                                      {"VELMAX", 3000.0},
                                      {"RAMPMIN", 0.5},
                                      {"SYNCTYPE", 1.0}})
      set(name, value);
    object.master.signal = &turned_;
    object.steps_per_millisecond = 3;  // so that what a pass begins is seen before the next one
    object.settings.drive.signals.reference_cam = PositionRange{5000.0, 6000.0};
    object.settings.markers = {.period = 4040.0};
    object.settings.master_marks = {.period = 4000.0};
    add_program(text);
  }
  void turn(int steps, int by) {
    for (int i = 0; i < steps; ++i) {
      turned_ += by;
      step();
      changes_ += object.device().following() != followed_ ? 1 : 0;
      followed_ = object.device().following();
    }
  }
  void input(std::size_t number, bool on) { object.device().io().set_input(number, on); }
  bool output(std::size_t number) { return object.device().io().output(number); }
  int changes() const { return changes_; }

 private:
  DINT turned_ = 0;
  bool followed_ = false;
  int changes_ = 0;
};

// A4: as printed, SYNCV is stopped and started again while the input stays on.
TEST(AposPrintedPrograms, A4FollowsByVelocityAndStopsEverySecondPass) {
  const auto text = corrected("A4", {});
  if (!text) return;
  PrintedRun run(*text);
  run.begin();
  run.turn(100, 20);
  EXPECT_EQ(run.changes(), 0);
  run.input(1, true);
  run.turn(3000, 20);
  EXPECT_GE(run.changes(), 2);
  EXPECT_EQ(run.object.machine().error(), 0);
  run.input(1, false);
  run.turn(1000, 20);
  EXPECT_EQ(run.object.device().set_velocity_now(), 0.0);
  EXPECT_FALSE(run.object.device().following());
}

// A5: steps of the offset come at most every 500 ms, none before the timer has run once; GET 132 is error
// 112.
TEST(AposPrintedPrograms, A5MovesItsOffsetAtMostEvery500Milliseconds) {
  const auto text = corrected("A5", {});
  if (!text) return;
  PrintedRun run(*text);
  run.set("33-03", 10);
  run.set("33-04", 1);
  run.set("1900", 100);
  run.set("1901", 1);
  run.begin();
  run.input(2, true);
  run.turn(50, 0);
  run.input(2, false);
  run.turn(8000, 0);
  ASSERT_TRUE(run.output(2)) << "homed";
  run.input(1, true);
  run.turn(2000, 20);
  ASSERT_TRUE(run.object.device().following());
  EXPECT_TRUE(run.output(1)) << "accurate";
  const auto apart = [&] {
    return run.object.device().actual_units() - run.object.device().master().shown();
  };
  const std::int32_t before = apart();
  const auto press = [&](int pause) {
    run.input(4, true);
    run.turn(100, 20);
    run.input(4, false);
    run.turn(pause, 20);
  };
  press(700);
  EXPECT_NEAR(apart(), before, 1) << "no step is enabled yet";
  for (int i = 0; i < 4; ++i) press(700);
  EXPECT_NEAR(apart(), before + 400, 1);
  press(200);
  press(700);
  EXPECT_NEAR(apart(), before + 500, 1) << "the second one comes within 500 ms";
  run.input(4, false);
  run.input(1, false);
  run.turn(1000, 20);
  EXPECT_EQ(run.object.device().pending().first(), 112);
  EXPECT_TRUE(run.output(8));
  run.input(8, true);
  run.turn(100, 0);
  EXPECT_EQ(run.object.device().pending().first(), 0);
}

// A6: the mean distances of markers become SYNCMPULSS and SYNCMPULSM, and it follows by them.
TEST(AposPrintedPrograms, A6MeasuresTheDistancesOfMarkers) {
  const auto text = corrected("A6", {{"old_mipos = new_mipos", "old_ipos = new_ipos"},
                                     {"old_mipos = MIPOS", "OUT 2 1\nold_mipos = MIPOS"}});
  if (!text) return;
  std::string program = *text;
  const std::size_t second = program.rfind("WHILE (IN 2 == 1)");
  ASSERT_NE(second, program.npos);
  program.replace(second, 17, "WHILE (IN 3 == 1)");
  PrintedRun run(program);
  run.set("1900", 20);
  run.begin();
  run.input(2, true);
  run.turn(3000, 0);
  EXPECT_TRUE(run.output(2));
  run.input(2, false);
  run.turn(1000, 0);
  EXPECT_EQ(run.object.parameters()[mco305::kSyncMPulsS], 4040);
  run.input(3, true);
  run.turn(3000, 20);
  run.input(3, false);
  run.turn(10, 20);
  EXPECT_EQ(run.object.parameters()[mco305::kSyncMPulsM], 4000);
  run.input(1, true);
  run.turn(500, 20);
  EXPECT_GE(run.changes(), 1);
  EXPECT_EQ(run.object.machine().error(), 0);
}

const std::map<std::string, Expected>& expected() {
  static const std::string handlers =
      "SUBMAINPROG\nSUBPROG hitinfo\nRETURN\nSUBPROG hitzero\nRETURN\nSUBPROG hitposdir\nRETURN\nENDPROG\n";
  static const std::map<std::string, Expected> programs = {
      {"A1", {}},
      {"A2", {}},
      {"A3", {}},
      {"A4", {}},
      {"A5", {}},
      {"A6",
       {{"A6:11:1: '*' cannot begin a statement; allowed: a command, a label, a variable",
         "A6:65:1: ENDIF without IF; the IF of line 58 ended in line 63"},
        {{"\n*****", "\n/*****"}, {"    ENDIF\n  ENDIF\n", "    ENDIF\n"}},
        ""}},
      {"A7", {}},
      {"A8", {}},
      {"A9", {}},
      {"A10", {}},
      {"A11",
       {{"A11:2:16: '1' cannot begin a statement; allowed: a command, a label, a variable",
         "A11:3:15: '8' cannot begin a statement; allowed: a command, a label, a variable",
         "A11:4:15: '1' cannot begin a statement; allowed: a command, a label, a variable",
         "A11:5:15: '8' cannot begin a statement; allowed: a command, a label, a variable",
         "A11:6:15: '11' cannot begin a statement; allowed: a command, a label, a variable"},
        {{"/*****/\n  Inputs", "/*****\n  Inputs"}, {"/***** Interrupts", "*/ // Interrupts"}},
        ""}},
      {"B1",
       {{"B1:8:1: IF of line 2 has no ENDIF before end of the file", "B1:4:7: there is no SUBPROG 'syncprog'",
         "B1:6:7: there is no SUBPROG 'speedprog'"},
        {{"GOTO main", "ENDIF\nGOTO main"}},
        "SUBMAINPROG\nSUBPROG syncprog\nRETURN\nSUBPROG speedprog\nRETURN\nENDPROG\n"}},
      {"B2", {}},
      {"B9",  // the lines of the table have run together
       {{"B9:2:1: SUBPROG outside of SUBMAINPROG and ENDPROG; allowed: between them",
         "B9:11:1: ENDPROG without SUBMAINPROG"},
        {{"SET SYNCMTYPS", "\nSET SYNCMTYPS"},
         {"CVEL", "\nCVEL"},
         {"CSTART", "\nCSTART"},
         {"mainloop:", "\nmainloop:"},
         {"GOTO mainloop", "\nGOTO mainloop"},
         {"SUBMAINPROG", "\nSUBMAINPROG"}},
        ""}},
      {"B10", {}},
      {"B11",
       {{"B11:1:32: OUT 11 is read as output 11 without a state; allowed: OUT 1 1, OUT 11 0, OUT 11 1 "
         "(outputs: 1 to 8, 21, 22, 27, 29, X34/1, X34/5, X34/10)",
         "B11:2:33: OUT 11 is read as output 11 without a state; allowed: OUT 1 1, OUT 11 0, OUT 11 1 "
         "(outputs: 1 to 8, 21, 22, 27, 29, X34/1, X34/5, X34/10)"},
        {{"OUT 11", "OUT 1 1"}, {"OUT 11", "OUT 1 1"}},
        ""}},
      {"B13",
       {{"B13:1:28: there is no SUBPROG 'hitinfo'", "B13:2:27: there is no SUBPROG 'hitinfo'",
         "B13:3:27: there is no SUBPROG 'hitinfo'", "B13:4:27: there is no SUBPROG 'hitzero'",
         "B13:5:27: there is no SUBPROG 'hitzero'", "B13:6:27: there is no SUBPROG 'hitinfo'",
         "B13:7:19: there is no SUBPROG 'hitinfo'", "B13:8:23: there is no SUBPROG 'hitinfo'"},
        {},
        handlers}},
      {"B14",
       {{"B14:3:1: '.' cannot begin a statement; allowed: a command, a label, a variable",
         "B14:1:23: there is no SUBPROG 'hitinfo'", "B14:2:23: there is no SUBPROG 'hitinfo'",
         "B14:4:23: there is no SUBPROG 'hitposdir'"},
        {{"...", ""}},
        handlers}},
      {"B22",  // likewise, and the value of a parameter is left open
       {{},
        {{"SET KPROP ...", "\nSET KPROP 30"},
         {"SWAPMENC ON", "\nSWAPMENC ON"},
         {"MOTOR ON", "\nmotor on"},
         {"POSA 10000", "\nPOSA 10000"},
         {"MOTOR OFF OUT 1 0", "\nMOTOR OFF\nOUT 1 0"},
         {"SET KPROP ...", "\nSET KPROP 30"},
         {"SWAPMENC OFF", "\nSWAPMENC OFF"},
         {"MOTOR ON", "\nMOTOR ON"},
         {"POSA 0", "\nPOSA 0"}},
        ""}},
      {"B24",
       {{},
        {{"TESTSETP", "\nTESTSETP"}, {"tstrunarray", "tstfahrtarray"}, {"TESTSTART", "\nTESTSTART"}},
        ""}},
      {"B26", {}},
      {"B28",
       {{"B28:1:1: '`' means nothing here; names have letters, digits and underscores",
         "B28:1:2: '`' means nothing here; names have letters, digits and underscores",
         "B28:1:3: '`' means nothing here; names have letters, digits and underscores",
         "B28:6:1: SUBPROG outside of SUBMAINPROG and ENDPROG; allowed: between them"},
        {{"```", ""}, {"SUBPROG err_handle", "SUBMAINPROG\nSUBPROG err_handle"}},
        ""}},
  };
  return programs;
}

}  // namespace
}  // namespace lockstep::aposs::printed_program_test
