#include <gtest/gtest.h>

#include <filesystem>

#include "projects/cam_files/file.hpp"
#include "projects/cam_files/schema.hpp"
#include "schema_check.hpp"

namespace lockstep::cam_schema_test {
namespace {

using nlohmann::json;

class CamSchema : public SchemaCheck {
 protected:
  CamSchema() : SchemaCheck(cam_schema()) {}
};

TEST_F(CamSchema, ShipsAsItIsMade) {
  expect_shipped("cam.schema.json", cam_schema());
}

TEST_F(CamSchema, AcceptsEveryExampleAndWhatIsWritten) {
  for (const auto& entry : std::filesystem::directory_iterator(kProjects + "/cams")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_TRUE(accepts(json::parse(read(entry.path().string())))) << entry.path();
    const LoadedCam cam = load_cam_file(entry.path().string(), "", kCamPoints);
    ASSERT_TRUE(cam.definition);
    for (const bool flat : {false, true})
      EXPECT_TRUE(accepts(json::parse(cam_document(*cam.definition, flat)))) << entry.path() << flat;
  }
}

// An unknown key anywhere in an example is refused by both.
TEST_F(CamSchema, AgreesWithTheReaderOnUnknownKeys) {
  const json example = json::parse(read(kProjects + "/cams/feeder.cam.json"));
  int places = 0;
  const json flat = example.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    json::json_pointer place(pointer);
    while (!place.empty()) {
      place = place.parent_pointer();
      json changed = example;
      if (!changed[place].is_object()) continue;
      changed[place]["unknown_key"] = 1;
      ++places;
      EXPECT_FALSE(accepts(changed)) << place.to_string();
      EXPECT_FALSE(load_cam(changed.dump(), "", "", kCamPoints).definition) << place.to_string();
    }
  }
  EXPECT_GT(places, 20);
}

// What the schema refuses, the reader refuses: a value of each kind at every place.
TEST_F(CamSchema, RefusesNothingThatTheReaderAccepts) {
  const json example = json::parse(read(kProjects + "/cams/feeder.cam.json"));
  int accepted = 0;
  const json flat = example.flatten();
  for (const auto& [pointer, old] : flat.items())
    for (const json& value : {json(1), json(-2.5), json("text"), json(true), json(nullptr),
                              json::array({1, 2}), json::object(), json(1e13), json("law"), json("sine")}) {
      json changed = example;
      changed[json::json_pointer(pointer)] = value;
      if (!load_cam(changed.dump(), "", "", kCamPoints).definition) continue;
      ++accepted;
      EXPECT_TRUE(accepts(changed)) << pointer << " = " << value;
    }
  EXPECT_GT(accepted, 20);
}

}  // namespace
}  // namespace lockstep::cam_schema_test
