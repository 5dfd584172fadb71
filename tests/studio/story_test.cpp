// What an outsider does with the studio in his first minutes, from the first look to a motion by hand: one
// story.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/studio/page.hpp"

namespace lockstep::story_test {
namespace {

using Json = nlohmann::json;
using Page = test::StudioPage;

/// `lockstep run projects/02_rotary_knife/project.json --studio`, the project as it is.
RunOptions as_it_is() {
  RunOptions options = test::options_of(test::kKnife);
  options.stimuli = false;  // what happens, somebody does
  return options;
}

/// Types into the field of a new value, as the project's screen has one for each.
void type_value(Page& page, const std::string& path, const std::string& value, const std::string& told) {
  const std::string field = "input[aria-label='New value of " + path + "']";
  ASSERT_TRUE(page.browser.wait_for("document.querySelector(\"" + field + "\")"))
      << page.browser.text(".project-screen");
  page.browser.evaluate("document.querySelector(\"" + field + "\").focus()");
  page.browser.type(value);
  page.browser.press("Enter");
  ASSERT_TRUE(
      page.browser.wait_for("document.querySelector(\"" + told + "\").textContent.startsWith('✓ written')"))
      << page.browser.text(told);
  page.browser.evaluate("document.activeElement.blur()");
}

void write_tag(Page& page, const std::string& tag, const std::string& value) {
  page.browser.press("3");
  page.open_tab("Tags");
  type_value(page, tag, value, "[aria-label=Tags] .told");
}

void write_variable(Page& page, const std::string& variable, const std::string& value) {
  const std::string path = "Knife." + variable;
  type_value(page, path, value, "tr[data-path='" + path + "'] .told");
}

void open_data_of_knife(Page& page) {
  page.browser.press("3");
  page.open_tab("Data");
  page.browser.choose("[aria-label='Object or instance']", "Knife");
}

void see_it_run(Page& page) {
  ASSERT_TRUE(page.is_live());
  write_tag(page, "start", "TRUE");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('[data-live=synced]').dataset.value === 'true'"));
  page.browser.press("1");
  for (const char* instance : {"gear", "run"})
    ASSERT_TRUE(page.browser.wait_for("document.querySelector('.job[data-instance=" + std::string(instance) +
                                      "][data-state=\"goes on\"] rect')"))
        << instance;
  ASSERT_TRUE(page.browser.wait_for(test::kDrawn +
                                    ".some((one) => one.high >= 300 && one.signals.some((s) => s.path === "
                                    "'Knife.Velocity' && s.rows > 20))"));
}

/// A number of the table of cursors, in a column of the line of a signal.
double measured(Page& page, const std::string& path, const std::string& head) {
  const std::string cell =
      "document.querySelector('.measure tr[data-path=\"" + path +
      "\"]').cells[[...document.querySelectorAll('.measure thead th')].findIndex((e) => e.textContent === "
      "'" +
      head + "')].textContent";
  EXPECT_TRUE(page.browser.wait_for("isFinite(Number(" + cell + "))")) << path << " " << head;
  return page.browser.evaluate("Number(" + cell + ")").get<double>();
}

void measure_with_two_cursors(Page& page) {
  // A second of which all is in step.
  page.browser.choose("[aria-label='Length of the picture']", "1000000000");
  const double now =
      page.browser.evaluate("parseFloat(document.querySelector('.clock').textContent)").get<double>();
  ASSERT_TRUE(page.browser.wait_for("parseFloat(document.querySelector('.clock').textContent) > " +
                                    std::to_string(now + 1.5)));
  ASSERT_TRUE(page.stop());
  page.browser.press("a");
  page.browser.press("b");
  for (int i = 0; i < 5; ++i) page.browser.press("ArrowLeft", true);
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.times').textContent.includes('B − A -')"))
      << page.browser.text(".times");
  EXPECT_EQ(measured(page, "Knife.Velocity", "n"), 51) << "both rows and the 49 between them";
  EXPECT_NEAR(measured(page, "Conveyor.Velocity", "mean"), 200.0, 1e-3);
  EXPECT_NEAR(measured(page, "Knife.Velocity", "mean"), 300.0, 1e-3) << "3 : 2";
  EXPECT_NEAR(measured(page, "Knife.Velocity", "B − A"), 0.0, 1e-3);
  page.browser.press("Escape");
  page.browser.press(" ");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.live[aria-pressed=false]')"));
}

void arm_a_trigger_on_the_following_error(Page& page) {
  page.browser.click("[data-line='Knife.StatusPositioning.FollowingError']");
  page.browser.evaluate(
      "[...document.querySelectorAll('.popover:not([hidden]) button')].find((e) => e.textContent === "
      "'Trigger on it').click()");
  page.browser.choose(".trigger [aria-label='Kind of the trigger']", "outside");
  page.browser.choose(".trigger [aria-label=Level]", "-3");
  page.browser.choose(".trigger [aria-label='Upper level']", "3");
  page.browser.click("button[title='Wait for this']");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.trigger-state').textContent === 'armed'"))
      << page.browser.text(".trigger-state");
  page.browser.evaluate("document.activeElement.blur()");
}

const std::string kAlarm =
    "[...document.querySelectorAll('.alarm')].find((one) => one.textContent.includes('Knife: alarm 521'))";

/// No precontrol, and few degrees of following error are permitted.
void provoke_an_alarm_and_find_it(Page& page) {
  open_data_of_knife(page);
  write_variable(page, "FollowingError.MinValue", "5");
  write_variable(page, "FollowingError.MaxValue", "5");
  write_variable(page, "PositionControl.Kpc", "0");
  ASSERT_TRUE(page.browser.wait_for(kAlarm));
  const auto card = page.browser.evaluate(kAlarm + ".textContent").get<std::string>();
  for (const char* part : {"remove the enable", "Measured", "Permitted", "permitted 5 °", "Cause",
                           "the actual position lags", "Remedy", "PositionControl.Kv and Kpc"})
    EXPECT_NE(card.find(part), std::string::npos) << part << " in " << card;
  EXPECT_TRUE(page.browser.wait_for("/▼ \\d alarms?/.test(document.querySelector('.alarming').textContent)"));
  // From there to the moment in the picture.
  page.browser.evaluate(
      "[..." + kAlarm +
      ".querySelectorAll('button')].find((one) => one.textContent.startsWith('Show at')).click()");
  ASSERT_TRUE(page.browser.wait_for(
      "document.querySelector('.scope').offsetParent && document.querySelector('[data-cursor=A]') && "
      "document.querySelector('.event[data-kind=alarm]')"));
}

void look_at_what_the_trigger_has_caught(Page& page) {
  page.open_tab("Traces");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('[data-shot=shot-1]')"));
  page.browser.click("[data-shot=shot-1]");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.shown [data-shot=shot-1]')"));
  const std::string following = test::kDrawn +
                                ".flatMap((one) => one.signals.some((s) => s.path === "
                                "'Knife.StatusPositioning.FollowingError') ? [one] : [])[0]";
  EXPECT_TRUE(page.browser.wait_for(following + ".high > 3 && document.querySelector('[data-cursor=A]')"))
      << page.browser.evaluate(following);
}

void acknowledge_it(Page& page) {
  open_data_of_knife(page);
  write_variable(page, "PositionControl.Kpc", "100");
  write_variable(page, "FollowingError.MaxValue", "100");
  write_variable(page, "FollowingError.MinValue", "10");
  page.browser.click(".alarm button[title='Reset Knife']");
  ASSERT_TRUE(page.browser.wait_for("!document.querySelector('.alarm')")) << page.browser.text(".alarms");
}

const std::string kKnifePanel = ".panel[data-axis=Knife] ";
const std::string kVelocity =
    "Math.abs(parseFloat(document.querySelector('.panel[data-axis=Knife] "
    "[data-name=velocity]').textContent))";

void jog_it_under_a_dead_man(Page& page) {
  page.browser.press("4");
  ASSERT_TRUE(page.browser.wait_for(kVelocity + " < 0.01 && /^enabled.*standstill/.test(" +
                                    "document.querySelector('" + kKnifePanel + ".panel-state').textContent)"))
      << page.browser.text(kKnifePanel);
  const std::string held = "document.querySelector('.panel[data-axis=Knife] .jog[aria-pressed=true]')";
  bool has_moved = false;
  // A page that the machine has kept silent for 300 ms has let go: then anew.
  for (int attempt = 0; attempt < 20 && !has_moved; ++attempt) {
    const Json middle = page.browser.middle_of(kKnifePanel + "[data-action='jog forward']");
    page.browser.press_pointer(middle["x"], middle["y"]);
    page.browser.wait_for(kVelocity + " > 10 || !" + held);
    has_moved = page.browser
                    .evaluate(kVelocity +
                              " > 10 && document.body.classList.contains('controlled') && "
                              "!document.querySelector('.control').hidden")
                    .get<bool>();
    if (!has_moved) page.browser.release_pointer(1, 1);
  }
  EXPECT_TRUE(has_moved) << "it moves, and a frame says so: " << page.browser.text(kKnifePanel);
  page.browser.release_pointer(1, 1);
  EXPECT_TRUE(page.browser.wait_for("!" + held + " && " + kVelocity + " < 0.01")) << "it was let go";
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('.control').hidden && !document.body.classList.contains('controlled')"));
}

TEST(StudioStory, AnOutsiderLooksMeasuresTriggersFindsTheAlarmAndJogs) {
  Page page(as_it_is());
  for (const auto& chapter : {see_it_run, measure_with_two_cursors, arm_a_trigger_on_the_following_error,
                              provoke_an_alarm_and_find_it, look_at_what_the_trigger_has_caught,
                              acknowledge_it, jog_it_under_a_dead_man}) {
    chapter(page);
    if (HasFatalFailure()) return;
  }
  page.expect_quiet();
}

}  // namespace
}  // namespace lockstep::story_test
