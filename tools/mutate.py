#!/usr/bin/env python3
"""Mutation testing: makes small faults in the sources, one at a time, and counts how many of them the tests catch.

Usage: tools/mutate.py [--count 200] [--seed 1] [--layers spline,scene] [--jobs 1] [--list] ...   from the root of the tree

Works on a copy of the tree in a build folder B (build/mutate). There all of src is one shared library, so that a fault costs one
object and one link, however many tests there are. A build with coverage tells once which tests run which lines; each fault meets only
these, from the quickest to the slowest, one that shares a word with its file's name as if it were ten times as quick, until one fails,
crashes or takes far too long. Tests that took longer than --longest in the suite's last run
(build/test-out/times) are left out; after --patience a fault counts as survivor.

What a run found is kept in B/results.jsonl: the same faults again cost only the tests that changed since. Where a source has changed, all
tests may run its lines, until B is removed and all is measured anew. Seconds are those of B's measurement.

Prints a table of layers and every survivor. Exit status 1 where fewer than 85 % are caught.
"""

import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import threading
import time

WANTED = 85  # per cent
FEWEST = 5  # faults for even the smallest layer
WRAPPED = "malloc calloc realloc aligned_alloc posix_memalign strdup".split()
PLAIN = "-g0 -fPIC -fno-semantic-interposition"
COVERED = "-g0 -O0 -fPIC -fno-semantic-interposition --coverage"
TRAPS = ["-fsanitize=undefined", "-fsanitize-undefined-trap-on-error"]  # as the suite's run under sanitizers ends
MEMORY = 8 << 30  # a fault may allocate without end

Fault = collections.namedtuple("Fault", "layer file line kind start end new before after idle rank", defaults=[False, 0])


# --- faults ------------------------------------------------------------------------------------------------------------

SWAPS = {
    "+": "-", "-": "+", "*": "/", "/": "*", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=",
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&",
}
OPERATOR = re.compile(r"(?<= )([-+*/]=?|[<>]=?|==|!=|&&|\|\|)(?= )")
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:e[+-]?\d+)?|\d+(?:e[+-]?\d+)?)(f?)(?![\w.])")
BOOLEAN = re.compile(r"\b(true|false)\b")
DECLARATION = re.compile(r"^\s*(static |const |struct \w+ |enum \w+ |unsigned |double |float |int |char |bool |long |u?int\d+_t |size_t )")
STATEMENT = re.compile(r"^\s+(?!return\b|break\b|continue\b|goto\b|case\b|default\b|if\b|else\b|for\b|while\b|do\b|\(void\))[\w*(].*;\s*$")
# Asserts, allocations and room for more, and what gives memory back: no behaviour, or seen only by a sanitizer. Bounds of options,
# of which most have none; -1 for none, where any other negative is the same.
LEFT_OUT = re.compile(r"^\s*#|assert|alloc|sizeof|no_memory|free|capacity|strerror|perror|OPTION_|return -1;")
MESSAGE = re.compile(r"\b(fail\w*|warn\w*|f?printf|options_wrong)\(")


def masked(text):
    """The text with comments, strings and characters blanked, each place where it was."""
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S)


def number_for(text, pick):
    if float(text) == 0: return text.replace("0", "1", 1) if "." not in text else "1."
    value = float(text)
    if re.fullmatch(r"\d+", text): return str(int(text) * 2) if pick.random() < 0.5 else str(int(text) + 1)
    return repr(value * 2) if value > 10 or pick.random() < 0.5 else repr(value + 1)


def condition(code):
    """Where the condition of an `if` that ends on its own line begins and ends."""
    found = re.match(r"^\s*(?:\} else )?if \(", code)
    if not found: return None
    depth = 1
    for i in range(found.end(), len(code)):
        depth += {"(": 1, ")": -1}.get(code[i], 0)
        if depth == 0: return found.end(), i
    return None


def faults_of_line(code, follows, pick):
    """(kind, start, end, new text) of every fault that a line of a function may get; `code` is masked."""
    message = MESSAGE.search(code)
    reach = message.start() if message else len(code)
    for m in OPERATOR.finditer(code, 0, reach): yield "operator", m.start(), m.end(), SWAPS[m.group()]
    for m in BOOLEAN.finditer(code, 0, reach): yield "boolean", m.start(), m.end(), {"true": "false", "false": "true"}[m.group()]
    for m in NUMBER.finditer(code, 0, reach):
        dimension = DECLARATION.match(code) and code[m.end():m.end() + 1] == "]"
        if not dimension: yield "number", m.start(1), m.end(1), number_for(m.group(1), pick)
    span = condition(code)
    if span and span[1] <= reach: yield "condition", span[0], span[1], None
    whole = follows and STATEMENT.match(code) and not message and code.count("(") == code.count(")")
    if whole and not DECLARATION.match(code): yield "statement", len(code) - len(code.lstrip()), len(code.rstrip()), ";"


