#!/usr/bin/env bash
# Builds the Debian package and looks at what is in it: run.sh SOURCES BUILD WORK.
set -euo pipefail
sources=$1 build=$2 work=$3
fail() { echo "FAILED: $*" >&2; exit 1; }
expect() { [[ $1 == *"$2"* ]] || fail "'$2' is missing in: $1"; }

rm -rf "$work"
mkdir -p "$work"
# Not compressed, which would take most of the time and is not what is looked at.
(cd "$build" && cpack -G DEB -D CPACK_DEBIAN_COMPRESSION_TYPE=none -B "$work/cpack") >"$work/cpack.log" || fail "cpack: $(tail -n 20 "$work/cpack.log")"
package=$(echo "$work"/cpack/lockstep_*.deb)
dpkg-deb -x "$package" "$work/root"

echo "what it says of itself"
control=$(dpkg-deb -f "$package")
expect "$control" "Package: lockstep"
depends=$(dpkg-deb -f "$package" Depends)
for library in libc6 libstdc++6 libmodbus5 libsqlite3-0 liblcm1; do expect "$depends" "$library"; done

expect "$depends" "libsqlite3-0 (>= 3.38)"

echo "what it does when it comes and goes"
dpkg-deb -e "$package" "$work/control"
for script in postinst prerm postrm; do
  [[ $(stat -c %a "$work/control/$script") == 755 ]] || fail "$script is not executable by all, writable by its owner alone"
  sh -n "$work/control/$script"
done
# In a system of its own, in which systemctl writes down what it is asked for.
rehearse() { # what SCRIPT ARGUMENT does
  mkdir -p "$work/stage/run/systemd/system" "$work/stage/var/lib/private/lockstep/press" "$work/stage/etc/lockstep/press"
  sed -e "s| /run| $work/stage/run|g" -e "s| /var| $work/stage/var|g" -e "s| /etc| $work/stage/etc|g" \
    -e "s|systemctl |echo |" "$work/control/$1" >"$work/stage/$1"
  sh "$work/stage/$1" "$2"
}
[[ $(rehearse prerm upgrade) == "" ]] || fail "an upgrade stops machines"
expect "$(rehearse prerm remove)" "stop lockstep@*.service"
expect "$(rehearse postinst configure)" "daemon-reload"
expect "$(rehearse postrm remove)" "daemon-reload"
[[ -d $work/stage/var/lib/private/lockstep ]] || fail "a removal takes retained values along"
rehearse postrm purge >/dev/null
[[ ! -e $work/stage/var/lib/private/lockstep ]] || fail "a purge leaves retained values"
[[ -d $work/stage/etc/lockstep/press ]] || fail "a purge takes projects along"

echo "what is in it"
for path in bin/lockstep share/man/man1/lockstep.1.gz share/man/man5/lockstep-project.5.gz share/man/man7/lockstep-language.7.gz \
  share/man/man7/lockstep-blocks.7.gz share/bash-completion/completions/lockstep share/zsh/vendor-completions/_lockstep \
  share/fish/vendor_completions.d/lockstep.fish \
  lib/systemd/system/lockstep@.service include/lockstep/projects/loader/simulation.hpp \
  share/lockstep/project.schema.json share/lockstep/part.schema.json share/lockstep/system.schema.json share/lockstep/projects/02_rotary_knife/project.json \
  share/doc/lockstep/lockstep.spdx.json share/doc/lockstep/copyright share/doc/lockstep/documents/README.md share/lockstep/README.md share/lockstep/LICENSE \
  share/lockstep/projects/README.md share/lockstep/projects/PLANT.md share/lockstep/projects/LANGUAGE.md share/lockstep/projects/FUNCTIONS.md \
  share/lockstep/projects/KEYS.md share/lockstep/projects/CAMS.md share/lockstep/fb/BLOCKS.md share/lockstep/hmi_bridge/MODBUS.md \
  share/lockstep/hmi_bridge/lcm/trace.lcm share/lockstep/hmi_bridge/lcm/command.lcm share/lockstep/hmi_bridge/lcm/leading_value.lcm \
  share/lockstep/hmi_bridge/subscriber/subscriber.py share/lockstep/hmi_bridge/subscriber/subscriber.cpp share/lockstep/hmi_bridge/tls/certificates.sh; do
  [[ -s $work/root/usr/$path ]] || fail "usr/$path is not in the package"
done
[[ -n $(find "$work/root/usr/lib" -name LockstepConfig.cmake) ]] || fail "no CMake package"
[[ -z $(find "$work/root" -perm /022 ! -type l) ]] || fail "others may write: $(find "$work/root" -perm /022 ! -type l)"
[[ -z $(find "$work/root" -mindepth 1 -maxdepth 1 ! -name usr) ]] || fail "it has more than usr/"
! grep -rIl "$sources" "$work/root/usr/lib" "$work/root/usr/share" "$work/root/usr/include" || fail "paths of the build"

