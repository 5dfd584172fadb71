#include "projects/aposs/error_texts.hpp"

namespace lockstep::aposs {

std::string_view error_text(int error) noexcept {
  switch (error) {
    case 110:
      return "unknown command";
    case 112:
      return "there is no such parameter";
    case 114:
      return "too many LOOP within each other";
    case 149:
      return "too many interrupts";
    case 151:
      return "too many GOSUB within each other";
    case 152:
      return "RETURN without GOSUB";
    case 155:
      return "LINKGPAR failed";
    case 170:
      return "an array is there already with another size";
    case 171:
      return "outside the bounds of an array, or no such output";
    case 175:
      return "no memory for an array";
    case 184:
      return "too many ON TIME and ON PERIOD";
    case 196:
      return "compiled for another version";
    default:
      return "";
  }
}

}  // namespace lockstep::aposs
