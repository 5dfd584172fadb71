// Control and status words, the state machine of a drive, and the telegrams as words.
#include "tech_objects/drive/profidrive.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lockstep::profidrive_test {
namespace {

using State = DriveStates::State;

TEST(DriveStates, GoFromReadyToOperationAndBack) {
  DriveStates drive;
  EXPECT_EQ(drive.state(), State::ready);
  EXPECT_EQ(drive.zsw1() & 0x7F, 0x31);  // ready to switch on, no OFF2, no OFF3
  drive.control(kControlOn);
  EXPECT_EQ(drive.state(), State::operation);
  EXPECT_EQ(drive.zsw1() & 0x7F, 0x37);
  drive.control(kControlOff);
  EXPECT_EQ(drive.state(), State::ramp_stop);
  EXPECT_TRUE(drive.pulses());
  EXPECT_FALSE(bit_of(drive.zsw1(), zsw1::kOperationEnabled));
  drive.stopped();
  EXPECT_EQ(drive.state(), State::ready);
}

TEST(DriveStates, WaitForTheEnablingOfThePulses) {
  DriveStates drive;
  drive.control(kControlOn & ~bit_mask(stw1::kEnableOperation));
  EXPECT_EQ(drive.state(), State::switched_on);
  EXPECT_FALSE(drive.pulses());
  drive.control(kControlOn);
  EXPECT_EQ(drive.state(), State::operation);
}

TEST(DriveStates, TakeAnOFF1BackButNotAnOFF3) {
  DriveStates drive;
  drive.control(kControlOn);
  drive.control(kControlOff);
  drive.control(kControlOn);
  EXPECT_EQ(drive.state(), State::operation);
  drive.control(kControlQuickStop);
  drive.control(kControlOn);
  EXPECT_EQ(drive.state(), State::quick_stop);
  drive.stopped();
  EXPECT_EQ(drive.state(), State::inhibited);
}

TEST(DriveStates, LoseTheirPulsesAtOnceWithOFF2) {
  DriveStates drive;
  drive.control(kControlOn);
  drive.control(kControlCoast);
  EXPECT_EQ(drive.state(), State::inhibited);
  EXPECT_FALSE(drive.pulses());
  EXPECT_TRUE(bit_of(drive.zsw1(), zsw1::kSwitchingOnInhibited));
  EXPECT_FALSE(bit_of(drive.zsw1(), zsw1::kNoCoastStop));
  drive.control(kControlOn);
  EXPECT_EQ(drive.state(), State::inhibited) << "it has to be told OFF1 before";
  drive.control(kControlOff);
  EXPECT_EQ(drive.state(), State::ready);
}

TEST(DriveStates, KeepAFaultUntilItsCauseIsGoneAndItIsAcknowledgedByARisingEdge) {
  DriveStates drive;
  drive.control(kControlOn);
  drive.hold_fault(true);
  drive.fail(false);
  EXPECT_EQ(drive.state(), State::inhibited);
  EXPECT_TRUE(bit_of(drive.zsw1(), zsw1::kFaultPresent));
  constexpr std::uint16_t kAcknowledge = kControlOff | bit_mask(stw1::kAcknowledgeFault);
  drive.control(kAcknowledge);
  EXPECT_TRUE(drive.fault());
  drive.hold_fault(false);
  drive.control(kAcknowledge);
  EXPECT_TRUE(drive.fault()) << "no edge";
  drive.control(kControlOff);
  drive.control(kAcknowledge);
  EXPECT_FALSE(drive.fault());
  EXPECT_EQ(drive.state(), State::ready);
}

TEST(DriveStates, StopByThemselvesAtAFaultThatAsksForIt) {
  DriveStates drive;
  drive.control(kControlOn);
  drive.fail(true);
  EXPECT_EQ(drive.state(), State::quick_stop);
  drive.control(kControlOn);
  EXPECT_EQ(drive.state(), State::quick_stop);
  drive.stopped();
  EXPECT_EQ(drive.state(), State::inhibited);
}

TEST(DriveStates, DoNotHearWordsThatAreNotValid) {
  DriveStates drive;
  drive.control(kControlOn);
  drive.control(0x0000);
  EXPECT_EQ(drive.state(), State::operation);
}

constexpr TelegramSetpoint kSetpoint{.stw1 = 0x047F,
                                     .nsoll_b = -123456789,
                                     .stw2 = 0xA123,
                                     .momred = 0x1234,
                                     .g1_stw = 0x8001,
                                     .xerr = -2,
                                     .kpc = 0x00012345};
constexpr TelegramActual kActual{.zsw1 = 0x0237,
                                 .nist_b = 0x40000001,
                                 .zsw2 = 0xB456,
                                 .meldw = 0x0002,
                                 .g1_zsw = 0x2000,
                                 .g1_xist1 = 0xFFFF0001,
                                 .g1_xist2 = 0x00020003};

TEST(Telegrams, HaveTheHighWordFirst) {
  const Telegram3Actual words = pack_telegram_3(kActual);
  EXPECT_EQ(words[1], 0x4000);
  EXPECT_EQ(words[2], 0x0001);
  EXPECT_EQ(words[5], 0xFFFF);
  EXPECT_EQ(words[6], 0x0001);
  const Telegram105Setpoint setpoint = pack_telegram_105(kSetpoint);
  EXPECT_EQ(setpoint[0], 0x047F);
  EXPECT_EQ(setpoint[4], 0x1234) << "MOMRED is the fifth word";
  EXPECT_EQ(setpoint[6], 0xFFFF);
  EXPECT_EQ(setpoint[7], 0xFFFE);
  EXPECT_EQ(setpoint[8], 0x0001);
  EXPECT_EQ(setpoint[9], 0x2345);
}

TEST(Telegrams, ComeBackAsTheyWereSent) {
  EXPECT_EQ(unpack_telegram_105_setpoint(pack_telegram_105(kSetpoint)), kSetpoint);
  EXPECT_EQ(unpack_telegram_105_actual(pack_telegram_105(kActual)), kActual);
  TelegramSetpoint setpoint = kSetpoint;
  setpoint.momred = 0;
  setpoint.xerr = setpoint.kpc = 0;
  EXPECT_EQ(unpack_telegram(pack_telegram_3(kSetpoint)), setpoint) << "telegram 3 has no room for the rest";
  TelegramActual actual = kActual;
  actual.meldw = 0;
  EXPECT_EQ(unpack_telegram(pack_telegram_3(kActual)), actual);
}

TEST(Telegrams, NormaliseToTheReferenceAndCutAtTwiceOfIt) {
  EXPECT_EQ(normalised_32(3000.0, 3000.0), 0x40000000);
  EXPECT_EQ(normalised_32(-3000.0, 3000.0), -0x40000000);
  EXPECT_EQ(normalised_32(1e9, 3000.0), 0x7FFFFFFF);
  EXPECT_EQ(normalised_32(-1e9, 3000.0), -0x7FFFFFFF - 1);
  EXPECT_EQ(normalised_32(NAN, 3000.0), 0);
  EXPECT_EQ(normalised_16(5.0, 10.0), 0x2000);
  EXPECT_EQ(normalised_16(100.0, 10.0), 0x7FFF);
  for (double speed = -5000.0; speed < 5000.0; speed += 37.77) {
    EXPECT_NEAR(from_normalised_32(normalised_32(speed, 3000.0), 3000.0), speed, 3000.0 / 0x40000000);
    EXPECT_NEAR(from_normalised_16(normalised_16(speed, 3000.0), 3000.0), speed, 3000.0 / 0x4000);
  }
}

}  // namespace
}  // namespace lockstep::profidrive_test
