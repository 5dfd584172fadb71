// What a user sees of a project and of its axes: couplings, programs, tags, data blocks, health, override
// rules.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "cli/describe/subject.hpp"
#include "tests/projects/crossing_project.hpp"
#include "tests/studio/desk_page.hpp"
#include "tests/studio/page.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::project_test {
namespace {

using Json = nlohmann::json;
using Page = test::StudioPage;

const std::string kShaft = LOCKSTEP_SOURCE_DIR "/projects/03_line_shaft/project.json";

/// As `lockstep run` has it.
RunOptions options_of(const std::string& file) {
  RunOptions options = test::options_of(file);
  options.describe = [](const std::string& path) { return cli::describe_as_json(path); };
  return options;
}

void open(Page& page, const std::string& tab) {
  page.browser.press("3");
  page.open_tab(tab);
}

TEST(StudioProject, ShowsWhichObjectFollowsWhichAndWhatItsCouplingDoes) {
  Json project = Json::parse(std::ifstream(kShaft));
  project.erase("stimuli");
  project["studio"] = {{"write", true}};
  const test::Directory directory;
  Page page(directory.write("project.json", project.dump()));
  ASSERT_TRUE(page.is_live());
  open(page, "Overview");
  const auto row = [](const std::string& coupling) {
    return "document.querySelector('tr[data-coupling=\"" + coupling + "\"]')";
  };
  ASSERT_TRUE(page.browser.wait_for(row("Shaft Chill"))) << page.browser.text(".project-screen");
  EXPECT_EQ(page.browser.evaluate("document.querySelectorAll('.graph .node').length"), 6);
  EXPECT_EQ(page.browser.evaluate("document.querySelectorAll('.graph .edge').length"), 6);
  const auto text = [&](const std::string& coupling, int cell) {
    return page.browser.evaluate(row(coupling) + ".cells[" + std::to_string(cell) + "].textContent");
  };
  EXPECT_EQ(text("Shaft Chill", 2), "gear");
  EXPECT_EQ(text("Shaft Chill", 3), "355 : 113");
  EXPECT_EQ(text("Chill Slitter", 8), "Slitter ← Chill ← Shaft")
      << "back to where its leading value comes from";
  EXPECT_TRUE(page.browser.wait_for(row("Chill Slitter") +
                                    ".querySelector('[data-state]').dataset.state === 'synchronous'"))
      << text("Chill Slitter", 5);
  // What the project allows, and no program does.
  EXPECT_EQ(text("Shaft Slitter", 4), "the project");
  EXPECT_EQ(text("Shaft Slitter", 5), "○ possible");
  // Leading objects stand above those that follow them.
  const auto top = [&](const std::string& name) {
    return page.browser
        .evaluate("Number(document.querySelector('.node[data-object=" + name + "] rect').getAttribute('y'))")
        .get<double>();
  };
  EXPECT_LT(top("Shaft"), top("Chill"));
  EXPECT_LT(top("Chill"), top("Slitter"));
  const std::string state = row("Shaft Chill") + ".querySelector('[data-state]').dataset.state";
  ASSERT_TRUE(page.browser.wait_for(state + " === 'synchronous'")) << text("Shaft Chill", 5);
  EXPECT_EQ(
      page.browser.evaluate(
          "fetch('api/write', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: "
          "JSON.stringify({ writes: [{ path: 'clutch_3', value: false }] }) }).then((one) => one.status)"),
      200);
  EXPECT_TRUE(page.browser.wait_for(state + " === 'possible'"))
      << "clutch 3 is open: " << text("Shaft Chill", 5);
  page.expect_quiet();
}

TEST(StudioProject, TellsCouplingsThatGoRoundApart) {
  Json project = Json::parse(std::ifstream(test::kKnife));
  Json& objects = project["technology_objects"];
  objects["Conveyor"]["type"] = "TO_SynchronousAxis";
  objects["Conveyor"]["leading_values"] = {{{"to", "Knife"}, {"coupling", "setpoint"}}};
  const test::Directory directory;
  Page page(directory.write("project.json", project.dump()));
  ASSERT_TRUE(page.is_live()) << page.browser.text("body");
  open(page, "Overview");
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('tr.recursive').length === 2"))
      << page.browser.text(".project-screen");
  EXPECT_NE(page.browser.text("tr.recursive").find("↻ recursive"), std::string::npos)
      << "not by colour alone";
  EXPECT_EQ(page.browser.evaluate("document.querySelector('tr.recursive .route').textContent"),
            "none: it goes round");
  page.expect_quiet();
}

TEST(StudioProject, ShowsWhatComesFromOtherControllersAndHowMuchLeadingValuesAreDelayed) {
  const test::Directory directory;
  test::DeskPage page({.file = directory.write("project.json", test::crossing_project())});
  ASSERT_TRUE(page.is_greeted());
  page.browser.press("3");
  page.open_tab("Overview");
  const auto row = [](const std::string& coupling) {
    return "document.querySelector('tr[data-coupling=\"" + coupling + "\"]')";
  };
  ASSERT_TRUE(page.browser.wait_for(row("Infeed.Conveyor Beyond"))) << page.browser.text(".project-screen");
  EXPECT_EQ(page.browser.evaluate(row("Infeed.Conveyor Beyond") + ".cells[2].textContent"), "transfer area");
  EXPECT_EQ(page.browser.evaluate(row("Infeed.Conveyor Beyond") + ".cells[4].textContent"), "belt");
  const Json elsewhere = page.browser.evaluate(
      "[...document.querySelectorAll('.node.elsewhere')].map((one) => one.dataset.object)");
  EXPECT_EQ(elsewhere, (Json{"Infeed.Conveyor", "proxies of out"}));
  // The route goes on beyond this controller.
  EXPECT_EQ(page.browser.evaluate(row("Beyond Far") + ".cells[8].textContent"),
            "Far ← Beyond ← Infeed.Conveyor");
  EXPECT_TRUE(page.browser.wait_for(row("Main Near") + ".cells[7].textContent === '0.004'"))
      << page.browser.evaluate(row("Main Near") + ".cells[7].textContent");
  EXPECT_TRUE(page.browser.wait_for(row("Line Far") + ".cells[7].textContent === '0.002'"));
  EXPECT_EQ(page.browser.evaluate(row("Main Far") + ".cells[7].textContent"), "");
  page.expect_quiet();
}

TEST(StudioProject, TellsProgramsAsTheyAreWrittenWithWhatTheirPinsHaveNow) {
  Page page;
  ASSERT_TRUE(page.is_live());
  open(page, "Programs");
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('.call').length > 15"))
      << page.browser.text(".project-screen");
  // In the order of the calls.
  const Json names = page.browser.evaluate(
      "[...document.querySelectorAll('.call b')].map((e) => e.textContent).filter((name) => name !== 'if ')");
  EXPECT_EQ(names.at(0), "power_c");
  EXPECT_EQ(names.at(1), "power_k");
  const std::string gear =
      "[...document.querySelectorAll('.call')].find((e) => e.querySelector('b')?.textContent === 'gear')";
  EXPECT_EQ(page.browser.evaluate(gear + ".querySelector('.edge-pin code').textContent"),
            "Knife.StatusWord.X5 AND start AND NOT park.Busy");
  EXPECT_TRUE(page.browser.wait_for(
      gear + ".querySelector('[data-live=\"gear.Execute\"]').dataset.value === 'true'"));
  EXPECT_TRUE(
      page.browser.wait_for(gear + ".querySelector('[data-live=\"gear.InSync\"]').dataset.value === 'true'"));
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('[data-live=cuts]') && "
                            "Number(document.querySelector('[data-live=cuts]').textContent) > 0"))
      << "the knife cuts";
  // Where a name is used.
  page.browser.click("[aria-label='Find where a name is used']");
  page.browser.type("park");
  EXPECT_TRUE(page.browser.wait_for("document.querySelectorAll('.found-name').length >= 3"));
  EXPECT_TRUE(
      page.browser
          .evaluate(
              "[...document.querySelectorAll('.found-name')].every((e) => e.dataset.text.includes('park'))")
          .get<bool>());
  // A value goes into the scope.
  page.browser.evaluate(gear + ".querySelector('[data-live=\"gear.InSync\"]').closest('button').click()");
  EXPECT_TRUE(page.browser.wait_for(
      "!document.querySelector('.scope').hidden && " + test::kDrawn +
      ".some((one) => one.signals.length === 1 && one.signals[0].path === 'gear.InSync')"));
  page.expect_quiet();
}

