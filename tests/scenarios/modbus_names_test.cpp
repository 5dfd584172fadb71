// A running project read and written by the names of its map, and its diagnostics; a second one that polls
// it.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>

#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::modbus_names_test {
namespace {

Json entry(const std::string& tag, const std::string& table, int address, const Json& more = Json::object()) {
  Json json{{"tag", tag}, {"table", table}, {"address", address}};
  json.update(more);
  return json;
}

/// "doubled" follows "speed".
Json panel_project() {
  Json project = empty_project();
  project["tags"] = Json::parse(R"({
    "speed": {"type": "LREAL", "init": 200.0}, "doubled": {"type": "LREAL"}, "start": {"type": "BOOL"},
    "wait": {"type": "TIME", "init": "250ms"}, "mask": {"type": "WORD", "init": "16#0F0F"},
    "small": {"type": "DINT", "init": -3}, "tenths": {"type": "REAL"}, "wide": {"type": "LREAL"}})");
  project["programs"] = {
      {{"name", "P"}, {"ob", "Main"}, {"cycle", "1ms"}, {"calls", {assignment("doubled", "speed * 2.0")}}}};
  project["modbus"]["map"] = {
      entry("speed", "holding_register", 0, {{"type", "REAL"}}),
      entry("doubled", "input_register", 0),
      entry("start", "holding_register", 9, {{"bit", 3}}),
      entry("wait", "holding_register", 10),
      entry("mask", "holding_register", 12, {{"byte_order", "little"}}),
      entry("small", "holding_register", 13, {{"type", "INT"}}),
      entry("tenths", "holding_register", 14, {{"type", "INT"}, {"scale", 0.1}}),
      entry("wide", "holding_register", 15, {{"type", "INT"}, {"scale", 0.1}}),
      Json{{"diagnostic", "ticks"}, {"table", "input_register"}, {"address", 100}},
      Json{{"diagnostic", "overruns"}, {"table", "input_register"}, {"address", 104}, {"type", "UDINT"}},
      Json{{"diagnostic", "alarms"}, {"table", "input_register"}, {"address", 106}, {"type", "UINT"}},
      Json{{"diagnostic", "clients"}, {"table", "input_register"}, {"address", 107}, {"type", "UINT"}}};
  return project;
}

/// Ports at which nobody listens.
std::array<int, 2> free_ports() {
  std::array<int, 2> sockets{};
  std::array<int, 2> ports{};
  for (std::size_t i = 0; i < ports.size(); ++i) {
    sockets[i] = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{
        .sin_family = AF_INET, .sin_port = 0, .sin_addr = {htonl(INADDR_LOOPBACK)}, .sin_zero = {}};
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(sockets[i], reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(::getsockname(sockets[i], reinterpret_cast<sockaddr*>(&address), &size), 0);
    ports[i] = ntohs(address.sin_port);
  }
  for (const int socket : sockets) ::close(socket);
  return ports;
}

class Panel : public ::testing::Test {
 protected:
  Ended call(const std::string& command, std::vector<std::string> arguments, int port) const {
    std::vector<std::string> all{command, "127.0.0.1:" + std::to_string(port), "--project", file};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return lockstep(all);
  }
  Directory directory;
  std::string file = directory.write("project.json", panel_project().dump());
};

TEST_F(Panel, ReadsAndWritesByName) {
  RunningLockstep run(file);
  Ended ended = call("read", {"speed", "START", "wait", "mask", "small"}, run.port());
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out, "speed = 200.0\nstart = FALSE\nwait = T#0.25s\nmask = 16#F0F\nsmall = -3\n");
  ended =
      call("write", {"speed=-12.5", "start=TRUE", "wait=1.5s", "mask=16#1234", "small=-40", "tenths=12.34"},
           run.port());
  ASSERT_EQ(ended.status, 0) << ended.err;
  ended = call("read", {"speed", "start", "wait", "mask", "small"}, run.port());
  EXPECT_EQ(ended.out, "speed = -12.5\nstart = TRUE\nwait = T#1.5s\nmask = 16#1234\nsmall = -40\n");
  EXPECT_TRUE(wait_until([&] { return call("read", {"doubled"}, run.port()).out == "doubled = -25.0\n"; }));
  for (const auto& [coil, shown] : {std::pair("start=0", "FALSE"), {"start=1", "TRUE"}}) {
    EXPECT_EQ(call("write", {coil}, run.port()).status, 0) << "as Modbus has it";
    EXPECT_EQ(call("read", {"start"}, run.port()).out, std::string("start = ") + shown + "\n");
  }
  EXPECT_EQ(call("read", {"tenths"}, run.port()).out, "tenths = 12.3\n")
      << "a REAL as short as it was written";
  ASSERT_EQ(call("write", {"wide=0.7"}, run.port()).status, 0);
  EXPECT_EQ(call("read", {"wide"}, run.port()).out, "wide = 0.7\n") << "7 times 0.1 of a computer is not";
  const Json all = Json::parse(call("read", {"--json"}, run.port()).out);
  EXPECT_EQ(all.size(), 12u);
  EXPECT_NEAR(all["tenths"].get<double>(), 12.3, 1e-6);
  EXPECT_GT(all["diagnostic.ticks"].get<int>(), 0);
  EXPECT_EQ(all["diagnostic.alarms"], 0);
  EXPECT_EQ(all["diagnostic.clients"], 1);
}

