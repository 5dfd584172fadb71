// What a line of a map shows of an MCO 305 as a whole.
#include <algorithm>
#include <string>

#include "projects/keys/modbus.hpp"
#include "projects/loader/mco305_panel.hpp"
#include "projects/loader/modbus.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/data_blocks/mco305.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t kRegisters = 65536;
constexpr std::uint32_t kPerNumber = 10;  // registers of a number of a parameter

/// Adds entries of one device.
class ContentWriter {
 public:
  ContentWriter(const std::string& object, const ModbusEntry& shape, const Loading& loading,
                std::vector<ModbusEntry>& entries, std::vector<NamedSignal>& signals)
      : object_(object), shape_(shape), loading_(loading), entries_(entries), signals_(signals) {}

  void add_process_data() {
    for (std::uint32_t i = 0; i < Mco305Outside::kWords; ++i) {
      const std::string index = "[" + std::to_string(i + 1) + "]";
      add("PcdIn" + index, ModbusTable::holding_register, i, Type::WORD, true);
      add("PcdOut" + index, ModbusTable::input_register, i, Type::WORD, false);
    }
  }
  void add_parameters() {
    for (const mco305::Parameter& of : mco305::parameters())
      add(mco305_parameter_path(of), ModbusTable::holding_register, at(of.number), Type::DINT,
          !mco305::is_read_out(of.number));
    for (std::int32_t number = mco305::kFirstApplicationParameter;
         number <= mco305::kLastApplicationParameter; ++number)
      add("P" + std::to_string(number), ModbusTable::holding_register, at(number), Type::DINT, true);
  }

 private:
  static std::uint32_t at(std::int32_t number) { return kPerNumber * static_cast<std::uint32_t>(number); }

  void add(const std::string& variable, ModbusTable table, std::uint32_t offset, Type type, bool writable) {
    const std::string path = object_ + "." + variable;
    const Operand place = loading_.names().find(path).place.value();
    ModbusEntry entry = shape_;
    entry.table = table;
    entry.address += offset;
    // A word of process data as a parameter is 32 bits wide like all of them.
    const bool word = place.signal.value_type() == Type::WORD;
    entry.type = word && type == Type::DINT ? Type::DWORD : type;
    entry.writable = writable;
    entry.range = written_range(place);
    entry.signal = static_cast<std::uint32_t>(signals_.size());
    if (writable) expect_writes(place);
    entries_.push_back(entry);
    signals_.push_back({path, place.signal, place.unit, place.object, place.instance});
  }

  const std::string& object_;
  const ModbusEntry& shape_;
  const Loading& loading_;
  std::vector<ModbusEntry>& entries_;
  std::vector<NamedSignal>& signals_;
};

void refuse_other_keys(const Fields& fields, Problems& problems) {
  for (const char* const key :
       {"tag", "diagnostic", "table", "type", "byte_order", "bit", "scale", "offset", "access", "min", "max"})
    if (const JsonValue* const field = fields[key])
      problems.report(*field, "a content has no '" + std::string(key) +
                                  "'; allowed: object, content, address, word_order");
  for (const char* const key : {"object", "content"})
    if (fields[key] == nullptr)
      problems.report(fields.value(), "the key '" + std::string(key) + "' is missing");
}

}  // namespace

void add_device_content(const Fields& fields, std::uint32_t line, const Loading& loading,
                        std::vector<ModbusEntry>& entries, std::vector<NamedSignal>& signals) {
  Problems& problems = loading.problems;
  const std::size_t before = problems.count();
  refuse_other_keys(fields, problems);
  ModbusEntry shape;
  read_keys(fields, keys::kEntryShape, shape, loading);
  const auto object = read_value(fields, keys::kMapEntry["object"], loading);
  const auto content = read_value(fields, keys::kMapEntry["content"], loading);
  if (!object || !content || problems.count() != before) return;
  shape.line = line;
  const bool all = content->integer == static_cast<std::int64_t>(keys::DeviceContent::parameters);
  const std::uint64_t span = all ? kPerNumber * 3472 : Mco305Outside::kWords;
  if (shape.address + span > kRegisters)
    return problems.report(*fields["address"], "what stands from " + std::to_string(shape.address) +
                                                   " on goes beyond 65535; allowed: up to " +
                                                   std::to_string(kRegisters - span));
  const auto& device = *static_cast<const TechnologyObject*>(object->address);
  ContentWriter writer(device.name, shape, loading, entries, signals);
  if (all)
    writer.add_parameters();
  else
    writer.add_process_data();
}

}  // namespace lockstep
