// What a user does with traces at the desk: drops them, compares them, computes of them, keeps layouts beside
// the project.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hmi_bridge/lcm/log.hpp"
#include "tests/studio/desk_page.hpp"
#include "tests/support/directory.hpp"
#include "tests/support/values.hpp"

namespace lockstep::desk_test {
namespace {

using Json = nlohmann::json;
using test::kDrawn;
using Page = test::DeskPage;

constexpr double kPi = 3.14159265358979323846;

/// A trace of a row each millisecond.
std::string csv(const std::string& names, int rows, const std::function<std::string(int)>& row) {
  std::string text = "t," + names + "\n";
  for (int i = 0; i < rows; ++i) text += std::to_string(i / 1000.0) + "," + row(i) + "\n";
  return text;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// A sine of 50 Hz and 2.0, with a half of it at 120 Hz, and a ramp.
std::string humming(int rows, int late = 0) {
  return csv("hum,ramp", rows, [late](int i) {
    const double t = (i - late) / 1000.0;
    return number(2.0 * std::sin(2 * kPi * 50 * t) + 1.0 * std::sin(2 * kPi * 120 * t)) + "," +
           number(std::max(0, i - late) * 0.5);
  });
}

/// Drops a trace, which is shown then.
void show(Page& page, const std::string& name, const std::string& content, const std::string& id) {
  page.drop(name, content);
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.shown [data-trace=" + id + "]')"))
      << page.browser.text(".traces-panel");
}

TEST(StudioDesk, ComparesTwoRunsThatAreDroppedAndShiftsOneInTime) {
  Page page({});
  ASSERT_TRUE(page.is_greeted()) << page.browser.text("body");
  page.open_tab("Traces");
  show(page, "before.csv", humming(1000), "file-1");
  EXPECT_TRUE(page.browser.wait_for(kDrawn +
                                    ".flatMap((one) => one.signals).filter((s) => s.rows > 500).length >= 2"))
      << page.browser.evaluate(kDrawn);
  show(page, "after.csv", humming(1000, 7), "file-2");
  const std::string other =
      "document.querySelector('[data-trace=file-1]').parentElement.querySelector('input')";
  page.browser.evaluate(other + ".click()");
  ASSERT_TRUE(page.browser.wait_for(kDrawn + "[0].signals[0].overlays === 1"));
  const std::string compare = "button[title^='With what is shown']";
  ASSERT_TRUE(page.browser.wait_for("document.querySelector(\"" + compare + "\")"));
  page.browser.click(compare);
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.compare .lost')"))
      << page.browser.text(".compare");
  EXPECT_NE(page.browser.text(".compare .lost").find("first difference: hum, tick 0"), std::string::npos)
      << page.browser.text(".compare");
  EXPECT_NE(page.browser.text(".compare table").find("ramp"), std::string::npos);
  // The moment of it is shown by a click.
  page.browser.click(".compare .lost button");
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('[data-cursor=A]')"));
  // Seven rows later they are the same.
  page.browser.choose(".shift", "7");
  page.browser.choose("[aria-label=Tolerance]", "1e-9");
  page.browser.click(compare);
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('.compare .same')"))
      << page.browser.text(".compare");
  EXPECT_NE(page.browser.text(".compare").find("without a partner: 7 and 0"), std::string::npos)
      << page.browser.text(".compare");
  page.expect_quiet();
}

TEST(StudioDesk, SaysWhyAFileIsNoTrace) {
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  page.drop("notes.csv", "this is no trace\n1,2\n");
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('.traces-panel').textContent.includes(\"notes.csv:1:1\")"))
      << page.browser.text(".traces-panel");
  page.drop("picture.png", "x");
  EXPECT_TRUE(
      page.browser.wait_for("document.querySelector('.traces-panel').textContent.includes('.csv or .lcm')"))
      << page.browser.text(".traces-panel");
}

TEST(StudioDesk, SaysOfEachFileThatIsNoTraceWhy) {
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  page.drop("notes.csv", "this is no trace\n1,2\n");
  page.drop("numbers.csv", "t,a\n0,1\n0.001,one\n");
  for (const auto& [id, place] :
       {std::pair("file-1", "notes.csv:1:1"), std::pair("file-2", "numbers.csv:3:7")})
    EXPECT_TRUE(page.browser.wait_for("document.querySelector('[data-trace=" + std::string(id) +
                                      "]')?.textContent.includes('" + place + "')"))
        << page.browser.text(".traces-panel");
}

// That a file is no trace comes over another connection than the answer to its sending, and so at times
// before it.
TEST(StudioDesk, SaysWhyAFileIsNoTraceThoughItIsToldBeforeTheSendingIsAnswered) {
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  const std::string state = "document.querySelector('.traces-panel [role=status]').textContent";
  page.browser.evaluate(
      "window.ask = fetch; window.fetch = async (path, options) => { const answer = await ask(path, "
      "options); "
      "while (path.startsWith('api/traces?name') && !" +
      state +
      ".includes('notes.csv:1:1')) await new Promise((done) => setTimeout(done, 5)); return answer; }; true");
  page.drop("notes.csv", "this is no trace\n1,2\n");
  ASSERT_TRUE(page.browser.wait_for(
      "document.querySelector('[data-trace=file-1]').textContent.includes('cannot be read')"))
      << page.browser.text(".traces-panel");
  EXPECT_NE(page.browser.evaluate(state).get<std::string>().find("notes.csv:1:1"), std::string::npos)
      << page.browser.evaluate(state);
}

TEST(StudioDesk, SaysWhyAFileIsNoTraceThoughTheMessageIsLost) {
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  page.browser.evaluate(
      "window.parse = JSON.parse; JSON.parse = (text) => { const message = parse(text); return message.type "
      "=== 'trace' ? { type: 'lost' } : message; }; true");
  page.drop("notes.csv", "this is no trace\n1,2\n");
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('.traces-panel [role=status]').textContent.includes('notes.csv:1:1')"))
      << page.browser.text(".traces-panel");
}

TEST(StudioDesk, TellsTheSpectrumOfASignalWithItsPeaks) {
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  show(page, "hum.csv", humming(4000), "file-1");
  page.open_tab("Spectrum");
  page.browser.choose("[aria-label='Signal of the spectrum']", "hum");
  page.browser.choose("[aria-label='Window of the spectrum']", "flattop");
  page.browser.evaluate(
      "[...document.querySelectorAll('.analysis button')].find((e) => e.textContent === 'Compute').click()");
  const std::string peak = "document.querySelectorAll('[aria-label=Spectrum] tbody tr')";
  ASSERT_TRUE(page.browser.wait_for(peak + ".length >= 2"))
      << page.browser.text("[aria-label=Spectrum].analysis");
  const auto cell = [&](int row, int column) {
    return page.browser
        .evaluate("parseFloat(" + peak + "[" + std::to_string(row) + "].cells[" + std::to_string(column) +
                  "].textContent)")
        .get<double>();
  };
  EXPECT_NEAR(cell(0, 0), 50.0, 0.3);
  EXPECT_NEAR(cell(0, 1), 2.0, 0.02);
  EXPECT_NEAR(cell(1, 0), 120.0, 0.3);
  EXPECT_NEAR(cell(1, 1), 1.0, 0.02);
  page.browser.click("[aria-label=Decibel]");
  EXPECT_TRUE(
      page.browser.wait_for("Math.abs(parseFloat(" + peak + "[0].cells[1].textContent) - 6.02) < 0.1"))
      << page.browser.evaluate(peak + "[0].textContent");
  page.expect_quiet();
}

TEST(StudioDesk, TellsTheSpectrumByOrdersOfALeadingAxis) {
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  // An axis that speeds up, so that a frequency would be smeared; three waves to each unit of its position.
  const std::string drum = csv("hum,Drum.Position", 4000, [](int i) {
    const double t = i / 1000.0;
    const double position = 5.0 * t + 1.5 * t * t;
    return number(2.0 * std::sin(2 * kPi * 3.0 * position)) + "," + number(position);
  });
  show(page, "drum.csv", drum, "file-1");
  page.open_tab("Spectrum");
  page.browser.choose("[aria-label='Signal of the spectrum']", "hum");
  page.browser.choose("[aria-label='Window of the spectrum']", "flattop");
  page.browser.choose("[aria-label='Axis of the orders']", "Drum.Position");
  page.browser.evaluate(
      "[...document.querySelectorAll('.analysis button')].find((e) => e.textContent === 'Compute').click()");
  const std::string peak = "document.querySelectorAll('[aria-label=Spectrum] tbody tr')";
  ASSERT_TRUE(page.browser.wait_for(peak + ".length >= 1"))
      << page.browser.text("[aria-label=Spectrum].analysis");
  const auto number_in = [&](int column) {
    return page.browser
        .evaluate("parseFloat(" + peak + "[0].cells[" + std::to_string(column) + "].textContent)")
        .get<double>();
  };
  EXPECT_NEAR(number_in(0), 3.0, 0.05) << "waves to a unit of the position, whatever the speed";
  EXPECT_NEAR(number_in(1), 2.0, 0.05);
  EXPECT_TRUE(
      page.browser
          .evaluate("document.querySelector('svg[aria-label=Spectrum]').textContent.includes('order')")
          .get<bool>());
  // Of one that turns back there are none, and the page says so.
  const std::string back = csv("hum,Drum.Position", 2000,
                               [](int i) { return number(i % 7) + "," + number(i < 1000 ? i : 2000 - i); });
  show(page, "back.csv", back, "file-2");
  page.browser.choose("[aria-label='Axis of the orders']", "Drum.Position");
  page.browser.evaluate(
      "[...document.querySelectorAll('.analysis button')].find((e) => e.textContent === 'Compute').click()");
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('[aria-label=Spectrum] [role=status]').textContent.includes('turns back')"))
      << page.browser.text("[aria-label=Spectrum].analysis");
  EXPECT_EQ(page.browser.evaluate(peak + ".length"), 0);
}

TEST(StudioDesk, ShowsEachChannelOfALogAsATraceOfItsOwn) {
  const test::Directory directory;
  const std::string path = directory.file("run.lcm");
  const std::vector<TraceSignal> signals = {{"v", Type::LREAL, ""}};
  {
    LcmLog log(path, {"desk", "MAIN", 1'000'000, 0});
    const auto slow = log.add_channel({"desk", "SLOW", 10'000'000, 0});
    for (TraceSink* sink : {static_cast<TraceSink*>(&log), slow.get()}) sink->begin(signals);
    for (std::int64_t t = 0; t < 200; ++t) {
      log.row({t * 1'000'000, static_cast<std::uint64_t>(t), 0, std::vector<Value>{test::real(1.0)}});
      if (t % 10 == 0)
        slow->row({t * 1'000'000, static_cast<std::uint64_t>(t), 0, std::vector<Value>{test::real(2.0)}});
    }
    slow->end();
    log.end();
  }
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  page.browser.choose_file("[aria-label='Files to open']", path);
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('[data-trace=file-2]')"))
      << page.browser.text(".traces-panel");
  EXPECT_EQ(page.browser.evaluate("document.querySelector('[data-trace=file-2]').textContent"),
            "run.lcm, SLOW");
  page.browser.click("[data-trace=file-2]");
  EXPECT_TRUE(page.browser.wait_for(
      "document.querySelector('.shown [data-trace=file-2]') && " + kDrawn +
      ".some((one) => one.signals.some((s) => s.path === 'v' && s.rows >= 19 && s.rows <= 20))"))
      << page.browser.evaluate(kDrawn);
  page.expect_quiet();
}

TEST(StudioDesk, ComputesSignalsOfTheOthersByTheProjectsExpressions) {
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  show(page, "hum.csv", humming(1000), "file-1");
  page.open_tab("Signals");
  const auto draw = [&page](const std::string& expression) {
    page.browser.evaluate("document.querySelector('.picker input').focus()");
    page.browser.evaluate("document.querySelector('.picker input').value = ''");
    page.browser.type(expression);
    page.browser.press("Enter", true);
    return page.browser.wait_for(kDrawn + ".some((one) => one.signals.some((s) => s.path === " +
                                 Json(expression).dump() + " && s.rows > 500))");
  };
  EXPECT_TRUE(draw("=hum - 2.0 * ramp")) << page.browser.evaluate(kDrawn);
  EXPECT_TRUE(draw("=derivative(ramp)")) << page.browser.evaluate(kDrawn);
  // 0.5 a millisecond.
  EXPECT_TRUE(page.browser.wait_for(kDrawn +
                                    ".some((one) => one.signals.some((s) => s.path === '=derivative(ramp)') "
                                    "&& one.low <= 500 && one.high >= 500 && one.high < 600)"))
      << page.browser.evaluate(kDrawn);
  page.browser.evaluate("document.querySelector('.picker input').value = ''");
  page.browser.evaluate("document.querySelector('.picker input').focus()");
  page.browser.type("=ramp +");
  page.browser.press("Enter", true);
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('.note').textContent.includes('=ramp +')"))
      << page.browser.text(".note");
}

TEST(StudioDesk, ShowsTheJobsAndEventsOfALog) {
  const test::Directory directory;
  const std::string path = directory.file("run.lcm");
  const std::vector<TraceSignal> signals = {{"v", Type::LREAL, "mm"}};
  LcmLog log(path, {"elsewhere", "TRACE", 1'000'000, 0});
  log.begin(signals);
  TraceEvent event;
  event.source = "gear";
  event.type = "MC_GearIn";
  for (std::int64_t t = 0; t < 200; ++t) {
    event.t = t * 1'000'000;
    event.kind = t == 20 ? EventKind::job_started : EventKind::job_aborted;
    if (t == 20 || t == 150) log.event(event);
    log.row(
        {event.t, static_cast<std::uint64_t>(t), 0, std::vector<Value>{test::real(static_cast<double>(t))}});
  }
  log.end();
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  page.browser.choose_file("input[type=file]", path);
  ASSERT_TRUE(page.browser.wait_for("document.querySelector('.shown [data-trace=file-1]')"))
      << page.browser.text(".traces-panel");
  EXPECT_TRUE(page.browser.wait_for("document.querySelector('.job[data-instance=gear] rect')"))
      << page.browser.text(".bars");
  EXPECT_TRUE(page.browser.wait_for("document.querySelectorAll('.event').length === 2"));
  page.browser.press("n");
  EXPECT_TRUE(page.browser.wait_for("/gear: job/.test(document.querySelector('.note').textContent)"))
      << page.browser.text(".note");
  page.expect_quiet();
}

TEST(StudioDesk, KeepsLayoutsBesideTheProjectForEverybody) {
  const test::Directory directory;
  std::ifstream knife(test::kKnife);
  const std::string file = directory.write("project.json", {std::istreambuf_iterator<char>(knife), {}});
  Page page({.file = file});
  ASSERT_TRUE(page.is_greeted());
  ASSERT_TRUE(page.browser.wait_for(kDrawn + ".length > 1"));
  const Json before = page.browser.evaluate(kDrawn + ".length");
  page.open_tab("Layouts");
  page.browser.click("[aria-label='Name of the layout']");
  page.browser.type("for all");
  page.browser.click("button[title^='Keep this layout in studio.json']");
  const std::string kept = "[aria-label='Layouts beside the project'] [data-layout='for all']";
  ASSERT_TRUE(page.browser.wait_for("document.querySelector(\"" + kept + "\")"))
      << page.browser.text(".layouts-panel");
  EXPECT_EQ(Json::parse(test::content(directory.file("studio.json")))
                .at("layouts")
                .at("for all")
                .at("diagrams")
                .size(),
            before);
  page.browser.click(".diagram-head > button");
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('.plot').length === " +
                                    std::to_string(before.get<int>() - 1)));
  // Another browser has it as well, and what it keeps besides is lost to nobody.
  test::Browser other;
  other.open(page.url());
  ASSERT_TRUE(other.wait_for("document.querySelectorAll('.plot').length > 1"));
  other.click("[data-tab=Layouts]");
  ASSERT_TRUE(other.wait_for("document.querySelector(\"" + kept + "\")")) << other.text(".layouts-panel");
  other.click("[aria-label='Name of the layout']");
  other.type("mine");
  other.click("button[title^='Keep this layout in studio.json']");
  ASSERT_TRUE(other.wait_for(
      "document.querySelectorAll(\"[aria-label='Layouts beside the project'] [data-layout]\").length === 2"));
  page.browser.click("button[title='Forget for all']");
  EXPECT_TRUE(
      page.browser.wait_for("[...document.querySelectorAll(\"[aria-label='Layouts beside the project'] "
                            "[data-layout]\")].map((e) => e.textContent).join() === 'mine'"))
      << page.browser.text(".layouts-panel");
  page.browser.click("[data-layout=mine]");
  EXPECT_TRUE(page.browser.wait_for("document.querySelectorAll('.plot').length === " + before.dump()));
}