TEST(StudioProject, WritesSeveralTagsAtOneTickAndFiltersThem) {
  Json project = Json::parse(std::ifstream(test::kKnife));
  project["stimuli"] = Json::array();
  project["tags"]["recipe"] = {{"type", "ARRAY[2..4] OF LREAL"}};
  const test::Directory directory;
  Page page(directory.write("project.json", project.dump()));
  ASSERT_TRUE(page.is_live()) << page.browser.text("body");
  open(page, "Tags");
  const auto field = [](const std::string& tag) { return "input[aria-label='New value of " + tag + "']"; };
  ASSERT_TRUE(page.browser.wait_for("document.querySelector(\"" + field("recipe[4]") + "\")"))
      << page.browser.text("[aria-label=Tags]");
  EXPECT_EQ(page.browser.evaluate(
                "[...document.querySelectorAll('[data-tag=speed] td')].map((e) => e.textContent)[4]"),
            "holding register 10 REAL");
  EXPECT_EQ(page.browser.evaluate(
                "[...document.querySelectorAll('[data-tag=speed] td')].map((e) => e.textContent)[5]"),
            "yes")
      << "it is kept";
  const auto type = [&](const std::string& tag, const std::string& value) {
    page.browser.evaluate("document.querySelector(\"" + field(tag) + "\").focus()");
    page.browser.type(value);
  };
  type("speed", "77.5");
  type("recipe[3]", "1,25");
  const std::string write = "button[title^='Write all new values']";
  ASSERT_TRUE(page.browser.wait_for("document.querySelector(\"" + write + "\").textContent === 'Write 2'"));
  page.browser.click(write);
  ASSERT_TRUE(page.browser.wait_for(
      "document.querySelector('[aria-label=Tags] .told').textContent.startsWith('✓ written at tick')"))
      << page.browser.text("[aria-label=Tags] .told");
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('[data-live=speed]').textContent === '77.5'"));
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('[data-live=\"recipe[3]\"]').textContent === '1.25'"))
      << "either decimal sign is taken";
  // Both are events, of one tick.
  const Json events = Json::parse(page.get("/api/events").body)["events"];
  std::set<std::string> ticks;
  int written = 0;
  for (const Json& event : events)
    if (event["kind"] == "written") ++written, ticks.insert(event["tick"].get<std::string>());
  EXPECT_EQ(written, 2) << events;
  EXPECT_EQ(ticks.size(), 1u);
  // All or none: one that is wrong keeps the other from being written, and what is wrong is told.
  type("speed", "99");
  type("cuts", "-1");
  page.browser.click(write);
  ASSERT_TRUE(
      page.browser.wait_for("document.querySelector('[aria-label=Tags] .told').textContent.startsWith('✕')"));
  EXPECT_NE(page.browser.text("[aria-label=Tags] .told").find("cuts"), std::string::npos);
  EXPECT_EQ(page.browser.text("[data-live=speed]"), "77.5");
  page.browser.click("[aria-label='Filter tags']");
  page.browser.type("hmi speed");
  EXPECT_TRUE(page.browser.wait_for(
      "[...document.querySelectorAll('[data-tag]')].map((e) => e.dataset.tag).join() === 'speed'"));
}

