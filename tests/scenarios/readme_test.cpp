// The walk through a first project in the README does what it says, and its links lead somewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "tests/scenarios/csv_table.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/support/marked_blocks.hpp"

namespace lockstep::test::readme_test {
namespace {

const std::string kSource = LOCKSTEP_SOURCE_DIR "/";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// Goes through the blocks as a reader does, in a directory of its own, and with a free port.
class Reader {
 public:
  void read(const Block& block) {
    if (block.mark.rfind("file ", 0) == 0) return write(block.mark.substr(5), block.text);
    if (block.mark == "beside") return start(block.text);
    if (block.mark == "output") {
      EXPECT_NE(written_.find(block.text), std::string::npos) << block.text << "was told otherwise:\n"
                                                              << written_;
      return;
    }
    if (block.mark == "alarm") return expect_lines(block.text);
    if (block.mark == "commands") return carry_out(block.text, 0);
    if (block.mark == "commands, status 1") return carry_out(block.text, 1);
    FAIL() << "unknown mark " << block.mark;
  }
  std::string file(const std::string& name) const { return directory_.file(name); }
  int port() const { return port_; }
  void interrupt() {
    ASSERT_NE(beside_, nullptr) << "nothing was to be run beside";
    beside_->send(SIGINT);
    EXPECT_EQ(beside_->status(), 0) << beside_->err();
  }

 private:
  void write(const std::string& name, const std::string& text) {
    directory_.write(name, replaced(text, "127.0.0.1:1502", "127.0.0.1:0"));
  }
  std::vector<std::string> shell(const std::string& commands) const {
    // What the package brings is that of the sources here; the test of the package runs it as it is.
    std::string script = "cd " + directory_.file("") +
                         "\napt() { :; }\nPATH=$(dirname " LOCKSTEP_PROGRAM "):$PATH\n" +
                         replaced(commands, "/usr/share/lockstep/", kSource);
    return {"bash", "-e", "-c", replaced(script, "-p 1502", "-p " + std::to_string(port_))};
  }
  void carry_out(const std::string& commands, int status) {
    Process process(shell(commands));
    EXPECT_EQ(process.status(), status) << commands << process.out() << process.err();
    written_ = process.out() + process.err();
    said_ += written_;
  }
  /// Each line stands in what the commands so far have said.
  void expect_lines(const std::string& text) const {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      EXPECT_NE(said_.find(line), std::string::npos) << line << "\n" << said_;
  }
  void start(const std::string& command) {
    beside_ = std::make_unique<Process>(shell("exec " + command));
    std::smatch match;
    std::string text;
    ASSERT_TRUE(wait_until([&] {
      text = beside_->err();
      return std::regex_search(text, match, std::regex("Modbus server on 127.0.0.1:([0-9]+)\n"));
    })) << text;
    port_ = std::stoi(match[1]);
  }

  Directory directory_;
  std::unique_ptr<Process> beside_;
  std::string written_;  ///< by the last commands
  std::string said_;     ///< by all of them
  int port_ = 1502;
};

TEST(Readme, TheFirstProjectInTenMinutesDoesWhatItSays) {
  const std::string document = content(kSource + "README.md");
  const std::vector<Block> blocks = marked_blocks(document);
  EXPECT_EQ(blocks.size(), 17u) << "the walk of the README; the program in Python is run by its tests";
  const std::regex fence("\n```[a-z]+\n");
  const auto fences = std::distance(std::sregex_iterator(document.begin(), document.end(), fence), {});
  EXPECT_EQ(static_cast<std::size_t>(fences) + 3, blocks.size())
      << "every block is tested; those of outputs name no language";
  Reader reader;
  for (const Block& block : blocks) reader.read(block);
  EXPECT_EQ(ModbusClient(reader.port()).holding_float(0), 80.0F) << "what mbpoll wrote";
  reader.interrupt();

  const CsvTable table = read_csv(reader.file("first.csv"));
  EXPECT_EQ(table.rows, 2000u);
  double belt = 0.0;
  double drum = 0.0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    belt += table["Belt.Position"][i] - table["Belt.Position"][i - 1];
    drum += ring_distance(table["Drum.Position"][i], table["Drum.Position"][i - 1], 360.0);
    ASSERT_NEAR(drum, belt * 7.0 / 3.0, 1e-9);
  }
  EXPECT_GT(belt, 100.0);
  EXPECT_EQ(table["Belt.Velocity"].back(), 0.0) << "the operator of the stimuli has stopped it";
  EXPECT_EQ(table["gear.InGear"].back(), 1.0);
  EXPECT_GT(read_csv(reader.file("real.csv")).rows, 0u);
}

/// What a stranger does who has read the README: the flying shear in it.
class FlyingShear : public ::testing::Test {
 protected:
  FlyingShear() {
    for (const Block& block : marked_blocks(content(kSource + "README.md")))
      if (block.mark == "file shear.json") directory_.write("shear.json", block.text);
  }
  Process run() const {
    return Process({LOCKSTEP_PROGRAM, "run", directory_.file("shear.json"), "--simulate", "--duration", "20s",
                    "--trace", directory_.file("shear.csv")});
  }

