#include "projects/loader/cam_calls.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "projects/expressions/constant.hpp"
#include "tech_objects/cam_object/cam.hpp"

namespace lockstep {
namespace {

constexpr DINT kAtTheEnd = 5;         // SyncProfileReference: takes over at the end of the cam before
constexpr double kRounding = 1.0e-6;  // share of the slopes that is no difference

/// Slopes of the scaled cam where it is entered and where it is left, the leading value going up.
struct Slopes {
  double first, last;
};
Slopes slopes_of(const MC_CamIn& block) {
  const CamFunction& cam = block.Cam->function();
  const double scale = block.SlaveScaling / block.MasterScaling;
  const double start = cam.piece_value(0, cam.start_leading_value()).first * scale;
  const double end = cam.piece_value(cam.piece_count() - 1, cam.end_leading_value()).first * scale;
  return block.MasterScaling < 0.0 ? Slopes{end, start} : Slopes{start, end};
}

bool has_curve(const MC_CamIn& block) {
  return block.Slave != nullptr && block.Cam != nullptr && block.Cam->interpolated() &&
         block.MasterScaling != 0.0;
}

}  // namespace

void CamCalls::warn_of_exchanges(Problems& problems) const {
  for (const Call& next : calls_) {
    if (next.block->SyncProfileReference != kAtTheEnd || !has_curve(*next.block)) continue;
    for (const Call& before : calls_) {
      if (&before == &next || before.block->Slave != next.block->Slave || !has_curve(*before.block) ||
          before.block->Cam == next.block->Cam)
        continue;
      const double left = slopes_of(*before.block).last, taken = slopes_of(*next.block).first;
      if (std::abs(left - taken) <= kRounding * std::max({std::abs(left), std::abs(taken), 1.0e-3})) continue;
      problems.warn(*next.in->find("SyncProfileReference"),
                    "'" + next.block->Cam->name + "' begins with a slope of " +
                        value_text({.r = taken}, Type::LREAL) + " where '" + before.block->Cam->name +
                        "' ends with one of " + value_text({.r = left}, Type::LREAL) +
                        ": where it takes over, the velocity of the following axis steps");
      break;
    }
  }
}

}  // namespace lockstep
