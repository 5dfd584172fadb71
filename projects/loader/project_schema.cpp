#include "projects/loader/project_schema.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "fb/block.hpp"
#include "hmi_bridge/modbus/serial.hpp"
#include "projects/cam_files/schema.hpp"
#include "projects/json/project_keys.hpp"
#include "projects/loader/configuration_tree.hpp"
#include "tech_objects/drive/drive_models.hpp"
#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {
namespace {

using Json = nlohmann::ordered_json;
using Members = std::initializer_list<std::pair<std::string_view, Json>>;

/// An object with the keys that the loader accepts. @throws std::logic_error if one of them is not described
Json object(Keys keys, const Members& members) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Key& key : keys) {
    const auto* const member =
        std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.first == key.name; });
    if (member == members.end()) throw std::logic_error("no schema for the key " + std::string(key.name));
    properties[std::string(key.name)] = member->second;
    if (key.required) required.push_back(key.name);
  }
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json described(std::string_view description, const Json& schema) {
  Json result = {{"description", description}};
  result.update(schema);
  return result;
}

Json text(std::string_view description) {
  return described(description, {{"type", "string"}});
}
Json integer(std::string_view description, std::int64_t lowest, std::int64_t highest) {
  return described(description, {{"type", "integer"}, {"minimum", lowest}, {"maximum", highest}});
}
Json duration(std::string_view description) {
  return text(std::string(description) + ": a duration such as 10ms, 1.5s, T#1s500ms");
}
Json words(std::string_view description, std::span<const std::string_view> list) {
  return described(description, {{"enum", Json(std::vector<std::string_view>(list.begin(), list.end()))}});
}
Json reference(std::string_view definition) {
  return {{"$ref", "#/definitions/" + std::string(definition)}};
}
Json array(std::string_view description, Json items) {
  return described(description, {{"type", "array"}, {"items", std::move(items)}});
}
Json map(std::string_view description, Json values) {
  return described(description, {{"type", "object"}, {"additionalProperties", std::move(values)}});
}
Json value(std::string_view description) {
  return described(description, {{"type", {"boolean", "number", "string"}}});
}

Json default_of(const Variable& variable) {
  const Value start = variable.start_value();
  if (variable.type == Type::BOOL) return start.u != 0;
  if (is_real(variable.type)) return start.r;
  if (is_signed_integer(variable.type)) return start.i;
  return start.u;
}

Json variable_schema(const Variable& variable) {
  std::string description(variable.text);
  if (variable.unit != Unit::kNone) description += " [" + std::string(unit_text(variable.unit)) + "]";
  if (variable.later) description += " (no effect yet)";
  if (variable.type == Type::TAG) return text(description + ": the name of a BOOL tag");
  Json schema = {{"description", description}};
  const bool real = is_real(variable.type);
  schema["type"] = variable.type == Type::BOOL ? "boolean" : real ? "number" : "integer";
  if (variable.type != Type::BOOL) {
    const auto bound = [&](double limit) {
      return real ? Json(limit) : Json(static_cast<std::int64_t>(limit));
    };
    if (!variable.choices.empty()) {
      for (const Choice& choice : variable.choices) schema["enum"].push_back(choice.value);
    } else if (variable.range.highest < std::numeric_limits<double>::max()) {
      schema["minimum"] = bound(variable.range.lowest);
      schema["maximum"] = bound(variable.range.highest);
    }
  }
  schema["default"] = default_of(variable);
  return schema;
}

/// A structure of the configuration. Elements of an array become definitions, which the elements refer to.
Json structure_schema(const ConfigurationNode& structure, Json& definitions) {
  constexpr std::size_t kListedElements = 100;  // of longer arrays an editor gets the kind of element only
  Json properties = Json::object();
  Json others = Json::array();
  for (const auto& child : structure.children) {
    if (child->computed()) continue;
    const std::string name(child->name);
    Json schema = child->variable != nullptr ? variable_schema(*child->variable)
                                             : structure_schema(*child, definitions);
    if (child->count == 0) {
      properties[name] = std::move(schema);
      continue;
    }
    definitions[name] = std::move(schema);
    if (child->count > kListedElements) {
      others.push_back(reference(name));
      continue;
    }
    for (std::size_t i = 1; i <= child->count; ++i)
      properties[name + "[" + std::to_string(i) + "]"] = reference(name);
  }
  const Json rest = others.empty() ? Json(false) : Json{{"anyOf", others}};
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", rest}};
}