TEST_F(Panel, TellsNamesAndValuesThatAreWrongAndWritesNothing) {
  RunningLockstep run(file);
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"speeed=1"}, "did you mean 'speed'?"},
      {{"doubled=1"}, "is read-only on Modbus"},
      {{"speed=1", "start=2"}, "start: "},
      {{"speed"}, "is not NAME=VALUE"},
      {{"small=40000"}, "small: 40000 does not fit INT on Modbus; allowed: from -32768 to 32767"},
      {{"tenths=5000"}, "tenths: 5000.0 does not fit INT on Modbus; allowed: from -3276.8 to 3276.7"},
      {{"wide=5000"}, "wide: 5000.0 does not fit INT on Modbus; allowed: from -3276.8 to 3276.7\n"},
      {{"wait=30d"},
       "wait: T#2592000s does not fit TIME on Modbus; allowed: from T#-2147483.648s to T#2147483.647s"},
      {{"speed=1e39"},
       "speed: 1.0E39 does not fit REAL on Modbus; allowed: from -3.4028234663852886E38 to "
       "3.4028234663852886E38"},
      {{"diagnostic.ticks=1"}, "is read-only"}};
  for (const auto& [arguments, part] : wrong) {
    const Ended ended = call("write", arguments, run.port());
    EXPECT_EQ(ended.status, 1) << part;
    EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
  }
  EXPECT_EQ(call("read", {"speed"}, run.port()).out, "speed = 200.0\n");
  EXPECT_EQ(call("read", {"speeed"}, run.port()).status, 1);
}

TEST_F(Panel, ANameWithoutAnAddressIsToldAsSuch) {
  const Ended ended = lockstep({"read", "nobody.invalid:502", "--project", file, "speed"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("nobody.invalid:502: the name has no address: "), std::string::npos) << ended.err;
}

/// Registers as they are.
class Registers {
 public:
  explicit Registers(int port) : client_(modbus_new_tcp("127.0.0.1", port)) {
    modbus_set_response_timeout(client_, 20, 0);
    EXPECT_EQ(modbus_connect(client_), 0) << modbus_strerror(errno);
  }
  ~Registers() {
    modbus_close(client_);
    modbus_free(client_);
  }
  Registers(const Registers&) = delete;
  Registers& operator=(const Registers&) = delete;

  std::vector<std::uint16_t> inputs(int address, int count) {
    std::vector<std::uint16_t> words(static_cast<std::size_t>(count));
    EXPECT_EQ(modbus_read_input_registers(client_, address, count, words.data()), count)
        << modbus_strerror(errno);
    return words;
  }
  bool write(int address, const std::vector<std::uint16_t>& words) {
    return modbus_write_registers(client_, address, static_cast<int>(words.size()), words.data()) ==
           static_cast<int>(words.size());
  }

 private:
  modbus_t* client_;
};

/// "last" follows "kind", "is_ale" tells what it is.
class TextPanel : public Panel {
 protected:
  TextPanel() {
    Json project = empty_project();
    project["tags"] = Json::parse(R"({
      "kind": {"type": "STRING[5]", "init": "ale", "retain": true}, "last": {"type": "STRING[5]"},
      "note": {"type": "STRING[254]"}, "is_ale": {"type": "BOOL"}})");
    project["programs"] = {{{"name", "P"},
                            {"ob", "Main"},
                            {"cycle", "1ms"},
                            {"calls", {assignment("last", "kind"), assignment("is_ale", "kind = 'ale'")}}}};
    project["modbus"]["map"] = {entry("kind", "holding_register", 10),
                                entry("last", "input_register", 10, {{"byte_order", "little"}}),
                                entry("note", "holding_register", 20), entry("is_ale", "coil", 0)};
    file = directory.write("texts.json", project.dump());
  }
};

