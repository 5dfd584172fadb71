// A LinMot controller by itself, without a project: every sequence of requests and causes, every command in
// every state, bytes and words by chance, against models of their own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tech_objects/linmot/ascii_line.hpp"
#include "tech_objects/linmot/controller.hpp"
#include "tests/support/property.hpp"

namespace lockstep::linmot_controller_test {
namespace {

using linmot::AsciiCommand;
using linmot::AsciiForm;
using linmot::CommandInterface;
using linmot::State;

constexpr DINT kLinear = 3;  // LinMot P0x-37

/// A controller whose requests are inputs, and whose motor A is there.
struct Machine {
  bool run = false, init = false, freeze = false, stop = false, missing = false, hot = false;
  std::unique_ptr<LinMotController> controller = std::make_unique<LinMotController>("C", DB_ANY{1});
  linmot::AsciiLine line;
  std::int64_t now = 0;

  explicit Machine(CommandInterface interface, bool by_inputs) {
    LinMotController& c = *controller;
    c.control_cycle = 1e-3;
    c.data.Parameters.command_interface = static_cast<DINT>(interface);
    c.data.Motors[0].Parameters.type = kLinear;
    if (by_inputs) {
      c.data.Parameters.run_input = c.data.Parameters.init_input = true;
      c.data.Parameters.freeze_input = c.data.Parameters.emerg_stop_input = true;
    }
    c.wiring.run = &run;
    c.wiring.init = &init;
    c.wiring.freeze = &freeze;
    c.wiring.stop = &stop;
    c.motor_settings[0].slider_missing = &missing;
    c.motor_settings[0].too_hot = &hot;
    line.controllers[0] = &c;
  }
  void begin() { controller->configure(1e-3, 1); }
  void tick() {
    controller->servo(now);
    now += 1'000'000;
  }
  std::string send(std::string_view text) {
    return linmot::ascii_text(line.carry_out(linmot::read_ascii(text)));
  }
};

// ---- Requests and causes

/// What the operating states are to be, from the words of the table: homing by Actual Position takes no time.
struct StateModel {
  State state = State::disable;
  bool homed = false, error = false;

