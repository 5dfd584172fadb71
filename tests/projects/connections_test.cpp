// The interconnection overview of five systems: rows, routes and delay times as computed by hand.
#include "projects/system/connections.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "projects/system/apply_delays.hpp"
#include "system_files.hpp"

namespace lockstep::connections_test {
namespace {

using test::ControllerFile;
using test::SystemFiles;

/// A controller with a leading axis `Lead`.
ControllerFile leading(double delay = 0.0) {
  ControllerFile file("leading");
  file.axis("Lead");
  file.axis("Near");
  file.provide("Lead", delay);
  file.gear("Near", "Lead", 1, 1, "delayed");
  return file;
}

/// A controller with a proxy `Line` and an axis `Far` that follows it.
ControllerFile following(int ratio, double local_delay = 0.0) {
  ControllerFile file("following", "1ms", ratio);
  file.proxy("Line", 0.1, local_delay);
  file.axis("Far");
  file.gear("Far", "Line");
  return file;
}

/// The same with a virtual axis `Virtual` that provides its value again.
ControllerFile cascading(int ratio, double delay = 0.0) {
  ControllerFile file = following(ratio, delay);
  file.axis("Virtual");
  file.provide("Virtual", delay);
  file.gear("Virtual", "Line");
  return file;
}

struct Shown {
  explicit Shown(const SystemFiles& files) {
    LoadedSystem loaded = load_system_file(files.path(), LoadedFor::looking, SeveralSources::kept);
    for (const Problem& problem : loaded.problems) ADD_FAILURE() << to_string("system.json", problem);
    system = std::move(loaded.system);
    if (system) connections = std::make_unique<Connections>(*system);
  }

  std::string name(const SystemObject& object) const {
    return object.object == nullptr ? "-" : full_name(system->controllers[object.controller], *object.object);
  }
  /// One row a line.
  std::string rows() const {
    std::string text;
    for (const Interconnection& row : connections->rows()) {
      text += name(row.source) + " " + (row.local() ? "local" : row.area + ":" + row.proxy->name) + " " +
              name(row.following);
      for (const auto& [is, word] : {std::pair{row.recursive, " recursive"},
                                     {row.cut, " cut"},
                                     {row.left_out, " left out"},
                                     {row.ambiguous, " ambiguous"},
                                     {row.extrapolated, " extrapolated"}})
        text += is ? word : "";
      text += "\n";
    }
    return text;
  }
  /// The computed delays [ms] by object; −1: none.
  std::map<std::string, double> delays() const {
    std::map<std::string, double> all;
    for (const DelayTime& one : connections->delays())
      all[name(one.object)] = one.computed ? *one.computed * 1e3 : -1.0;
    return all;
  }
  const LeadingObject* axis(const std::string& wanted) const {
    for (const Interconnection& row : connections->rows())
      if (row.following.object != nullptr && name(row.following) == wanted) return row.following.object;
    return nullptr;
  }
  std::string routes(const std::string& wanted) const {
    std::string text;
    for (const Route& route : connections->routes_of(axis(wanted))) {
      for (const Interconnection* const hop : route.hops) text += name(hop->source) + " ";
      text += route.extrapolated ? "extrapolated\n" : "interpolated\n";
    }
    return text;
  }

