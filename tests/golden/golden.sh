#!/usr/bin/env bash
# golden.sh MEANDER SCENE.toml MATERIAL ALBEDO DIR: a fresh render must agree with the golden image beside the scene
# within the noise of both; the same scene with ALBEDO (1 % too low) in MATERIAL must not.
set -euo pipefail
meander=$1 scene=$2 material=$3 albedo=$4 dir=$5
name=$(basename "$scene" .toml)
golden=${scene%.toml}.exr
mkdir -p "$dir"
"$meander" render "$scene" -o "$dir/$name.exr" --spp 512 --seed 7 --quiet
if ! "$meander" compare "$dir/$name.exr" "$golden" --z-test --output "$dir/$name-difference.png"; then
  echo "FAILED: $dir/$name.exr differs from $golden; difference: $dir/$name-difference.png"
  exit 1
fi
"$meander" render "$scene" -o "$dir/$name-wrong.exr" --spp 512 --seed 7 --quiet --set "material.$material.albedo=$albedo"
status=0
"$meander" compare "$dir/$name-wrong.exr" "$golden" --z-test || status=$?
if [ $status -ne 1 ]; then
  echo "FAILED: an albedo that is 1 % too low goes unnoticed (exit code $status)"
  exit 1
fi
