/// A studio that takes traces from files, without a network.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "tests/projects/studio_machine.hpp"

namespace lockstep::test {

/// A folder that is gone with its test.
class StudioFolder {
 public:
  StudioFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "studio_files_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) ADD_FAILURE() << "no folder";
    path_ = name;
  }
  ~StudioFolder() { std::filesystem::remove_all(path_); }
  StudioFolder(const StudioFolder&) = delete;
  StudioFolder& operator=(const StudioFolder&) = delete;

  std::string write(const std::string& name, const std::string& content) const {
    const std::string path = (path_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

class StudioOfFiles : public StudioMachine {
 public:
  explicit StudioOfFiles(Simulation made) : StudioMachine(std::move(made)) {
    StudioPowers powers;
    powers.why_no_files = "";
    powers.files = &files;
    powers.trace_folder = std::filesystem::temp_directory_path().string();
    session.empower(powers);
  }
  StudioOfFiles()
      : StudioOfFiles(Simulation::from_text(R"({ "lockstep": 1, "name": "files",
          "clock": { "servo_cycle": "2ms" }, "technology_objects": {}, "programs": [] })")) {}

  /// What `GET /api/traces` tells of a trace; null: nothing.
  Json told(const std::string& id) {
    const Json traces = get("/api/traces").at("traces");
    for (const Json& trace : traces)
      if (trace.at("id") == id) return trace;
    return {};
  }
  /// Waits until a file has been read, or could not be.
  Json settled(const std::string& id) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (std::chrono::steady_clock::now() < deadline) {
      session.look();
      Json trace = told(id);
      if (trace.is_null() || trace.at("state") != "loading") return trace;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << id << " is never read";
    return {};
  }
  /// Has a file of the desk read. @return its id
  std::string open(const std::string& path) {
    const StudioAnswer answer = ask("POST", "/api/traces", {}, Json{{"path", path}}.dump());
    EXPECT_EQ(answer.status, 202u) << answer.body;
    const Json json = Json::parse(answer.body);
    const std::string id = json.at("id");
    EXPECT_EQ(settled(id).value("state", ""), "ready") << told(id);
    return id;
  }

  StudioTraceFiles files;
};

/// A text of numbers that are read back to the bit.
inline std::string exact(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

/// A CSV trace of a thousand rows a second. @param row values of a row, with commas between them
inline std::string csv_of(const std::string& names, int rows, const std::function<std::string(int)>& row) {
  std::string text = "t," + names + "\n";
  for (int i = 0; i < rows; ++i) text += exact(static_cast<double>(i) * 1e-3) + "," + row(i) + "\n";
  return text;
}

}  // namespace lockstep::test