def faults_of_file(path, seed):
    """Each with a rank that only its own line gives it: what changes elsewhere leaves it where it was."""
    text = path.read_text()
    lines, codes = text.split("\n"), masked(text).split("\n")
    inside, found, like, begins = False, [], collections.Counter(), 0
    for i, code in enumerate(codes):
        begin, begins = begins, begins + len(code) + 1
        if code in ("{", "}"): inside = code == "{"
        after_allocation = any("alloc" in c for c in codes[max(0, i - 2):i]) and "if (!" in code
        if not inside or LEFT_OUT.search(code) or after_allocation or "no_memory" in "".join(codes[i + 1:i + 2]): continue
        before = codes[i - 1].rstrip()
        gives_up = "return" in code and "free(" in before and "alloc(" in "".join(codes[max(0, i - 6):i])
        like[code] += 1
        pick = random.Random(f"{seed} {path} {code} {like[code]}")
        for kind, start, end, new in faults_of_line(code, before.endswith((";", "{", "}", ":")), pick):
            old = lines[i]
            if new is None: new = "!(" + old[start:end] + ")"
            changed = old[:start] + new + old[end:]
            found.append(Fault(path.parts[1], str(path), i + 1, kind, begin + start, begin + end, new, old.strip(), changed.strip(),
                               gives_up or is_idle(code, kind, start, end), pick.random()))
    return found


