#!/usr/bin/env bash
# The man page of the command, from what its --help says: command_man.sh LOCKSTEP VERSION OUTPUT
set -euo pipefail
readonly lockstep=$1 version=$2 output=$3
exec >"$output.new"

# Text as it stands: a backslash and what begins a line of roff are no commands.
verbatim() { printf '.nf\n'; sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\([.']\)/\\\\\&\1/"; printf '.fi\n'; }

commands=$("$lockstep" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[[ -n $commands ]] || { echo "no commands in --help" >&2; exit 1; }
cat <<HEAD
.TH LOCKSTEP 1 "" "lockstep $version" "Lockstep"
.SH NAME
lockstep \- motion\-control runtime for coupled axes
.SH SYNOPSIS
.B lockstep
.I COMMAND
.RI [ OPTIONS ]
.SH DESCRIPTION
HEAD
"$lockstep" --help | verbatim
echo '.SH COMMANDS'
for command in $commands; do
  printf '.SS lockstep %s\n' "$command"
  COLUMNS=78 "$lockstep" "$command" --help | verbatim
done
cat <<'TAIL'
.SH FILES
.TP
.I /usr/share/lockstep/projects
examples. Copy one to run it: the values that it keeps stand beside its file
.TP
.I /etc/lockstep/NAME/project.json
what the service
.B lockstep@NAME
runs; see
.BR lockstep\-project (5)
.TP
.I /var/lib/lockstep/NAME/project.retain
the values that it keeps across runs
.SH ENVIRONMENT
.TP
.B STATE_DIRECTORY
where values are kept if neither the command line nor the project says, and flight records whose path is relative
.TP
.B JOURNAL_STREAM
set by systemd; messages to the journal have priorities
.SH SIGNALS
SIGINT and SIGTERM end a run: programs stop, the axes are brought to rest within 10 seconds, retained values are kept. SIGHUP does
nothing.
.SH SEE ALSO
.BR lockstep\-project (5),
.BR lockstep\-language (7),
.BR lockstep\-blocks (7),
.BR systemctl (1)
TAIL
mv "$output.new" "$output"