for file in "$work"/root/usr/share/lockstep/projects/*/*.json; do
  schema=$(sed -n 's/^ *"$schema": "\([^"]*\)".*/\1/p' "$file")
  [[ -z $schema || -s $(dirname "$file")/$schema ]] || fail "$file: its schema $schema is not in the package"
done

echo "its documents lead nowhere that is not in it"
dead=$("$sources/tests/package/check_links.py" "$work/root/usr/share") || fail "dead links: $dead"
printf '# A\n\n[there](missing.md), not `[this](code.md)`\n' >"$work/root/usr/share/lockstep/DEAD.md"
dead=$("$sources/tests/package/check_links.py" "$work/root/usr/share") && fail "a dead link passes"
[[ $dead == "lockstep/DEAD.md: missing.md" ]] || fail "a dead link is told otherwise: $dead"
rm "$work/root/usr/share/lockstep/DEAD.md"

echo "its program runs"
lockstep=$work/root/usr/bin/lockstep
"$lockstep" check "$work/root/usr/share/lockstep/projects/02_rotary_knife/project.json"
expect "$("$lockstep" --help)" "lockstep check $work/root/usr/share/lockstep/projects/02_rotary_knife/project.json"
version=$(sed -n 's/^project(lockstep VERSION \([0-9.]*\).*/\1/p' "$sources/CMakeLists.txt")
[[ $("$lockstep" --version) == "lockstep $version" ]] || fail "it is $("$lockstep" --version), not $version"
[[ $(dpkg-deb -f "$package" Version) == "$version" ]] || fail "the package has another version"

echo "the first motion that README tells, with what is in the package"
mkdir -p "$work/first"
{
  printf 'set -e\ncd "%s"\napt() { :; }\nlockstep() { "%s" "$@"; }\n' "$work/first" "$lockstep"
  sed -n '/^## See it run/,/^## Your first/p' "$sources/README.md" | sed -n '/^```sh$/,/^```$/{/^```/d;p}' |
    sed "s|/usr/share/lockstep|$work/root/usr/share/lockstep|g"
} >"$work/first.sh"
grep -q -- --simulate "$work/first.sh" || fail "README tells no first motion"
begin=$SECONDS
bash "$work/first.sh" >"$work/first.log" 2>&1 || fail "the first motion: $(cat "$work/first.log")"
((SECONDS - begin < 120)) || fail "it takes $((SECONDS - begin)) s"
[[ -s $work/first/motion.csv && -s $work/first/motion.svg ]] || fail "no trace or no picture of it"

echo "shells find what completes its command line"
bash -c '. "$1"; complete -p lockstep' sh "$work/root/usr/share/bash-completion/completions/lockstep" >/dev/null ||
  fail "bash gets no completion"
cmp <("$lockstep" completion fish) "$work/root/usr/share/fish/vendor_completions.d/lockstep.fish" || fail "that of fish is not its own"
cmp <("$lockstep" completion zsh) "$work/root/usr/share/zsh/vendor-completions/_lockstep" || fail "that of zsh is not its own"

echo "its man pages are well formed and complete"
gunzip -k "$work/root/usr/share/man"/man?/lockstep*.gz
for page in man1/lockstep.1 man5/lockstep-project.5 man7/lockstep-language.7 man7/lockstep-blocks.7; do
  complaints=$(groff -k -man -Tutf8 -ww -z "$work/root/usr/share/man/$page" 2>&1)
  [[ -z $complaints ]] || fail "$page: $complaints"