def shares(count, lines):
    """How many of `count` each layer gets: by its lines, but a few at least."""
    total = sum(lines.values())
    few = min(FEWEST, count // len(lines))
    given = {layer: few for layer in lines}
    rest = count - few * len(lines)
    for layer in lines: given[layer] += int(rest * lines[layer] / total)
    by_size = sorted(lines, key=lines.get, reverse=True)
    for i in range(count - sum(given.values())): given[by_size[i % len(by_size)]] += 1
    return given


def is_idle(code, kind, start, end):
    """Whether a fault changes nothing that a test could see: how much a buffer takes and giving something back (a sanitizer's), what is
    no longer bound in OpenGL, or which side of a bound a real number falls that equals it to the last bit."""
    if kind == "statement": return bool(re.match(r"\s*(\w*(close|decref)\(|glBind\w+\((\w+, )?0\);)", code))
    room = re.search(r"snprintf\([^,]*,[^,]*,", code)
    bound = code[start:end] in ("<", "<=", ">", ">=") and NUMBER.match(code, end + 1)
    return bool(room and start < room.end() or bound and "." in bound.group() and float(bound.group(1)) != 0)


def queue_of_layer(layer, seed):
    """All faults of a layer in the order in which they are tried: kinds in turn, at most one a line. Idle ones are dropped last, so
    that a new rule of what is idle leaves the others as they were."""
    pick = random.Random(f"{seed} {layer}")
    kinds, seen, queue = collections.defaultdict(list), set(), []
    for path in sorted(pathlib.Path("src", layer).rglob("*.c")):
        for fault in faults_of_file(path, seed): kinds[fault.kind].append(fault)
    for faults in kinds.values(): faults.sort(key=lambda fault: fault.rank)
    while any(kinds.values()):
        kind = pick.choice(sorted(k for k in kinds if kinds[k]))
        fault = kinds[kind].pop()
        if (fault.file, fault.line) not in seen and not fault.idle: queue.append(fault)
        seen.add((fault.file, fault.line))
    return queue


def faults_named(path):
    """The faults that a file names, one a line: a source, what is there once, and what takes its place; tabs between, \\n for an end of line."""
    for row in pathlib.Path(path).read_text().split("\n"):
        if not row or row.startswith("#"): continue
        file, old, new = (field.replace("\\n", "\n") for field in row.split("\t"))
        text = pathlib.Path(file).read_text()
        if text.count(old) != 1: sys.exit(f"mutate: {path}: expected once in {file}, got {text.count(old)} times: {old}")
        start = text.index(old)
        line = text.count("\n", 0, start) + 1
        yield Fault(file.split("/")[1], file, line, "named", start, start + len(old), new, old.strip(), new.strip() or ";")


# --- the copy, built twice ---------------------------------------------------------------------------------------------


def digest(*paths):
    return hashlib.sha1(b"".join(pathlib.Path(p).read_bytes() for p in paths)).hexdigest()[:16]


def must(command, folder, log):
    with open(log, "ab") as out:
        if subprocess.run(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode:
            sys.exit(f"mutate: {' '.join(map(str, command))[:200]} failed; see {log}")


class Copy:
    """A copy of the tree in which src is a shared library, plain (build) and with coverage (cov)."""

    def __init__(self, root, jobs):
        self.root, self.tree, self.jobs = root, root / "tree", jobs
        self.log = root / "build.log"
        self.tests = {}

    def refresh(self):
        self.tree.mkdir(parents=True, exist_ok=True)
        listed = subprocess.run(["git", "ls-files", "-coz", "--exclude-standard"], stdout=subprocess.PIPE, check=True).stdout
        names = [n for n in listed.decode().split("\0") if n and os.path.isfile(n)]
        for name in names:
            here, there = pathlib.Path(name), self.tree / name
            if there.exists() and there.read_bytes() == here.read_bytes(): continue
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(here, there)
        for gone in set(self.kept()) - set(names): (self.tree / gone).unlink()

    def kept(self):
        for folder in ("src", "tests", "tools"):
            for path in (self.tree / folder).rglob("*.[ch]"): yield str(path.relative_to(self.tree))

    def make(self, where, flags, goals):
        must(["make", f"-j{self.jobs}", f"B={where}", f"CFLAGS={flags}", *goals], self.tree, self.log)

    def link(self, output, objects, *more):
        wraps = [f"-Wl,--wrap={w}" for w in WRAPPED]
        libraries = subprocess.run(["pkg-config", "--libs", "glfw3", "epoxy", "egl", "jansson"], stdout=subprocess.PIPE,
                                   check=True, text=True).stdout.split()
        return ["gcc", "-Wl,--as-needed", *wraps, *more, *objects, "-o", str(output), "-Wl,--no-as-needed",
                *(["-Lbuild/so", "-lparts"] if "-shared" not in more else []), "-Wl,--as-needed",
                *libraries, "-lm", "-ldl", "-lpthread"]

    def objects(self, where):
        return [f"{where}/obj/{s[:-2]}.o" for s in self.sources] + [f"{where}/obj/{n}.o" for n in
                                                                  ("build", "embedded_table", "embedded_data")]

    def build(self):
        self.refresh()
        tree = self.tree
        self.sources = sorted(str(p.relative_to(tree)) for p in (tree / "src").rglob("*.c") if p.name != "main.c")
        tests = sorted(p.stem for p in (tree / "tests").glob("*.c"))
        tools = sorted(p.stem for p in (tree / "tools").glob("*.c"))
        self.make("build", PLAIN, ["all", "build/parts.a"] + [f"build/obj/tests/{t}.o" for t in tests])
        self.make("build/cov", COVERED, ["build/cov/parts.a"])
        self.make("build", PLAIN, ["compile_commands.json"])
        self.commands = {e["file"]: shlex.split(e["command"]) for e in json.loads((tree / "compile_commands.json").read_text())}
        for where in ("build", "build/cov"):
            (tree / where / "so").mkdir(exist_ok=True)
            self.shared(where + "/so/libparts.so", self.objects(where), "--coverage" if "cov" in where else "-O2")
        (tree / "build/tests").mkdir(exist_ok=True)
        support = [f"build/obj/tests/{t}.o" for t in tests if not t.startswith("test_")]
        for test in (t for t in tests if t.startswith("test_")):
            self.program(f"build/tests/{test}", [f"build/obj/tests/{test}.o", *support], "-lcmocka", "-llapacke", "-lopenblas", "-lquadmath")
        for tool in tools: self.program(f"build/{tool}", [f"build/obj/tools/{tool}.o"])
        self.program("build/wiggly", ["build/obj/src/main.o"])
        # A test that calls make would build all of it anew.
        (self.root / "bin").mkdir(exist_ok=True)
        (self.root / "bin/make").write_text("#!/bin/sh\nexit 1\n")
        (self.root / "bin/make").chmod(0o755)
        for path in sorted((tree / "tests").glob("test_*")):
            if path.suffix == ".c": self.tests[path.stem] = digest(tree / "build/tests" / path.stem)
            elif path.suffix == ".sh": self.tests[path.name] = digest(path)

    def shared(self, output, objects, *more):
        must(self.link(output, objects, "-shared", *more), self.tree, self.log)

    def program(self, output, objects, *libraries):
        made = self.tree / output
        newest = max((self.tree / o).stat().st_mtime for o in objects)
        stamp = made.with_name(made.name + ".linked")
        # make, too, makes the program, with all of src in it
        if made.exists() and stamp.exists() and stamp.stat().st_mtime >= max(made.stat().st_mtime, newest): return
        must(self.link(output, objects) + list(libraries), self.tree, self.log)
        stamp.touch()


# --- running a test ----------------------------------------------------------------------------------------------------

Outcome = collections.namedtuple("Outcome", "status failed seconds")
FAILED = re.compile(r"^(?:\[  FAILED  \] ([a-zA-Z_0-9]+)|not ok - (.*))$", re.M)


def run_test(copy, test, library, scratch, cpu, wall, gcov=None):
    """Runs a test with one of the libraries; a status of None is one that took too long."""
    program = ["bash", f"tests/{test}"] if test.endswith(".sh") else [f"build/tests/{test}"]
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    environment = dict(os.environ, B="build", WIGGLY="build/wiggly", TEST_OUT=str(scratch), CC="gcc",
                       LD_LIBRARY_PATH=str(library), PATH=f"{copy.root}/bin:{os.environ['PATH']}")
    if gcov: environment["GCOV_PREFIX"] = str(gcov)

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (int(cpu) + 1, int(cpu) + 2))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))

    started = time.monotonic()
    with open(scratch / "log", "wb") as log:
        process = subprocess.Popen(program, cwd=copy.tree, env=environment, stdin=subprocess.DEVNULL, stdout=log,
                                   stderr=subprocess.STDOUT, preexec_fn=limit, start_new_session=True)
        try:
            status = process.wait(wall)
        except subprocess.TimeoutExpired:
            status = None
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()
    text = (scratch / "log").read_bytes().decode(errors="replace")
    failed = {a or b for a, b in FAILED.findall(text)}
    shutil.rmtree(scratch, ignore_errors=True)
    return Outcome(status, failed, time.monotonic() - started)