TEST(StudioProject, MarksWhatOfADataBlockDiffersFromItsDefault) {
  Page page;
  ASSERT_TRUE(page.is_live());
  open(page, "Data");
  page.browser.choose("[aria-label='Object or instance']", "Knife");
  const std::string velocity = "document.querySelector('tr[data-path=\"Knife.DynamicLimits.MaxVelocity\"]')";
  ASSERT_TRUE(page.browser.wait_for(velocity));
  EXPECT_TRUE(page.browser
                  .evaluate(velocity + ".classList.contains('different') && " + velocity +
                            ".textContent.includes('≠')")
                  .get<bool>());
  EXPECT_EQ(page.browser.evaluate(velocity + ".cells[4].textContent"), "1200") << "of the project";
  EXPECT_NE(page.browser.evaluate(velocity + ".cells[5].textContent"), "1200") << "the default";
  EXPECT_TRUE(page.browser.wait_for(velocity + ".querySelector('[data-live]').textContent === '1200'"));
  page.browser.click("[aria-label='Only what differs from its default']");
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelectorAll('[aria-label=Data] tbody tr').length < 40 && " + velocity));
  EXPECT_EQ(
      page.browser.evaluate("document.querySelectorAll('[aria-label=Data] tbody tr:not(.different)').length"),
      0);
  page.browser.click("[aria-label='Filter variables']");
  page.browser.type("limits.maxjerk");
  EXPECT_TRUE(
      page.browser.wait_for("[...document.querySelectorAll('[aria-label=Data] tbody tr')].map((e) "
                            "=> e.dataset.path).join() === 'Knife.DynamicLimits.MaxJerk'"));
  // Into the trigger, by its button.
  page.browser.click("button[title='Trigger on Knife.DynamicLimits.MaxJerk']");
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('.trigger input[list]').value === 'Knife.DynamicLimits.MaxJerk'"));
  page.expect_quiet();
}