TEST(StudioDesk, ShowsTheCurvesOfCamFiles) {
  const std::string folder = LOCKSTEP_SOURCE_DIR "/projects/cams/";
  Page page({.cams = {folder + "feeder.cam.json", folder + "press.cam.json"}});
  ASSERT_TRUE(page.is_greeted());
  page.browser.press("3");
  ASSERT_TRUE(page.browser.wait_for("document.querySelectorAll('.cam-charts .chart-line').length === 4"))
      << page.browser.text(".cams");
  EXPECT_NE(page.browser.text(".cams").find("Leading values from 0 to "), std::string::npos)
      << page.browser.text(".cams");
  const std::string line =
      "document.querySelector('[data-curve=\"following value\"] .chart-line').getAttribute('d')";
  const Json before = page.browser.evaluate(line);
  EXPECT_GT(before.get<std::string>().size(), 2000u);
  page.browser.choose("[aria-label=Cam]", "press.cam.json");
  EXPECT_TRUE(page.browser.wait_for(line + " !== " + before.dump()));
  EXPECT_NE(page.browser.text(".cams caption").find("Extremes"), std::string::npos);
  page.expect_quiet();
}

TEST(StudioDesk, OpensASavedPageWithoutAServer) {
  const test::Directory directory;
  Page page({});
  ASSERT_TRUE(page.is_greeted());
  page.open_tab("Traces");
  show(page, "hum.csv", humming(500), "file-1");
  page.browser.call("Page.setDownloadBehavior",
                    {{"behavior", "allow"}, {"downloadPath", directory.file("")}});
  page.browser.click(".menu summary");
  page.browser.click("button[title='Save one page with the values, which opens without a server']");
  std::string name;
  for (int i = 0; i < 6000 && name.empty(); ++i) {
    page.browser.evaluate("new Promise((done) => setTimeout(done, 20))");
    for (const auto& entry : std::filesystem::directory_iterator(directory.file("")))
      if (entry.path().extension() == ".html") name = entry.path().filename().string();
  }
  ASSERT_FALSE(name.empty());
  page.expect_quiet();
  test::Browser alone;
  alone.open("file://" + directory.file(name));
  EXPECT_TRUE(
      alone.wait_for(kDrawn + ".flatMap((one) => one.signals).filter((s) => s.rows > 490).length === 2"))
      << alone.text("body");
  EXPECT_EQ(alone.complaints(), std::vector<std::string>{});
  for (const std::string& request : alone.requests())
    EXPECT_TRUE(request.starts_with("file://" + directory.file(name)) || request.starts_with("data:") ||
                request.starts_with("blob:"))
        << request;
}

}  // namespace
}  // namespace lockstep::desk_test
