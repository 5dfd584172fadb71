// What pages ask of a studio, line by line: a request (`GET /api`, `POST /api/read {…}`), a message of the
// WebSocket (`{…}`), `~` for a tick of the machine. It commands and writes a machine of its own each time.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "hmi_bridge/studio/url.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/projects/studio_machine.hpp"

namespace lockstep::fuzz::studio_session_target {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLines = 48;

/// Two axes, one of which takes commands, and a tag of each kind that is told otherwise.
constexpr std::string_view kMachine = R"({ "lockstep": 1, "name": "fuzzed",
  "clock": { "servo_cycle": "1ms", "interpolator_ratio": 2 },
  "technology_objects": {
    "Belt": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 } } },
    "Drum": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } }, "leading_values": [ { "to": "Belt" } ] } },
  "tags": { "start": { "type": "BOOL" }, "speed": { "type": "LREAL", "init": 50.0 }, "wide": { "type": "LINT" }, "bits": { "type": "LWORD" },
            "span": { "type": "TIME" }, "text": { "type": "STRING[20]" }, "list": { "type": "ARRAY[0..3] OF DINT" } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "2ms", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Belt", "Enable": true } },
    { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Belt", "Execute": "power.Status AND start", "Velocity": "speed" } } ] } ],
  "trace": { "signals": [ "Belt.Position" ] },
  "studio": { "write": true, "commands": { "axes": { "Belt": { "jog_velocity": 10.0 } } } } })";

class Machine : public test::StudioMachine {
 public:
  Machine() : StudioMachine(Simulation::from_text(std::string(kMachine))) {
    empower();
    session.opened(page);
    run(2);
  }
  ~Machine() { session.closed(page); }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  test::StudioPage page;
};

void check(const StudioAnswer& answer) {
  require(answer.status >= 200 && answer.status < 500 ? true : answer.status == 503,
          "a status of the contract");
  if (answer.type != "application/json") return;
  const Json json = Json::parse(answer.body, nullptr, false);
  require(!json.is_discarded(), "an answer is JSON");
  if (answer.status < 400) return;
  const Json& error = json.at("error");
  require(error.at("code").is_string() && !error.at("message").get_ref<const std::string&>().empty(),
          "an error tells what it is");
}

void ask(Machine& machine, std::string_view line) {
  StudioRequest request;
  const std::size_t blank = line.find(' ');
  if (blank == line.npos) return;
  request.method = line.substr(0, blank);
  line.remove_prefix(blank + 1);
  const std::size_t end = std::min(line.find(' '), line.size());
  StudioUrl url;
  if (!parse_url(line.substr(0, end), url)) return;
  request.path = std::move(url.path);
  request.query = std::move(url.query);
  request.body = line.substr(std::min(end + 1, line.size()));
  request.peer = "192.0.2.7:4242";
  int answers = 0;
  machine.session.answer(request, [&answers](const StudioAnswer& answer) {
    ++answers;
    check(answer);
  });
  // What waits for a tick of the machine has its answer then.
  for (int tick = 0; tick < 8 && answers == 0; ++tick) machine.run(1);
  require(answers <= 1, "a request has one answer");
}

void check(test::StudioPage& page) {
  for (const test::DecodedFrame& frame : page.frames) require(frame.is_whole, "a frame is whole");
  for (const Json& text : page.texts) require(text.at("type").is_string(), "a message has a type");
  page.frames.clear();
  page.texts.clear();
}

}  // namespace

