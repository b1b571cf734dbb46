"""corrupt.py MEANDER SOURCE_DIR CASES: damaged files of every kind that is read, cut short or with changed bytes.

Each ends with exit code 0, and a whole output, or with 2 or 3, one line and no output at all; never by a signal, never
after more than half a minute. CASES damaged files of each kind, the places spread evenly over the file."""
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile

MEANDER, SOURCE, CASES = sys.argv[1], sys.argv[2], int(sys.argv[3])
SECONDS = 30
SMALL = ['--spp', '1', '--width', '8', '--height', '6', '--threads', '1', '--quiet']
CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
QUADS = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def ply():
    head = ('ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\n'
            'property float z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n').encode()
    return head + b''.join(struct.pack('<3f', *c) for c in CORNERS) + b''.join(
        struct.pack('<B3i', 3, *t) for t in TRIANGLES)


def obj():
    return ('mtllib none.mtl\n' + ''.join('v %g %g %g\n' % c for c in CORNERS) + ''.join(
        'f %d %d %d %d\n' % tuple(k + 1 for k in q) for q in QUADS)).encode()


def glb():
    body = b''.join(struct.pack('<3f', *c) for c in CORNERS) + b''.join(struct.pack('<3H', *t) for t in TRIANGLES)
    text = ('{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":'
            '[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":8,'
            '"type":"VEC3","min":[0,0,0],"max":[1,1,1]},{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],'
            '"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72}],'
            '"buffers":[{"byteLength":168}]}').encode()
    text += b' ' * (-len(text) % 4)
    return (b'glTF' + struct.pack('<2I', 2, 28 + len(text) + len(body)) + struct.pack('<I', len(text)) + b'JSON' + text +
            struct.pack('<I', len(body)) + b'BIN\0' + body)


def read(path):
    with open(path, 'rb') as file:
        return file.read()


def write(path, data):
    with open(path, 'wb') as file:
        file.write(data)


def damaged(whole, random_source):
    """CASES versions of the bytes, half of them cut short and half with one to four bytes changed."""
    cuts = CASES // 2
    for k in range(cuts):
        yield 'cut at %d' % (len(whole) * k // cuts), whole[:len(whole) * k // cuts]
    for k in range(CASES - cuts):
        changed = bytearray(whole)
        places = [(len(whole) * k + random_source.randrange(len(whole))) // (CASES - cuts)]
        places += [random_source.randrange(len(whole)) for _ in range(k % 4)]
        for place in places:
            changed[place] = random_source.randrange(256)
        yield 'changed at %s' % places, bytes(changed)


def judge(command, output):
    """What is wrong with the end of the command; empty when nothing is. And whether it refused."""
    try:
        done = subprocess.run(command, capture_output=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return 'takes more than %d seconds' % SECONDS, False
    said = done.stderr.decode('utf-8', 'replace')
    left = [name for name in os.listdir('out')]
    if done.returncode == 0:
        return ('' if left == [output] else 'leaves %s' % left), False
    if done.returncode not in (2, 3):
        return 'exit code %d: %s' % (done.returncode, said), True
    if not said.startswith('meander: ') or said.count('\n') != 1 or len(said) > 2000:
        return 'is not refused in one line: %s' % said, True
    return ('leaves %s' % left if left else ''), True


def commands():
    """Name of the damaged file, its whole bytes, and the command that reads it and writes out/a.…"""
    scene = SOURCE + '/scenes/sphere_furnace.toml'
    wax = '[[material]]\nname = "wax"\nalbedo = 0.9\nmean_free_path = 0.1\n'
    render = [MEANDER, 'render']
    write('sky.toml', b'[environment]\nimage = "sky.exr"\n')
    write('whole.toml', (wax + '[[light]]\nname = "key"\ntype = "point"\nposition = [0, 3, 3]\nintensity = 4\n'
                         '[[object]]\nshape = "sphere"\nmaterial = "wax"\ntransform = { scale = 0.5 }\n').encode())
    subprocess.run(render + [scene, '-o', 'whole.exr', '--checkpoint', 'whole.ckpt'] + SMALL, check=True)
    subprocess.run(render + [scene, '-o', 'next.exr', '--first-sample', '1'] + SMALL, check=True)
    exr = ['-o', 'out/a.exr']
    yield 'box.ply', ply(), render + ['box.ply'] + exr + SMALL
    yield 'box.obj', obj(), render + ['box.obj'] + exr + SMALL
    yield 'box.glb', glb(), render + ['box.glb'] + exr + SMALL
    yield 'a.toml', read('whole.toml'), render + ['a.toml'] + exr + SMALL
    yield 'sky.exr', read('whole.exr'), render + ['sky.toml'] + exr + SMALL
    yield 'part.exr', read('whole.exr'), [MEANDER, 'merge', 'part.exr', 'next.exr', '--quiet'] + exr
    yield 'run.ckpt', read('whole.ckpt'), render + [scene, '--resume', 'run.ckpt', '-o', 'out/a.exr'] + SMALL


def main():
    failures, counts = [], {}
    for name, whole, command in commands():
        source = random.Random(20261126)
        refusals = 0
        for how, data in [('whole', whole)] + list(damaged(whole, source)):
            write(name, data)
            shutil.rmtree('out', ignore_errors=True)
            os.mkdir('out')
            wrong, refused = judge(command, 'a.exr')
            refusals += refused
            if how == 'whole' and refused:
                wrong = 'the whole file is refused ' + wrong
            if name == 'run.ckpt' and how != 'whole' and not refused and data != whole:
                wrong = 'a damaged checkpoint is taken'
            if wrong:
                failures.append('%s %s: %s' % (name, how, wrong))
        counts[name] = '%d of %d' % (refusals, CASES)
        if refusals < CASES // 4:
            failures.append('%s: only %d of %d damaged files are refused' % (name, refusals, CASES))
    for failure in failures[:40]:
        print('FAILED:', failure)
    print('refused:', ', '.join('%s %s' % item for item in counts.items()))
    sys.exit(1 if failures else 0)


if __name__ == '__main__':
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main()
        os.chdir('/')
