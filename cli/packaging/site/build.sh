#!/usr/bin/env bash
# The site, without a dead link: build.sh SOURCES LOCKSTEP OUTPUT. Its first page is OUTPUT/html/index.html.
set -euo pipefail
readonly sources=$1 lockstep=$2 output=$3
here=$(dirname "${BASH_SOURCE[0]}")
mkdir -p "$output"
python3 "$here/stage.py" "$sources" "$lockstep" "$output/pages"
rm -rf "$output/html"
# -W: a warning, such as a link to nothing, is an error.
sphinx-build -q -W --keep-going -j 2 -b html -c "$here" -d "$output/doctrees" "$output/pages" "$output/html"
