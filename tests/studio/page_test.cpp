// What a user sees of a run in the studio's page, and does with it.
#include "tests/studio/page.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/studio/proxy.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::page_test {
namespace {

using Json = nlohmann::json;
using test::kDrawn;
using test::kKnife;
using test::options_of;
using Page = test::StudioPage;

TEST(StudioPage, ShowsKnifeAndConveyorLiveWithTheirJobsAsBars) {
  Page page;
  ASSERT_TRUE(page.browser.wait_for("document.title === 'rotary_knife'"));
  ASSERT_TRUE(page.is_live());
  // The stimuli start the web after half a second.
  EXPECT_TRUE(page.browser.wait_for(
      kDrawn + ".some((one) => one.signals.some((s) => s.path === 'Knife.Velocity') && one.high > 100)"));
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('.job[data-instance=gear] rect').getBoundingClientRect().width > 2"));
  EXPECT_TRUE(page.browser.wait_for(
      "[...document.querySelectorAll('.lane')].map((lane) => lane.textContent).includes('Conveyor')"));
  EXPECT_EQ(page.browser.text(".job[data-instance=home_k] title"), "home_k (MC_Home): done");
  // Something of the colour of the first signal is in the picture.
  EXPECT_TRUE(page.browser.wait_for(test::looking_at("0") +
                                    "for (let x = 0; x < width; ++x) for (let y = 0; y < height; ++y) if "
                                    "(has(x, y)) return true; return false; })()"));
  page.expect_quiet();
}

TEST(StudioPage, HasBarsAndAxisOfTimeInSightHoweverManyDiagramsThereAre) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.job')"));
  for (const char* path : {"start", "speed", "wanted", "ran", "synced", "alarm", "cuts", "reset"}) {
    page.browser.press("/");
    page.browser.evaluate("document.activeElement.value = ''");
    page.browser.type(path);
    ASSERT_TRUE(page.browser.wait_for("document.querySelector('.found button').dataset.path === '" +
                                      std::string(path) + "'"));
    page.browser.press("Enter", true);
    page.browser.press("Escape");
  }
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('.plot canvas').length > 12"));
  EXPECT_EQ(
      page.browser.evaluate("document.querySelector('.time').getBoundingClientRect().bottom <= innerHeight"),
      true);
  EXPECT_EQ(page.browser.evaluate(
                "document.querySelector('.job rect').getBoundingClientRect().bottom <= innerHeight"),
            true);
  page.expect_quiet();
}

// A jump of Conveyor.Position from 240 mm to 0 would be a line from the top to the bottom.
TEST(StudioPage, DrawsNothingAcrossTheJumpOfAModulo) {
  Page page;
  const std::string one = kDrawn +
                          ".findIndex((one) => one.signals.length === 1 && one.signals[0].path === "
                          "'Conveyor.Position' && one.high > 200)";
  ASSERT_TRUE(page.browser.wait_for(one + " >= 0"));
  // Two turns of the web.
  ASSERT_TRUE(page.browser.wait_for("parseFloat(document.querySelector('.clock').textContent) > 3.5"));
  const Json longest = page.browser.evaluate(
      test::looking_at(one) +
      "let longest = 0; for (let x = 0; x < width; ++x) { let run = 0; for (let y = 0; y < height; ++y) { "
      "run = has(x, y) ? run + 1 : 0; longest = Math.max(longest, run); } } return longest / height; })()");
  EXPECT_GT(longest.get<double>(), 0.0);
  EXPECT_LT(longest.get<double>(), 0.5);
  page.expect_quiet();
}

