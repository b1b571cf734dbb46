#!/usr/bin/env bash
# errors.sh MEANDER SOURCE_DIR: bad input gets one clear line, exit code 2, and nothing is written.
set -uo pipefail
meander=$1 source=$2
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
mkdir in out
cp "$source/scenes/sphere_furnace.toml" in/good.toml
failures=0

# refuse WANTED ARGS…: the arguments must fail with a message that contains WANTED.
refuse() {
  local wanted=$1 status=0 message
  shift
  message=$("$meander" "$@" 2>&1 >out.txt) || status=$?
  if [ $status -ne 2 ]; then echo "FAILED: meander $*: exit code $status, not 2: $message"; failures=$((failures + 1)); fi
  if [ "$(printf '%s\n' "$message" | wc -l)" -ne 1 ]; then echo "FAILED: meander $*: not one line: $message"; failures=$((failures + 1)); fi
  case $message in *"$wanted"*) ;; *) echo "FAILED: meander $*: says '$message', not '$wanted'"; failures=$((failures + 1)) ;; esac
  if [ -n "$(ls -A out)" ] || [ -s out.txt ]; then echo "FAILED: meander $*: wrote $(ls -A out) $(head -c 99 out.txt)"; failures=$((failures + 1)); rm -rf out; mkdir out; fi
}

# scene NAME: a scene file from standard input.
scene() { cat > "in/$1.toml"; }
wax='[[material]]
name = "wax"
albedo = 0.9
mean_free_path = 0.1'

refuse 'A subcommand is required'
refuse "did you mean 'render'" rendr in/good.toml -o out/a.exr
refuse 'known: preview, render, capture' xyzzy
refuse '--sppp' render in/good.toml -o out/a.exr --sppp 4
refuse 'required' render in/good.toml
refuse "'0'" render in/good.toml -o out/a.exr --spp 0
refuse "'-3'" render in/good.toml -o out/a.exr --time -3
for number in nan inf 010x 0x10 1e2 -1; do
  refuse "is '$number', but must be a whole number from 1 to 2147483648" render in/good.toml -o out/a.exr --spp="$number"
done
refuse '--crop: is '"'a', but must be a whole number from 0 to 16384" render in/good.toml -o out/a.exr --crop a,0,4,4
refuse "--ior: is 'nan', but must be a number from 1 to 4" measure slab --boundary dielectric --ior nan
refuse "--roughness: is 'nan', but must be a number from 0 to 1" measure slab --boundary dielectric --ior 1.5 --roughness nan
refuse "--exposure: is 'nan', but must be a number from -50 to 50" capture in/good.toml -o out/a.png --exposure nan
refuse "--ui-scale: is 'nan', but must be a number from 0.5 to 4" capture in/good.toml -o out/a.png --ui --ui-scale nan
refuse "'nan'" render in/good.toml -o out/a.exr --error nan
refuse 'analog' render in/good.toml -o out/a.exr --estimator guided
refuse '0 <= X0 < X1 <= 256' render in/good.toml -o out/a.exr --crop 10,10,10,20
refuse 'none.toml: cannot open' render in/none.toml -o out/a.exr
refuse '.exr' render in/good.toml -o out/a.jpg
refuse '.png' capture in/good.toml -o out/a.exr
refuse 'nowhere' render in/good.toml -o nowhere/a.exr
refuse '.json' render in/good.toml -o out/a.exr --stats out/a.txt
refuse 'out' render in/good.toml -o out
refuse 'there is no material named' render in/good.toml -o out/a.exr --set material.jade.g=0
refuse "did you mean 'white'" render in/good.toml -o out/a.exr --set object.sphere.material=whit

printf '[camera]\nlook_form = [0, 0, 1]\n' | scene unknown
refuse "in/unknown.toml:2:1: unknown key 'look_form' in [camera]; did you mean 'look_from'?" render in/unknown.toml -o out/a.exr
printf '[film]\nwidth = "wide"\n' | scene type
refuse 'in/type.toml:2:9: ' render in/type.toml -o out/a.exr
printf '%s\ng = nan\n' "$wax" | scene nan
refuse "in/nan.toml:5:5: 'g' is nan" render in/nan.toml -o out/a.exr
printf '%s\ng = -1\n' "$wax" | scene g
refuse "in/g.toml:5:5: 'g' is -1" render in/g.toml -o out/a.exr
printf '%s\n' "${wax/0.9/1.01}" | scene albedo
refuse "in/albedo.toml:3:10: 'albedo' is 1.01, but must be in [0, 1]" render in/albedo.toml -o out/a.exr
printf '%s\n' "${wax/0.1/0}" | scene zero
refuse "in/zero.toml:4:18: 'mean_free_path' is 0, but must be greater than 0" render in/zero.toml -o out/a.exr
printf '%s\n' "${wax/0.1/1e-39}" | scene dense
refuse "in/dense.toml:4:18: 'mean_free_path' gives an extinction of 1e+39 per unit of length, but it must be at most 1e30" render in/dense.toml -o out/a.exr
printf '%s\n[[object]]\nshape = "sphere"\nmaterial = "wax"\ntransform = { scale = -1 }\n' "$wax" | scene scale
refuse "in/scale.toml:8:23: 'scale' is -1" render in/scale.toml -o out/a.exr
printf '[film]\nwidth = -5\n' | scene size
refuse "in/size.toml:2:9: 'width' is -5" render in/size.toml -o out/a.exr
printf 'width = = 5\n' | scene syntax
refuse 'in/syntax.toml:1:' render in/syntax.toml -o out/a.exr

