// lockstep run with a panel: a client on the network enables, jogs and lets go.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <sstream>

#include "hmi_bridge/lcm/commands.hpp"
#include "hmi_bridge/lcm/receiver.hpp"
#include "tests/cli/command_run.hpp"
#include "tests/hmi_bridge/own_network.hpp"
#include "tests/support/datagrams.hpp"

namespace lockstep::run_commands_test {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0";

/// A machine with one axis that no program moves.
std::string project(const std::string& commands) {
  return R"({ "lockstep": 1, "name": "panel", "clock": { "servo_cycle": "2ms" },
    "technology_objects": { "Slide": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
      "DynamicDefaults": { "Velocity": 40.0, "Acceleration": 1000.0, "Deceleration": 1000.0, "Jerk": 0.0 } } } },
    "trace": { "lcm": { "url": "udpm://239.255.76.67:7667?ttl=0", "channel": "SLIDE")" +
         commands + R"( }, "signals": [ "Slide.Position", "Slide.VelocitySetpoint" ] } })";
}

/// A panel of its own, with what it hears.
class Client {
 public:
  Client()
      : joined_(kUrl, LcmTraceIdentity{"client", "CLIENT", 0, 0}, false),
        receiver_(joined_, "", LcmBounds{}, [this](const LcmMessage& message) { take(message); }) {}
  /// Listens until something holds; false at the deadline.
  bool hear_until(const std::function<bool()>& condition, std::chrono::milliseconds limit = kDeadline) {
    const auto deadline = SteadyClock::now() + limit;
    while (!condition() && SteadyClock::now() < deadline) {
      pollfd source{receiver_.descriptor(), POLLIN, 0};
      if (poll(&source, 1, 10) > 0) receiver_.take(100);
    }
    return condition();
  }
  void send(std::int32_t action, double value = 0.0) {
    command_t command{};
    command.run = state.run;
    command.beat = state.beat;
    command.sender = 5;
    command.sequence = ++sequence_;
    command.action = action;
    command.value = value;
    command.axis = axis;
    send(encoded(command));
  }
  void send(const std::vector<std::uint8_t>& bytes) {
    last = bytes;
    lcm_publish(joined_.instance(), "SLIDE_CMD", bytes.data(), static_cast<unsigned>(bytes.size()));
  }
  /// Waits for an answer or another event of a kind with a part in its text. @return the event
  event_t event(const std::string& kind, const std::string& part = "") {
    const auto fits = [&](const event_t& event) {
      return event.kind == kind && (event.text + event.type).find(part) != std::string::npos;
    };
    const auto found = [&] { return std::find_if(events.begin(), events.end(), fits); };
    EXPECT_TRUE(hear_until([&] { return found() != events.end(); })) << "no " << kind << " " << part;
    if (found() == events.end()) return {};
    event_t taken = *found();
    events.erase(found());
    return taken;
  }

  std::string axis = "Slide";
  panel_t state{};
  std::uint64_t states = 0, rows = 0;
  std::vector<event_t> events;
  std::vector<std::uint8_t> last;

 private:
  void take(const LcmMessage& message) {
    if (!message.channel.starts_with("SLIDE")) return;
    if (const auto event = decode_event(message.data)) events.push_back(*event);
    if (message.channel == "SLIDE") ++rows;
    const auto heard = decode_panel(message.data);
    if (!heard) return;
    state = *heard;
    ++states;
  }

  LcmPublisher joined_;
  LcmReceiver receiver_;
  std::int64_t sequence_ = 0;
};

std::vector<std::string> run_of(const std::string& file, const std::string& errors,
                                const std::string& trace = "") {
  return {"sh",
          "-c",
          R"(exec "$0" run "$1" --no-modbus --no-retain ${3:+--trace "$3"} 2>"$2")",
          LOCKSTEP_EXECUTABLE,
          file,
          errors,
          trace};
}

