#!/usr/bin/env python3
"""Mutation testing: makes small faults in the sources, one at a time, and counts how many of them the tests catch.

Usage: tools/mutate.py [--count 200] [--seed 1] [--rooms spline,scene] [--patience 60] [--list]   from the root of the tree

Works on a copy of the tree in build/mutate. A fault costs one object and one link; then tests run, one after the other, until one fails,
crashes or takes far too long: first those that share a word with the file's path, each group from the quickest to the slowest by the
suite's last run (build/test-out/times). After --patience seconds of tests a fault counts as survivor.

Prints a table of rooms and every survivor. Exit status 1 where fewer than 90 % are caught.
"""

import argparse
import collections
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time

WANTED = 90  # per cent
FEWEST = 5  # faults for the smallest part of the code
# How a suite run under sanitizers ends.
FLAGS = "CFLAGS=-g0 -fsanitize=undefined -fsanitize-undefined-trap-on-error"
SAME = " -- " + FLAGS.replace(" ", "\\ ")  # for scripts that call make, which would build the copy anew with other flags
FOLDER = pathlib.Path("build/mutate")

Fault = collections.namedtuple("Fault", "file line kind start end new before after")

SWAPS = {
    "+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=",
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
    "true": "false", "false": "true",
}
OPERATOR = re.compile(r"(?<= )([-+*/]=?|[<>]=?|==|!=|&&|\|\|)(?= )|\b(true|false)\b")
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[+-]?\d+)?|\d+(?:e[+-]?\d+)?)f?(?![\w.\]])")
CONDITION = re.compile(r"^\s*(?:\} else )?if \((.*)\) (?:\{|\w.*;)$")
STATEMENT = re.compile(r"^\s+(?!return\b|break\b|continue\b|goto\b|case\b|default\b|if\b|else\b|for\b|while\b|do\b|\(void\)"
                       r"|static |const |struct \w+ |enum \w+ |unsigned |double |float |int |char |bool |long |u?int\d+_t |size_t )[\w*(].*;$")
CALL = re.compile(r"^\s+(?!return\b|if\b|for\b|while\b|switch\b)[\w.>-]+\(.*\);$")
INDEX = re.compile(r"(?<=[\w\])])\[([a-z]\w*)\]")
LEAVES = re.compile(r"\b(break|continue)(?=;)")
FAILURE = re.compile(r"\bif \(([^{};]*)\)\s+return [^;]*\bfail\w*\(")
# Asserts, allocations, releases and texts: no behaviour, or only visible to sanitizers.
LEFT_OUT = re.compile(r"^\s*#|assert|alloc|need|sizeof|free|capacity|OPTION_|fail\w*\(|warn\w*\(|printf\(|options_wrong\(")


def masked(text):
    """The text with comments, strings and characters blanked, each place where it was."""
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S)


def faults_of_line(code, line):
    """(kind, start, end, new text) of every fault that a line of a function may get; `code` is masked."""
    for m in OPERATOR.finditer(code): yield "operator", m.start(), m.end(), SWAPS[m.group()]
    for m in NUMBER.finditer(code): yield "number", m.start(1), m.end(1), repr(2 * float(m[1])) if "." in m[1] else str(int(float(m[1])) + 1)
    m = CONDITION.match(code)
    if m: yield "condition", m.start(1), m.end(1), "!(" + line[m.start(1):m.end(1)] + ")"
    if STATEMENT.match(code) and code.count("(") == code.count(")"):
        yield "call" if CALL.match(code) else "statement", len(code) - len(code.lstrip()), len(code), ";"
    for m in INDEX.finditer(code): yield "index", m.start(1), m.end(1), m[1] + " + 1"
    for m in LEAVES.finditer(code): yield "leave", m.start(), m.end(), {"break": "continue", "continue": "break"}[m[1]]
    for start, colon, end in ternaries(code):
        yield "ternary", start, end, line[colon + 2:end] + line[colon - 1:colon + 2] + line[start:colon - 1]


def ternaries(code):
    """(start of the first branch, its colon, end of the second branch) of every ternary that a line holds whole."""
    for m in re.finditer(r" \? ", code):
        depth, inner, colon = 0, 0, None
        for i in range(m.end(), len(code)):
            c = code[i]
            depth += (c in "([{") - (c in ")]}")
            if depth < 0 or depth == 0 and c in ",;":
                if colon: yield m.end(), colon, i
                break
            if depth == 0 and c == "?": inner += 1
            elif depth == 0 and c == ":" and colon is None:
                if inner == 0: colon = i
                else: inner -= 1


def faults_of_room(room):
    for path in sorted(pathlib.Path("src", room).rglob("*.c")):
        text = path.read_text()
        for m in FAILURE.finditer(masked(text)):
            yield Fault(str(path), text.count("\n", 0, m.start()) + 1, "failure", m.start(1), m.end(1), "false",
                        f"if ({text[m.start(1):m.end(1)]})", "if (false)")
        inside, begin = False, 0
        for number, (line, code) in enumerate(zip(text.split("\n"), masked(text).split("\n")), 1):
            if code in ("{", "}"): inside = code == "{"
            if inside and not LEFT_OUT.search(code):
                for kind, start, end, new in faults_of_line(code.rstrip(), line):
                    yield Fault(str(path), number, kind, begin + start, begin + end, new, line.strip(),
                                (line[:start] + new + line[end:]).strip())
            begin += len(line) + 1


