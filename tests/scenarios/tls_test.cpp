// The recipe of hmi_bridge/tls: Modbus behind stunnel, in a network of its own, with the configurations as
// they are shipped but for the folder, the users and the address of the machine.
#include <gtest/gtest.h>
#include <modbus/modbus.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>

#include "tests/hmi_bridge/own_network.hpp"
#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::tls_test {
namespace {

const std::string kRecipe = LOCKSTEP_SOURCE_DIR "/hmi_bridge/tls/";
constexpr int kPlain = 1502, kTunnel = 1802, kSecure = 802;

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (auto at = text.find(what); at != text.npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  return text;
}

/// Without the lines that begin with one of these.
std::string without(const std::string& text, const std::vector<std::string>& keys) {
  std::string result, line;
  for (std::istringstream lines(text); std::getline(lines, line);)
    if (std::none_of(keys.begin(), keys.end(), [&](const auto& key) { return line.starts_with(key); }))
      result += line + "\n";
  return result;
}

/// A configuration as it is shipped, for certificates in the folder.
std::string recipe(const std::string& name, const Directory& folder) {
  std::string text = without(content(kRecipe + name), {"setuid", "setgid"});
  text = replaced(std::move(text), "/etc/stunnel/lockstep/ca", folder.file("own/ca"));
  text = replaced(std::move(text), "/etc/stunnel/lockstep/server", folder.file("own/press.example"));
  text = replaced(std::move(text), "/etc/stunnel/lockstep/client", folder.file("own/panel-1"));
  return replaced(std::move(text), "press.example:802", "127.0.0.1:802");
}

/// One request over a connection of its own, as a panel makes it. @return the register, or nothing
std::optional<int> asked(int port) {
  const std::unique_ptr<modbus_t, void (*)(modbus_t*)> client(modbus_new_tcp("127.0.0.1", port),
                                                              &modbus_free);
  modbus_set_response_timeout(client.get(), 10, 0);
  if (modbus_connect(client.get()) != 0) return std::nullopt;
  std::uint16_t value = 0;
  const bool good = modbus_read_registers(client.get(), 0, 1, &value) == 1;
  modbus_close(client.get());
  return good ? std::optional<int>(value) : std::nullopt;
}

bool written(int port, std::uint16_t value) {
  const std::unique_ptr<modbus_t, void (*)(modbus_t*)> client(modbus_new_tcp("127.0.0.1", port),
                                                              &modbus_free);
  modbus_set_response_timeout(client.get(), 10, 0);
  if (modbus_connect(client.get()) != 0) return false;
  const bool good = modbus_write_register(client.get(), 0, value) == 1;
  modbus_close(client.get());
  return good;
}

class Tls : public testing::Test {
 protected:
  void certify(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{kRecipe + "certificates.sh"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    Process process(command);
    ASSERT_EQ(process.status(), 0) << process.err();
  }
  std::unique_ptr<Process> tunnel(const std::string& name, const std::string& configuration) {
    return std::make_unique<Process>(std::vector<std::string>{"stunnel4", folder.write(name, configuration)});
  }
  /// Whether a panel with this configuration is turned away by the other end, while the tunnel is up.
  void expect_refused(const std::string& configuration, const std::string& why) {
    const auto client = tunnel("refused.conf", configuration);
    EXPECT_TRUE(wait_until([&] {
      EXPECT_EQ(asked(kTunnel), std::nullopt);
      return client->err().find(why) != std::string::npos || !client->running();
    })) << client->err();
    EXPECT_TRUE(client->running()) << client->err();
    EXPECT_FALSE(written(kTunnel, 99));
  }

  Directory folder;
};

TEST_F(Tls, LetsPanelsWithACertificateInAndNobodyElse) {
  in_own_network([&] {
    bring_up_network();
    certify({folder.file("own"), "press.example", "panel-1", "lost"});
    certify({folder.file("foreign"), "press.example", "panel-1"});
    certify({"--revoke", folder.file("own"), "lost"});
    Json json = empty_project();
    json["tags"]["number"] = {{"type", "UINT"}, {"init", 7}};
    json["modbus"] = {{"server", {{"listen", "127.0.0.1:" + std::to_string(kPlain)}}},
                      {"map", {{{"tag", "number"}, {"table", "holding_register"}, {"address", 0}}}}};
    Process run(lockstep_command({"run", folder.write("project.json", json.dump()), "--no-lcm"}));
    ASSERT_TRUE(wait_until([] { return asked(kPlain) == 7; })) << run.err();

    const auto server = tunnel("server.conf", recipe("server.conf", folder));
    const std::string client = recipe("client.conf", folder);
    {
      const auto panel = tunnel("client.conf", client);
      ASSERT_TRUE(wait_until([] { return asked(kTunnel) == 7; })) << server->err() << panel->err();
      EXPECT_TRUE(written(kTunnel, 42)) << server->err() << panel->err();
      EXPECT_EQ(asked(kTunnel), 42);
    }
    expect_refused(without(client, {"cert", "key"}), "certificate required");
    expect_refused(replaced(client, "own/panel-1", "foreign/panel-1"), "unknown ca");
    expect_refused(replaced(client, "own/panel-1", "own/lost"), "certificate revoked");
    expect_refused(replaced(client, "= press.example", "= other.example"), "Subject checks failed");
    EXPECT_EQ(asked(kSecure), std::nullopt) << "Modbus in the clear";
    EXPECT_EQ(asked(kPlain), 42) << "nothing of all this has arrived";

    const auto panel = tunnel("client.conf", client);
    EXPECT_TRUE(wait_until([] { return asked(kTunnel) == 42; })) << server->err() << panel->err();
    EXPECT_TRUE(server->running()) << server->err();
    run.send(SIGINT);
    EXPECT_EQ(run.status(), 0) << run.err();
  });
}

}  // namespace
}  // namespace lockstep::test::tls_test