TEST(StudioPage, StopsThePictureAndMeasuresWithTwoCursors) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.stop());
  const Json still = page.drawn();
  const std::string clock = page.browser.text(".clock");
  page.browser.press("a");
  page.browser.press("b");
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('.measure tbody tr').length > 3"));
  page.browser.press("ArrowRight", true);
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.times').textContent.includes('B − A 20 ms')"))
      << "ten rows of 2 ms: " << page.browser.text(".times");
  EXPECT_NE(page.browser.text(".times").find("1 / (B − A) 50 Hz"), std::string::npos);
  EXPECT_EQ(page.drawn()[0]["from"], still[0]["from"]) << "the picture stands";
  // What the server says of the same rows.
  const std::string row = ".measure tr[data-path=\"Conveyor.Position\"]";
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('" + row + "').cells[8].textContent !== '–'"))
      << page.browser.text(".measure") << page.browser.text(".state");
  const Json cells = page.browser.evaluate("[...document.querySelector('" + row +
                                           "').cells].map((cell) => cell.textContent)");
  const double a = std::stod(cells[1].get<std::string>());
  const double b = std::stod(cells[2].get<std::string>());
  EXPECT_NEAR(std::stod(cells[3].get<std::string>()), b - a, 1e-6);
  EXPECT_LE(std::stod(cells[5].get<std::string>()), std::min(a, b) + 1e-6);
  EXPECT_GE(std::stod(cells[6].get<std::string>()), std::max(a, b) - 1e-6);
  page.browser.press("Escape");
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('.measure').hidden"));
  page.browser.press(" ");
  EXPECT_TRUE(page.browser.wait_for(kDrawn + "[0].from > " + still[0]["from"].dump())) << "it goes on";
  EXPECT_NE(clock, "");
  page.expect_quiet();
}

TEST(StudioPage, FindsASignalByTypingAndShowsItInADiagram) {
  Page page;
  ASSERT_TRUE(page.is_live());
  page.browser.press("/");
  page.browser.type("knife.actualvel");
  ASSERT_TRUE(page.browser.wait_for(
      "document.querySelector('.found button').dataset.path === 'Knife.ActualVelocity'"))
      << page.browser.text(".found");
  page.browser.press("Enter", true);
  EXPECT_TRUE(page.browser.wait_for(kDrawn + ".some((one) => one.signals.length === 1 && one.signals[0].path "
                                             "=== 'Knife.ActualVelocity' && one.signals[0].rows > 5)"));
  // It is there again when the page is loaded anew, and goes when it is taken away.
  page.browser.open(page.url());
  EXPECT_TRUE(page.browser.wait_for(
      kDrawn + ".some((one) => one.signals.some((s) => s.path === 'Knife.ActualVelocity'))"));
  page.browser.click("button[title='Remove Knife.ActualVelocity']");
  EXPECT_TRUE(
      page.browser.wait_for("![...document.querySelectorAll('.legend "
                            ".path')].some((e) => e.textContent === 'Knife.ActualVelocity')"));
  page.expect_quiet();
}

TEST(StudioPage, ZoomsByFrameWheelAndKeysAndGoesBack) {
  Page page;
  ASSERT_TRUE(page.is_live());
  const double y = page.y(0.5);
  const auto x = [&](double share) { return page.x(share); };
  page.browser.press(" ");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.live[aria-pressed=true]')"));
  const Json whole = page.drawn()[0];
  const double length = whole["to"].get<double>() - whole["from"].get<double>();
  page.browser.drag(x(0.5), y, x(0.75), y);
  const std::string span = "(" + kDrawn + "[0].to - " + kDrawn + "[0].from)";
  ASSERT_TRUE(page.browser.wait_for("Math.abs(" + span + " / " + std::to_string(length) + " - 0.25) < 0.01"));
  for (const Json& one : page.drawn())
    EXPECT_EQ(one["from"], page.drawn()[0]["from"]) << "one axis of time for all";
  page.browser.press("Backspace");
  ASSERT_TRUE(page.browser.wait_for("Math.abs(" + span + " / " + std::to_string(length) + " - 1) < 1e-6"));
  page.browser.turn_wheel(x(0.5), y, -100);
  EXPECT_TRUE(page.browser.wait_for(span + " < " + std::to_string(length * 0.9)));
  page.browser.press("-");
  page.browser.press("-");
  EXPECT_TRUE(page.browser.wait_for(span + " > " + std::to_string(length * 1.5)));
  page.expect_quiet();
}