def worse(outcome, known):
    """Whether a test found what it does not find in the sources as they are."""
    return outcome.status is None or bool(outcome.failed - set(known["failed"])) or (
        outcome.status != known["status"] and not outcome.failed)


class Knowledge:
    """What each test does with the sources as they are: its time, its failures, and (as .gcda files) the lines it runs."""

    def __init__(self, copy, longest, patience):
        self.copy, self.longest, self.patience = copy, longest, patience
        self.path = copy.root / "tests.json"
        self.known = json.loads(self.path.read_text()) if self.path.exists() else {}
        self.lines = {}
        self.lock = threading.Lock()

    def measure(self, jobs):
        """Measures what is new or has changed, the quickest first; what took long in the suite is not even begun."""
        times = pathlib.Path("build/test-out/times")
        last = dict(reversed(line.split()) for line in times.read_text().splitlines()) if times.exists() else {}
        seconds = lambda test: int(last.get(test, 0)) / 1000
        for test in set(self.known) - set(self.copy.tests): del self.known[test]
        stale = [t for t, d in self.copy.tests.items() if self.known.get(t, {}).get("digest") != d]
        stale = sorted((t for t in stale if seconds(t) <= self.longest), key=seconds)
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool: list(pool.map(self.measure_one, stale))

    def measure_one(self, test):
        gcov = self.copy.root / "gcov" / test
        shutil.rmtree(gcov, ignore_errors=True)
        outcome = run_test(self.copy, test, self.copy.tree / "build/cov/so", self.copy.root / "scratch" / test, 10 * self.longest,
                           20 * self.longest, gcov)
        with self.lock:
            self.known[test] = {"digest": self.copy.tests[test], "status": outcome.status, "failed": sorted(outcome.failed),
                                "seconds": round(outcome.seconds, 2)}
            self.path.write_text(json.dumps(self.known, indent=0))
            self.lines.clear()
        if outcome.status: print(f"mutate: {test} fails in this copy by itself: {len(outcome.failed)} cases", flush=True)

    def lines_of(self, file):
        """For each test that runs a file: how often it runs its lines, as {line: times}; None where that was of other sources."""
        with self.lock:
            if file in self.lines: return self.lines[file]
        made = self.copy.tree / "build/cov/obj" / file
        found = {}
        for test in self.known:
            counted = self.copy.root / "gcov" / test / str(made.with_suffix(".gcda")).lstrip("/")
            if not counted.exists(): continue
            if counted.stat().st_mtime < made.with_suffix(".gcno").stat().st_mtime: # of other sources
                found[test] = None
                continue
            notes = counted.with_suffix(".gcno")
            if not notes.exists(): notes.symlink_to(made.with_suffix(".gcno"))
            told = subprocess.run(["gcov", "--json-format", "--stdout", str(counted)], stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, cwd=self.copy.tree).stdout
            for line in told.decode().splitlines():
                for entry in json.loads(line)["files"]:
                    if entry["file"] != file: continue
                    counts = collections.Counter()
                    for l in entry["lines"]: counts[l["line_number"]] += l["count"]
                    found[test] = counts
        with self.lock: self.lines[file] = found
        return found

    def tests_of(self, fault):
        """Tests that run the line of a fault, in the order in which they are tried."""
        chosen = []
        for test, counts in self.lines_of(fault.file).items():
            known = self.known[test]
            # what goes on from the line above has no count of its own
            runs = counts is None or counts[max((line for line in counts if line <= fault.line), default=0)]
            if runs and known["status"] is not None and known["seconds"] <= 10 * self.longest: chosen.append(test)
        words = set(re.split(r"[/_]", fault.file.removesuffix(".c"))) - {"src"}
        own = lambda test: bool(words & set(test.split(".")[0].split("_")[1:]))
        order, spent = sorted(chosen, key=lambda t: self.known[t]["seconds"] / (10 if own(t) else 1)), 0
        for i, test in enumerate(order):
            spent += self.known[test]["seconds"]
            if i and spent > self.patience: return order[:i]
        return order