TEST_F(TextPanel, ReadsAndWritesTexts) {
  RunningLockstep run(file, {"--no-retain"});
  const auto read = [&](const std::string& name) { return call("read", {name}, run.port()).out; };
  EXPECT_EQ(read("Kind"), "kind = 'ale'\n");
  const std::string note(254, 'n');
  Ended ended = call("write", {"kind=K\u00F6ln", "note=" + note}, run.port());
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_TRUE(wait_until([&] { return read("last") == "last = 'K\u00F6ln'\n"; })) << read("last");
  EXPECT_EQ(read("note"), "note = '" + note + "'\n");
  EXPECT_TRUE(wait_until([&] { return read("is_ale") == "is_ale = FALSE\n"; }));
  ASSERT_EQ(call("write", {"kind='it$'s'"}, run.port()).status, 0);
  EXPECT_EQ(read("kind"), "kind = 'it$'s'\n");
  const Json all = Json::parse(call("read", {"--json"}, run.port()).out);
  EXPECT_EQ(all.size(), 4u);
  EXPECT_EQ(all["kind"], "it's");
  EXPECT_EQ(all["note"], note);
}

TEST_F(TextPanel, IsToldOfTextsThatDoNotFit) {
  RunningLockstep run(file, {"--no-retain"});
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"kind=porter", "'porter' has 6 characters; allowed: up to 5"},
      {"kind='it's'", "a quote within a text is written $'"},
      {"kind=5 \u20AC", "kind: '5 \u20AC' is no text; allowed: printable characters of ISO 8859-1"},
      {"last=ale", "'last' is read-only on Modbus"},
      {"kind[1]=a", "the Modbus map has no 'kind[1]'"}};
  for (const auto& [argument, part] : wrong) {
    const Ended ended = call("write", {argument}, run.port());
    EXPECT_EQ(ended.status, 1) << part;
    EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
  }
  EXPECT_EQ(call("read", {"kind"}, run.port()).out, "kind = 'ale'\n");
}

TEST_F(TextPanel, AForeignClientWritesTwoCharactersInARegister) {
  RunningLockstep run(file, {"--no-retain"});
  Registers client(run.port());
  EXPECT_TRUE(client.write(10, {0x7374, 0x6F75, 0x7400}));
  EXPECT_EQ(call("read", {"kind"}, run.port()).out, "kind = 'stout'\n");
  EXPECT_TRUE(wait_until([&] {
    return client.inputs(10, 3) == std::vector<std::uint16_t>{0x7473, 0x756F, 0x0074};
  })) << "swapped";
  EXPECT_FALSE(client.write(10, {0x7374, 0x6F75, 0x7478})) << "a sixth character";
  EXPECT_TRUE(client.write(11, {0x0107})) << "a part, and what cannot be printed";
  EXPECT_EQ(call("read", {"kind"}, run.port()).out, "kind = 'st$01$07t'\n");
  EXPECT_TRUE(client.write(10, {0x616C, 0x6500})) << "what stands behind the end does not count";
  EXPECT_EQ(call("read", {"kind"}, run.port()).out, "kind = 'ale'\n");
  EXPECT_TRUE(wait_until([&] { return call("read", {"is_ale"}, run.port()).out == "is_ale = TRUE\n"; }));
}

TEST_F(TextPanel, WhatIsKeptComesBackInTheNextRun) {
  for (const std::string text : {"st$$ut", "K\u00F6ln"}) {
    RunningLockstep run(file);
    ASSERT_EQ(call("write", {"kind='" + text + "'"}, run.port()).status, 0);
    run.send(SIGTERM);
    ASSERT_EQ(run.status(), 0) << run.err();
    RunningLockstep next(file);
    EXPECT_EQ(call("read", {"kind"}, next.port()).out, "kind = '" + text + "'\n");
    next.send(SIGTERM);
    ASSERT_EQ(next.status(), 0) << next.err();
  }
  Json json = Json::parse(content(file));
  for (const char* tag : {"kind", "last"}) json["tags"][tag]["type"] = "STRING[9]";
  directory.write("texts.json", json.dump());
  RunningLockstep other(file);
  EXPECT_EQ(call("read", {"kind"}, other.port()).out, "kind = 'ale'\n");
  other.send(SIGTERM);
  ASSERT_EQ(other.status(), 0);
  EXPECT_NE(other.err().find("kind was kept as STRING[5] ('K\u00F6ln') and is STRING[9] now"),
            std::string::npos)
      << other.err();
}

