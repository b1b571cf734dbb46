"""preview.py MEANDER SOURCE_DIR [PART…]: a user at the previewer's window. What is asked is seen from outside: what the X
server shows, titles, exit codes, messages, files. Run by with_display.sh."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

from desktop import ACCENT, ERROR, TOOLBAR, Preview, fail, wait

MEANDER, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SMALL = ("--spp", 8, "--window", "1280,720")
MESSAGES = (300, 480, 660, 560)  # the lower middle of the picture
IMAGE = (200, 100, 800, 420)  # within the picture, above where messages appear
PANEL = (970, 80, 1270, 690)
LENGTH = (1050, 214, 1272, 232)  # the row "Mean free path"


def copy_scene(name="look.toml"):
    """The default scene with a film that is done at once."""
    text = (SOURCE / "scenes" / "wax_knot.toml").read_text()
    pathlib.Path(name).write_text(text + "\n[film]\nwidth = 160\nheight = 90\n")
    return name


def handle(preview):
    """Where the handle of the length's slider is."""
    places = preview.shot().find(ACCENT, LENGTH)
    return sum(x for x, _ in places) / len(places) if places else None


def is_at(preview, place, slack):
    found = handle(preview)
    return found is not None and abs(found - place) <= slack


def looks_around():
    """Orbit, undo, views, exposure, hiding, comparing, sizes: the picture changes as it must, and returns."""
    preview = Preview(MEANDER, copy_scene(), *SMALL)
    first = preview.settled(IMAGE)
    if preview.title() != "look.toml – meander":
        fail("the title is " + preview.title())
    preview.drag(450, 330, 570, 330)
    preview.changes(first, IMAGE, 4, "an orbit changes the picture")
    wait(lambda: preview.title().startswith("*"), "the title says that the scene was changed")
    preview.key("ctrl+z")
    preview.returns(first, IMAGE, "one undo takes the whole drag back, and the picture is the same to the bit")
    wait(lambda: not preview.title().startswith("*"), "the title says that the scene is as it was")
    preview.process.send_signal(signal.SIGSTOP)  # all of a drag between two frames
    preview.drag(450, 330, 570, 330)
    preview.process.send_signal(signal.SIGCONT)
    wait(lambda: preview.title().startswith("*"), "a drag is not lost in a slow frame")
    preview.key("ctrl+z")
    preview.returns(first, IMAGE, "one undo takes this drag back, too")
    preview.key("6")
    preview.changes(first, IMAGE, 10, "the normals are another picture")
    preview.key("1", "shift+e")
    preview.changes(first, IMAGE, 3, "exposure changes the picture")
    preview.key("e")
    preview.returns(first, IMAGE, "exposure and back is nothing")
    preview.key("Tab")
    preview.changes(first, PANEL, 5, "Tab puts the panel away")
    preview.key("Tab")
    preview.returns(first, IMAGE, "Tab brings everything back")
    preview.key("k", "w")
    line = (470, 100, 486, 420)
    preview.changes(first, line, 1, "a wipe shows its line")
    preview.key("w")
    preview.returns(first, line, "the wipe goes")
    for size in ((640, 400), (300, 200), (1600, 1000), (1280, 720)):
        preview.resize(*size)
        corners = ((2, 2), (size[0] - 2, 2), (2, size[1] - 2))
        wait(lambda: all(preview.shot().pixel(*at) == TOOLBAR for at in corners), f"the bars reach the corners at {size}")
    preview.returns(first, IMAGE, "the old size shows the old picture")
    preview.key("question")
    preview.changes(first, IMAGE, 5, "the help lies over the picture")
    preview.key("Escape")
    preview.returns(first, IMAGE, "Escape closes the help, not the window")
    preview.key("Escape")  # there are unsaved edits: it asks
    preview.changes(first, MESSAGES, 3, "Escape speaks of the edits that would be lost")
    preview.key("Escape")
    preview.end(0)


