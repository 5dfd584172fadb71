#include "hmi_bridge/traces/text_literal.hpp"

#include <gtest/gtest.h>

namespace lockstep::text_literal_test {
namespace {

std::string problem_of(const std::string& literal) {
  std::string problem;
  EXPECT_FALSE(read_text_literal(literal, problem)) << literal;
  return problem;
}

TEST(TextLiteral, GivesAnyCharactersBack) {
  std::string all;
  for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
  std::string problem;
  EXPECT_EQ(read_text_literal(text_literal(all), problem), all);
  EXPECT_EQ(problem, "");
  EXPECT_EQ(text_literal("it's 5 $\n"), "'it$'s 5 $$$0A'");
  EXPECT_EQ(text_literal("K\xF6lsch"), "'K\u00F6lsch'");
  EXPECT_EQ(text_literal(""), "''");
}

TEST(TextLiteral, TellsWhatIsWrong) {
  EXPECT_NE(problem_of("ale").find("in single quotes"), std::string::npos);
  EXPECT_NE(problem_of("'").find("in single quotes"), std::string::npos);
  EXPECT_NE(problem_of("'it's'").find("$'"), std::string::npos);
  for (const char* literal : {"'$'", "'$4'", "'$x1'", "'$00'", "'$1f'"})
    EXPECT_NE(problem_of(literal).find("after a $"), std::string::npos) << literal;
  for (const char* literal : {"'\u20AC'", "'\t'", "'\x80'", "'\xC3'", "'\xC2\x85'"})
    EXPECT_NE(problem_of(literal).find("ISO 8859-1"), std::string::npos) << literal;
}

TEST(TextFromUtf8, TakesWhatCanBePrintedOfLatin1) {
  EXPECT_EQ(text_from_utf8("K\u00F6lsch, 5 %"), "K\xF6lsch, 5 %");
  EXPECT_EQ(text_from_utf8("\u00A0\u00FF"), "\xA0\xFF");
  for (const char* wrong : {"\u0100", "\u20AC", "\n", "\x7F", "\u0085", "\xC3", "\xF6", "\xC0\xA0", "\xC3("})
    EXPECT_FALSE(text_from_utf8(wrong)) << wrong;
  EXPECT_EQ(text_to_utf8("K\xF6lsch"), "K\u00F6lsch");
}

}  // namespace
}  // namespace lockstep::text_literal_test
