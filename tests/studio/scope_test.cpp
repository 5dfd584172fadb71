// The oscilloscope as a user works with it: one test for each thing that it does.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/studio/page.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::scope_test {
namespace {

using Json = nlohmann::json;
using test::kDrawn;
using Page = test::StudioPage;

/// Has this signal, in a diagram of its own.
std::string alone(const std::string& path) {
  return kDrawn + ".some((one) => one.signals.length === 1 && one.signals[0].path === '" + path + "')";
}

/// Diagram that has a signal, from 0.
std::size_t diagram_of(Page& page, const std::string& path) {
  return page.browser
      .evaluate(kDrawn + ".findIndex((one) => one.signals.some((s) => s.path === '" + path + "'))")
      .get<std::size_t>();
}

/// What one diagram shows.
std::string drawn_at(std::size_t diagram) {
  return kDrawn + "[" + std::to_string(diagram) + "]";
}

TEST(StudioScope, TakesASignalFromTheTreeByDraggingItOntoADiagram) {
  Page page;
  ASSERT_TRUE(page.is_live());
  const auto open = [&page](const std::string& name) {
    const std::string one =
        "[...document.querySelectorAll('.tree summary')].find((e) => e.textContent.startsWith('" + name +
        "'))";
    ASSERT_TRUE(page.browser.wait_for(one));
    page.browser.evaluate(one + ".click()");
  };
  open("Objects");
  open("Conveyor");
  const std::string leaf = ".tree [data-path='Conveyor.Acceleration']";
  ASSERT_TRUE(page.browser.wait_for("document.querySelector(\"" + leaf + "\")"));
  const std::size_t diagram = diagram_of(page, "Conveyor.Velocity");
  const Json from = page.browser.middle_of(leaf);
  page.browser.drag(from["x"], from["y"], page.x(0.5, diagram), page.y(0.5, diagram));
  EXPECT_TRUE(page.browser.wait_for(
      drawn_at(diagram) +
      ".signals.map((s) => s.path).join() === 'Conveyor.Velocity,Conveyor.Acceleration'"));
  EXPECT_TRUE(page.browser.wait_for("Object.keys(" + drawn_at(diagram) + ".ranges).length === 2"))
      << "an axis for each unit";
  // From one diagram to below all of them: a diagram of its own.
  const Json line = page.browser.middle_of("[data-line='Conveyor.Acceleration']");
  page.browser.drag(line["x"], line["y"], page.x(0.5, 0), page.y(0.5, 0));
  EXPECT_TRUE(
      page.browser.wait_for(drawn_at(0) + ".signals.some((s) => s.path === 'Conveyor.Acceleration')"));
  page.expect_quiet();
}

TEST(StudioScope, DrawsASignalInAnotherColourScaledMovedAndHidden) {
  Page page;
  ASSERT_TRUE(page.is_live());
  const std::size_t diagram = diagram_of(page, "Conveyor.Velocity");
  ASSERT_TRUE(
      page.browser.wait_for(drawn_at(diagram) + ".high >= 200 && " + drawn_at(diagram) + ".high < 800"));
  const Json before = page.browser.evaluate(drawn_at(diagram) + ".signals[0].colour");
  page.browser.click("[data-line='Conveyor.Velocity']");
  ASSERT_TRUE(page.browser.wait_for("!document.querySelectorAll('.popover')[" + std::to_string(diagram) +
                                    "].hidden"));
  const std::string popover = ".popover:not([hidden]) ";
  page.browser.click(popover + ".colour-6");
  EXPECT_TRUE(page.browser.wait_for(drawn_at(diagram) + ".signals[0].colour !== " + before.dump()));
  page.browser.evaluate("document.querySelector('" + popover + "[aria-label=Scale]').value = '10'");
  page.browser.choose(popover + "[aria-label=Scale]", "10");
  page.browser.choose(popover + "[aria-label=Offset]", "-5000");
  // It goes at 120 to 300, at first at 200, and may have come from 0 before anybody looked.
  EXPECT_TRUE(page.browser.wait_for(drawn_at(diagram) + ".low <= -2900 && " + drawn_at(diagram) +
                                    ".high >= -3100 && " + drawn_at(diagram) + ".high < 0"))
      << page.browser.evaluate(drawn_at(diagram));
  page.browser.click(popover + "[aria-label=Visible]");
  EXPECT_TRUE(page.browser.wait_for(drawn_at(diagram) + ".signals.length === 0"));
  page.browser.press("Escape");
  EXPECT_TRUE(page.browser.wait_for("!document.querySelector('.popover:not([hidden])')"));
  page.expect_quiet();
}

TEST(StudioScope, DrawsStatesAsBandsWithTheNamesOfTheirValues) {
  Page page;
  ASSERT_TRUE(page.is_live());
  const std::string path = "Knife.StatusSynchronizedMotion.FunctionState";
  page.browser.press("/");
  page.browser.type(path);
  ASSERT_TRUE(
      page.browser.wait_for("document.querySelector('.found button')?.dataset.path === '" + path + "'"));
  page.browser.press("Enter", true);
  // What its gear makes of the knife most of the time, as it is declared with the variable; as much as fits.
  EXPECT_TRUE(
      page.browser.wait_for("[...document.querySelectorAll('.band-name')].some((one) => "
                            "/gearing/.test(one.lastChild.textContent))"))
      << page.browser.evaluate("[...document.querySelectorAll('.band-name')].map((one) => one.textContent)");
  // As a line it has an axis of values in place of names.
  page.browser.click("[data-line='" + path + "']");
  const std::string popover = ".popover:not([hidden]) ";
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('" + popover + "[aria-label=\"Drawn as\"]')"));
  page.browser.choose(popover + "[aria-label='Drawn as']", "line");
  EXPECT_TRUE(
      page.browser.wait_for("![...document.querySelectorAll('.band-name')].some((one) => "
                            "/gearing/.test(one.lastChild.textContent))"));
  page.expect_quiet();
}

TEST(StudioScope, RollsByMovingThePictureAndSweepsWithAPen) {
  Page page;
  ASSERT_TRUE(page.is_live());
  page.browser.choose("[aria-label='Length of the picture']", "1000000000");
  ASSERT_TRUE(page.browser.wait_for(kDrawn + "[0].to - " + kDrawn + "[0].from === 1e9"));
  // From now on: how often a picture is drawn whole before it rolls depends on how fast the page is.
  const auto drawn = [&](const char* how) {
    return page.browser.evaluate(drawn_at(1) + "." + how).get<double>();
  };
  const double moved = drawn("moved");
  const double whole = drawn("whole");
  ASSERT_TRUE(page.browser.wait_for(drawn_at(1) + ".moved > " + std::to_string(moved + 40)));
  EXPECT_GT(drawn("moved") - moved, 2 * (drawn("whole") - whole))
      << "what was drawn stays, and only what is new is added";
  page.browser.choose("[aria-label='How a live picture moves']", "sweep");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.time').textContent.startsWith('+0')"));
  // The pen leaves a gap before it, and all else is there.
  EXPECT_TRUE(page.browser.wait_for(test::looking_at("1") +
                                    "let empty = 0; for (let x = 0; x < width; ++x) { let any = false; for "
                                    "(let y = 0; y < height; ++y) any ||= has(x, y); "
                                    "empty += any ? 0 : 1; } return empty > 2 && empty < width * 0.2; })()"));
  ASSERT_TRUE(page.stop());
  EXPECT_EQ(page.browser.text(".time").find('+'), std::string::npos) << "what stands has its own times";
  page.expect_quiet();
}

TEST(StudioScope, MeasuresValuesWithTwoFurtherCursors) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.stop());
  page.browser.press("c");
  page.browser.press("d");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.times').textContent.includes('D − C')"));
  const auto difference = [&page] {
    return page.browser
        .evaluate("Number(/D − C (\\S+)/.exec(document.querySelector('.times').textContent)[1])")
        .get<double>();
  };
  const Json range = page.drawn()[0];
  const double height = range["high"].get<double>() - range["low"].get<double>();
  EXPECT_NEAR(difference(), height / 3, 1e-3 * height);
  // D is dragged to the upper edge.
  const Json line = page.browser.middle_of("[data-cursor=D]");
  page.browser.drag(page.x(0.5), line["y"], page.x(0.5), page.y(0.0) + 1);
  ASSERT_TRUE(page.browser.wait_for(
      "Number(/D − C (\\S+)/.exec(document.querySelector('.times').textContent)[1]) > " +
      std::to_string(height / 2)));
  EXPECT_NEAR(difference(), height * 2 / 3, 0.05 * height);
  page.expect_quiet();
}

