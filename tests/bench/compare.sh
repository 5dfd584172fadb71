#!/usr/bin/env bash
# Compares what the cycle and its parts cost here and in another revision: ./dev bench --compare REV [OPTIONS].
# Both are measured by the benchmark of this working tree, in turns, so that what disturbs one disturbs both.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

readonly ROUNDS=5
(($# >= 1)) || {
  echo "usage: compare.sh REV [OPTIONS of lockstep_bench, such as --filter TEXT or --instructions]" >&2
  exit 2
}
revision=$(git rev-parse --verify --quiet "$1^{commit}") || {
  echo "compare.sh: there is no revision '$1'" >&2
  exit 2
}
readonly revision name=$1
shift
readonly other=build/compare/$revision

# The sources of the other revision with the benchmark of this one.
if [[ ! -d $other ]]; then
  mkdir -p "$other"
  git archive "$revision" | tar -x -C "$other"
fi
rm -rf "$other/tests/bench"
cp -r tests/bench "$other/tests/bench"
# The first paragraph is about that benchmark; others may need what the other revision does not have.
sed '/^$/,$d' tests/bench/CMakeLists.txt >"$other/tests/bench/CMakeLists.txt"
grep -q '^ *add_subdirectory(bench)$' "$other/tests/CMakeLists.txt" ||
  echo 'add_subdirectory(bench)' >>"$other/tests/CMakeLists.txt"

for tree in . "$other"; do
  (cd "$tree" && cmake --preset release -DLOCKSTEP_TESTS=ON && cmake --build --preset release --target lockstep_bench) >&2
done

rounds=$ROUNDS
for option in "$@"; do [[ $option != --instructions ]] || rounds=1; done # they are the same every time

results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
for ((round = 1; round <= rounds; ++round)); do
  echo "round $round of $rounds" >&2
  "$other/build/release/lockstep_bench" --lines "$@" >>"$results/other"
  build/release/lockstep_bench --lines "$@" >>"$results/here"
done

# The least of the rounds of each; below 1 this tree is quicker.
awk -F'\t' -v name="$name" '
  NR == FNR { if (!($2 in other) || $1 < other[$2]) other[$2] = $1; next }
  { if (!($2 in here)) rows[++count] = $2; if (!($2 in here) || $1 < here[$2]) here[$2] = $1 }
  END {
    printf "%-75s %12s %12s %7s\n", "", name, "here", "ratio"
    for (i = 1; i <= count; ++i)
      if (rows[i] in other)
        printf "%-75s %12.1f %12.1f %7.2f\n", rows[i], other[rows[i]], here[rows[i]],
          (other[rows[i]] ? here[rows[i]] / other[rows[i]] : 0)
  }' "$results/other" "$results/here"
