// Arrays on Modbus: which entries a line of the map becomes, and what is wrong with one.
#include <gtest/gtest.h>

#include <string>

#include "projects/loader/project.hpp"

namespace lockstep::modbus_array_test {
namespace {

std::string project(const std::string& map, const std::string& more = "") {
  return R"({ "lockstep": 1, "name": "arrays", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Profile": { "type": "TO_Cam" } },
    "tags": { "heights": { "type": "ARRAY[0..3] OF LREAL" }, "counts": { "type": "ARRAY[-1..3] OF INT" },
      "on": { "type": "ARRAY[1..20] OF BOOL" }, "words": { "type": "ARRAY[1..3] OF WORD" },
      "points": { "type": "ARRAY[1..4] OF TO_Cam_Struct_PointData" }, "much": { "type": "ARRAY[1..100000] OF INT" },
      "good": { "type": "BOOL" }, "age": { "type": "TIME" }, "one": { "type": "INT" } },
    "modbus": { "map": [ )" +
         map + " ]" + more + " } }";
}

/// "counts[-1]@40 counts[0]@41 …", a bit as "@40.15".
std::string entries(const std::string& line) {
  const LoadedProject loaded = load_project(project(line));
  std::string text;
  for (const Problem& problem : loaded.problems) text += problem.place + ": " + problem.text + "\n";
  if (!loaded.project) return text;
  const ModbusConfig& modbus = loaded.project->modbus;
  for (const ModbusEntry& entry : modbus.maps.front().map.entries()) {
    text += (text.empty() ? "" : " ") + modbus.signal_of(entry).name + "@" + std::to_string(entry.address);
    if (entry.bit >= 0) text += "." + std::to_string(entry.bit);
  }
  return text;
}

TEST(ModbusArrays, StandElementAfterElement) {
  const std::string place = R"(", "table": "holding_register", "address": 40 })";
  const std::string all = "counts[-1]@40 counts[0]@41 counts[1]@42 counts[2]@43 counts[3]@44";
  EXPECT_EQ(entries(R"({ "tag": "counts)" + place), all);
  EXPECT_EQ(entries(R"({ "tag": "counts[*])" + place), all);
  EXPECT_EQ(entries(R"({ "tag": "counts[-1..3])" + place), all);
  EXPECT_EQ(entries(R"({ "tag": "counts[0 .. 1])" + place), "counts[0]@40 counts[1]@41");
  EXPECT_EQ(entries(R"({ "tag": "counts[2])" + place), "counts[2]@40");
  EXPECT_EQ(entries(R"({ "tag": "heights[1..3])" + place), "heights[1]@40 heights[2]@44 heights[3]@48");
  EXPECT_EQ(entries(R"({ "tag": "heights", "type": "REAL", "table": "input_register", "address": 0 })"),
            "heights[0]@0 heights[1]@2 heights[2]@4 heights[3]@6");
  EXPECT_EQ(entries(R"({ "tag": "points[2..3].y)" + place), "points[2].y@40 points[3].y@44");
  EXPECT_EQ(entries(R"({ "tag": "Profile.Point[1..2].x)" + place),
            "Profile.Point[1].x@40 Profile.Point[2].x@44");
  EXPECT_EQ(entries(R"({ "tag": "words[*].X3", "table": "coil", "address": 9 })"),
            "words[1].X3@9 words[2].X3@10 words[3].X3@11");
  EXPECT_EQ(entries(R"({ "tag": "on[1..3]", "table": "discrete_input", "address": 9 })"),
            "on[1]@9 on[2]@10 on[3]@11");
  EXPECT_EQ(entries(R"({ "tag": "on[1..4]", "bit": 14, "table": "holding_register", "address": 9 })"),
            "on[1]@9.14 on[2]@9.15 on[3]@10.0 on[4]@10.1");
}

TEST(ModbusArrays, HaveTheOrdersScaleAndAccessOfTheirLine) {
  const LoadedProject loaded = load_project(project(
      R"({ "tag": "heights", "table": "holding_register", "address": 4, "type": "DINT", "scale": 0.5, "offset": -1,
           "word_order": "little", "byte_order": "little", "access": "read" },
         { "tag": "one", "table": "holding_register", "address": 90 },
         { "tag": "counts", "table": "holding_register", "address": 100 })"));
  ASSERT_TRUE(loaded.project.has_value());
  const ModbusMapConfig& map = loaded.project->modbus.maps.front();
  ASSERT_EQ(map.map.entries().size(), 10u);
  for (std::size_t i = 0; i < 4; ++i) {
    const ModbusEntry& entry = map.map.entries()[i];
    EXPECT_EQ(entry.type, Type::DINT);
    EXPECT_EQ(entry.scale, 0.5);
    EXPECT_EQ(entry.offset, -1.0);
    EXPECT_EQ(entry.word_order, WordOrder::little);
    EXPECT_EQ(entry.byte_order, ByteOrder::little);
    EXPECT_FALSE(entry.writable);
    EXPECT_EQ(map.map.find(ModbusTable::holding_register, 4 + 2 * static_cast<std::uint32_t>(i)), &entry);
  }
  EXPECT_TRUE(map.map.entries()[9].writable);
  ASSERT_EQ(map.arrays.size(), 2u);
  EXPECT_EQ(map.arrays[0].elements.name, "heights");
  EXPECT_EQ(map.arrays[0].elements.type, "ARRAY[0..3] OF LREAL");
  EXPECT_EQ(map.arrays[1].first, 5u);
}

TEST(ModbusArrays, AreToldOfWhatIsWrong) {
  const auto told = [](const std::string& tag, const std::string& rest) {
    return entries(R"({ "tag": ")" + tag + R"(", )" + rest + " }");
  };
  const std::string place = R"("table": "holding_register", "address": 0)";
  EXPECT_EQ(
      told("counts[2..4]", place),
      "/modbus/map/0/tag: 'counts[2..4]' goes beyond the elements that there are; allowed: [*], or a range "
      "within [-1..3]\n");
  EXPECT_NE(told("counts[2..1]", place).find("/modbus/map/0/tag: [2..1] in 'counts[2..1]' is no range"),
            std::string::npos);
  EXPECT_NE(told("counts[..]", place).find("is no range of elements; allowed: [*]"), std::string::npos);
  EXPECT_NE(told("counts[4]", place).find("has no element [4]; allowed: -1 to 3"), std::string::npos);
  EXPECT_NE(told("points", place).find("one of the members of an element has to follow: x, y"),
            std::string::npos);
  EXPECT_NE(told("points[*].z", place).find("no member 'z' (did you mean 'x'?); allowed: x, y"),
            std::string::npos);
  EXPECT_NE(told("points[*][1..2].x", place).find("only one index"), std::string::npos);
  EXPECT_NE(told("one[*]", place).find("/modbus/map/0/tag: "), std::string::npos);
  EXPECT_EQ(told("counts", R"("table": "coil", "address": 0)"),
            "/modbus/map/0/table: a value of type INT does not fit the one bit of the table coil; allowed: "
            "input_register, holding_register\n");
  EXPECT_NE(
      told("heights", R"("type": "INT", )" + place).find("/modbus/map/0/type: a value of type LREAL cannot "),
      std::string::npos);
  EXPECT_NE(told("heights", R"("bit": 3, )" + place).find("/modbus/map/0/bit: only a BOOL"),
            std::string::npos);
  EXPECT_EQ(told("heights", R"("table": "holding_register", "address": 65530)"),
            "/modbus/map/0/address: 4 elements on 16 addresses from 65530 on go beyond 65535\n");
  EXPECT_NE(told("much", place).find("/modbus/map/0/address: 100000 elements on 100000 addresses from 0"),
            std::string::npos);
}

TEST(ModbusArrays, ThatOverlapAreToldOnceByTheirLines) {
  EXPECT_EQ(
      entries(R"({ "tag": "heights", "table": "holding_register", "address": 0 },
                       { "tag": "counts", "table": "holding_register", "address": 13 },
                       { "tag": "one", "table": "holding_register", "address": 17 })"),
      "/modbus/map/1/address: address 13 of the table holding_register is taken by entry 0 of the map "
      "already\n/modbus/map/2/address: address 17 of the table holding_register is taken by entry 1 of the "
      "map already\n");
}

TEST(ModbusArrays, OfAllMapsTogetherHaveALimit) {
  std::string units;
  for (int unit = 0; unit < 2; ++unit)
    units += (unit > 0 ? ", " : "") + std::string(R"({ "unit": )") + std::to_string(unit) + R"(, "map": [
      { "tag": "much[1..65536]", "table": "holding_register", "address": 0 } ] })";
  const LoadedProject loaded = load_project(project("", R"(, "units": [)" + units + "]"));
  ASSERT_EQ(loaded.problems.size(), 1u);
  EXPECT_EQ(loaded.problems.front().place, "/modbus/units/1/map/0/tag");
  EXPECT_NE(loaded.problems.front().text.find("there are more than 100000 values on Modbus"),
            std::string::npos);
}

std::string client(const std::string& reads, const std::string& writes = "") {
  return R"(, "clients": [ { "connect": "10.0.0.5:502", "devices": [ { "name": "m", "cycle": "1s",
    "read": [ )" +
         reads + R"( ], "write": [ )" + writes + " ] } ] } ]";
}

TEST(ModbusClientArrays, AreEntriesOfOneLineWithOneQuality) {
  const LoadedProject loaded = load_project(project(
      "",
      client(
          R"({ "tag": "one", "table": "input_register", "address": 0 },
                   { "tag": "counts", "table": "input_register", "address": 1, "quality": "good", "age": "age" })",
          R"({ "tag": "heights[2..3]", "table": "holding_register", "address": 0, "quality": "on[1]" })")));
  ASSERT_TRUE(loaded.project.has_value()) << loaded.problems.front().text;
  const ModbusDevice& device = loaded.project->modbus.clients.front().options.devices.front();
  ASSERT_EQ(device.reads.size(), 6u);
  EXPECT_EQ(device.reads[0].line, 0u);
  EXPECT_EQ(device.reads[5].line, 1u);
  EXPECT_EQ(device.reads[5].address, 5u);
  ASSERT_EQ(device.writes.size(), 2u);
  ASSERT_EQ(device.lines.size(), 2u);
  EXPECT_FALSE(device.lines[0].is_write);
  EXPECT_EQ(device.lines[0].line, 1u);
  EXPECT_TRUE(device.lines[0].quality.has_value());
  EXPECT_TRUE(device.lines[0].age.has_value());
  EXPECT_TRUE(device.lines[1].is_write);
}

TEST(ModbusClientArrays, AreToldOfWhatIsWrongWithTheQualityOfAnEntry) {
  const LoadedProject loaded = load_project(project(
      "",
      client(
          R"({ "tag": "one", "table": "input_register", "address": 0, "quality": "one", "age": "good" })")));
  ASSERT_EQ(loaded.problems.size(), 2u);
  EXPECT_EQ(loaded.problems[0].place, "/modbus/clients/0/devices/0/read/0/quality");
  EXPECT_NE(loaded.problems[0].text.find("no tag of type BOOL"), std::string::npos);
  EXPECT_EQ(loaded.problems[1].place, "/modbus/clients/0/devices/0/read/0/age");
}

}  // namespace
}  // namespace lockstep::modbus_array_test
