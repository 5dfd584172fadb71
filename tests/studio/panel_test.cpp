// What the panel of the page moves, and how every motion ends: by the hand, by the page, or by its silence.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/studio/page.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::panel_test {
namespace {

using Json = nlohmann::json;
using Page = test::StudioPage;

/// The rotary knife, whose drive is blocked while a tag says so.
Json knife_that_jams() {
  Json project = Json::parse(std::ifstream(test::kKnife));
  project["tags"]["jammed"] = {{"type", "BOOL"}};
  Json& knife = project["technology_objects"]["Knife"];
  knife["config"]["FollowingError"] = {{"EnableMonitoring", true}, {"MinValue", 5.0}, {"MaxValue", 5.0}};
  knife["drive"]["faults"] = {{"blocked", "jammed"}};
  // Started, and left alone then.
  project["stimuli"] = {{{"at", "0.5s"}, {"set", {{"start", true}}}}};
  project["studio"] = {
      {"write", true},
      {"commands",
       {{"axes", {{"Knife", {{"jog_velocity", 90.0}}}, {"Conveyor", {{"jog_velocity", 100.0}}}}}}}};
  return project;
}

const std::string kKnifePanel = ".panel[data-axis=Knife] ";
const std::string kVelocity =
    "Math.abs(parseFloat(document.querySelector('.panel[data-axis=Knife] "
    "[data-name=velocity]').textContent))";

void write_tag(Page& page, const std::string& tag, const std::string& value) {
  page.browser.press("3");
  page.open_tab("Tags");
  const std::string field = "input[aria-label='New value of " + tag + "']";
  ASSERT_TRUE(page.browser.wait_for("document.querySelector(\"" + field + "\")"))
      << page.browser.text(".project-screen");
  page.browser.click(field);
  page.browser.type(value);
  page.browser.press("Enter");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.told').textContent.startsWith('✓ written')"))
      << page.browser.text(".told");
  page.browser.evaluate("document.activeElement.blur()");
}

void press_and_hold(Page& page, const std::string& action) {
  const Json middle = page.browser.middle_of(kKnifePanel + "[data-action='" + action + "']");
  page.browser.press_pointer(middle["x"], middle["y"]);
}

/// What the machine itself says, as the page may not be able to any more.
Json read(const Page& page, const Json& paths) {
  const test::HttpAnswer answer = test::StudioConnection(page.machine.studio_endpoint()->port)
                                      .post("/api/read", Json({{"paths", paths}}).dump());
  Json values;
  const Json told = Json::parse(answer.body);
  for (const Json& one : told.at("values")) values.push_back(one.at("value"));
  return values;
}

double knife_velocity(const Page& page) {
  return read(page, {"Knife.Velocity"}).at(0).get<double>();
}

/// The knife stands, homed and enabled by its program, which has parked it and has nothing left to do.
void let_the_knife_stand(Page& page) {
  write_tag(page, "start", "FALSE");
  const Json paths = {"start", "ran", "park.Busy", "Conveyor.StatusWord.X7", "Knife.StatusWord.X7"};
  const Json rest = {false, false, false, true, true};
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (read(page, paths) != rest && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_EQ(read(page, paths), rest);
  page.browser.press("4");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('" + kKnifePanel +
                                    ".panel-state').textContent.includes('standstill')"))
      << page.browser.text(kKnifePanel);
  ASSERT_TRUE(page.browser.wait_for(kVelocity + " < 0.01"));
}

bool knife_stands(const Page& page) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < until) {
    if (std::abs(knife_velocity(page)) < 0.01) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

/// Holds a button until the knife moves. A slow machine may have kept the page silent for 300 ms: then anew.
void jog(Page& page, const std::string& action = "jog forward") {
  const std::string down = "document.querySelector(\"" + kKnifePanel + "[data-action='" + action +
                           "']\").getAttribute('aria-pressed')";
  for (int attempt = 0; attempt < 20; ++attempt) {
    press_and_hold(page, action);
    page.browser.wait_for(kVelocity + " > 5 || " + down + " !== 'true'");
    if (std::abs(knife_velocity(page)) > 1) return;
    page.browser.release_pointer(1, 1);
  }
  FAIL() << "it does not move: " << page.browser.text(kKnifePanel);
}

TEST(StudioPanel, EndsAMotionWhenThePointerLeavesOrTheFocusGoesOrStopIsPressed) {
  const test::Directory directory;
  Page page(test::options_of(directory.write("project.json", knife_that_jams().dump())));
  ASSERT_TRUE(page.is_live());
  let_the_knife_stand(page);
  jog(page);
  page.browser.move_pointer(640, 700, true);
  EXPECT_TRUE(page.browser.wait_for(kVelocity + " < 0.01")) << "the pointer has left";
  page.browser.release_pointer(640, 700);

  // Held by Space, and let go.
  page.browser.evaluate("document.querySelector(\"" + kKnifePanel +
                        "[data-action='jog backward']\").focus()");
  page.browser.call("Input.dispatchKeyEvent",
                    {{"type", "keyDown"}, {"key", " "}, {"windowsVirtualKeyCode", 32}});
  EXPECT_TRUE(page.browser.wait_for(kVelocity + " > 5")) << page.browser.text(kKnifePanel);
  page.browser.call("Input.dispatchKeyEvent",
                    {{"type", "keyUp"}, {"key", " "}, {"windowsVirtualKeyCode", 32}});
  EXPECT_TRUE(page.browser.wait_for(kVelocity + " < 0.01"));

  // The window loses the focus.
  jog(page);
  page.browser.evaluate("window.dispatchEvent(new Event('blur'))");
  EXPECT_TRUE(page.browser.wait_for(kVelocity + " < 0.01"));
  page.browser.release_pointer(1, 1);

  // Another tab hides the page.
  jog(page);
  const Json other = page.browser.call("Target.createTarget", {{"url", "about:blank"}});
  page.browser.call("Target.activateTarget", other);
  EXPECT_TRUE(page.browser.wait_for("document.hidden"));
  EXPECT_TRUE(knife_stands(page)) << "the page is hidden";
  page.browser.call("Target.closeTarget", other);
  page.browser.release_pointer(1, 1);

  // Esc, which is heard from every screen.
  jog(page);
  page.browser.press("Escape");
  EXPECT_TRUE(page.browser.wait_for(kVelocity + " < 0.01"));
  page.browser.release_pointer(1, 1);
  // A page that is loaded anew moves nothing.
  page.browser.open("about:blank");
  page.browser.open(page.url());
  ASSERT_TRUE(page.is_live());
  page.browser.press("4");
  ASSERT_TRUE(page.browser.wait_for(kVelocity + " < 0.01"));
  page.expect_quiet();
}

// The page cannot say anything any more: the cycle ends the motion.
TEST(StudioPanel, LeavesNoMotionBehindWhenTheBrowserIsFrozen) {
  const test::Directory directory;
  Page page(test::options_of(directory.write("project.json", knife_that_jams().dump())));
  ASSERT_TRUE(page.is_live());
  let_the_knife_stand(page);
  jog(page);
  page.browser.freeze();
  EXPECT_TRUE(knife_stands(page)) << knife_velocity(page);
  page.browser.thaw();
  // Back again it takes up nothing by itself, though the button was never let go.
  EXPECT_TRUE(page.browser.wait_for("!document.querySelector('.jog[aria-pressed=true]')"));
  for (int i = 0; i < 10; ++i) {
    ASSERT_LT(std::abs(knife_velocity(page)), 0.01) << "reading " << i;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  page.browser.release_pointer(1, 1);
  EXPECT_TRUE(knife_stands(page)) << "back again, and let go";
}

TEST(StudioPanel, LeavesNoMotionBehindWhenTheBrowserIsKilled) {
  const test::Directory directory;
  Page page(test::options_of(directory.write("project.json", knife_that_jams().dump())));
  ASSERT_TRUE(page.is_live());
  let_the_knife_stand(page);
  jog(page);
  page.browser.kill();
  EXPECT_TRUE(knife_stands(page)) << knife_velocity(page);
}

TEST(StudioPanel, ShowsASecondOneWhoHoldsTheAxisAndRefusesIt) {
  const test::Directory directory;
  Page page(test::options_of(directory.write("project.json", knife_that_jams().dump())));
  ASSERT_TRUE(page.is_live());
  let_the_knife_stand(page);
  test::Browser second;
  second.open(page.url());
  ASSERT_TRUE(second.wait_for(test::kHasRows));
  second.press("4");
  const std::string places =
      "[...document.querySelectorAll('main, .panel button')].map((one) => { const { x, y } = "
      "one.getBoundingClientRect(); return [x, y]; })";
  const Json before = second.evaluate(places);
  jog(page);
  const std::string state = "document.querySelector('" + kKnifePanel + ".panel-state').textContent";
  EXPECT_TRUE(second.wait_for(state + ".includes('held by another panel')")) << second.text(kKnifePanel);
  EXPECT_TRUE(page.browser.wait_for(state + ".includes('held by this page')"))
      << page.browser.text(kKnifePanel);
  EXPECT_FALSE(second.evaluate("document.querySelector('.control').hidden").get<bool>())
      << "on every screen of every page";
  EXPECT_EQ(second.evaluate(places), before) << "no button has moved to where another one was";
  const Json middle = second.middle_of(kKnifePanel + "[data-action='jog backward']");
  second.press_pointer(middle["x"], middle["y"]);
  EXPECT_TRUE(second.wait_for("document.querySelector('" + kKnifePanel +
                              ".lost').textContent.startsWith('jog backward: ')"))
      << second.text(kKnifePanel);
  EXPECT_TRUE(second.wait_for("!document.querySelector('.jog[aria-pressed=true]')"))
      << "it lets go by itself";
  second.release_pointer(1, 1);
  // Stop is everybody's, and is not taken back by the one who still holds the button.
  second.press("Escape");
  EXPECT_TRUE(knife_stands(page));
  for (int i = 0; i < 5; ++i) {
    EXPECT_LT(std::abs(knife_velocity(page)), 0.01) << "reading " << i;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  page.browser.release_pointer(1, 1);
}

TEST(StudioPanel, HomesAndSetsTheOverrideAndSaysWhatIsRefused) {
  const test::Directory directory;
  Page page(test::options_of(directory.write("project.json", knife_that_jams().dump())));
  ASSERT_TRUE(page.is_live());
  let_the_knife_stand(page);
  page.browser.choose(kKnifePanel + "[aria-label='Position after homing']", "42.5");
  page.browser.click(kKnifePanel + "button[title='Set the position (MC_Home)']");
  const std::string number = "parseFloat(document.querySelector('" + kKnifePanel + "[data-name=";
  EXPECT_TRUE(page.browser.wait_for("Math.abs(" + number + "position]').textContent) - 42.5) < 0.01"))
      << page.browser.text(kKnifePanel);
  page.browser.choose(kKnifePanel + "[aria-label='Override [%]']", "50");
  page.browser.click(kKnifePanel + "button[title='Override of the velocity']");
  EXPECT_TRUE(page.browser.wait_for(number + "override]').textContent) === 50"))
      << page.browser.text(kKnifePanel);
  page.browser.choose(kKnifePanel + "[aria-label='Override [%]']", "900");
  page.browser.click(kKnifePanel + "button[title='Override of the velocity']");
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('" + kKnifePanel +
                                    ".lost').textContent.startsWith('override: ')"))
      << page.browser.text(kKnifePanel);
  EXPECT_EQ(page.browser.evaluate(number + "override]').textContent)"), 50);
  // Who enables the axis is said where the panel does not.
  EXPECT_TRUE(
      page.browser
          .evaluate("document.querySelector('" + kKnifePanel + "button[title$=\"not the panel\"]').disabled")
          .get<bool>())
      << page.browser.text(kKnifePanel);
  page.expect_quiet();
}

TEST(StudioPanel, SaysWhyItMayNotCommand) {
  Json project = knife_that_jams();
  project.erase("studio");
  const test::Directory directory;
  Page page(test::options_of(directory.write("project.json", project.dump())));
  ASSERT_TRUE(page.is_live());
  page.browser.press("4");
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('.why').offsetParent && "
                            "document.querySelector('.why').textContent.length > 10"));
  EXPECT_EQ(page.browser.evaluate("document.querySelectorAll('.stop:not([hidden]), .panel').length"), 0);
  page.expect_quiet();
}

}  // namespace
}  // namespace lockstep::panel_test
