// The printed programs: as printed each has exactly these messages, and with the corrections of the print
// none but the warnings.
#include <gtest/gtest.h>

#include <set>

#include "tests/projects/aposs/printed_programs.hpp"

namespace lockstep::aposs::printed_program_test {
namespace {

using namespace printed_programs;

TEST(AposPrintedPrograms, HaveTheMessagesOfThePrintAndCompileWithItsCorrections) {
  if (!fs::exists(kDocument)) {
    std::printf("%s is not there; nothing was compared\n", kDocument.c_str());
    return;
  }
  const Lines document = document_lines();
  const nlohmann::json catalogue = printed_catalogue();
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

}  // namespace
}  // namespace lockstep::aposs::printed_program_test
