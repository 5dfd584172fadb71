/// A run of LinMot on PROFIBUS, led by its words.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep {

struct Bus : LinMotRun {
  using LinMotRun::LinMotRun;
  void out(int word, int value) { write("C.ProfibusOut[" + std::to_string(word) + "]", value & 0xFFFF); }
  int in(int word) { return static_cast<int>(read("C.ProfibusIn[" + std::to_string(word) + "]")); }
  void into_run() {
    step();
    out(1, 0x0008);
    run(0.01);
    out(1, 0x0002);
    run(0.01);
    ASSERT_EQ(state(), linmot::State::run);
  }
};

}  // namespace lockstep