std::vector<std::string> seeds() {
  return {
      "GET /api\nGET /api/project\nGET /api/signals?q=belt+position&limit=5\nGET /api/events\nGET "
      "/api/jobs\nGET /api/traces\n"
      "GET /api/tags\nGET /api/objects/Belt\nGET /api/instances/run\nGET /api/programs\nGET "
      "/api/uses?name=speed\nGET /api/check\nGET /api/health\n",
      "POST /api/read {\"paths\":[\"Belt.Position\",\"wide\",\"list[2]\",\"=Belt.Position * 2.0\"]}\n~\n~\n",
      "POST /api/write "
      "{\"writes\":[{\"path\":\"start\",\"value\":true},{\"path\":\"wide\",\"value\":\"9223372036854775807\"}"
      ",{\"path\":\"bits\",\"value\":3,\"bits\":1},"
      "{\"path\":\"text\",\"value\":\"abc\"},{\"path\":\"span\",\"value\":\"1000\"},{\"path\":\"Belt."
      "DynamicDefaults.Velocity\",\"value\":1e3}]}\n~\n~\n~\n",
      "{\"type\":\"hello\",\"seq\":1}\n{\"type\":\"subscribe\",\"seq\":2,\"id\":1,\"paths\":[\"Belt."
      "Position\",\"start\",\"=derivative(Belt.Position)\",\"=mean(speed, 4ms)\"]}\n~\n~\n~\n"
      "{\"type\":\"ack\",\"frame\":1}\n{\"type\":\"unsubscribe\",\"seq\":3,\"id\":1}\n~\n",
      "{\"type\":\"hello\"}\n{\"type\":\"trigger\",\"seq\":2,\"action\":\"arm\",\"kind\":\"rising\",\"path\":"
      "\"speed\",\"level\":10,\"hysteresis\":1,\"before\":2000000,\"after\":2000000,\"mode\":\"normal\"}\n"
      "~\n~\n{\"type\":\"trigger\",\"action\":\"force\"}\n~\n~\n~\n~\nGET /api/traces\nGET "
      "/api/traces/shot-1/window?signals=speed&pixels=10\n"
      "GET /api/traces/shot-1/export?format=csv&signals=speed\nPOST /api/traces/shot-1/derived "
      "{\"signal\":\"=speed + 1.0\"}\nDELETE /api/traces/shot-1\n",
      "{\"type\":\"hello\"}\n{\"type\":\"trigger\",\"action\":\"arm\",\"kind\":\"job\"}\nPOST /api/write "
      "{\"writes\":[{\"path\":\"start\",\"value\":true}]}\n~\n~\n~\n",
      "{\"type\":\"hello\"}\n{\"type\":\"subscribe\",\"id\":1,\"paths\":[\"Belt.Position\",\"Belt.Velocity\"]"
      "}\n~\n~\n~\n~\n~\n~\n~\n~\n"
      "GET /api/traces/live/window?signals=Belt.Position&from=0&to=8000000&pixels=2\nGET "
      "/api/traces/live/statistics?signals=Belt.Position,Belt.Velocity&from=0&to=9000000\n"
      "GET /api/traces/live/spectrum?signal=Belt.Velocity&window=flattop\nGET "
      "/api/traces/live/spectrum?signal=Belt.Velocity&order=Belt.Position\n"
      "GET /api/traces/live/xy?x=Belt.Position&y=Belt.Velocity&points=4\nGET "
      "/api/compare?a=live&b=live&signals=Belt.Position&shift=2000000&tolerance=0.5\n"
      "GET /api/traces/live/export?format=lcm&signals=Belt.Position\nGET "
      "/api/traces/live/export?format=html&signals=Belt.Position\nGET /api/traces/live/events\n",
      "{\"type\":\"hello\"}\n{\"type\":\"command\",\"seq\":3,\"axis\":\"Belt\",\"action\":\"jog "
      "forward\",\"value\":5,\"run\":\"0\",\"beat\":0,\"sequence\":1}\n~\n~\n"
      "{\"type\":\"command\",\"axis\":\"Belt\",\"action\":\"stop\",\"value\":0,\"run\":\"0\",\"beat\":0,"
      "\"sequence\":2}\n~\n",
      "POST /api/simulation {\"action\":\"seek\",\"t\":\"1000000\"}\nPUT /api/files/project.json {}\nPOST "
      "/api/traces {\"path\":\"a.csv\"}\nGET /api/describe/MC_Power\n"};
}

int take(const std::uint8_t* data, std::size_t size) {
  Machine machine;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  for (std::size_t lines = 0; !rest.empty() && lines < kLines; ++lines) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    if (line.starts_with('~'))
      machine.run(1);
    else if (line.starts_with('{'))
      machine.session.text(machine.page, line);
    else
      ask(machine, line);
    check(machine.page);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return 0;
}

}  // namespace lockstep::fuzz::studio_session_target
