#!/usr/bin/env bash
# faults.sh MEANDER SOURCE_DIR STEP: disks that are full, folders that cannot be written, a scene that changes, time that
# is too short, memory limits every STEP MiB: a clear line, an exit code that says whose fault it is, no half file, and
# nothing lost that was there before.
set -uo pipefail
meander=$1 source=$2 step=$3
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
mkdir out
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
scene=$source/scenes/sphere_furnace.toml
small=(--width 40 --height 30 --quiet)

# ends CODE WANTED COMMAND…: it must end so, with one line that contains WANTED (none at all where that is empty).
ends() {
  local code=$1 wanted=$2 status=0 message
  shift 2
  message=$("$@" 2>&1 >/dev/null) || status=$?
  [[ $status -eq $code ]] || fail "$*: exit code $status, not $code: $message"
  [[ $message == *"$wanted"* ]] || fail "$*: says '$message', not '$wanted'"
  [[ -n $wanted || -z $message ]] || fail "$*: says '$message'"
  [[ $(printf %s "$message" | grep -c '') -le 1 ]] || fail "$*: not one line: $message"
}
# holds FOLDER NAMES…: the folder holds these files and no others.
holds() {
  local folder=$1
  shift
  [[ $(ls -A "$folder" | xargs) == "$*" ]] || fail "$folder holds $(ls -A "$folder" | xargs), not $*"
}
limited() { (ulimit -f "$1" && shift && exec "$@"); }  # files of at most so many KiB
narrow() { (ulimit -v "$1" && shift && exec "$@"); }   # so many KiB of address space

"$meander" render "$scene" "${small[@]}" --spp 24 -o whole.exr || fail "the run without faults"
"$meander" render "$scene" "${small[@]}" --spp 1 --first-sample 24 -o next.exr || fail "the sample after it"

# A file that may not grow.
echo before >out/a.exr
ends 3 'cannot write out/a.exr: File too large' limited 2 "$meander" render "$scene" "${small[@]}" --spp 2 -o out/a.exr
ends 3 'cannot write out/a.png: File too large' limited 0 "$meander" capture "$scene" "${small[@]}" --spp 2 -o out/a.png
ends 3 'cannot write out/b.exr: File too large' limited 2 "$meander" merge whole.exr next.exr -o out/b.exr
holds out a.exr
[[ $(cat out/a.exr) == before ]] || fail "a failed write changed the file that was there"
# Checkpoints that cannot be written are worth one warning, and the image comes.
status=0
limited 64 "$meander" render "$scene" "${small[@]}" --spp 24 --checkpoint out/a.ckpt --every 1e-6 -o out/a.exr 2>said.txt || status=$?
[[ $status -eq 0 && $(cat said.txt) == 'meander: warning: no checkpoint: cannot write out/a.ckpt: File too large' ]] ||
  fail "a run without its checkpoint: exit code $status, $(cat said.txt)"
cmp out/a.exr whole.exr || fail "a run without its checkpoint gives another image"
holds out a.exr

# Standard output that is full.
if [[ -c /dev/full ]]; then
  status=0
  message=$("$meander" compare whole.exr whole.exr 2>&1 >/dev/full) || status=$?
  [[ $status -eq 3 && $message == 'meander: cannot write to standard output' ]] || fail "a full standard output: $status, $message"
fi

# A real disk that is full, where the system lets a test have one: 256 KiB, of which a checkpoint takes 150.
cat >disk.sh <<'DISK'
set -u
meander=$1 scene=$2
run=(render "$scene" --width 40 --height 30 --quiet)
mount -t tmpfs -o size=256k tmpfs disk || exit 77
"$meander" "${run[@]}" --spp 8 --checkpoint disk/a.ckpt --every 1000 -o eight.exr || exit 1
cp disk/a.ckpt eight.ckpt
"$meander" "${run[@]}" --spp 24 --resume disk/a.ckpt --checkpoint disk/a.ckpt --every 1000 -o done.exr 2>warning.txt || exit 2
cmp done.exr whole.exr && cmp disk/a.ckpt eight.ckpt || exit 3
[[ $(cat warning.txt) == 'meander: warning: no checkpoint: cannot write disk/a.ckpt: No space left on device' ]] || exit 4
echo before >disk/a.exr
head -c 400000 /dev/zero >disk/filling 2>/dev/null
"$meander" "${run[@]}" --spp 24 --checkpoint kept.ckpt -o disk/a.exr 2>error.txt
[[ $? -eq 3 && $(cat disk/a.exr) == before && $(ls -A disk | xargs) == 'a.ckpt a.exr filling' ]] || exit 5
[[ $(cat error.txt) == 'meander: cannot write disk/a.exr: No space left on device; the samples are kept: --resume kept.ckpt writes'* ]] || exit 6
"$meander" "${run[@]}" --spp 24 --resume kept.ckpt -o late.exr && cmp late.exr whole.exr || exit 7
DISK
mkdir disk
status=0
unshare --mount --map-root-user bash disk.sh "$meander" "$scene" >disk.txt 2>&1 || status=$?
case $status in
  0) disk='a full disk' ;;
  *) if unshare --mount --map-root-user bash -c 'mount -t tmpfs -o size=256k tmpfs disk' 2>/dev/null; then
    fail "on a full disk, step $status: $(cat disk.txt warning.txt error.txt 2>/dev/null | xargs)"
  fi
    disk='no full disk (the system gives a test none)' ;;
