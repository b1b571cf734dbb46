#!/usr/bin/env bash
# Checks every #include under src against the floors: a room includes itself and strictly lower floors,
# and each library is known only in the rooms that own it.
#   include_edges.sh SRC_DIR       the self-test, then the sources
#   include_edges.sh --self-test   the self-test alone: what is planted must be found, and nothing else
set -euo pipefail

declare -rA floor_of=(
  [core]=0 [math]=0 [medium]=1 [film]=1 [gl]=1 [stats]=1 [scene]=2
  [walk]=3 [trace]=3 [io]=3 [display]=3 [ui]=3 [render]=4 [app]=5
)
readonly pure_rooms=" core math medium film scene walk stats "

# Sets `owners` to the rooms which may include a library's header, or to nothing when no room owns it.
find_owners() {
  case $1 in
    glm/* | hwy/*) owners=${!floor_of[*]} ;;
    embree[0-9]/*) owners="trace" ;;
    # libstdc++ implements <execution> with oneTBB.
    tbb/* | tbb.h | oneapi/* | execution) owners="render trace" ;;
    OpenImageIO/* | OpenEXR/* | Imath/* | assimp/* | toml++/* | toml.hpp) owners="io" ;;
    GL/* | GLES*/* | EGL/* | KHR/* | GLFW/*) owners="gl display" ;;
    CLI/*) owners="app" ;;
    nlohmann/*) owners="io app" ;;
    imgui*) owners="ui display" ;;
    *) owners= ;;
  esac
}

# A header of C++20, or of C under its C++ name.
is_standard() {
  case $1 in
    algorithm | any | array | atomic | barrier | bit | bitset | charconv | chrono | codecvt) ;;
    compare | complex | concepts | condition_variable | coroutine | deque | exception | filesystem) ;;
    format | forward_list | fstream | functional | future | initializer_list | iomanip | ios) ;;
    iosfwd | iostream | istream | iterator | latch | limits | list | locale | map | memory) ;;
    memory_resource | mutex | new | numbers | numeric | optional | ostream | queue | random) ;;
    ranges | ratio | regex | scoped_allocator | semaphore | set | shared_mutex | source_location) ;;
    span | sstream | stack | stdexcept | stop_token | streambuf | string | string_view | syncstream) ;;
    system_error | thread | tuple | type_traits | typeindex | typeinfo | unordered_map) ;;
    unordered_set | utility | valarray | variant | vector | version) ;;
    cassert | cctype | cerrno | cfenv | cfloat | cinttypes | climits | clocale | cmath | csetjmp) ;;
    csignal | cstdarg | cstddef | cstdint | cstdio | cstdlib | cstring | ctime | cuchar | cwchar) ;;
    cwctype) ;;
    *) return 1 ;;
  esac
}

# Headers of the operating system and the compiler, which the rooms that are not pure may use.
is_system() {
  [[ $1 == sys/* || $1 == linux/* || $1 != */* ]]
}

# Sets `fault` to what is wrong with ROOM including HEADER in quotes or angles; to nothing when it is allowed.
judge_include() {
  local room=$1 header=$2 quote=$3 target=${2%%/*}
  fault=
  if [[ -n ${floor_of[$target]:-} && $header == */* ]]; then
    [[ $target == "$room" ]] && return
    if ((floor_of[$target] >= floor_of[$room])); then
      fault="$room -> $target: $room is on floor ${floor_of[$room]} and $target on floor ${floor_of[$target]}"
    fi
    return
  fi
  is_standard "$header" && return
  find_owners "$header"
  if [[ -n $owners ]]; then
    [[ " $owners " == *" $room "* ]] || fault="$room -> $header: belongs to ${owners// / and }"
  elif [[ $quote == '"' ]]; then
    fault="$room -> $header: names no room; a path starts with the room, as in \"$room/…\""
  elif [[ $pure_rooms == *" $room "* ]]; then
    fault="$room -> $header: a pure room includes only the standard library and glm"
  elif ! is_system "$header"; then
    fault="$room -> $header: no room owns this library; name its room in tests/include_edges.sh"
  fi
}

