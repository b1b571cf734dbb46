"""A user at the previewer's window: what the X server shows, and a mouse and keys. Needs with_display.sh, xdotool."""

import ctypes
import mmap
import os
import struct
import subprocess
import sys
import time

ACCENT, ERROR, TOOLBAR = (94, 164, 226), (236, 108, 96), (34, 34, 34)
PATIENCE = 60  # seconds that a condition may take on a machine that has much else to do
QUIET = ("sanitizer", "leak", "opengl", "error", "warning")


def fail(message):
    sys.exit("FAILED: " + message)


def wait(condition, what, seconds=PATIENCE):
    """Polls until the condition holds, and returns what it gave."""
    end = time.monotonic() + seconds
    while True:
        if value := condition():
            return value
        if time.monotonic() > end:
            fail("waited in vain: " + what)
        time.sleep(0.05)


def xdotool(*words):
    return subprocess.run(["xdotool", *map(str, words)], capture_output=True, text=True).stdout.strip()


class Shot:
    """A copy of a part of the screen."""

    def __init__(self, rows):
        self.rows = rows

    def pixel(self, x, y):
        b, g, r = self.rows[y][4 * x : 4 * x + 3]
        return r, g, b

    def find(self, color, box):
        """The places of a colour within x0, y0, x1, y1."""
        x0, y0, x1, y1 = box
        word = bytes(color[::-1])
        return [(x, y) for y in range(y0, y1) for x in range(x0, x1) if self.rows[y][4 * x : 4 * x + 3] == word]

    def far_from(self, other, box):
        """The mean difference within a box, in levels: one pixel of every twelve is compared."""
        x0, y0, x1, y1 = box
        total = count = 0
        for y in range(y0, y1, 4):
            for x in range(x0, x1, 3):
                p, q = self.rows[y][4 * x : 4 * x + 3], other.rows[y][4 * x : 4 * x + 3]
                if p != q:
                    total += sum(abs(i - j) for i, j in zip(p, q))
                count += 3
        return total / count


class Screen:
    """The X server's own picture, in the file in which it keeps it (XWD, which xwd writes too)."""

    def __init__(self):
        with open(os.environ["MEANDER_SCREEN"], "rb") as file:
            self.data = mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ)
        header = struct.unpack(">25I", self.data[:100])
        self.line, colors = header[12], header[19]
        self.start = header[0] + 12 * colors
        assert header[11] == 32, header

    def shot(self, x, y, width, height):
        at = self.start + y * self.line + 4 * x
        return Shot([self.data[at + i * self.line : at + i * self.line + 4 * width] for i in range(height)])


class Preview:
    """A running previewer."""

    def __init__(self, program, *words, env=None):
        self.log = open("log", "w+")
        command = [program, "preview", *map(str, words)]
        self.process = subprocess.Popen(command, stderr=self.log, env={**os.environ, **(env or {})})
        self.screen = Screen()
        self.window = wait(self.find, "the window appears")
        xdotool("windowfocus", self.window)
        self.rest()
        wait(lambda: xdotool("getwindowfocus") == self.window, "the window has the keyboard")
        wait(lambda: len(set(self.shot().rows[300][i : i + 3] for i in range(400, 2400, 4))) > 20, "the first picture")

    def find(self):
        if self.process.poll() is not None:
            fail(f"the previewer ended at once, exit code {self.process.returncode}: {self.said()}")
        return xdotool("search", "--onlyvisible", "--name", " – meander$").partition("\n")[0]

    def said(self):
        self.log.seek(0)
        return self.log.read()

    def title(self):
        return xdotool("getwindowname", self.window)

    def place(self):
        lines = dict(l.split("=") for l in xdotool("getwindowgeometry", "--shell", self.window).split("\n"))
        return [int(lines[key]) for key in ("X", "Y", "WIDTH", "HEIGHT")]

    def shot(self):
        return self.screen.shot(*self.place())

    def at_work(self):
        """Whether any thread but the one that draws runs, or would if it had a processor."""
        folder = f"/proc/{self.process.pid}/task"
        for task in set(os.listdir(folder)) - {str(self.process.pid)}:
            try:
                with open(f"{folder}/{task}/stat") as stat:
                    if stat.read().rpartition(")")[2].split()[0] == "R":
                        return True
            except OSError:  # it has ended
                pass
        return False

    def settled(self, box):
        """The shot after which the box does not change any more: nothing is traced, and on a machine that is busy with other
        things the picture has had the time to be drawn."""
        shots = [self.shot()]

        def still():
            for _ in range(30):
                time.sleep(0.01)
                if self.at_work():
                    del shots[:]
                    return False
            shots.append(self.shot())
            return len(shots) > 3 and all(shots[-1].far_from(s, box) == 0 for s in shots[-3:])

        wait(still, "the picture comes to rest")
        return shots[-1]

    def changes(self, before, box, least, what):
        wait(lambda: self.shot().far_from(before, box) > least, what)

    def returns(self, before, box, what):
        wait(lambda: self.shot().far_from(before, box) < 0.05, what)

    def key(self, *chords):
        for chord in chords:
            xdotool("key", chord)

    def move(self, x, y):
        xdotool("mousemove", "--window", self.window, x, y)

    def drag(self, x, y, to_x, to_y):
        self.move(x, y)
        xdotool("mousedown", 1)
        for i in range(1, 5):
            self.move(x + (to_x - x) * i // 4, y + (to_y - y) * i // 4)
        xdotool("mouseup", 1)
        self.rest()

    def rest(self):
        """The pointer goes to the status line, where nothing answers to it."""
        self.move(600, 708)

    def resize(self, width, height):
        xdotool("windowsize", self.window, width, height)
        wait(lambda: self.place()[2:] == [width, height], "the window has its size")

    def end(self, code=0, quiet=True):
        """Waits for the end; the exit code and what was said must be right."""
        wait(lambda: self.process.poll() is not None, "the previewer ends")
        said = self.said()
        if self.process.returncode != code:
            fail(f"exit code {self.process.returncode} instead of {code}: {said}")
        if quiet and any(word in said.lower() for word in QUIET):
            fail("complaints: " + said)
        return said

    def close(self):
        """What the cross of a window's frame does: WM_DELETE_WINDOW, which xdotool of 2016 cannot say."""
        x11 = ctypes.CDLL("libX11.so.6")
        x11.XOpenDisplay.restype = ctypes.c_void_p
        x11.XInternAtom.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
        x11.XInternAtom.restype = ctypes.c_ulong
        x11.XSendEvent.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_long, ctypes.c_char_p]
        x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
        display = x11.XOpenDisplay(None)
        protocols, delete = (x11.XInternAtom(display, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW"))
        client_message = 33
        event = struct.pack(
            "@iLiPLLi5l", client_message, 0, 1, display, int(self.window), protocols, 32, delete, 0, 0, 0, 0
        )
        x11.XSendEvent(display, int(self.window), 0, 0, event.ljust(192, b"\0"))
        x11.XCloseDisplay(display)
