#!/usr/bin/env bash
# mutation.sh CXX SRC DIR: plants one bug at a time into a copy of SRC, builds the oracles against the copy, and requires
# that the oracle named for the bug fails. The true source must pass them all. The source itself is never touched.
set -euo pipefail
cxx=$1 source=$(realpath "$2") dir=$3
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
flags=(-std=c++20 -O2 -DNDEBUG -w -ffp-contract=off -fno-math-errno)
files=(math/random.cpp math/rough_dielectric.cpp render/measure.cpp render/measure_bins.cpp render/parallel.cpp)
patience=30  # seconds; the true source needs about one an oracle
caught=0 planted=0 status=0
mkdir -p "$dir"
dir=$(realpath "$dir")

# ask ORACLE: its line; a walk that a bug has trapped for ever fails too.
ask() {
  local code=0
  timeout "$patience" "$dir/oracles" "$1" || code=$?
  case $code in
    0 | 1) ;;
    124) printf '%s FAILED no end after %s s\n' "$1" "$patience" ;;
    *) printf '%s FAILED exit code %s\n' "$1" "$code" ;;
  esac
}
export -f ask
export dir patience

# judge NAME: builds the copy's oracles and writes what they say to DIR/NAME.txt.
judge() {
  "$cxx" "${flags[@]}" -I "$dir/src" -o "$dir/oracles" "$here/oracles.cpp" "${files[@]/#/$dir/src/}" -ltbb
  "$dir/oracles" | xargs -P "$(nproc)" -I '{}' bash -c 'ask "$1"' ask '{}' >"$dir/$1.txt"
}

fresh_copy() {
  rm -rf "$dir/src"
  cp -r "$source" "$dir/src"
}

# plant FILE FROM TO: FROM must be in the file exactly once.
plant() {
  local text rest
  text=$(<"$dir/src/$1")
  rest=${text#*"$2"}
  if [[ $rest == "$text" || $rest == *"$2"* ]]; then
    printf 'mutation.sh: not exactly once in %s: %s\n' "$1" "$2" >&2
    exit 2
  fi
  printf '%s\n' "${text%%"$2"*}$3$rest" >"$dir/src/$1"
}

# mutant NAME ORACLE FILE FROM TO
mutant() {
  fresh_copy
  plant "$3" "$4" "$5"
  judge "$1"
  planted=$((planted + 1))
  local named seen unseen
  named=$(sed -n "s/^$2 FAILED //p" "$dir/$1.txt")
  seen=$(awk '$2 == "FAILED"' "$dir/$1.txt" | wc -l)
  unseen=$(awk '$2 == "passed" { printf " %s", $1 }' "$dir/$1.txt")
  if [[ -n $named ]]; then
    caught=$((caught + 1))
    printf '%-28s caught by %-18s %s\n' "$1" "$2" "$named"
  else
    status=1
    printf '%-28s NOT CAUGHT by %s: %s\n' "$1" "$2" "$(grep "^$2 " "$dir/$1.txt")"
  fi
  printf '%-28s %s oracles see it; blind:%s\n' '' "$seen" "$unseen"
}

fresh_copy
judge true_source
if grep FAILED "$dir/true_source.txt"; then
  echo "FAILED: the true source does not pass its own oracles"
  exit 1
fi
printf 'the true source passes %s oracles\n' "$(wc -l <"$dir/true_source.txt")"

mutant sign_of_g slab_forward walk/random_walk.h 'sample_henyey_greenstein(g, u1)' 'sample_henyey_greenstein(-g, u1)'
mutant sigma_t_3_percent_high slab_unscattered walk/random_walk.h \
  'sample_free_path(sigma, random.next())' 'sample_free_path(Real(1.03) * sigma, random.next())'
mutant exit_1_percent_short mean_path walk/analytic_worlds.h \
  'std::max(b > 0 ? -c / (b + root) : root - b, Real(0));' \
  'Real(0.99) * std::max(b > 0 ? -c / (b + root) : root - b, Real(0));'
mutant albedo_at_the_exit_too half_space walk/random_walk.h \
  'return {WalkEnd::exited, crossing};' 'walker.weight.albedo *= medium.albedo; return {WalkEnd::exited, crossing};'
mutant roulette_without_factor half_space walk/path_weight.h 'throughput /= survival;' ''
mutant half_circle_azimuth infinite_moments walk/random_walk.h 'sample_azimuth(u2)' 'sample_azimuth(Real(0.5) * u2)'
mutant fixed_frame slab_oblique walk/random_walk.h 'make_frame(walker.direction)' 'make_frame(Vec3(0, 0, -1))'
mutant uniform_entry sphere_diffuse render/measure.cpp 'std::sqrt(1 - double{random.next()})' '(1 - double{random.next()})'
mutant capped_at_50 half_space_bright walk/random_walk.h \
  '++walker.weight.order;' 'if (++walker.weight.order == 50) return {WalkEnd::absorbed, crossing};'
mutant fresnel_swapped sphere_fresnel render/measure.cpp 'eval_fresnel(cosine, ior)' 'eval_fresnel(cosine, 1 / ior)'
mutant eta_squared_missing mean_path_fresnel render/measure.cpp \
  'static_cast<Real>(1 / job_.ior))' 'static_cast<Real>(job_.ior))'
mutant channel_weights_per_step chromatic_slab walk/path_weight.h \
  'ratio *= since;' 'throughput *= since / average(since);'
mutant hero_weighs_alone chromatic_bound walk/path_weight.h 'return p / average(p);' 'return p / p[hero];'
mutant entry_without_reflection mean_path_fresnel render/measure.cpp 'Rgb(1 - fresnel.reflectance)' 'Rgb(1)'
mutant backward_not_swapped half_space_backward math/henyey_greenstein.h \
  'if (g < 0) std::swap(one_minus, one_plus);' ''
mutant total_reflection_lets_out mean_path_fresnel math/fresnel.h 'return {1, 0};' 'return {0, 0};'

printf '%s of %s planted bugs caught\n' "$caught" "$planted"
exit $status
