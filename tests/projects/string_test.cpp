// Tags of type STRING: how they are declared, given texts, compared, set and put on Modbus.
#include <gtest/gtest.h>

#include <string>

#include "projects/loader/simulation.hpp"

namespace lockstep::string_test {
namespace {

/// @param calls of the program
std::string project(const std::string& calls = "", const std::string& more = "",
                    const std::string& tags = "") {
  return R"({ "lockstep": 1, "name": "texts", "clock": { "servo_cycle": "1ms" },
    "tags": { "kind": { "type": "STRING[5]", "init": "ale" }, "last": { "type": "STRING[6]" }, "on": { "type": "BOOL" },
      "n": { "type": "DINT" })" +
         tags + R"( },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [ )" +
         calls + " ] } ]" + more + " }";
}

std::string text(Simulation& machine, const std::string& name) {
  const StringTag* const tag = machine.project().names.find_string(name);
  return tag == nullptr ? "no text" : std::string(tag->text.view());
}

/// What is wrong with the project: its only problem.
std::string told(const std::string& json) {
  const LoadedProject loaded = load_project(json);
  if (loaded.problems.size() != 1) return std::to_string(loaded.problems.size()) + " problems";
  return loaded.problems.front().place + ": " + loaded.problems.front().text;
}

TEST(Strings, HoldTheirInitialTextAndTakeOthers) {
  Simulation machine = Simulation::from_text(project(R"(
    { "set": "last", "to": "kind" }, { "set": "kind", "to": "'it$'s'" })"));
  EXPECT_EQ(text(machine, "KIND"), "ale");
  EXPECT_EQ(text(machine, "last"), "");
  machine.step();
  EXPECT_EQ(text(machine, "last"), "ale");
  EXPECT_EQ(text(machine, "kind"), "it's");
  machine.step();
  EXPECT_EQ(text(machine, "last"), "it's");
}

TEST(Strings, AreComparedWithEachOtherAndWithLiterals) {
  Simulation machine = Simulation::from_text(project(R"(
    { "set": "on", "to": "kind = 'ale' AND NOT (kind = last) AND EQ('', last) AND 'a' <> 'b' OR on" },
    { "if": "kind <> last", "then": [ { "set": "n", "to": "SEL(last = '', 20, 10) + 1" } ] },
    { "set": "last", "to": "kind" })"));
  machine.step();
  EXPECT_EQ(machine.read("on"), 1.0);
  EXPECT_EQ(machine.read("n"), 11.0);
  machine.write("n", 5.0);
  machine.step();
  EXPECT_EQ(machine.read("n"), 5.0) << "they are the same now";
}

TEST(Strings, AreChosenBySelAndMux) {
  Simulation machine = Simulation::from_text(project(R"json(
    { "set": "kind", "to": "SEL(on, 'ale', MUX(n, 'mild', SEL(G := last = '', IN0 := kind, IN1 := 'stout'), 'bock'))" },
    { "if": "MUX(n - 1, 'a', 'b', kind) = SEL(n > 2, 'b', kind)", "then": [ { "set": "last", "to": "MOVE(kind)" } ] })json"));
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "ale");
  EXPECT_EQ(text(machine, "last"), "");
  machine.write("on", 1.0);
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "mild");
  machine.write("n", 1.0);
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "stout");
  machine.write("n", 2.0);
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "bock");
  EXPECT_EQ(text(machine, "last"), "bock") << "MUX(1, 'a', 'b', kind) is 'b', as SEL(FALSE, 'b', kind)";
  machine.write("n", 1.0);
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "bock");
  machine.write("n", 99.0);
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "bock") << "above the last one the last one is taken";
  machine.write("n", -1.0);
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "mild") << "below the first one the first one";
}

TEST(Strings, ThatAreChosenFitWhereTheyGo) {
  const auto set = [](const std::string& to) {
    return told(project(R"({ "set": "kind", "to": ")" + to + "\" }"));
  };
  const std::string to = "/programs/0/calls/0/to: ";
  EXPECT_EQ(set("SEL(on, 'ale', 'stout')"), "0 problems");
  EXPECT_EQ(set("SEL(on, 'ale', last)"),
            to + "'SEL(on, 'ale', last)' may have 6 characters; allowed for 'kind': up to 5");
  EXPECT_EQ(set("MUX(n, 'a', SEL(on, 'b', 'porter'))").substr(to.size(), 4), "'MUX");
  EXPECT_NE(set("SEL(on, 'ale', n)").find("need a common type"), std::string::npos);
  EXPECT_NE(set("SEL(kind, 'ale', last)").find("a text does not fit where BOOL is expected"),
            std::string::npos);
}

TEST(Strings, AreSetByStimuli) {
  Simulation machine = Simulation::from_text(
      project("", R"(, "stimuli": [ { "at": "1ms", "set": { "kind": "K\u00F6l", "n": 3 } } ])"));
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "ale");
  machine.step();
  EXPECT_EQ(text(machine, "kind"), "K\xF6l");
}