TEST(RunCommands, APanelEnablesJogsHomesAndTheJogStopsWhenItFallsSilent) {
  in_own_network([] {
    bring_up_network();
    const cli::Directory folder;
    const std::string file = folder.write(
        "project.json", project(R"(, "commands": { "axes": { "Slide": { "jog_velocity": 20.0 } } })"));
    ForeignProgram run(run_of(file, folder.file("err")));
    Client client;
    ASSERT_TRUE(client.hear_until([&] { return client.states > 0; })) << cli::content(folder.file("err"));
    EXPECT_EQ(client.state.axis, "Slide");
    EXPECT_EQ(client.state.jog_velocity, 20.0);

    client.send(command_t::JOG_FORWARD, 10.0);  // not enabled: the block says so
    EXPECT_EQ(client.event("job failed", "MC_MoveJog").number, 0x800F);
    const std::int64_t then = client.state.t;  // until that jog has been let go
    ASSERT_TRUE(client.hear_until([&] { return client.state.t > then + 600'000'000; }));

    client.send(command_t::ENABLE);
    EXPECT_EQ(client.event("command accepted", "enable").source, "Slide");
    ASSERT_TRUE(client.hear_until([&] { return (client.state.status_word & 1) != 0; }));

    // Held: a command every 50 ms.
    ASSERT_TRUE(client.hear_until([&, due = SteadyClock::now()]() mutable {
      if (SteadyClock::now() >= due) {
        client.send(command_t::JOG_FORWARD, 10.0);
        due += 50ms;
      }
      return client.state.velocity == 10.0;
    }));
    EXPECT_EQ(client.event("job started", "MC_MoveJog").source, "panel.Slide.jog");
    // Let go without a word: it stands after 300 ms and the ramp, of which the states tell within 100 ms.
    ASSERT_TRUE(client.hear_until([&] { return client.state.velocity == 0.0; }, 30s));
    const double rest = client.state.position;
    EXPECT_GT(rest, 0.0);
    const std::uint64_t seen = client.states;
    ASSERT_TRUE(client.hear_until([&] { return client.states > seen + 5; }));
    EXPECT_EQ(client.state.position, rest);

    client.send(command_t::HOME, -7.5);
    ASSERT_TRUE(client.hear_until([&] { return client.state.position == -7.5; }));
    client.send(command_t::OVERRIDE, 60.0);
    ASSERT_TRUE(client.hear_until([&] { return client.state.speed == 60.0; }));
    const std::vector<std::uint8_t> once = client.last;
    client.send(once);
    client.event("command refused", "repeated");
    client.send(command_t::JOG_FORWARD, 20.5);
    client.event("command refused", "velocity 20.5 is not permitted; allowed: above 0, up to 20");
    client.send(std::vector<std::uint8_t>(100, 'x'));
    client.event("command refused", "not a command");
    client.send(command_t::DISABLE);
    ASSERT_TRUE(client.hear_until([&] { return (client.state.status_word & 1) == 0; }));

    run.interrupt();
    EXPECT_EQ(run.status(), 0);
    const std::string told = cli::content(folder.file("err"));
    EXPECT_NE(told.find("commands from panels on udpm://239.255.76.67:7667?ttl=0, channel SLIDE_CMD: Slide"),
              std::string::npos)
        << told;
    for (const char* const part :
         {"1 refused: not a command", "1 refused: of another run, too old or repeated",
          "1 refused: an axis, action or value"})
      EXPECT_NE(told.find(part), std::string::npos) << told;
  });
}

/// An event in a line, without what differs from hearing to hearing.
std::string in_words(const event_t& event) {
  return std::to_string(event.t) + " " + event.kind + " " + event.source + " " + event.type + " " +
         event.text;
}

std::vector<std::string> in_words(const std::vector<event_t>& events) {
  std::vector<std::string> lines;
  for (const event_t& event : events) lines.push_back(in_words(event));
  return lines;
}

TEST(RunCommands, ALogOfTheRunHasTheAnswersThatTheNetworkHearsAndAPlayerTellsThemAgain) {
  in_own_network(
      [] {
        bring_up_network();
        const cli::Directory folder;
        const std::string log = folder.file("run.lcm");
        std::vector<event_t> heard;
        {
          ForeignProgram run(
              run_of(folder.write("project.json", project(R"(, "commands": { "axes": { "Slide": {} } })")),
                     folder.file("err"), log));
          Client client;
          ASSERT_TRUE(client.hear_until([&] { return client.states > 0; }))
              << cli::content(folder.file("err"));
          client.send(command_t::ENABLE);
          client.send(command_t::HOME, 5.0);
          client.send(command_t::OVERRIDE, 500.0);
          const auto told = [&](const char* text) {
            return std::any_of(client.events.begin(), client.events.end(), [&](const event_t& event) {
              return in_words(event).find(text) != std::string::npos;
            });
          };
          ASSERT_TRUE(
              client.hear_until([&] { return told("job done panel.Slide.home") && told("override 500"); }));
          run.interrupt();
          EXPECT_EQ(run.status(), 0);
          client.hear_until([] { return false; }, 300ms);  // what is on its way
          heard = client.events;
        }
        Client listener;
        ForeignProgram player({"lcm-logplayer", std::string("--lcm-url=") + kUrl, log});
        ASSERT_TRUE(listener.hear_until([&] { return !player.running(); }));
        listener.hear_until([] { return false; }, 300ms);
        EXPECT_GT(listener.rows, 0u);
        EXPECT_EQ(in_words(listener.events), in_words(heard));
        EXPECT_EQ(listener.states, 0u)
            << "how axes stand is not told again: a panel would cite a run that is over";
        for (std::size_t i = 1; i < heard.size(); ++i)
          EXPECT_GE(heard[i].t, heard[i - 1].t) << in_words(heard[i]);
        EXPECT_EQ(std::count_if(heard.begin(), heard.end(),
                                [](const event_t& event) { return event.kind == "command accepted"; }),
                  2);
      });
}

