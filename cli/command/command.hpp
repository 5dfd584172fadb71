/// The commands of `lockstep` and their exit statuses.
/// @source contract of the project file, section 3
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "projects/loader/project.hpp"
#include "projects/system/system.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace lockstep::cli {

/// Exit statuses, as the contract has them.
enum ExitStatus : int {
  kOk = 0,
  kNotValid = 1,        ///< the project is not valid; a name is unknown; an expectation does not hold
  kCouldNotStart = 2,   ///< a file cannot be read or written, a port is taken, the command line is wrong,
                        ///< nothing to test
  kStoppedByFault = 3,  ///< an internal fault, or the overrun policy
  kFailedOn = 4         ///< there was what --fail-on names
};

/// What a command does once the command line has been read; gives the exit status.
using Action = std::function<int()>;

void add_check_command(CLI::App& app, Action& action);
void add_run_command(CLI::App& app, Action& action);
void add_test_command(CLI::App& app, Action& action);
void add_studio_command(CLI::App& app, Action& action);
void add_connections_command(CLI::App& app, Action& action);
void add_describe_command(CLI::App& app, Action& action);
void add_tags_command(CLI::App& app, Action& action);
void add_read_command(CLI::App& app, Action& action);
void add_write_command(CLI::App& app, Action& action);
void add_plot_command(CLI::App& app, Action& action);
void add_monitor_command(CLI::App& app, Action& action);
void add_cam_command(CLI::App& app, Action& action);
void add_doctor_command(CLI::App& app, Action& action);
/// Behind all others, whose declarations it reads when it is carried out.
void add_completion_command(CLI::App& app, Action& action);

/// Makes all options and arguments of all commands refuse an empty text, as a script gives it whose variable
/// is not set, in place of taking it for one that is not there: the one rule of all of them. Behind the last
/// command.
void refuse_empty_texts(CLI::App& app);
/// The words of a command line with each "--option=" as two, of which the second is empty: CLI11 would take
/// the next one for its value.
std::vector<std::string> with_empty_texts(const std::vector<std::string>& words);

/// Whether warnings of a project are told: not by commands that use it and do not judge it.
enum class Warnings : std::uint8_t { told, kept };

/// Loads a project and tells its problems and warnings on standard error.
/// @param status the exit status if there is no project
/// @param prepare, use see `load_project`
std::optional<Project> load_or_tell(const std::string& path, int& status, const Prepare& prepare = {},
                                    Warnings warnings = Warnings::told, LoadedFor use = LoadedFor::running);

/// Loads a system file and tells its problems and warnings on standard error.
std::optional<System> load_system_or_tell(const std::string& path, int& status,
                                          LoadedFor use = LoadedFor::running,
                                          SeveralSources sources = SeveralSources::refused);

/// Writes a text to standard error, as far as that takes it. A closed terminal, a pipe without reader or a
/// full disk is no reason to end a run, and one that takes nothing, such as a stopped terminal, holds nothing
/// up for longer than `timeout` [ms]. The text goes out as it is; what others wrote goes through `tell`.
void write_message(const std::string& text, int timeout = 500) noexcept;

/// How grave a message is. Where standard error is the journal of systemd, it is told that.
enum class Severity : std::uint8_t { error = 3, warning = 4, information = 6 };

/// Writes one line to standard error: "lockstep: " and the text, which begins with "warning: " for a warning.
/// Parts of it may come from files and networks: what a terminal would obey is shown as "?".
void tell(const std::string& text, Severity severity = Severity::information) noexcept;
/// Writes one line to standard error, without the name of the program; otherwise as `tell`.
void tell_line(const std::string& text, Severity severity) noexcept;

}  // namespace lockstep::cli
