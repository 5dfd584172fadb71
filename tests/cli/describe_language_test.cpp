// lockstep describe of functions, operators and types against the tables of the compiler.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "projects/expressions/functions.hpp"
#include "projects/expressions/habits.hpp"
#include "projects/expressions/operators.hpp"
#include "projects/expressions/type_table.hpp"
#include "tests/cli/command_run.hpp"

namespace lockstep::cli {
namespace {

using nlohmann::json;

json described(const std::string& name) {
  const Ended ended = lockstep({"describe", name, "--json"});
  EXPECT_EQ(ended.status, 0) << name << ": " << ended.err;
  return json::parse(ended.out, nullptr, false);
}

TEST(DescribeLanguage, ListsEachFunctionOperatorAndType) {
  EXPECT_EQ(described("functions")["functions"].size(), standard_functions().size());
  EXPECT_EQ(described("operators")["operators"].size(), expression_operators().size());
  EXPECT_EQ(described("types")["types"].size(), elementary_types().size());
  const std::string functions = lockstep({"describe", "functions"}).out;
  for (const StandardFunction& function : standard_functions())
    EXPECT_NE(functions.find("\n" + signature(function)), std::string::npos) << function.name;
  const std::string types = lockstep({"describe", "types"}).out;
  for (const TypeText& type : elementary_types())
    EXPECT_NE(types.find("\n" + std::string(type_name(type.type)) + " "), std::string::npos);
}

TEST(DescribeLanguage, FindsEachFunctionByItsNameWithAnExample) {
  for (const StandardFunction& function : standard_functions()) {
    const json shown = described(std::string(function.name));
    EXPECT_EQ(shown["kind"], "function") << function.name;
    EXPECT_EQ(shown["signature"], signature(function));
    EXPECT_FALSE(shown["examples"].empty()) << function.name;
  }
}

TEST(DescribeLanguage, TellsOfAFunctionItsInputsItsEdgesAndItsExamples) {
  const json shown = described("limit");
  EXPECT_EQ(shown["name"], "LIMIT");
  EXPECT_EQ(shown["signature"], "LIMIT(MN, IN, MX)");
  EXPECT_EQ(shown["edges"], "with MN above MX the result is MX; with a NaN among them NaN");
  EXPECT_EQ(shown["examples"][2]["expression"], "LIMIT(10, 5, 0)");
  EXPECT_EQ(shown["examples"][2]["result"], "0");
  const std::string text = lockstep({"describe", "LIMIT"}).out;
  for (const char* part : {"LIMIT(MN, IN, MX)\n", "Takes", "Edges", "LIMIT(10, 5, 0)"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(DescribeLanguage, TellsOfEachTypeConversionAndOperator) {
  EXPECT_EQ(described("usint")["range"], "0 to 255");
  EXPECT_EQ(described("USINT")["widens_to"][0], "INT");
  for (const TypeText& type : elementary_types())
    EXPECT_EQ(described(std::string(type_name(type.type)))["text"], type.meaning);
  const json minus = described("-")["operators"];
  ASSERT_EQ(minus.size(), 2u) << "before its operand, and between two";
  EXPECT_EQ(minus[0]["operands"], 1);
  EXPECT_EQ(described("mod")["operators"][0]["name"], "MOD");
  EXPECT_EQ(described("to_int")["name"], "TO_INT");
  EXPECT_EQ(described("REAL_TO_INT")["text"], "a value of REAL as one of INT");
}

TEST(DescribeLanguage, TellsOfTheTypesThatAreNotElementary) {
  for (const OtherType& type : other_types()) {
    if (type.name.find('[') == type.name.npos) continue;
    EXPECT_EQ(described(std::string(type.name))["text"], type.meaning) << type.name;
  }
  EXPECT_EQ(described("string")["name"], "STRING[n]");
  EXPECT_EQ(described("STRING[80]")["name"], "STRING[n]");
  EXPECT_EQ(described("array")["name"], "ARRAY[lower..upper] OF type");
  EXPECT_EQ(described("axis")["kind"], "search")
      << "what has to do with axes says more than the type of a pin";
}

TEST(DescribeLanguage, IsFoundByWhatItHasToDoWith) {
  struct Wanted {
    const char *word, *kind, *name;
  };
  const Wanted all[] = {{"square", "function", "SQRT"},         {"remainder", "operator", "MOD"},
                        {"nanoseconds", "type", "TIME"},        {"printable", "type", "STRING[n]"},
                        {"conversion", "function", "TO_LREAL"}, {"select", "function", "SEL"},
                        {"absolute", "function", "ABS"}};
  for (const Wanted& wanted : all) {
    const json found = described(wanted.word)["found"];
    const bool there = std::ranges::any_of(
        found, [&](const json& one) { return one["name"] == wanted.name && one["kind"] == wanted.kind; });
    EXPECT_TRUE(there) << wanted.word << ": " << found.dump(1);
  }
  // Whatever is found is told in full by its name.
  const json all_found = described("the")["found"];
  int told = 0;
  for (const json& one : all_found) {
    if (one["kind"] != "function" && one["kind"] != "operator" && one["kind"] != "type") continue;
    EXPECT_EQ(lockstep({"describe", one["name"]}).status, 0) << one["name"];
    ++told;
  }
  EXPECT_GT(told, 5);
}

TEST(DescribeLanguage, TellsWhatIsWrittenHereInPlaceOfWhatOtherLanguagesWrite) {
  for (const Habit& habit : habits()) {
    // What is of APOSS too, and what begins as an option does.
    if (habit.written == "IF" || habit.written.starts_with('-')) continue;
    const json told = described(std::string(habit.written));
    EXPECT_EQ(told["text"], habit.here) << habit.written << ": " << told;
  }
  const Ended ended = lockstep({"describe", "norm_x"});
  EXPECT_NE(ended.out.find("(VALUE - MIN) / (MAX - MIN)"), std::string::npos) << ended.out;
}

TEST(DescribeLanguage, FindsWhatMayStandAnywhereInTheFile) {
  for (const char* const word : {"comment", "comments"}) {
    const json found = described(word);
    ASSERT_EQ(found["kind"], "search") << word;
    EXPECT_EQ(found["found"][0]["name"], "keys comment") << found.dump(1);
  }
  for (const char* const path : {"comment", "technology_objects.comment", "programs.calls.comment"}) {
    const Ended ended = lockstep({"describe", "keys", path});
    EXPECT_EQ(ended.status, 0) << path << ": " << ended.err;
    EXPECT_NE(ended.out.find("/* */"), std::string::npos) << ended.out;
  }
  EXPECT_EQ(lockstep({"describe", "keys", "nowhere.comment"}).status, 1);
  EXPECT_EQ(lockstep({"describe", "keys include"}).out, lockstep({"describe", "keys", "include"}).out)
      << "in one pair of quotation marks";
  EXPECT_NE(lockstep({"describe", "keys include"}).out.find("files with further parts"), std::string::npos);
}

TEST(DescribeLanguage, SuggestsTheNearestName) {
  const Ended ended = lockstep({"describe", "LIMMIT"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find("did you mean 'LIMIT'?"), std::string::npos) << ended.err;
  EXPECT_EQ(lockstep({"describe", "REAL_TO_WORD"}).status, 1) << "there is no such conversion";
}

}  // namespace
}  // namespace lockstep::cli
