#include "cli/monitor/keys.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cli/describe/table.hpp"

namespace lockstep::cli {
namespace {

constexpr std::size_t kLongestText = 60;  // of what is typed
constexpr double kOverrideStep = 10.0;    // [%]
constexpr double kHighestOverride = 200.0;

/// Takes a character away, or adds one.
void edit(std::string& text, const Key& key) {
  if (key.kind == KeyKind::text && text.size() < kLongestText) text += key.text;
  if (key.kind != KeyKind::erase) return;
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

void search(Model& model, const Key& key) {
  if (key.kind == KeyKind::enter) model.searching = false;
  if (key.kind == KeyKind::escape) {
    model.searching = false;
    model.search.clear();
  }
  edit(model.search, key);
}

void command(Model& model, Wish& wish, std::int32_t action, double value, Model::Clock::time_point now) {
  wish.command = model.panel->command(action, value, now);
  if (!wish.command) model.remark = "no run is heard that takes commands; nothing was sent";
}

/// Where the axis is set to: a number, and Enter.
void answer(Model& model, const Key& key, Wish& wish, Model::Clock::time_point now) {
  if (key.kind == KeyKind::enter) {
    const auto position = number_of(model.answer);
    if (position)
      command(model, wish, command_t::HOME, *position, now);
    else
      model.remark = "'" + model.answer + "' is no number; nothing was sent";
  }
  if (key.kind == KeyKind::enter || key.kind == KeyKind::escape) {
    model.prompt.clear();
    model.answer.clear();
  }
  edit(model.answer, key);
}

/// Asks where the axis is, if it can be told.
void ask_position(Model& model, const PanelAxis* axis) {
  if (axis == nullptr) return;
  const std::string name = printable(axis->state.axis);
  if (axis->state.has_position != 0)
    model.prompt = "position of " + name + " is";
  else
    model.remark = name + " is a speed axis: it has no position to set; nothing was sent";
}

/// @return whether the panel knows the key
bool press_on_panel(Model& model, const Key& key, Wish& wish, Model::Clock::time_point now) {
  const PanelAxis* const axis = model.panel->chosen();
  const double speed = axis == nullptr ? 100.0 : axis->state.speed;
  const auto act = [&](std::int32_t action, double value = 0.0) {
    command(model, wish, action, value, now);
    return true;
  };
  if (key.kind == KeyKind::tab) {
    model.panel->choose_next();
    return true;
  }
  if (key.kind == KeyKind::left) return act(command_t::JOG_BACKWARD);
  if (key.kind == KeyKind::right) return act(command_t::JOG_FORWARD);
  if (key.kind != KeyKind::text || key.text.size() != 1) return false;
  switch (key.text[0]) {
    case 'e':
      return act(command_t::ENABLE);
    case 'd':
      return act(command_t::DISABLE);
    case ' ':
      return act(command_t::STOP);
    case 'x':
      return act(command_t::RESET);
    case 'n':
      return act(command_t::START_PROGRAM, -1.0);
    case '[':
      return act(command_t::OVERRIDE, std::max(speed - kOverrideStep, 0.0));
    case ']':
      return act(command_t::OVERRIDE, std::min(speed + kOverrideStep, kHighestOverride));
    case '<':
    case '>':
      model.panel->change_percent(key.text[0] == '<' ? -1 : 1);
      return true;
    case 'h':
      ask_position(model, axis);
      return true;
    default:
      return false;
  }
}

void press_letter(Model& model, char letter, Wish& wish, Model::Clock::time_point now) {
  const int last_window = static_cast<int>(std::size(Model::kWindows)) - 1;
  switch (letter) {
    case 'q':
    case 'Q':
      wish.end = true;
      break;
    case '/':
      model.searching = true;
      break;
    case 's':
      model.order = static_cast<Order>((static_cast<int>(model.order) + 1) % 3);
      break;
    case 'g':
      model.plot = !model.plot;
      break;
    case 'j':
      model.jobs = !model.jobs;
      break;
    case 'a':
      model.alarms = !model.alarms;
      break;
    case 'l':
      model.leading = !model.leading;
      break;
    case 'p':
      model.pause(!model.paused(), now);
      break;
    case 'r':
      wish.record = true;
      break;
    case '?':
      model.help = !model.help;
      break;
    case '+':
    case '-':
      model.window_index = std::clamp(model.window_index + (letter == '+' ? 1 : -1), 0, last_window);
      break;
    default:
      break;
  }
}

void move(Model& model, KeyKind kind, std::ptrdiff_t page) {
  constexpr std::ptrdiff_t kFar = 1'000'000'000;
  if (kind == KeyKind::up) model.move(-1);
  if (kind == KeyKind::down) model.move(1);
  if (kind == KeyKind::page_up) model.move(-page);
  if (kind == KeyKind::page_down) model.move(page);
  if (kind == KeyKind::first) model.move(-kFar);
  if (kind == KeyKind::last) model.move(kFar);
}

}  // namespace

Wish press(Model& model, const Key& key, std::size_t page, Model::Clock::time_point now) {
  Wish wish;
  model.remark.clear();
  if (key.kind == KeyKind::interrupt) {
    wish.end = true;
  } else if (!model.prompt.empty()) {
    answer(model, key, wish, now);
  } else if (model.searching) {
    search(model, key);
  } else if (model.panel && press_on_panel(model, key, wish, now)) {
    return wish;
  } else if (key.kind == KeyKind::escape) {
    model.help = false;
    model.search.clear();
  } else if (key.kind == KeyKind::text && key.text.size() == 1) {
    press_letter(model, key.text[0], wish, now);
  } else {
    move(model, key.kind, static_cast<std::ptrdiff_t>(page));
  }
  return wish;
}

}  // namespace lockstep::cli