/// "rising" counts in all its elements at once; the rest is the operator's.
class ArrayPanel : public Panel {
 protected:
  ArrayPanel() {
    Json project = empty_project();
    project["tags"] = Json::parse(R"({
      "heights": {"type": "ARRAY[0..3] OF LREAL", "init": [5.0, 7.5]}, "on": {"type": "ARRAY[1..20] OF BOOL"},
      "rising": {"type": "ARRAY[1..200] OF DINT"}, "k": {"type": "DINT"},
      "points": {"type": "ARRAY[1..3] OF TO_Cam_Struct_PointData"}})");
    Json calls = Json::array({assignment("k", "k + 1")});
    for (int i = 1; i <= 200; ++i) calls.push_back(assignment("rising[" + std::to_string(i) + "]", "k"));
    project["programs"] = {{{"name", "P"}, {"ob", "Main"}, {"cycle", "1ms"}, {"calls", calls}}};
    project["modbus"]["map"] = {
        entry("heights", "holding_register", 10, {{"type", "REAL"}, {"word_order", "little"}}),
        entry("on", "holding_register", 40, {{"bit", 14}}), entry("on[3..4]", "coil", 0),
        entry("rising", "input_register", 100),
        entry("points[1..2].y", "holding_register", 60, {{"type", "INT"}, {"scale", 0.1}})};
    file = directory.write("arrays.json", project.dump());
  }
};

TEST_F(ArrayPanel, ReadsAndWritesElementsRangesAndAll) {
  RunningLockstep run(file);
  const auto read = [&](const std::string& name) { return call("read", {name}, run.port()).out; };
  EXPECT_EQ(read("heights"), "heights = [5.0, 7.5, 0.0, 0.0]\n");
  Ended ended =
      call("write", {"heights[2]=1.25", "heights[0..1]=[-1, MAX(2.0, 3.0)]", "points[*].y=[1.0, 2.5]"},
           run.port());
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(read("HEIGHTS[*]"), "HEIGHTS[*] = [-1.0, 3.0, 1.25, 0.0]\n");
  EXPECT_EQ(read("heights[1..2]"), "heights[1..2] = [3.0, 1.25]\n");
  EXPECT_EQ(read("heights[3]"), "heights[3] = 0.0\n");
  EXPECT_EQ(read("points[2].y"), "points[2].y = 2.5\n");
  std::string all = "[TRUE";
  for (int i = 2; i <= 20; ++i) all += i % 3 == 1 ? ", TRUE" : ", FALSE";
  ended = call("write", {"on=" + all + "]"}, run.port());
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(read("on"), "on = " + all + "]\n");
  ended = call("write", {"on[3..4]=[TRUE, FALSE]"}, run.port());
  EXPECT_EQ(read("on[2..5]"), "on[2..5] = [FALSE, TRUE, FALSE, FALSE]\n");
  const Json json = Json::parse(call("read", {"--json"}, run.port()).out);
  EXPECT_EQ(json["heights"], Json::parse("[-1.0, 3.0, 1.25, 0.0]"));
  EXPECT_EQ(json["on"].size(), 20u);
  EXPECT_EQ(json["rising"].size(), 200u);
  EXPECT_EQ(json["points[1..2].y"], Json::parse("[1.0, 2.5]"));
}

TEST_F(ArrayPanel, ARequestSeesAllElementsAtOneInstant) {
  RunningLockstep run(file);
  Registers client(run.port());
  int before = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<std::uint16_t> words = client.inputs(100, 124);
    const int first = words[0] << 16 | words[1];
    for (std::size_t k = 2; k < words.size(); k += 2) ASSERT_EQ(words[k] << 16 | words[k + 1], first);
    EXPECT_GE(first, before);
    before = first;
  }
  EXPECT_GT(before, 0);
}

TEST_F(ArrayPanel, WritingAPartChangesThisPartAndHalfAnElementIsRefused) {
  RunningLockstep run(file);
  Registers client(run.port());
  EXPECT_TRUE(client.write(12, {0x0000, 0x4120}));  // heights[1] = 10, its low word first
  EXPECT_EQ(call("read", {"heights"}, run.port()).out, "heights = [5.0, 10.0, 0.0, 0.0]\n");
  EXPECT_FALSE(client.write(12, {0x0000})) << "half of an element";
  EXPECT_FALSE(client.write(11, {0x0000, 0x4120})) << "halves of two elements";
  EXPECT_FALSE(client.write(12, {0x0000, 0x4120, 0x0000, 0x7F80})) << "infinity in the second";
  EXPECT_EQ(call("read", {"heights"}, run.port()).out, "heights = [5.0, 10.0, 0.0, 0.0]\n");
}