TEST(RunCommands, AnAuditLogTellsCommandsThatAreCarriedOutAndThoseThatAreNot) {
  in_own_network([] {
    bring_up_network();
    const cli::Directory folder;
    const std::string audit = folder.file("audit.jsonl");
    auto command =
        run_of(folder.write("project.json", project(R"(, "commands": { "axes": { "Slide": {} } })")),
               folder.file("err"), "");
    command[2].replace(command[2].find("2>"), 0, "--audit \"$4\" ");
    command.push_back(audit);
    ForeignProgram run(command);
    Client client;
    ASSERT_TRUE(client.hear_until([&] { return client.states > 0; })) << cli::content(folder.file("err"));
    const auto told = [&](const std::string& text) {
      return client.hear_until([&] { return cli::content(audit).find(text) != std::string::npos; });
    };
    client.send(command_t::ENABLE);
    EXPECT_TRUE(told(
        R"("who":"panel 5","action":"enable","target":"Slide","old":false,"new":true,"result":"accepted"})"))
        << cli::content(audit);
    client.send(command_t::OVERRIDE, 50.0);
    EXPECT_TRUE(told(R"("action":"override","target":"Slide","old":100,"new":50,"result":"accepted"})"))
        << cli::content(audit);
    client.send(command_t::OVERRIDE, 500.0);
    EXPECT_TRUE(told(R"("result":"refused","why":"override 500 is not permitted)")) << cli::content(audit);
    client.send(std::vector<std::uint8_t>{1, 2, 3});
    EXPECT_TRUE(told(R"("action":"command","result":"refused","why":"not a command"})"))
        << cli::content(audit);
    EXPECT_TRUE(told(R"("via":"lcm","from":")")) << cli::content(audit);
    run.interrupt();
    EXPECT_EQ(run.status(), 0);
  });
}

TEST(RunCommands, AnAxisThatHasNoNameIsToldAsText) {
  in_own_network([] {
    bring_up_network();
    const cli::Directory folder;
    ForeignProgram run(
        run_of(folder.write("project.json", project(R"(, "commands": { "axes": { "Slide": {} } })")),
               folder.file("err")));
    Client client;
    ASSERT_TRUE(client.hear_until([&] { return client.states > 0; })) << cli::content(folder.file("err"));
    client.axis = "x\x1b[2J\n";
    client.send(command_t::ENABLE);
    EXPECT_EQ(client.event("command refused", "no axis of this name").source, "x?[2J?");
    run.interrupt();
    EXPECT_EQ(run.status(), 0);
  });
}

TEST(RunCommands, AProjectThatDoesNotSaySoHearsNoCommand) {
  in_own_network([] {
    bring_up_network();
    const cli::Directory folder;
    ForeignProgram run(run_of(folder.write("project.json", project("")), folder.file("err")));
    Client client;
    ASSERT_TRUE(client.hear_until([&] { return client.rows > 0; })) << cli::content(folder.file("err"));
    const std::uint64_t before = client.rows;
    for (int i = 0; i < 10; ++i) client.send(command_t::ENABLE);
    ASSERT_TRUE(client.hear_until([&] { return client.rows > before + 500; }));
    EXPECT_EQ(client.states, 0u);
    for (const event_t& event : client.events) EXPECT_EQ(event.kind, "overrun") << "of a busy machine";
    run.interrupt();
    EXPECT_EQ(run.status(), 0);
    EXPECT_EQ(cli::content(folder.file("err")).find("commands"), std::string::npos);
  });
}

TEST(RunCommands, ANetworkOfTheCommandLineThatLeavesTheMachineIsWarnedOf) {
  in_own_network([] {
    bring_up_network();
    const cli::Directory folder;
    const std::string open =
        folder.write("open.json", project(R"(, "commands": { "axes": { "Slide": {} } })"));
    const std::string closed = folder.write("closed.json", project(""));
    const auto says = [&](const std::string& file, const std::string& url) {
      const cli::Ended ended =
          cli::lockstep({"run", file, "--no-modbus", "--no-retain", "--duration", "100ms", "--lcm", url});
      EXPECT_EQ(ended.status, 0) << ended.err;
      return ended.err.find("warning: --lcm: whoever reaches this network can move these axes") !=
             std::string::npos;
    };
    EXPECT_TRUE(says(open, "udpm://239.255.76.67:7667?ttl=3"));
    EXPECT_TRUE(says(open, "udpm://239.255.76.67:7667?recv_buf_size=9000&ttl=1"));
    EXPECT_FALSE(says(open, "udpm://239.255.76.67:7667?ttl=0"));
    EXPECT_FALSE(says(open, "udpm://239.255.76.67:7667"));
    EXPECT_FALSE(says(closed, "udpm://239.255.76.67:7667?ttl=3")) << "it takes no commands";
  });
}

// ---- A network on which somebody lies

/// Sends datagrams as they are.
class Liar {
 public:
  Liar() : fd_(::socket(AF_INET, SOCK_DGRAM, 0)) {}
  ~Liar() { ::close(fd_); }
  void send(const std::vector<std::uint8_t>& datagram) const {
    sockaddr_in group{};
    group.sin_family = AF_INET;
    group.sin_port = htons(7667);
    ::inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
    ::sendto(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&group),
             sizeof group);
  }
  /// Forged, oversized, interleaved and cut ones.
  void lie() const {
    const std::string data(1000, 'x');
    for (std::uint32_t i = 0; i < 40; ++i) {
      send(
          test::fragment_datagram({.sequence = i, .size = 0x7FFFFFFF, .number = 0, .count = 2}, "SLIDE_CMD"));
      send(test::fragment_datagram({.sequence = i, .size = 8u << 20, .number = 1, .count = 2}, data));
      send(test::fragment_datagram({.sequence = 99, .size = 2000, .number = 0, .count = 3},
                                   std::string("SLIDE_CMD\0", 10) + data));
      send(test::fragment_datagram(
          {.sequence = 99, .size = 2000, .offset = 0xFFFFFFFFu - i * 64, .number = 1, .count = 3}, data));
      send(test::short_datagram("SLIDE_CMD", data));
      send({'L', 'C', '0', '3', static_cast<std::uint8_t>(i)});
    }
  }

 private:
  int fd_;
};

/// Memory of a program that is in use [KiB].
long resident_memory(pid_t process) {
  std::istringstream status(cli::content("/proc/" + std::to_string(process) + "/status"));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  return -1;
}

TEST(RunCommands, DatagramsThatLieEndNoRunNorTakeItsMemoryNorKeepCommandsAway) {
  in_own_network([] {
    bring_up_network();
    const cli::Directory folder;
    const std::string file = folder.write(
        "project.json", project(R"(, "commands": { "axes": { "Slide": { "jog_velocity": 20.0 } } })"));
    ForeignProgram run(run_of(file, folder.file("err")));
    ForeignProgram monitor(
        {"sh", "-c", R"(exec "$0" monitor >"$1" 2>&1)", LOCKSTEP_EXECUTABLE, folder.file("monitor")});
    Client client;
    const auto shown = [&](const char* text) {
      return cli::content(folder.file("monitor")).find(text) != std::string::npos;
    };
    ASSERT_TRUE(client.hear_until([&] { return client.states > 0 && shown("SLIDE: panel"); }));
    const long before = resident_memory(run.process()), watching = resident_memory(monitor.process());
    ASSERT_GT(before, 0);
    ASSERT_GT(watching, 0);
    const Liar liar;
    liar.lie();
    const std::uint64_t states = client.states;
    ASSERT_TRUE(client.hear_until([&] { return client.states > states + 5; }));
    EXPECT_LT(resident_memory(run.process()) - before, 40'000);
    EXPECT_LT(resident_memory(monitor.process()) - watching, 40'000);
    client.send(command_t::ENABLE);
    client.event("command accepted", "enable");
    liar.lie();
    client.send(command_t::DISABLE);
    client.event("command accepted", "disable");
    EXPECT_TRUE(monitor.running());
    run.interrupt();
    EXPECT_EQ(run.status(), 0) << cli::content(folder.file("err"));
  });
}

}  // namespace
}  // namespace lockstep::run_commands_test
