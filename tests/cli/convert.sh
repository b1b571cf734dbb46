#!/usr/bin/env bash
# convert.sh MEANDER SOURCE_DIR: what `convert` writes is well-formed in its own language, whatever the names.
set -uo pipefail
meander=$1 source=$2
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir" || exit 1
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

cat > all.toml <<'EOF'
[scene]
millimetres_per_unit = 10
[[material]]
name = "wax"
color = [0.9, 0.7, 0.4]
radius = [0.3, 0.2, 0.1]
[[material]]
name = "it's \"marble\" --> \\\n\u0001 & <b> 蝋"
preset = "marble"
roughness = 0.2
[[material]]
name = "skin"
albedo = [0.99, 0.1, 0.9999999]
mean_free_path = 0.2
g = -0.3
boundary = "diffuse"
ior = 1.4
[[material]]
name = "ground"
type = "diffuse"
color = 0.5
EOF

for renderer in cycles arnold renderman openpbr mitsuba pbrt; do
  "$meander" convert all.toml --to $renderer > $renderer.txt 2> err.txt || fail "convert --to $renderer: $(cat err.txt)"
  [ -s err.txt ] && fail "convert --to $renderer says $(cat err.txt)"
  [ -s $renderer.txt ] || fail "convert --to $renderer writes nothing"
  grep -q 'of 10 mm each' $renderer.txt || fail "convert --to $renderer does not say its unit"
  grep -q 'ground' $renderer.txt && fail "convert --to $renderer writes an opaque material"
done

python3 - <<'PY' || fail "what is written is not well-formed"
import ast
import re
import sys
import unittest.mock
import xml.etree.ElementTree as xml

tree = ast.parse(open('cycles.txt').read())
names = [node.args[0].value for node in ast.walk(tree) if isinstance(node, ast.Call)
         and ast.unparse(node.func) == 'bpy.data.materials.new']
marble = 'it\'s "marble" --> \\\n\x01 & <b> 蝋'
assert names == ['wax', marble, 'skin'], names
# It also runs, as far as a stand-in for Blender can tell.
bpy = sys.modules['bpy'] = unittest.mock.MagicMock()
bpy.context.scene.cycles.max_bounces = 12
bpy.context.scene.cycles.volume_bounces = 0
exec(open('cycles.txt').read(), {})
assert bpy.context.scene.cycles.volume_bounces == 1024 and bpy.data.materials.new.call_count == 3

root = xml.parse('openpbr.txt').getroot()
assert root.tag == 'materialx' and root.get('colorspace') == 'lin_rec709'
surfaces = {s.get('name'): s for s in root.findall('open_pbr_surface')}
used = [m.find('input').get('nodename') for m in root.findall('surfacematerial')]
assert len(used) == 3 and sorted(used) == sorted(surfaces), used
assert float(surfaces['wax_surface'].find("input[@name='subsurface_radius']").get('value')) == 0.300000007

root = xml.parse('mitsuba.txt').getroot()
assert root.tag == 'scene' and len(root.findall('medium')) == 3 and len(root.findall('bsdf')) == 3
assert [b.get('type') for b in root.findall('bsdf')] == ['null', 'roughdielectric', 'dielectric']

# The other three have strings, brackets and braces to balance.
for name, blocks in (('arnold', 'standard_surface'), ('renderman', 'Bxdf'), ('pbrt', 'MakeNamedMedium')):
    code = '\n'.join(line for line in open(name + '.txt').read().split('\n') if not line.lstrip().startswith('#'))
    assert len(re.findall(blocks, code)) == 3, name
    assert code.count('"') % 2 == 0, name
    for opening, closing in ('[]', '{}'):
        assert code.count(opening) == code.count(closing), name
PY

# One material, into a file of the right type, with an edit.
"$meander" convert all.toml --to mitsuba --material wax --set material.wax.g=0.25 -o wax.xml > out.txt || fail "convert -o"
[ -s out.txt ] && fail "convert -o prints $(cat out.txt)"
python3 - <<'PY' || fail "wax.xml"
import xml.etree.ElementTree as xml
media = xml.parse('wax.xml').getroot().findall('medium')
assert [m.get('id') for m in media] == ['wax_medium']
assert float(media[0].find('phase/float').get('value')) == 0.25
PY
"$meander" convert "$source/scenes/soap.ply" --to cycles > mesh.py || fail "a mesh's studio wax is not converted"
python3 -c 'import ast; ast.parse(open("mesh.py").read())' || fail "mesh.py"

# refuse WANTED ARGS…: exit code 2 and one line that contains WANTED.
refuse() {
  local wanted=$1 status=0 message
  shift
  message=$("$meander" convert "$@" 2>&1 >out.txt) || status=$?
  [ $status -eq 2 ] || fail "convert $*: exit code $status, not 2: $message"
  [ "$(printf '%s\n' "$message" | wc -l)" -eq 1 ] || fail "convert $*: not one line: $message"
  case $message in *"$wanted"*) ;; *) fail "convert $*: says '$message', not '$wanted'" ;; esac
  [ -s out.txt ] && fail "convert $*: wrote $(head -c 99 out.txt)"
}
printf '[[material]]\nname = "ground"\ntype = "diffuse"\n[[material]]\nname = "chalk"\ncolor = 0.8\nradius = 0\n' > opaque.toml
refuse '--to is required' all.toml
refuse "did you mean 'cycles'?" all.toml --to cycls
refuse 'known: cycles, arnold' all.toml --to lightwave3d
refuse "did you mean 'skin'?" all.toml --to pbrt --material skn
refuse "'ground' is not translucent" all.toml --to pbrt --material ground
refuse 'opaque.toml: has no translucent material' opaque.toml --to pbrt
refuse '.xml' all.toml --to mitsuba -o wax.mtlx
refuse 'nowhere' all.toml --to mitsuba -o nowhere/wax.xml
refuse 'none.toml: cannot open' none.toml --to mitsuba
[ -e wax.mtlx ] && fail "a refused conversion left a file"

[ $failures -eq 0 ] || { echo "$failures failures"; exit 1; }
echo "every conversion is well-formed"
