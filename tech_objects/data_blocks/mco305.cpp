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
    SHOWN("SysVar.4096", Read.ActualPosition, "actual position [qc]"),
    SHOWN("SysVar.4097", Read.SetPosition, "set position [qc]"),
    SHOWN("SysVar.4111", Read.Reference, "reference of the position controller, ±1048575"),
    SHOWN("SysVar.4275", Read.JerkState, "phase of a motion, 1 to 15"),
    SHOWN("Program.Number", Program.Number, "number of the program; -1: none"),
    SHOWN("Program.State", Program.State,
          "0: none, 1: runs, 2: waits, 3: a handler runs, 4: ended, 5: ended by an error, 6: refused"),
    SHOWN("Program.Line", Program.Line, "line that is carried out"),
    SHOWN("Program.Steps", Program.Steps, "internal commands since its start"),
    SHOWN("Program.Starved", Program.Starved, "steps whose budget of internal commands was used up"),
};

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
  add_bits("In.", Data{}.In.size(), offsetof(Data, In), "digital input");
  add_bits("Out.", Data{}.Out.size(), offsetof(Data, Out),
           "digital output; 30, 31, 32: X34/1, X34/5, X34/10");
  return all;
}

std::vector<Variable> declare_parameters(std::deque<std::string>& names) {
  std::vector<Variable> all;
  const auto add = [&](std::string name, std::size_t index, Range range, std::string text, bool later) {
    all.push_back({.path = names.emplace_back(std::move(name)),
                   .type = Type::DINT,
                   .offset = offsetof(Data, Parameters) + index * sizeof(DINT),
                   .effect = Effect::RON,
                   .computed = true,
                   .unit = Unit::kNone,
                   .range = range,
                   .text = names.emplace_back(std::move(text)),
                   .later = later,
                   .start = &start_value_in<Data>});
  };
  const auto parameters = mco305::parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const mco305::Parameter& of = parameters[i];
    std::string number = std::to_string(of.number);
    number.insert(2, "_");
    std::string text = number.replace(2, 1, "-") + ": " + std::string(of.title);
    number.replace(2, 1, "_");
    if (!of.unit.empty()) text += " [" + std::string(of.unit) + (of.decimals != 0 ? "/1000]" : "]");
    add(of.mnemonic.empty() ? "P" + number : std::string(of.mnemonic), i,
        {static_cast<double>(of.lowest), static_cast<double>(of.highest)}, text, !of.effective);
  }
  for (std::size_t i = 0; i < mco305::kApplicationParameters; ++i)
    add("P" + std::to_string(mco305::kFirstApplicationParameter + static_cast<int>(i)),
        mco305::kNumberedParameters + i, kWhole, "application parameter", false);
  return all;
}

struct Declared {
  std::deque<std::string> names;
  std::vector<Variable> status = declare_status(names);
  std::vector<Variable> parameters = declare_parameters(names);
  DataBlock block{{}, {}};
  Declared() {
    status.insert(status.end(), parameters.begin(), parameters.end());
    block = {{}, status};
  }
};

}  // namespace

const DataBlock& mco305_data_block() {
  static const Declared declared;
  return declared.block;
}

}  // namespace lockstep
