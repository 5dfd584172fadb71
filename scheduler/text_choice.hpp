/// Texts that are chosen at run time.
/// @source IEC 61131-3:2013, 6.6.2.5.6 (selection)
#pragma once

#include <vector>

#include "scheduler/expression.hpp"
#include "scheduler/text.hpp"

namespace lockstep {

/// What SEL and MUX do with texts.
struct TextChoice {
  Expression chooser;              ///< a BOOL, or a LINT from 0; below the first is taken, above the last one
  std::vector<TextSource> inputs;  ///< one at least

  const TextSource& chosen(EvaluationCounters& counters) const noexcept;
};

}  // namespace lockstep
