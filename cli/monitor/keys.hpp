/// Keys of the monitor: each changes the model, or is a wish that others have to fulfil.
#pragma once

#include <optional>
#include <string>

#include "cli/monitor/model.hpp"

namespace lockstep::cli {

enum class KeyKind : std::uint8_t {
  text,
  up,
  down,
  left,
  right,
  page_up,
  page_down,
  first,
  last,
  enter,
  escape,
  erase,
  tab,
  interrupt,
  other
};

struct Key {
  KeyKind kind = KeyKind::other;
  std::string text;  ///< of `text`: one character in UTF-8
};

/// What is asked of those around the model.
struct Wish {
  bool end = false;
  bool record = false;  ///< begin or end it
  std::optional<OutgoingCommand> command;
};

/// @param page signals on a page of the table
Wish press(Model& model, const Key& key, std::size_t page, Model::Clock::time_point now);

}  // namespace lockstep::cli
