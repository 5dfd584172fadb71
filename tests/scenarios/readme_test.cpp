// The walk through a first project in the README does what it says, and its links lead somewhere.
#include <gtest/gtest.h>

#include <memory>
#include <regex>
#include <string>

#include "tests/scenarios/csv_table.hpp"
#include "tests/scenarios/modbus_client.hpp"

namespace lockstep::test::readme_test {
namespace {

const std::string kSource = LOCKSTEP_SOURCE_DIR "/";

/// A fenced block of the README with the mark before it: `<!-- tested: MARK -->`.
struct Block {
  std::string mark;
  std::string text;
};

std::vector<Block> marked_blocks(const std::string& document) {
  std::vector<Block> blocks;
  std::istringstream lines(document);
  const std::string begin = "<!-- tested: ";
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(begin, 0) != 0) continue;
    Block block{line.substr(begin.size(), line.find(" -->") - begin.size()), ""};
    std::getline(lines, line);
    EXPECT_EQ(line.rfind("```", 0), 0u) << "no block after the mark " << block.mark;
    while (std::getline(lines, line) && line != "```") block.text += line + "\n";
    blocks.push_back(block);
  }
  return blocks;
}

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
    std::string script = "cd " + directory_.file("") + "\n" + commands;
    script = replaced(script, "build/release/lockstep", LOCKSTEP_PROGRAM);
    return {"bash", "-e", "-c", replaced(script, "-p 1502", "-p " + std::to_string(port_))};
  }
  void carry_out(const std::string& commands, int status) {
    Process process(shell(commands));
    EXPECT_EQ(process.status(), status) << commands << process.out() << process.err();
    written_ = process.out() + process.err();
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
  std::string written_;
  int port_ = 1502;
};

TEST(Readme, TheFirstProjectInTenMinutesDoesWhatItSays) {
  const std::string document = content(kSource + "README.md");
  const std::vector<Block> blocks = marked_blocks(document);
  EXPECT_EQ(blocks.size(), 11u) << "the walk of the README";
  const std::regex fence("\n```[a-z]+\n");
  const auto fences = std::distance(std::sregex_iterator(document.begin(), document.end(), fence), {});
  EXPECT_EQ(static_cast<std::size_t>(fences) + 2, blocks.size())
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

TEST(Readme, TheCommandsOfDevThatItNamesAreThere) {
  Process help({"bash", kSource + "dev", "help"});
  ASSERT_EQ(help.status(), 0) << help.err();
  for (const char* command : {"./dev demo", "./dev test", "./dev build", "./dev bench"})
    EXPECT_NE(help.out().find(command), std::string::npos) << command;
}

}  // namespace
}  // namespace lockstep::test::readme_test
