// Compares every registered block with the catalogues of published instructions: pins, their order, class,
// type and default, and the technology objects they accept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fb/block.hpp"

namespace lockstep::block_list_test {
namespace {

using Json = nlohmann::json;

constexpr const char* kCatalogues[] = {"instructions_axis.json", "instructions.json"};

// A pin that the published block does not have.
struct ExtraPin {
  const char* block;
  const char* pin;
  double initial;
};
constexpr ExtraPin kExtraPins[] = {
    {"MC_MoveAbsolute", "BufferMode", 0.0},
    {"MC_MoveRelative", "BufferMode", 0.0},
    {"MC_MoveVelocity", "BufferMode", 0.0},
    {"MC_Halt", "BufferMode", 0.0},
};

// The kinds of technology object there are; a kind that the catalogue names beyond these does not count.
constexpr ObjectKind kKinds[] = {ObjectKind::TO_PositioningAxis, ObjectKind::TO_SynchronousAxis,
                                 ObjectKind::TO_ExternalEncoder, ObjectKind::TO_MeasuringInput,
                                 ObjectKind::TO_SpeedAxis,       ObjectKind::TO_OutputCam,
                                 ObjectKind::TO_CamTrack,        ObjectKind::TO_Cam,
                                 ObjectKind::TO_Cam_10k,         ObjectKind::TO_LeadingAxisProxy};
// Those of Lockstep beside them, which the published blocks take where they take what leads.
constexpr ObjectKinds kOwnKinds = static_cast<ObjectKinds>(ObjectKind::MCO_305);

std::map<std::string, Json> read_catalogues() {
  std::map<std::string, Json> blocks;
  for (const char* name : kCatalogues) {
    std::ifstream file(std::string(LOCKSTEP_TEST_DATA) + "/" + name);
    for (Json& block : Json::parse(file)) {
      const std::string block_name = block.at("name");
      if (block_name.front() != '_') blocks[block_name] = std::move(block);
    }
  }
  return blocks;
}

const std::map<std::string, Json>& catalogue() {
  static const std::map<std::string, Json> blocks = read_catalogues();
  return blocks;
}

// Whether the data type is that of a technology object: a list of them, or one.
bool names_objects(const Json& data_type) {
  return data_type.is_array() || data_type.get<std::string>().starts_with("TO_");
}

std::set<std::string> published_objects(const Json& data_type) {
  return data_type.is_array() ? data_type.get<std::set<std::string>>()
                              : std::set<std::string>{data_type.get<std::string>()};
}

// The elementary type in a text such as "INT (S7-1500: also SINT)".
std::optional<Type> published_type(const Json& data_type) {
  const std::string text = data_type;
  const std::string name = text.substr(0, text.find(' '));
  return name == "VARIANT" ? Type::LREAL : tag_type(name);  // a number holds what such a pin is used for
}

// A default as a number: false, 1.0, "16#0000", "T#0s".
double published_number(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
  if (value.is_number()) return value.get<double>();
  const std::string text = value;
  if (text.starts_with("16#")) return static_cast<double>(std::stoull(text.substr(3), nullptr, 16));
  if (text.starts_with("T#") && text.ends_with("s") && !text.ends_with("ms"))
    return std::stod(text.substr(2));
  throw std::invalid_argument("a default that this test cannot read: " + text);
}

double initial_value(const BlockType& type, const Pin& pin) {
  const std::unique_ptr<Block> block = type.create();
  return as_double(pin.signal(*block).load(), pin.type);
}

const ExtraPin* find_extra(const BlockType& type, const Pin& pin) {
  const auto* found = std::find_if(std::begin(kExtraPins), std::end(kExtraPins), [&](const ExtraPin& extra) {
    return type.name == extra.block && pin.name == extra.pin;
  });
  return found == std::end(kExtraPins) ? nullptr : found;
}

void expect_objects(const Pin& pin, const Json& data_type) {
  EXPECT_EQ(pin.type, Type::AXIS);
  const std::set<std::string> published = published_objects(data_type);
  ObjectKinds known = 0;
  for (const ObjectKind kind : kKinds) {
    const auto bit = static_cast<ObjectKinds>(kind);
    known |= bit;
    EXPECT_EQ((pin.objects & bit) != 0, published.contains(std::string(kind_name(kind)))) << kind_name(kind);
  }
  EXPECT_EQ(pin.objects & ~known & ~kOwnKinds, 0u) << "a kind that this test does not know: add it to kKinds";
}

void expect_value(const BlockType& type, const Pin& pin, const Json& published) {
  const std::optional<Type> expected = published_type(published.at("dataType"));
  ASSERT_TRUE(expected) << "data type " << published.at("dataType") << " is not known";
  EXPECT_EQ(type_name(pin.type), type_name(*expected));
  if (published.at("default").is_null()) return;
  EXPECT_EQ(initial_value(type, pin), published_number(published.at("default")));
}

void expect_pin(const BlockType& type, const Pin& pin, const Json& published) {
  EXPECT_EQ(pin.name, published.at("name").get<std::string>());
  const char* const classes[] = {"INPUT", "OUTPUT", "INOUT"};
  EXPECT_EQ(classes[static_cast<std::size_t>(pin.pin_class)], published.at("declaration").get<std::string>());
  if (published.at("dataType").is_string() &&
      published.at("dataType").get<std::string>().starts_with("ARRAY[*] OF ")) {
    ASSERT_EQ(pin.type, Type::ARRAY);
    EXPECT_EQ("ARRAY[*] OF " + std::string(pin.element->name), published.at("dataType").get<std::string>());
    return;
  }
  if (names_objects(published.at("dataType")))
    expect_objects(pin, published.at("dataType"));
  else
    expect_value(type, pin, published);
}

// An extra pin has to leave the published behaviour alone unless it is used.
void expect_extra(const BlockType& type, const Pin& pin, const ExtraPin& extra) {
  EXPECT_EQ(pin.pin_class, PinClass::input) << extra.pin;
  EXPECT_EQ(initial_value(type, pin), extra.initial) << extra.pin;
}

class PublishedBlock : public testing::TestWithParam<std::string> {};

TEST_P(PublishedBlock, HasThePublishedPins) {
  const BlockType& type = *find_block_type(GetParam());
  const Json& published = catalogue().at(GetParam()).at("parameters");
  std::vector<const Pin*> pins;
  for (const Pin& pin : type.pins)
    if (const ExtraPin* extra = find_extra(type, pin))
      expect_extra(type, pin, *extra);
    else
      pins.push_back(&pin);
  ASSERT_EQ(pins.size(), published.size());
  for (std::size_t i = 0; i < pins.size(); ++i) {
    SCOPED_TRACE(testing::Message() << type.name << ", pin " << i << ": " << published[i].at("name"));
    expect_pin(type, *pins[i], published[i]);
  }
}

std::vector<std::string> published_blocks() {
  std::vector<std::string> blocks;
  for (const BlockType& type : block_types())
    if (catalogue().contains(std::string(type.name))) blocks.emplace_back(type.name);
  return blocks;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, PublishedBlock, testing::ValuesIn(published_blocks()),
                         [](const auto& block) { return block.param; });

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Published blocks that there are not, and why.
const std::map<std::string, std::string> kNotThere = {};

TEST(BlockList, HasEveryPublishedBlockButThoseThatAreListedWithTheirReason) {
  EXPECT_EQ(catalogue().size(), 52u);
  for (const auto& [name, block] : catalogue()) {
    const BlockType* const type = find_block_type(name);
    EXPECT_NE(type != nullptr, kNotThere.contains(name)) << name;
    if (type != nullptr) {
      EXPECT_EQ(type->name, name);
    }
  }
  for (const auto& [name, reason] : kNotThere) {
    EXPECT_TRUE(catalogue().contains(name)) << name;
    EXPECT_FALSE(reason.empty()) << name;
  }
}

TEST(BlockList, NamesBlocksAndTheirPinsOnce) {
  std::set<std::string> blocks;
  for (const BlockType& type : block_types()) {
    EXPECT_TRUE(blocks.insert(lower(type.name)).second) << type.name;
    std::set<std::string> pins;
    for (const Pin& pin : type.pins)
      EXPECT_TRUE(pins.insert(lower(pin.name)).second) << type.name << "." << pin.name;
  }
}

TEST(BlockList, SaysWhatEachBlockAndEachPinIs) {
  for (const BlockType& type : block_types()) {
    EXPECT_FALSE(type.text.empty()) << type.name;
    EXPECT_FALSE(type.source.empty()) << type.name;
    for (const Pin& pin : type.pins) EXPECT_FALSE(pin.text.empty()) << type.name << "." << pin.name;
  }
}

TEST(BlockList, HoldsEachPinInAPlaceOfItsOwn) {
  for (const BlockType& type : block_types()) {
    const std::unique_ptr<Block> block = type.create();
    std::set<const void*> places;
    for (const Pin& pin : type.pins)
      EXPECT_TRUE(places.insert(pin.address(*block)).second) << type.name << "." << pin.name;
  }
}

}  // namespace
}  // namespace lockstep::block_list_test