TEST(StudioScope, ZoomsEachAxisOfValuesAndTakesThemBack) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.stop());
  const std::size_t diagram = diagram_of(page, "Conveyor.Velocity");
  const Json before = page.browser.evaluate(drawn_at(diagram));
  const std::string size = "(" + drawn_at(diagram) + ".high - " + drawn_at(diagram) + ".low)";
  const double height = before["high"].get<double>() - before["low"].get<double>();
  page.browser.turn_wheel(page.x(0.0, diagram) - 30, page.y(0.5, diagram), -100);
  EXPECT_TRUE(page.browser.wait_for("Math.abs(" + size + " - " + std::to_string(height * 0.8) + ") < 1e-6"));
  EXPECT_EQ(page.browser.evaluate(drawn_at(diagram) + ".from"), before["from"]) << "time stays";
  page.browser.drag(page.x(0.0, diagram) - 30, page.y(0.5, diagram), page.x(0.0, diagram) - 30,
                    page.y(0.9, diagram));
  EXPECT_TRUE(
      page.browser.wait_for(drawn_at(diagram) + ".high > " +
                            std::to_string(before["high"].get<double>() - height * 0.1 + height * 0.2)));
  page.browser.click(".legend [data-line='Conveyor.Velocity']");
  page.browser.press("Escape");
  page.browser.evaluate("document.activeElement.blur()");
  page.browser.press("v");
  EXPECT_TRUE(page.browser.wait_for("Math.abs(" + size + " - " + std::to_string(height) + ") < 1e-6"));
  // The whole, by the key and by the strip above.
  page.browser.press("Home");
  const std::string share = "parseFloat(document.querySelector('.strip-window').style.width)";
  ASSERT_TRUE(page.browser.wait_for(share + " > 90"));
  page.browser.press("+");
  page.browser.press("+");
  page.browser.press("+");
  ASSERT_TRUE(page.browser.wait_for(share + " < 40"));
  page.browser.evaluate("document.activeElement.blur()");
  // Framed in the strip: its right end, which the window in the middle leaves free.
  const Json strip = page.browser.middle_of(".strip-track");
  const double wide =
      page.browser.evaluate("document.querySelector('.strip-track').clientWidth").get<double>();
  const double right = strip["x"].get<double>() + wide / 2;
  // The run goes on, so that the whole grows until one lets go: 15 % of it at least.
  const Json shown = page.browser.evaluate(drawn_at(diagram));
  const double length = shown["to"].get<double>() - shown["from"].get<double>();
  const double whole = length / page.browser.evaluate(share).get<double>() * 100;
  page.browser.drag(right - wide / 5, strip["y"], right - wide / 20, strip["y"]);
  const std::string framed = "(" + drawn_at(diagram) + ".to - " + drawn_at(diagram) + ".from)";
  EXPECT_TRUE(page.browser.wait_for(drawn_at(diagram) + ".to > " + std::to_string(shown["to"].get<double>()) +
                                    " && " + framed + " > " + std::to_string(0.14 * whole) + " && Math.abs(" +
                                    framed + " - " + std::to_string(length) + ") > 1000"))
      << page.browser.evaluate(drawn_at(diagram)) << shown << whole;
  page.expect_quiet();
}

