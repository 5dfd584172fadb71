#include "tests/architecture/source_text.hpp"

#include <gtest/gtest.h>

namespace lockstep::source_text_test {
namespace {

TEST(SourceText, FindsIncludesAndHowTheyAreWritten) {
  const auto includes = includes_of(
      "#include <vector>\n"
      "  #  include \"fb/block.hpp\"  // the base\n"
      "// #include \"cli/main.hpp\"\n"
      "/*\n#include \"cli/main.hpp\"\n*/\n"
      "#include \"scheduler/cycle.hpp\"\n");
  ASSERT_EQ(includes.size(), 3u);
  EXPECT_EQ(includes[0].path, "vector");
  EXPECT_FALSE(includes[0].quoted);
  EXPECT_EQ(includes[1].path, "fb/block.hpp");
  EXPECT_TRUE(includes[1].quoted);
  EXPECT_EQ(includes[1].line, 2);
  EXPECT_EQ(includes[2].path, "scheduler/cycle.hpp");
  EXPECT_EQ(includes[2].line, 7);
}

TEST(SourceText, FindsAWordOnlyWhereItIsCode) {
  EXPECT_EQ(lines_with_word("void f() {\n  throw 1;\n}\n", "throw"), std::vector<int>{2});
  EXPECT_TRUE(lines_with_word("// may throw\n/* throw\n throw */ int nothrow, throw_it;\n", "throw").empty());
  EXPECT_TRUE(
      lines_with_word("auto a = \"throw \\\" throw\"; auto b = R\"x(throw \" throw)x\";", "throw").empty());
  EXPECT_TRUE(lines_with_word("char c = '\"'; // throw", "throw").empty());
  EXPECT_EQ(lines_with_word("auto n = 1'000; throw n; // 1'0", "throw"), std::vector<int>{1});
  EXPECT_EQ(lines_with_word("auto s = \"//\"; throw s;", "throw"), std::vector<int>{1});
}

}  // namespace
}  // namespace lockstep::source_text_test
