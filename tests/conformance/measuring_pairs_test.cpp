// Every pair of the override table of measuring jobs (12.3.3), live, at each kind of object that is measured.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "fb/home.hpp"
#include "fb/measuring_input.hpp"
#include "fb/power.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "tech_objects/sensing/measuring_input.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::test::measuring_pairs_test {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kPairs = 30;

/// What is measured, and how.
struct Kind {
  const char* name;
  ObjectKind object;
  bool driven = false;
  bool absolute = false;     // its encoder, which modes 6 and 7 want
  bool by_telegram = false;  // which cannot measure cyclically
};
constexpr Kind kKinds[] = {
    {"a virtual axis", ObjectKind::TO_PositioningAxis},
    {"an axis with a drive", ObjectKind::TO_PositioningAxis, true},
    {"an axis with an absolute encoder", ObjectKind::TO_PositioningAxis, true, true},
    {"an axis with a drive, by its telegram", ObjectKind::TO_PositioningAxis, true, false, true},
    {"an axis with an absolute encoder, by its telegram", ObjectKind::TO_PositioningAxis, true, true, true},
    {"an external encoder", ObjectKind::TO_ExternalEncoder},
    {"an external encoder, by its telegram", ObjectKind::TO_ExternalEncoder, false, false, true},
};

/// An input at an object of some kind, on which a job measures that sees no edge.
class Scene : public Rig {
 public:
  Scene(const Kind& kind, const std::string& running_block) : kind_(kind) {
    continuity.assign(1, {false, false});
    LeadingObject& object = measured();
    input_ = &static_cast<MeasuringInput&>(controller.add_object(ObjectKind::TO_MeasuringInput, "Input"));
    input_->measured = &object;
    input_->data.Interface.Address = &level_;
    input_->data.Parameter.MeasuringInputType = kind.by_telegram ? 1 : 0;
    auto& power = block<MC_Power>();
    power.Axis = &object;
    power.Enable = true;
    home_ = &block<MC_Home>();
    home_->Axis = &object;
    running = &measuring(running_block);
    run(10);
    start(*running);
  }

  ExecuteBlock& new_job(const Json& pair) {
    const std::string name = pair.at("newJob");
    if (name != "MC_Home") return measuring(name);
    home_->Mode = pair.at("newMode").get<INT>();
    return *home_;
  }
  void start(ExecuteBlock& job) {
    job.Execute = true;
    run(3);
  }

  ExecuteBlock* running = nullptr;

 private:
  LeadingObject& measured() {
    if (kind_.object == ObjectKind::TO_ExternalEncoder) {
      auto& encoder = static_cast<ExternalEncoder&>(controller.add_object(kind_.object, "Encoder"));
      encoder.source_settings.signal = {&place_, Type::LREAL};
      encoder.source_settings.signals.zero_marks = ZeroMarks{1e6, 5e5};
      return encoder;
    }
    Axis& made = axis("Axis", [this](AxisData& data) {
      data.VirtualAxis.Mode = kind_.driven ? 0 : 1;
      data.Sensor[0].Type = kind_.absolute ? 1 : 0;
    });
    made.drive_settings.signals.zero_marks = ZeroMarks{1e6, 5e5};
    return made;
  }
  ExecuteBlock& measuring(const std::string& name) {
    if (name == "MC_MeasuringInput") return at_input<MC_MeasuringInput>();
    if (name == "MC_MeasuringInputCyclic") return at_input<MC_MeasuringInputCyclic>();
    EXPECT_EQ(name, "MC_AbortMeasuringInput");
    return at_input<MC_AbortMeasuringInput>();
  }
  template <class Block>
  ExecuteBlock& at_input() {
    auto& made = block<Block>();
    made.MeasuringInput = input_;
    return made;
  }

  const Kind& kind_;
  bool level_ = false;
  LREAL place_ = 0.0;  // of an external encoder
  MeasuringInput* input_ = nullptr;
  MC_Home* home_ = nullptr;
};

/// Which job cannot begin there, so that it ends none.
bool refused(const Json& pair, const Kind& kind) {
  if (pair.at("newMode").is_null()) return kind.by_telegram && pair.at("newJob") == "MC_MeasuringInputCyclic";
  const int mode = pair.at("newMode");
  if (kind.object == ObjectKind::TO_ExternalEncoder)
    return mode == 3 || mode == 5 || mode == 6 || mode == 7 || mode == 11 || mode == 12;
  return (mode == 6 || mode == 7) && !kind.absolute;
}

TEST(MeasuringPairs, EndAndGoOnAsTheTableSaysWhateverIsMeasured) {
  const Json file = Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/override.json"));
  std::size_t pairs = 0, scenes = 0;
  for (const Json& pair : file.at("pairs")) {
    if (pair.at("matrix") != "measuring_input") continue;
    ++pairs;
    std::size_t accepted = 0;
    for (const Kind& kind : kKinds) {
      const std::string running = pair.at("runningJob");
      if (kind.by_telegram && running == "MC_MeasuringInputCyclic") continue;
      SCOPED_TRACE("new " + pair.at("newJob").get<std::string>() + " " + pair.at("newMode").dump() +
                   " against " + running + " at " + kind.name);
      Scene scene(kind, running);
      ASSERT_TRUE(scene.running->Busy);
      ExecuteBlock& next = scene.new_job(pair);
      scene.start(next);
      ++scenes;
      const bool is_refused = refused(pair, kind);
      EXPECT_EQ(next.Error, is_refused);
      accepted += !is_refused;
      // A refused measuring job of the same input raises the alarm that ends what it does.
      if (is_refused && pair.at("newMode").is_null()) continue;
      const bool ends = pair.at("effect") == "aborts" && !is_refused;
      EXPECT_EQ(scene.running->CommandAborted, ends);
      EXPECT_EQ(scene.running->Busy, !ends);
      EXPECT_FALSE(scene.running->Error);
    }
    EXPECT_GT(accepted, 0u) << pair << ": accepted nowhere";
  }
  EXPECT_EQ(pairs, kPairs);
  std::printf("%zu pairs of measuring jobs tested, in %zu scenes\n", pairs, scenes);
}

}  // namespace
}  // namespace lockstep::test::measuring_pairs_test
