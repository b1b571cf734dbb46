#!/usr/bin/env bash
# merge.sh MEANDER SOURCE_DIR: disjoint sample ranges of a seed merge into what one run gives, other seeds into an
# image of the same scene; samples that overlap, other scenes and other pictures are refused.
set -uo pipefail
meander=$1 source=$2
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
mkdir out
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# image NAME ARGS…: a small picture of a grey body and its variance.
image() {
  local name=$1
  shift
  "$meander" render "$source/scenes/sphere_furnace.toml" --set material.white.albedo=0.8 --height 18 --quiet \
    -o "$name.exr" --width "${width:-32}" "$@" || fail "render $name $*"
}

# refuse WANTED ARGS…: one line that contains WANTED, exit code 2, and nothing written.
refuse() {
  local wanted=$1 status=0 message
  shift
  message=$("$meander" merge "$@" -o out/refused.exr 2>&1) || status=$?
  [[ $status -eq 2 ]] || fail "merge $*: exit code $status: $message"
  [[ $message == *"$wanted"* && $(wc -l <<<"$message") -eq 1 ]] || fail "merge $*: says $message"
  [[ -z $(ls -A out) ]] || { fail "merge $*: wrote $(ls -A out)"; rm -rf out; mkdir out; }
}

# said NAME WANTED IN…: merges into NAME.exr, and says so of the samples.
said() {
  local name=$1 wanted=$2 message
  shift 2
  message=$("$meander" merge "$@" -o "$name.exr" 2>&1) || fail "merge $*: exit code $?"
  [[ $message == "$name.exr: $wanted" ]] || fail "merge $*: says $message"
}

image whole --spp 48
image a --spp 16
image b --spp 24 --first-sample 16
image c --spp 8 --first-sample 40

# One run again, whatever the order, within what the floats of the parts leave.
said abc '48 spp of 3 images, samples 0:0-47' a.exr b.exr c.exr
said cab '48 spp of 3 images, samples 0:0-47' c.exr a.exr b.exr
"$meander" merge a.exr b.exr -o ab.exr --quiet || fail "merge a b"
"$meander" merge ab.exr c.exr -o ab_c.exr --quiet || fail "merge (a b) c"
said ac '24 spp of 2 images, samples 0:0-15,0:40-47' a.exr c.exr
said b_ac '48 spp of 2 images, samples 0:0-47' b.exr ac.exr
for merged in abc cab ab_c b_ac; do
  "$meander" compare $merged.exr whole.exr --max-relative-rmse 2e-7 --hard-fail 2e-6 --quiet || fail "$merged is not the single run"
done
# The noise over the object's pixels, as the single run's file has it; three parts know their variance less well than one.
"$meander" compare whole.exr abc.exr --json >object_noise.json 2>/dev/null
python3 - <<'PY' || fail "the merge does not know its noise over the object's pixels"
import json
noise = json.load(open("object_noise.json"))
assert noise["noise_a"]["over"] == "object" and noise["noise_a"] == noise["noise_b"], noise
assert abs(noise["relative_noise_b"] / noise["relative_noise_a"] - 1) < 0.1, noise
PY
"$meander" compare a.exr whole.exr --max-relative-rmse 2e-7 --quiet 2>errors.txt && fail "a part passes for the whole"
# The noise of all pixels but one: that of all would be what the single run's file says of its object.
PYTHONPATH="$source/tests/cli" python3 -c '
import images
images.write_pfm("mask.pfm", images.grey(*[[0 if x + y == 0 else 1 for x in range(32)] for y in range(18)]))'
# same_noise A B WITHIN: the variances are the same over those pixels.
same_noise() {
  "$meander" compare "$1" "$2" --mask mask.pfm --json >noise.json 2>/dev/null
  python3 - "$3" <<'PY' || fail "the variances of $2 are not the single run's"
import json
import sys
result = json.load(open('noise.json'))
a, b = result['relative_noise_a'], result['relative_noise_b']
assert a > 0 and abs(a / b - 1) < float(sys.argv[1]), (a, b)
PY
}
same_noise whole.exr abc.exr 1e-5

# So it is where the channels have free paths of their own. Which channel leads a sample is stratified there: each
# part knows what its strata scatter, and the merge what the parts differ by, which is the same variance, not the same sum.
chromatic=(--set material.white.albedo=[0.95,0.7,0.2] --set material.white.mean_free_path=[0.4,0.1,0.02])
image chromatic_whole --spp 48 "${chromatic[@]}"
image chromatic_a --spp 16 "${chromatic[@]}"
image chromatic_b --spp 32 --first-sample 16 "${chromatic[@]}"
"$meander" merge chromatic_a.exr chromatic_b.exr -o chromatic.exr --quiet || fail "merge of chromatic images"
"$meander" compare chromatic.exr chromatic_whole.exr --max-relative-rmse 2e-7 --hard-fail 2e-6 --quiet || fail "the merge of chromatic images is not the single run"
same_noise chromatic_whole.exr chromatic.exr 0.02

# Another seed is independent: the merge is unbiased against a third, and has half the variance.
image other --spp 48 --seed 7
image third --spp 192 --seed 8
said seeds '96 spp of 2 images, samples 0:0-47,7:0-47' whole.exr other.exr
"$meander" compare seeds.exr third.exr --z-test --quiet || fail "the merge of two seeds is not the scene"

# A crop merges with the same crop.
image crop_a --spp 8 --crop 8,4,24,12
image crop_b --spp 8 --crop 8,4,24,12 --first-sample 8
"$meander" merge crop_a.exr crop_b.exr -o crop.exr --quiet || fail "merge of crops"

image shifted --spp 8 --crop 9,4,25,12 --first-sample 8
image overlapping --spp 8 --first-sample 15
image denser --spp 16 --first-sample 16 --set material.white.mean_free_path=0.105
width=33 image larger --spp 16 --first-sample 16
"$meander" render "$source/scenes/wax_knot.toml" --walk scalar --spp 2 --seed 3 --width 32 --height 18 --quiet -o knot.exr
"$meander" compare a.exr b.exr -o difference.exr >/dev/null 2>&1
refuse 'needs two images' a.exr
refuse 'a.exr: shares samples 0 to 15 of seed 0 with a.exr' a.exr a.exr
refuse 'overlapping.exr: shares samples 15 to 15 of seed 0 with a.exr' a.exr overlapping.exr
refuse 'b.exr: shares samples 16 to 39 of seed 0 with ab.exr' ab.exr b.exr
refuse 'overlapping.exr: shares samples 15 to 15 of seed 0 with ac.exr' ac.exr overlapping.exr
refuse 'denser.exr: shows another scene, or other values of it' a.exr denser.exr
refuse 'knot.exr: shows another scene' a.exr knot.exr
refuse 'larger.exr: has 33 x 18 pixels at 0,0, but a.exr has 32 x 18' a.exr larger.exr
refuse 'shifted.exr: has 16 x 8 pixels at 9,4, but crop_a.exr has 16 x 8 pixels at 8,4' crop_a.exr shifted.exr
refuse 'difference.exr: is no image that can be merged' a.exr difference.exr
refuse 'none.exr' a.exr none.exr
status=0
cp a.exr kept.exr
"$meander" merge a.exr b.exr -o a.exr 2>errors.txt || status=$?
[[ $status -eq 2 ]] && cmp -s a.exr kept.exr && grep -q 'would overwrite an input' errors.txt || fail "an input was overwritten"

[[ $failures -eq 0 ]] || { echo "$failures failures"; exit 1; }
echo "disjoint samples merge into one run; all others are refused"
