#!/usr/bin/env bash
# Sets meander up on Debian 12, as root, through sudo, or as a user who may call sudo.
set -euo pipefail

readonly root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
readonly list=$root/third_party/packages.txt
readonly build=$root/build/release
readonly program=$build/src/app/meander
readonly samples=64
export PATH=$PATH:/usr/local/sbin:/usr/sbin:/sbin  # plain su leaves these out, and dpkg needs them

say() { printf '==> %s\n' "$*"; }

# die STATUS MESSAGE: 2 is wrong use or bad input, 3 a failure at run time.
die() {
  printf 'bootstrap.sh: %s\n' "$2" >&2
  exit "$1"
}

usage() {
  cat <<'USAGE'
usage: third_party/bootstrap.sh VERB
  packages      install the Debian packages that are missing
  build         configure and build into build/release
  run [SCENE]   packages, build, then the previewer; without a display a captured picture
  test          packages, build, then the quick test suite
USAGE
}

# Whoever asked for sudo owns what is built, if the checkout is theirs to write to.
find_builder() {
  builder=
  [[ $EUID -eq 0 && -n ${SUDO_USER:-} && $SUDO_USER != root ]] || return 0
  id -u -- "$SUDO_USER" >/dev/null 2>&1 || return 0
  runuser -u "$SUDO_USER" -- test -w "$root" || return 0
  builder=$SUDO_USER
  builder_home=$(getent passwd "$builder" | cut -d: -f6)
}

as_builder() {
  if [[ -n $builder ]]; then
    runuser -u "$builder" -- env HOME="$builder_home" "$@"
  else
    "$@"
  fi
}

as_root() {
  if [[ $EUID -eq 0 ]]; then
    "$@"
  else
    sudo env ${http_proxy+http_proxy="$http_proxy"} ${https_proxy+https_proxy="$https_proxy"} "$@"
  fi
}

missing_packages() {
  local name rest
  while read -r name rest; do
    [[ -z $name || $name == \#* ]] && continue
    # A package of several architectures has a line for each.
    dpkg-query -W -f '${db:Status-Status}\n' "$name" 2>/dev/null | grep -qx installed || printf '%s\n' "$name"
  done <"$list"
}

apt() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 "$@"
}

packages() {
  command -v apt-get >/dev/null && command -v dpkg-query >/dev/null ||
    die 3 "no apt here: install what third_party/packages.txt lists by other means, then use the verb build"
  local missing
  mapfile -t missing < <(missing_packages)
  if ((${#missing[@]} == 0)); then
    say "packages: all installed"
    return
  fi
  say "packages: installing ${missing[*]}"
  [[ $EUID -eq 0 ]] || command -v sudo >/dev/null ||
    die 3 "no sudo here; as root: apt-get install --no-install-recommends ${missing[*]}"
  apt update || say "packages: not every package list could be fetched; going on with those there are"
  apt install -y --no-install-recommends -- "${missing[@]}" || die 3 "apt could not install: ${missing[*]}"
}

# A build folder that root made, or that was made for a checkout elsewhere, must not stop the build.
prepare_build_folder() {
  fresh=()
  if [[ -e $root/build && -n $builder ]]; then
    chown -Rh -- "$builder:$(id -g -- "$builder")" "$root/build"
  fi
  local there=$root/build
  [[ -e $there ]] || there=$root
  [[ -e $build ]] && there=$build
  as_builder test -w "$there" || die 3 "$there cannot be written to by $(as_builder id -un)"
  [[ -f $build/CMakeCache.txt ]] || return 0
  local made_for
  made_for=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
  [[ $made_for -ef $root ]] || fresh=(--fresh)
}

build() {
  local tool
  for tool in cmake ninja "${CXX:-c++}"; do
    command -v "$tool" >/dev/null || die 3 "$tool is not installed: first third_party/bootstrap.sh packages"
  done
  prepare_build_folder
  say "build: configuring build/release"
  as_builder cmake -S "$root" --preset release "${fresh[@]}" ||
    die 3 "cmake could not configure build/release"
  say "build: compiling with $(nproc) jobs"
  as_builder cmake --build "$build" --parallel "$(nproc)" || die 3 "the build failed"
}

has_preview() {
  [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && grep -qw preview <<<"$("$program" --help)"
}

# A path in the current folder named after the scene; nothing that is already there is overwritten.
picture_path() {
  local stem number=2
  stem=$(basename -- "$1")
  stem=$PWD/${stem%.*}
  picture=$stem.png
  while [[ -e $picture ]]; do
    picture=$stem-$number.png
    number=$((number + 1))
  done
}

run() {
  local scene=${1:-$root/scenes/wax_knot.toml}
  [[ -f $scene ]] || die 2 "no such scene: $scene"
  as_builder test -w . || die 2 "a picture could not be written to $PWD: start from a folder of your own"
  packages
  build
  if has_preview; then
    say "run: previewing $scene"
    as_builder "$program" preview "$scene"
    return
  fi
  picture_path "$scene"
  say "run: no window on this machine, capturing $scene at $samples samples a pixel"
  as_builder "$program" capture "$scene" -o "$picture" --spp "$samples"
  say "run: the picture is"
  printf '%s\n' "$picture"
}

quick_suite() {
  packages
  build
  say "test: the quick suite"
  cd -- "$root"
  as_builder ctest --preset release --parallel "$(nproc)" --label-exclude '^(long|bench|mutation)$' --no-tests=error
  say "test: all passed"
}

main() {
  local verb=${1:-} most=1
  [[ $verb == run ]] && most=2
  (($# <= most)) || { usage >&2; die 2 "too many arguments: $*"; }
  find_builder
  case $verb in
    packages) packages ;;
    build) build ;;
    run) run "${@:2}" ;;
    test) quick_suite ;;
    help | -h | --help) usage ;;
    "") usage >&2; exit 2 ;;
    *) usage >&2; die 2 "unknown verb: $verb (packages, build, run, test)" ;;
  esac
}

main "$@"
