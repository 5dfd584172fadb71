#!/usr/bin/env bash
# Builds the site and looks at it: site.sh SOURCES LOCKSTEP WORK.
set -euo pipefail
sources=$1 lockstep=$2 work=$3
fail() { echo "FAILED: $*" >&2; exit 1; }
build=$sources/cli/packaging/site/build.sh
rm -rf "$work"
mkdir -p "$work"

echo "without a dead link"
"$build" "$sources" "$lockstep" "$work/site" >"$work/log" 2>&1 || fail "$(head -n 40 "$work/log")"
html=$work/site/html

echo "every document is a page"
for page in README projects/LANGUAGE projects/FUNCTIONS projects/KEYS fb/BLOCKS hmi_bridge/LCM hmi_bridge/MODBUS cli/COMMANDS \
  tech_objects/ALARMS CONTRIBUTING projects/02_rotary_knife/README; do
  [[ -s $html/$page.html ]] || fail "$page is no page"
done
(cd "$sources" && git -c safe.directory="$PWD" ls-files '*.md') | while read -r document; do
  [[ -s $html/${document%.md}.html ]] || fail "$document is no page"
done
for command in run describe 'cam info' completion; do
  grep -q "lockstep $command" "$html/cli/COMMANDS.html" || fail "$command is not told"
done
grep -q 608 "$html/tech_objects/ALARMS.html" || fail "no alarms"
for picture in "$sources"/projects/[0-9]*/*.png; do
  [[ -s $html/_images/$(basename "$picture") ]] || fail "$picture is not in it"
done

echo "it needs no network"
outside=$(grep -rhoE '<(script|link|img|iframe)[^>]+(src|href)="(https?:)?//[^"]+' "$html" --include='*.html' || true)
[[ -z $outside ]] || fail "it loads $outside"

echo "its search knows its words"
[[ -s $html/searchindex.js && -s $html/search.html ]] || fail "no search"
for word in flying modbus sqrt stimuli; do grep -q "$word" "$html/searchindex.js" || fail "'$word' is not to be found"; done

echo "a dead link is told"
for link in 'missing.md' '#nowhere' 'SECOND.md#nothing'; do
  rm -rf "$work/dead"
  mkdir -p "$work/dead"
  printf '# First\n\n[there](%s)\n' "$link" >"$work/dead/README.md"
  printf '# Second\n\nText.\n' >"$work/dead/SECOND.md"
  ! "$build" "$work/dead" "$lockstep" "$work/dead_site" >"$work/dead.log" 2>&1 || fail "a link to $link passes"
  grep -q "target not found: $link" "$work/dead.log" || fail "a link to $link is told otherwise: $(head "$work/dead.log")"
done