  Directory directory_;
};

TEST_F(FlyingShear, CutsPiecesOfOneLengthBeforeAndAfterItHasJammed) {
  Process process = run();
  ASSERT_EQ(process.status(), 0) << process.err();
  const CsvTable table = read_csv(directory_.file("shear.csv"));
  std::vector<double> cuts;  // the place of the web, with its turns, at which the blade comes down
  double web = 0.0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    web += ring_distance(table["Web.Position"][i], table["Web.Position"][i - 1], 600.0);
    if (table["t"][i] > 11.0 && table["t"][i] < 12.0) {
      ASSERT_EQ(table["Web.Position"][i], table["Web.Position"][i - 1])
          << "acknowledged, but not yet started";
      ASSERT_EQ(table["Shear.Velocity"][i], 0.0) << "acknowledged, but not yet started";
    }
    if (table["blade"][i] == 0.0) continue;
    ASSERT_NEAR(table["Shear.Velocity"][i], 200.0, 1e-6) << "it runs along while the blade is down";
    if (table["blade"][i - 1] == 0.0) cuts.push_back(web);
  }
  ASSERT_GE(cuts.size(), 5u);
  EXPECT_EQ(static_cast<double>(cuts.size()), table["cuts.CV"].back());
  for (std::size_t i = 1; i < cuts.size(); ++i)
    EXPECT_NEAR(cuts[i] - cuts[i - 1], 600.0, 1.0)
        << "piece " << i << ", to the cycle in which the blade falls";
}

/// An operator stops it and starts it again, wherever it is just then.
TEST_F(FlyingShear, BearsToBeStoppedAndStartedAnywhere) {
  const nlohmann::json project = nlohmann::json::parse(content(directory_.file("shear.json")));
  for (const double stop : {0.8, 1.0, 1.3, 1.8, 2.1, 2.2, 2.3, 2.6, 3.1, 4.2}) {
    nlohmann::json stopped = project;
    stopped["stimuli"] = {{{"at", "0.5s"}, {"set", {{"start", true}}}},
                          {{"at", std::to_string(stop) + "s"}, {"set", {{"start", false}}}},
                          {{"at", std::to_string(stop + 1.5) + "s"}, {"set", {{"start", true}}}}};
    directory_.write("shear.json", stopped.dump());
    Process process = run();
    ASSERT_EQ(process.status(), 0) << process.err();
    EXPECT_EQ(process.err().find("alarm"), std::string::npos) << process.err();
    const CsvTable table = read_csv(directory_.file("shear.csv"));
    EXPECT_LT(std::ranges::max(table["Shear.Position"]), 300.0) << stop;
    EXPECT_GE(table["cuts.CV"].back(), 5.0) << stop;
    double web = 0.0, cut = 0.0;
    for (std::size_t i = 1; i < table.rows; ++i) {
      web += ring_distance(table["Web.Position"][i], table["Web.Position"][i - 1], 600.0);
      if (table["blade"][i] == 0.0 || table["blade"][i - 1] != 0.0) continue;
      if (cut != 0.0) {
        EXPECT_NEAR(web - cut, 600.0, 1.0) << "stopped at " << stop << " s, cut at " << web;
      }
      cut = web;
    }
  }
}

TEST_F(FlyingShear, TellsOnTheConsoleWhatHasHappenedAndWhereToReadOn) {
  Process process = run();
  ASSERT_EQ(process.status(), 0) << process.err();
  const std::string said = process.err();
  const std::size_t at = said.find("Shear: alarm 521");
  ASSERT_NE(at, std::string::npos) << said;
  const std::string told = said.substr(at, said.find("lockstep: ", at) - at);
  for (const char* part : {"cause: ", "remedy: "})
    EXPECT_NE(told.find(part), std::string::npos) << part << "\n" << told;
  EXPECT_EQ(said.find("alarm 521", at + 20), std::string::npos) << "it comes once\n" << said;
  EXPECT_NE(said.find("Shear: alarms acknowledged", at), std::string::npos) << said;
  Process described({LOCKSTEP_PROGRAM, "describe", "521"});
  ASSERT_EQ(described.status(), 0);
  for (const char* part : {"ollowing error", "MC_Reset"})
    EXPECT_NE(described.out().find(part), std::string::npos) << part << "\n" << described.out();
}

