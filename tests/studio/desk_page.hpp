/// A studio at the desk, as `lockstep studio` serves it, and a browser that looks into it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "hmi_bridge/studio/server.hpp"
#include "projects/runtime/desk_run.hpp"
#include "tests/studio/page.hpp"

namespace lockstep::test {

class DeskPage {
 public:
  using Json = nlohmann::json;

  /// @param options without a file of a project: only traces
  explicit DeskPage(DeskOptions options, StudioServerOptions server_options = {})
      : handler(std::move(options)) {
    server_options.listen = {"127.0.0.1", 0};
    server_ = std::make_unique<StudioServer>(std::move(server_options), handler);
    EXPECT_EQ(server_->start(), "");
    browser.open(url());
  }
  ~DeskPage() { server_->stop(); }
  DeskPage(const DeskPage&) = delete;
  DeskPage& operator=(const DeskPage&) = delete;

  std::string host() const { return "127.0.0.1:" + std::to_string(server_->endpoint().port); }
  std::string url() const { return "http://" + host() + "/"; }
  bool is_greeted() { return browser.wait_for("/ page/.test(document.querySelector('.state').textContent)"); }
  void open_tab(const std::string& name) { browser.click("[data-tab='" + name + "']"); }
  /// As if files were dropped onto the window.
  void drop(const std::string& name, const std::string& content) {
    browser.evaluate("(() => { const data = new DataTransfer(); data.items.add(new File([" +
                     Json(content).dump() + "], " + Json(name).dump() +
                     ")); window.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, "
                     "cancelable: true })); })()");
  }
  void expect_quiet() const { test::expect_quiet(browser, host()); }

  DeskHandler handler;
  Browser browser;

 private:
  std::unique_ptr<StudioServer> server_;
};

}  // namespace lockstep::test