# Prints a line for each violation under DIR and sets `edges` and `violations` to the counts.
scan() {
  local dir=$1 path line text room
  local -r form='^[[:space:]]*#[[:space:]]*include(_next)?[[:space:]]*(["<])([^">]+)[">]'
  edges=0 violations=0
  while IFS=: read -r path line text; do
    edges=$((edges + 1))
    room=${path#"$dir"/}
    if [[ $room != */* || -z ${floor_of[${room%%/*}]:-} ]]; then
      fault="is in no room: name its floor in tests/include_edges.sh"
    elif [[ $text =~ $form ]]; then
      judge_include "${room%%/*}" "${BASH_REMATCH[3]}" "${BASH_REMATCH[2]}"
    else
      fault="an include that is not a plain file name cannot be checked"
    fi
    [[ -z $fault ]] && continue
    violations=$((violations + 1))
    printf '%s:%s: %s\n' "$path" "$line" "$fault"
  done < <(grep -rnE '^[[:space:]]*#[[:space:]]*include' -- "$dir" || true)
}

# plant DIR FILE LINE: a file of two lines, the second of them LINE.
plant() {
  mkdir -p "$(dirname "$1/$2")"
  printf '// planted\n%s\n' "$3" >"$1/$2"
}

# A file, a line, and the edge that the report must name; `ok` where there must be none.
planted_cases() {
  cat <<'CASES'
math/floor_equal.h|#include "core/error.h"|math -> core
medium/floor_equal.h|#include "film/film.h"|medium -> film
walk/floor_equal.h|#include "trace/world.h"|walk -> trace
film/floor_above.h|#include "scene/scene.h"|film -> scene
core/floor_top.cpp|#include "app/main.h"|core -> app
render/angled.cpp|#include <app/main.h>|render -> app
io/spaced.cpp|  #  include   "render/session.h"|io -> render
walk/embree.cpp|#include <embree3/rtcore.h>|walk -> embree3/rtcore.h
render/embree.cpp|#include "embree3/rtcore.h"|render -> embree3/rtcore.h
io/tbb.cpp|#include <tbb/parallel_for.h>|io -> tbb/parallel_for.h
walk/oneapi.cpp|#include <oneapi/tbb.h>|walk -> oneapi/tbb.h
film/execution.cpp|#include <execution>|film -> execution
app/image.cpp|#include <OpenImageIO/imageio.h>|app -> OpenImageIO/imageio.h
trace/assimp.cpp|#include <assimp/scene.h>|trace -> assimp/scene.h
io/gl.cpp|#include <GL/gl.h>|io -> GL/gl.h
scene/toml.cpp|#include <toml++/toml.h>|scene -> toml++/toml.h
io/cli.cpp|#include <CLI/CLI.hpp>|io -> CLI/CLI.hpp
render/json.cpp|#include <nlohmann/json.hpp>|render -> nlohmann/json.hpp
app/imgui.cpp|#include <imgui.h>|app -> imgui.h
core/posix.cpp|#include <unistd.h>|core -> unistd.h
math/posix.cpp|#include <unistd.h>|math -> unistd.h
medium/posix.cpp|#include <unistd.h>|medium -> unistd.h
film/posix.cpp|#include <unistd.h>|film -> unistd.h
scene/posix.cpp|#include <unistd.h>|scene -> unistd.h
walk/posix.cpp|#include <unistd.h>|walk -> unistd.h
stats/posix.cpp|#include <unistd.h>|stats -> unistd.h
stats/boost.cpp|#include <boost/math/special_functions.hpp>|stats -> boost/math/special_functions.hpp
app/boost.cpp|#include <boost/any.hpp>|app -> boost/any.hpp
film/sideways.cpp|#include "film.h"|film -> film.h
film/upward.cpp|#include "../scene/scene.h"|film -> ../scene/scene.h
film/hidden.cpp|#include HIDDEN_HEADER|not a plain file name
attic/roomless.cpp|#include <vector>|in no room
loose.cpp|#include <vector>|in no room
math/own.cpp|#include "math/random.h"|ok
math/standard.cpp|#include <vector>|ok
math/glm.h|#include <glm/vec3.hpp>|ok
scene/down.h|#include "medium/medium.h"|ok
walk/hwy.cpp|#include <hwy/highway.h>|ok
app/down.cpp|#include "render/session.h"|ok
trace/embree.cpp|#include <embree3/rtcore.h>|ok
render/tbb.cpp|#include <tbb/parallel_for.h>|ok
io/image.cpp|#include <OpenImageIO/imageio.h>|ok
display/gl.cpp|#include <GL/gl.h>|ok
app/json.cpp|#include <nlohmann/json.hpp>|ok
io/posix.cpp|#include <sys/wait.h>|ok
core/comment.cpp|// #include "app/main.h"|ok
CASES
}

self_test() {
  local tree report file line edge found expected=0 failures=0
  tree=$(mktemp -d)
  trap "rm -rf -- '$tree'" EXIT
  while IFS='|' read -r file line edge; do plant "$tree/src" "$file" "$line"; done < <(planted_cases)
  scan "$tree/src" >"$tree/report"
  report=$(<"$tree/report")
  while IFS='|' read -r file line edge; do
    if [[ $edge == ok ]]; then
      [[ $report == *"/$file:"* ]] && fail_self_test "$file: reported, and should not be: $line"
    else
      expected=$((expected + 1))
      found=$(grep -F -- "$tree/src/$file:2: " <<<"$report" || true)
      [[ $found == *"$edge"* ]] || fail_self_test "$file: not found: $line"
    fi
  done < <(planted_cases)
  ((violations == expected)) || fail_self_test "found $violations violations where $expected were planted"
  ((failures == 0)) || exit 1
  printf 'self-test: %d planted violations found\n' "$violations"
}

fail_self_test() {
  failures=$((failures + 1))
  printf 'self-test: %s\n' "$1" >&2
}

main() {
  (($# == 1)) || { printf 'usage: include_edges.sh SRC_DIR | --self-test\n' >&2; exit 2; }
  self_test
  [[ $1 == --self-test ]] && return
  [[ -d $1 ]] || { printf 'include_edges.sh: no such folder: %s\n' "$1" >&2; exit 2; }
  scan "${1%/}"
  printf '%d includes, %d violations\n' "$edges" "$violations"
  ((edges > 0 && violations == 0))
}

main "$@"