TEST(Strings, AreToldOfWhatIsWrongInTheirDeclaration) {
  const auto tag = [](const std::string& declaration) {
    return told(project("", "", R"(, "more": )" + declaration));
  };
  for (const char* type :
       {"STRING", "STRING[0]", "STRING[255]", "STRING[-1]", "STRING[2", "STRING[ 2]", "STRING(2)"})
    EXPECT_EQ(tag(R"({ "type": ")" + std::string(type) + R"(" })"),
              "/tags/more/type: '" + std::string(type) +
                  "' is no type of a text; allowed: STRING[n], n from 1 to 254, such as STRING[20]");
  EXPECT_EQ(tag(R"({ "type": "STRING[3]", "init": "pale" })"),
            "/tags/more/init: 'pale' has 4 characters; allowed: a text of up to 3 printable characters");
  EXPECT_NE(tag(R"({ "type": "STRING[3]", "init": "\u20AC" })").find("of ISO 8859-1 (Latin-1)"),
            std::string::npos);
  EXPECT_NE(tag(R"({ "type": "STRING[3]", "init": "a\nb" })").find("holds a character that no STRING has"),
            std::string::npos);
  EXPECT_NE(tag(R"({ "type": "STRING[3]", "init": 3 })").find("allowed: a text of up to 3"),
            std::string::npos);
  EXPECT_NE(tag(R"({ "type": "ARRAY[1..3] OF STRING[3]" })").find("unknown type"), std::string::npos);
  EXPECT_NE(tag(R"({ "type": "STRING[3]", "inti": "a" })").find("unknown key 'inti'"), std::string::npos);
  EXPECT_EQ(tag(R"({ "type": "STRING[3]", "init": "\u00E4\u00F6\u00FC" })"), "0 problems")
      << "characters count";
}

TEST(Strings, AreToldOfWhatIsWrongWhereTheyAreUsed) {
  const auto set = [](const std::string& to, const std::string& place = "kind") {
    return told(project(R"({ "set": ")" + place + R"(", "to": )" + to + " }"));
  };
  const std::string to = "/programs/0/calls/0/to: ";
  EXPECT_EQ(set("3").substr(0, to.size()), to);
  EXPECT_EQ(set("\"last\""), to + "'last' may have 6 characters; allowed for 'kind': up to 5");
  EXPECT_EQ(set("\"'porter'\""), to + "''porter'' may have 6 characters; allowed for 'kind': up to 5");
  EXPECT_EQ(set("\"n\""), to + "DINT is no text; allowed: a text such as 'ale', or a tag of type STRING");
  EXPECT_NE(set("\"ale\"").find("unknown name 'ale'"), std::string::npos);
  EXPECT_NE(set("\"'ale\"").find("has no end '"), std::string::npos);
  EXPECT_NE(set("\"kind\"", "n").find("a text does not fit where DINT is expected"), std::string::npos);
  EXPECT_NE(set("\"TO_DINT(kind)\"", "n").find("a text has no number"), std::string::npos);
  EXPECT_NE(set("\"kind.X0\"", "on").find("is a text and has no bits"), std::string::npos);
  EXPECT_NE(set("\"kind < last\"", "on").find("texts are compared with = and <>"), std::string::npos);
  for (const char* wrong :
       {"kind = n", "kind = 3", "kind AND on", "NOT kind", "kind + 'a' = 'b'", "-kind = n", "ABS(kind) = 1",
        "MAX(kind, last) = kind", "SEL(on, kind, n) = kind", "SEL(n, kind, last) = kind",
        "SEL(on, kind, last)", "SHL(kind, 1) = 1", "SQRT(kind) = 1.0", "kind", "TRUNC(kind) = 1",
        "SEL(kind, 1, 2) = 1", "kind[1] = 3", "MUX(kind, 1, 2) = 1"})
    EXPECT_EQ(set("\"" + std::string(wrong) + "\"", "on").substr(0, to.size()), to) << wrong;
}

TEST(Strings, AreNoPlaceForANumber) {
  const std::string reason =
      "'kind' is a STRING[5], a text; allowed here: a number, a bit string, a BOOL or a TIME";
  EXPECT_EQ(told(project("", R"(, "trace": { "signals": [ "kind" ] })")), "/trace/signals/0: " + reason);
  EXPECT_EQ(told(project("", R"(, "trace": { "signals": [ "kind.X1" ] })")),
            "/trace/signals/0: 'kind' is a STRING[5], which has no part 'X1'");
  EXPECT_EQ(
      told(project("", R"(, "flight_recorder": { "before": "1s", "file": "a.csv", "signals": [ "kind" ] })")),
      "/flight_recorder/signals/0: " + reason);
  EXPECT_EQ(told(project(R"({ "set_start": "kind", "to": 1 })")), "/programs/0/calls/0/set_start: " + reason);
  EXPECT_NE(
      told(project("", R"(, "stimuli": [ { "at": "0s", "set": { "kind": 3 } } ])")).find("allowed: a text"),
      std::string::npos);
}

