/// A run in real time, and a browser that looks into it.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "projects/runtime/runtime.hpp"
#include "tests/hmi_bridge/studio_client.hpp"
#include "tests/studio/browser.hpp"

namespace lockstep::test {

inline const std::string kKnife = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";

// Of the page, in its own language: what its pictures say that they show.
inline const std::string kDrawn =
    "[...document.querySelectorAll('.plot canvas')].map((canvas) => canvas.drawn)";
inline const std::string kHasRows =
    kDrawn + ".length > 1 && " + kDrawn +
    ".every((one) => one.signals.length && one.signals.every((s) => s.rows > 20))";

/// Begin of a function of JavaScript: `has(x, y)` is whether a pixel of a diagram has the colour of its first
/// signal.
inline std::string looking_at(const std::string& diagram) {
  return "(() => { const canvas = document.querySelectorAll('.plot canvas')[" + diagram +
         "]; const { data, width, height } = canvas.getContext('2d').getImageData(0, 0, canvas.width, "
         "canvas.height); "
         "const wanted = [1, 3, 5].map((i) => parseInt(canvas.drawn.signals[0].colour.slice(i, i + 2), 16)); "
         "const has = (x, y) => { const at = 4 * (y * width + x); return wanted.every((c, i) => data[at + i] "
         "=== c); }; ";
}

inline RunOptions options_of(const std::string& file) {
  return {.file = file,
          .stimuli = true,
          .no_modbus = true,
          .no_lcm = true,
          .no_retain = true,
          .studio = "127.0.0.1:0"};
}

/// Nothing went wrong in the page, and it asked nobody else. @param host with its port
inline void expect_quiet(const Browser& browser, const std::string& host) {
  EXPECT_EQ(browser.complaints(), std::vector<std::string>{});
  const std::string url = "http://" + host + "/";
  for (const std::string& request : browser.requests())
    EXPECT_TRUE(request.starts_with(url) || request.starts_with("ws://" + host + "/") ||
                request.starts_with("blob:" + url) || request == "about:blank")
        << request;
}

class StudioPage {
 public:
  using Json = nlohmann::json;

  explicit StudioPage(RunOptions options) : machine(std::move(options)) {
    machine.start();
    browser.open(url());
  }
  explicit StudioPage(const std::string& file = kKnife) : StudioPage(options_of(file)) {}
  ~StudioPage() {
    machine.stop();
    machine.wait();
  }
  StudioPage(const StudioPage&) = delete;
  StudioPage& operator=(const StudioPage&) = delete;

  std::string host() const { return "127.0.0.1:" + std::to_string(machine.studio_endpoint()->port); }
  std::string url() const { return "http://" + host() + "/"; }
  HttpAnswer get(const std::string& path) const {
    return StudioConnection(machine.studio_endpoint()->port).get(path);
  }
  bool is_live() { return browser.wait_for(kHasRows); }
  Json drawn() { return browser.evaluate(kDrawn); }
  /// A panel of those that lie behind each other.
  void open_tab(const std::string& name) { browser.click("[data-tab='" + name + "']"); }
  /// Arms the trigger for what does not happen and has it catch what is now: "shot-1" of the traces.
  void catch_a_shot() {
    open_tab("Trigger");
    browser.choose(".trigger input[list]", "Knife.Position");
    browser.choose(".trigger [aria-label=Level]", "1000");
    browser.click("button[title='Wait for this']");
    ASSERT_TRUE(browser.wait_for("document.querySelector('.trigger-state').textContent === 'armed'"))
        << browser.text(".trigger-state");
    browser.click("button[title='Catch what is now']");
    open_tab("Traces");
    ASSERT_TRUE(browser.wait_for("document.querySelector('[data-shot=shot-1]')"))
        << browser.text(".trigger-state");
  }
  /// The picture stands.
  bool stop() {
    browser.press(" ");
    if (!browser.wait_for("document.querySelector('.live[aria-pressed=true]')")) return false;
    // What stands is drawn, with ranges that fit it.
    browser.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
    return true;
  }
  /// Where a share of a diagram's plot lies. @param diagram from 0
  double x(double share, std::size_t diagram = 0) {
    const Json at = box(diagram);
    return at["x"].get<double>() + 72 + share * (at["w"].get<double>() - 132);
  }
  double y(double share, std::size_t diagram = 0) {
    const Json at = box(diagram);
    return at["y"].get<double>() + share * at["h"].get<double>();
  }
  void expect_quiet() const { test::expect_quiet(browser, host()); }

  Runtime machine;
  Browser browser;

 private:
  Json box(std::size_t diagram) {
    return browser.evaluate(
        "(() => { const r = document.querySelectorAll('.plot')[" + std::to_string(diagram) +
        "].getBoundingClientRect(); return {x: r.x, y: r.y, w: r.width, h: r.height}; })()");
  }
};

}  // namespace lockstep::test
