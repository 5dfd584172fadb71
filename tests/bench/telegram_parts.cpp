// What telegrams of leading values cost a tick.
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/measure.hpp"
#include "bench/parts.hpp"
#include "projects/loader/project.hpp"
#include "scheduler/telegram_ring.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"

namespace lockstep::bench {
namespace {

constexpr std::int64_t kCycle = 1'000'000;  // [ns]
constexpr char kSource[] = R"({
  "lockstep": 1, "name": "source", "clock": { "servo_cycle": "1ms" },
  "technology_objects": {
    "Main": { "type": "TO_PositioningAxis",
              "config": { "VirtualAxis": { "Mode": 1 }, "Modulo": { "Enable": true, "Length": 360.0 },
                          "CrossPlcSynchronousOperation": { "LocalLeadingValueDelayTime": 0.008,
                                                            "Interface[1]": { "EnableLeadingValueOutput": true } } } } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Main", "Enable": true } },
    { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Main", "Execute": "power.Status", "Velocity": 100.0 } } ] } ]
})";

/// Ticks of a controller with one leading axis, that sends its value or provides none.
Part ticks(bool sends) {
  std::string text = kSource;
  const std::string enabled = "\"EnableLeadingValueOutput\": true";
  if (!sends) text.replace(text.find(enabled), enabled.size(), "\"EnableLeadingValueOutput\": false");
  auto loaded = std::make_shared<LoadedProject>(load_project(text));
  if (!loaded->project) throw std::runtime_error("no source of telegrams");
  auto ring = std::make_shared<TelegramRing>();
  Controller& controller = *loaded->project->controller;
  if (sends) controller.telegram_outputs.push_back({controller.axes[0], ring.get()});
  for (int i = 0; i < 5000; ++i) controller.tick();
  return {std::string("tick of a controller with one leading axis, ") +
              (sends ? "that sends its leading value" : "that provides none"),
          [loaded, ring, &controller](int calls) {
            for (int i = 0; i < calls; ++i) {
              controller.tick();
              ring->take([](const LeadingValueTelegram& one) { keep(one); });
            }
          },
          100'000};
}

/// A telegram is made and put, as a tick does for each transfer area; now and then the ring is emptied.
Part out() {
  auto loaded = std::make_shared<LoadedProject>(load_project(kSource));
  if (!loaded->project) throw std::runtime_error("no source of telegrams");
  for (int i = 0; i < 100; ++i) loaded->project->controller->tick();
  auto ring = std::make_shared<TelegramRing>();
  return {"telegram of a leading value: out, into its slot",
          [loaded, ring](int calls) {
            const LeadingObject& source = *loaded->project->controller->axes[0];
            for (int i = 0; i < calls; ++i) {
              LeadingValueTelegram telegram = source.telegram();
              telegram.time += i;
              if (!ring->put(telegram)) ring->take([](const LeadingValueTelegram& one) { keep(one); });
            }
          },
          100'000};
}

/// What a proxy and its tick know of a source that runs.
struct Line {
  Line() : proxy("Line", DB_ANY{1}) {
    proxy.configure(0.001, 1);
    telegram.cycle = kCycle;
    telegram.delay = 2 * kCycle;
    telegram.modulo = {true, 360.0, 0.0};
    telegram.value.velocity = 100.0;
    telegram.valid = telegram.position_led = true;
  }
  void send() {
    ++telegram.sequence;
    telegram.time += kCycle;
    telegram.value.position = advanced(telegram.value.position, 0.1, telegram.modulo);
    ring.put(telegram);
  }
  void take() {
    ring.take_while([this](const LeadingValueTelegram& one) {
      proxy.take(one, telegram.time);
      return true;
    });
  }

  LeadingAxisProxy proxy;
  TelegramRing ring;
  LeadingValueTelegram telegram{};
};

Part in() {
  auto line = std::make_shared<Line>();
  return {"telegram of a leading value: in, from its slot to a proxy",
          [line](int calls) {
            for (int i = 0; i < calls; ++i) {
              line->send();
              line->take();
            }
            keep(line->proxy);
          },
          100'000};
}

/// What comes in and what is given in a tick. @param phase of the receiver behind the source [ns]
Part led(std::int64_t phase) {
  auto line = std::make_shared<Line>();
  return {phase == 0 ? "telegram of a leading value: in, and the value of a proxy in this tick"
                     : "the same, between two telegrams",
          [line, phase](int calls) {
            for (int i = 0; i < calls; ++i) {
              line->send();
              line->take();
              line->proxy.servo(line->telegram.time + phase);
              line->proxy.before_axes();
            }
            keep(line->proxy);
          },
          100'000};
}

}  // namespace

std::vector<Part> telegram_parts() {
  return {out(), ticks(false), ticks(true), in(), led(0), led(300'000)};
}

}  // namespace lockstep::bench
