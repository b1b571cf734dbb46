"""storm.py MEANDER SOURCE_DIR: two hundred random steps of a script in a real window, always the same ones; the
previewer must do them all and end well. Run by with_display.sh."""

import os
import pathlib
import random
import subprocess
import sys
import tempfile

MEANDER, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
STEPS, SEED = 200, 7
# None that opens a file dialog, whose entries a later click could choose, or that saves.
KEYS = (
    "F R C 1 2 3 4 5 6 7 8 E Shift+E X K F12 Ctrl+1 Ctrl+2 W D B Ctrl+Z Ctrl+Z Ctrl+Shift+Z Ctrl+Y Ctrl+R Tab H"
).split()
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"


def an_edit(roll):
    color = [round(roll.uniform(0.05, 0.95), 3) for _ in range(3)]
    return roll.choice(
        (
            f"material.wax.color={color}",
            f"material.wax.g={roll.uniform(-0.8, 0.8):.3f}",
            f"light.key.radiance={10 * color[0]:.2f}",
            f"display.exposure={roll.uniform(-2, 2):.2f}",
            f"film.width={roll.randint(24, 160)}",
            f"camera.vertical_fov={roll.randint(15, 60)}",
        )
    )


def a_step(roll):
    """Clicks stay below the toolbar, whose buttons open the dialogs."""
    x, y = (lambda: roll.randint(0, 1279)), (lambda: roll.randint(45, 719))
    kind = roll.randrange(8)
    if kind == 0:
        return "set " + an_edit(roll)
    if kind in (1, 2):
        return "key " + roll.choice(KEYS)
    if kind == 3:
        return f"drag {roll.choice(('left', 'left', 'right', 'middle'))} {x()} {y()} {x()} {y()}"
    if kind == 4:
        return f"click {x()} {y()}"
    if kind == 5:
        return f"move {x()} {y()}\nscroll {roll.randint(-2, 2)}"
    if kind == 6:
        return f"size {roll.randint(200, 1280)} {roll.randint(150, 720)}"
    return roll.choice(("wait-image", "wait-image", "drop bad.toml", "drop missing.hdr", "drop t.obj", "snapshot s.png"))


def main():
    scene = (SOURCE / "scenes" / "wax_knot.toml").read_text()
    pathlib.Path("scene.toml").write_text(scene + "\n[film]\nwidth = 96\nheight = 54\n")
    pathlib.Path("bad.toml").write_text("[camera\n")
    pathlib.Path("t.obj").write_text(TETRAHEDRON)
    roll = random.Random(SEED)
    # `set` names a material that stays; keys that a dialog or a field would keep are let go by the next click.
    steps = [a_step(roll) for _ in range(STEPS)]
    pathlib.Path("script.txt").write_text("\n".join(["wait-image", *steps, "size 800 500", "snapshot last.png", "quit"]))
    run = subprocess.run(
        [MEANDER, "preview", "scene.toml", "--spp", "4", "--script", "script.txt"], capture_output=True, text=True
    )
    if run.returncode != 0 or run.stderr or not pathlib.Path("last.png").exists():
        sys.exit(f"FAILED: exit code {run.returncode}, {run.stderr}")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
