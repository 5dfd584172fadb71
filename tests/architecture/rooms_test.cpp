// Rooms: which of one folder may include which, as its CMakeLists.txt declares them; and what the cycle may
// not reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/architecture/source_text.hpp"

namespace lockstep::rooms_test {
namespace {

namespace fs = std::filesystem;

// A room and the rooms of the same folder on which it depends.
struct Room {
  std::string name;
  std::set<std::string> depends;
};

// A folder with rooms, in the order in which they are declared.
struct Folder {
  std::string name;
  std::vector<Room> rooms;

  const Room* find(const std::string& room) const {
    const auto found =
        std::find_if(rooms.begin(), rooms.end(), [&](const Room& one) { return one.name == room; });
    return found == rooms.end() ? nullptr : &*found;
  }
};

// Folders that are all rooms; and those that have rooms, of which scheduler has a floor besides. The floor
// may include its rooms, a room never the floor.
constexpr const char* kFoldersOfRooms[] = {"tech_objects", "hmi_bridge", "projects", "cli"};
constexpr const char* kFoldersWithRooms[] = {"tech_objects", "scheduler", "hmi_bridge", "projects", "cli"};

// Rooms that allocate, which nothing that the cycle reaches may include, and who may.
constexpr const char* kForTheDesk[] = {"tech_objects/cam_design/", "fb/checks/"};
constexpr const char* kInTheCycle[] = {"tech_objects", "fb", "scheduler"};

// Of tech_objects: what moves, on any controller; and what the kernel knows nothing of.
const std::set<std::string> kKernel = {"arithmetic",  "profile", "cam",
                                       "synchronous", "filters", "leading_values"};
const std::set<std::string> kOfTheController = {"jobs", "alarms", "data_blocks", "objects"};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The rooms that a CMakeLists.txt declares: lockstep_room(FOLDER ROOM DEPENDS...).
Folder folder_declared(const std::string& name, const std::string& text) {
  Folder folder{name, {}};
  const std::regex declaration("lockstep_room\\(" + name + "\\s+([^)]*)\\)");
  for (std::sregex_iterator found(text.begin(), text.end(), declaration); found != std::sregex_iterator();
       ++found) {
    std::istringstream words((*found)[1].str());
    Room room;
    words >> room.name;
    for (std::string word; words >> word;)
      if (folder.find(word) != nullptr) room.depends.insert(word);
    folder.rooms.push_back(std::move(room));
  }
  return folder;
}

Folder folder_of(const std::string& name) {
  return folder_declared(name, text_of(fs::path(LOCKSTEP_SOURCE_DIR) / name / "CMakeLists.txt"));
}

// "cam/function.hpp" → "cam"; empty for what stands on the floor of the folder.
std::string room_of(const std::string& below_folder) {
  const std::size_t slash = below_folder.find('/');
  return slash == std::string::npos ? "" : below_folder.substr(0, slash);
}

// What is wrong with the includes of a source in `room`, one a line.
std::string faults_of(const Folder& folder, const std::string& room, const std::string& path,
                      const std::string& text) {
  std::string faults;
  const Room* const own = folder.find(room);
  for (const Include& include : includes_of(text)) {
    if (!include.path.starts_with(folder.name + "/")) continue;
    const std::string other = room_of(include.path.substr(folder.name.size() + 1));
    const bool permitted =
        room.empty() || other == room || (own != nullptr && own->depends.count(other) != 0);
    if (!permitted)
      faults += path + ":" + std::to_string(include.line) + ": " + include.path + " is of a room that " +
                folder.name + "/" + room + " does not name\n";
  }
  return faults;
}

bool is_source(const fs::path& path) {
  return path.extension() == ".cpp" || path.extension() == ".hpp";
}

TEST(Rooms, IncludeOnlyThoseThatTheyName) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  for (const std::string name : kFoldersWithRooms) {
    const Folder folder = folder_of(name);
    EXPECT_GE(folder.rooms.size(), 2u) << name;
    for (const Room& room : folder.rooms)
      for (const fs::directory_entry& entry : fs::directory_iterator(root / name / room.name))
        if (is_source(entry.path())) {
          EXPECT_EQ(faults_of(folder, room.name, entry.path().string(), text_of(entry.path())), "");
        }
  }
}

TEST(Rooms, HoldEverySourceOfTheirFolder) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  for (const std::string name : kFoldersOfRooms) {
    const Folder folder = folder_of(name);
    for (const fs::directory_entry& entry : fs::directory_iterator(root / name)) {
      const std::string file = entry.path().filename().string();
      if (is_source(entry.path())) {
        EXPECT_EQ(name + "/" + file, "cli/main.cpp");
      }
    }
  }
}