TEST(StudioPage, ShowsAnAlarmWithCauseAndRemedyAndItsMoment) {
  Json project = Json::parse(std::ifstream(kKnife));
  project["tags"]["jammed"] = {{"type", "BOOL"}};
  Json& knife = project["technology_objects"]["Knife"];
  knife["config"]["FollowingError"] = {{"EnableMonitoring", true}, {"MinValue", 5.0}, {"MaxValue", 5.0}};
  knife["drive"]["faults"] = {{"blocked", "jammed"}};
  const Json jam = {{"at", "3s"}, {"set", {{"jammed", true}}}};
  project["stimuli"].insert(project["stimuli"].begin() + 1, jam);
  const test::Directory directory;
  Page page(directory.write("project.json", project.dump()));
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.alarm')"))
      << "the knife is blocked while it runs along";
  const std::string card = page.browser.text(".alarm");
  EXPECT_NE(card.find("Knife: alarm 52"), std::string::npos) << card;
  EXPECT_NE(card.find("Cause"), std::string::npos) << card;
  EXPECT_NE(card.find("Remedy"), std::string::npos) << card;
  EXPECT_NE(card.find("Permitted"), std::string::npos) << card;
  EXPECT_NE(card.find("Measuredfollowing error"), std::string::npos) << card;
  page.browser.click(".alarm button");
  ASSERT_TRUE(page.browser.wait_for(
      "document.querySelector('.live[aria-pressed=true]') && document.querySelector('.event')"));
  const Json alarm = Json::parse(page.get("/api/events").body)["pending"][0];
  const double t = std::stod(alarm["t"].get<std::string>());
  EXPECT_TRUE(page.browser.wait_for(kDrawn + "[0].from < " + std::to_string(t) + " && " + kDrawn +
                                    "[0].to > " + std::to_string(t)));
  page.expect_quiet();
}

TEST(StudioPage, ArmsATriggerAndShowsWhatItHasCaught) {
  Page page;
  ASSERT_TRUE(page.is_live());
  page.open_tab("Trigger");
  page.browser.click(".trigger input[list]");
  page.browser.type("gear.InSync");
  page.browser.click(".trigger input[aria-label=Level]");
  page.browser.press("End");
  page.browser.type(".5");
  page.browser.click("button[title='Wait for this']");
  ASSERT_TRUE(
      page.browser.wait_for("/^(armed|caught)/.test(document.querySelector('.trigger-state').textContent)"))
      << page.browser.text(".trigger-state");
  // The knife is in step with the web some two seconds after the start.
  page.open_tab("Traces");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('[data-shot=shot-1]')"));
  page.browser.click("[data-shot=shot-1]");
  // 200 ms before and after, unless it was armed later than that.
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.live[aria-pressed=true]') && " + kDrawn +
                                    "[0].to - " + kDrawn + "[0].from <= 400e6"));
  EXPECT_TRUE(page.browser.wait_for(kDrawn + "[0].signals[0].rows > 50"));
  EXPECT_NE(page.browser.text(".times").find("A "), std::string::npos) << "a cursor is on the occasion";
  page.open_tab("Trigger");
  page.browser.click("button[title='Wait for this']");
  page.browser.click(".trigger input[list]");
  page.browser.type(".NoSuch");
  page.browser.click("button[title='Wait for this']");
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('.trigger-state.lost').textContent.includes('NoSuch')"));
  page.expect_quiet();
}