TEST(StudioScope, DrawsOneSignalOverAnother) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.browser.wait_for(drawn_at(0) + ".signals[0].rows > 600"));
  ASSERT_TRUE(page.stop());
  page.open_tab("XY");
  page.browser.choose("[aria-label='Signal to the right']", "Conveyor.Velocity");
  page.browser.choose("[aria-label='Signal upwards']", "Knife.Velocity");
  page.browser.press("a");
  ASSERT_TRUE(
      page.browser.wait_for("document.querySelector('.chart[aria-label]').getAttribute('aria-label')."
                            "startsWith('Knife.Velocity over "
                            "Conveyor.Velocity')"));
  EXPECT_TRUE(page.browser.wait_for("Number(document.querySelector('.chart').dataset.points) > 500"));
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('.chart-name').textContent === 'A'"))
      << "the cursor of time stands on the curve";
  EXPECT_GT(
      page.browser.evaluate("document.querySelector('.chart-line').getAttribute('d').length").get<int>(),
      1000);
  page.expect_quiet();
}

// Nothing moves then that would have it drawn again.
TEST(StudioScope, ShowsAtOnceWhatIsChosenWhileThePictureStands) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.stop());
  page.open_tab("XY");
  // One after the other, faster than the curve is drawn.
  for (const char* path : {"Knife.Velocity", "Conveyor.Position", "Conveyor.Velocity", "Knife.Position"})
    page.browser.choose("[aria-label='Signal upwards']", path);
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('.chart[aria-label]').getAttribute('aria-label')."
                            "startsWith('Knife.Position over ')"))
      << page.browser.evaluate("document.querySelector('.chart[aria-label]').getAttribute('aria-label')");
  page.expect_quiet();
}