  std::optional<System> system;
  std::unique_ptr<Connections> connections;
};

using Delays = std::map<std::string, double>;

SystemFiles plain(double delay = 0.0) {
  SystemFiles files;
  files.add("A", leading(delay));
  files.add("B", following(2));
  files.area("line", "A.Lead", {"B.Line"});
  return files;
}

// 2 × 2 ms.
TEST(Connections, OfAPlainSystem) {
  const Shown shown(plain());
  EXPECT_EQ(shown.rows(), "A.Lead line:Line B.Far extrapolated\nA.Lead local A.Near\n");
  EXPECT_EQ(shown.delays(), (Delays{{"A.Lead", 4.0}, {"B.Line", 0.0}}));
  EXPECT_EQ(shown.routes("B.Far"), "A.Lead extrapolated\n");
  EXPECT_EQ(Shown(plain(0.004)).routes("B.Far"), "A.Lead interpolated\n");
  EXPECT_TRUE(Shown(plain(0.004)).connections->delay_of(Shown(plain(0.004)).axis("B.Far")) == nullptr);
  EXPECT_EQ(Shown(plain(0.00399)).routes("B.Far"), "A.Lead extrapolated\n");
}

// The slower one of the receivers: 2 × 4 ms.
TEST(Connections, OfTwoReceivers) {
  SystemFiles files = plain();
  files.add("C", following(4));
  files.area("line", "A.Lead", {"B.Line", "C.Line"});
  const Shown shown(files);
  EXPECT_EQ(
      shown.rows(),
      "A.Lead line:Line B.Far extrapolated\nA.Lead line:Line C.Far extrapolated\nA.Lead local A.Near\n");
  EXPECT_EQ(shown.delays(), (Delays{{"A.Lead", 8.0}, {"B.Line", 0.0}, {"C.Line", 0.0}}));
}

SystemFiles cascade() {
  SystemFiles files;
  files.add("A", leading());
  files.add("B", cascading(2));
  files.add("C", cascading(4));
  files.add("D", following(1));
  files.area("first", "A.Lead", {"B.Line"});
  files.area("second", "B.Virtual", {"C.Line"});
  files.area("third", "C.Virtual", {"D.Line"});
  return files;
}

// From the end: 2 × 1 ms; 2 × 4 ms + 2 ms; 2 × 2 ms + 10 ms.
TEST(Connections, OfACascadeOfThree) {
  const SystemFiles files = cascade();
  const Shown shown(files);
  EXPECT_EQ(shown.delays(), (Delays{{"C.Virtual", 2.0},
                                    {"C.Line", 2.0},
                                    {"B.Virtual", 10.0},
                                    {"B.Line", 10.0},
                                    {"A.Lead", 14.0},
                                    {"D.Line", 0.0}}));
  EXPECT_EQ(shown.routes("D.Far"), "C.Virtual B.Virtual A.Lead extrapolated\n");
  EXPECT_EQ(shown.routes("C.Far"), "B.Virtual A.Lead extrapolated\n");
}

// A proxy with two virtual axes is brought forward by one time, which both delay by.
TEST(Connections, OfTwoVirtualAxesOfOneProxyHaveOneDelay) {
  SystemFiles files = cascade();
  ControllerFile middle = cascading(2);
  middle.axis("Other");
  middle.provide("Other", 0.0);
  middle.gear("Other", "Line");
  files.add("B", middle);
  files.add("E", following(1));
  files.area("fourth", "B.Other", {"E.Line"});
  const Delays delays = Shown(files).delays();
  EXPECT_EQ(delays.at("B.Other"), 10.0) << "2 × 1 ms would do for itself";
  EXPECT_EQ(delays.at("B.Virtual"), 10.0);
  EXPECT_EQ(delays.at("B.Line"), 10.0);
  EXPECT_EQ(delays.at("A.Lead"), 14.0);
}

/// The virtual axis that passes the value on follows another one, and that the proxy.
SystemFiles two_hops(const std::string& coupling = "setpoint") {
  SystemFiles files = cascade();
  ControllerFile middle = following(2);
  middle.axis("Draw");
  middle.axis("Virtual");
  middle.gear("Draw", "Line", 1, 1, coupling);
  middle.gear("Virtual", "Draw");
  middle.provide("Virtual", 0.0);
  files.add("B", middle);
  return files;
}

// As in the cascade: what is between the proxy and the virtual axis is as far ahead as both.
TEST(Connections, OfAVirtualAxisTwoHopsBehindItsProxyHaveTheDelayOfACascade) {
  const Shown shown(two_hops());
  EXPECT_EQ(shown.delays(), (Delays{{"C.Virtual", 2.0},
                                    {"C.Line", 2.0},
                                    {"B.Virtual", 10.0},
                                    {"B.Line", 10.0},
                                    {"A.Lead", 14.0},
                                    {"D.Line", 0.0}}));
  EXPECT_EQ(shown.routes("D.Far"), "C.Virtual B.Virtual B.Draw A.Lead extrapolated\n");
}

// Behind the delay nothing is brought forward, so that bringing the proxy forward would serve nobody.
TEST(Connections, OfAVirtualAxisBehindADelayDoNotBringItsProxyForward) {
  const Delays delays = Shown(two_hops("delayed")).delays();
  EXPECT_EQ(delays.at("B.Virtual"), 10.0);
  EXPECT_EQ(delays.at("B.Line"), 0.0);
  EXPECT_EQ(delays.at("A.Lead"), 4.0);
}

// Both provide their value: 2 × 4 ms for the one, 2 × 1 ms would do for the other.
TEST(Connections, OfAnAxisThatFollowsTheLeadingAxisAtHomeAreThoseOfThat) {
  SystemFiles files = plain();
  ControllerFile one = leading();
  one.axis("Second");
  one.gear("Second", "Lead");
  one.provide("Second", 0.0);
  files.add("A", one);
  files.add("B", following(4));
  files.add("C", following(1));
  files.area("other", "A.Second", {"C.Line"});
  EXPECT_EQ(Shown(files).delays(),
            (Delays{{"A.Lead", 8.0}, {"A.Second", 8.0}, {"B.Line", 0.0}, {"C.Line", 0.0}}));
}

SystemFiles recursive() {
  SystemFiles files;
  ControllerFile a = cascading(1);
  a.axis("Free");
  a.provide("Free", 0.0);
  files.add("A", a);
  files.add("B", cascading(2));
  files.add("C", following(4));
  ControllerFile d = following(4);
  d.axis("Above");
  d.provide("Above", 0.0);
  files.add("D", d);
  files.area("there", "A.Virtual", {"B.Line"});
  files.area("back", "B.Virtual", {"A.Line"});
  files.area("free", "A.Free", {"C.Line"});
  return files;
}

// A.Virtual follows B.Virtual, which follows A.Virtual; A.Free and C have nothing to do with it: 2 × 4 ms.
TEST(Connections, OfARecursiveSystem) {
  const SystemFiles files = recursive();
  const Shown shown(files);
  EXPECT_TRUE(shown.connections->recursive());
  EXPECT_EQ(shown.rows(),
            "A.Virtual there:Line B.Far extrapolated\n"
            "A.Virtual there:Line B.Virtual recursive extrapolated\n"
            "B.Virtual back:Line A.Far extrapolated\n"
            "B.Virtual back:Line A.Virtual recursive extrapolated\n"
            "A.Free free:Line C.Far extrapolated\n");
  EXPECT_EQ(shown.delays(), (Delays{{"A.Line", -1.0},
                                    {"A.Virtual", -1.0},
                                    {"B.Line", -1.0},
                                    {"B.Virtual", -1.0},
                                    {"A.Free", 8.0},
                                    {"C.Line", 0.0}}));
  EXPECT_EQ(shown.routes("B.Virtual"), "") << "of recursive ones none is shown";
}

// What a recursion is left out of is computed: B.Virtual no longer counts as an axis of B.Line.
TEST(Connections, OfARecursionThatIsLeftOut) {
  SystemFiles files = recursive();
  files.json["delays"]["left_out"] = {"A.Virtual", "B.Virtual"};
  const Shown shown(files);
  EXPECT_EQ(shown.delays().at("A.Virtual"), 4.0) << "for B.Far";
  EXPECT_EQ(shown.delays().at("B.Virtual"), 2.0) << "for A.Far";
  EXPECT_NE(shown.rows().find("B.Virtual recursive cut left out"), std::string::npos);
}

// 10.6.2: of a recursion one interconnection does not count. A.Virtual no longer is an axis of A.Line, so
// that B.Virtual delays by 2 × 1 ms, for A.Far; as much brings B.Line forward, and A.Virtual delays by 2 × 2
// ms more.
TEST(Connections, OfARecursionOfWhichOneIsLeftOutAreComputed) {
  SystemFiles files = recursive();
  files.json["delays"]["left_out"] = {"A.Virtual"};
  const Shown shown(files);
  EXPECT_EQ(shown.delays(), (Delays{{"A.Line", 0.0},
                                    {"A.Virtual", 6.0},
                                    {"B.Line", 2.0},
                                    {"B.Virtual", 2.0},
                                    {"A.Free", 8.0},
                                    {"C.Line", 0.0}}));
  EXPECT_NE(shown.rows().find("A.Virtual there:Line B.Virtual recursive cut extrapolated\n"),
            std::string::npos)
      << shown.rows();
  EXPECT_NE(shown.rows().find("B.Virtual back:Line A.Virtual recursive cut left out extrapolated\n"),
            std::string::npos);
  EXPECT_TRUE(shown.connections->recursive()) << "it is there for all that";
  // An object whose delay stays as it is leaves its interconnections out as well.
  files.json["delays"] = {{"fixed", {"A.Line"}}};
  EXPECT_EQ(Shown(files).delays().at("A.Virtual"), 6.0);
}

// The way of D.Far goes through a recursion; whoever leads into one has no delay either, nor the proxy before
// it.
TEST(Connections, OfWhatLeadsThroughARecursionHaveNoRoute) {
  SystemFiles files;
  files.add("A", leading());
  files.add("B", cascading(1));
  ControllerFile c = cascading(1);
  c.proxy("Back", 0.1, 0.0);
  c.interconnect("Virtual", "Back");
  files.add("C", c);
  files.add("D", cascading(1));
  files.area("in", "A.Lead", {"B.Line"});
  files.area("there", "B.Virtual", {"C.Line"});
  files.area("round", "C.Virtual", {"D.Line"});
  files.area("back", "D.Virtual", {"C.Back"});
  const Shown shown(files);
  for (const char* const none :
       {"A.Lead", "B.Line", "B.Virtual", "C.Line", "C.Virtual", "D.Line", "D.Virtual"})
    EXPECT_EQ(shown.delays().at(none), -1.0) << none;
  EXPECT_EQ(shown.routes("D.Far"), "C.Virtual B.Virtual A.Lead extrapolated\n");
  EXPECT_EQ(Shown(recursive()).routes("A.Far"), "") << "there is no other way";
}

// Telegrams come every 8 ms: 2 × 1 ms, as computed, do not last until the next one.
TEST(Connections, OfASlowSourceAreExtrapolatedBetweenItsTelegrams) {
  for (const auto& [delay, word] :
       {std::pair{0.002, "A.Lead extrapolated\n"}, {0.008, "A.Lead interpolated\n"}}) {
    SystemFiles files;
    ControllerFile slow("leading", "1ms", 8);
    slow.axis("Lead");
    slow.provide("Lead", delay);
    files.add("A", slow);
    files.add("B", following(1));
    files.area("line", "A.Lead", {"B.Line"});
    const Shown shown(files);
    EXPECT_EQ(shown.delays().at("A.Lead"), 2.0) << "as published";
    EXPECT_EQ(shown.routes("B.Far"), word);
  }
}

TEST(Connections, OfAProxyWithTwoSourcesAreAmbiguous) {
  SystemFiles files = plain();
  files.add("C", leading());
  files.area("other", "C.Lead", {"B.Line"});
  const Shown shown(files);
  EXPECT_EQ(shown.rows(),
            "A.Lead line:Line B.Far ambiguous extrapolated\n"
            "C.Lead other:Line B.Far ambiguous extrapolated\n"
            "A.Lead local A.Near\nC.Lead local C.Near\n");
  EXPECT_EQ(shown.routes("B.Far"), "A.Lead extrapolated\nC.Lead extrapolated\n");
}

TEST(Connections, LeaveOutWhatTheSystemFileNames) {
  SystemFiles files = cascade();
  files.json["delays"]["fixed"] = {"B.Virtual"};
  EXPECT_EQ(Shown(files).delays(), (Delays{{"C.Virtual", 2.0},
                                           {"C.Line", 2.0},
                                           {"B.Virtual", 0.0},
                                           {"B.Line", 0.0},
                                           {"A.Lead", 4.0},
                                           {"D.Line", 0.0}}));
  files = cascade();
  files.json["delays"]["left_out"] = {"D.Far"};
  EXPECT_EQ(Shown(files).delays(), (Delays{{"C.Virtual", 0.0},
                                           {"C.Line", 0.0},
                                           {"B.Virtual", 8.0},
                                           {"B.Line", 8.0},
                                           {"A.Lead", 12.0},
                                           {"D.Line", 0.0}}));
}

TEST(Connections, WithinOneProjectAreShownAsWell) {
  SystemFiles files = plain();
  ControllerFile one = leading();
  one.provide("Lead", 0.0, 2);
  one.proxy("Own");
  one.axis("OnOwn");
  one.gear("OnOwn", "Own");
  one.json["transfer_areas"]["own"] = {{"from", "Lead"}, {"interface", 2}, {"to", "Own"}};
  files.add("A", one);
  EXPECT_NE(Shown(files).rows().find("A.Lead own:Own A.OnOwn"), std::string::npos);
}

// ---- Writing delays into the projects

/// Where two texts differ: what stands there in the one, and in the other.
std::pair<std::string, std::string> difference(const std::string& before, const std::string& after) {
  std::size_t first = 0;
  while (first < before.size() && first < after.size() && before[first] == after[first]) ++first;
  std::size_t end = 0;
  while (end < before.size() - first && end < after.size() - first &&
         before[before.size() - 1 - end] == after[after.size() - 1 - end])
    ++end;
  return {before.substr(first, before.size() - first - end), after.substr(first, after.size() - first - end)};
}

TEST(ApplyDelays, ChangesNoOtherByte) {
  const SystemFiles files = plain();
  // As somebody writes it, with comments, tabs and an order of his own.
  std::string text = test::content(files.directory().file("A.json"));
  const std::size_t at = text.find("\"LocalLeadingValueDelayTime\": 0.0");
  ASSERT_NE(at, text.npos);
  text.replace(at, 33, "/* [s] */\t\"LocalLeadingValueDelayTime\" :\t3.00e-3 // by hand\r\n");
  files.directory().write("A.json", text);
  const Shown shown(files);
  const ChangedFiles changed = with_delays(*shown.system, *shown.connections);
  EXPECT_TRUE(changed.problems.empty());
  ASSERT_EQ(changed.files.size(), 1u) << "that of the proxy is 0 already";
  EXPECT_EQ(difference(text, changed.files[0].text),
            (std::pair<std::string, std::string>("3.00e-3", "0.004")));
  replace_file(changed.files[0].path, changed.files[0].text);
  const Shown again(files);
  EXPECT_TRUE(with_delays(*again.system, *again.connections).files.empty());
  EXPECT_EQ(again.routes("B.Far"), "A.Lead interpolated\n");
}

TEST(ApplyDelays, LeavesALinkToAProject) {
  const SystemFiles files = plain();
  const std::string link = files.directory().file("A.json"), real = files.directory().file("real.json");
  std::filesystem::rename(link, real);
  std::filesystem::create_symlink("real.json", link);
  const Shown shown(files);
  for (const ChangedFile& file : with_delays(*shown.system, *shown.connections).files)
    replace_file(file.path, file.text);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_NE(test::content(real).find("0.004"), std::string::npos);
}

TEST(ApplyDelays, PutsWhatIsNotThereIntoItsStructure) {
  const SystemFiles files = cascade();
  const Shown shown(files);
  for (const ChangedFile& file : with_delays(*shown.system, *shown.connections).files) {
    const std::string before = test::content(file.path);
    EXPECT_GT(file.text.size(), before.size());
    replace_file(file.path, file.text);
  }
  const Shown again(files);
  ASSERT_TRUE(again.system);
  for (const DelayTime& delay : again.connections->delays())
    EXPECT_TRUE(delay.is_current()) << again.name(delay.object) << " " << delay.configured;
  EXPECT_EQ(again.routes("C.Far"), "B.Virtual A.Lead interpolated\n");
  EXPECT_EQ(again.routes("D.Far"), "C.Virtual B.Virtual A.Lead extrapolated\n")
      << "C sends every 4 ms, 2 × 1 ms do not last as long";
}

TEST(ApplyDelays, FindsObjectsInIncludedFilesAndTellsThoseOfTemplates) {
  SystemFiles files = plain();
  ControllerFile one = leading();
  test::SystemJson part;
  part["technology_objects"]["Lead"] = one.json["technology_objects"]["Lead"];
  one.json["technology_objects"].erase("Lead");
  one.json["include"] = {"part.json"};
  files.directory().write("part.json", part.dump());
  files.add("A", one);
  const Shown shown(files);
  const ChangedFiles changed = with_delays(*shown.system, *shown.connections);
  ASSERT_EQ(changed.files.size(), 1u);
  EXPECT_EQ(changed.files[0].path, files.directory().file("part.json"));
  one.json.erase("include");
  one.json["templates"]["t"] = part;
  one.json["instances"] = test::SystemJson::parse(R"([ { "template": "t", "name": "one" } ])");
  files.add("A", one);
  const Shown templated(files);
  const ChangedFiles refused = with_delays(*templated.system, *templated.connections);
  ASSERT_EQ(refused.problems.size(), 1u);
  EXPECT_NE(refused.problems[0].find("A.Lead is made by a template"), std::string::npos);
}

TEST(ApplyDelays, RefusesOneFileForTwoControllersWithDelaysOfTheirOwn) {
  SystemFiles files = cascade();
  files.add("E", following(4));
  files.json["controllers"]["C"]["project"] = "B.json";
  files.area("third", "C.Virtual", {"D.Line", "E.Line"});
  const Shown shown(files);
  const ChangedFiles changed = with_delays(*shown.system, *shown.connections);
  ASSERT_FALSE(changed.problems.empty());
  EXPECT_NE(changed.problems[0].find("another controller runs"), std::string::npos);
}

}  // namespace
}  // namespace lockstep::connections_test
