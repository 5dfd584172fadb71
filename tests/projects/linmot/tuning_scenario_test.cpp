// The tuning tool: what a load takes.
#include "tech_objects/linmot/tuning.hpp"
#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_tuning_scenario_test {
namespace {

TEST(LinMotScenario, L16CalculatesWhatALoadTakes) {
  const ScenarioList expect = expectations("L16");
  linmot::TuningInput input{
      .force_constant = 40.0, .slider_mass = 0.829, .load_mass = 1.2, .friction = 10.0, .inclination = 90.0};
  const linmot::TuningResult first = linmot::tune(input);
  const double tolerance = expect[0].at("tolerance");
  EXPECT_NEAR(first.ff_friction, expect[0].at("value")[0].get<double>(), tolerance);
  EXPECT_NEAR(first.ff_acceleration, expect[0].at("value")[1].get<double>(), tolerance);
  EXPECT_NEAR(first.ff_acceleration, expect[0].at("value")[2].get<double>(), tolerance);  // and deceleration
  EXPECT_NEAR(first.current_offset, expect[0].at("value")[3].get<double>(), tolerance);
  input.force_constant = 40.8;
  input.friction = 0.0;
  const linmot::TuningResult second = linmot::tune(input);
  EXPECT_NEAR(second.ff_acceleration, expect[1].at("value")[0].get<double>(), 0.001);
  EXPECT_NEAR(second.current_offset, expect[1].at("value")[1].get<double>(), 0.001);
  input.motors = 2;
  EXPECT_NEAR(linmot::tune(input).mass, expect[2].at("value").get<double>(), 1e-12);
}

}  // namespace
}  // namespace lockstep::linmot_tuning_scenario_test