std::vector<std::string_view> block_names() {
  std::vector<std::string_view> names;
  for (const BlockType& type : block_types()) names.push_back(type.name);
  return names;
}

std::vector<std::string_view> tag_type_names() {
  std::vector<std::string_view> names;
  for (int type = 0; type <= static_cast<int>(Type::TIME); ++type)
    names.push_back(type_name(static_cast<Type>(type)));
  return names;
}

Json number(std::string_view description, double lowest, double highest) {
  return described(description, {{"type", "number"}, {"minimum", lowest}, {"maximum", highest}});
}

Json place(std::string_view description) {
  return described(description, {{"type", "number"}, {"minimum", -1e12}, {"maximum", 1e12}});
}

Json range(std::string_view description) {
  Json schema = array(description, place("[u]"));
  schema["minItems"] = schema["maxItems"] = 2;
  return schema;
}

Json zero_marks_schema() {
  return object(keys::kZeroMarks,
                {{"position", place("of a zero mark [u]")},
                 {"period", number("after which the next one follows [u]; 0: there is one only", 0, 1e12)}});
}

Json reference_cam_schema() {
  return range("positions in which the reference cam is active");
}

/// The encoders of an axis beside that of the drive.
Json sensors_schema() {
  return array(
      "encoders beside that of the drive",
      object(keys::kSensor,
             {{"sensor", number("its number, of Sensor[2] to Sensor[4]", 2, 4)},
              {"ratio", number("user units that it tells per unit of the machine, not 0", -1e12, 1e12)},
              {"resolution", number("increment [u]; 0: none", 0.0, 1e12)},
              {"inverted", described("it turns the other way round than the machine", {{"type", "boolean"}})},
              {"start_position", place("what it tells at the beginning, of an absolute one [u]")},
              {"fault", text("BOOL tag: while TRUE it tells nothing")}}));
}

Json encoder_schema(const Json& type, const Json& config) {
  const Json encoder = object(
      keys::kEncoder,
      {{"model", words("kind of the encoder", words::kModels)},
       {"follows", text("axis on whose load it sits; or 'signal'")},
       {"ratio", number("user units of the encoder per unit of that axis, not 0", -1e12, 1e12)},
       {"signal", text("number whose value is the position: tag, instance.Pin or Object.Variable")},
       {"valid", text("BOOL tag: whether the signal is heard of; FALSE is a fault of the encoder (411), "
                      "but for the time before it is TRUE first. With 'signal' only")},
       {"wrap", number("length at which the signal wraps [u]", 0.001, 1e12)},
       {"resolution", number("increment of the encoder [u]; 0: none", 0.0, 1e12)},
       {"noise", number("largest deviation of a reading to either side [u]", 0.0, 1e12)},
       {"zero_marks", zero_marks_schema()},
       {"reference_cam", reference_cam_schema()}});
  return object(keys::kEncoderObject, {{"type", type}, {"config", config}, {"encoder", encoder}});
}

Json measuring_input_schema(const Json& type, const Json& config) {
  const Json marks =
      object(keys::kMarks,
             {{"period", number("distance from mark to mark [u]", 0.001, 1e12)},
              {"offset", number("beginning of a mark [u]", -1e12, 1e12)},
              {"width", number("of a mark [u], less than the period; half of it if not given", 0.0, 1e12)}});
  return object(keys::kMeasuringInputObject,
                {{"type", type},
                 {"config", config},
                 {"assigned_to", text("axis or external encoder whose position is measured")},
                 {"marks", described("print marks that the input sees", marks)}});
}

Json output_cam_schema(const Json& type, const Json& config) {
  const Json times = object(
      keys::kSwitchingTimes,
      {{"on", text("LREAL tag: when the output has gone on last [s], more finely than in servo cycles")},
       {"off", text("LREAL tag: when it has gone off last [s]")}});
  return object(keys::kOutputCamObject,
                {{"type", type},
                 {"config", config},
                 {"assigned_to", text("axis or external encoder whose position switches, or is measured")},
                 {"switching_times", times}});
}

