#!/usr/bin/env bash
# compare.sh in a repository of its own, with a benchmark that prints what its tree says: compare_test.sh SOURCES WORK
set -euo pipefail
readonly sources=$1 work=$2
rm -rf "$work"
mkdir -p "$work/repository/tests/bench" "$work/bin"

fail() {
  printf '%s\n' "compare_test: $1" "${output-}" >&2
  exit 1
}

# Configures nothing, and builds what prints the next of the values in `speed` each time.
cat >"$work/bin/cmake" <<'CMAKE'
#!/usr/bin/env bash
[[ $1 == --build ]] || exit 0
mkdir -p build/release
cat >build/release/lockstep_bench <<'BENCH'
#!/usr/bin/env bash
here=$(dirname "$0")
round=$(($(cat "$here/round" 2>/dev/null || echo 0) + 1))
echo "$round" >"$here/round"
printf '%s\n' "$*" >>"$here/options"
printf '%s\tgear\n' "$(sed -n "${round}p" "$here/../../speed")"
printf '7\t%s\n' "$(cat "$here/../../own")"
BENCH
chmod +x build/release/lockstep_bench
CMAKE
chmod +x "$work/bin/cmake"
export PATH="$work/bin:$PATH"

cd "$work/repository"
cp "$sources/tests/bench/compare.sh" tests/bench/
printf '# The benchmark.\nadd_executable(lockstep_bench x.cpp)\n\n# Another.\nadd_executable(later_bench y.cpp)\n' >tests/bench/CMakeLists.txt
touch tests/CMakeLists.txt
git init -q .
git config user.name test
git config user.email test@example.invalid
printf '50\n40\n60\n45\n55\n' >speed # the least of five rounds is 40
echo only_before >own
git add -A
git commit -qm before
printf "35\n33\n30\n31\n39\n" >speed # and here 30
echo only_here >own

output=$(tests/bench/compare.sh HEAD --filter gear 2>/dev/null) || fail "it ended with $?"
[[ $(wc -l <<<"$output") == 2 ]] || fail "a title and one row that both have were expected"
read -r name before here ratio < <(tail -n 1 <<<"$output")
[[ "$name $before $here $ratio" == "gear 40.0 30.0 0.75" ]] || fail "the least of the rounds, and their ratio, were expected"
[[ $(sort -u build/release/options) == "--lines --filter gear" ]] || fail "the options of the benchmark are lost"
[[ $(wc -l <build/release/options) == 5 ]] || fail "five rounds were expected"
other=$(echo build/compare/*/tests)
grep -q later_bench "$other/bench/CMakeLists.txt" && fail "benchmarks that the other revision may not know are configured there"
grep -qx 'add_subdirectory(bench)' "$other/CMakeLists.txt" || fail "the benchmark is not part of the other revision"

rm build/release/round build/compare/*/build/release/round
output=$(tests/bench/compare.sh HEAD --instructions 2>/dev/null) || fail "it ended with $?"
[[ $(cat build/release/round) == 1 ]] || fail "instructions are the same every time, so that one round is enough"

status=0
output=$(tests/bench/compare.sh no_such_revision 2>&1) || status=$?
[[ $status == 2 && $output == *"no revision 'no_such_revision'"* ]] || fail "a revision that is not there has to be told"
