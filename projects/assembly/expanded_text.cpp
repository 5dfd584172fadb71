#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "projects/assembly/sources.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;

/// What a project does not need when all of it is in one file.
bool is_of_parts(std::string_view key) {
  return key == "include" || key == "templates" || key == "instances";
}

class Writer {
 public:
  /// @param folder of the project
  explicit Writer(std::string folder) : folder_(std::move(folder)) {}

  Json json_of(const JsonValue& value) const {
    switch (value.kind) {
      case JsonKind::boolean:
        return value.boolean;
      case JsonKind::number:
        return number_of(value);
      case JsonKind::string:
        return value.text;
      case JsonKind::array: {
        Json list = Json::array();
        for (const JsonValue* const element : value.elements) list.push_back(json_of(*element));
        return list;
      }
      case JsonKind::object: {
        Json object = Json::object();
        for (const auto& [key, member] : value.members)
          object[key] = is_cam_file(value, key, *member) ? Json(path_of(*member)) : json_of(*member);
        return object;
      }
      case JsonKind::null:
      case JsonKind::unusable:
        break;
    }
    return nullptr;
  }

 private:
  static Json number_of(const JsonValue& value) {
    constexpr std::uint64_t kLowest = std::uint64_t{1} << 63;  // of an integer, its amount
    if (!value.whole || value.fraction || (value.negative && value.magnitude > kLowest)) return value.number;
    if (!value.negative) return value.magnitude;
    return static_cast<std::int64_t>(0 - value.magnitude);
  }

  /// Its name is relative to where it was written, which may be another folder.
  bool is_cam_file(const JsonValue& object, std::string_view key, const JsonValue& value) const {
    const JsonValue* const type = object.find("type");
    return key == "file" && value.kind == JsonKind::string && value.source() != nullptr &&
           value.source()->folder() != folder_ && type != nullptr && type->text.starts_with("TO_Cam");
  }
  std::string path_of(const JsonValue& name) const {
    const std::filesystem::path path = std::filesystem::path(name.source()->folder()) / name.text;
    return path.lexically_relative(folder_.empty() ? std::filesystem::path() : std::filesystem::path(folder_))
        .string();
  }

  std::string folder_;
};

}  // namespace

std::string expanded_text(const JsonValue& root) {
  const Writer writer(root.source() == nullptr ? "" : root.source()->folder());
  Json project = Json::object();
  for (const auto& [key, value] : root.members)
    if (!is_of_parts(key)) project[key] = writer.json_of(*value);
  return project.dump(2) + "\n";
}

}  // namespace lockstep