TEST(Strings, OnModbusHaveTwoCharactersInARegister) {
  const LoadedProject loaded = load_project(project("", R"(, "modbus": { "map": [
    { "tag": "n", "table": "holding_register", "address": 0 },
    { "tag": "Kind", "table": "holding_register", "address": 10 },
    { "tag": "last", "table": "input_register", "address": 20, "byte_order": "little" },
    { "tag": "last", "table": "holding_register", "address": 20, "access": "read" } ] })"));
  ASSERT_TRUE(loaded.project) << loaded.problems.front().text;
  const ModbusMapConfig& map = loaded.project->modbus.maps.front();
  ASSERT_EQ(map.texts.size(), 3u);
  EXPECT_EQ(map.texts[0].first, 1u);
  EXPECT_EQ(map.texts[0].count(), 3u);
  const auto word = [&](std::size_t index) {
    const ModbusEntry& entry = map.map.entries()[index];
    return encode(entry, map.map.signal_type(entry),
                  loaded.project->modbus.signals[entry.signal].signal.load())[0];
  };
  loaded.project->names.find_string("kind")->text.assign("stout");
  loaded.project->names.find_string("last")->text.assign("ale");
  EXPECT_EQ(word(1), 0x7374u);  // st
  EXPECT_EQ(word(2), 0x6F75u);  // ou
  EXPECT_EQ(word(3), 0x7400u);  // t
  EXPECT_EQ(word(4), 0x6C61u) << "the first character in the low byte";
  EXPECT_EQ(word(7), 0x616Cu);
  EXPECT_TRUE(map.map.entries()[3].writable);
  EXPECT_FALSE(map.map.entries()[4].writable);
  EXPECT_FALSE(map.map.entries()[7].writable);
  EXPECT_FALSE(decode(map.map.entries()[3], Type::BYTE, std::vector<std::uint16_t>{0x7478}))
      << "there is no sixth character";
}

TEST(Strings, OnModbusAreToldOfWhatIsWrong) {
  const auto entry = [](const std::string& more) {
    return told(project("", R"(, "modbus": { "map": [ { "tag": "kind", )" + more + " } ] }"));
  };
  const std::string place = R"("table": "holding_register", "address": 0)";
  EXPECT_EQ(
      entry(R"("table": "coil", "address": 0)"),
      "/modbus/map/0/table: a text does not fit the one bit of the table coil; allowed: input_register, "
      "holding_register");
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"type", "\"WORD\""}, {"word_order", "\"big\""}, {"bit", "3"}, {"scale", "2"}, {"offset", "2"}})
    EXPECT_EQ(entry(place + ", \"" + key + "\": " + value),
              "/modbus/map/0/" + key + ": a text has no '" + key + "'; allowed: table, address, byte_order");
  EXPECT_EQ(entry(R"("table": "holding_register", "address": 65534)"),
            "/modbus/map/0/address: 3 elements on 3 addresses from 65534 on go beyond 65535");
  EXPECT_NE(entry(R"("table": "input_register", "address": 0, "access": "write")").find("cannot write"),
            std::string::npos);
  EXPECT_NE(
      told(project("", R"(, "modbus": { "map": [ { "tag": "kind", "table": "holding_register", "address": 0 },
    { "tag": "n", "table": "holding_register", "address": 2 } ] })"))
          .find("address 2 of the table"),
      std::string::npos);
}

TEST(Strings, OfForeignDevicesAreEntriesOfTheirClient) {
  const std::string device = R"(, "modbus": { "clients": [ { "connect": "127.0.0.1:502", "devices": [
    { "name": "d", "cycle": "1s", "read": [ { "tag": "kind", "table": "input_register", "address": 4 } ],
      "write": [ { "tag": "last", "table": ")";
  const LoadedProject loaded =
      load_project(project("", device + R"(holding_register", "address": 9 } ] } ] } ] })"));
  ASSERT_TRUE(loaded.project) << loaded.problems.front().text;
  const ModbusDevice& made = loaded.project->modbus.clients.front().options.devices.front();
  EXPECT_EQ(made.reads.size(), 3u);
  EXPECT_EQ(made.writes.size(), 3u);
  EXPECT_EQ(made.writes.back().address, 11u);
  EXPECT_NE(
      told(project("", device + R"(input_register", "address": 9 } ] } ] } ] })")).find("cannot be written"),
      std::string::npos);
}

TEST(Strings, ThatAreKeptCountWithTheArrays) {
  const std::string array = R"(, "row": { "type": "ARRAY[1..9997] OF BOOL", "retain": true })";
  const std::string kept = R"(, "more": { "type": "STRING[)";
  EXPECT_EQ(told(project("", "", array + kept + R"(6]", "retain": true })")), "0 problems");
  EXPECT_NE(told(project("", "", array + kept + R"(7]", "retain": true })")).find("allowed are 10000"),
            std::string::npos);
}

}  // namespace
}  // namespace lockstep::string_test