TEST_F(ArrayPanel, TellsNamesAndValuesThatAreWrongAndWritesNothing) {
  RunningLockstep run(file);
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"heights=[1, 2, 3]", "are not the values of 4 elements; allowed: [VALUE, …] with one for each"},
      {"heights=1", "are not the values of 4 elements"},
      {"heights[1]=[1]", "heights[1]: "},
      {"heights[4]=1", "the Modbus map has no 'heights[4]': "},
      {"heights[4]=1", "0 to 3"},
      {"heights[2..4]=[1, 2, 3]",
       "goes beyond the elements that there are; allowed: [*], or a range within [0..3]"},
      {"heights[0..1]=[1, x]", "heights[1]: "},
      {"heights[0..1]=[1, 1e39]", "heights[1]: 1.0E39 does not fit REAL on Modbus; allowed: from -3.4"},
      {"points[1..3].y=[1, 2, 3]", "the Modbus map has no 'points[3].y'"},
      {"points[*].x=[1, 2, 3]", "the Modbus map has no 'points[1].x'"},
      {"rising[1..2]=[1, 2]", "'rising[1]' is read-only on Modbus"}};
  for (const auto& [argument, part] : wrong) {
    const Ended ended = call("write", {"heights[0]=9", argument}, run.port());
    EXPECT_EQ(ended.status, 1) << argument;
    EXPECT_NE(ended.err.find(part), std::string::npos) << ended.err;
  }
  EXPECT_EQ(call("read", {"heights"}, run.port()).out, "heights = [5.0, 7.5, 0.0, 0.0]\n");
}

/// Two servers: one with the common map, one with maps of its own, in which the same addresses mean other
/// tags.
class TwoServers : public Panel {
 protected:
  TwoServers() {
    const std::array<int, 2> free = free_ports();
    common = free[0];
    own = free[1];
    write(common, own);
  }
  void write(int first, int second) {
    Json project = empty_project();
    project["tags"] = Json::parse(R"({"a": {"type": "INT", "init": 11}, "b": {"type": "INT", "init": 22},
                                      "c": {"type": "INT", "init": 33}, "unused": {"type": "INT"}})");
    const auto listen = [](int port) { return "127.0.0.1:" + std::to_string(port); };
    project["modbus"]["map"] = {entry("a", "holding_register", 0), entry("b", "holding_register", 1)};
    project["modbus"]["server"] = {
        Json{{"listen", listen(first)}},
        Json{{"listen", listen(second)},
             {"map", {entry("b", "holding_register", 0)}},
             {"units", {Json{{"unit", 1}, {"map", {entry("c", "holding_register", 0)}}}}}}};
    file = directory.write("two.json", project.dump());
  }
  int common = 0;
  int own = 0;
};

TEST_F(TwoServers, TheAddressTellsWhichMapCounts) {
  Process run(lockstep_command({"run", file, "--no-lcm", "--no-retain"}));
  ASSERT_TRUE(wait_until([&] { return call("read", {"a"}, common).status == 0; })) << run.err();
  EXPECT_EQ(call("read", {}, common).out, "a = 11\nb = 22\n");
  EXPECT_EQ(call("read", {}, own).out, "b = 22\nc = 33\n") << "the unit id 1 is taken by a map of its own";
  const Ended unknown = call("write", {"a=99"}, own);
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.err.find("has no 'a' (did you mean 'b'?); it has: b, c"), std::string::npos)
      << unknown.err;
  EXPECT_EQ(call("write", {"b=5", "c=6"}, own).status, 0);
  EXPECT_EQ(call("read", {}, common).out, "a = 11\nb = 5\n");
  EXPECT_EQ(call("read", {"c"}, own).out, "c = 6\n");
  const Ended by_name = lockstep({"read", "localhost:" + std::to_string(own), "--project", file, "c"});
  EXPECT_EQ(by_name.out, "c = 6\n") << by_name.err;

  write(1, 2);  // as behind a tunnel: no server listens where the client connects
  const Ended asked = call("read", {"b"}, own);
  EXPECT_EQ(asked.status, 2);
  EXPECT_NE(asked.err.find("allowed: an address at which one listens, or --server with one of 0 "
                           "(127.0.0.1:1), 1 (127.0.0.1:2)"),
            std::string::npos)
      << asked.err;
  EXPECT_EQ(call("read", {"--server", "1"}, own).out, "b = 5\nc = 6\n");
  EXPECT_EQ(call("read", {"--server", "0"}, common).out, "a = 11\nb = 5\n");
  EXPECT_EQ(call("read", {"--server", "2"}, own).status, 2);
}

