#!/usr/bin/env bash
# kills.sh MEANDER SOURCE_DIR KILLS: a run that writes checkpoints is killed (SIGKILL) at that many moments, random ones
# and some in the middle of a write. After each the last checkpoint is whole and no older than the one before it, the
# output is the old file or the whole new one; in the end the resumed run gives the bytes of one without a break.
set -uo pipefail
meander=$1 source=$2 kills=$3
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
RANDOM=20261126
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# A run that takes longer than the program takes to start, most of it passes about as long as their checkpoints.
scene=("$source/scenes/sphere_furnace.toml" --set camera.look_from=[0,0,25] --width 192 --height 192 --threads 2 --quiet)
run=("${scene[@]}" --spp 2000)
milliseconds() { echo $(($(date +%s%N) / 1000000)); }
begin=$(milliseconds)
"$meander" render "${run[@]}" --checkpoint whole.ckpt --every 0.001 -o whole.exr || fail "the unbroken run: exit code $?"
length=$(($(milliseconds) - begin))

echo before >before.exr
restart() { rm -f run.ckpt; cp before.exr out.exr; kept=0; }

# What the checkpoint holds, as its refusal of a smaller budget says; only one that is whole comes so far.
check_checkpoint() {
  local message spp
  [[ -e run.ckpt ]] || { [[ $kept -eq 0 ]] || fail "the checkpoint is gone"; return; }
  message=$("$meander" render "${scene[@]}" --spp 1 --resume run.ckpt -o looked.exr 2>&1)
  case $?:$message in
    0:) spp=1 ;;
    2:*' holds '*' samples a pixel, more than --spp 1') spp=${message#* holds }; spp=${spp%% *} ;;
    *) fail "the checkpoint after kill $killed: $message"; return ;;
  esac
  [[ $spp -ge $kept ]] || fail "the checkpoint went back from $kept to $spp samples a pixel"
  [[ $spp -eq $kept ]] || advances=$((advances + 1))
  kept=$spp
}

restart
killed=0 finished=0 advances=0 torn=0
for ((round = 0; killed < kills && round < 20 * kills; ++round)); do
  resume=()
  [[ -e run.ckpt ]] && resume=(--resume run.ckpt)
  "$meander" render "${run[@]}" --checkpoint run.ckpt --every 0.001 "${resume[@]}" -o out.exr 2>said.txt &
  pid=$!
  if ((round % 3 == 2)); then  # at the first sight of a checkpoint in the making
    until [[ -s .run.partial-$pid.ckpt ]] || ! kill -0 $pid 2>/dev/null; do :; done
  else
    delay=$((RANDOM % (length + 1)))
    sleep "$((delay / 1000)).$(printf %03d $((delay % 1000)))"
  fi
  kill -9 $pid 2>/dev/null
  status=0
  wait $pid 2>/dev/null || status=$?
  [[ -s said.txt ]] && fail "a run says $(cat said.txt)"
  cmp -s out.exr before.exr || cmp -s out.exr whole.exr || fail "half a file after round $round"
  if [[ $status -eq 0 ]]; then
    finished=$((finished + 1))
    cmp -s out.exr whole.exr || fail "a resumed run differs from the unbroken one"
    restart
    continue
  fi
  [[ $status -eq 137 ]] || fail "round $round: exit code $status"
  killed=$((killed + 1))
  compgen -G ".*.partial-$pid.*" >/dev/null && torn=$((torn + 1))
  check_checkpoint
done
[[ $killed -eq $kills ]] || fail "only $killed of $kills kills hit a run"
[[ $advances -gt 0 ]] || fail "no killed run left a checkpoint"

resume=()
[[ -e run.ckpt ]] && resume=(--resume run.ckpt)
"$meander" render "${run[@]}" --checkpoint run.ckpt "${resume[@]}" -o out.exr || fail "the last run: exit code $?"
cmp out.exr whole.exr || fail "the last run differs from the unbroken one"
compgen -G '.*.partial-*' && fail "a killed run's partial file outlives the next run"

[[ $failures -eq 0 ]] || { echo "$failures failures"; exit 1; }
echo "$killed kills, $torn of them in the middle of a write, $finished runs ended before theirs: nothing was lost"
