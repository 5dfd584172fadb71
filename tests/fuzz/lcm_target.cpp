// Any messages on an LCM network, as lockstep monitor hears them: each is a byte for its channel, two for its
// length, and itself.
#include <algorithm>
#include <chrono>

#include "cli/monitor/traces.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace lockstep::fuzz::lcm_target {
namespace {

constexpr std::size_t kWidth = 80;

std::vector<TraceSignal> signals() {
  return {{"on", Type::BOOL, ""},
          {"after", Type::TIME, "s"},
          {"Knife.Position", Type::LREAL, "u"},
          {"n", Type::ULINT, ""},
          {"word", Type::WORD, ""}};
}

void add(std::string& input, char channel, Bytes message) {
  input += channel;
  input += static_cast<char>(message.size() >> 8);
  input += static_cast<char>(message.size());
  input.append(message.begin(), message.end());
}

}  // namespace

std::vector<std::string> seeds() {
  LcmEncoder encoder({"knife", "K", 1'000'000, 5}, signals());
  const std::vector<Value> values(signals().size());
  std::string whole, headers, rows;
  add(whole, 1, encoder.header());
  for (int i = 0; i < 4; ++i) add(whole, 0, encoder.row({i * 1'000'000, 1, 0, values}));
  for (char channel = 1; channel < 9; channel += 2) add(headers, channel, encoder.header());
  add(rows, 0, encoder.row({7, 1, 0, values}));
  add(rows, 1, encoder.header());
  add(rows, 1, encoder.row({7, 1, 0, values}));
  add(rows, 0, encoder.header());
  return {whole, headers, rows};
}

int take(const std::uint8_t* data, std::size_t size) {
  cli::HeardTraces traces;
  const auto begin = cli::HeardTrace::Clock::time_point{} + std::chrono::hours(1);
  Bytes rest(data, size);
  for (int i = 0; rest.size() >= 3; ++i) {
    const std::size_t length = std::min<std::size_t>(rest[1] << 8 | rest[2], rest.size() - 3);
    const std::string channel = "C" + std::to_string(rest[0] / 2) + (rest[0] % 2 != 0 ? "_HEADER" : "");
    traces.accept(channel, rest.subspan(3, length), begin + std::chrono::milliseconds(i));
    rest = rest.subspan(3 + length);
  }
  require(traces.all().size() <= cli::HeardTraces::kMaximum, "there is an end to the number of traces");
  for (const std::string& line : cli::trace_lines(traces, begin + std::chrono::seconds(1), kWidth)) {
    require(std::none_of(line.begin(), line.end(),
                         [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }),
            "no control characters reach the terminal");
    const auto columns = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    require(static_cast<std::size_t>(columns) <= kWidth, "no line is longer than the terminal");
  }
  return 0;
}

}  // namespace lockstep::fuzz::lcm_target
