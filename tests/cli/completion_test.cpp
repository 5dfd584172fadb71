// lockstep completion: the scripts, carried out by the shells for which they are.
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "fb/block.hpp"
#include "tests/cli/command_run.hpp"

namespace lockstep::cli {
namespace {

/// The script of a shell, in a file.
std::string script(const Directory& folder, const std::string& shell) {
  const Ended ended = lockstep({"completion", shell});
  EXPECT_EQ(ended.status, 0) << ended.err;
  folder.write(shell, ended.out);
  return folder.file(shell);
}

/// What a bash offers for a line whose last word is being written.
std::set<std::string> offered(const std::string& line) {
  const Directory folder;
  std::string words;
  int count = 0;
  std::istringstream list(line);
  for (std::string word; list >> word; ++count) words += " '" + word + "'";
  if (line.ends_with(' ')) {
    words += " ''";
    ++count;
  }
  const Ended ended =
      run({"bash", "-c",
           "cd '" + folder.file("") + "' && touch machine.json && . '" + script(folder, "bash") +
               "' && COMP_WORDS=(" + words + ") && COMP_CWORD=" + std::to_string(count - 1) +
               " && _lockstep && printf '%s\\n' \"${COMPREPLY[@]}\""});
  EXPECT_EQ(ended.status, 0) << ended.err;
  std::set<std::string> result;
  std::istringstream lines(ended.out);
  for (std::string one; std::getline(lines, one);) result.insert(one);
  return result;
}

/// The commands that the help of one lists; of `lockstep` itself if it is empty.
std::vector<std::string> commands_of(const std::string& command) {
  std::vector<std::string> words;
  if (!command.empty()) words.push_back(command);
  words.emplace_back("--help");
  std::istringstream help(lockstep(words).out);
  std::vector<std::string> commands;
  std::string line;
  while (std::getline(help, line) && line != "Subcommands:") continue;
  while (std::getline(help, line) && !line.empty())
    if (line.rfind("   ", 0) != 0)  // of a meaning, what does not fit its first line
      commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  return commands;
}

TEST(Completion, OfBashOffersEachCommand) {
  const std::set<std::string> commands = offered("lockstep ");
  const std::vector<std::string> told = commands_of("");
  for (const std::string& command : told) EXPECT_TRUE(commands.contains(command)) << command;
  EXPECT_GE(told.size(), 16u);
  EXPECT_EQ(offered("lockstep che"), std::set<std::string>{"check"});
  EXPECT_TRUE(offered("lockstep --v").contains("--version"));
}

/// Each option that `--help` tells is offered, of every command.
TEST(Completion, OfBashOffersEachOption) {
  std::vector<std::string> commands;
  for (const std::string& command : commands_of("")) {
    const std::vector<std::string> parts = commands_of(command);
    if (parts.empty()) commands.push_back(command);
    for (const std::string& part : parts) commands.push_back(command + " " + part);
  }
  EXPECT_GE(commands.size(), 24u);
  for (const std::string& command : commands) {
    std::vector<std::string> words;
    std::istringstream parts(command);
    for (std::string part; parts >> part;) words.push_back(part);
    words.emplace_back("--help");
    std::istringstream help(lockstep(words).out);
    const std::set<std::string> options = offered("lockstep " + command + " --");
    std::size_t told = 0;
    for (std::string line; std::getline(help, line);) {
      const std::size_t begin = line.find("--");
      if (line.rfind("  -", 0) != 0 || begin == line.npos) continue;
      const std::string option = line.substr(begin, line.find_first_of(" ,=:{", begin) - begin);
      EXPECT_TRUE(options.contains(option)) << command << " " << option;
      ++told;
    }
    EXPECT_GE(told, 1u) << command;
  }
}

TEST(Completion, OfBashOffersValuesFilesAndNames) {
  EXPECT_EQ(offered("lockstep cam convert --as d"), (std::set<std::string>{"design", "data"}));
  EXPECT_EQ(offered("lockstep check m"), std::set<std::string>{"machine.json"});
  EXPECT_EQ(offered("lockstep run machine.json --trace m"), std::set<std::string>{"machine.json"});
  EXPECT_EQ(offered("lockstep completion f"), std::set<std::string>{"fish"});
  EXPECT_TRUE(offered("lockstep cam ").contains("info"));
  EXPECT_EQ(offered("lockstep describe MC_GearInP"), std::set<std::string>{"MC_GearInPos"});
  const std::set<std::string> names = offered("lockstep describe ");
  for (const BlockType& type : block_types())
    EXPECT_TRUE(names.contains(std::string(type.name))) << type.name;
  EXPECT_TRUE(names.contains("SEL"));
}

TEST(Completion, OfTheOtherShellsIsReadByThem) {
  const Directory folder;
  const Ended zsh = run({"zsh", "-n", script(folder, "zsh")});
  EXPECT_EQ(zsh.status, 0) << zsh.err;
  const Ended fish = run({"fish", "--no-execute", script(folder, "fish")});
  EXPECT_EQ(fish.status, 0) << fish.err;
}

/// Of fish, which can be asked from outside.
TEST(Completion, OfFishOffersCommandsOptionsAndValues) {
  const Directory folder;
  const auto offered_by_fish = [&](const std::string& line) {
    return run({"env", "HOME=" + folder.file(""), "fish", "--no-config", "-c",
                "source '" + script(folder, "fish") + "'; complete -C '" + line + "'"})
        .out;
  };
  EXPECT_EQ(offered_by_fish("lockstep che").rfind("check\t", 0), 0u) << offered_by_fish("lockstep che");
  EXPECT_NE(offered_by_fish("lockstep run --tr").find("--trace\t"), std::string::npos);
  EXPECT_NE(offered_by_fish("lockstep cam in").find("info\t"), std::string::npos);
  EXPECT_NE(offered_by_fish("lockstep cam convert --as des").find("design"), std::string::npos);
  EXPECT_NE(offered_by_fish("lockstep describe MC_GearInP").find("MC_GearInPos"), std::string::npos);
  const std::string commands = "\n" + offered_by_fish("lockstep ");
  for (const std::string& command : commands_of(""))
    EXPECT_NE(commands.find("\n" + command + "\t"), std::string::npos) << command;
}

/// What a zsh offers at a terminal, where a line is written and the tab key pressed.
constexpr char kAsk[] = R"zsh(zmodload zsh/zpty
zpty ask zsh -f -i
zpty -w ask "PROMPT=; PS2=; out=$3
autoload -U compinit && compinit -u -D; source $1; compdef _lockstep lockstep
compadd() {
  typeset -a hits
  if [[ \${@[1,(i)(-|--)]} != *-(O|A|D)\ * ]]; then
    builtin compadd -A hits \"\$@\"
    (( \${#hits} )) && print -rl -- \$hits >> \$out
  fi
  builtin compadd \"\$@\"
}
comppostfuncs=(ended); ended() { print -r -- . >> \$out; exit }
bindkey '^I' complete-word; : > \$out.ready"
repeat 1200; do [[ -e $3.ready ]] && break; zpty -r -t ask said; sleep 0.05; done
zpty -w -n ask "$2"$'\t'
repeat 1200; do grep -qsx '[.]' $3 && break; zpty -r -t ask said; sleep 0.05; done
zpty -d ask
)zsh";

TEST(Completion, OfZshOffersCommandsOptionsAndValues) {
  const Directory folder;
  const std::string asked = folder.write("ask.zsh", kAsk), completion = script(folder, "zsh");
  int question = 0;
  const auto offered_by_zsh = [&](const std::string& line) {
    const std::string answer = folder.file("answer" + std::to_string(++question));
    const Ended ended =
        run({"env", "HOME=" + folder.file(""), "TERM=dumb", "zsh", "-f", asked, completion, line, answer});
    EXPECT_EQ(ended.status, 0) << ended.err;
    std::set<std::string> words;
    std::istringstream lines(content(answer));
    for (std::string word; std::getline(lines, word);)
      if (word != ".") words.insert(word);
    return words;
  };
  const std::set<std::string> commands = offered_by_zsh("lockstep ");
  for (const std::string& command : commands_of("")) EXPECT_TRUE(commands.contains(command)) << command;
  EXPECT_EQ(offered_by_zsh("lockstep che"), std::set<std::string>{"check"});
  EXPECT_EQ(offered_by_zsh("lockstep run --tra"), (std::set<std::string>{"--trace", "--transcript"}));
  EXPECT_EQ(offered_by_zsh("lockstep cam in"), std::set<std::string>{"info"});
  EXPECT_EQ(offered_by_zsh("lockstep cam convert --as d"), (std::set<std::string>{"data", "design"}));
  EXPECT_EQ(offered_by_zsh("lockstep describe MC_GearInP"), std::set<std::string>{"MC_GearInPos"});
}

TEST(Completion, OfZshHasEachCommandAndItsOptions) {
  const std::string text = lockstep({"completion", "zsh"}).out;
  EXPECT_EQ(text.rfind("#compdef lockstep\n", 0), 0u);
  for (const char* part :
       {"_lockstep_run() {", "_lockstep_cam_info() {", "'--trace[", "(design data points)"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(Completion, OfAShellThatIsNotKnownIsRefused) {
  EXPECT_EQ(lockstep({"completion", "tcsh"}).status, 2);
  EXPECT_EQ(lockstep({"completion"}).status, 2);
}

}  // namespace
}  // namespace lockstep::cli
