"""How files are damaged and programs watched while they read them: what the fuzz scripts share."""

import os
import re
import struct
import subprocess
import time

NUMBERS = ["0", "1", "-1", "2", "3", "15", "16", "99", "1000001", "2147483647", "2147483648", "-2147483648", "4294967296",
           "9223372036854775807", "-9223372036854775808", "18446744073709551615", "1e308", "-1e308", "1e-320", "nan",
           "inf", "-inf", "1e5", "0.5", "x", "", "1 1", "0x10", "$", "\0", "1,5"]
WORDS = [struct.pack("<q", value) for value in (0, 1, -1, 2, 1 << 31, 1 << 32, (1 << 63) - 1, -(1 << 63), 100, 10**6)]
WORDS += [struct.pack("<d", value) for value in (0.0, 1.0, -1.0, 1e308, 1e-320, float("nan"), float("inf"))]
WORDS += [struct.pack("<i", value) for value in (0, 1, -1, 2, 3, 9, 15, 1 << 30, -(1 << 31))]


def damage_lines(data, rng):
    """Lines dropped, doubled, exchanged, moved; numbers replaced; sections dropped, doubled, exchanged or put within
    another."""
    lines = data.split(b"\n")
    k, m = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(9)
    if kind == 0:
        del lines[k]
    elif kind == 1:
        lines.insert(k, lines[m])
    elif kind == 2:
        lines[k], lines[m] = lines[m], lines[k]
    elif kind == 3:
        del lines[k:k + rng.randrange(1, 30)]
    elif kind == 4:
        lines.insert(k, rng.choice([b"$Foo", b"$EndFoo", b"$Nodes", b"$EndNodes", b"$Elements", b"$Comments", b"text"]))
    elif kind < 8:
        for _ in range(rng.choice((1, 1, 1, 3))):
            k = rng.randrange(len(lines))
            words = lines[k].split(b" ")
            place = rng.randrange(len(words))
            other = rng.choice(lines).split(b" ")
            words[place] = rng.choice((rng.choice(NUMBERS).encode(), rng.choice(other)))
            lines[k] = b" ".join(words)
    else:
        marks = [(at, word) for at, word in enumerate(lines) if re.fullmatch(rb"\$(?!End)\w+", word)]
        at, word = rng.choice(marks or [(0, b"$")])
        ends = [k + 1 for k in range(at, len(lines)) if lines[k] == b"$End" + word[1:]]
        end = ends[0] if ends else len(lines)
        section = lines[at:end]
        if rng.random() < 0.5:
            del lines[at:end]
        k = rng.randrange(len(lines) or 1)
        lines[k:k] = section if rng.random() < 0.7 else []
    return b"\n".join(lines)


def damage_bytes(data, rng):
    """Bytes flipped or overwritten by numbers that hurt, pieces dropped, doubled, exchanged; the end cut off."""
    data = bytearray(data)
    kind = rng.randrange(6)
    at = rng.randrange(len(data))
    if kind == 0:
        for _ in range(rng.choice((1, 2, 8))):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    elif kind < 3:
        for _ in range(rng.choice((1, 1, 4))):
            word = rng.choice(WORDS)
            at = rng.randrange(len(data))
            data[at:at + len(word)] = word
    elif kind == 3:
        del data[at:at + rng.choice((1, 4, 8, 24, 200))]
    elif kind == 4:
        piece = data[at:at + rng.choice((4, 8, 24, 200))]
        other = rng.randrange(len(data))
        data[other:other] = piece
    else:
        del data[at:]
    return bytes(data)


def watched(command, folder, hang, environment=None, enough=None):
    """Runs a program in a folder. Exit code, stdout, stderr, seconds of work (on a busy machine those on the clock say
    little), and MB of the largest process. What hangs is killed, after six times `hang` on the clock; so is what has said
    `enough`, whose exit code then is 0."""
    start = time.monotonic()
    with open(folder / "said", "wb") as out, open(folder / "err", "wb") as err:
        child = subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=out, stderr=err)
        said_enough = False
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid:
                break
            said_enough = enough is not None and enough in (folder / "said").read_text(errors="replace")
            if time.monotonic() - start > 6 * hang or said_enough:
                child.kill()
                _, status, usage = os.wait4(child.pid, 0)
                break
            time.sleep(0.01)
    child.returncode = os.waitstatus_to_exitcode(status)
    seconds = usage.ru_utime + usage.ru_stime
    said, text = ((folder / name).read_text(errors="replace") for name in ("said", "err"))
    return 0 if said_enough else child.returncode, said, text, seconds, usage.ru_maxrss / 1024
