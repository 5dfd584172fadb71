#include "projects/aposs/listing.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "projects/aposs/interrupt_classes.hpp"

namespace lockstep::aposs {
namespace {

constexpr std::string_view kPositions[] = {"+APOS", "-APOS", "+MAPOS", "-MAPOS", "+MCPOS", "-MCPOS"};

std::string cell_text(const Image& image, std::size_t cell) {
  if (cell < image.variables.size()) return image.variables[cell];
  if (cell < image.writable_cells()) return "t" + std::to_string(cell - image.variables.size());
  return std::to_string(image.constants[cell - image.writable_cells()]);
}

std::string target_text(const Image& image, std::size_t target) {
  for (const Routine& routine : image.routines)
    if (routine.entry == target) return routine.name;
  return std::to_string(target);
}

std::string cells_text(const Image& image, std::size_t first, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + cell_text(image, first + i);
  return text;
}

std::string printed_text(const Image& image, const Instruction& at) {
  const PrintList& list = image.prints[at.a];
  std::string text;
  std::size_t cell = at.b;
  for (const PrintItem& item : list.items) {
    if (!text.empty()) text += ", ";
    if (item.kind == PrintItem::Kind::kText)
      text += "\"" + image.texts[item.text] + "\"";
    else if (item.kind == PrintItem::Kind::kNumber)
      text += cell_text(image, cell++);
    else
      text += "CHR(" + cell_text(image, cell++) + ")";
  }
  return text + (list.ends_line ? "" : ";");
}

std::string operand_text(const Image& image, const Instruction& at, Operand kind, std::uint16_t value) {
  switch (kind) {
    case Operand::kRead:
    case Operand::kWrite:
    case Operand::kUpdate:
      return cell_text(image, value);
    case Operand::kResult:
      return value == kNoCell ? "" : "-> " + cell_text(image, value);
    case Operand::kArray:
      return image.arrays[value].name + "[]";
    case Operand::kTarget:
      return target_text(image, value);
    case Operand::kCommand:
      return std::string(row_of(static_cast<Command>(value)).name);
    case Operand::kArguments:
      return cells_text(image, value, row_of(static_cast<Command>(at.a)).arity());
    case Operand::kPrintList:
      return printed_text(image, at);
    case Operand::kPosition:
      return std::string(kPositions[value]);
    case Operand::kClass:
      return std::string(kInterruptClassNames[value]);
    case Operand::kPrinted:
    case Operand::kNone:
      break;
  }
  return "";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::string line;
  for (std::istringstream stream(text); std::getline(stream, line);) {
    if (line.ends_with('\r')) line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

/// Where an instruction may go on to within its routine. A call goes on behind itself.
std::vector<std::size_t> followers(const Instruction& at, std::size_t self) {
  switch (at.operation) {
    case Operation::kEnd:
    case Operation::kExit:
    case Operation::kReturn:
      return {};
    case Operation::kJump:
    case Operation::kRest:
    case Operation::kLeave:
      return {at.a};
    case Operation::kJumpIfZero:
    case Operation::kRestIfZero:
    case Operation::kLoop:
      return {self + 1, at.a};
    default:
      return {self + 1};
  }
}

/// The longest path through the instructions, calls included.
class LongestRun {
 public:
  explicit LongestRun(const Image& image)
      : image_(image), known_(image.code.size()), mark_(image.code.size()) {}

  // The steps are put on a stack of its own: a program may be as long as it likes.
  std::optional<std::size_t> from(std::size_t entry) {
    std::vector<std::size_t> stack{entry};
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      std::vector<std::size_t> next = followers(image_.code[at], at);
      if (image_.code[at].operation == Operation::kGosub) next.push_back(image_.code[at].a);
      if (mark_[at] == Mark::kFresh) {
        mark_[at] = Mark::kOpen;
        for (const std::size_t one : next) {
          if (mark_[one] == Mark::kOpen) return std::nullopt;
          if (mark_[one] == Mark::kFresh) stack.push_back(one);
        }
        continue;
      }
      stack.pop_back();
      if (mark_[at] == Mark::kDone) continue;
      mark_[at] = Mark::kDone;
      std::size_t maximum = 0, called = 0;
      for (const std::size_t one : followers(image_.code[at], at)) maximum = std::max(maximum, known_[one]);
      if (image_.code[at].operation == Operation::kGosub) called = known_[image_.code[at].a];
      known_[at] = 1 + maximum + called;
    }
    return known_[entry];
  }

 private:
  enum class Mark : std::uint8_t { kFresh, kOpen, kDone };
  const Image& image_;
  std::vector<std::size_t> known_;
  std::vector<Mark> mark_;
};

}  // namespace

std::string instruction_text(const Image& image, std::size_t instruction) {
  const Instruction& at = image.code[instruction];
  const OperationRow& row = row_of(at.operation);
  std::string text(row.name);
  const std::array<std::pair<Operand, std::uint16_t>, 3> operands = {
      {{row.a, at.a}, {row.b, at.b}, {row.c, at.c}}};
  bool first = true;
  for (const auto& [kind, value] : operands) {
    const std::string operand = operand_text(image, at, kind, value);
    if (operand.empty()) continue;
    text += (first ? " " : at.operation == Operation::kCommand ? " " : ", ") + operand;
    first = false;
  }
  return text;
}

std::string listing(const Image& image, const std::vector<std::string>& sources) {
  std::vector<std::vector<std::string>> lines;
  lines.reserve(sources.size());
  for (const std::string& source : sources) lines.push_back(lines_of(source));
  std::string text;
  Place last;
  for (std::size_t i = 0; i < image.code.size(); ++i) {
    for (const Routine& routine : image.routines)
      if (routine.entry == i) text += "\n" + routine.name + ":\n";
    const Place& place = image.places[i];
    const bool known = place.file < lines.size() && place.line >= 1 && place.line <= lines[place.file].size();
    if (known && (place.line != last.line || place.file != last.file)) {
      text += (image.files.size() > 1 ? image.files[place.file] + ":" : "") + std::to_string(place.line) +
              ": " + lines[place.file][place.line - 1] + "\n";
      last = place;
    }
    const std::string number = std::to_string(i);
    text += std::string(number.size() < 6 ? 6 - number.size() : 0, ' ') + number + "  " +
            instruction_text(image, i) + "\n";
  }
  return text;
}

std::optional<std::size_t> longest_run(const Image& image, std::uint16_t entry) {
  return LongestRun(image).from(entry);
}

std::vector<Routine> handlers_of(const Image& image) {
  std::vector<Routine> result;
  for (const Routine& routine : image.routines) {
    const bool called = std::any_of(image.code.begin(), image.code.end(), [&](const Instruction& at) {
      switch (at.operation) {
        case Operation::kOnError:
          return at.a == routine.entry;
        case Operation::kOnPosition:
          return at.c == routine.entry;
        case Operation::kOnInput:
        case Operation::kOnCombit:
        case Operation::kOnStatbit:
        case Operation::kOnParameter:
        case Operation::kOnTime:
        case Operation::kOnPeriod:
          return at.b == routine.entry;
        default:
          return false;
      }
    });
    if (called) result.push_back(routine);
  }
  return result;
}

}  // namespace lockstep::aposs
