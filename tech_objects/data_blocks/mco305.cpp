/// Declaration of the variables of an MCO 305: its published read-outs, and its parameters from their table.
/// @source MCO 305 Design Guide: read-outs, SYSVAR, parameter reference
#include "tech_objects/data_blocks/mco305.hpp"

#include <deque>
#include <string>
#include <vector>

#include "tech_objects/data_blocks/declaration.hpp"

namespace lockstep {
namespace {

using Data = Mco305Data;

constexpr Range kWhole{-2147483648.0, 2147483647.0};

/// COMPUTED, of a member that has another path.
#define SHOWN(path_, member_, text_)                                                                 \
  Variable {                                                                                         \
    .path = (path_), .type = type_of<decltype(Data{}.member_)>(), .offset = offsetof(Data, member_), \
    .effect = Effect::RON, .computed = true, .unit = Unit::kNone, .range = kWhole, .text = (text_),  \
    .start = &start_value_in<Data>                                                                   \
  }

const Variable kReadOuts[] = {
    SHOWN("APOS", Read.APOS, "actual position [UU]"),
    SHOWN("CPOS", Read.CPOS, "set position [UU]"),
    SHOWN("IPOS", Read.IPOS, "last index or marker position [UU]"),
    SHOWN("MAPOS", Read.MAPOS, "position of the master [qc]"),
    SHOWN("MIPOS", Read.MIPOS, "last index or marker position of the master [qc]"),
    SHOWN("MAVEL", Read.MAVEL, "velocity of the master [qc/s]"),
    SHOWN("SYNCERR", Read.SYNCERR, "synchronization error [UU]"),
    SHOWN("SYNCSTAT", Read.SYNCSTAT, "flags of the synchronization"),
    SHOWN("TRACKERR", Read.TRACKERR, "following error, CPOS - APOS [UU]"),
    SHOWN("AVEL", Read.AVEL, "actual velocity [UU/s]"),
    SHOWN("AXEND", Read.AXEND, "state of the motion"),
    SHOWN("STAT", Read.STAT, "state of axis and controller"),
    SHOWN("ERRNO", Read.ERRNO, "first error that has not been cleared; 0: none"),
    SHOWN("CURVEPOS", Read.CURVEPOS, "position of the slave on the curve; curves are not built: 0 [UU]"),
    SHOWN("Program.Number", Program.Number, "number of the program; -1: none"),
    SHOWN("Program.State", Program.State,
          "0: none, 1: runs, 2: waits, 3: a handler runs, 4: ended, 5: ended by an error, 6: refused"),
    SHOWN("Program.Line", Program.Line, "line that is carried out"),
    SHOWN("Program.Steps", Program.Steps, "internal commands since its start"),
    SHOWN("Program.Starved", Program.Starved, "steps whose budget of internal commands was used up"),
};

/// Where the read-out of a number stands, 34-50 as 3450.
struct ReadOut {
  std::int32_t number;
  std::size_t offset;
};
constexpr ReadOut kNumbered[] = {
    {3440, offsetof(Data, Read.Inputs)},     {3441, offsetof(Data, Read.Outputs)},
    {3450, offsetof(Data, Read.APOS)},       {3451, offsetof(Data, Read.CPOS)},
    {3452, offsetof(Data, Read.MAPOS)},      {3453, offsetof(Data, Read.IPOS)},
    {3454, offsetof(Data, Read.MIPOS)},      {3455, offsetof(Data, Read.CURVEPOS)},
    {3456, offsetof(Data, Read.TRACKERR)},   {3457, offsetof(Data, Read.SYNCERR)},
    {3458, offsetof(Data, Read.AVEL)},       {3459, offsetof(Data, Read.MAVEL)},
    {3460, offsetof(Data, Read.SYNCSTAT)},   {3461, offsetof(Data, Read.AXEND)},
    {3462, offsetof(Data, Read.STAT)},       {3470, offsetof(Data, Read.AlarmWord1)},
    {3471, offsetof(Data, Read.AlarmWord2)},
};
constexpr std::int32_t kFirstWordIn = 3401, kFirstWordOut = 3421;

/// Of a read-out: its place among the read-outs or the process data.
void place_read_out(std::int32_t number, Variable& variable) {
  const auto word = [&](std::int32_t first, std::size_t offset) {
    const std::int32_t index = number - first;
    if (index < 0 || index >= static_cast<std::int32_t>(Mco305Outside::kWords)) return;
    variable.type = Type::WORD;
    variable.range = kAny;
    variable.offset = offset + static_cast<std::size_t>(index) * sizeof(WORD);
  };
  word(kFirstWordIn, offsetof(Data, Outside.PcdIn));
  word(kFirstWordOut, offsetof(Data, Outside.PcdOut));
  for (const ReadOut& one : kNumbered)
    if (one.number == number) variable.offset = one.offset;
}

std::vector<Variable> declare_status(std::deque<std::string>& names) {
  std::vector<Variable> all(std::begin(kReadOuts), std::end(kReadOuts));
  const auto add_bits = [&](const char* group, std::size_t count, std::size_t offset, const char* text) {
    for (std::size_t i = 0; i < count; ++i)
      all.push_back({.path = names.emplace_back(group + std::to_string(i + 1)),
                     .type = Type::BOOL,
                     .offset = offset + i * sizeof(BOOL),
                     .effect = Effect::RON,
                     .computed = true,
                     .unit = Unit::kNone,
                     .range = kAny,
                     .text = text,
                     .start = &start_value_in<Data>});
  };
  const auto add_words = [&](const char* path, std::size_t offset, Effect effect, const char* text) {
    all.push_back({.path = path,
                   .type = Type::WORD,
                   .offset = offset,
                   .count = Mco305Outside::kWords,
                   .stride = sizeof(WORD),
                   .effect = effect,
                   .computed = effect == Effect::RON,
                   .unit = Unit::kNone,
                   .range = kAny,
                   .text = text,
                   .start = &start_value_in<Data>});
  };
  const auto add_past = [&](const char* path, std::size_t offset, const char* text) {
    all.push_back({.path = path,
                   .type = Type::DINT,
                   .offset = offsetof(Data, ErrorHistory) + offset,
                   .count = kMco305PastErrors,
                   .stride = sizeof(Mco305PastError),
                   .effect = Effect::RON,
                   .computed = true,
                   .unit = Unit::kNone,
                   .range = kWhole,
                   .text = text,
                   .start = &start_value_in<Data>});
  };
  add_past("ErrorHistory[].Number", offsetof(Mco305PastError, Number),
           "number of an error that there has been, the newest first; 0: none");
  add_past("ErrorHistory[].Time", offsetof(Mco305PastError, Time), "when it came up, as TIME [ms]");
  add_past("ErrorHistory[].Program", offsetof(Mco305PastError, Program), "program that ran; -1: none");
  add_past("ErrorHistory[].Line", offsetof(Mco305PastError, Line), "line that was carried out; -1: none");
  add_past(
      "ErrorHistory[].Value", offsetof(Mco305PastError, Value),
      "of 108 the following error, of 111 and 198 the actual position [qc]; of 112 the parameter or system "
      "variable; of 125 the input; of 192 the encoder (1 master, 2 slave); else 0");
  add_words("PcdIn[]", offsetof(Data, Outside.PcdIn), Effect::DIR,
            "process data that come from a field bus: PCD, COMOPTGET, ON COMBIT");
  add_words("PcdOut[]", offsetof(Data, Outside.PcdOut), Effect::RON,
            "process data that go to a field bus: PCD[n] = …, COMOPTSEND");
  all.push_back({.path = "Keys",
                 .type = Type::DINT,
                 .offset = offsetof(Data, Outside.Keys),
                 .effect = Effect::DIR,
                 .unit = Unit::kNone,
                 .range = {0.0, 65'535.0},
                 .text = "keys of the panel that are pressed, each a bit, as INKEY tells them",
                 .start = &start_value_in<Data>});
  add_bits("In.", Data{}.In.size(), offsetof(Data, In), "digital input");
  add_bits("Out.", Data{}.Out.size(), offsetof(Data, Out),
           "digital output; 30, 31, 32: X34/1, X34/5, X34/10");
  return all;
}

/// By their indices and by their names. What is read most is there in every step.
std::vector<Variable> declare_system_variables(std::deque<std::string>& names) {
  std::vector<Variable> all;
  const auto numbered = mco305::system_variables();
  for (std::size_t i = 0; i < numbered.size(); ++i) {
    const mco305::SystemVariable& of = numbered[i];
    std::size_t offset = offsetof(Data, SystemVariables) + i * sizeof(DINT);
    if (of.index == 4096) offset = offsetof(Data, Read.ActualPosition);
    if (of.index == 4097) offset = offsetof(Data, Read.SetPosition);
    if (of.index == 4111) offset = offsetof(Data, Read.Reference);
    if (of.index == 4275) offset = offsetof(Data, Read.JerkState);
    const std::string& text =
        names.emplace_back(std::string(of.text) + (of.unit.empty() ? "" : " [" + std::string(of.unit) + "]"));
    for (const std::string& name : {std::to_string(of.index), std::string(of.name)})
      all.push_back({.path = names.emplace_back("SysVar." + name),
                     .type = Type::DINT,
                     .offset = offset,
                     .effect = Effect::RON,
                     .computed = true,
                     .unit = Unit::kNone,
                     .range = kWhole,
                     .text = text,
                     .later = !of.built,
                     .start = &start_value_in<Data>});
  }
  return all;
}

std::vector<Variable> declare_parameters(std::deque<std::string>& names) {
  std::vector<Variable> all;
  const auto add = [&](std::string name, std::size_t index, Range range, std::string text, bool later,
                       bool read_out) {
    all.push_back({.path = names.emplace_back(std::move(name)),
                   .type = Type::DINT,
                   .offset = offsetof(Data, Parameters) + index * sizeof(DINT),
                   .effect = read_out ? Effect::RON : Effect::DIR,
                   .computed = read_out,
                   .unit = Unit::kNone,
                   .range = range,
                   .text = names.emplace_back(std::move(text)),
                   .later = later,
                   .start = &start_value_in<Data>});
  };
  const auto parameters = mco305::parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const mco305::Parameter& of = parameters[i];
    std::string text = std::to_string(of.number).insert(2, "-") + ": " + std::string(of.title);
    if (!of.unit.empty()) text += " [" + std::string(of.unit) + (of.decimals != 0 ? "/1000]" : "]");
    add(mco305_parameter_path(of), i, {static_cast<double>(of.lowest), static_cast<double>(of.highest)}, text,
        !of.effective, mco305::is_read_out(of.number));
    if (mco305::is_read_out(of.number)) place_read_out(of.number, all.back());
  }
  for (std::size_t i = 0; i < mco305::kApplicationParameters; ++i)
    add("P" + std::to_string(mco305::kFirstApplicationParameter + static_cast<int>(i)),
        mco305::kNumberedParameters + i, kWhole, "application parameter", false, false);
  return all;
}

struct Declared {
  std::deque<std::string> names;
  std::vector<Variable> status = declare_status(names);
  std::vector<Variable> system_variables = declare_system_variables(names);
  std::vector<Variable> parameters = declare_parameters(names);
  DataBlock block{{}, {}};
  Declared() {
    status.insert(status.end(), system_variables.begin(), system_variables.end());
    status.insert(status.end(), parameters.begin(), parameters.end());
    block = {{}, status};
  }
};

}  // namespace

std::string mco305_parameter_path(const mco305::Parameter& parameter) {
  if (!parameter.mnemonic.empty()) return std::string(parameter.mnemonic);
  return "P" + std::to_string(parameter.number).insert(2, "_");
}

const DataBlock& mco305_data_block() {
  static const Declared declared;
  return declared.block;
}

}  // namespace lockstep
