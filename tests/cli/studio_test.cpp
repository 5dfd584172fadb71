// lockstep run --studio, as a user calls it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/cli/command_run.hpp"
#include "tests/projects/studio_machine.hpp"

namespace lockstep::studio_test {
namespace {

using cli::Directory;
using cli::Ended;
using cli::lockstep;
using test::content;

const std::string kKnife = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";

TEST(Studio, DoesNotChangeABitOfASimulation) {
  const Directory folder;
  const auto simulate = [&](const std::string& trace, std::vector<std::string> more) {
    std::vector<std::string> command = {"run", kKnife, "--simulate", "--duration", "2s", "--trace", trace};
    command.insert(command.end(), more.begin(), more.end());
    return lockstep(command);
  };
  ASSERT_EQ(simulate(folder.file("without.csv"), {}).status, 0);
  const Ended with = simulate(folder.file("with.csv"), {"--studio", "127.0.0.1:0"});
  ASSERT_EQ(with.status, 0) << with.err;
  EXPECT_NE((with.out + with.err).find("studio on http://127.0.0.1:"), std::string::npos) << with.err;
  const std::string trace = content(folder.file("without.csv"));
  EXPECT_GT(trace.size(), 10'000u);
  EXPECT_EQ(content(folder.file("with.csv")), trace);
}

TEST(Studio, SaysAtTheStartWhatPagesMay) {
  const std::string plain = LOCKSTEP_SOURCE_DIR "/projects/01_positioning/project.json";
  const auto rights = [](std::vector<std::string> run) {
    run.insert(run.begin(), "run");
    run.insert(run.end(), {"--studio", "127.0.0.1:0", "--duration", "20ms", "--no-lcm", "--no-modbus"});
    const Ended ended = lockstep(run);
    EXPECT_EQ(ended.status, 0) << ended.err;
    const std::string line =
        ended.err.substr(std::min(ended.err.find("studio on http://"), ended.err.size()));
    return line.substr(0, line.find('\n')).substr(line.rfind('/', line.find('\n')) + 1);
  };
  EXPECT_EQ(rights({plain}), "");
  EXPECT_EQ(rights({plain, "--studio-write"}), ", whose pages may write");
  EXPECT_EQ(rights({kKnife}), ", whose pages may write, and command Knife, Conveyor");
  EXPECT_EQ(rights({kKnife, "--simulate"}), ", whose pages may write");
}

TEST(Studio, IsRefusedWhereStrangersCouldLook) {
  const Ended open = lockstep({"run", kKnife, "--simulate", "--duration", "10ms", "--studio", "0.0.0.0:0"});
  EXPECT_EQ(open.status, 2);
  EXPECT_NE(open.err.find("--studio-token-file"), std::string::npos) << open.err;
  const Directory folder;
  const std::string token = folder.write("token", "0123456789abcdef0123456789abcdef\n");
  const Ended readable = lockstep({"run", kKnife, "--simulate", "--duration", "10ms", "--studio",
                                   "127.0.0.1:0", "--studio-token-file", token});
  EXPECT_EQ(readable.status, 2);
  EXPECT_NE(readable.err.find("chmod 600"), std::string::npos) << readable.err;
}

TEST(Studio, NeedsAnEndpointThatIsOne) {
  EXPECT_EQ(lockstep({"run", kKnife, "--simulate", "--duration", "10ms", "--studio", "127.0.0.1"}).status, 2);
  EXPECT_EQ(lockstep({"run", kKnife, "--simulate", "--duration", "10ms", "--studio", "nowhere:0"}).status, 2);
}

TEST(Studio, EndsWhereItsPortIsTaken) {
  const int taken = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(taken, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(taken, 1), 0);
  ASSERT_EQ(::getsockname(taken, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const std::string place = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  const Ended ended = lockstep({"run", kKnife, "--simulate", "--duration", "10ms", "--studio", place});
  ::close(taken);
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find(place), std::string::npos) << ended.err;
}

TEST(Studio, ExportsWhatATraceWritesToTheBit) {
  const Directory folder;
  const std::string file = folder.file("trace.csv");
  const std::string signals = "Knife.Position,Conveyor.Velocity,gear.InSync,Knife.StatusWord,cuts";
  ASSERT_EQ(lockstep({"run", kKnife, "--simulate", "--duration", "2s", "--signals", signals, "--trace", file})
                .status,
            0);
  const std::string written = content(file);

  test::StudioMachine machine(kKnife);
  test::StudioPage page;
  machine.session.opened(page);
  machine.session.text(page, R"({"type":"hello"})");
  machine.session.text(page, R"({"type":"subscribe","id":1,"paths":["Knife.Position","Conveyor.Velocity",
    "gear.InSync","Knife.StatusWord","cuts"]})");
  machine.run(1900);
  const StudioAnswer answer = machine.ask("GET", "/api/traces/live/export", {{"signals", signals}});
  ASSERT_EQ(answer.status, 200u) << answer.body;
  EXPECT_EQ(answer.type, "text/csv; charset=utf-8");
  const std::size_t head = answer.body.find('\n') + 1;
  EXPECT_EQ(answer.body.substr(0, head), written.substr(0, written.find('\n') + 1));
  EXPECT_GT(std::count(answer.body.begin(), answer.body.end(), '\n'), 900);
  EXPECT_NE(written.find("\n" + answer.body.substr(head)), std::string::npos) << "row by row the same text";
}

}  // namespace
}  // namespace lockstep::studio_test
