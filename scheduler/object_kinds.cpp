#include "scheduler/object_kinds.hpp"

#include <iterator>
#include <utility>

#include "scheduler/mco305/mco305.hpp"
#include "tech_objects/axis/axis.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"
#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "tech_objects/sensing/measuring_input.hpp"
#include "tech_objects/switching/cam_track.hpp"
#include "tech_objects/switching/output_cam.hpp"

namespace lockstep {
namespace {

using Made = std::unique_ptr<TechnologyObject>;

template <class Object>
Made make(ObjectKind kind, std::string name, DB_ANY number) {
  if constexpr (std::is_constructible_v<Object, ObjectKind, std::string, DB_ANY>)
    return std::make_unique<Object>(kind, std::move(name), number);
  else
    return std::make_unique<Object>(std::move(name), number);
}

struct Entry {
  ObjectKinds kinds;
  Made (*make)(ObjectKind, std::string, DB_ANY);
};

/// Every class of objects, a line each, in the order in which they take part in a phase.
constexpr Entry kClasses[] = {
    {kAnyCam, make<Cam>},
    {kAnyDrivenAxis, make<Axis>},
    {static_cast<ObjectKinds>(ObjectKind::TO_ExternalEncoder), make<ExternalEncoder>},
    {static_cast<ObjectKinds>(ObjectKind::TO_LeadingAxisProxy), make<LeadingAxisProxy>},
    {kMeasuringInput, make<MeasuringInput>},
    {kOutputCam, make<OutputCam>},
    {kCamTrack, make<CamTrack>},
    {static_cast<ObjectKinds>(ObjectKind::MCO_305), make<Mco305>},
    {static_cast<ObjectKinds>(ObjectKind::LinMot_Controller), make<LinMotController>},
};

}  // namespace

std::size_t index_in_phase(ObjectKind kind) noexcept {
  std::size_t index = 0;
  while (index < std::size(kClasses) && !among(kind, kClasses[index].kinds)) ++index;
  return index;
}

std::unique_ptr<TechnologyObject> make_object(ObjectKind kind, std::string name, DB_ANY number) {
  const std::size_t index = index_in_phase(kind);
  return index < std::size(kClasses) ? kClasses[index].make(kind, std::move(name), number) : nullptr;
}

}  // namespace lockstep