TEST(StudioProject, TellsHowTheRunIsAndWhatCheckSays) {
  Page page;
  ASSERT_TRUE(page.is_live());
  open(page, "Health");
  const std::string part =
      "[...document.querySelectorAll('.health')].find((e) => e.querySelector('h2').textContent === 'cycle')";
  ASSERT_TRUE(page.browser.wait_for(part)) << page.browser.text("[aria-label=Health]");
  const auto ticks = [&] {
    return page.browser
        .evaluate("(() => { const all = [..." + part +
                  ".querySelectorAll('dt')]; return Number(all.find((e) => e.textContent === "
                  "'ticks').nextElementSibling.textContent); })()")
        .get<double>();
  };
  const double before = ticks();
  EXPECT_GT(before, 0);
  EXPECT_TRUE(page.browser.wait_for("(() => { const all = [..." + part +
                                    ".querySelectorAll('dt')]; return Number(all.find((e) => e.textContent "
                                    "=== 'ticks').nextElementSibling.textContent) > " +
                                    std::to_string(before) + "; })()"));
  for (const char* name : {"overruns", "missed ticks", "worst lateness [µs]"})
    EXPECT_NE(page.browser.text("[aria-label=Health]").find(name), std::string::npos) << name;
  for (const char* name : {"tap", "modbus", "retain", "studio"})
    EXPECT_TRUE(page.browser
                    .evaluate("[...document.querySelectorAll('.health h2')].some((e) => e.textContent === '" +
                              std::string(name) + "')")
                    .get<bool>())
        << name;
  page.open_tab("Checks");
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('[aria-label=Checks]').textContent.includes('Warnings: 0')"))
      << page.browser.text("[aria-label=Checks]");
  page.expect_quiet();
}

TEST(StudioAxes, TellWhatAJobOverridesAndWhichOfItRunsNow) {
  Page page(options_of(test::kKnife));
  ASSERT_TRUE(page.is_live());
  page.browser.press("2");
  page.browser.choose(".diagnosis select", "Knife");
  const std::string job = "document.querySelector('.jobs tr[data-instance=gear] button')";
  ASSERT_TRUE(page.browser.wait_for(job + "?.textContent === 'MC_GearInPos'")) << page.browser.text(".jobs");
  page.browser.evaluate(job + ".click()");
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('.rules tbody tr').length > 5"))
      << page.browser.text(".rules");
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('.rules tr.present')?.textContent.includes('▶ runs: ')"))
      << page.browser.text(".rules");
  EXPECT_NE(page.browser.text(".rules tr.present").find("MC_GearInPos"), std::string::npos);
  // Why there are no words of a telegram, and which variables tell the same.
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('.telegram').textContent.includes('without words of PROFIdrive')"));
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('.telegram [data-path=\"Knife.ActualVelocity\"] .value').textContent !== '–'"));
  EXPECT_NE(page.browser.text(".telegram").find("NIST: ActualVelocity"), std::string::npos);
  page.expect_quiet();
}

}  // namespace
}  // namespace lockstep::project_test