mesh_scene() { printf '%s\n[[object]]\nmesh = "%s"\nmaterial = "wax"\n' "$wax" "$1" | scene mesh; }
mesh_scene none.ply
refuse 'none.ply: cannot open' render in/mesh.toml -o out/a.exr
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' > in/empty.obj
mesh_scene empty.obj
refuse 'in/empty.obj' render in/mesh.toml -o out/a.exr
printf 'v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n' > in/point.obj
mesh_scene point.obj
refuse 'in/point.obj' render in/mesh.toml -o out/a.exr
head -c 3000 "$source/scenes/soap.ply" > in/cut.ply
refuse 'in/cut.ply' render in/cut.ply -o out/a.exr
printf 'hello' > in/word.fbx
refuse '.ply' render in/word.fbx -o out/a.exr

refuse 'slab' measure cube
refuse '--albedo is 1.5' measure slab --albedo 1.5
refuse '--g must be' measure slab --g 1
refuse '--tau must be' measure slab --tau 0
refuse 'not finite' measure halfspace --albedo 1
refuse 'cosine=MU' measure slab --incidence sideways
refuse '--roughness needs --boundary dielectric' measure slab --roughness 0.5
refuse 'dielectric needs --ior' measure slab --boundary dielectric
refuse '--radius is the range of --radial-bins' measure slab --radius 3
refuse '--json or --csv' measure slab --json --csv
refuse 'need --json' measure slab --albedo 0.1:0.9:3 --angular-bins 4
refuse '--inversion is that of --color' measure halfspace --inversion chiang
refuse 'a slab in mm needs --thickness' measure slab --sigma-s 10 --sigma-a 0.1
refuse 'none.exr' compare in/none.exr in/none.exr
refuse "is '', but must be the name of a file" render in/good.toml -o ''
refuse "SCENE: is '', but must be the name of a file" render '' -o out/a.exr
refuse 'in: is a folder, not a scene file' render in -o out/a.exr
refuse '/dev/null: is not a regular file' render /dev/null -o out/a.exr
# Nothing that is read is written over, and no device is put away for a file.
"$meander" render in/good.toml -o in/sky.exr --spp 2 --width 8 --height 8 --checkpoint in/run.exr --quiet
printf '[environment]\nimage = "sky.exr"\n' | scene sky
cp in/sky.exr kept.exr
refuse 'in/sky.exr: --output would overwrite an input' render in/sky.toml -o in/sky.exr
refuse 'in/run.exr: --output would overwrite an input' render in/good.toml --spp 2 --width 8 --height 8 --resume in/run.exr -o in/run.exr
ln -s sky.exr in/link.exr
refuse 'in/link.exr: --output would overwrite an input' render in/sky.toml -o in/link.exr
cmp in/sky.exr kept.exr || { echo "FAILED: an input was written over"; failures=$((failures + 1)); }
mkfifo in/pipe.exr
ln -s pipe.exr in/to_pipe.exr
for name in pipe to_pipe; do refuse "cannot write in/$name.exr: it is not a regular file" render in/good.toml -o in/$name.exr; done
[ -p in/pipe.exr ] || { echo "FAILED: a pipe was put away"; failures=$((failures + 1)); }

# Leading zeros are no octal numbers.
"$meander" render in/good.toml -o in/ten.exr --seed 010 --spp 010 --width 08 --height 8 --quiet --stats in/ten.json
grep -q '"seed": 10' in/ten.json && grep -q '"spp": 10' in/ten.json || { echo "FAILED: 010 is not ten"; failures=$((failures + 1)); }
# A scene whose name is not UTF-8 has statistics all the same.
cp in/good.toml $'in/\xff.toml'
"$meander" render $'in/\xff.toml' -o in/ten.exr --spp 2 --width 8 --height 8 --quiet --estimator analog --stats in/name.json &&
  grep -q '"isa": "baseline"' in/name.json || { echo "FAILED: statistics of a scene whose name is not UTF-8"; failures=$((failures + 1)); }

# A seed that no signed integer holds travels as text.
"$meander" render in/good.toml -o in/large.exr --seed 18446744073709551615 --spp 2 --width 8 --height 8 --quiet
refuse 'the very samples of seed 18446744073709551615' report in/good.toml -o out/report --seed 18446744073709551615 \
  --spp 2 --width 8 --height 8 --reference in/large.exr

# An open mesh is a warning with the number of open edges, not an error.
for size in 1e30 1e-30; do  # of a bare mesh, which the studio is built around
  printf 'v 0 0 0\nv %s 0 0\nv 0 %s 0\nv 0 0 %s\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' $size $size $size > in/size.obj
  refuse 'in/size.obj: is 1.73205e' render in/size.obj -o out/a.exr
done
printf 'ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\nabc' > in/huge.ply
refuse 'in/huge.ply: ' render in/huge.ply -o out/a.exr
case $("$meander" render in/huge.ply -o out/a.exr 2>&1) in *std::*) echo "FAILED: in/huge.ply: names a type"; failures=$((failures + 1)) ;; esac
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n' > in/open.obj
mesh_scene open.obj
message=$("$meander" render in/mesh.toml -o out/open.exr --spp 1 --width 8 --height 8 2>&1) || { echo "FAILED: an open mesh is refused: $message"; failures=$((failures + 1)); }
case $message in *'warning: in/open.obj: 3 open edges'*) ;; *) echo "FAILED: an open mesh says: $message"; failures=$((failures + 1)) ;; esac

[ $failures -eq 0 ] || { echo "$failures failures"; exit 1; }
echo "every bad input was refused in one line"
