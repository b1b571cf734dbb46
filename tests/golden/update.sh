#!/usr/bin/env bash
# Renews the golden images: tests/golden/update.sh MEANDER REASON. Run from anywhere; commit the result with the reason.
# Each golden is a long render with a seed of its own; its attributes carry seed, samples and version, and the log
# beside it the reason.
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: update.sh MEANDER REASON" >&2; exit 2; }
meander=$(realpath "$1")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for scene in "$here"/*.toml; do
  name=$(basename "$scene" .toml)
  (cd "$here" && "$meander" render "$name.toml" -o "$name.exr" --spp 8192 --seed 1000003 --quiet)
  size=$(stat -c %s "$here/$name.exr")
  [ "$size" -le 65536 ] || { echo "update.sh: $name.exr has $size bytes, more than 65536" >&2; exit 1; }
  printf '%s  %s  spp 8192 seed 1000003  %s: %s\n' "$(date -u +%F)" "$("$meander" --version)" "$name" "$2" >> "$here/log.txt"
done
