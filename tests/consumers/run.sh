#!/usr/bin/env bash
# Builds and runs the consumer: run.sh KIND SOURCES BUILD WORK, KIND being "installed" or "subdirectory".
set -euo pipefail
kind=$1 sources=$2 build=$3 work=$4
rm -rf "$work"
mkdir -p "$work"
if [[ $kind == installed ]]; then
  cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
  cmake -S "$sources/tests/consumers" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/configure.log"
  cmake --build "$work/build" >"$work/build.log"
  "$work/prefix/bin/lockstep" check "$work/prefix/share/lockstep/projects/02_rotary_knife/project.json"
  "$work/build/consumer" "$sources/projects/02_rotary_knife/project.json"
  "$work/build/machine" "$sources/projects/02_rotary_knife/project.json"
else
  # Configuring is what can go wrong here; the sources are those that all other tests build.
  cmake -S "$sources/tests/consumers" -B "$work/build" -G Ninja -DLOCKSTEP_SOURCES="$sources" >"$work/configure.log"
  ninja -C "$work/build" -n consumer machine >"$work/build.log"
fi