Json objects_schema() {
  const Json leading_value =
      object(keys::kLeadingValue, {{"to", text("name of the leading axis")},
                                   {"coupling", words("how its value is taken", words::kCouplings)}});
  const Json limit_switches =
      object(keys::kLimitSwitches, {{"min", place("from here downwards the negative one is pressed [u]")},
                                    {"max", place("from here upwards the positive one is pressed [u]")}});
  const Json digital_input =
      object(keys::kDigitalInput, {{"tag", text("BOOL tag that the machine writes in every servo cycle")},
                                   {"range", range("positions in which it is TRUE")}});
  const Json fixed_stop = object(
      keys::kFixedStop, {{"position", place("on the scale of the machine, where it is touched [u]")},
                         {"stiffness", number("torque at the motor per way into it [Nm/u]", 1e-12, 1e12)},
                         {"direction", words("of the motion that meets it", words::kDirections)}});
  const Json plant = object(
      keys::kPlant,
      {{"inertia", number("of all that moves, at the motor [kg m²; of a linear motor N s²/u]", 1e-12, 1e12)},
       {"friction", number("dry friction, as torque at the motor", 0.0, 1e12)},
       {"load_torque", number("pushes the machine, at the motor; positive: forwards", -1e12, 1e12)},
       {"maximum_torque", number("of the drive", 1e-12, 1e12)},
       {"fixed_stop", described("something immovable in the way", fixed_stop)}});
  const Json faults =
      object(keys::kFaults, {{"drive", text("BOOL tag: while TRUE the drive has a fault")},
                             {"encoder", text("BOOL tag: while TRUE the encoder tells nothing")},
                             {"communication", text("BOOL tag: while TRUE the drive is not heard")},
                             {"blocked", text("BOOL tag: while TRUE the machine cannot move")}});
  const Json drive = object(
      keys::kDrive, {{"model", words("kind of the drive", kDriveModelNames)},
                     {"time_constant", duration("lag of the velocity loop")},
                     {"dead_time", duration("dead time of the velocity loop")},
                     {"encoder_resolution", described("increment of the encoder [u]; 0: none",
                                                      {{"type", "number"}, {"minimum", 0}})},
                     {"inverted", described("motor and encoder turn the other way round than the machine",
                                            {{"type", "boolean"}})},
                     {"start_position", place("of the machine, on its own scale [u]")},
                     {"zero_marks", zero_marks_schema()},
                     {"reference_cam", reference_cam_schema()},
                     {"limit_switches", limit_switches},
                     {"digital_inputs", array("switches that are tags", digital_input)},
                     {"quick_stop_deceleration",
                      number("of a quick stop (OFF3) [u/s²]; 0: as hard as the drive can", 0.0, 1e12)},
                     {"plant", described("what the drive moves", plant)},
                     {"faults", described("what goes wrong, and when", faults)},
                     {"position_cycle", duration("cycle of the position loop in the drive (DSC)")},
                     {"sensors", sensors_schema()}});
  const Json type = words("published type", words::kObjectTypes);
  const Json config = {{"anyOf",
                        {reference("config"), reference("speed_axis_config"), reference("encoder_config"),
                         reference("measuring_input_config"), reference("output_cam_config"),
                         reference("cam_track_config"), reference("cam_config")}}};
  const Json axis =
      object(keys::kObject, {{"type", type},
                             {"config", config},
                             {"drive", drive},
                             {"leading_values", array("axes that this one may follow", leading_value)}});
  const Json definition = cam_definition_schema();
  const Json cam =
      object(keys::kCam, {{"type", type},
                          {"config", config},
                          {"elements", definition["elements"]},
                          {"optimization", definition["optimization"]},
                          {"points", definition["points"]},
                          {"segments", definition["segments"]},
                          {"file", text("cam file beside the project, instead of what else defines a cam")}});
  Json any = axis;
  for (const Json& other : {encoder_schema(type, config), measuring_input_schema(type, config),
                            output_cam_schema(type, config), cam})
    any["properties"].update(other["properties"]);
  return map("name: technology object", any);
}