TEST(StudioPage, TellsEveryBitOfAnAxisAndSinceWhen) {
  Page page;
  ASSERT_TRUE(page.is_live());
  page.browser.press("2");
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('.bits li').length > 60"));
  page.browser.evaluate(
      "(() => { const s = document.querySelector('.diagnosis select'); s.value = 'Knife'; "
      "s.dispatchEvent(new Event('change')); })()");
  const std::string bit = "document.querySelector('[data-path=\"Knife.StatusWord.X5\"]')";
  ASSERT_TRUE(page.browser.wait_for(bit + ".dataset.value === 'true'")) << "it is homed";
  EXPECT_EQ(page.browser.evaluate(bit + ".querySelector('.value').textContent"), "● TRUE")
      << "not by colour alone";
  // In the groups of 11.1.1, with its variable; what else its words have stands behind them, each once.
  EXPECT_EQ(page.browser.evaluate("[...document.querySelectorAll('.groups h2')].map((e) => e.textContent)."
                                  "slice(0, 7).join()"),
            "Motion,Axis,Limit switches,Motion,Synchronism,Errors,Warnings");
  const auto group_of = [&page](const std::string& path) {
    return page.browser.evaluate(
        "[...document.querySelectorAll('[data-path=\"Knife." + path +
        "\"]')].map((e) => e.closest('section').querySelector('h2').textContent).join()");
  };
  EXPECT_EQ(group_of("StatusWord.X5"), "Axis");
  EXPECT_EQ(group_of("StatusWord.X15"), "Limit switches");
  EXPECT_EQ(group_of("StatusWord2.X0"), "Motion");
  EXPECT_EQ(group_of("StatusWord.X22"), "Synchronism");
  EXPECT_EQ(group_of("ErrorWord.X11"), "Errors");
  EXPECT_EQ(group_of("WarningWord.X6"), "Warnings");
  EXPECT_EQ(group_of("OperativeSensor"), "Motion,Axis");
  const Json declared = Json::parse(page.get("/api/objects/Knife").body)["variables"];
  std::size_t bits = 0;
  for (const Json& variable : declared)
    if (variable.contains("bits") && variable["path"].get<std::string>().find("[]") == std::string::npos)
      for (const Json& one : variable["bits"]) {
        ++bits;
        EXPECT_EQ(page.browser.evaluate("document.querySelectorAll('[data-path=\"" +
                                        one["path"].get<std::string>() + "\"]').length"),
                  1)
            << one;
      }
  EXPECT_GT(bits, 40u);
  // The web is stopped after 13 s, so something of the knife changes while one looks.
  EXPECT_TRUE(page.browser.wait_for(
      "[...document.querySelectorAll('.since')].some((e) => /^since \\d/.test(e.textContent))"));
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('[data-path=\"Knife.StatusPositioning.FollowingError\"] "
                            ".value').textContent !== '–'"));
  page.browser.evaluate("document.querySelector('[data-path=\"Knife.StatusWord.X22\"] button').click()");
  EXPECT_TRUE(page.browser.wait_for(
      "!document.querySelector('.scope').hidden && " + kDrawn +
      ".some((one) => one.signals.length === 1 && one.signals[0].path === 'Knife.StatusWord.X22')"));
  page.expect_quiet();
}

TEST(StudioPage, SavesWhatItShowsAsCsvSvgAndPng) {
  Page page;
  ASSERT_TRUE(page.is_live());
  const test::Directory directory;
  page.browser.call("Page.setDownloadBehavior",
                    {{"behavior", "allow"}, {"downloadPath", directory.file("")}});
  const auto saved = [&](const std::string& title, const std::string& name) {
    page.browser.click(".menu summary");
    page.browser.click("button[title='" + title + "']");
    std::string text;
    for (int i = 0; i < 6000 && text.empty(); ++i) {
      page.browser.evaluate("new Promise((done) => setTimeout(done, 20))");
      if (std::filesystem::exists(directory.file(name))) text = test::content(directory.file(name));
    }
    return text;
  };
  page.browser.press(" ");
  const std::string csv = saved("Save the values of what is shown", "rotary_knife.csv");
  EXPECT_EQ(csv.substr(0, csv.find(',')), "t");
  EXPECT_NE(csv.find("Knife.Position"), std::string::npos);
  EXPECT_GT(std::count(csv.begin(), csv.end(), '\n'), 20);
  const std::string svg = saved("Save the picture as SVG", "rotary_knife.svg");
  EXPECT_NE(svg.find("Knife.Velocity [°/s]"), std::string::npos) << svg.substr(0, 400);
  EXPECT_NE(svg.find(" d=\"M"), std::string::npos);
  EXPECT_EQ(saved("Save the picture as PNG", "rotary_knife.png").substr(1, 3), "PNG");
  page.expect_quiet();
}

