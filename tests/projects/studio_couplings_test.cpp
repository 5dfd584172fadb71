// What follows what, across controllers too, and by what a leading value is delayed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "projects/loader/simulation.hpp"
#include "projects/studio/couplings.hpp"
#include "projects/studio/project_text.hpp"
#include "tests/projects/crossing_project.hpp"

namespace lockstep::studio_couplings_test {
namespace {

using Json = nlohmann::json;

/// The coupling of a following object by a leading one; null: there is none.
Json between(const Json& all, const std::string& following, const std::string& leading) {
  for (const Json& one : all)
    if (one.at("following") == following && one.at("leading") == leading) return one;
  return {};
}

TEST(StudioCouplings, GoOverTransferAreasToOtherControllersAndFromThem) {
  const std::string text = test::crossing_project();
  Simulation simulation = Simulation::from_text(text);
  const Json all =
      Json::parse(studio_api::couplings_json(simulation.project(), StudioProjectText(text)).dump());
  const Json within = between(all, "Line", "Main");
  EXPECT_EQ(within.value("area", ""), "line") << all;
  EXPECT_FALSE(within.contains("remote"));
  const Json received = between(all, "Beyond", "Infeed.Conveyor");
  EXPECT_EQ(received.value("remote", ""), "leading") << all;
  EXPECT_EQ(received.value("area", ""), "belt");
  const Json sent = between(all, "proxies of out", "Main");
  EXPECT_EQ(sent.value("remote", ""), "following") << all;
  EXPECT_EQ(sent.value("area", ""), "out");
}

TEST(StudioCouplings, TellByWhatTheirLeadingValueIsDelayed) {
  const std::string text = test::crossing_project();
  Simulation simulation = Simulation::from_text(text);
  const Json all =
      Json::parse(studio_api::couplings_json(simulation.project(), StudioProjectText(text)).dump());
  const auto delay = [&](const std::string& following, const std::string& leading) {
    return between(all, following, leading).value("delay", "");
  };
  // Behind the delay of the leading object; the parameter of a proxy; without one where the setpoint is
  // taken.
  EXPECT_EQ(delay("Near", "Main"), "Main.CrossPlcSynchronousOperation.LocalLeadingValueDelayTime") << all;
  EXPECT_EQ(delay("Far", "Line"), "Line.Parameter.LocalLeadingValueDelayTime") << all;
  EXPECT_EQ(delay("Far", "Main"), "") << all;
  EXPECT_EQ(simulation.read(delay("Near", "Main")), 0.004) << "these are paths";
  EXPECT_EQ(simulation.read(delay("Far", "Line")), 0.002);
}

}  // namespace
}  // namespace lockstep::studio_couplings_test
