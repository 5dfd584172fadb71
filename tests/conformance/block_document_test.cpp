// Keeps fb/BLOCKS.md, the list of supported blocks and their pins, in step with the registry.
#include <gtest/gtest.h>

#include <charconv>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/conformance/subject.hpp"

namespace lockstep::test::block_document_test {
namespace {

constexpr const char* kFile = LOCKSTEP_SOURCE_DIR "/fb/BLOCKS.md";

std::string number_text(double number) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, end};
}

std::string default_text(Subject& block, const Pin& pin) {
  const double number = block.number(pin);
  if (pin.type >= Type::AXIS) return "";
  if (pin.type == Type::BOOL) return number != 0.0 ? "TRUE" : "FALSE";
  if (pin.type == Type::WORD) return "16#0000";
  if (pin.type == Type::TIME) return "T#" + number_text(number) + "s";
  const std::string text = number_text(number);
  const bool whole = text.find_first_of(".e") == std::string::npos;
  return is_real(pin.type) && whole ? text + ".0" : text;
}

std::string type_text(const Pin& pin) {
  if (pin.type == Type::ARRAY) return "ARRAY[*] OF " + std::string(pin.element->name);
  if (pin.type != Type::AXIS) return std::string(type_name(pin.type));
  std::string text;
  for (const ObjectKindText& known : kObjectKinds)
    if (among(known.kind, pin.objects)) text += (text.empty() ? "" : ", ") + std::string(known.name);
  return text;
}

std::string meaning_text(const Pin& pin) {
  std::string text(pin.text);
  for (const Choice& choice : pin.choices)
    text += (&choice == pin.choices.data() ? ": " : "; ") + std::to_string(choice.value) + " " +
            std::string(choice.text);
  if (pin.error == ErrorId::none || pin.type == Type::AXIS) return text;
  char code[32];
  std::snprintf(code, sizeof code, " (16#%04X)", static_cast<unsigned>(pin.error));
  return text + code;
}

void write_block(std::ostream& out, const BlockType& type) {
  Subject block(type);
  out << "\n## " << type.name << "\n\n" << type.text << "\nSource: " << type.source << ".\n\n";
  out << "| pin | class | type | default | unit | meaning (error for a value that is not permitted) |\n";
  out << "|---|---|---|---|---|---|\n";
  constexpr const char* kClasses[] = {"input", "output", "in and out"};
  for (const Pin& pin : type.pins)
    out << "| " << pin.name << " | " << kClasses[static_cast<std::size_t>(pin.pin_class)] << " | "
        << type_text(pin) << " | " << (pin.pin_class == PinClass::input ? default_text(block, pin) : "")
        << " | " << unit_text(pin.unit) << " | " << meaning_text(pin) << " |\n";
}

std::string generated() {
  std::ostringstream out;
  out << "# Supported function blocks\n\n"
      << "Every block with its pins, as PLCopen asks a supplier to state them. Names, order and defaults "
         "are\n"
      << "the published ones. This file is generated from the list of blocks and tested against it; to "
         "renew\n"
      << "it, run `LOCKSTEP_UPDATE=1 ctest --preset dev -R BlockDocument`.\n\n"
      << "u is the user unit of the axis that a value belongs to.\n\n";
  for (const BlockType& type : block_types())
    out << "- [" << type.name << "](#" <<
        [&] {
          std::string anchor(type.name);
          for (char& c : anchor)
            if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
          return anchor;
        }()
        << "): " << type.text << "\n";
  for (const BlockType& type : block_types()) write_block(out, type);
  return out.str();
}

TEST(BlockDocument, ListsTheBlocksAsTheyAreRegistered) {
  const std::string expected = generated();
  if (std::getenv("LOCKSTEP_UPDATE") != nullptr) std::ofstream(kFile) << expected;
  std::ostringstream actual;
  actual << std::ifstream(kFile).rdbuf();
  EXPECT_TRUE(actual.str() == expected)
      << kFile << " is out of date. Renew it with LOCKSTEP_UPDATE=1 ctest --preset dev -R BlockDocument";
}

TEST(BlockDocument, HasNoCellThatBreaksItsTable) {
  for (const BlockType& type : block_types())
    for (const Pin& pin : type.pins)
      EXPECT_EQ(meaning_text(pin).find_first_of("|\n"), std::string::npos) << type.name << "." << pin.name;
}

}  // namespace
}  // namespace lockstep::test::block_document_test