/// One schema for all kinds of calls: which keys go together is told by `dependencies`.
Json call_schema() {
  Json schema = object(keys::kCall, {{"fb", words("function block", block_names())},
                                     {"name", text("name of the instance")},
                                     {"in", map("pin: value, expression or technology object",
                                                value("value, expression or technology object"))}});
  const Json set = object(keys::kSet, {{"set", text("tag or writable variable to assign to")},
                                       {"to", value("value or expression")}});
  const Json start = object(keys::kSetStart, {{"set_start", text("variable whose start value is changed; it "
                                                                 "counts with a restart by MC_Reset")},
                                              {"to", value("value or expression")}});
  const Json branch = object(keys::kIf, {{"if", value("BOOL value or expression")},
                                         {"then", array("what runs if it is TRUE", reference("call"))},
                                         {"else", array("what runs if it is FALSE", reference("call"))}});
  schema["properties"].update(set["properties"]);
  schema["properties"].update(start["properties"]);
  schema["properties"].update(branch["properties"]);
  schema.erase("required");
  schema["dependencies"] = {{"fb", {"name"}},      {"name", {"fb"}}, {"in", {"fb"}},   {"set", {"to"}},
                            {"set_start", {"to"}}, {"if", {"then"}}, {"then", {"if"}}, {"else", {"if"}}};
  return schema;
}

Json programs_schema() {
  const Json program = object(
      keys::kProgram,
      {{"name", text("name of the program")},
       {"ob", words("organization block in which it runs", words::kObs)},
       {"cycle", duration("period of a Main or Cyclic program, a whole multiple of servo_cycle")},
       {"priority", integer("of a Cyclic program; the higher runs first", kLowestPriority, kHighestPriority)},
       {"calls", array("what runs, in this order", reference("call"))}});
  return array("programs", program);
}

/// A text or an array of texts, an object or an array of objects.
Json one_or_many(Json one, std::string_view description) {
  Json schema = described(description, one);
  schema["items"] = one;
  schema["type"] = {one["type"], "array"};
  return schema;
}

Json modbus_entry_schema() {
  return object(keys::kMapEntry,
                {{"tag", text("signal: tag (a text: two characters in a register), instance.Pin or "
                              "Object.Variable; elements of an array side by side: "
                              "array, array[*], array[2..5]")},
                 {"diagnostic",
                  text("in place of a tag: a number of the run, such as ticks, overruns, alarms, refused")},
                 {"table", words("table of Modbus", words::kTables)},
                 {"address", integer("zero-based address of the first register or of the bit", 0, 65535)},
                 {"type", words("type on the wire; it may narrow that of the signal", tag_type_names())},
                 {"word_order", words("big: most significant register first", words::kWordOrders)},
                 {"byte_order", words("big: more significant byte of a register first", words::kWordOrders)},
                 {"bit", integer("a BOOL as this bit of a register, which several may share", 0, 15)},
                 {"scale", described("of a REAL or LREAL as an integer: value = integer * scale + offset",
                                     {{"type", "number"}})},
                 {"offset", described("see scale", {{"type", "number"}})},
                 {"access", words("whether a client may write", words::kAccesses)}});
}

Json modbus_client_schema(const Json& serial) {
  const Json served = modbus_entry_schema();
  const Json& shapes = served["properties"];
  const Json entry =
      object(keys::kDeviceEntry, {{"tag", text("tag or variable, or elements of an array as in a map")},
                                  {"table", shapes["table"]},
                                  {"address", shapes["address"]},
                                  {"type", shapes["type"]},
                                  {"word_order", shapes["word_order"]},
                                  {"byte_order", shapes["byte_order"]},
                                  {"bit", shapes["bit"]},
                                  {"scale", shapes["scale"]},
                                  {"offset", shapes["offset"]},
                                  {"quality", text("BOOL tag: this entry went well in the last cycle")},
                                  {"age", text("TIME tag: since the last cycle in which it did")}});
  const Json device =
      object(keys::kDevice, {{"name", text("for messages")},
                             {"unit", integer("unit id (1)", 0, 255)},
                             {"cycle", duration("how often it is read and written")},
                             {"quality", text("BOOL tag: the last cycle went well")},
                             {"age", text("TIME tag: since the last cycle that went well")},
                             {"read", array("from the device into tags", entry)},
                             {"write", array("from tags and variables to the device", entry)}});
  return object(keys::kClient, {{"connect", text("HOST:PORT of the device or gateway")},
                                {"serial", described("RTU over a serial line, in place of connect", serial)},
                                {"timeout", duration("for connecting and for each answer (500ms)")},
                                {"devices", array("devices behind this connection", device)}});
}

