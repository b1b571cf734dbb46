#!/usr/bin/env bash
# mutation.sh CXX SRC DIR LIBRARY...: plants one bug of bugs.sh at a time into a copy of SRC, builds the oracles against
# the copy, and requires that the oracle named for the bug fails. The true source must pass them all. The source
# itself is never touched. BUGS="NAME..." in the environment plants only those. After the oracle stands how many of the
# program's saw the bug; what each said is in DIR/said.
set -euo pipefail
cxx=$1 source=$(realpath "$2")
mkdir -p "$3"
dir=$(realpath "$3") libraries=("${@:4}")
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
rooms=(core math medium film stats scene walk trace render)
programs=(walk mesh picture)
declare -A program_of=() known=()
caught=0 planted=0 status=0
# Vector code is compiled for one instruction set, and that is what every other is called.
if grep -qw avx2 /proc/cpuinfo; then
  lanes="-march=x86-64-v3 -maes -mpclmul -DN_SSE4=N_AVX2 -DN_AVX3=N_AVX2"
else
  lanes="-march=x86-64-v2 -maes -mpclmul -DN_AVX2=N_SSE4 -DN_AVX3=N_SSE4"
fi
flags="-std=c++20 -O2 -DNDEBUG -w -ffp-contract=off -fno-math-errno -DHWY_COMPILE_ONLY_STATIC $lanes"

die() {
  printf 'mutation.sh: %s\n' "$*" >&2
  exit 2
}

# object_of FILE: the name of its object.
object_of() {
  local name=${1#"$dir/src/"}
  name=${name#"$here/"}
  printf '%s.o' "${name//\//.}"
}

# compile OUT FILE: OUT/OBJECT, and the files that it was made from in OUT/OBJECT.d.
compile() {
  local object
  object=$1/$(object_of "$2")
  # shellcheck disable=SC2086  # flags are words
  "$cxx" $flags -I "$dir/src" -I "$here" -MMD -MF "$object.d" -c "$2" -o "$object"
}

# compile_all OUT: the files of standard input.
compile_all() { xargs -r -P "$(nproc)" -I '{}' bash -c 'compile "$@"' compile "$1" '{}'; }

# link PROGRAM OBJECT...: DIR/PROGRAM; what the objects leave open comes from the true source.
link() {
  "$cxx" -o "$dir/$1" "${@:2}" "$dir/true/rooms.a" "${libraries[@]}" -Wl,-Map="$dir/$1.map"
}

# ask PROGRAM ORACLE: its line; a walk that a bug has trapped for ever fails too.
ask() {
  local code=0 patience=600 begin=$EPOCHREALTIME
  [[ ! -e $dir/patience/$2 ]] || patience=$(<"$dir/patience/$2")
  timeout "$patience" "$dir/$1" "$2" || code=$?
  case $code in
    0) [[ -e $dir/patience/$2 ]] ||
      awk -v a="$begin" -v b="$EPOCHREALTIME" 'BEGIN { print 10 + int(10 * (b - a)) }' >"$dir/patience/$2" ;;
    1) ;;
    124) printf '%s FAILED no end after %s s\n' "$2" "$patience" ;;
    *) printf '%s FAILED exit code %s\n' "$2" "$code" ;;
  esac
}
export -f object_of compile ask
export cxx dir here flags

# ask_all PROGRAM: every oracle's line.
ask_all() { "$dir/$1" | xargs -P "$(nproc)" -I '{}' bash -c 'ask "$@"' ask "$1" '{}'; }

# The true source: its objects, what each program takes of them, and what its oracles say.
judge_true_source() {
  local room program oracle object
  rm -rf "$dir/src" "$dir/true" "$dir/patience"
  mkdir -p "$dir/src" "$dir/true" "$dir/patience" "$dir/said"
  cp -r "$source/." "$dir/src"
  {
    for room in "${rooms[@]}"; do printf '%s\n' "$dir/src/$room"/*.cpp; done
    printf "$here/%s_oracles.cpp\n" "${programs[@]}"
  } | compile_all "$dir/true"
  for room in "${rooms[@]}"; do ar rcs "$dir/true/rooms.a" "$dir/true/$room".*.o; done
  : >"$dir/said/true_source"
  for program in "${programs[@]}"; do
    object=${program}_oracles.cpp.o
    link "$program" "$dir/true/$object"
    printf '%s\n' "$object" >"$dir/true/$program.objects"
    grep -oP 'rooms\.a\(\K[^)]+' "$dir/$program.map" | sort -u >>"$dir/true/$program.objects"
    for oracle in $("$dir/$program"); do program_of[$oracle]=$program; done
    ask_all "$program" >>"$dir/said/true_source"
  done
  if grep FAILED "$dir/said/true_source"; then
    echo "FAILED: the true source does not pass its own oracles"
    exit 1
  fi
  printf 'the true source passes %s oracles\n' "$(wc -l <"$dir/said/true_source")"
}

# plant FILE FROM TO: FROM must be in the file exactly once.
plant() {
  local text rest
  text=$(<"$dir/src/$1")
  rest=${text#*"$2"}
  [[ $rest != "$text" && $rest != *"$2"* ]] || die "not exactly once in $1: $2"
  printf '%s\n' "${text%%"$2"*}$3$rest" >"$dir/src/$1"
}

# build_mutant PROGRAM FILE: compiles what the program has from the file again.
build_mutant() {
  local object sources=()
  rm -rf "$dir/mutant"
  mkdir "$dir/mutant"
  while read -r object; do
    grep -qF "$dir/src/$2" "$dir/true/$object.d" || continue
    case $object in
      *_oracles.cpp.o) sources+=("$here/${object%.o}") ;;
      *) sources+=("$dir/src/${object%%.*}/$(basename "${object#*.}" .o)") ;;
    esac
  done <"$dir/true/$1.objects"
  ((${#sources[@]} > 0)) || die "$1 has nothing from $2"
  printf '%s\n' "${sources[@]}" | compile_all "$dir/mutant" || die "a bug in $2 does not compile"
  local objects=("$dir/mutant"/*.o)
  [[ -e $dir/mutant/$1_oracles.cpp.o ]] || objects+=("$dir/true/$1_oracles.cpp.o")
  link "$1" "${objects[@]}"
}

# mutant NAME ORACLE FILE FROM TO
mutant() {
  [[ -z ${BUGS-} || " $BUGS " == *" $1 "* ]] || return 0
  [[ -z ${known[$1]-} ]] || die "two bugs are called $1"
  known[$1]=1
  local program=${program_of[$2]-} said=$dir/said/$1
  [[ -n $program ]] || die "no oracle is called $2"
  plant "$3" "$4" "$5"
  build_mutant "$program" "$3"
  cp "$source/$3" "$dir/src/$3"
  ask_all "$program" >"$said"
  planted=$((planted + 1))
  local named seen
  named=$(sed -n "s/^$2 FAILED //p" "$said")
  seen="$(awk '$2 == "FAILED"' "$said" | wc -l) of $(wc -l <"$said")"
  if [[ -n $named ]]; then
    caught=$((caught + 1))
    printf '%-29s caught by %-24s %-9s %s\n' "$1" "$2" "($seen)" "$named"
  else
    status=1
    printf '%-29s NOT CAUGHT by %s (%s): %s\n' "$1" "$2" "$seen" "$(grep "^$2 " "$said")"
  fi
}

judge_true_source
printf 'after %s s\n' "$SECONDS"
# shellcheck source=bugs.sh
. "$here/bugs.sh"
printf '%s of %s planted bugs caught, after %s s\n' "$caught" "$planted" "$SECONDS"
exit $status