  void tick(bool run, bool init, bool stop, bool missing, bool hot) {
    const bool clear = !run && !init && !stop, cause = missing || hot;
    switch (state) {
      case State::error:
        if (clear && !cause_before) {
          state = State::disable;
          error = false;
        }
        break;
      case State::stop:
      case State::wait_for_disable:
        if (clear) state = State::disable;
        break;
      case State::disable:
        if (!stop && init) {
          state = State::init;
          homed = true;
        } else if (!stop && run && homed) {
          state = State::run;
        }
        break;
      case State::init:
        if (stop)
          state = State::stop;
        else if (run && !init)
          state = homed ? State::run : state;
        else if (clear)
          state = State::disable;
        break;
      case State::run:
        if (stop)
          state = State::stop;
        else if (!run)
          state = State::disable;
        break;
    }
    if (missing) homed = false;
    cause_before = cause;
    if (cause) {
      error = true;
      state = State::error;
    }
  }
  bool cause_before = false;
};

/// Six bits a step: the four requests, and two causes of errors.
void follow_sequence(const std::array<int, 3>& steps) {
  Machine machine(CommandInterface::mt, true);
  machine.begin();
  StateModel model;
  for (const int bits : steps) {
    const auto has = [bits](int bit) { return (bits >> bit & 1) != 0; };
    machine.run = has(0);
    machine.init = has(1);
    machine.stop = has(2);
    machine.freeze = has(3);
    machine.missing = has(4);
    machine.hot = has(5);
    machine.tick();
    model.tick(has(0), has(1), has(2), has(4), has(5));
    ASSERT_EQ(machine.controller->state(), model.state) << steps[0] << " " << steps[1] << " " << steps[2];
    ASSERT_EQ(machine.controller->data.Motors[0].InitDone, model.homed)
        << steps[0] << " " << steps[1] << " " << steps[2];
  }
}

// All of them in a soak, otherwise each hundredth or so.
TEST(LinMotControllerProperty, FollowsEverySequenceOfRequestsAndCauses) {
  constexpr int kChoices = 64;
  const auto first = static_cast<int>(test::seed_of_test(7) % 97);
  const int stride = test::cases(97, 1);
  int sequences = 0;
  for (int i = stride == 1 ? 0 : first; i < kChoices * kChoices * kChoices; i += stride, ++sequences)
    follow_sequence({i % kChoices, i / kChoices % kChoices, i / kChoices / kChoices});
  EXPECT_GT(sequences, 2000);
}

// What has a heat sink to look at is always awake.
TEST(LinMotControllerProperty, ShowsWithoutMotorsAsleepWhatItShowsAwake) {
  std::mt19937_64 random(test::seed_of_test(17));
  const auto chance = [&random](unsigned of) { return random() % of == 0; };
  int changes = 0, refusals = 0;
  for (int round = 0; round < test::cases(200, 20'000); ++round) {
    const bool by_inputs = chance(2), cool = false;
    Machine sleeps(CommandInterface::ascii_rs232, by_inputs), wakes(CommandInterface::ascii_rs232, by_inputs);
    wakes.controller->wiring.heat_sink_hot = &cool;
    const bool automatic = chance(2);
    for (Machine* const machine : {&sleeps, &wakes}) {
      machine->controller->data.Motors[0].Parameters.type = linmot::kNoDrive;
      machine->controller->data.Parameters.auto_start = automatic;
      machine->begin();
    }
    const auto toggle = [&](bool Machine::*input) {
      if (chance(20)) sleeps.*input = wakes.*input = !(sleeps.*input);
    };
    for (int tick = 0; tick < 300; ++tick) {
      for (bool Machine::*const input : {&Machine::run, &Machine::init, &Machine::stop, &Machine::freeze})
        toggle(input);
      const char* const kTexts[] = {"!SR+1", "!SR-1", "!SI+1", "!SI-1", "!SS+1", "!SS-1", "!SF+1", "!SF-1"};
      if (chance(10)) {
        const char* const text = kTexts[random() % 8];
        const std::string answer = sleeps.send(text);
        ASSERT_EQ(answer, wakes.send(text)) << text;
        refusals += answer != "#" ? 1 : 0;
      }
      if (tick == 290) {
        sleeps.controller->shut_down();
        wakes.controller->shut_down();
      }
      const State before = sleeps.controller->state();
      sleeps.tick();
      wakes.tick();
      const LinMotData &one = sleeps.controller->data, &other = wakes.controller->data;
      ASSERT_EQ(one.State, other.State) << round << ", " << tick;
      ASSERT_EQ(one.Errors, other.Errors);
      ASSERT_EQ(one.Warnings, other.Warnings);
      ASSERT_EQ(one.LoggedWarnings, other.LoggedWarnings);
      ASSERT_EQ(sleeps.controller->flags(), wakes.controller->flags());
      ASSERT_EQ(sleeps.controller->state_bits(), wakes.controller->state_bits());
      changes += sleeps.controller->state() != before ? 1 : 0;
    }
  }
  EXPECT_GT(changes, 1000);
  EXPECT_GT(refusals, 100);
}

// ---- ASCII

/// Brings a machine into a state by flags of the line.
void bring_into(Machine& machine, State state) {
  const auto send = [&machine](std::string_view text) {
    EXPECT_EQ(machine.send(text), "#") << text;
    machine.tick();
  };
  machine.tick();
  if (state == State::wait_for_disable) return;
  send("!SR-1");
  send("!SI-1");
  if (state == State::disable) return;
  if (state == State::error) machine.hot = true;
  if (state == State::init) machine.controller->data.Motors[0].Parameters.init_mode = 0;
  send("!SI+1");
  if (state == State::init || state == State::error) return;
  send("!SR+1");
  send("!SI-1");
  if (state == State::stop) send("!SS+1");
}

/// The code with which a command is to be refused that is well-formed, with a number of its range; 0: it is
/// not.
int expected_refusal(const AsciiCommand& command, State state, bool is_there, bool is_serial,
                     bool has_curve) {
  const bool of_motor = command.form == AsciiForm::drive || command.form == AsciiForm::number_drive;
  if (of_motor && !is_there) return 57;
  if (command.is(AsciiCommand::kMotion) && !is_serial) return 66;
  if (command.is(AsciiCommand::kInRun) && state != State::run)
    return state == State::disable ? 51 : state == State::init ? 52 : state == State::error ? 53 : 50;
  const bool curve = command.is(AsciiCommand::kMotion) && command.highest == 63;
  if (curve && !has_curve) return 62;
  // The memory begins with a parameter that nobody writes.
  return command.name == "WR" || command.name == "WS" ? 64 : 0;
}

void expect_answer(Machine& machine, const AsciiCommand& command, const std::string& text, int refusal) {
  const std::string answer = machine.send(text);
  ASSERT_FALSE(answer.empty());
  ASSERT_EQ(answer[0], '#');
  if (refusal != 0) {
    EXPECT_EQ(answer, "#E" + std::to_string(refusal)) << text;
  } else if (command.is(AsciiCommand::kReads)) {
    EXPECT_GT(answer.size(), 1u) << text;
  } else {
    EXPECT_EQ(answer, "#") << text;
  }
}

std::string text_of(const AsciiCommand& command, std::int64_t number) {
  std::string text = "!" + std::string(command.name);
  if (command.form == AsciiForm::number_drive) text += std::to_string(number);
  if (command.form == AsciiForm::sign_controller || command.form == AsciiForm::sign_any) text += "+";
  const bool of_motor = command.form == AsciiForm::drive || command.form == AsciiForm::number_drive;
  return text + (of_motor ? "A" : "1");
}

TEST(LinMotAscii, AnswersEveryCommandInEveryStateOfEveryType) {
  constexpr State kStates[] = {
      State::wait_for_disable, State::disable, State::init, State::run, State::stop, State::error};
  int asked = 0;
  for (const State state : kStates)
    for (const bool is_there : {true, false})
      for (DINT mode = 0; mode < 5; ++mode)
        for (const AsciiCommand& command : linmot::ascii_commands()) {
          Machine machine(CommandInterface::ascii_rs232, false);
          LinMotController& controller = *machine.controller;
          controller.data.Motors[0].Parameters.run_mode = mode;
          if (!is_there) {
            controller.data.Motors[1].Parameters.type = kLinear;
            controller.data.Motors[0].Parameters.type = linmot::kNoDrive;
            controller.motor_settings[1].too_hot = &machine.hot;
          }
          machine.begin();
          bring_into(machine, state);
          ASSERT_EQ(controller.state(), state);
          const std::int64_t number = command.lowest > 0 ? command.lowest : 0;
          expect_answer(machine, command, text_of(command, number),
                        expected_refusal(command, state, is_there, mode == 0, true));
          ++asked;
        }
  EXPECT_EQ(asked, 6 * 2 * 5 * 70);
}

TEST(LinMotAscii, KeepsToTheRangeOfEveryCommand) {
  for (const AsciiCommand& command : linmot::ascii_commands()) {
    if (command.form != AsciiForm::number_drive) continue;
    Machine machine(CommandInterface::ascii_rs232, false);
    machine.begin();
    bring_into(machine, State::run);
    expect_answer(machine, command, text_of(command, command.highest + std::int64_t{1}), 64);
    if (command.lowest < 0)
      expect_answer(machine, command, text_of(command, command.lowest - std::int64_t{1}), 64);
    if (command.lowest > 0) expect_answer(machine, command, text_of(command, 0), 64);
    const bool curve = command.is(AsciiCommand::kMotion) && command.highest == 63;
    if (curve) expect_answer(machine, command, text_of(command, 5), 62);
  }
}

// Bytes of any kind: what ends with CR is one command, and has one answer.
TEST(LinMotAsciiProperty, AnswersWhateverBytesComeOnce) {
  std::mt19937_64 random(test::seed_of_test(11));
  Machine machine(CommandInterface::ascii_rs232, false);
  machine.begin();
  const std::string letters = "!#ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-";
  std::string text;
  std::int64_t answers = 0, commands = 0, bytes = 0;
  const std::int64_t count = test::cases(100'000, 10'000'000);
  const auto pick = [&random](std::size_t below) { return static_cast<std::size_t>(random() % below); };
  for (; bytes < count; ++bytes) {
    const bool wild = pick(8) == 0;
    const bool begins = text.empty() && pick(4) != 0;
    char byte = wild ? static_cast<char>(pick(256)) : letters[pick(letters.size())];
    if (begins) {
      text = "!" + std::string(linmot::ascii_commands()[pick(70)].name);
      continue;
    }
    if (pick(6) == 0) byte = '\r';
    if (byte != '\r') {
      if (text.size() < 64) text += byte;
      continue;
    }
    ++commands;
    const std::string answer = machine.send(text);
    text.clear();
    ASSERT_FALSE(answer.empty());
    ASSERT_EQ(answer.find('#'), 0u);
    ASSERT_EQ(answer.rfind('#'), 0u);
    ++answers;
    machine.tick();
    ASSERT_TRUE(std::isfinite(machine.controller->data.Motors[0].SetPoint));
  }
  EXPECT_EQ(answers, commands);
  EXPECT_GT(commands, count / 40);
}

// ---- PROFIBUS

/// The image of one motor with every module.
void use_all_modules(LinMotController& controller) {
  linmot::ProcessImageLayout& image = controller.image;
  const auto add = [&image](const linmot::ModuleRow& row) {
    image.places.push_back({row.module, 0, image.out_words, image.in_words});
    image.out_words = static_cast<std::uint8_t>(image.out_words + row.out_words);
    image.in_words = static_cast<std::uint8_t>(image.in_words + row.in_words);
  };
  add(*linmot::find_module("Control/Status"));
  for (const linmot::ModuleRow& row : linmot::modules())
    if (row.module != linmot::Module::control_status && row.module != linmot::Module::next_drive) add(row);
}

TEST(LinMotProfibusProperty, BearsWordsOfAnyKind) {
  std::mt19937_64 random(test::seed_of_test(13));
  Machine machine(CommandInterface::profibus, false);
  LinMotController& controller = *machine.controller;
  use_all_modules(controller);
  linmot::CurvePart part;
  part.end = 30.0;
  part.time = 0.05;
  ASSERT_TRUE(controller.curves[1].make({&part, 1}));
  machine.begin();
  const auto chance = [&random](int of) { return random() % static_cast<unsigned>(of) == 0; };
  int errors = 0, runs = 0;
  for (int i = 0; i < test::cases(20'000, 2'000'000); ++i) {
    // The control word leads to RUN for a while, and now and then is anything; so are the other words.
    constexpr std::uint16_t kWay[] = {0x0000, 0x0008, 0x0002, 0x0002, 0x0002, 0x0002};
    controller.data.ProfibusOut[0] =
        WORD{chance(50) ? static_cast<std::uint16_t>(random()) : kWay[i / 10 % 6]};
    for (std::size_t word = 1; word < controller.image.out_words; ++word)
      if (chance(10))
        controller.data.ProfibusOut[word] =
            WORD{static_cast<std::uint16_t>(chance(20) ? random() : 1 + random() % 200)};
    machine.tick();
    runs += controller.state() == State::run ? 1 : 0;
    const std::uint16_t of_motor = controller.motor_errors(0), of_system = controller.system_errors();
    ASSERT_EQ(of_motor & ~linmot::motor_bit::kCurve, 0) << i;
    ASSERT_EQ(of_system & ~linmot::system_bit::kApplication, 0) << i;
    errors += controller.state() == State::error ? 1 : 0;
    if (controller.state() == State::error) {
      ASSERT_NE(of_motor | of_system, 0) << i;
    }
    const LinMotMotorData& motor = controller.data.Motors[0];
    ASSERT_TRUE(std::isfinite(motor.SetPoint) && std::isfinite(motor.DemandPosition)) << i;
    // Now and then the words are as they should be, so that ERROR is left.
    if (chance(20))
      for (std::size_t word = 0; word < controller.image.out_words; ++word)
        controller.data.ProfibusOut[word] = WORD{static_cast<std::uint16_t>(word == 0 ? 0 : 1)};
  }
  EXPECT_GT(errors, 100);
  EXPECT_GT(runs, 100);
}

}  // namespace
}  // namespace lockstep::linmot_controller_test
