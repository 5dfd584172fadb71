/// The parts of the loader; each reads one section of the project file into the project.
#pragma once

#include <unordered_map>

#include "projects/json/fields.hpp"
#include "projects/loader/project_contents.hpp"
#include "scheduler/mco305/mco305.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"
#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "tech_objects/sensing/measuring_input.hpp"
#include "tech_objects/switching/cam_track.hpp"
#include "tech_objects/switching/output_cam.hpp"

namespace lockstep {

/// What the parts share while a project is being loaded.
struct Loading {
  Project& project;
  Problems& problems;
  /// The instance of each call of a function block, as far as its type is known.
  std::unordered_map<const JsonValue*, Instance*>& instances;
  /// Of the project file, to which names of files are relative; empty: the current one.
  std::string folder;
  /// Where each name was added first, in lower case.
  std::unordered_map<std::string, const JsonValue*>& named;
  /// Of a project that is looked at the axes are no `Axis` but a `LookedAtAxis` each.
  LoadedFor use;
  const UsedOutside& used_outside;

  Controller& controller() const { return *project.controller; }
  Names& names() const { return project.names; }
  /// Adds a technology object; its number is its index among all.
  TechnologyObject& add_object(ObjectKind kind, const std::string& name) const;
  /// The leading values of a synchronous axis.
  const std::vector<LeadingValue>& leading_values_of(const TechnologyObject& axis) const;
  /// Adds a name, or reports what is wrong with it.
  bool add_name(const JsonValue& at, std::string_view name, Names::Entity entity) const;
  /// Whether telegrams for a proxy come from outside of the project.
  bool is_led_from_outside(std::string_view proxy) const { return used_outside.contains(fold(proxy)); }
  /// The place to which a path leads, or none: then that is reported, unless the problem is known already.
  std::optional<Operand> find(const JsonValue& at, std::string_view path) const;
  /// `find` for a path whose index may be missing, as in "points[].x".
  std::optional<Operand> find_elements(const JsonValue& at, std::string_view path) const;
  /// A technology object of one of the kinds, or nullptr: then that is reported, unless the problem is known
  /// already.
  TechnologyObject* find_object(const JsonValue* name, ObjectKinds kinds) const;
};

void load_clock(const JsonValue& clock, const Loading& loading);
void load_tags(const JsonValue& tags, const Loading& loading);
/// Reads { tag: constant, … }; whatever is wrong is reported.
/// @param who sets them, for messages, such as "a stimulus"
std::vector<Assignment> read_assignments(const JsonValue* json, std::string_view who, const Loading& loading);

/// Adds all objects and their names; `load_objects` then reads them, when all names are there.
void declare_objects(const JsonValue& objects, const Loading& loading);
void load_objects(const JsonValue& objects, const Loading& loading);
/// What an encoder measures; what a measuring input sees, and of what it measures the position.
void load_encoder(const JsonValue& json, ExternalEncoder& encoder, const Loading& loading);
void load_measuring_input(const JsonValue& json, MeasuringInput& input, const Loading& loading);
/// What switches an output, by whose position, and where the times of its edges stand.
void load_output_cam(const JsonValue& json, OutputCam& cam, const Loading& loading);
void load_cam_track(const JsonValue& json, CamTrack& track, const Loading& loading);
/// Outputs that several cams switch; when all have been loaded.
void check_outputs(const JsonValue& objects, const Loading& loading);
/// Defines a cam and interpolates it.
void load_cam(const JsonValue& json, Cam& cam, const Loading& loading);
/// Parameters, wiring and programs of an MCO 305.
void load_mco305(const JsonValue& json, Mco305& device, const Loading& loading);
/// Parameters, motors, curves, tables and wiring of a LinMot controller.
void load_linmot(const JsonValue& json, LinMotController& controller, const Loading& loading);
/// When the objects are loaded.
void load_ascii_lines(const JsonValue& json, const Loading& loading);
/// A stimulus that is a command on a line. @param at [ns]
void load_scripted_command(const JsonValue& json, std::int64_t at, const Loading& loading);
/// Whether a leading value can be delayed for so long [s].
void check_delay(const JsonValue& config, double delay, const Loading& loading);
/// Sets the start values of one object.
void load_configuration(const JsonValue& config, TechnologyObject& object, const Loading& loading);

/// Adds all instances and their names; `load_programs` then compiles, when all names are there.
void declare_instances(const JsonValue& programs, const Loading& loading);
void load_programs(const JsonValue& programs, const Loading& loading);
void load_stimuli(const JsonValue& stimuli, const Loading& loading);

/// What the file has of leading values that cross; each may be nullptr.
struct TransferSections {
  const JsonValue* areas = nullptr;
  const JsonValue* network = nullptr;
  const JsonValue* objects = nullptr;
};
/// When the objects are loaded.
void load_transfer_areas(const TransferSections& sections, const Loading& loading);
/// Refuses devices that lead themselves, through whatever they follow. When the transfer areas are loaded.
void refuse_circles(const JsonValue& objects, const Loading& loading);

void load_modbus(const JsonValue* modbus, const Loading& loading);
void load_trace(const JsonValue& trace, const Loading& loading);
/// The axes that take commands by a route: makes the instances that carry them out. When programs are loaded.
void load_commands(const JsonValue& commands, CommandRoute route, const Loading& loading);
/// After the trace, whose network may have given commands to the same axes.
void load_studio(const JsonValue& json, const Loading& loading);
/// Networks from which clients may come. @param json may be nullptr
void load_networks(const JsonValue* json, std::vector<IpNetwork>& networks, Problems& problems);
/// When tags and objects are loaded.
void load_retain(const JsonValue* retain, const Loading& loading);
void load_flight_recorder(const JsonValue& json, const Loading& loading);
void load_audit(const JsonValue& json, const Loading& loading);
/// What a test expects, and how long it goes on; either may be nullptr. When all names are there.
void load_expectations(const JsonValue* json, const JsonValue* duration, const Loading& loading);

}  // namespace lockstep
