#!/usr/bin/env bash
# The soak under the address and undefined-behaviour sanitizers: run.sh [SECONDS [SEED]], an hour from seed 1.
set -euo pipefail
readonly root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
export MEANDER_SOAK_SECONDS=${1:-3600} MEANDER_SOAK_SEED=${2:-1} MESA_SHADER_CACHE_DISABLE=true
# A quarantine that fills soon, so that what is resident can stay flat.
export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:quarantine_size_mb=16
export LSAN_OPTIONS=suppressions=$root/third_party/sanitizers/lsan.supp:print_suppressions=0
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
cd -- "$root"
cmake --preset asan
cmake --build --preset asan --parallel "$(nproc)" --target preview_soak
time build/asan/tests/soak/preview_soak
