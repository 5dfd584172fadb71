// Parameters of any value, as SET takes them: nothing overflows, setpoints stay finite, and the device goes
// on.
#include <cmath>
#include <limits>
#include <random>

#include "tests/scheduler/mco305/device_run.hpp"
#include "tests/support/property.hpp"

namespace lockstep::hostile_parameters_test {
namespace {

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();

std::int32_t any_value(std::mt19937_64& random, const mco305::Parameter& of) {
  const std::int32_t values[] = {of.lowest,
                                 of.highest,
                                 of.start,
                                 0,
                                 1,
                                 -1,
                                 2,
                                 3,
                                 kLowest,
                                 kHighest,
                                 -kHighest,
                                 static_cast<std::int32_t>(random()),
                                 static_cast<std::int32_t>(random() % 2000)};
  std::int32_t value = values[random() % std::size(values)];
  if (random() % 4 == 0 && value < kHighest) ++value;
  if (random() % 4 == 0 && value > kLowest) --value;
  return value;
}

void ask_something(mco305::Device& device, std::mt19937_64& random) {
  const auto value = static_cast<std::int32_t>(random());
  const auto small = static_cast<std::int32_t>(random() % 20'000) - 10'000;
  switch (random() % 14) {
    case 0:
      device.position_to(value, false);
      break;
    case 1:
      device.position_to(small, true);
      break;
    case 2:
      device.set_speed(value);
      device.start_speed();
      break;
    case 3:
      device.stop_speed();
      break;
    case 4:
      device.set_velocity(random() % 2 == 0 ? value : small);
      break;
    case 5:
      device.set_acceleration(random() % 2 == 0 ? value : small);
      break;
    case 6:
      device.set_deceleration(random() % 2 == 0 ? value : small);
      break;
    case 7:
      device.begin_home(random() % 2 == 0);
      break;
    case 8:
      device.set_origin(value);
      break;
    case 9:
      device.define_origin();
      break;
    case 10:
      device.motor_stop();
      break;
    case 11:
      device.motor_off();
      device.set_reference(value);
      break;
    case 12:
      device.motor_on();
      break;
    default:
      device.go_on();
  }
}

void read_everything(const mco305::Device& device) {
  std::int32_t value = 0;
  for (const std::int32_t index :
       {1, 9, 17, 22, 4096, 4097, 4098, 4099, 4101, 4107, 4111, 4218, 4231, 4275, 4276, 4277})
    EXPECT_TRUE(device.system_variable(index, value)) << index;
  for (const mco305::Parameter& of : mco305::parameters())
    EXPECT_TRUE(device.get_parameter(of.number, value)) << of.number;
}

TEST(Mco305HostileParameters, LeaveSetpointsFiniteAndTheDeviceAlive) {
  test::for_each_seed(1, test::cases(400, 40'000), [](const test::Case& one) {
    std::mt19937_64 random(one.seed);
    DeviceRun run;
    run.object.settings.has_drive = random() % 2 == 0;
    const auto parameters = mco305::parameters();
    const auto set_one = [&] {
      const mco305::Parameter& of = parameters[random() % parameters.size()];
      run.object.device().set_parameter(of.number, any_value(random, of));
    };
    for (int i = 0; i < 20; ++i) set_one();
    run.begin();
    for (int i = 0; i < 500; ++i) {
      if (random() % 20 == 0) set_one();
      if (random() % 10 == 0) ask_something(run.object.device(), random);
      if (random() % 50 == 0) run.object.device().io().set_input(1 + random() % 12, random() % 2 == 0);
      run.step();
      run.object.device().clear_all_errors();
      ASSERT_TRUE(std::isfinite(run.object.device().set_position())) << i;
      ASSERT_TRUE(std::isfinite(run.object.device().set_velocity_now())) << i;
      ASSERT_LE(std::abs(run.object.data.Read.Reference), 1'048'575) << i;
    }
    read_everything(run.object.device());
  });
}

/// Each parameter alone, at its limits, beside and far outside: a positioning goes on, or has an error.
TEST(Mco305HostileParameters, EachAloneAtAndOutsideItsLimits) {
  for (const mco305::Parameter& of : mco305::parameters())
    for (const std::int32_t value :
         {of.lowest, of.lowest == kLowest ? kLowest : of.lowest - 1, of.highest,
          of.highest == kHighest ? kHighest : of.highest + 1, 0, kLowest, kHighest}) {
      DeviceRun run;
      const std::int32_t before = run.object.parameters()[of.number];
      const int refused = run.object.device().set_parameter(of.number, value);
      EXPECT_TRUE(refused == 0 || refused == 112) << of.number;
      EXPECT_EQ(run.object.parameters()[of.number], refused != 0 ? before : value) << of.number;
      run.add_program(
          "ON ERROR GOSUB e\nVEL 50\nACC 50\nDEC 50\nPOSA 1000\nPOSA 0\nSUBMAINPROG\nSUBPROG e\n"
          "n = ERRNO\nEXIT\nRETURN\nENDPROG\n");
      run.begin();
      for (int i = 0; i < 300; ++i) {
        run.step();
        ASSERT_TRUE(std::isfinite(run.object.device().set_position())) << of.number << " = " << value;
      }
    }
}

}  // namespace
}  // namespace lockstep::hostile_parameters_test