TEST(StudioScope, TellsItsPictureAsATable) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.stop());
  page.open_tab("Values");
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('.values tbody tr').length > 20"));
  EXPECT_LE(page.browser.evaluate("document.querySelectorAll('.values tbody tr').length").get<int>(), 201);
  EXPECT_NE(page.browser.text(".values thead").find("Knife.Velocity [°/s]"), std::string::npos);
  page.expect_quiet();
}

TEST(StudioScope, GoesFromEventToEventAndTellsWhatItWas) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.job[data-instance=gear]')"));
  ASSERT_TRUE(page.stop());
  page.browser.press("n");
  ASSERT_TRUE(page.browser.wait_for("!document.querySelector('.note').hidden"));
  const std::string first = page.browser.text(".note");
  page.browser.press("n");
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('.note').textContent !== " + Json(first).dump()));
  const Json bar = page.browser.middle_of(".job[data-instance=gear] rect");
  EXPECT_GT(bar["x"].get<double>(), 0.0);
  page.browser.evaluate(
      "document.querySelector('.job[data-instance=gear]').dispatchEvent(new MouseEvent('click', {bubbles: "
      "true}))");
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('.note').textContent.startsWith('gear (MC_GearInPos)')"));
  page.expect_quiet();
}

TEST(StudioScope, DrawsTheLevelOfTheTriggerWhereItIsDragged) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_TRUE(page.stop());  // the line moves with the range of a running picture
  const std::string path = "Knife.StatusPositioning.FollowingError";
  page.browser.click("[data-line='" + path + "']");
  page.browser.evaluate(
      "[...document.querySelectorAll('.popover:not([hidden]) button')].find((e) => e.textContent === "
      "'Trigger on it').click()");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.level')"));
  EXPECT_EQ(page.browser.evaluate("document.querySelector('.trigger input[list]').value"), path);
  const double before =
      page.browser.evaluate("Number(document.querySelector('.trigger [aria-label=Level]').value)")
          .get<double>();
  const Json line = page.browser.middle_of(".level");
  page.browser.drag(page.x(0.4), line["y"], page.x(0.4), line["y"].get<double>() - 15);
  EXPECT_TRUE(page.browser.wait_for("Number(document.querySelector('.trigger [aria-label=Level]').value) > " +
                                    std::to_string(before)));
  page.expect_quiet();
}

TEST(StudioScope, LaysShotsOverEachOtherSoThatTheirOccasionsMeet) {
  Page page;
  ASSERT_TRUE(page.is_live());
  page.open_tab("Trigger");
  // Waits for what does not happen, and is told to catch what is now.
  page.browser.choose(".trigger input[list]", "Knife.Position");
  page.browser.choose(".trigger [aria-label=Level]", "1000");
  page.browser.choose(".trigger [aria-label='Mode of the trigger']", "normal");
  page.browser.click("button[title='Wait for this']");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.trigger-state').textContent === 'armed'"))
      << page.browser.text(".trigger-state");
  for (const char* shot : {"shot-1", "shot-2"}) {
    page.browser.click("button[title='Catch what is now']");
    ASSERT_TRUE(page.browser.wait_for("document.querySelector('[data-shot=" + std::string(shot) + "]')"))
        << page.browser.text(".trigger-state");
  }
  page.open_tab("Traces");
  page.browser.click("[data-shot=shot-1]");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.shown [data-shot=shot-1]')"));
  EXPECT_EQ(page.browser.evaluate(drawn_at(0) + ".signals[0].overlays"), 0);
  page.browser.evaluate(
      "document.querySelector('[data-shot=shot-2]').parentElement.querySelector('input').click()");
  EXPECT_TRUE(page.browser.wait_for(drawn_at(0) + ".signals[0].overlays === 1"));
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.shift')"));
  const Json traces = Json::parse(page.get("/api/traces").body)["traces"];
  double first = 0;
  double second = 0;
  for (const Json& trace : traces) {
    if (trace["id"] == "shot-1") first = std::stod(trace["t"].get<std::string>());
    if (trace["id"] == "shot-2") second = std::stod(trace["t"].get<std::string>());
  }
  EXPECT_NEAR(page.browser.evaluate("Number(document.querySelector('.shift').value)").get<double>(),
              (first - second) / 1e6, 1e-3);
  page.browser.press(" ");
  page.expect_quiet();
}

