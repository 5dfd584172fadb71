#include "scheduler/aposs/printed_line.hpp"

namespace lockstep::aposs {

bool append_printed(std::string& line, std::span<const std::string> texts, const Printed& item) {
  switch (item.kind) {
    case Printed::Kind::kText:
      if (static_cast<std::size_t>(item.value) < texts.size())
        line += texts[static_cast<std::size_t>(item.value)];
      return false;
    case Printed::Kind::kNumber:
      line += std::to_string(item.value);
      return false;
    case Printed::Kind::kCharacter: {
      // ISO 8859-1, as UTF-8.
      const auto character = static_cast<unsigned char>(item.value);
      if (character >= 0x80) line += static_cast<char>(0xc0 | (character >> 6));
      line += static_cast<char>(character < 0x80 ? character : 0x80 | (character & 0x3f));
      return false;
    }
    case Printed::Kind::kEndOfLine:
      return true;
  }
  return true;
}

}  // namespace lockstep::aposs
