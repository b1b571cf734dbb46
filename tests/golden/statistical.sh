#!/usr/bin/env bash
# statistical.sh MEANDER CHECK SCENE ESTIMATOR WALK ISA SPP MATERIAL TESTS DIR [SEED]: a fresh render of scenes/SCENE.toml must
# agree with statistical/SCENE.exr within the noise of both, at 1 % for all TESTS of the suite together. So that the test is
# known to be able to fail, the same comparison must fail for a render whose MATERIAL ("-": none) has 0.99 times the albedo,
# for one that is shifted by a pixel, for a blurred one, for one with a block that is off by less than its pixels show, and for one
# that went through the tone curve; and it must leave its evidence. All of it is in DIR. SEED is 7 but for trials by hand.
# Exit code 77: this machine has no ISA ("best": whatever it has).
set -euo pipefail
meander=$1 check=$2 scene=$3 estimator=$4 walk=$5 isa=$6 spp=$7 material=$8 tests=$9 seed=${11:-7}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
dir=${10}/${scene}_${estimator}_${walk}_$isa
set=()
if [[ $isa != best ]]; then
  "$meander" render --help | grep -Eq -- "--isa TEXT:[{](.*,)?$isa[,}]" || { echo "skipped: this machine has no $isa"; exit 77; }
  set=(--isa "$isa")
fi
rm -rf "$dir"
mkdir -p "$dir"
golden=$here/statistical/$scene.exr

# render NAME OPTIONS…: into DIR/NAME.exr.
render() {
  local name=$1
  shift
  "$meander" render "$here/scenes/$scene.toml" -o "$dir/$name.exr" --spp "$spp" --seed "$seed" --estimator "$estimator" --walk "$walk" "${set[@]}" --quiet "$@"
}

# must_fail NAME: DIR/NAME.exr is wrong, and its evidence is there.
must_fail() {
  local status=0
  "$check" statistical "$dir/$1.exr" "$golden" "$dir/self_test/$1" "$tests" >"$dir/$1.txt" || status=$?
  head -n 1 "$dir/$1.txt" | sed "s/^/planted $1: /"
  [[ $status -eq 1 ]] || { echo "FAILED: a planted fault ($1) goes unnoticed: exit code $status; $dir/$1.exr"; exit 1; }
  local file
  for file in render.exr golden.exr z.exr render_shown.png golden_shown.png difference.png p_values.png p_blocks.png index.html; do
    [[ -s $dir/self_test/$1/$file ]] || { echo "FAILED: no $dir/self_test/$1/$file"; exit 1; }
  done
  grep -qx "FAILED: see $dir/self_test/$1/index.html" "$dir/$1.txt" || { echo "FAILED: the page's path is not printed"; exit 1; }
}

render render
"$check" statistical "$dir/render.exr" "$golden" "$dir/failed" "$tests"
for fault in shift blur block tone; do
  "$check" fault $fault "$dir/render.exr" "$dir/$fault.exr"
  must_fail $fault
done
[[ $material == - ]] && exit
# The material's albedo, times 0.99.
darker=$(awk -v name="name = \"$material\"" '
  $0 == name { found = 1 }
  found && /^albedo = / {
    gsub(/[][,=]|albedo/, " ")
    for (i = 1; i <= NF; ++i) list = list (i > 1 ? ", " : "") 0.99 * $i
    print "[" list "]"
    exit
  }' "$here/scenes/$scene.toml" | sed -E 's/^\[([^,]*)\]$/\1/')
[[ -n $darker ]] || { echo "FAILED: $scene.toml gives no albedo of $material"; exit 1; }
render albedo --set "material.$material.albedo=$darker"
must_fail albedo