# --- one fault ---------------------------------------------------------------------------------------------------------


class Trial:
    """Builds and tests single faults, and keeps what it found."""

    def __init__(self, copy, knowledge):
        self.copy, self.knowledge, self.lock = copy, knowledge, threading.Lock()
        self.path = copy.root / "results.jsonl"
        self.results = {}
        if self.path.exists():
            for line in self.path.read_text().splitlines():
                entry = json.loads(line)
                self.results[entry["key"]] = entry

    def key(self, fault):
        return hashlib.sha1(f"{fault.file} {digest(fault.file)} {fault.line} {fault.after}".encode()).hexdigest()[:16]

    def compile(self, fault, folder):
        """The object with the fault; None where there is none or it is no other than before."""
        text = (self.copy.tree / fault.file).read_text()
        source, made = folder / fault.file, folder / "mutant.o"
        source.parent.mkdir(parents=True, exist_ok=True)
        source.write_text(text[:fault.start] + fault.new + text[fault.end:])
        command = [w for w in self.copy.commands[fault.file] if w not in ("-MMD", "-MP") and not w.startswith("-W")]
        command[command.index("-c") + 1], command[command.index("-o") + 1] = str(source), str(made)
        compiles = lambda *more: subprocess.run(command + ["-w", f"-fmacro-prefix-map={folder}/=", *more], cwd=self.copy.tree,
                                                stderr=subprocess.DEVNULL).returncode == 0
        old = self.copy.tree / "build/obj" / (fault.file[:-2] + ".o")
        if not compiles() or made.read_bytes() == old.read_bytes(): return None
        return made if compiles(*TRAPS) else None

    def caught_by(self, fault, passed, place):
        """The first test that fails with a fault; `passed` receives those that don't."""
        copy = self.copy
        library = place / "so"
        for test in self.knowledge.tests_of(fault):
            if passed.get(test) == copy.tests[test]: continue
            known = self.knowledge.known[test]
            limits = (5 * known["seconds"] + 5, 20 * known["seconds"] + 60)
            outcome = run_test(copy, test, library, place / "scratch", *limits)
            # A test that fails now and then, as scripts do under load, catches nothing.
            steady = outcome.status is not None and not test.endswith(".sh")
            if worse(outcome, known) and (
                    steady or not worse(run_test(copy, test, copy.tree / "build/so", place / "scratch", *limits), known)):
                return test
            passed[test] = copy.tests[test]
        return None

    def run(self, fault, place):
        """None where the fault is none; else the entry of results.jsonl."""
        key = self.key(fault)
        entry = self.results.get(key, {"key": key, "passed": {}})
        if entry.get("caught") or entry.get("same"): return None if entry.get("same") else entry
        shutil.rmtree(place, ignore_errors=True)
        made = self.compile(fault, place)
        entry.update(fault._asdict(), same=made is None)
        if made:
            mine = f"build/obj/{fault.file[:-2]}.o"
            (place / "so").mkdir()
            objects = [str(made) if o == mine else o for o in self.copy.objects("build")]
            self.copy.shared(place / "so/libparts.so", objects)
            entry["caught"] = self.caught_by(fault, entry["passed"], place)
        shutil.rmtree(place, ignore_errors=True)
        with self.lock:
            self.results[key] = entry
            with open(self.path, "a") as out: out.write(json.dumps(entry) + "\n")
        return entry if made else None