def moves_a_slider():
    """The slider of the mean free path: dragged, typed into, reset; saved, and closed by the frame's cross."""
    scene = copy_scene()
    preview = Preview(MEANDER, scene, *SMALL)
    first = preview.settled(IMAGE)
    start = handle(preview)
    y = (LENGTH[1] + LENGTH[3]) // 2
    preview.drag(int(start), y, int(start) - 40, y)
    wait(lambda: is_at(preview, start - 40, 2), "the handle follows the pointer")
    preview.changes(first, IMAGE, 1, "the picture follows the slider")
    preview.key("ctrl+z")
    preview.returns(first, IMAGE, "one undo takes the drag back")
    preview.move(int(start), y)
    subprocess.run(["xdotool", "keydown", "ctrl", "click", "1", "keyup", "ctrl"], check=True)
    preview.rest()
    preview.key("ctrl+a", "0", "period", "0", "5", "Return")
    wait(lambda: is_at(preview, start - 16, 2), "a typed length moves the handle")
    preview.changes(first, IMAGE, 1, "the picture follows the typed length")
    preview.key("ctrl+s")
    wait(lambda: "radius = [0.05," in pathlib.Path(scene).read_text(), "Ctrl+S saves the length")
    wait(lambda: not preview.title().startswith("*"), "saved is not modified")
    preview.key("ctrl+z")
    preview.returns(first, IMAGE, "undo goes back behind the save")
    wait(lambda: preview.title().startswith("*"), "which is a change again")
    preview.drag(int(start), y, int(start) - 60, y)
    wait(lambda: is_at(preview, start - 60, 2), "another drag")
    preview.move(int(start) + 8, y)
    subprocess.run(["xdotool", "click", "--repeat", "2", "--delay", "60", "1"], check=True)
    preview.rest()
    wait(lambda: not preview.title().startswith("*"), "a double click resets to what was saved")
    preview.close()
    preview.end(0)


def watches_files():
    """Scene and shaders are read anew when they change; what is broken keeps the picture, and says so."""
    scene = copy_scene("watched.toml")
    shutil.copytree(SOURCE / "shaders", "shaders")
    preview = Preview(MEANDER, scene, *SMALL, env={"MEANDER_SHADERS": os.path.abspath("shaders")})
    first = preview.settled(IMAGE)
    below = (200, 420, 800, 600)

    def write(name, text):
        pathlib.Path(name + ".new").write_text(text)
        os.replace(name + ".new", name)

    good = pathlib.Path(scene).read_text()
    write(scene, good.replace("color = [0.92, 0.66, 0.36]", "color = [0.2, 0.4, 0.9]"))
    preview.changes(first, IMAGE, 3, "a changed scene is shown")
    blue = preview.settled(IMAGE)
    write(scene, good + "nonsense\n")
    wait(lambda: preview.shot().find(ERROR, below), "a broken scene is an error on the screen")
    preview.returns(blue, IMAGE, "a broken scene keeps the last good picture")
    write(scene, good)
    preview.returns(first, IMAGE, "the mended scene is shown")
    shader = pathlib.Path("shaders/film.frag").read_text()
    end = "void main() { color = vec4(view(), 1.0); }"
    if end not in shader:
        fail("film.frag ends in another way than this test knows")
    before = len(preview.shot().find(ERROR, below))
    write("shaders/film.frag", shader + "}\n")
    wait(lambda: len(preview.shot().find(ERROR, below)) > before, "a broken shader is an error on the screen")
    preview.returns(first, IMAGE, "a broken shader keeps the last good one")
    write("shaders/film.frag", shader.replace(end, "void main() { color = vec4(1.0 - view(), 1.0); }"))
    preview.changes(first, IMAGE, 30, "a mended shader draws")
    preview.process.send_signal(signal.SIGINT)
    preview.end(0)


def plays_a_script():
    """Drops, which no xdotool can make, in a real window."""
    copy_scene("dropped.toml")
    pathlib.Path("t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    pathlib.Path("script.txt").write_text(
        "wait-image\nsnapshot knot.png\ndrop t.obj\nwait-image\nsnapshot tetrahedron.png\ndrop nothing.stl\n"
        "drop knot.png\nwait 0.1\nsnapshot wiped.png\nsize 800 500\nwait-image\nsnapshot small.png\n"
    )
    preview = Preview(MEANDER, "dropped.toml", *SMALL, "--script", "script.txt")
    wait(lambda: preview.place()[2:] == [800, 500], "the script resizes the window")
    wait(pathlib.Path("small.png").exists, "the script writes its snapshots")
    preview.close()
    preview.end(0)
    pictures = [pathlib.Path(name + ".png").read_bytes() for name in ("knot", "tetrahedron", "wiped", "small")]
    if len(set(pictures)) != 4:
        fail("the snapshots of a script are not four pictures")


def has_no_display():
    env = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    run = subprocess.run([MEANDER, "preview"], env=env, capture_output=True, text=True)
    if run.returncode != 3 or "meander capture" not in run.stderr or run.stderr.count("\n") != 1:
        fail(f"without a display: exit code {run.returncode}, {run.stderr}")


def loses_its_server():
    preview = Preview(MEANDER, copy_scene(), *SMALL)
    os.kill(int(os.environ["MEANDER_XVFB_PID"]), signal.SIGTERM)
    if "meander capture" not in preview.end(3, quiet=False):
        fail("a lost display does not name capture: " + preview.said())


if shutil.which("xdotool") is None:
    print("no xdotool here: nobody to do anything")
    sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    parts = (has_no_display, looks_around, moves_a_slider, watches_files, plays_a_script, loses_its_server)
    for part in parts:
        if part.__name__ in sys.argv[3:] or not sys.argv[3:]:
            print(part.__name__, flush=True)
            part()