TEST_F(FlyingShear, IsDrawnInTheUnitsOfItsAxes) {
  Process process = run();
  ASSERT_EQ(process.status(), 0) << process.err();
  Process drawn({LOCKSTEP_PROGRAM, "plot", directory_.file("shear.csv"), "--project",
                 directory_.file("shear.json"), "-o", directory_.file("shear.svg")});
  ASSERT_EQ(drawn.status(), 0) << drawn.err();
  const std::string picture = content(directory_.file("shear.svg"));
  EXPECT_NE(picture.find("mm/s"), std::string::npos);
  EXPECT_EQ(picture.find("[u"), std::string::npos) << "a unit that is none";
}

TEST_F(FlyingShear, IsWrittenWithWordsThatTheReferenceKnows) {
  const std::string project = content(directory_.file("shear.json"));
  std::size_t words = 0;
  const std::regex block(R"x("fb": "([A-Z_a-z]+)")x");
  const std::regex word(R"(\b(AND|OR|NOT|BOOL)\b)");
  const auto expect_described = [&](const std::regex& pattern) {
    for (std::sregex_iterator found(project.begin(), project.end(), pattern), end; found != end;
         ++found, ++words) {
      Process described({LOCKSTEP_PROGRAM, "describe", (*found)[1].str()});
      EXPECT_EQ(described.status(), 0) << described.err();
    }
  };
  expect_described(block);
  expect_described(word);
  EXPECT_GT(words, 15u);
}

/// What stands before the first project is what one sees first: it fits a screen.
TEST(Readme, SaysOnOneScreenWhatItIsAndHowItIsRun) {
  const std::string document = content(kSource + "README.md");
  const std::string first = document.substr(0, document.find("\n## Your first project"));
  constexpr std::ptrdiff_t kScreen = 40;
  EXPECT_LE(std::count(first.begin(), first.end(), '\n'), kScreen);
  EXPECT_NE(first.find("apt install ./lockstep_"), std::string::npos);
}

TEST(Readme, ThoseOfTheFoldersAndThisOneLinkToFilesThatAreThere) {
  std::size_t links = 0;
  const std::regex link(R"(\]\(([^)#]+)(#[^)]*)?\))");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource)) {
    const std::filesystem::path& path = entry.path();
    if (path.string().rfind(kSource + "build", 0) == 0 || path.extension() != ".md") continue;
    const std::string document = content(path);
    for (std::sregex_iterator match(document.begin(), document.end(), link), end; match != end; ++match) {
      const std::string target = (*match)[1];
      if (target.rfind("http", 0) == 0) continue;
      EXPECT_TRUE(std::filesystem::exists(path.parent_path() / target)) << path << " → " << target;
      ++links;
    }
  }
  EXPECT_GT(links, 10u);
}

/// The indented block of which a part is known, without its indentation.
std::string block_with(const std::string& document, const std::string& part) {
  const std::size_t at = document.find(part);
  if (at == std::string::npos) return "";
  const std::size_t begin = document.rfind("\n\n", at) + 2;
  return replaced("\n" + document.substr(begin, document.find("\n\n", at) - begin), "\n    ", "\n");
}

/// Settings of an editor for the package, which installs the schemas beside the examples' documents.
TEST(Readme, ItsSettingsOfAnEditorNameSchemasThatAreThere) {
  const std::string document = content(kSource + "README.md");
  const nlohmann::json settings =
      nlohmann::json::parse("{" + block_with(document, "\"json.schemas\"") + "}", nullptr, false);
  ASSERT_TRUE(settings.is_object()) << block_with(document, "\"json.schemas\"");
  const nlohmann::json schemas = settings.at("json.schemas"), comments = settings.at("files.associations");
  EXPECT_GE(schemas.size(), 3u);
  for (const nlohmann::json& one : schemas) {
    const std::string url = one.at("url");
    EXPECT_TRUE(url.starts_with("file:///usr/share/lockstep/")) << url;
    EXPECT_TRUE(std::filesystem::exists(kSource + "projects/" + url.substr(url.rfind('/') + 1))) << url;
    EXPECT_FALSE(one.at("fileMatch").empty());
  }
  for (const nlohmann::json& kind : comments) EXPECT_EQ(kind, "jsonc");
  std::size_t named = 0;
  const std::regex schema(R"(([a-z]+\.schema\.json))");
  for (std::sregex_iterator match(document.begin(), document.end(), schema), end; match != end;
       ++match, ++named)
    EXPECT_TRUE(std::filesystem::exists(kSource + "projects/" + (*match)[1].str())) << (*match)[1];
  EXPECT_GE(named, 6u);
}

TEST(Readme, TheCommandsOfDevThatItNamesAreThere) {
  Process help({"bash", kSource + "dev", "help"});
  ASSERT_EQ(help.status(), 0) << help.err();
  for (const char* command : {"./dev demo", "./dev test", "./dev build", "./dev bench"})
    EXPECT_NE(help.out().find(command), std::string::npos) << command;
}

}  // namespace
}  // namespace lockstep::test::readme_test