esac

# Folders that cannot be written; root may write into all but the kernel's own.
rm -f out/*
ends 2 'out/file is not a folder' env -C . bash -c 'touch out/file; "$@"' - "$meander" render "$scene" "${small[@]}" -o out/file/a.exr
ends 2 'there is no folder none' "$meander" render "$scene" "${small[@]}" -o none/a.exr
ends 2 'cannot write /proc/a.exr' "$meander" render "$scene" "${small[@]}" -o /proc/a.exr
ends 2 'cannot write /proc/a.ckpt' "$meander" render "$scene" "${small[@]}" --checkpoint /proc/a.ckpt -o out/a.exr
ends 2 'it exists and is no checkpoint' "$meander" render "$scene" "${small[@]}" --checkpoint whole.exr -o out/a.exr
ends 2 '--checkpoint must name another file than out/a.exr' "$meander" render "$scene" "${small[@]}" --checkpoint out/../out/a.exr -o out/a.exr
if [[ $(id -u) -ne 0 ]]; then
  mkdir sealed
  chmod a-w sealed
  ends 2 'cannot write sealed/a.exr: Permission denied' "$meander" render "$scene" "${small[@]}" -o sealed/a.exr
fi
holds out file

# Checkpoints of other runs, and options that go with none.
sed 's/^albedo.*/albedo = 0.9/' "$scene" >scene.toml
run=("$meander" render scene.toml "${small[@]}" -o out/a.exr)
"${run[@]}" --spp 4 --seed 3 --checkpoint run.ckpt || fail "a run with a checkpoint"
rm -f out/a.exr
ends 2 'holds 4 samples a pixel, more than --spp 2' "${run[@]}" --seed 3 --spp 2 --resume run.ckpt
ends 2 'run.ckpt: is a checkpoint of a run with seed 3; this one has 0' "${run[@]}" --resume run.ckpt
ends 2 'with first_sample 0; this one has 4' "${run[@]}" --seed 3 --first-sample 4 --resume run.ckpt
ends 2 'with size 40 x 30; this one has 41 x 30' "$meander" render scene.toml --width 41 --height 30 --quiet -o out/a.exr --seed 3 --resume run.ckpt
ends 2 'with crop none; this one has 0,0,8,8' "${run[@]}" --seed 3 --crop 0,0,8,8 --resume run.ckpt
ends 2 'with estimator implicit; this one has analog' "${run[@]}" --seed 3 --estimator analog --resume run.ckpt
ends 2 'with walk batch; this one has scalar' "${run[@]}" --seed 3 --walk scalar --resume run.ckpt
ends 2 'none.ckpt: there is no such checkpoint' "${run[@]}" --seed 3 --resume none.ckpt
ends 2 'whole.exr: is no checkpoint of meander' "${run[@]}" --seed 3 --resume whole.exr
ends 2 '--checkpoint' "${run[@]}" --every 3

# A checkpoint is replaced by the run that goes on from it, and by no other.
cp run.ckpt kept.ckpt
ends 2 'run.ckpt: holds an earlier run: continue it with --resume run.ckpt, or remove it, or name another file' \
  "${run[@]}" --seed 3 --spp 4 --checkpoint run.ckpt