TEST_F(TwoServers, TheProjectsWarningsAreNotForWhoReadsAndWrites) {
  EXPECT_NE(lockstep({"check", file}).err.find("warning"), std::string::npos);
  RunningLockstep run(file);  // the first server alone, where the command line says
  for (const std::string name : {"read", "write"}) {
    const Ended ended = call(name, {"--server", "0", name == "read" ? "a" : "a=1"}, run.port());
    EXPECT_EQ(ended.status, 0);
    EXPECT_EQ(ended.err, "");
  }
}

TEST_F(Panel, WhereNobodyAnswersItSaysSo) {
  const Ended ended = call("read", {"speed"}, 1);
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("127.0.0.1:1: Connection refused"), std::string::npos) << ended.err;
}

TEST_F(Panel, RefusedClientsAreToldAtTheEndOfTheRun) {
  Json project = panel_project();
  project["modbus"]["server"] = {{"listen", "127.0.0.1:0"}, {"allow", {"10.0.0.0/8"}}};
  const std::string guarded = directory.write("guarded.json", project.dump());
  RunningLockstep run(guarded);
  const Ended ended = call("read", {"speed"}, run.port());
  EXPECT_EQ(ended.status, 2);
  run.send(SIGINT);
  EXPECT_EQ(run.status(), 0);
  EXPECT_NE(run.err().find("warning: Modbus: 1 connections refused: not from a network in 'allow'"),
            std::string::npos)
      << run.err();
}

TEST_F(Panel, OneControllerPollsAnother) {
  RunningLockstep device(file);
  Json project = empty_project();
  project["tags"] = Json::parse(R"({
    "seen": {"type": "LREAL"}, "wanted": {"type": "LREAL", "init": 77.0}, "good": {"type": "BOOL"},
    "age": {"type": "TIME"}})");
  const Json reading = entry("seen", "input_register", 0, {{"type", "LREAL"}});
  const Json writing = entry("wanted", "holding_register", 0, {{"type", "REAL"}});
  project["modbus"]["clients"] = {{{"connect", "127.0.0.1:" + std::to_string(device.port())},
                                   {"devices",
                                    {{{"name", "panel"},
                                      {"cycle", "10ms"},
                                      {"quality", "good"},
                                      {"age", "age"},
                                      {"read", {reading}},
                                      {"write", {writing}}}}}}};
  project["modbus"]["map"] = {entry("seen", "input_register", 0), entry("good", "coil", 0)};
  RunningLockstep poller(directory.write("poller.json", project.dump()));
  const ModbusClient client(poller.port());
  EXPECT_TRUE(wait_until([&] {
    ModbusClient again(poller.port());
    return again.coil(0) && call("read", {"speed"}, device.port()).out == "speed = 77.0\n";
  }));
  device.send(SIGINT);
  EXPECT_EQ(device.status(), 0);
  EXPECT_TRUE(wait_until([&] { return !ModbusClient(poller.port()).coil(0); }));
  poller.send(SIGINT);
  EXPECT_EQ(poller.status(), 0);
  EXPECT_NE(poller.err().find("warning: Modbus client of 127.0.0.1:"), std::string::npos) << poller.err();
}

TEST(ModbusNames, OfAProjectWithoutAMapAreRefusedWithWhatItTakes) {
  const Directory directory;
  Json project = panel_project();
  project.erase("modbus");
  const std::string file = directory.write("project.json", project.dump(1));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"read", "127.0.0.1:1", "--project", file},
        {"read", "127.0.0.1:1", "speed", "--project", file},
        {"write", "127.0.0.1:1", "speed=1", "--project", file}}) {
    const Ended ended = lockstep(words);
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_NE(ended.err.find("the project has no Modbus map"), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find("lockstep describe keys modbus.map"), std::string::npos) << ended.err;
  }
  EXPECT_EQ(lockstep({"describe", "keys", "modbus.map"}).status, 0) << "as it says";
}

}  // namespace
}  // namespace lockstep::test::modbus_names_test
