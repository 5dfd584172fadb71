/// A line as the controller sees it that serves it.
#pragma once

#include <cstdint>

namespace lockstep::linmot {

class Line {
 public:
  /// Carries out what is due, at the begin of a tick of the controller. The cycle's thread.
  /// @param now time of the tick [ns]
  virtual void step(std::int64_t now) noexcept = 0;

 protected:
  Line() = default;
  Line(const Line&) = default;
  Line& operator=(const Line&) = default;
  ~Line() = default;
};

}  // namespace lockstep::linmot
