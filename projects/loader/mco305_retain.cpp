#include "projects/loader/mco305_retain.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

namespace lockstep {
namespace {

using aposs::Command;
using mco305::ParameterSet;

bool uses(const Mco305& device, std::initializer_list<Command> commands) {
  for (const DeviceProgram& program : device.programs)
    for (const aposs::Instruction& at : program.image.code)
      if (at.operation == aposs::Operation::kCommand &&
          std::ranges::find(commands, static_cast<Command>(at.a)) != commands.end())
        return true;
  return false;
}

/// Numbers of the parameters of a set.
std::vector<std::int32_t> numbers_of(ParameterSet set) {
  std::vector<std::int32_t> numbers;
  for (const mco305::Parameter& parameter : mco305::parameters())
    if (mco305::set_of(parameter.number) == set) numbers.push_back(parameter.number);
  if (set == ParameterSet::kApplication)
    for (std::int32_t n = mco305::kFirstApplicationParameter; n <= mco305::kLastApplicationParameter; ++n)
      numbers.push_back(n);
  return numbers;
}

std::string array_type(std::size_t size) {
  return "ARRAY[1.." + std::to_string(size) + "] OF DINT";
}

/// What the project says of a set: its parameters that are not at their start values.
std::string given(const mco305::ParameterValues& values, const std::vector<std::int32_t>& numbers) {
  static const mco305::ParameterValues kStart;
  std::string text;
  for (const std::int32_t number : numbers)
    if (values[number] != kStart[number])
      text.append(text.empty() ? "" : " ")
          .append(std::to_string(number))
          .append("=")
          .append(std::to_string(values[number]));
  return text.empty() ? "start values" : text;
}

void keep_set(Mco305& device, const char* name, ParameterSet set, std::vector<KeptValue>& values) {
  mco305::ParameterValues& parameters = device.parameters();
  const std::vector<std::int32_t> numbers = numbers_of(set);
  KeptValue kept{.name = device.name + "." + name, .signal = {}, .basis = given(parameters, numbers)};
  for (const std::int32_t number : numbers)
    kept.elements.push_back({parameters.kept(number), Type::DINT, -1});
  kept.array_type = array_type(numbers.size());
  kept.signal = kept.elements.front();
  if (set != ParameterSet::kApplication) kept.present = Signal{parameters.saved(set), Type::BOOL, -1};
  values.push_back(std::move(kept));
}

/// Sizes of the arrays, in their order: a device knows them by that alone.
std::string sizes_of(const Mco305& device) {
  std::vector<std::uint32_t> sizes;
  for (const DeviceProgram& program : device.programs)
    for (std::size_t i = sizes.size(); i < program.image.arrays.size(); ++i)
      sizes.push_back(program.image.arrays[i].size);
  std::string text = "DIM of";
  for (const std::uint32_t size : sizes) text += " " + std::to_string(size);
  return text;
}

}  // namespace

std::size_t make_kept_arrays(Mco305& device) {
  if (!uses(device, {Command::kSave, Command::kSaveprom})) return 0;
  aposs::Arrays all;
  for (const DeviceProgram& program : device.programs) all.fit(program.image.arrays);
  device.eeprom.arrays.assign(all.all().size(), 0);
  return device.eeprom.arrays.size();
}

void keep_mco305(Mco305& device, std::vector<KeptValue>& values) {
  const bool saves = uses(device, {Command::kSave, Command::kSaveprom});
  if (saves || device.has_panel() || uses(device, {Command::kSet, Command::kLinkgpar}))
    keep_set(device, "USRPARS", ParameterSet::kApplication, values);
  if (!saves && !device.has_panel()) return;
  keep_set(device, "AXPARS", ParameterSet::kAxis, values);
  keep_set(device, "GLBPARS", ParameterSet::kGlobal, values);
  if (!saves) return;
  values.push_back(
      {.name = device.name + ".EepromWrites", .signal = {&device.eeprom.writes, Type::UDINT, -1}});
  if (device.eeprom.arrays.empty()) return;
  KeptValue kept{.name = device.name + ".ARRAYS",
                 .signal = {},
                 .present = Signal{&device.eeprom.arrays_saved, Type::BOOL, -1},
                 .basis = sizes_of(device)};
  for (DINT& cell : device.eeprom.arrays) kept.elements.push_back({&cell, Type::DINT, -1});
  kept.array_type = array_type(kept.elements.size());
  kept.signal = kept.elements.front();
  values.push_back(std::move(kept));
}

}  // namespace lockstep