Json watchdog_schema() {
  const Json watchdog = object(
      keys::kWatchdog,
      {{"tag", text("heartbeat: a tag of the map that a client writes; a change of its value is a sign of "
                    "life")},
       {"timeout", duration("without a sign of life after which there is silence")},
       {"set", map("tag: value, written in every tick while there is silence", value("constant"))},
       {"status", text("BOOL tag: there is silence")}});
  return one_or_many(watchdog, "what is done when a client that writes falls silent");
}

Json modbus_schema() {
  const Json watchdog = reference("modbus_watchdog");
  const Json unit =
      object(keys::kUnit, {{"unit", integer("unit id", 0, 255)},
                           {"map", array("which signal stands where", reference("modbus_entry"))},
                           {"watchdog", watchdog}});
  const Json own_map = array("a map of its own in place of the common one", reference("modbus_entry"));
  const Json units = array("maps of single unit ids in place of the one for all", unit);
  const Json serial =
      object(keys::kSerial,
             {{"device", text("serial line, such as /dev/ttyS0")},
              {"baud", described("bits per second (19200)", {{"enum", Json(kBauds)}})},
              {"parity", words("(even)", words::kParities)},
              {"stop_bits", integer("(1)", 1, 2)},
              {"silence", duration("that ends a frame; 3.5 characters and at least 1.75 ms if missing")}});
  const Json network = text("address or network, such as 192.168.1.0/24");
  const Json server = object(
      keys::kServer,
      {{"listen", one_or_many({{"type", "string"}}, "HOST:PORT, such as 127.0.0.1:1502 or [::1]:1502")},
       {"serial", described("RTU over a serial line, in place of listen", serial)},
       {"unit", integer("own address on the serial line (1)", 1, 247)},
       {"allow", array("from where clients may come; from everywhere if missing", network)},
       {"max_clients", integer("connected at the same time (64)", 1, 1000)},
       {"max_requests_per_second", integer("of one client; what is more waits", 1, 1'000'000)},
       {"max_clients_per_address",
        integer("of them from one address (three quarters of max_clients)", 1, 1000)},
       {"idle_timeout", duration("a client that asks for nothing for this long is disconnected")},
       {"map", own_map},
       {"watchdog", watchdog},
       {"units", units}});
  return object(keys::kModbus, {{"server", one_or_many(server, "where clients may ask")},
                                {"map", array("which signal stands where", reference("modbus_entry"))},
                                {"watchdog", watchdog},
                                {"units", units},
                                {"clients", array("foreign devices", modbus_client_schema(serial))}});
}

