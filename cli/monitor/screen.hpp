/// The terminal of the monitor, by ncurses.
#pragma once

#include <memory>
#include <vector>

#include "cli/monitor/keys.hpp"
#include "cli/monitor/view.hpp"

namespace lockstep::cli {

/// The terminal of standard input and output, in a state of its own; it is as before when this ends. Any one
/// thread; one at a time.
class Screen {
 public:
  /// @throws std::runtime_error for a terminal that ncurses does not know
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  ViewSize size() const;
  Characters characters() const noexcept { return characters_; }
  void show(const std::vector<ViewLine>& lines);
  /// The keys that have been pressed since the last call. @param ended the terminal is gone
  std::vector<Key> keys(bool& ended);

 private:
  struct State;
  std::unique_ptr<State> state_;
  Characters characters_ = Characters::ascii;
};

}  // namespace lockstep::cli
