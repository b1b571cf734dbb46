#!/usr/bin/env bash
# Builds the fuzz targets and runs them: run.sh SECONDS [TARGET…], SECONDS of processor time each, two at a time (JOBS).
# Ends with a table, and with exit code 1 when anything was found. Corpora grow in build/fuzz/run/TARGET/corpus, seeded
# from tests/fuzz/corpus, and are minimised at the end; inputs that found something are in build/fuzz/run/TARGET/findings.
#
# The scene file is read under the address and undefined-behaviour sanitizers. What is read in a child process, the
# rest, goes without the first: it would take the child's limit of memory away, and four fifths of the runs; the corpora
# are replayed under it by ctest --preset asan.
#
# A finding is: a report of a sanitizer or an assertion, a broken promise of targets.h,
# 3 s of processor time for one input (under the sanitizers; all that was kept is replayed without the first, in 1 s each), one
# allocation over 1 GiB, or 2 GiB resident. Nothing goes by the clock, which runs on while a process is stopped.
set -euo pipefail

readonly root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
readonly out=$root/build/fuzz/run
readonly all=(scene ply obj glb stl image)
readonly longest_input=131072
readonly most_findings=20

usage() {
  echo "usage: run.sh SECONDS [TARGET…]; targets: ${all[*]}" >&2
  exit 2
}

# The folder of the program of a target.
bin_of() {
  local preset=fuzz-shut-in
  [[ $1 == scene ]] && preset=fuzz
  printf '%s\n' "$root/build/$preset/tests/fuzz"
}

# run_once TARGET SECONDS LOG: one process; its processor seconds go to LOG.time.
run_once() {
  local folder=$out/$1 TIMEFORMAT='%U %S' dictionary=()
  [[ -f $root/tests/fuzz/$1.dict ]] && dictionary=(-dict="$root/tests/fuzz/$1.dict")
  { time nice -n 19 "$(bin_of "$1")/fuzz_$1" -max_total_time="$2" -timeout=0 -report_slow_units=3600 \
    -malloc_limit_mb=1024 -rss_limit_mb=2048 -max_len=$longest_input -print_final_stats=1 "${dictionary[@]}" \
    -artifact_prefix="$folder/findings/" "$folder/corpus" >"$3" 2>&1; } 2>"$3.time" || true
}

# Until the processor seconds are spent: another process after a finding, and where the clock ran faster than the work.
# One that ends at once without a finding is broken itself, and its log is the finding.
fuzz() {
  local target=$1 seconds=$2 folder=$out/$1 round=0 spent=0 found=0 runs
  mkdir -p "$folder"/{corpus,findings,logs}
  rm -f "$folder"/logs/*
  cp "$root/tests/fuzz/corpus/$target"/* "$folder/corpus/"
  while ((spent < seconds && found < most_findings)); do
    round=$((round + 1))
    run_once "$target" $((seconds - spent < 60 ? 60 : seconds - spent)) "$folder/logs/$round"
    spent=$(cat "$folder"/logs/*.time | awk '{ sum += $1 + $2 } END { printf "%d", sum + 0.5 }')
    runs=$(grep -c '^#' "$folder/logs/$round" || true)
    ((runs > 0)) || cp "$folder/logs/$round" "$folder/findings/broken-$round"
    found=$(find "$folder/findings" -type f | wc -l)
    ((runs > 0)) || break
  done
  mkdir -p "$folder/minimised"
  rm -f "$folder/minimised"/*
  nice -n 19 "$(bin_of "$target")/fuzz_$target" -merge=1 -timeout=0 "$folder/minimised" "$folder/corpus" >"$folder/merge" 2>&1 || true
}

# build_and_replay PRESET TARGET…: the seeds have to be read, lest the fuzzers see nothing but refusals.
build_and_replay() {
  local targets=("${@:2}")
  cd -- "$root"
  cmake --preset "$1"
  cmake --build --preset "$1" --parallel "$(nproc)" --target fuzz_replay "${targets[@]/#/fuzz_}"
  "build/$1/tests/fuzz/fuzz_replay" tests/fuzz/corpus
}

# Every input that was kept, and the seeds of the targets that did not run, in 1 s each; what is slower or worse is a
# finding of its target.
replay_kept() {
  local target kept line
  rm -rf "$out/kept"
  for target in "${all[@]}"; do
    mkdir -p "$out/kept/$target"
    kept=$out/$target/minimised
    [[ -n $(find "$kept" -type f -print -quit 2>/dev/null) ]] || kept=$root/tests/fuzz/corpus/$target
    cp "$kept"/* "$out/kept/$target/"
  done
  "$root/build/fuzz-shut-in/tests/fuzz/fuzz_replay" "$out/kept" >"$out/kept.log" || true
  while read -r line; do
    target=${line#"$out/kept/"} target=${target%%/*}
    mkdir -p "$out/$target/findings"
    echo "$line" >>"$out/$target/findings/replayed"
  done < <(grep FINDING "$out/kept.log")
}

row() {
  local folder=$out/$1
  awk -v target="$1" -v found="$(find "$folder/findings" -type f | wc -l)" -v kept="$(find "$folder/minimised" -type f | wc -l)" '
    /^#[0-9]+/ { here = substr($1, 2) + 0; if (here > at[FILENAME]) at[FILENAME] = here
                 for (i = 2; i < NF; ++i) { if ($i == "cov:") cov = $(i + 1); if ($i == "ft:") ft = $(i + 1) } }
    /^stat::number_of_executed_units/ { at[FILENAME] = $2 }
    FILENAME ~ /\.time$/ && NF == 2 { seconds += $1 + $2 }
    END { for (f in at) runs += at[f]
          printf "%-8s %12d %10d %10d %10.0f %8d %10d\n", target, runs, cov, ft, seconds, kept, found }' "$folder"/logs/*
}

main() {
  command -v clang++ >/dev/null || { echo "run.sh: no clang here: third_party/packages-fuzz.txt has what is needed" >&2; exit 3; }
  [[ ${1:-} =~ ^[0-9]+$ ]] || usage
  local seconds=$1 jobs=${JOBS:-2} targets=("${@:2}") target
  ((${#targets[@]})) || targets=("${all[@]}")
  for target in "${targets[@]}"; do [[ " ${all[*]} " == *" $target "* ]] || usage; done
  build_and_replay fuzz scene >&2
  build_and_replay fuzz-shut-in ply obj glb stl image >&2
  export ASAN_OPTIONS=quarantine_size_mb=32:allocator_may_return_null=0:detect_leaks=1
  export LSAN_OPTIONS=suppressions=$root/third_party/sanitizers/lsan.supp:print_suppressions=0
  [[ -w /dev/shm ]] && export TMPDIR=/dev/shm
  for target in "${targets[@]}"; do
    while (($(jobs -rp | wc -l) >= jobs)); do wait -n || true; done
    fuzz "$target" "$seconds" &
  done
  wait
  replay_kept
  printf '%-8s %12s %10s %10s %10s %8s %10s\n' target runs coverage features seconds inputs findings
  for target in "${targets[@]}"; do row "$target"; done
  [[ -z $(for target in "${targets[@]}"; do find "$out/$target/findings" -type f; done) ]]
}

main "$@"
