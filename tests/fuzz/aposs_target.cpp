// Any program in APOSS: it has messages with places, or it runs within its budget, whatever it does. The
// first byte says how many internal commands a step has.
#include "projects/aposs/compiler.hpp"
#include "projects/aposs/listing.hpp"
#include "scheduler/aposs/machine.hpp"
#include "scheduler/aposs/plain_device.hpp"
#include "scheduler/aposs/printed_line.hpp"
#include "tests/fuzz/texts.hpp"

namespace lockstep::fuzz::aposs_target {
namespace {

/// Answers every command somehow: at once, after a while, or with an error.
class FickleDevice final : public aposs::PlainDevice {
 public:
  aposs::Reply begin(aposs::Command command, const std::int32_t* arguments,
                     aposs::Arrays& arrays) noexcept override {
    const aposs::Reply plain = PlainDevice::begin(command, arguments, arrays);
    if (plain.kind != aposs::Reply::Kind::kRefused) return plain;
    switch (++asked_ % 4) {
      case 0:
        return aposs::Reply::busy();
      case 1:
        return aposs::Reply::failed(111);
      default:
        return aposs::Reply::done(static_cast<std::int32_t>(asked_ * 2654435761u));
    }
  }
  aposs::Reply proceed(aposs::Command, const std::int32_t*, std::int64_t elapsed) noexcept override {
    return elapsed > 3 ? aposs::Reply::done(1) : aposs::Reply::busy();
  }
  bool level(aposs::EdgeSource, std::int32_t number) noexcept override {
    return (milliseconds() / 3 + number) % 2 == 0;
  }
  aposs::PositionReading position(aposs::PositionSource) noexcept override {
    return {static_cast<std::int32_t>(milliseconds() * 977 % 4000), 4000};
  }
  int take_error() noexcept override { return milliseconds() % 17 == 16 ? 108 : 0; }

 private:
  std::uint32_t asked_ = 0;
};

void run(const aposs::Image& image, std::int32_t budget) {
  FickleDevice device;
  aposs::Arrays arrays;
  aposs::Machine machine(device, arrays);
  if (machine.load(image) != 0) return;
  std::string line;
  aposs::Printed item;
  for (int step = 0; step < 60 && !machine.over(); ++step) {
    const std::uint64_t before = machine.counters().commands;
    machine.step(budget);
    require(machine.counters().commands - before <= static_cast<std::uint64_t>(budget), "the budget is kept");
    while (machine.prints().take(item))
      if (aposs::append_printed(line, image.texts, item)) line.clear();
    device.advance(1);
  }
}

/// Each command of the device in a line of its own, with arguments of the kinds that it has; so that changes
/// put them together.
std::string every_command() {
  constexpr std::string_view kArguments[] = {"",       " 1",    " 2",     " ON", "",        "[1]",   " a",
                                             " 32-67", " 3-03", " \"t\"", " 5",  " ARRAYS", " KPROP"};
  std::string text = "DIM a[9]\n";
  for (const aposs::CommandRow& row : aposs::commands()) {
    if (row.kind != aposs::CommandKind::kStatement && row.kind != aposs::CommandKind::kFunction) continue;
    if (row.kind == aposs::CommandKind::kFunction) text += "x = ";
    text += row.name;
    for (std::size_t i = 0; i < row.arity(); ++i)
      text += kArguments[static_cast<std::size_t>(row.arguments[i])];
    text += "\n";
  }
  return text;
}

void look_at(const std::vector<std::string>& files, const aposs::Message& message) {
  require(message.place.file < files.size() && message.place.line > 0 && message.place.column > 0,
          "a message has a place");
  require(to_string(files, message).find_first_of("\n\r\x1b") == std::string::npos,
          "a message is one line without control sequences");
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> texts{"\x20" + every_command()};
  for (const char* text :
       {"DIM a[9], b[2]\nON ERROR GOSUB fault\nON PERIOD 5 GOSUB tick\nON INT -2 GOSUB "
        "tick\ni = 1\nagain:\na[i] = i * 3 % 2\n"
        "i = i + 1\nIF i < 12 THEN\n GOTO again\nELSEIF NOT (IN 1) THEN\n OUT 2 "
        "1\nENDIF\nDELAY 7\nPOSA (a[2] + 5)\n"
        "SUBMAINPROG\nSUBPROG fault\n PRINT \"error \", ERRNO\n ERRCLR\nRETURN\nSUBPROG "
        "tick\n n = n + 1\nRETURN\nENDPROG\n",
        "x = 0x7FFFFFFF + 1 rnd 3 mod 7 << 2\nx.b2 = 'A'\nx.3 = x.w1 & ~5 | 6 ^ 1\nWHILE "
        "(x > 0) AND (TIME < 50) DO\n x = x - 1\n"
        "ENDWHILE\nPRINT CHR(65), x, \"end\";\nREPEAT\nUNTIL SYNCSTAT & 4\n",
        "NOWAIT ON\nHOME\nSET SYNCMSTART 2000\nSET 32-67 5\nLINKGPAR 1900 \"a\" 0 9 "
        "0\nCVEL GET 1900\nCSTART\nWAITI 3 OFF\n"
        "ON +APOS 2000 GOSUB s\nON DELETE 0 GOSUB s\nDISABLE ALL\nENABLE "
        "ALL\nSYNCP\nWAITAX\nl: LOOP 3 l\nSYSVAR[4105] = PCD[1].3\n"
        "SUBMAINPROG\nSUBPROG s\n CSTOP\nRETURN\nENDPROG\n",
        "#INCLUDE a.m\nGOSUB a\nEXIT\nSUBMAINPROG\nSUBPROG a\n GOSUB a\nRETURN\nENDPROG\n"})
    for (const char budget : {'\1', '\x40'}) texts.push_back(budget + std::string(text));
  return texts;
}

int take(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view program = text_of(data + 1, size - 1);
  // What a file includes is its own first half, by a short name.
  const aposs::ReadIncluded half = [program](const std::string& name) {
    return name.size() > 4 ? std::nullopt : std::optional(std::string(program.substr(0, program.size() / 2)));
  };
  const aposs::CompiledProgram compiled = aposs::compile_program("x.m", program, half);
  require(compiled.image.has_value() == compiled.errors.empty(), "a program or problems");
  for (const auto& messages : {compiled.errors, compiled.warnings})
    for (const aposs::Message& message : messages) look_at(compiled.files, message);
  if (!compiled.image) return 0;
  require(compiled.image->fault() == 0, "what the compiler makes is sound");
  require(!aposs::listing(*compiled.image, {}).empty(), "a program can be listed");
  for (const aposs::Routine& handler : handlers_of(*compiled.image))
    longest_run(*compiled.image, handler.entry);
  run(*compiled.image, 1 + data[0] % 100);
  return 0;
}

}  // namespace lockstep::fuzz::aposs_target