TEST(StudioPage, IsLightOrDarkAsTheSystemIsWithContrastForAll) {
  Page page;
  ASSERT_TRUE(page.is_live());
  // WCAG 2.1: contrast of relative luminances.
  const std::string contrasts =
      "(() => { const style = getComputedStyle(document.documentElement); "
      "const light = (name) => { const h = style.getPropertyValue(name).trim(); "
      "const [r, g, b] = [1, 3, 5].map((i) => parseInt(h.slice(i, i + 2), 16) / 255).map((c) => c <= 0.03928 "
      "? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4); "
      "return 0.2126 * r + 0.7152 * g + 0.0722 * b; }; "
      "const contrast = (a, b) => { const [x, y] = [light(a), light(b)].sort((p, q) => q - p); return (x + "
      "0.05) / (y + 0.05); }; "
      "return { texts: ['--ink', '--faint', '--alarm'].flatMap((name) => [contrast(name, '--ground'), "
      "contrast(name, '--raised'), contrast(name, '--bar')]), "
      "bars: ['--runs', '--done', '--aborted', '--alarm', '--signal-frame'].map((name) => contrast(name, "
      "'--on-bar')).concat(contrast('--frame', '--on-frame')), "
      "lines: [0, 1, 2, 3, 4, 5, 6, 7].map((i) => contrast('--signal-' + i, '--ground')), "
      "ground: getComputedStyle(document.body).backgroundColor }; })()";
  const auto expect_contrast = [&](const char* theme, const std::string& ground) {
    const Json seen = page.browser.evaluate(contrasts);
    EXPECT_EQ(seen["ground"], ground) << theme;
    for (const Json& text : seen["texts"]) EXPECT_GE(text.get<double>(), 4.5) << theme << seen;
    for (const Json& bar : seen["bars"]) EXPECT_GE(bar.get<double>(), 4.5) << theme << seen;
    for (const Json& line : seen["lines"]) EXPECT_GE(line.get<double>(), 3.0) << theme << seen;
  };
  page.browser.prefer_dark(false);
  expect_contrast("light", "rgb(255, 255, 255)");
  page.browser.prefer_dark(true);
  expect_contrast("dark", "rgb(15, 19, 23)");
  page.browser.press("t");
  expect_contrast("chosen", "rgb(255, 255, 255)");
  page.expect_quiet();
}

TEST(StudioPage, IsWorkedByKeysAndTellsThem) {
  Page page;
  ASSERT_TRUE(page.is_live());
  page.browser.press("?", true);
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('dialog[open]').textContent.includes('Space')"));
  page.browser.press("Escape");
  ASSERT_TRUE(page.browser.wait_for("!document.querySelector('dialog[open]')"));
  // Whatever can be pressed has a name, and is reached by Tab.
  EXPECT_EQ(page.browser.evaluate("[...document.querySelectorAll('button, input')].filter((e) => "
                                  "!(e.textContent.trim() || e.getAttribute('aria-label'))).length"),
            0);
  EXPECT_EQ(page.browser.evaluate(
                "[...document.querySelectorAll('button, input')].filter((e) => e.tabIndex < 0).length"),
            0);
  page.expect_quiet();
}

// As the example for nginx in STUDIO.md has it.
TEST(StudioPage, WorksBelowAPathOfAProxy) {
  RunOptions options = options_of(kKnife);
  options.studio_names = {"127.0.0.1"};  // the proxy's port is not the studio's
  Page page(std::move(options));
  const test::Proxy proxy(page.machine.studio_endpoint()->port, "/lockstep");
  test::Browser browser;
  browser.open("http://" + proxy.host() + "/lockstep/");
  ASSERT_TRUE(browser.wait_for(test::kHasRows)) << browser.text("body");
  browser.press("2");
  EXPECT_TRUE(browser.wait_for("document.querySelectorAll('.bits li[data-value]').length > 20"));
  EXPECT_EQ(browser.complaints(), std::vector<std::string>{});
  for (const std::string& request : browser.requests())
    EXPECT_TRUE(request.starts_with("http://" + proxy.host() + "/lockstep/") ||
                request == "ws://" + proxy.host() + "/lockstep/ws" || request == "about:blank")
        << request;
}

TEST(StudioPage, AsksForTheTokenAndTakesItOffTheAddress) {
  const test::Directory directory;
  const std::string token(64, 'a');
  const std::string file = directory.write("token", token + "\n");
  ASSERT_EQ(chmod(file.c_str(), 0600), 0);
  RunOptions options = options_of(kKnife);
  options.studio_token = file;
  Page page(std::move(options));
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('dialog[open] input[type=password]')"));
  EXPECT_EQ(page.browser.evaluate("document.querySelectorAll('.plot canvas').length"), 0);
  page.browser.open("about:blank");
  page.browser.open(page.url() + "#token=" + token);
  ASSERT_TRUE(page.is_live());
  EXPECT_EQ(page.browser.evaluate("location.href"), page.url());
  for (const std::string& request : page.browser.requests())
    EXPECT_EQ(request.find(token + "/"), std::string::npos) << "never in an address that is asked for";
}

}  // namespace
}  // namespace lockstep::page_test
