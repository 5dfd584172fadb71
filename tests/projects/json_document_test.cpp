#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "projects/json/document.hpp"

namespace lockstep::json_document_test {
namespace {

struct Refused {
  std::string name;
  std::string text;
  std::string place;
  std::string part;  // of the message
};

void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.name;
}

class JsonText : public testing::TestWithParam<Refused> {};

TEST_P(JsonText, IsRefusedAtItsPlace) {
  const JsonDocument document(GetParam().text);
  ASSERT_FALSE(document.problems().empty());
  EXPECT_EQ(document.problems().front().place, GetParam().place);
  EXPECT_NE(document.problems().front().text.find(GetParam().part), std::string::npos)
      << document.problems().front().text;
  EXPECT_LT(document.problems().front().text.size(), 400u);
}

std::string nested(int levels) {
  return std::string(static_cast<std::size_t>(levels), '[') +
         std::string(static_cast<std::size_t>(levels), ']');
}

std::string zeros(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "/0";
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, JsonText,
    testing::Values(
        Refused{"empty", "", "1:1", "empty"}, Refused{"blank", " \n\t ", "1:1", "empty"},
        Refused{"cut_short", "{\"a\": 1", "1:8", "expected"},
        Refused{"trailing_comma", "{\"a\": 1,}", "1:9", "expected string literal"},
        Refused{"decimal_comma", "{\"a\": 1,5}", "1:9", "the decimal point is '.', as in 1.5"},
        Refused{"trailing_comma_of_an_array", "[1,]", "1:4", "(no comma stands before it)"},
        Refused{"missing_comma", "{\"a\": 1\n  \"clock\": 2}", "2:3", "(a comma is missing before it)"},
        Refused{"missing_comma_of_an_array", "[1 [2]]", "1:4", "(a comma is missing before it)"},
        Refused{"upper_case", "{\"a\": TRUE}", "1:7", "allowed: true, false, numbers"},
        Refused{"only_a_comment", "// note\n", "2:1", "expected"},
        Refused{"open_comment", "{} /* note", "1:4", "missing closing '*/'"},
        Refused{"open_comment_within", "{ // \"\n\"a/*\": \"\\\"/*\", /* b */\n /*/ 1 }", "3:2",
                "missing closing '*/'"},
        Refused{"half_a_comment", "{\n/ note\n}", "2:2", "invalid comment"},
        Refused{"behind_comments", "/* a\n b */ {\r\n// c\r\n\"d\" 1}", "4:5", "expected ':'"},
        Refused{"behind_a_mark", "\xEF\xBB\xBF{\"a\" 1}", "1:6", "expected ':'"},
        Refused{"third_line", "{\n\"a\": 1,\n  \"b\" 2\n}", "3:7", "expected ':'"},
        Refused{"column_counts_characters", "[\"äöü\", x]", "1:9", "invalid literal"},
        Refused{"garbage_behind", "{} {}", "1:4", "end of input"},
        Refused{"invalid_utf8", "{\"a\": \"\xff\"}", "1:8", "UTF-8"},
        Refused{"lone_surrogate", R"(["\ud800"])", "1:9", "surrogate"},
        Refused{"nul_between", std::string("{}\0{}", 5), "1:3", "NUL"},
        Refused{"utf16_little", std::string("\xFF\xFE{\0}\0", 6), "1:1", "in UTF-16; allowed: UTF-8"},
        Refused{"utf16_big", std::string("\xFE\xFF\0{\0}", 6), "1:1", "in UTF-16; allowed: UTF-8"},
        Refused{"utf16_without_a_mark", std::string("{\0}\0", 4), "1:1", "in UTF-16; allowed: UTF-8"},
        Refused{"nul_in_string", std::string("[\"a\0\"]", 6), "1:4", "NUL"},
        Refused{"nan", "[NaN]", "1:2", "invalid literal"}, Refused{"leading_zero", "[01]", "1:3", "expected"},
        Refused{"control_character", "[\"a\nb\"]", "1:4", "control character"},
        Refused{"long_token", "[\"" + std::string(1'000'000, 'x'), "1:1000003", "missing closing quote"}),
    [](const auto& suite_case) { return suite_case.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Structure, JsonText,
    testing::Values(Refused{"duplicate", R"({"a": {"b": 1, "b": 2}})", "/a/b", "twice"},
                    Refused{"duplicate_after_escape", R"({"a": 1, "\u0061": 2})", "/a", "twice"},
                    Refused{"overflow", R"({"a": [0, 1e400]})", "/a/1", "the number 1e400 is out of range"},
                    Refused{"negative_overflow", "[-1e999]", "/0", "out of range"},
                    Refused{"too_deep", nested(65), zeros(64), "64 levels"},
                    Refused{"bottomless", nested(100'000), zeros(64), "64 levels"},
                    Refused{"unclosed", std::string(100'000, '['), zeros(64), "64 levels"},
                    Refused{"huge", std::string(JsonDocument::kLongest + 1, ' '), "", "16 MiB"}),
    [](const auto& suite_case) { return suite_case.param.name; });

TEST(JsonDocument, TakesSixtyFourLevels) {
  const JsonDocument document(nested(64));
  EXPECT_TRUE(document.usable());
  EXPECT_TRUE(document.problems().empty());
}

TEST(JsonDocument, TellsEveryDuplicateAndEveryOverflow) {
  const JsonDocument document(R"({"a": 1, "a": 2, "b": 1e400, "c": [-1e400, 3], "a": 3})");
  ASSERT_TRUE(document.usable());
  std::vector<std::string> places;
  for (const Problem& problem : document.problems()) places.push_back(problem.place);
  std::sort(places.begin(), places.end());
  EXPECT_EQ(places, (std::vector<std::string>{"/a", "/a", "/b", "/c/0"}));
  EXPECT_EQ(document.root().find("b")->kind, JsonKind::unusable);
  EXPECT_EQ(document.root().find("c")->elements[1]->magnitude, 3u);
  EXPECT_EQ(document.root().find("a")->magnitude, 1u) << "the first of duplicates is kept";
  const std::string line = to_string("FILE", document.problems().back());
  EXPECT_EQ(line,
            "FILE:/a: the key 'a' is there twice; each key is allowed once, the other one is in line 1 "
            "(line 1, column 48)");
}

TEST(JsonDocument, GivesUpOnTooManyOverflows) {
  std::string text = "[1e400";
  for (int i = 0; i < 100; ++i) text += ", 1e400";
  const JsonDocument document(text + "]");
  EXPECT_FALSE(document.usable());
  EXPECT_EQ(document.problems().size(), 20u);
}

TEST(JsonDocument, GivesUpOnTooManyValues) {
  std::string text = "[0";
  for (std::size_t i = 0; i < JsonDocument::kMaximumValues; ++i) text += ",0";
  const JsonDocument document(text + "]");
  EXPECT_FALSE(document.usable());
  ASSERT_EQ(document.problems().size(), 1u);
  EXPECT_NE(document.problems()[0].text.find("2000000 values"), std::string::npos);
}

SourcePosition position_at(const JsonDocument& document, std::string_view pointer) {
  const JsonValue* value = &document.root();
  while (!pointer.empty()) {
    const auto end = std::min(pointer.find('/', 1), pointer.size());
    const std::string_view step = pointer.substr(1, end - 1);
    value =
        value->kind == JsonKind::array ? value->elements[std::stoul(std::string(step))] : value->find(step);
    pointer.remove_prefix(end);
  }
  return value->position();
}

TEST(JsonDocument, KnowsWhereItsValuesBegin) {
  const JsonDocument document(
      "// \"no\": [1]\r\n{ \"a\\\"b:\": /* [ */ [ 1,\t-2e3, \"x\\\\\",\r\n"
      "    { \"ä\": true /* } */ , \"c\" : null }, [], {} ] }");
  ASSERT_TRUE(document.usable());
  ASSERT_TRUE(document.problems().empty());
  EXPECT_EQ(document.root().position(), (SourcePosition{2, 1}));
  const JsonValue& list = *document.root().members[0].value;
  EXPECT_EQ(document.root().members[0].key, "a\"b:");
  EXPECT_EQ(list.key_position(), (SourcePosition{2, 3}));
  EXPECT_EQ(list.position(), (SourcePosition{2, 20}));
  const std::vector<SourcePosition> expected{{2, 22}, {2, 25}, {2, 31}, {3, 5}, {3, 41}, {3, 45}};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(list.elements[i]->position(), expected[i]) << i;
  EXPECT_EQ(list.elements[3]->find("ä")->position(), (SourcePosition{3, 12}));
  EXPECT_EQ(list.elements[3]->find("c")->key_position(), (SourcePosition{3, 27}));
  EXPECT_EQ(list.elements[3]->find("c")->position(), (SourcePosition{3, 33}));
}

TEST(JsonDocument, CountsNoByteOrderMark) {
  const JsonDocument document("\xEF\xBB\xBF{ \"a\": 1 }");
  ASSERT_TRUE(document.usable());
  EXPECT_EQ(position_at(document, ""), (SourcePosition{1, 1}));
  EXPECT_EQ(position_at(document, "/a"), (SourcePosition{1, 8}));
}

TEST(JsonDocument, KnowsPositionsInLongLines) {
  std::string text = "[";
  for (int i = 0; i < 2000; ++i) text += "\"ä\", ";
  const JsonDocument document(text + "{ \"end\": 1 } ]");
  ASSERT_TRUE(document.usable());
  for (const std::size_t i : {0u, 171u, 999u, 1999u})
    EXPECT_EQ(document.root().elements[i]->position(), (SourcePosition{1, 2 + 5 * i})) << i;
  EXPECT_EQ(position_at(document, "/2000/end"), (SourcePosition{1, 2 + 5 * 2000 + 9}));
}

TEST(JsonDocument, TellsWhatAValueIsPartOf) {
  const JsonDocument document(R"({
    "name": "machine",
    "technology_objects": { "Knife": { "config": { "Modulo": 3 } } },
    "programs": [ { "name": "Main", "calls": [ { "if": "x", "then": [ { "name": "gear", "in": { "a": 1 } } ] } ] } ]
  })");
  ASSERT_TRUE(document.usable());
  const JsonValue& root = document.root();
  EXPECT_EQ(root.owner(), "");
  EXPECT_EQ(root.find("name")->owner(), "");
  EXPECT_EQ(root.find("technology_objects")->find("Knife")->find("config")->find("Modulo")->owner(),
            "object 'Knife'");
  const JsonValue& branch = *root.find("programs")->elements[0]->find("calls")->elements[0];
  EXPECT_EQ(branch.find("if")->owner(), "program 'Main'");
  EXPECT_EQ(branch.find("then")->elements[0]->find("in")->find("a")->owner(), "call 'gear'");
}

TEST(JsonDocument, KeepsTheOrderOfMembers) {
  const JsonDocument document(R"({"z": 1, "a": 2, "m": 3})");
  std::string order;
  for (const auto& member : document.root().members) order += member.key;
  EXPECT_EQ(order, "zam");
}

TEST(JsonDocument, TellsNumbersWithAFractionFromThoseWithout) {
  const JsonDocument document("[3, -3, 3.0, 3e2, 3e-1, 18446744073709551615, 1e30, -9223372036854775808]");
  const auto& numbers = document.root().elements;
  const auto whole = [&](std::size_t i) { return numbers[i]->whole; };
  const auto fraction = [&](std::size_t i) { return numbers[i]->fraction; };
  EXPECT_TRUE(whole(0) && whole(1) && whole(3) && whole(5) && whole(7));
  EXPECT_FALSE(whole(2) || whole(4) || whole(6));
  EXPECT_TRUE(fraction(2) && fraction(4));
  EXPECT_FALSE(fraction(0) || fraction(3) || fraction(6));
  EXPECT_EQ(numbers[3]->magnitude, 300u);
  EXPECT_EQ(numbers[5]->magnitude, 18446744073709551615u);
  EXPECT_TRUE(numbers[7]->negative);
  EXPECT_EQ(numbers[7]->magnitude, std::uint64_t{1} << 63);
}

TEST(JsonDocument, EscapesPointersAndKeepsThemOnOneLine) {
  const JsonDocument document(R"({"a/b~c": {"x\ny": [1]}})");
  const JsonValue& inner = *document.root().members[0].value->members[0].value;
  EXPECT_EQ(inner.elements[0]->pointer(), "/a~1b~0c/x?y/0");
  EXPECT_EQ(document.root().pointer(), "");
}

TEST(JsonDocument, CutsVeryLongKeysAndValuesShort) {
  const JsonDocument document("{\"" + std::string(1'000'000, 'k') + "\": \"" + std::string(1'000'000, 'v') +
                              "\"}");
  const JsonValue& value = *document.root().members[0].value;
  EXPECT_LT(value.pointer().size(), 80u);
  EXPECT_LT(value.shown().size(), 80u);
}

TEST(JsonDocument, SkipsAByteOrderMark) {
  const JsonDocument document("\xEF\xBB\xBF{}");
  EXPECT_TRUE(document.usable());
  EXPECT_TRUE(document.problems().empty());
}

TEST(Shown, ReplacesWhatATerminalCannotShow) {
  EXPECT_EQ(shown("a\x1b[31m\tb\x7f"), "a?[31m?b?");
  EXPECT_EQ(shown("äöü€😀"), "äöü€😀");
  EXPECT_EQ(shown("\xff\xc3"), "??");
  EXPECT_EQ(shown("\xc2\x9b"), "??") << "control characters beyond ASCII as well";
  EXPECT_EQ(shown("\xe0\x82\x9b\xc1\x9b"), "?????") << "in a form that is too long as well";
  EXPECT_EQ(shown("\xed\xa0\x80\xf4\x90\x80\x80"), "???????") << "no characters";
  EXPECT_EQ(shown("a\u202Eb\u2028\u2066"), "a???b??????") << "what turns the direction, ends of lines";
  EXPECT_EQ(visible("\x1b]0;" + std::string(200, 'x') + "\r\n\u200F"),
            "?]0;" + std::string(200, 'x') + "??\u200F");
}

TEST(Shown, CutsBetweenCharacters) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "ä";
  std::string expected;
  for (int i = 0; i < 60; ++i) expected += "ä";
  EXPECT_EQ(shown(text), expected + "…");
}

TEST(DidYouMean, NamesTheNearestOneOrNone) {
  const std::vector<std::string_view> names = {"Velocity", "Acceleration", "Jerk"};
  EXPECT_EQ(did_you_mean("Velosity", names), " (did you mean 'Velocity'?)");
  EXPECT_EQ(did_you_mean("velocity", names), " (did you mean 'Velocity'?)");
  EXPECT_EQ(did_you_mean("Jrek", names), " (did you mean 'Jerk'?)");
  EXPECT_EQ(did_you_mean("Torque", names), "");
  EXPECT_EQ(did_you_mean(std::string(1'000'000, 'V'), names), "");
}

}  // namespace
}  // namespace lockstep::json_document_test