def try_faults(trial, queue, count, place):
    """Tries faults in turn until as many as asked for were real."""
    done = []
    for fault in queue:
        if len(done) == count: break
        started = time.monotonic()
        entry = trial.run(fault, place)
        if not entry: continue
        done.append(entry)
        verdict = f"caught by {entry['caught']}" if entry["caught"] else f"SURVIVED {len(entry['passed'])} tests"
        print(f"{fault.file}:{fault.line}: {verdict} ({time.monotonic() - started:.0f} s)\n    {fault.before}\n    {fault.after}", flush=True)
    return done


def report(entries):
    """Prints the table and the survivors; returns per cent caught."""
    layers = collections.defaultdict(list)
    for entry in entries: layers[entry["layer"]].append(entry)
    print(f"\n{'layer':<12} {'faults':>6} {'caught':>6} {'survived':>8}")
    for layer in sorted(layers) + ["all"]:
        of = entries if layer == "all" else layers[layer]
        caught = sum(bool(e["caught"]) for e in of)
        print(f"{layer:<12} {len(of):>6} {caught:>6} {len(of) - caught:>8}  {100 * caught / max(1, len(of)):5.1f} %")
    print()
    for e in entries:
        if not e["caught"]: print(f"{e['file']}:{e['line']}: {len(e['passed'])} tests ran it\n  - {e['before']}\n  + {e['after']}")
    return 100 * sum(bool(e["caught"]) for e in entries) / max(1, len(entries))


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--count", type=int, default=200, help="how many faults (200), spread over the layers by their size")
    options.add_argument("--seed", type=int, default=1, help="another seed makes other faults (1)")
    options.add_argument("--layers", default="", help="only these, separated by commas")
    options.add_argument("--jobs", type=int, default=1, help="how many at once (1)")
    options.add_argument("--longest", type=float, default=30, help="leaves out tests that took longer in the suite's last run, in seconds (30)")
    options.add_argument("--patience", type=float, default=300, help="of a fault: how long its tests take before it counts as survivor, in seconds (300)")
    options.add_argument("--build", default="build/mutate", help="where (build/mutate)")
    options.add_argument("--named", default="", help="only the faults that this file names, as tools/mutate-named.txt does")
    options.add_argument("--list", action="store_true", help="prints the faults that would be tried, and builds nothing")
    given = options.parse_args()
    lines = {p.name: sum(f.read_text().count("\n") for f in p.rglob("*.c")) for p in pathlib.Path("src").iterdir() if p.is_dir()}
    wanted = {l: n for l, n in shares(given.count, lines).items() if not given.layers or l in given.layers.split(",")}
    queues = {layer: (queue_of_layer(layer, given.seed), wanted[layer]) for layer in sorted(wanted)}
    if given.named:
        named = list(faults_named(given.named))
        queues = {"named": (named, len(named))}
    if given.list:
        for queue, count in queues.values():
            for f in queue[:count]: print(f"{f.file}:{f.line}: {f.kind}\n  - {f.before}\n  + {f.after}")
        return 0
    copy = Copy(pathlib.Path(given.build).resolve(), given.jobs)
    copy.build()
    knowledge = Knowledge(copy, given.longest, given.patience)
    knowledge.measure(given.jobs)
    trial = Trial(copy, knowledge)
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        tried = [pool.submit(try_faults, trial, *queue, copy.root / "faults" / name) for name, queue in queues.items()]
        entries = [e for t in tried for e in t.result()]
    return 0 if report(entries) >= WANTED else 1


if __name__ == "__main__":
    sys.exit(main())
