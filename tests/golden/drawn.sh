#!/usr/bin/env bash
# drawn.sh DRAW CHECK NAME TOLERANCE FAULT DIR: what golden_draw draws now must be drawn/NAME.png within TOLERANCE levels
# at every pixel. So that the test is known to be able to fail, the same comparison must fail where two neighbouring
# pixels have changed places, where all are shifted by one, blurred, or sent through a tone curve, and for a picture
# drawn with FAULT ("none": there is none); and it must leave its evidence. All of it is in DIR.
set -euo pipefail
draw=$1 check=$2 name=$3 tolerance=$4 fault=$5
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
dir=$6/$name
golden=$here/drawn/$name.png
rm -rf "$dir"
mkdir -p "$dir"

# must_fail NAME: DIR/NAME.png is wrong, and its evidence is there.
must_fail() {
  local status=0 file
  "$check" drawn "$dir/$1.png" "$golden" "$dir/self_test/$1" "$tolerance" >"$dir/$1.txt" || status=$?
  head -n 1 "$dir/$1.txt" | sed "s/^/planted $1: /"
  [[ $status -eq 1 ]] || { echo "FAILED: a planted fault ($1) goes unnoticed: exit code $status; $dir/$1.png"; exit 1; }
  for file in drawn.png golden.png drawn_shown.png golden_shown.png difference.png index.html; do
    [[ -s $dir/self_test/$1/$file ]] || { echo "FAILED: no $dir/self_test/$1/$file"; exit 1; }
  done
  grep -qx "FAILED: see $dir/self_test/$1/index.html" "$dir/$1.txt" || { echo "FAILED: the page's path is not printed"; exit 1; }
}

"$draw" "$name" "$dir/drawn.png"
"$check" drawn "$dir/drawn.png" "$golden" "$dir/failed" "$tolerance"
for planted in pixel shift blur tone; do
  "$check" fault $planted "$dir/drawn.png" "$dir/$planted.png"
  must_fail $planted
done
[[ $fault == none ]] && exit
"$draw" "$name" "$dir/drawn_$fault.png" "$fault"
must_fail "drawn_$fault"