// The sources of the cycle that include a room for the desk, one a line.
std::string reaches_of_the_desk(const std::string& path, const std::string& text) {
  const auto of_the_desk = [](const std::string& file) {
    return std::any_of(std::begin(kForTheDesk), std::end(kForTheDesk),
                       [&](const char* desk) { return file.starts_with(desk); });
  };
  if (of_the_desk(path)) return "";
  std::string reaches;
  for (const Include& include : includes_of(text))
    if (of_the_desk(include.path)) reaches += path + ":" + std::to_string(include.line) + "\n";
  return reaches;
}

TEST(Rooms, ForTheDeskAreOutOfReachOfTheCycle) {
  const fs::path root = LOCKSTEP_SOURCE_DIR;
  for (const char* desk : kForTheDesk) EXPECT_TRUE(fs::is_directory(root / desk)) << desk;
  for (const char* folder : kInTheCycle)
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string path = entry.path().lexically_relative(root).string();
      if (is_source(entry.path())) {
        EXPECT_EQ(reaches_of_the_desk(path, text_of(entry.path())), "");
      }
    }
}

TEST(Rooms, OfTheKernelDependOnTheKernelAlone) {
  const Folder folder = folder_of("tech_objects");
  for (const std::string& name : kKernel) {
    const Room* const room = folder.find(name);
    ASSERT_NE(room, nullptr) << name;
    for (const std::string& other : room->depends) EXPECT_TRUE(kKernel.count(other)) << name << ": " << other;
  }
}

TEST(Rooms, OfTheKernelNameNothingOfTheController) {
  const fs::path root = fs::path(LOCKSTEP_SOURCE_DIR) / "tech_objects";
  const std::regex of_the_controller("\\b(Job|JobKind|JobPhase|ErrorId|TO_Struct\\w*|TO_Cam\\w*)\\b");
  for (const std::string& room : kKernel)
    for (const fs::directory_entry& entry : fs::directory_iterator(root / room)) {
      if (!is_source(entry.path())) continue;
      const std::string text = text_of(entry.path());
      EXPECT_FALSE(std::regex_search(text, of_the_controller)) << entry.path();
      for (const Include& include : includes_of(text))
        for (const std::string& other : kOfTheController)
          EXPECT_FALSE(include.path.starts_with("tech_objects/" + other + "/"))
              << entry.path() << ':' << include.line;
    }
}

// The rules themselves, on sources that break them.

TEST(RoomRules, KnowWhatARoomDependsOn) {
  const Folder folder = folder_declared(
      "house", "lockstep_room(house cellar)\nlockstep_room(house kitchen cellar\n  lib::water roof)\n");
  ASSERT_EQ(folder.rooms.size(), 2u);
  EXPECT_EQ(folder.rooms[1].depends, std::set<std::string>{"cellar"});
}

TEST(RoomRules, RefuseARoomThatIsNotNamed) {
  const Folder folder =
      folder_declared("house", "lockstep_room(house cellar)\nlockstep_room(house kitchen cellar)\n");
  EXPECT_EQ(faults_of(folder, "kitchen", "a", "#include \"house/cellar/coal.hpp\"\n"), "");
  EXPECT_EQ(faults_of(folder, "kitchen", "a", "#include \"house/kitchen/oven.hpp\"\n"), "");
  EXPECT_EQ(faults_of(folder, "cellar", "a", "#include \"house/kitchen/oven.hpp\"\n"),
            "a:1: house/kitchen/oven.hpp is of a room that house/cellar does not name\n");
  EXPECT_NE(faults_of(folder, "kitchen", "a", "#include \"house/floor.hpp\"\n"), "");
}

TEST(RoomRules, RefuseTheDeskInTheCycleAndLetItUseTheDesk) {
  const std::string includes = "#include \"fb/pin.hpp\"\n#include \"tech_objects/cam_design/design.hpp\"\n";
  EXPECT_EQ(reaches_of_the_desk("fb/cam_in.cpp", includes), "fb/cam_in.cpp:2\n");
  EXPECT_EQ(reaches_of_the_desk("fb/checks/cam_in_check.cpp", includes), "");
}

}  // namespace
}  // namespace lockstep::rooms_test