// Lists are told anew while a pointer is down on them.
TEST(StudioScope, LosesNoClickOnAListThatIsToldAnew) {
  Page page;
  ASSERT_TRUE(page.is_live());
  ASSERT_NO_FATAL_FAILURE(page.catch_a_shot());
  const Json shot = page.browser.middle_of("[data-shot=shot-1]");
  const auto is_at = [](const Json& place, const std::string& what) {
    return "document.elementFromPoint(" + place["x"].dump() + ", " + place["y"].dump() + ")?.closest('" +
           what + "') !== null";
  };
  ASSERT_TRUE(page.browser.evaluate(is_at(shot, "[data-shot=shot-1]")).get<bool>())
      << page.browser.text("body");
  page.browser.press_pointer(shot["x"], shot["y"]);
  // The tab, chosen again, asks for what there is; the page has its answer before ours.
  page.browser.evaluate("document.querySelector('[data-tab=Traces]').click()");
  page.browser.evaluate("fetch('api/traces').then((one) => one.json()).then(() => fetch('api/traces'))");
  page.browser.release_pointer(shot["x"], shot["y"]);
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('.shown [data-shot=shot-1]')"));

  // A bar of a picture that moves is another one by the time that one lets go.
  page.browser.press(" ");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.live[aria-pressed=false]')"));
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.job[data-instance=power_k] rect')"));
  const Json bar = page.browser.evaluate(
      "(() => { const r = document.querySelector('.job[data-instance=power_k] "
      "rect').getBoundingClientRect(); "
      "const { right } = document.querySelector('.bars').getBoundingClientRect(); "
      "return {x: (Math.max(r.x, 80) + Math.min(r.right, right - 70)) / 2, y: r.y + r.height / 2}; })()");
  page.browser.evaluate("window.pressed = document.querySelector('.job[data-instance=power_k]')");
  ASSERT_TRUE(page.browser.evaluate(is_at(bar, ".job[data-instance=power_k]")).get<bool>())
      << bar << page.browser.text(".under");
  page.browser.press_pointer(bar["x"], bar["y"]);
  ASSERT_TRUE(page.browser.wait_for("!window.pressed.isConnected"));
  page.browser.release_pointer(bar["x"], bar["y"]);
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('.note').textContent.startsWith('power_k (MC_Power)')"));
  page.expect_quiet();
}

TEST(StudioScope, KeepsLayoutsByNameAndUsesThemAgain) {
  Page page;
  ASSERT_TRUE(page.is_live());
  const Json before = page.browser.evaluate(kDrawn + ".map((one) => one.signals.map((s) => s.path))");
  page.browser.evaluate("localStorage.clear()");
  page.browser.click("[data-tab='Layouts']");
  page.browser.click("[aria-label='Name of the layout']");
  page.browser.type("all of it");
  page.browser.press("Enter");
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('[data-layout=\"all of it\"]')"));
  page.browser.click(".diagram-head > button");
  ASSERT_TRUE(page.browser.wait_for(kDrawn + ".length === " + std::to_string(before.size() - 1)));
  page.browser.click("[data-layout='all of it']");
  EXPECT_TRUE(page.browser.wait_for(
      "JSON.stringify(" + kDrawn +
      ".map((one) => one.signals.map((s) => s.path))) === " + Json(before.dump()).dump()));
  page.expect_quiet();
}

