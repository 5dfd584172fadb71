/// The printed programs, where the document lies beside the sources; its text stays there.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/projects/aposs/program_run.hpp"

namespace lockstep::aposs::printed_programs {

namespace fs = std::filesystem;

inline const fs::path kDocument =
    fs::path(LOCKSTEP_SOURCE_DIR).parent_path() / "shared" / "manuals" / "002_751af5590a647f38.txt";

/// The lines of a printed program. Of lines of a table, what stands between "<pre>" and "</pre>"; what is
/// left of the table is no program.
inline Lines printed_lines(const nlohmann::json& program, const Lines& document) {
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

inline std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

inline const std::map<std::string, Expected>& expected() {
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

inline Lines document_lines() {
  Lines document;
  std::ifstream file(kDocument);
  for (std::string line; std::getline(file, line);) document.push_back(line);
  return document;
}

inline nlohmann::json printed_catalogue() {
  return nlohmann::json::parse(
      std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/mco305/printed_programs.json"));
}

/// The text of a program as the print has to be corrected, where the document is there.
/// @param ending what follows it, in place of what it takes to be read
inline std::optional<std::string> corrected(const std::string& id, const std::vector<Correction>& more = {},
                                            const std::optional<std::string>& ending = std::nullopt) {
  if (!fs::exists(kDocument)) {
    std::printf("%s is not there; nothing was run\n", kDocument.c_str());
    return std::nullopt;
  }
  const Lines document = document_lines();
  const nlohmann::json catalogue = printed_catalogue();
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
    return text + ending.value_or(expected().at(id).ending);
  }
  return std::nullopt;
}

}  // namespace lockstep::aposs::printed_programs
