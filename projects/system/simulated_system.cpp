#include "projects/system/simulated_system.hpp"

#include <stdexcept>

#include "projects/loader/simulation.hpp"

namespace lockstep {
namespace {

System valid(LoadedSystem loaded, const std::string& path) {
  if (loaded.system) return std::move(*loaded.system);
  std::string text = "the system is not valid";
  for (const Problem& problem : loaded.problems) text += "\n" + to_string(path, problem);
  throw InvalidProject(text);
}

}  // namespace

SimulatedSystem::SimulatedSystem(System system)
    : system_(std::move(system)), ends_(system_.controllers.size()) {
  connect();
  for (std::size_t i = 0; i < system_.controllers.size(); ++i) {
    Controller& controller = *system_.controllers[i].project.controller;
    controller.apply_stimuli = true;
    due_.emplace(controller.now() + controller.shared_time_at_start, i);
  }
}

SimulatedSystem::SimulatedSystem(const std::string& path)
    : SimulatedSystem(valid(load_system_file(path), path)) {}

void SimulatedSystem::connect() {
  std::uint64_t index = 0;
  for (const SystemArea& area : system_.areas) {
    Sender sender{std::make_unique<TelegramRing>(), {}};
    system_.controllers[area.controller].project.controller->telegram_outputs.push_back(
        {area.from, sender.ring.get()});
    for (const SystemArea::Receiver& to : area.to) {
      Receiver receiver{std::make_unique<SimulatedLink>(system_.simulated_network, index++),
                        std::make_unique<TelegramRing>()};
      sender.links.push_back(receiver.link.get());
      system_.controllers[to.controller].project.controller->telegram_inputs.push_back(
          {to.proxy, receiver.ring.get()});
      ends_[to.controller].receivers.push_back(std::move(receiver));
    }
    ends_[area.controller].senders.push_back(std::move(sender));
  }
}

void SimulatedSystem::step() {
  const auto [time, index] = due_.top();
  due_.pop();
  Controller& controller = *system_.controllers[index].project.controller;
  for (Receiver& receiver : ends_[index].receivers)
    receiver.link->take(time, [&](const LeadingValueTelegram& telegram) { receiver.ring->put(telegram); });
  controller.tick();
  for (Sender& sender : ends_[index].senders)
    sender.ring->take([&, sent = time](const LeadingValueTelegram& telegram) {
      for (SimulatedLink* const link : sender.links) link->send(telegram, sent);
    });
  due_.emplace(controller.now() + controller.shared_time_at_start, index);
}

void SimulatedSystem::run_for(std::chrono::nanoseconds duration) {
  const std::int64_t end = now() + duration.count();
  while (now() < end) step();
}

/// The index of the controller with which a path begins, and what comes behind it.
std::pair<std::size_t, std::string_view> SimulatedSystem::split(std::string_view path) const {
  const std::size_t dot = path.find('.');
  const auto index = system_.find(path.substr(0, dot));
  if (!index || dot == path.npos)
    throw std::out_of_range(quote(path) + " begins with no controller of the system");
  return {*index, path.substr(dot + 1)};
}

double SimulatedSystem::read(std::string_view path) const {
  const auto [index, within] = split(path);
  return read_value_of(system_.controllers[index].project, within);
}

void SimulatedSystem::write(std::string_view path, double value) {
  const auto [index, within] = split(path);
  write_value_of(system_.controllers[index].project, within, value);
}

std::uint64_t SimulatedSystem::lost() const noexcept {
  std::uint64_t lost = 0;
  for (const Ends& ends : ends_)
    for (const Receiver& receiver : ends.receivers) lost += receiver.link->lost();
  return lost;
}

}  // namespace lockstep
