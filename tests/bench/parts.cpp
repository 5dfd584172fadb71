#include "bench/parts.hpp"

#include <fstream>
#include <memory>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "bench/machine.hpp"
#include "bench/measure.hpp"
#include "projects/expressions/compiler.hpp"
#include "projects/loader/project.hpp"
#include "tech_objects/cam/motion.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/cam_object/interpolation.hpp"
#include "tech_objects/profile/profile.hpp"
#include "tech_objects/synchronous/gear_function.hpp"

namespace lockstep::bench {
namespace {

using Row = std::vector<double>;

std::vector<Row> rows_of(const std::string& name) {
  std::ifstream file(std::string(LOCKSTEP_TEST_DATA) + "/" + name);
  std::vector<Row> rows;
  std::string line;
  for (bool header = true; std::getline(file, line);) {
    if (line.empty() || line.front() == '#' || std::exchange(header, false)) continue;
    std::istringstream cells(line);
    Row row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error("no test data in " + name);
  return rows;
}

PlanResult plan_any_state(const Row& r, Profile& profile) {
  return plan_position({r[0], r[1], r[2]}, r[3], r[4], {r[5], -r[5], r[6], r[6], r[7]}, profile);
}

PlanResult plan_unequal(const Row& r, Profile& profile) {
  return plan_position({r[0], 0.0, 0.0}, r[1], 0.0, {r[2], -r[2], r[3], r[4], r[5]}, profile);
}

PlanResult plan_change(const Row& r, Profile& profile) {
  constexpr double kNoLimit = 1e9;
  return plan_velocity({0.0, r[0], r[1]}, r[2], {kNoLimit, -kNoLimit, r[3], r[3], r[4]}, profile);
}

/// Plans the motions of a file one after the other.
Part planning(std::string name, const std::string& file, PlanResult (*plan)(const Row&, Profile&)) {
  auto rows = std::make_shared<std::vector<Row>>(rows_of(file));
  return {std::move(name),
          [rows, plan, next = std::size_t{0}](int calls) mutable {
            Profile profile;
            for (int i = 0; i < calls; ++i) {
              if (plan((*rows)[next], profile) != PlanResult::ok) throw std::runtime_error("not planned");
              keep(profile);
              next = (next + 1) % rows->size();
            }
          },
          static_cast<int>(rows->size())};
}

/// Evaluates the motions of a file at times spread over their duration.
Part evaluation(const std::string& file) {
  auto profiles = std::make_shared<std::vector<Profile>>();
  for (const Row& row : rows_of(file)) {
    Profile profile;
    if (plan_any_state(row, profile) == PlanResult::ok) profiles->push_back(profile);
  }
  return {"profile: state at a time",
          [profiles, next = std::size_t{0}, percent = 0](int calls) mutable {
            const Profile* const all = profiles->data();
            const std::size_t number = profiles->size();
            for (int i = 0; i < calls; ++i) {
              keep(all[next].at(all[next].duration() * 0.01 * percent));
              if (++next == number) next = 0;
              if (++percent > 100) percent = 0;
            }
          },
          100'000};
}

Part gear(std::string name, const Modulo& leading, const Modulo& following) {
  auto function = std::make_shared<GearFunction>();
  function->set(-7, 11, {0, 10.0}, {0, 20.0}, leading, following);
  return {std::move(name),
          [function, leading, place = AxisPosition{}](int calls) mutable {
            for (int i = 0; i < calls; ++i) {
              place = advanced(place, 0.314, leading);
              keep(function->value(place));
            }
          },
          100'000};
}

/// A definition of 10,000 points of cubic splines.
std::shared_ptr<CamData10k> long_definition() {
  auto made = std::make_shared<CamData10k>();
  CamData10k& data = *made;
  for (std::size_t i = 0; i < data.Point.size(); ++i) {
    const double x = 360.0 * static_cast<double>(i) / 9999.0;
    data.Point[i] = {x, x * (360.0 - x) / 400.0};
  }
  data.ValidPoint.fill(true);
  data.InterpolationSettings.InterpolationMode = 1;
  return made;
}

void interpolate(CamInterpolator& interpolator, const CamData10k& data, CamFunction& function) {
  if (interpolator.interpolate(elements_of(data), function) != ErrorId::none)
    throw std::runtime_error("no cam");
}

/// The cam, which is moved along, alone or applied to a pair of axes.
CamFunction long_cam() {
  CamFunction function(kCam10kPoints);
  CamInterpolator interpolator(kCam10kPoints);
  interpolate(interpolator, *long_definition(), function);
  return function;
}

Part cam_interpolation() {
  auto data = long_definition();
  auto function = std::make_shared<CamFunction>(kCam10kPoints);
  auto interpolator = std::make_shared<CamInterpolator>(kCam10kPoints);
  return {"cam of 10,000 points: interpolation by cubic splines",
          [data, function, interpolator](int calls) {
            for (int i = 0; i < calls; ++i) interpolate(*interpolator, *data, *function);
          },
          10};
}

Part cam_anywhere() {
  auto function = std::make_shared<CamFunction>(long_cam());
  auto places = std::make_shared<std::vector<double>>();
  std::minstd_rand random(1);
  for (int i = 0; i < 100'000; ++i)
    places->push_back(360.0 * static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()));
  return {"cam of 10,000 points: value and derivatives, anywhere",
          [function, places, hint = CamHint{}, next = std::size_t{0}](int calls) mutable {
            for (int i = 0; i < calls; ++i) {
              keep(function->value((*places)[next], hint));
              next = next + 1 < places->size() ? next + 1 : 0;
            }
          },
          100'000};
}

/// The part of MC_CopyCamData that one interpolator cycle carries out, with the rest of the cam's tick.
Part cam_copy() {
  auto cam = std::make_shared<Cam>(ObjectKind::TO_Cam_10k, "Cam", DB_ANY{1});
  auto data = long_definition();
  auto job = std::make_shared<Job>();
  auto points = std::make_shared<Array>(Array{&kCamPointElement, 1, 10000, data->Point.data()});
  return {"cam of 10,000 points: a cycle of MC_CopyCamData",
          [cam, data, job, points](int calls) {
            const CamCopy copy{.points = points.get(), .number_of_points = 10000};
            for (int i = 0; i < calls; ++i) {
              if (!cam->copying()) {
                *job = Job{};
                job->kind = JobKind::MC_CopyCamData;
                job->asks = CamCopyJob{.copy = &copy};
                cam->submit(*job);
              }
              cam->before_axes();
              cam->behind_axes();
            }
          },
          1000};
}

Part cam_curve() {
  auto function = std::make_shared<CamFunction>(long_cam());
  return {"cam of 10,000 points: value and derivatives, moving",
          [function, hint = CamHint{}, x = 0.0](int calls) mutable {
            for (int i = 0; i < calls; ++i) {
              x += 0.314;
              if (x >= 360.0) x -= 360.0;
              keep(function->value(x, hint));
            }
          },
          100'000};
}

Part cam_applied() {
  auto function = std::make_shared<CamFunction>(long_cam());
  auto cam = std::make_shared<CamFollowing>();
  const Modulo ring{true, 360.0, 0.0};
  cam->set(*function, {1.0, 0.5, CamMode::cyclic}, {}, {}, ring, {});
  return {"cam applied to axes: linear after modulo axis, and a step of the leading axis",
          [function, cam, ring, place = AxisPosition{}](int calls) mutable {
            for (int i = 0; i < calls; ++i) {
              place = advanced(place, 0.314, ring);
              keep(cam->value(place));
            }
          },
          100'000};
}

/// The names that the expressions use.
class Tags final : public Scope {
 public:
  Reference resolve(std::string_view name, std::string_view /*path*/) const override {
    if (name == "start") return {Signal{&start_, Type::BOOL, -1}, ""};
    if (name == "stop") return {Signal{&stop_, Type::BOOL, -1}, ""};
    return {Signal{&speed_, Type::LREAL, -1}, ""};
  }

 private:
  mutable bool start_ = true;
  mutable bool stop_ = false;
  mutable double speed_ = 120.0;
};

Part expression(std::string_view text, Type type) {
  auto tags = std::make_shared<Tags>();
  CompiledExpression compiled = compile_expression(text, type, *tags);
  if (!compiled.expression) throw std::runtime_error("not compiled: " + std::string(text));
  return {"expression: " + std::string(text),
          [tags, code = *compiled.expression, counters = EvaluationCounters{}](int calls) mutable {
            for (int i = 0; i < calls; ++i) keep(code.evaluate(counters));
          },
          100'000};
}

Part loading(int axes) {
  auto text = std::make_shared<std::string>(project_text({.motion = Motion::gear, .axes = axes}));
  return {
      "load a project of " + std::to_string(axes) + " axes (" + std::to_string(text->size() / 1024) + " KiB)",
      [text](int calls) {
        for (int i = 0; i < calls; ++i)
          if (!load_project(*text).project) throw std::runtime_error("not loaded");
      },
      1};
}

}  // namespace

std::vector<Part> parts(bool quick) {
  const Modulo line;
  const Modulo ring{true, 360.0, 0.0};
  return {planning("profile: plan from any state", "otg_position.csv", plan_any_state),
          planning("profile: plan from rest to rest", "otg_asymmetric.csv", plan_unequal),
          planning("profile: plan a change of velocity", "otg_velocity.csv", plan_change),
          evaluation("otg_position.csv"),
          gear("gear function: linear after linear axis, and a step of the leading axis", line, line),
          gear("gear function: modulo after modulo axis, and a step of the leading axis", ring, ring),
          cam_curve(),
          cam_anywhere(),
          cam_interpolation(),
          cam_copy(),
          cam_applied(),
          expression("start", Type::BOOL),
          expression("start AND NOT stop", Type::BOOL),
          expression("LIMIT(10.0, speed * 1.5 + 2.0, 500.0)", Type::LREAL),
          loading(quick ? 10 : 1000)};
}

}  // namespace lockstep::bench