def chosen(room, seed):
    """The faults of a room in the order in which they are tried: kinds in turn, at most one a line."""
    pick = random.Random(f"{seed} {room}")
    kinds, seen = collections.defaultdict(list), set()
    for fault in faults_of_room(room): kinds[fault.kind].append(fault)
    for faults in kinds.values(): pick.shuffle(faults)
    while any(kinds.values()):
        fault = kinds[pick.choice(sorted(k for k in kinds if kinds[k]))].pop()
        if (fault.file, fault.line) not in seen: yield fault
        seen.add((fault.file, fault.line))


def shares(count, seed):
    """How many faults each room gets, by its lines, but a few at least; and which."""
    lines = {p.name: sum(f.read_text().count("\n") for f in p.rglob("*.c")) for p in pathlib.Path("src").iterdir() if p.is_dir()}
    few = min(FEWEST, count // len(lines))
    rest = count - few * len(lines)
    return {room: (few + round(rest * n / sum(lines.values())), chosen(room, seed)) for room, n in sorted(lines.items())}


def make(*goals):
    return subprocess.run(["make", "-s", "-j2", FLAGS, *goals], cwd=FOLDER, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def copy_tree():
    listed = subprocess.run(["git", "ls-files", "-coz", "--exclude-standard"], stdout=subprocess.PIPE, check=True).stdout
    for name in listed.decode().split("\0"):
        there = FOLDER / name
        if not os.path.isfile(name) or there.exists() and there.read_bytes() == pathlib.Path(name).read_bytes(): continue
        there.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(name, there)


def rooms():
    return sorted({path.parent.name for path in pathlib.Path("tests").glob("*/test_*.c")})


def room_of(test):
    return next((path.parent.name for path in pathlib.Path("tests").glob(f"*/{test}.c")), None)


def tests_for(file, times):
    words = set(re.split(r"[/_]", file.removesuffix(".c"))) - {"src"}
    return sorted(times, key=lambda test: (not words & {room_of(test), *test.split(".")[0].split("_")[1:]}, times[test]))


def fails(test, seconds):
    """Whether a test fails, crashes or takes far longer than it did."""
    program = ["bash", f"tests/{test}"] if test.endswith(".sh") else [f"build/tests/{room_of(test)}", test]
    scratch = (FOLDER / "scratch").resolve()
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir()
    run = subprocess.Popen(program, cwd=FOLDER, env=dict(os.environ, B="build", WIGGLY="build/wiggly", TEST_OUT=str(scratch), MAKEFLAGS=SAME),
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, start_new_session=True)
    try:
        return run.wait(10 * seconds + 20) != 0
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        return True


def caught_by(fault, times, patience):
    """The test that catches a fault, "" where none does; None where the fault does not compile or changes nothing."""
    source, made = FOLDER / fault.file, FOLDER / "build/obj" / (fault.file[:-2] + ".o")
    text, before = source.read_text(), made.read_bytes()
    source.write_text(text[:fault.start] + fault.new + text[fault.end:])
    try:
        if not make("build/tests/libparts.so", "build/wiggly") or made.read_bytes() == before: return None
        began = time.monotonic()
        for test in tests_for(fault.file, times):
            if fails(test, times[test]): return test
            if time.monotonic() - began > patience: break
        return ""
    finally:
        source.write_text(text)


def try_room(room, count, faults, times, patience):
    tried = []
    for fault in faults:
        if len(tried) == count: break
        test = caught_by(fault, times, patience)
        if test is None: continue
        tried.append((fault, test))
        print(f"{fault.file}:{fault.line}: {f'caught by {test}' if test else 'SURVIVED'}\n  - {fault.before}\n  + {fault.after}", flush=True)
    make("build/tests/libparts.so", "build/wiggly")
    return tried


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--count", type=int, default=200, help="how many faults (200), spread over the rooms by their size")
    options.add_argument("--seed", type=int, default=1, help="another seed makes other faults (1)")
    options.add_argument("--rooms", default="", help="only these, separated by commas")
    options.add_argument("--patience", type=float, default=60, help="seconds of tests before a fault counts as survivor (60)")
    options.add_argument("--list", action="store_true", help="prints the faults that would be tried, and builds nothing")
    given = options.parse_args()
    queues = {room: queue for room, queue in shares(given.count, given.seed).items() if not given.rooms or room in given.rooms.split(",")}
    if given.list:
        for count, faults in queues.values():
            for fault, _ in zip(faults, range(count)): print(f"{fault.file}:{fault.line}: {fault.kind}\n  - {fault.before}\n  + {fault.after}")
        return 0
    copy_tree()
    if not make("all", *(f"build/tests/{room}" for room in rooms())):
        sys.exit("mutate: the tests could not be built; see make -C build/mutate test")
    last = pathlib.Path("build/test-out/times")
    if not last.exists(): sys.exit("mutate: how long tests take is not known; run make test first")
    times = {test: int(ms) / 1000 for ms, test in map(str.split, last.read_text().splitlines()) if test.endswith(".sh") or room_of(test)}
    times = {test: seconds for test, seconds in times.items() if seconds < given.patience and not fails(test, seconds)}
    tried = {room: try_room(room, *queue, times, given.patience) for room, queue in queues.items()}
    print(f"\n{'room':<12} {'faults':>6} {'caught':>6}")
    tried["all"] = [pair for pairs in tried.values() for pair in pairs]
    for room, pairs in tried.items(): print(f"{room:<12} {len(pairs):>6} {sum(bool(test) for _, test in pairs):>6}")
    caught = sum(bool(test) for _, test in tried["all"])
    return 0 if 100 * caught >= WANTED * len(tried["all"]) else 1


if __name__ == "__main__":
    sys.exit(main())
