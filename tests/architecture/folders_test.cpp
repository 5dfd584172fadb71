// The rules that hold the folders apart: who may include whom, what stays out of the cycle, and names that
// say nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/architecture/source_text.hpp"

namespace lockstep::folders_test {
namespace {

namespace fs = std::filesystem;

// Each folder may use itself and those before it.
constexpr std::string_view kFolders[] = {"tech_objects", "fb", "scheduler", "hmi_bridge", "projects", "cli"};

// What the cycle runs.
constexpr std::string_view kCycleFolders[] = {"tech_objects", "fb", "scheduler"};

// Headers by the beginning of their path and the first folder that may include them; those after it may too.
struct Library {
  std::string_view path;
  std::string_view first_folder;
};
constexpr Library kLibraries[] = {
    {"Eigen/", "tech_objects"},
    {"unsupported/Eigen/", "tech_objects"},
    {"modbus", "hmi_bridge"},
    {"lcm/", "hmi_bridge"},
    {"sqlite3", "hmi_bridge"},
    {"lockstep/", "hmi_bridge"},  // generated from the .lcm files of hmi_bridge
    {"boost/", "hmi_bridge"},
    {"fmt/", "hmi_bridge"},
    {"iostream", "hmi_bridge"},
    {"sstream", "hmi_bridge"},
    {"fstream", "hmi_bridge"},
    {"nlohmann/", "projects"},
    {"valijson/", "projects"},
    {"pybind11/", "projects"},
    {"CLI/", "cli"},
    {"ncurses", "cli"},
    {"curses", "cli"},
};

constexpr std::string_view kEmptyNames[] = {"util",     "utils",  "common",  "core", "manager",
                                            "managers", "helper", "helpers", "misc"};

// A source file of a folder.
struct Source {
  fs::path path;  // below the root
  std::string folder;
  std::string text;
};

template <class List>
std::ptrdiff_t place_in(const List& list, std::string_view name) {
  return std::distance(std::begin(list), std::find(std::begin(list), std::end(list), name));
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Source> sources_of(std::string_view folder) {
  std::vector<Source> sources;
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
    const fs::path extension = entry.path().extension();
    if (extension == ".cpp" || extension == ".hpp")
      sources.push_back(
          {entry.path().lexically_relative(root), std::string(folder), content_of(entry.path())});
  }
  return sources;
}

// What is wrong with an include, empty if nothing is.
std::string include_fault(std::string_view folder, const Include& include) {
  const std::ptrdiff_t own = place_in(kFolders, folder);
  for (const Library& library : kLibraries)
    if (include.path.starts_with(library.path))
      return place_in(kFolders, library.first_folder) <= own ? "" : "is a matter of folders further down";
  const std::ptrdiff_t other = place_in(kFolders, include.path.substr(0, include.path.find('/')));
  if (other < std::ssize(kFolders)) return other <= own ? "" : "is in a folder further down";
  return include.quoted ? "is not named from the root" : "";
}

std::vector<std::string> include_faults(const Source& source) {
  std::vector<std::string> faults;
  for (const Include& include : includes_of(source.text))
    if (const std::string fault = include_fault(source.folder, include); !fault.empty())
      faults.push_back(source.path.string() + ":" + std::to_string(include.line) + ": " + include.path + " " +
                       fault);
  return faults;
}

std::vector<std::string> exception_faults(const Source& source) {
  std::vector<std::string> faults;
  for (const char* word : {"throw", "try", "catch"})
    for (const int line : lines_with_word(source.text, word))
      faults.push_back(source.path.string() + ":" + std::to_string(line) + ": " + word);
  return faults;
}

// All the faults of some folders, one a line.
template <class Folders>
std::string faults_of(const Folders& folders,
                      const std::function<std::vector<std::string>(const Source&)>& faults_in) {
  std::ostringstream text;
  for (const std::string_view folder : folders)
    for (const Source& source : sources_of(folder))
      for (const std::string& fault : faults_in(source)) text << fault << '\n';
  return text.str();
}

bool says_nothing(const fs::path& path) {
  return place_in(kEmptyNames, path.stem().string()) < std::ssize(kEmptyNames);
}

TEST(Folders, OfTheCycleHaveSources) {
  for (const std::string_view folder : kCycleFolders) EXPECT_FALSE(sources_of(folder).empty()) << folder;
}

TEST(Folders, IncludeOnlyWhatStandsAboveThem) {
  EXPECT_EQ(faults_of(kFolders, include_faults), "");
}

TEST(Folders, OfTheCycleHaveNoExceptions) {
  EXPECT_EQ(faults_of(kCycleFolders, exception_faults), "");
}

TEST(Folders, AndFilesHaveNamesThatSaySomething) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  for (const fs::directory_entry& entry : fs::directory_iterator(root))
    EXPECT_FALSE(entry.is_directory() && says_nothing(entry.path())) << entry.path();
  std::vector<std::string_view> folders(std::begin(kFolders), std::end(kFolders));
  folders.emplace_back("tests");
  for (const std::string_view folder : folders)
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
      EXPECT_FALSE(says_nothing(entry.path())) << entry.path();
}

// The rules themselves, on sources that break them.

Source source_in(const std::string& folder, std::string text) {
  return {folder + "/file.cpp", folder, std::move(text)};
}

TEST(FolderRules, LetAFolderIncludeItselfThoseAboveItAndTheStandardLibrary) {
  EXPECT_TRUE(include_faults(source_in("scheduler",
                                       "#include <vector>\n#include <sys/mman.h>\n"
                                       "#include \"scheduler/cycle.hpp\"\n"
                                       "#include \"fb/block.hpp\"\n"
                                       "#include \"tech_objects/types/types.hpp\"\n"))
                  .empty());
  EXPECT_TRUE(
      include_faults(source_in("projects", "#include <nlohmann/json.hpp>\n#include <modbus.h>\n")).empty());
}

TEST(FolderRules, RefuseAFolderFurtherDownWhicheverWayItIsWritten) {
  EXPECT_EQ(include_faults(source_in("tech_objects", "#include \"fb/block.hpp\"\n")),
            std::vector<std::string>{"tech_objects/file.cpp:1: fb/block.hpp is in a folder further down"});
  EXPECT_EQ(include_faults(source_in("fb", "#include <scheduler/cycle.hpp>\n")).size(), 1u);
  EXPECT_EQ(include_faults(source_in("scheduler", "#include \"hmi_bridge/tag.hpp\"\n")).size(), 1u);
  EXPECT_EQ(include_faults(source_in("hmi_bridge", "#include \"projects/loader/loader.hpp\"\n")).size(), 1u);
  EXPECT_EQ(include_faults(source_in("projects", "#include \"cli/main.hpp\"\n")).size(), 1u);
}

TEST(FolderRules, RefuseAPathThatIsNotNamedFromTheRoot) {
  EXPECT_EQ(include_faults(source_in("fb", "#include \"block.hpp\"\n")).size(), 1u);
  EXPECT_EQ(include_faults(source_in("fb", "#include \"../tech_objects/types.hpp\"\n")).size(), 1u);
}

TEST(FolderRules, RefuseLibrariesOutsideTheirFolders) {
  EXPECT_EQ(
      include_faults(source_in("scheduler", "#include <iostream>\n#include <modbus/modbus.h>\n")).size(), 2u);
  EXPECT_EQ(include_faults(source_in("hmi_bridge", "#include <nlohmann/json.hpp>\n")).size(), 1u);
  EXPECT_EQ(include_faults(source_in("projects", "#include <CLI/CLI.hpp>\n")).size(), 1u);
}

TEST(FolderRules, RefuseExceptionsInTheCycle) {
  EXPECT_EQ(exception_faults(source_in("fb", "void f() try {\n  throw 1;\n} catch (int) {\n}\n")).size(), 3u);
  EXPECT_TRUE(
      exception_faults(source_in("fb", "bool try_push() noexcept;  // never throws, does not throw\n"))
          .empty());
}

TEST(FolderRules, RefuseNamesThatSayNothing) {
  EXPECT_TRUE(says_nothing("fb/utils"));
  EXPECT_TRUE(says_nothing("fb/common.hpp"));
  EXPECT_FALSE(says_nothing("fb/edge.hpp"));
}

}  // namespace
}  // namespace lockstep::folders_test
