/// A schema of the product and what it accepts.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace lockstep {

inline const std::string kProjects = LOCKSTEP_SOURCE_DIR "/projects";

inline std::string read(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class SchemaCheck : public testing::Test {
 protected:
  explicit SchemaCheck(const std::string& text) {
    const nlohmann::json document = nlohmann::json::parse(text);
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(document), schema_);
  }

  bool accepts(const nlohmann::json& value) {
    return valijson::Validator().validate(schema_, valijson::adapters::NlohmannJsonAdapter(value), nullptr);
  }

  /// Whether the file that ships is what is made now. LOCKSTEP_UPDATE=1 writes it.
  static void expect_shipped(const std::string& file, const std::string& made) {
    const std::string path = kProjects + "/" + file;
    if (std::getenv("LOCKSTEP_UPDATE") != nullptr) std::ofstream(path) << made;
    EXPECT_TRUE(read(path) == made)
        << "a declaration has changed: run LOCKSTEP_UPDATE=1 projects_tests --gtest_filter=*Schema.*";
  }

 private:
  valijson::Schema schema_;
};

}  // namespace lockstep