Json trace_schema() {
  const Json command_axis = object(
      keys::kCommandAxis,
      {{"jog_velocity",
        number("highest velocity of jogging, in the unit of the axis' velocities (DynamicDefaults.Velocity)",
               1e-12, 1e12)}});
  const Json commands =
      object(keys::kCommands, {{"axes", map("name of an axis, a speed axis too: its limits", command_axis)}});
  const Json lcm =
      object(keys::kLcm,
             {{"url", text("network, such as udpm://239.255.76.67:7667?ttl=0")},
              {"channel", text("channel of the rows")},
              {"commands", described("axes that take commands from panels; none if missing", commands)}});
  const Json signal = text("tag, instance.Pin, variable");
  const Json trigger = object(
      keys::kTrigger,
      {{"on", words("above, below: rows with the signal beyond the level; rising, falling: around the row in "
                    "which it passes the level; alarm: around an alarm",
                    words::kTriggers)},
       {"signal", signal},
       {"level", number("of the signal (0.5)", -1e300, 1e300)},
       {"before", duration("of which the rows before count as well (none)")},
       {"after", duration("of which the rows after count as well (none)")}});
  const Json channel =
      object(keys::kTraceChannel, {{"channel", text("channel of the rows")},
                                   {"signals", array("columns", signal)},
                                   {"every", integer("only each n-th row (1)", 1, 1'000'000'000)},
                                   {"trigger", described("only the rows at an occasion", trigger)}});
  return object(keys::kTrace,
                {{"lcm", lcm},
                 {"signals", array("columns of the trace", signal)},
                 {"channels", array("further channels of LCM, each with a part of the trace", channel)}});
}

Json flight_recorder_schema() {
  return object(
      keys::kFlightRecorder,
      {{"before", duration("how much is kept for the time before an alarm")},
       {"after", duration("how much is added behind it (none)")},
       {"file", text("FILE_20261123T115200Z_17.csv and its like are written, one for each alarm: time (UTC) "
                     "and a number that goes on from run to run; relative to the project file, in a "
                     "service to its state directory")},
       {"files", integer("at most so many in a run (10)", 1, 1000)},
       {"keep", integer("so many stay, those of earlier runs among them; the oldest are removed "
                        "(20)",
                        1, 10000)},
       {"signals",
        array("what is kept; everything that may change if missing", text("tag, instance.Pin, variable"))}});
}

Json audit_schema() {
  return object(keys::kAudit,
                {{"file", text("one JSON object a line for each write and command from outside")},
                 {"size", integer("of a file [byte], behind which the next one begins (16777216)", 4096,
                                  std::int64_t{1} << 40)},
                 {"files", integer("in all: FILE, FILE.1 and so on; the oldest gives way (10)", 2, 1000)}});
}

Json root_schema() {
  const Json clock =
      object(keys::kClock,
             {{"servo_cycle", duration("period of MC_Servo")},
              {"interpolator_ratio", integer("servo cycles per interpolator cycle", 1, 32)},
              {"processors", integer("that a tick uses for the axes, where there are many (1)", 1, 64)},
              {"overrun", words("what three overruns in a row do", words::kOverrun)}});
  const Json type = {
      {"description",
       "elementary type, STRING[n], or ARRAY[lower..upper] OF an elementary type or of a structure of cams"},
      {"anyOf", {words("elementary type", tag_type_names()), text("text of up to n characters, or array")}}};
  const Json init = described("value at the start; of an array [element, ...] from the first one on",
                              {{"type", {"boolean", "number", "string", "array"}}});
  const Json tag = object(keys::kTag, {{"type", type},
                                       {"init", init},
                                       {"retain", {{"type", "boolean"}, {"description", "kept across runs"}}},
                                       {"comment", text("for the reader")}});
  const Json retain =
      object(keys::kRetain, {{"file", text("where kept values stand, relative to the project file")},
                             {"interval", duration("between two writes of changed values (1s)")}});
  const Json stimulus = object(keys::kStimulus, {{"at", duration("time since the start")},
                                                 {"set", map("tag: value", value("constant"))}});
  return object(keys::kProject, {{"lockstep", described("version of the format", {{"enum", {1}}})},
                                 {"name", text("name of the project")},
                                 {"description", text("what the project does")},
                                 {"clock", clock},
                                 {"technology_objects", objects_schema()},
                                 {"tags", map("name: tag", tag)},
                                 {"programs", programs_schema()},
                                 {"stimuli", array("changes of tags in a simulation", stimulus)},
                                 {"modbus", modbus_schema()},
                                 {"trace", trace_schema()},
                                 {"flight_recorder",
                                  described("keeps what happened before an alarm", flight_recorder_schema())},
                                 {"audit", described("who has written or commanded what", audit_schema())},
                                 {"retain", retain}});
}

}  // namespace

std::string project_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Lockstep project"}};
  schema.update(root_schema());
  Json definitions = Json::object();
  const auto add_configuration = [&](const char* name, ObjectKind kind, std::string_view text) {
    const Json config = structure_schema(configuration_tree(kind), definitions);
    definitions[name] = described(text, config);
  };
  add_configuration("config", ObjectKind::TO_SynchronousAxis, "start values of the technology data block");
  add_configuration("speed_axis_config", ObjectKind::TO_SpeedAxis, "start values of a speed axis");
  add_configuration("encoder_config", ObjectKind::TO_ExternalEncoder, "start values of an external encoder");
  add_configuration("measuring_input_config", ObjectKind::TO_MeasuringInput,
                    "start values of a measuring input");
  add_configuration("output_cam_config", ObjectKind::TO_OutputCam, "start values of an output cam");
  add_configuration("cam_track_config", ObjectKind::TO_CamTrack, "start values of a cam track");
  add_configuration("cam_config", ObjectKind::TO_Cam_10k, "start values of the data block of a cam");
  definitions["call"] = call_schema();
  definitions.update(cam_schema_definitions());
  definitions["modbus_entry"] = modbus_entry_schema();
  definitions["modbus_watchdog"] = watchdog_schema();
  schema["definitions"] = definitions;
  return schema.dump(2) + "\n";
}

}  // namespace lockstep
