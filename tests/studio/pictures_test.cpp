// The pictures of the page in STUDIO.md: LOCKSTEP_UPDATE=1 makes them anew from a run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "projects/runtime/runtime.hpp"
#include "tests/studio/browser.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::studio_pictures_test {
namespace {

const std::string kKnife = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";

/// Bytes of a text in base 64.
std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    value = value << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(value >> bits & 255u);
  }
  return bytes;
}

/// Width and height of a picture in PNG.
std::pair<unsigned, unsigned> size_of(const std::string& png) {
  const auto number = [&png](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(png.at(i));
    return value;
  };
  return {number(16), number(20)};
}

/// Looks whether the picture that is kept is one of a window as it is now, or makes it anew.
void hold(test::Browser& browser, const std::string& name) {
  const std::string png = decoded(browser.picture());
  ASSERT_EQ(png.substr(1, 3), "PNG");
  const std::string path = LOCKSTEP_SOURCE_DIR "/hmi_bridge/studio/" + name;
  if (std::getenv("LOCKSTEP_UPDATE") != nullptr) std::ofstream(path, std::ios::binary) << png;
  const std::string kept = test::content(path);
  ASSERT_GT(kept.size(), 10'000u) << path;
  EXPECT_EQ(size_of(kept), size_of(png)) << path;
}

TEST(StudioPictures, AreOfThePageAsItIs) {
  Runtime machine({.file = kKnife,
                   .stimuli = true,
                   .no_modbus = true,
                   .no_lcm = true,
                   .no_retain = true,
                   .studio = "127.0.0.1:0"});
  machine.start();
  test::Browser browser;
  browser.prefer_dark(false);
  browser.open("http://127.0.0.1:" + std::to_string(machine.studio_endpoint()->port) + "/");
  ASSERT_TRUE(browser.wait_for("parseFloat(document.querySelector('.clock').textContent) > 8"))
      << browser.text("body");
  browser.press(" ");
  browser.press("a");
  browser.press("b");
  for (int i = 0; i < 20; ++i) browser.press("ArrowRight", true);
  ASSERT_TRUE(
      browser.wait_for("[...document.querySelectorAll('.measure td')].every((cell) => cell.cellIndex < 6 || "
                       "cell.textContent !== '–')"));
  hold(browser, "scope.png");
  browser.press("Escape");
  browser.press("2");
  browser.choose(".diagnosis select", "Knife");
  ASSERT_TRUE(
      browser.wait_for("document.querySelectorAll('.bits li[data-value]').length > 20 && "
                       "document.querySelector('[data-path=\"Knife.StatusWord.X5\"]').dataset.value"));
  hold(browser, "axes.png");
  browser.press("1");
  browser.press(" ");
  browser.prefer_dark(true);
  ASSERT_TRUE(browser.wait_for(
      "[...document.querySelectorAll('.plot canvas')].every((canvas) => canvas.drawn.signals.length)"));
  hold(browser, "dark.png");
  machine.stop();
  EXPECT_TRUE(machine.wait());
}

}  // namespace
}  // namespace lockstep::studio_pictures_test
