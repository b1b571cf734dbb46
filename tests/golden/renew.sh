#!/usr/bin/env bash
# Renews golden images: renew.sh BUILD REASON [NAME…], all of them or those of that name; BUILD is a build folder
# (build/release). Commit the result. Each renewal is a row of RECORD.csv: what, when, by which version and commit, with
# which seed, samples a pixel and walk, how long it took, and why. The statistical ones are rendered by the scalar walk, the
# oracle, with 16 times the samples of the test that takes most, and a seed that no test has: the column `seconds` tells what
# that takes. The drawn ones take seconds. The build is that of the committed code, or the record would name another.
set -euo pipefail
fail() { echo "renew.sh: $*" >&2; exit 2; }
[[ $# -ge 2 && -n ${2//[[:space:]]/} ]] || fail "usage: renew.sh BUILD REASON [NAME…]; a golden image changes only for a reason"
build=$(realpath "$1") reason=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
meander=$build/src/app/meander draw=$build/tests/golden/golden_draw
seed=1000003 factor=16 largest=65536
[[ -x $meander ]] || fail "$meander is not there: build it first"
commit=$(git -C "$here" describe --always --dirty=+ 2>/dev/null || echo unknown)
git -C "$here/../.." diff --quiet HEAD -- src third_party CMakeLists.txt 2>/dev/null || fail "src differs from what is committed: commit first, so that the record names the code"
version="$("$meander" --version) $commit"

statistical=$(grep -v '^#' "$here/statistical.csv" | tail -n +2 | cut -d, -f1 | sort -u)
drawn=$(grep -v '^#' "$here/drawn.csv" | tail -n +2 | cut -d, -f1)
for name in "$@"; do grep -qx -- "$name" <<<"$statistical"$'\n'"$drawn" || fail "no golden image is called '$name'"; done
wanted() { [[ ${#names[@]} -eq 0 ]] || printf '%s\n' "${names[@]}" | grep -qx -- "$1"; }
names=("$@")

# keep KIND NAME FILE SEED SPP WALK SECONDS: the new image takes the place of the old, if it is small enough.
keep() {
  local kind=$1 name=$2 file=$3 size
  size=$(stat -c %s "$file")
  [[ $size -le $largest ]] || { rm -f "$file"; fail "$name has $size bytes, more than $largest"; }
  mv "$file" "$here/$kind/$name.${file##*.}"
  printf '%s,%s,%s,%s,%s,%s,%s,%s,"%s"\n' "$kind" "$name" "$(date -u +%F)" "$version" "$4" "$5" "$6" "$7" "${reason//\"/\"\"}" >>"$here/RECORD.csv"
  echo "$kind/$name: $size bytes, $7 s"
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$here"
for name in $statistical; do
  wanted "$name" || continue
  spp=$(awk -F, -v scene="$name" -v factor=$factor '$1 == scene && $5 > most { most = $5 } END { print factor * most }' statistical.csv)
  start=$(date +%s)
  "$meander" render "scenes/$name.toml" -o "$work/$name.exr" --spp "$spp" --seed $seed --walk scalar --estimator implicit --quiet
  keep statistical "$name" "$work/$name.exr" $seed "$spp" scalar $(($(date +%s) - start))
done
for name in $drawn; do
  wanted "$name" || continue
  [[ -x $draw ]] || fail "$draw is not there: build it first"
  start=$(date +%s)
  "$draw" "$name" "$work/$name.png"
  keep drawn "$name" "$work/$name.png" - - - $(($(date +%s) - start))
done
