/// A browser that a test looks with: Chromium without a window, led by its own protocol over two pipes.
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/directory.hpp"

namespace lockstep::test {

/// One window of 1280 × 720. What fails says so by std::runtime_error; every wait ends after a generous time.
class Browser {
 public:
  using Json = nlohmann::json;

  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::string& url);
  /// Value of an expression of JavaScript, a promise's when it is there.
  Json evaluate(const std::string& expression);
  /// Asks until the expression is true. @return whether it has become so
  bool wait_for(const std::string& expression);
  /// Text that a user sees in the first element that a selector finds.
  std::string text(const std::string& selector);

  void click(const std::string& selector);
  void drag(double from_x, double from_y, double to_x, double to_y);
  void turn_wheel(double x, double y, double by);
  /// A key as `KeyboardEvent.key` has it.
  void press(const std::string& key, bool shift = false);
  void type(const std::string& text);
  /// Chooses files in a field for files.
  void choose_file(const std::string& selector, const std::string& file);
  /// What a field has, or one of what a select offers, once it does; as if it had been chosen by hand.
  void choose(const std::string& selector, const std::string& value);
  /// Presses at a point and keeps it down, or lets go.
  void press_pointer(double x, double y);
  void move_pointer(double x, double y, bool is_down);
  void release_pointer(double x, double y);
  /// Where the middle of the first element is that a selector finds, which is brought into view.
  Json middle_of(const std::string& selector);
  /// As a system that prefers it has it.
  void prefer_dark(bool dark);
  /// All its processes stand still: connections stay open, nothing is said on them any more.
  void freeze() const;
  void thaw() const;
  /// All its processes are gone, without a word. Nothing else may be asked of it.
  void kill();
  /// A picture of the window, PNG.
  std::string picture();

  /// What the page has complained of: errors on the console, exceptions, refused scripts.
  const std::vector<std::string>& complaints() const { return complaints_; }
  /// Addresses of all requests.
  const std::vector<std::string>& requests() const { return requests_; }

  Json call(const std::string& method, const Json& parameters = Json::object());

 private:
  void start();
  void send(const std::string& text) const;
  Json receive();
  void note(const Json& event);

  Directory directory_;
  pid_t child_ = -1;
  int out_ = -1, in_ = -1;
  int number_ = 0;
  std::string session_, waiting_;
  std::vector<std::string> complaints_, requests_;
};

}  // namespace lockstep::test
