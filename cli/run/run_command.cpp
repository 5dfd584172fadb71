// lockstep run: command line.
#include "cli/run/run_command.hpp"

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "cli/command/command.hpp"
#include "cli/describe/subject.hpp"
#include "projects/literals/duration.hpp"
#include "projects/system/system.hpp"

namespace lockstep::cli {

void add_run_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("run", "Run a project, in real time or simulated");
  auto options = std::make_shared<RunOptions>();
  options->mark = "--";
  options->describe = [](const std::string& path) { return describe_as_json(path); };
  auto duration = std::make_shared<std::string>();
  command
      ->add_option("FILE", options->file, "the project file, or the file of a system of several controllers")
      ->required();
  auto* simulate = command->add_flag(
      "--simulate", options->simulate,
      "virtual time, as fast as the machine can; the same file gives the same trace, bit for bit");
  command->add_option("--duration", *duration,
                      "end after that much virtual or real time, such as 5s or 1.5min");
  command->add_option(
      "--trace", options->trace,
      "record the trace signals: FILE.csv, or FILE.lcm for a log that lcm-logplayer replays; of a "
      "system a file for each controller, its name before the end");
  command->add_option(
      "--transcript", options->transcript,
      "write what was sent on lines to LinMot controllers, and answered, with its time: FILE.csv");
  command
      ->add_option("--signals", options->signals,
                   "record these signals instead of the project's, comma separated")
      ->delimiter(',');
  command->add_flag("--stimuli", options->stimuli, "apply the project's stimuli in real time too");
  command
      ->add_option(
          "--cpu", options->cpu,
          "keep the cycle on this processor, from 0, and everything else off it: what Modbus clients "
          "and traces cost is not felt in a tick")
      ->check(CLI::NonNegativeNumber)
      ->excludes(simulate);
  auto controller = std::make_shared<std::string>();
  command
      ->add_option("--controller", *controller,
                   "of a system file: run this controller here, in real time; others run elsewhere")
      ->excludes(simulate);
  auto* modbus = command->add_option("--modbus", options->modbus,
                                     "listen on HOST:PORT instead of where the project says");
  command->add_flag("--no-modbus", options->no_modbus, "no Modbus server")->excludes(modbus);
  auto* lcm = command->add_option("--lcm", options->lcm, "publish on this URL instead of the project's");
  command->add_flag("--no-lcm", options->no_lcm, "no LCM")->excludes(lcm);
  auto* retain =
      command->add_option("--retain", options->retain, "keep values in this file instead of the project's")
          ->excludes(simulate);
  command->add_flag("--no-retain", options->no_retain, "begin with init values and keep nothing")
      ->excludes(retain);
  auto* studio = command->add_option(
      "--studio", options->studio,
      "show on HOST:PORT, to a browser, how the machine stands: signals, jobs, alarms, live");
  command
      ->add_option("--studio-token-file", options->studio_token,
                   "file of the token that it asks for, which is needed beyond this machine")
      ->needs(studio);
  command
      ->add_option("--studio-host", options->studio_names,
                   "a further name by which it may be called, such as that of a proxy")
      ->needs(studio);
  command->add_flag("--studio-write", options->studio_write,
                    "pages may write, and command the axes that the project names in studio.commands");
  command->add_flag("--no-studio", options->no_studio, "no studio, whatever the project says")
      ->excludes(studio);
  command->add_option("--audit", options->audit,
                      "append who writes or commands what to this file instead of the project's");
  auto fail_on = std::make_shared<std::vector<std::string>>();
  command
      ->add_option("--fail-on", *fail_on,
                   "exit with 4 if there was such a thing, comma separated: alarm (one with a reaction, or "
                   "that has to "
                   "be acknowledged), warning (any alarm, warnings too, which go by themselves), job (one "
                   "that failed)")
      ->delimiter(',')
      ->check(CLI::IsMember({"alarm", "warning", "job"}));
  command->footer(
      "Without --simulate it runs in real time until SIGINT or SIGTERM (or --duration), then brings its axes "
      "to\n"
      "rest. What follows has five seconds; a second signal makes it a moment. A closed terminal does not "
      "end "
      "it.\n"
      "Of a system file each controller runs in a process of its own, all on this machine, and all come to "
      "rest\n"
      "when one of them fails; with --controller one of them here, the others elsewhere; with --simulate all "
      "in "
      "this\n"
      "process. Signals of --signals begin with their controller (CONTROLLER.PATH).\n"
      "With --simulate it runs to the end of --duration, without it until a signal comes, too; Modbus, LCM "
      "and\n"
      "the audit log are off unless asked for.\n"
      "Values that are kept stand, unless named, beside the project file or in the state directory of "
      "systemd.\n"
      "Exit status: 0 ended as asked, 1 project not valid, 2 could not start, or what it simulated is not "
      "whole in\n"
      "the file of --trace or --transcript, 3 stopped by an internal fault or by the overrun policy, or "
      "something did\n"
      "not come to its end, 4 there was what --fail-on names, or events were lost and nobody knows");
  command->callback([&action, options, controller, duration, fail_on] {
    if (!duration->empty()) {
      std::string problem;
      const auto value = parse_duration(*duration, problem);
      if (!value) throw CLI::ValidationError("--duration", problem);
      if (*value <= 0)
        throw CLI::ValidationError("--duration", *duration + ": has to be longer than nothing");
      options->duration = *value;
    }
    const auto named = [&](const char* what) { return std::ranges::find(*fail_on, what) != fail_on->end(); };
    const FailOn fails{
        .alarm = named("alarm") || named("warning"), .warning = named("warning"), .job = named("job")};
    action = [options, controller, fails] {
      if (!controller->empty()) return run_controller(*options, *controller, fails);
      return is_system_file(options->file) ? run_system(*options, fails) : run_project(*options, fails);
    };
  });
}

}  // namespace lockstep::cli