/// Rows of a signal at 1 ms, of which some are missing, as the page saves them.
std::string saved_with_a_gap() {
  const int rows = 100;
  std::string bytes(24 + 16 * rows + 8 + 8 * rows, '\0');
  const auto put = [&bytes](std::size_t at, auto value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  };
  put(0, std::uint8_t{3});
  put(1, std::uint8_t{1});
  put(2, std::uint16_t{1});
  put(8, std::uint32_t{rows});
  put(24 + 16 * rows + 1, std::uint8_t{1});
  for (int i = 0; i < rows; ++i) {
    put(24 + 8 * static_cast<std::size_t>(i), std::int64_t{1'000'000} * (i < 50 ? i : i + 40));
    put(32 + 16 * rows + 8 * static_cast<std::size_t>(i), static_cast<double>(i % 7));
  }
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned value = 0;
    for (std::size_t k = 0; k < 3; ++k)
      value = value << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[value >> (18 - 6 * k) & 63u] : '=';
  }
  return Json{{"about", {{"project", "other"}}},
              {"signals", {{{"path", "Saw.Position"}, {"type", "LREAL"}, {"unit", "mm"}}}},
              {"frame", text},
              {"gaps", {{{"from", 49'000'000}, {"to", 90'000'000}, {"rows", 40}}}}}
      .dump();
}

TEST(StudioScope, HatchesRowsThatAreMissingAndCountsThem) {
  Page page;
  ASSERT_TRUE(page.is_live());
  page.open_tab("Traces");
  const test::Directory directory;
  page.browser.choose_file("input[type=file]", directory.write("gap.json", saved_with_a_gap()));
  ASSERT_TRUE(page.browser.wait_for(alone("Saw.Position")));
  EXPECT_TRUE(page.browser.wait_for(drawn_at(0) + ".gaps === 40"));
  EXPECT_EQ(page.browser.text(".gap title"), "40 rows are missing");
  EXPECT_EQ(page.browser.evaluate("document.querySelector('.gap rect').getAttribute('fill')"), "url(#hatch)");
  // Nothing is joined across: the columns of pixels in the middle are empty.
  EXPECT_EQ(page.browser.evaluate(test::looking_at("0") +
                                  "let any = 0; for (let x = Math.round(width * 0.4); x < width * 0.6; ++x) "
                                  "for (let y = 0; y < height; ++y) any += "
                                  "has(x, y) ? 1 : 0; return any; })()"),
            0);
  page.browser.click(".live");
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('.live').textContent.includes('Stop')"));
  EXPECT_TRUE(
      page.browser.wait_for(kDrawn + ".some((one) => one.signals.some((s) => s.path === 'Knife.Velocity'))"))
      << "the run is shown as it was before";
  page.expect_quiet();
}

TEST(StudioScope, SavesLayoutAndValuesAsOneFileThatOpensAgainTheSame) {
  Page page;
  ASSERT_TRUE(page.is_live());
  const test::Directory directory;
  page.browser.call("Page.setDownloadBehavior",
                    {{"behavior", "allow"}, {"downloadPath", directory.file("")}});
  ASSERT_TRUE(page.browser.wait_for("parseFloat(document.querySelector('.clock').textContent) > 3"));
  ASSERT_TRUE(page.stop());
  ASSERT_TRUE(page.browser.wait_for(kDrawn + "[0].signals[0].rows > 500"));
  const std::string seen =
      "JSON.stringify(" + kDrawn +
      ".map((one) => [one.from, one.to, one.signals.map((s) => [s.path, s.rows, s.colour])]))";
  const Json before = page.browser.evaluate(seen);
  page.browser.click(".menu summary");
  page.browser.click("button[title^='Save the layout with its values']");
  const std::string file = directory.file("rotary_knife.studio.json");
  for (int i = 0; i < 3000 && !std::filesystem::exists(file); ++i)
    page.browser.evaluate("new Promise((done) => setTimeout(done, 20))");
  ASSERT_TRUE(std::filesystem::exists(file));
  page.browser.press(" ");
  page.open_tab("Traces");
  page.browser.choose_file("input[type=file]", file);
  ASSERT_TRUE(
      page.browser.wait_for("document.querySelector('.source').textContent === 'rotary_knife (saved)'"));
  EXPECT_TRUE(page.browser.wait_for(seen + " === " + before.dump())) << page.browser.evaluate(seen) << before;
  page.expect_quiet();
}

}  // namespace
}  // namespace lockstep::scope_test
