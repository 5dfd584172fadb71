// MC_SaveAbsoluteEncoderData in the cycle; what it asks for is answered by hand here.
#include <gtest/gtest.h>

#include "fb/save_encoder_data.hpp"
#include "scheduler/controller.hpp"

namespace lockstep::encoder_saving_test {
namespace {

struct Saving {
  explicit Saving(bool kept = true, int instances = 2) {
    controller.encoder_saving.kept = kept;
    for (int i = 0; i < instances; ++i) {
      Instance& made =
          controller.add_instance(*find_block_type("MC_SaveAbsoluteEncoderData"), "save" + std::to_string(i));
      blocks.push_back(static_cast<MC_SaveAbsoluteEncoderData*>(made.block.get()));
    }
    controller.finish();
  }
  void tick() {
    controller.tick();
    for (auto* block : blocks) block->call(controller.now());
  }
  void answer(WORD error = WORD{}) {
    controller.encoder_saving.answered = controller.encoder_saving.asked;
    controller.encoder_saving.error = error;
  }
  static bool refused(const MC_SaveAbsoluteEncoderData& block, int error) {
    return block.Error && block.ErrorID == static_cast<WORD>(error) && !block.Busy && !block.Done;
  }

  Controller controller;
  std::vector<MC_SaveAbsoluteEncoderData*> blocks;
};

TEST(MC_SaveAbsoluteEncoderData, IsBusyUntilItIsAnswered) {
  Saving rig;
  MC_SaveAbsoluteEncoderData& save = *rig.blocks[0];
  save.Execute = true;
  for (int i = 0; i < 100; ++i) {
    rig.tick();
    ASSERT_TRUE(save.Busy && !save.Done && !save.Error) << i;
  }
  EXPECT_EQ(rig.controller.encoder_saving.asked, 1u);
  rig.answer();
  rig.tick();
  EXPECT_TRUE(save.Done && !save.Busy && !save.Error);
  save.Execute = false;
  rig.tick();
  EXPECT_FALSE(save.Done);
}

TEST(MC_SaveAbsoluteEncoderData, TellsWhyItWasNotWritten) {
  Saving rig;
  MC_SaveAbsoluteEncoderData& save = *rig.blocks[0];
  save.Execute = true;
  rig.tick();
  rig.answer(static_cast<WORD>(0x80EB));
  rig.tick();
  EXPECT_TRUE(Saving::refused(save, 0x80EB));
  save.Execute = false;
  rig.tick();
  save.Execute = true;
  rig.tick();
  EXPECT_TRUE(save.Busy) << "the answer was that of another job";
  rig.answer();
  rig.tick();
  EXPECT_TRUE(save.Done);
}

TEST(MC_SaveAbsoluteEncoderData, HasOneJobAtATimeAlsoOfOneInstance) {
  Saving rig;
  MC_SaveAbsoluteEncoderData &first = *rig.blocks[0], &second = *rig.blocks[1];
  first.Execute = second.Execute = true;
  rig.tick();
  EXPECT_TRUE(first.Busy);
  EXPECT_TRUE(Saving::refused(second, 0x80EE));
  first.Execute = second.Execute = false;
  rig.tick();
  ASSERT_TRUE(first.Busy) << "a falling edge ends nothing";
  first.Execute = true;
  rig.tick();
  EXPECT_TRUE(Saving::refused(first, 0x80EE));
  rig.answer();
  rig.tick();
  second.Execute = true;
  rig.tick();
  EXPECT_TRUE(second.Busy);
}

TEST(MC_SaveAbsoluteEncoderData, HasTwoInstancesInAProject) {
  Saving rig(true, 3);
  for (auto* block : rig.blocks) block->Execute = true;
  rig.tick();
  EXPECT_TRUE(rig.blocks[0]->Busy);
  EXPECT_TRUE(Saving::refused(*rig.blocks[2], 0x80ED));
}

TEST(MC_SaveAbsoluteEncoderData, IsRefusedWhereNothingIsKept) {
  Saving rig(false);
  rig.blocks[0]->Execute = true;
  rig.tick();
  EXPECT_TRUE(Saving::refused(*rig.blocks[0], 0x80EF));
}

}  // namespace
}  // namespace lockstep::encoder_saving_test