done
text=$(groff -k -man -Tascii -P-c -P-b -P-u "$work/root/usr/share/man/man1/lockstep.1" 2>/dev/null)
for word in $("$lockstep" run --help | grep -o '^  --[a-z-]*'); do expect "$text" "$word"; done
for command in check run describe tags read write plot monitor cam doctor aposs completion; do expect "$text" "lockstep $command"; done
text=$(groff -k -man -Tascii -P-c -P-b -P-u "$work/root/usr/share/man/man5/lockstep-project.5" 2>/dev/null)
for key in servo_cycle technology_objects programs retain listen; do expect "$text" "$key"; done
# Each key of the program's own tables is a paragraph of the page, with what is said of it.
keys=$("$lockstep" describe keys --json | python3 -c 'import json, sys
for key in {key["name"] for structure in json.load(sys.stdin)["structures"] for key in structure["keys"]}: print(key)')
for key in fb in set set_start if then else to config; do keys+=$'\n'$key; done
while read -r key; do  # a name of more than one word, too
  awk -v key="$key" '{ sub(/^ +/, "") } index($0 " ", key " ") == 1 { found = 1 } END { exit !found }' <<<"$text" ||
    fail "lockstep-project(5) says nothing of $key"
done <<<"$keys"
grep -A1 -E '^ +config( |$)' <<<"$text" | grep -q variables || fail "nothing is said of config"
text=$(groff -k -man -Tascii -P-c -P-b -P-u "$work/root/usr/share/man/man7/lockstep-language.7" 2>/dev/null)
for function in $("$lockstep" describe functions --json | python3 -c 'import json, sys
for function in json.load(sys.stdin)["functions"]: print(function["name"])'); do
  grep -qE "^ +$function\(" <<<"$text" || fail "lockstep-language(7) says nothing of $function"
done

echo "its bill of materials is SPDX and whole"
bill=$work/root/usr/share/doc/lockstep/lockstep.spdx.json
"$sources/tests/package/check_sbom.py" "$bill" "$lockstep" || fail "the bill of materials"
"$sources/tests/package/check_notices.py" "$work/root/usr/share/doc/lockstep/copyright" "$bill" || fail "the notices"
grep -v "Niels Lohmann" "$work/root/usr/share/doc/lockstep/copyright" >"$work/copyright"
! "$sources/tests/package/check_notices.py" "$work/copyright" "$bill" 2>/dev/null || fail "a notice that is missing is not told"
for _ in 1 2; do
  SOURCE_DATE_EPOCH=1 "$sources/cli/packaging/sbom.py" "$sources" "$build" "$build/lockstep" "$version" "$work/again.json"
  cat "$work/again.json" >>"$work/both.json"
done
expect "$(cat "$work/again.json")" '"created": "1970-01-01T00:00:01Z"'
cmp <(cat "$work/again.json" "$work/again.json") "$work/both.json" || fail "the same build gives two bills of materials"

echo "its unit is one"
unit=$work/lockstep@.service
sed "s|=lockstep |=$lockstep |" "$work/root/usr/lib/systemd/system/lockstep@.service" >"$unit"
complaints=$(systemd-analyze verify --man=no "$unit" 2>&1 | grep -v "^$" || true)
[[ -z $complaints ]] || fail "systemd-analyze verify: $complaints"
for setting in Type=notify WatchdogSec=10 IPAddressDeny=any IPAddressAllow=localhost MemoryMax=2G; do
  grep -qx "$setting" "$unit" || fail "the unit has no $setting"
done
grep -q '^AssertPathExists=/etc/lockstep/%i/project.json' "$unit" || fail "a start under a wrong name succeeds"
exposure=$(systemd-analyze security --offline=yes --threshold=30 "$unit" 2>&1 | tail -n 1) || fail "too exposed: $exposure"
echo "$exposure"

echo "what the unit forbids is not needed: system calls of a run with everything on"
systemd-analyze syscall-filter @system-service >"$work/allowed_sets"
allowed() { # the calls of a set and of the sets in it
  systemd-analyze syscall-filter "$1" | sed -e '/#/d' -e 1d | while read -r name; do
    case $name in '') ;; @*) allowed "$name" ;; *) echo "$name" ;; esac
  done
}
allowed @system-service | sort -u >"$work/allowed"
cp -r "$sources/projects/02_rotary_knife" "$work/knife"
strace -f -qq -e trace=all -o "$work/trace" "$lockstep" run "$work/knife/project.json" --duration 1s --stimuli \
  --modbus 127.0.0.1:0 --trace "$work/knife.csv" --retain "$work/knife.retain" 2>"$work/run.log" ||
  fail "the run: $(cat "$work/run.log")"
sed -E 's/^[0-9]+ +//' "$work/trace" | grep -oE '^[a-z_0-9]+\(' | tr -d '(' | sort -u >"$work/used"
forbidden=$(comm -23 "$work/used" "$work/allowed")
[[ -z $forbidden ]] || fail "the unit forbids what a run needs: $forbidden"
echo "$(wc -l <"$work/used") system calls used, all allowed"

echo "how the program is protected"
headers=$(readelf -hldW "$lockstep")
expect "$headers" "DYN (Position-Independent Executable file)"
expect "$headers" "GNU_RELRO"
expect "$headers" "BIND_NOW"
cmake -S "$sources" -B "$work/release" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLOCKSTEP_TESTS=OFF >"$work/release.log"
for source in hmi_bridge/modbus/request.cpp projects/json/document.cpp cli/main.cpp; do
  command=$(grep "command.*/$source" "$work/release/compile_commands.json") || fail "$source is not built"
  expect "$command" "-fstack-protector-strong"
  expect "$command" "-D_FORTIFY_SOURCE=2"
done
