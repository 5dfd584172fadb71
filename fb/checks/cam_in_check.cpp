#include "fb/checks/cam_in_check.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tech_objects/cam/motion.hpp"
#include "tech_objects/cam_design/design_check.hpp"
#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {
namespace {

constexpr DINT kAtTheEnd = 5;         // SyncProfileReference: takes over at the end of the cam before
constexpr double kRounding = 1.0e-6;  // share of the slopes that is no difference

const MC_CamIn& block_of(const WrittenCall& call) {
  return static_cast<const MC_CamIn&>(*call.block);
}

std::string number_text(double number) {
  char buffer[32];
  return {buffer, std::to_chars(std::begin(buffer), std::end(buffer), number).ptr};
}

bool has_curve(const MC_CamIn& block) {
  return block.Cam != nullptr && block.Cam->interpolated();
}

/// The ring of the following axis.
Modulo ring_of(TechnologyObject& axis) {
  const TO_Struct_Modulo& ring = static_cast<const AxisData*>(axis.data_block())->Modulo;
  return {ring.Enable, ring.Length, ring.StartValue};
}

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

/// Whether the slopes of a call are known.
bool has_slopes(const WrittenCall& call) {
  const MC_CamIn& block = block_of(call);
  return !call.computed("SyncProfileReference") && !call.computed("MasterScaling") &&
         !call.computed("SlaveScaling") && has_curve(block) && block.Slave != nullptr &&
         block.MasterScaling != 0.0;
}

bool agree(double a, double b) {
  return std::abs(a - b) <= kRounding * std::max({std::abs(a), std::abs(b), 1.0e-3});
}

/// The first call whose cam the one of `next` may take over from with another slope; nullptr: none.
const WrittenCall* stepped_from(const WrittenCall& next, std::span<const WrittenCall> calls) {
  const MC_CamIn& taken = block_of(next);
  for (const WrittenCall& before : calls) {
    const MC_CamIn& left = block_of(before);
    if (&before == &next || !has_slopes(before) || left.Slave != taken.Slave || left.Cam == taken.Cam)
      continue;
    if (!agree(slopes_of(left).last, slopes_of(taken).first)) return &before;
  }
  return nullptr;
}

}  // namespace

void check_cyclic_cam(const WrittenCall& call, CallWarnings& warnings) {
  const MC_CamIn& block = block_of(call);
  TechnologyObject* const slave = call.object("Slave");
  if (call.computed("ApplicationMode") || call.computed("SlaveScaling") || !has_curve(block) ||
      slave == nullptr || block.ApplicationMode != static_cast<DINT>(CamMode::cyclic))
    return;
  const CamFunction& cam = block.Cam->function();
  if (!CamFollowing::closes(cam, block.SlaveScaling, ring_of(*slave))) {
    warnings.push_back(
        {0, "ApplicationMode",
         "1 needs a cam that ends as it begins, and '" + block.Cam->name + "' begins with " +
             number_text(cam.start_following_value()) + " and ends with " +
             number_text(cam.end_following_value()) +
             "; the block will report error 16#80AC unless MC_InterpolateCam changes the cam before; "
             "allowed with this cam: 0, 2"});
    return;
  }
  for (const CamJoint& joint : joints_of(cam, true))
    if (joint.wrap && joint.keeps == Continuity::position)
      warnings.push_back({0, "ApplicationMode",
                          "with '" + block.Cam->name + "' " + step_text(joint) +
                              ": the following axis gets that step in each pass"});
}

void check_cam_exchanges(std::span<const WrittenCall> calls, CallWarnings& warnings) {
  for (const WrittenCall& next : calls) {
    if (!has_slopes(next) || block_of(next).SyncProfileReference != kAtTheEnd) continue;
    const WrittenCall* const before = stepped_from(next, calls);
    if (before == nullptr) continue;
    warnings.push_back({static_cast<std::size_t>(&next - calls.data()), "SyncProfileReference",
                        "'" + block_of(next).Cam->name + "' begins with a slope of " +
                            number_text(slopes_of(block_of(next)).first) + " where '" +
                            block_of(*before).Cam->name + "' ends with one of " +
                            number_text(slopes_of(block_of(*before)).last) +
                            ": where it takes over, the velocity of the following axis steps"});
  }
}

}  // namespace lockstep