ends 2 'run.ckpt: holds an earlier run' "${run[@]}" --seed 3 --spp 8 --resume kept.ckpt --checkpoint run.ckpt
cmp run.ckpt kept.ckpt || fail "a refused run has changed another's checkpoint"
"${run[@]}" --seed 3 --spp 8 --resume run.ckpt --checkpoint ./run.ckpt || fail "a run that goes on in its own checkpoint"
cmp -s run.ckpt kept.ckpt && fail "a run that goes on has not replaced its checkpoint"
rm -f out/a.exr kept.ckpt

# Through a link what it points to is written, whole, beside itself.
mkdir -p far && ln -s ../far/b.exr out/b.exr && echo old >far/b.exr
"$meander" render scene.toml "${small[@]}" --spp 2 -o out/b.exr || fail "a render through a link"
[[ -L out/b.exr && $(ls -A far) == b.exr ]] || fail "a link was replaced, or something was left beside its target"
head -c 4 far/b.exr | cmp - <(printf '\x76\x2f\x31\x01') || fail "what a link points to was not written"
rm -f far/b.exr
"$meander" render scene.toml "${small[@]}" --spp 2 -o out/b.exr || fail "a render through a link to nothing"
[[ -L out/b.exr && $(ls -A far) == b.exr ]] || fail "a link to nothing was replaced, or its target not written"
rm -rf far out/b.exr

sed -i 's/^albedo.*/albedo = 0.91/' scene.toml
ends 2 "is a checkpoint of another scene, or of other values of it" "${run[@]}" --seed 3 --resume run.ckpt
holds out file

# Time in which no pass can end: the camera is half a million mean free paths from anywhere.
begin=$(date +%s%N)
ends 3 'no pass was complete within --time 0.4 (seconds), not even one sample a pixel; nothing was written' \
  "$meander" render "$scene" "${small[@]}" --set camera.look_from=[0,0,0.5] --set material.white.mean_free_path=0.000001 --time 0.4 -o out/a.exr
passed=$((($(date +%s%N) - begin) / 1000000))
[[ $passed -lt 5000 ]] || fail "--time 0.4 took $passed ms"
holds out file
# A limit that many passes fit in is kept within 1 % or one pass.
"$meander" render "$scene" --set material.white.albedo=0.9 --width 64 --height 64 --quiet --time 1 -o timed.exr --stats timed.json || fail "--time 1"
python3 - <<'PY' || fail "--time 1 was not kept"
import json
run = json.load(open('timed.json'))
assert run['spp'] > 8, run
assert 0.5 < run['seconds'] < 1.5, run
PY

# Memory: where the program can start at all, it works or says in one line that it cannot. With the address sanitizer it
# starts in no limit, as it wants terabytes of addresses.
most=1500
if [[ $(narrow $((8 << 20)) "$meander" --version 2>&1) == *AddressSanitizer* ]]; then
  echo "memory limits: left out, with the address sanitizer"
  exit $((failures > 0))
fi
for ((limit = 128; limit < 3000; limit += 128)); do
  narrow $((limit * 1024)) "$meander" --version >/dev/null 2>&1 && break
done
narrowest=$limit narrow_failures=0
for (( ; limit <= narrowest + most; limit += step)); do
  for verb in 'render soap.ply a.exr 64' 'render furnace.toml a.exr 700' 'capture furnace.toml a.png 64'; do
    read -r verb input output size <<<"$verb"
    [[ -e soap.ply ]] || { cp "$source/scenes/soap.ply" . && cp "$scene" furnace.toml; }
    rm -rf out
    mkdir out
    status=0
    message=$(narrow $((limit * 1024)) "$meander" "$verb" "$input" --spp 1 --width "$size" --height "$size" --quiet -o out/$output 2>&1) || status=$?
    case $status in
      0) [[ -z $message ]] || fail "$limit MiB, $verb $input: says $message" && holds out $output ;;
      2 | 3)
        narrow_failures=$((narrow_failures + 1))
        [[ $message == 'meander: '* && $(wc -l <<<"$message") -eq 1 ]] || fail "$limit MiB, $verb $input: says $message"
        [[ $message == *memory* ]] || fail "$limit MiB, $verb $input: does not name memory: $message"
        holds out
        ;;
      *) fail "$limit MiB, $verb $input: exit code $status: $message" ;;
    esac
  done
done
[[ $narrow_failures -gt 0 ]] || fail "no memory limit was met"
[[ $failures -eq 0 ]] || { echo "$failures failures"; exit 1; }
echo "one line each, and nothing lost: $disk; memory limits from $narrowest MiB, of which $narrow_failures were met"
