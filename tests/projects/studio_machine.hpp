/// A project in virtual time with its studio, without a network.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "projects/studio/session.hpp"
#include "tests/hmi_bridge/studio_client.hpp"

namespace lockstep::test {

/// A page that keeps what it is sent.
class StudioPage final : public StudioClient {
 public:
  using Json = nlohmann::json;

  void send_text(std::string text) override { texts.push_back(Json::parse(text)); }
  void send_bytes(std::vector<std::uint8_t> bytes) override {
    frames.emplace_back(std::string(bytes.begin(), bytes.end()));
  }
  bool is_idle() const noexcept override { return true; }
  bool authorise(std::string_view token) noexcept override {
    known = token != "wrong";
    return known;
  }
  bool is_authorised() const noexcept override { return known; }
  std::string_view peer() const noexcept override { return "192.0.2.7:4242"; }

  /// The last text of a type; null: there was none.
  Json last(const std::string& type) const {
    for (auto text = texts.rbegin(); text != texts.rend(); ++text)
      if ((*text)["type"] == type) return *text;
    return {};
  }

  std::vector<Json> texts;
  std::vector<DecodedFrame> frames;
  bool known = false;
};

class StudioMachine {
 public:
  using Json = nlohmann::json;

  /// @param project name of a file
  explicit StudioMachine(const std::string& project) : StudioMachine(Simulation(project)) {}
  explicit StudioMachine(Simulation made)
      : simulation(std::move(made)), session(simulation.project(), 0), sink(session.sink()) {
    Controller& controller = *simulation.project().controller;
    controller.tap = &session.tap();
    controller.events = &events;
    controller.tell_jobs();
    texts = EventTexts(controller);
  }

  /// Pages may write, and command what the project says.
  void empower() {
    Project& project = simulation.project();
    for (const CommandAxis& axis : project.commands.axes)
      command_signals.insert(command_signals.end(), axis.signals.begin(), axis.signals.end());
    const auto tell = [this](const TraceEvent& event) { sink->event(event); };
    if (!command_signals.empty()) {
      image = std::make_unique<ProcessImage>(command_signals);
      desk = std::make_unique<SharedDesk>(project.commands.axes, *image,
                                          project.controller->clock.servo_cycle, tell);
      project.controller->images.push_back(image.get());
    }
    StudioPowers powers;
    powers.why_no_write = powers.why_no_command = "";
    powers.desk = desk.get();
    powers.tell = tell;
    session.empower(powers);
  }

  void run(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
      simulation.step();
      for (std::size_t i = 0; i < events.readable(); ++i) sink->event(texts.of(events.event(i), 0));
      events.pop(events.readable());
      session.look();
    }
  }

  StudioAnswer ask(const std::string& method, const std::string& path,
                   std::vector<std::pair<std::string, std::string>> query = {},
                   const std::string& body = "") {
    StudioRequest request;
    request.method = method;
    request.path = path;
    request.query = std::move(query);
    request.body = body;
    request.peer = "192.0.2.7:4242";
    StudioAnswer answer;
    answer.status = 0;
    session.answer(request, [&answer](StudioAnswer given) { answer = std::move(given); });
    return answer;
  }
  Json get(const std::string& path, std::vector<std::pair<std::string, std::string>> query = {}) {
    return Json::parse(ask("GET", path, std::move(query)).body);
  }

  Simulation simulation;
  StudioSession session;
  std::unique_ptr<TraceSink> sink;
  EventQueue events;
  EventTexts texts;
  std::vector<Signal> command_signals;
  std::unique_ptr<ProcessImage> image;
  std::unique_ptr<SharedDesk> desk;
};

}  // namespace lockstep::test
