"""The package against the program `wiggly`, and each promise of its pages."""

import copy
import csv
import doctest
import json
import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
import warnings
from pathlib import Path

import numpy as np

import wiggly
from wiggly import Bound, Group, Knot, Pin, Scene, Spline, Status, _library, _many, solve_many

TREE = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("WIGGLY", str(TREE / "build" / "wiggly"))
KNOTS = [(0, 0), (1, 1), (2.5, -0.4), (3, 0.2)]


class Tail(Spline):
    pass


class Named(Spline):
    def __init__(self, name):
        super().__init__(KNOTS, frequency=1.5)
        self.name = name


def load_tests(loader, tests, pattern):
    for name in sorted(name for name in sys.modules if name.split(".")[0] == "wiggly"):
        tests.addTests(doctest.DocTestSuite(sys.modules[name]))
    return tests


def solved_by_program(path, solver):
    """The columns of `wiggly solve`: total, Re x, Im x of each spline."""
    out = subprocess.run([PROGRAM, "solve", str(path), "--solver", solver], capture_output=True, encoding="utf-8", check=True).stdout
    return np.array(list(csv.reader(out.splitlines()))[1:], dtype=float).T[1:]


class Pages(unittest.TestCase):
    def test_their_programs_run(self):
        for page in ("docs/python.md", "python/README.md"):
            blocks = re.findall(r"^```python\n(.*?)^```$", (TREE / page).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
            self.assertTrue(blocks)
            exec(compile("".join(blocks), page, "exec"), {})

    def test_the_notebook_runs_and_holds_no_output(self):
        cells = json.loads((TREE / "python/examples/figures.ipynb").read_text(encoding="utf-8"))["cells"]
        self.assertTrue(all(not cell.get("outputs") for cell in cells))
        try:
            import matplotlib
        except ImportError:
            self.skipTest("Matplotlib is not installed")
        matplotlib.use("agg")
        names = {}
        for cell in cells:
            if cell["cell_type"] == "code":
                exec("".join(cell["source"]), names)
        self.assertEqual(len(names["plt"].get_fignums()), 6)

    def test_the_package_has_the_librarys_version(self):
        self.assertEqual(wiggly.__version__, wiggly.version())


class Headers(unittest.TestCase):
    text = re.sub(r"///.*", "", "".join((TREE / "include/wiggly" / name).read_text(encoding="utf-8") for name in ("wiggly.h", "more.h")))

    def body(self, kind, name):
        return re.search(rf"typedef {kind} {name} {{(.*?)}} {name};", self.text, re.DOTALL)[1]

    def test_structures_have_the_members_of_the_headers(self):
        for name, own in (
            ("desc", _library.CDesc), ("param", _library.CParam), ("curve", _library.CCurve),
            ("numbers", _library.CRows), ("rows", _library.CRows), ("many", _library.CMany), ("pull", _library.CPull),
            ("pin", _library.CPin), ("bound", _library.CBound), ("explanation", _library.CExplanation), ("poles", _library.CPoles),
            ("knot", None),
        ):  # fmt: skip
            members = re.findall(r"(\w+)\)?(?:\[\d\])*[,;]", self.body("struct", f"wiggly_{name}"))
            self.assertEqual([field[0] for field in own._fields_] if own else list(_library.KNOT.names), members, name)

    def test_statuses_are_those_of_the_headers(self):
        names = re.findall(r"WIGGLY_(?:ERROR_)?(\w+)", self.body("enum", "wiggly_status"))
        self.assertEqual([*Status.__members__, "STATUS_COUNT"], names)
        self.assertEqual(_library.lib.wiggly_status_text(Status.PIN + 1), b"unknown status")
        for status in Status:
            self.assertNotEqual(status.sentence, "unknown status")


class Scenes(unittest.TestCase):
    def compare(self, path, solver="chain"):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", wiggly.WigglyWarning)
            curves = Scene.load(path).solve(solver)
        rows = [row for curve in curves.values() for row in (curve.total, curve.re, curve.im)]
        np.testing.assert_array_equal(rows, solved_by_program(path, solver), err_msg=str(path))

    def test_every_committed_scene_has_the_bits_of_the_program(self):
        scenes = sorted((TREE / "assets" / "scenes").glob("*.json"))
        self.assertGreater(len(scenes), 10)
        for path in scenes:
            self.compare(path)

    def test_vectors_have_the_bits_of_the_program_by_both_solvers(self):
        # tracks, spring and friction, substeps, poses, stills, loops
        for name in ("track_uses_total", "spring_friction", "complex_substeps", "keys_pose_loop", "keys_two_stills", "loop_resonant"):
            for solver in ("chain", "band"):
                self.compare(TREE / "tests" / "vectors" / f"{name}.json", solver)

    def test_limits_variation_and_a_first_frame(self):
        scene = {"wiggly": 1, "fps": 30, "substeps": 3, "frames": [10, 70], "splines": [
            {"name": "a", "frequency": 1.3, "limits": [None, 1.1], "variation": {"seed": 7, "amount": 0.3},
             "knots": [{"frame": 60.2, "value": 1}, {"frame": 12.5, "value": 0.3, "slope": 2}]}]}  # fmt: skip
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.json"
            path.write_text(json.dumps(scene))
            self.compare(path)

    def test_curves_of_a_rig_are_read_between_samples(self):
        for name, curve in Scene.load(TREE / "assets/scenes/dog.json").solve().items():
            between, step = curve(curve.times[:-1] + 0.5 / curve.fps), np.abs(np.diff(curve.total)).max()
            np.testing.assert_allclose(between, (curve.total[:-1] + curve.total[1:]) / 2, rtol=0, atol=step / 2, err_msg=name)

    def test_a_scene_with_a_rig_says_what_it_needs(self):
        path = TREE / "assets" / "scenes" / "hands.json"
        with unittest.mock.patch.dict(os.environ, WIGGLY="/nowhere/wiggly"), self.assertRaisesRegex(wiggly.Error, "WIGGLY"):
            Scene.load(path).solve()

    def test_export_writes_the_programs_file(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = TREE / "assets" / "scenes" / "tail.json"
            Scene.load(scene).export(Path(folder) / "a.csv")
            subprocess.run([PROGRAM, "export", str(scene), "-o", str(Path(folder) / "b.csv"), "--quiet"], check=True)
            self.assertEqual((Path(folder) / "a.csv").read_bytes(), (Path(folder) / "b.csv").read_bytes())

    def test_faults_of_scenes_are_sentences(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = self.broken(Path(folder))
            for says in ("truncated", "at most 100000, got 0", "knots[0]: expected an object", "got 1e+300", '"x" itself', "joint: expected a whole"):
                path = next(path for line, path in paths.items() if says in line)
                check = subprocess.run([PROGRAM, "check", str(path)], capture_output=True, encoding="utf-8").stdout
                self.assertIn(self.fault(path) or "?", check)
            with unittest.mock.patch.dict(os.environ, WIGGLY="/nowhere/wiggly"):
                texts = {line: self.fault(path) for line, path in paths.items()}
            self.assertGreater(sum(map(bool, texts.values())), 60)
            for line, path in paths.items():
                self.assertRegex(texts[line] or f"{path}: ", "^" + re.escape(f"{path}: "))
            for line, says in (("truncated", "line 6"), ("got 1e+300", "x: knot 0: a knot is outside"), ('"r" itself', "wiggly check")):
                self.assertRegex(next(text for known, text in texts.items() if line in known), says)

    def broken(self, folder):
        """The scenes that tests/bad lists, by what it says of them; its rigs, which need the program, only where they are at fault."""
        bad, paths = TREE / "tests/bad", {}
        whole = (bad / "base.json").read_text()
        splines = re.sub(r',\n    { "name": "z".*', "\n  ]\n}\n", whole, flags=re.DOTALL)
        for number, line in enumerate((bad / "expected.txt").read_text().splitlines()):
            *fields, says = line.split("\t")
            if len(fields) == 1:
                paths[says] = bad / fields[0]
            elif fields:
                text = splines if fields[0] in splines else whole
                for old, new in zip(fields[::2], fields[1::2]):
                    text = text.replace(old, new, 1)
                paths[says] = folder / f"{number}.json"
                paths[says].write_text(text)
        return paths

    def fault(self, path):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", wiggly.WigglyWarning)
                Scene.load(path).solve()
        except wiggly.Error as error:
            return str(error)


class Splines(unittest.TestCase):
    def test_every_knot_is_hit_exactly_whatever_its_form(self):
        for knots in (KNOTS, np.array(KNOTS), [Knot(*knot) for knot in KNOTS], iter(KNOTS)):
            curve = Spline(knots, frequency=1, damping=0.1).solve(97)
            self.assertEqual(curve.total[[0, 24, 60, 72]].tolist(), [0, 1, -0.4, 0.2])

    def test_a_time_becomes_the_nearest_sample(self):
        curve = Spline([(0.49 / 24, 1), (1.5 / 24, 2)], mode="cubic").solve(5, fps=24)
        self.assertEqual(curve.total[[0, 2]].tolist(), [1, 2])

    def test_errors_name_the_knot_and_are_the_librarys_sentences(self):
        for knots, status, index in (
            ([(0, 0), (1, 1), (1.01, 2)], Status.KNOT_TWICE, 2),
            ([(0, 0), (9, 1)], Status.KNOT_OUTSIDE, 1),
            ([(0, 0), (float("nan"), 1)], Status.KNOT_OUTSIDE, 1),
            ([(0, 0), (1e300, 1)], Status.KNOT_OUTSIDE, 1),
            ([(0, float("inf"))], Status.KNOT_NUMBER, 0),
            ([(0, 0), Knot(1, 0, slope=1, still=True)], Status.KNOT_STILL, 1),
        ):
            with self.assertRaises(ValueError) as caught:
                Spline(knots, frequency=1).solve(97)
            self.assertEqual((caught.exception.status, caught.exception.knot), (status, index))
            self.assertEqual(str(caught.exception), f"knot {index}: {status.sentence}")
            self.assertEqual(pickle.loads(pickle.dumps(caught.exception)).knot, index)

    def test_wrong_arguments_are_errors_in_words(self):
        for wrong, fragment in (
            (lambda: Spline(mode="Complex"), "mode: expected complex, real, cubic, got 'Complex'"),
            (lambda: Spline(np.zeros((3, 3))), r"knots: .* \(n, 2\), got \(3, 3\)"),
            (lambda: Spline(frequency=np.ones(5)).solve(6), r"track: .* \(6,\), .* got \(5,\)"),
            (lambda: Spline().solve(0, fps=0), "fps"),
            (lambda: Spline(calm=2).solve(5), "calm 0 to 1"),
            (lambda: Spline(seed=2**31), "seed"),
            (lambda: Spline(frequency=np.ones(5)).poles(sample=5), "sample"),
            (lambda: solve_many(Spline(), [0], [1], 5, parts="total"), "parts: .* got 'total'"),
            (lambda: solve_many(Spline(), [0], [1], 5, threads=-1), "threads: expected 1 to 256, got -1"),
            (lambda: solve_many(Spline(), [0], [1], 5, threads=0), "threads: expected 1 to 256, got 0"),
            (lambda: Group([Spline()]).solve(5, pins=[Pin(0, {0: [1, 0]}, [0, 0, 0])]), r"three numbers, .* got \(2,\)"),
            (lambda: Group([Spline(), Spline()], [1]), r"weights: expected one a spline, 2, got an array of shape \(1,\)"),
            (lambda: Group([Spline()], 1), r"weights: .* got an array of shape \(\)"),
            (lambda: Group([Spline()]).solve(5, pins=[Pin(float("nan"), {}, [0, 0, 0])]), "a pin is outside"),
            (lambda: Group([Spline()]).solve(5, pins=[Pin(0, {3: [1, 0, 0]}, [0, 0, 0])]), "^a pointer is missing or a count"),
        ):
            with self.assertRaisesRegex(ValueError, fragment):
                wrong()

    def test_a_curve_that_is_not_as_described_warns(self):
        path = TREE / "tests" / "vectors" / "loop_resonant.json"
        with self.assertWarnsRegex(wiggly.WigglyWarning, "calm 0.05") as caught:
            curves = Scene.load(path).solve()
        self.assertEqual(caught.filename, __file__)
        self.assertEqual(curves["x"].status, Status.CALMED)

    def test_a_number_of_numpy_is_a_number(self):
        expected = Spline(KNOTS, frequency=2, damping=0.5).solve(97).total
        for number in (np.int64(2), np.float32(2), np.array(2.0)):
            np.testing.assert_array_equal(Spline(KNOTS, frequency=number, damping=np.float32(0.5)).solve(97).total, expected)

    def test_limits_hold(self):
        free = Spline(KNOTS, frequency=0.7).solve(97)
        held = Spline(KNOTS, frequency=0.7, limits=(-0.5, None)).solve(97)
        self.assertLess(free.total.min(), -0.6)
        self.assertGreaterEqual(held.total.min(), -0.5)

    def test_lagged_is_the_equation(self):
        curve = Spline(KNOTS, frequency=1, equilibrium=0.3).solve(97)
        angles = np.linspace(0, 6, 5)
        rows = curve.lagged(angles)
        np.testing.assert_allclose(rows, [curve.y + (np.exp(-1j * angle) * curve.x).real for angle in angles], rtol=0, atol=1e-14)
        np.testing.assert_array_equal(curve.lagged(angles[2]), rows[2])
        self.assertEqual(curve(1.5, lag=angles).tolist(), rows[:, 36].tolist())

    def test_a_curve_between_samples(self):
        curve = Spline(KNOTS, frequency=1, start="loop").solve(97)
        t = np.array([[0.51, 1.013], [2.2, 3.9]])
        step = 1e-5
        np.testing.assert_allclose(curve.derivative(t), (curve(t + step) - curve(t - step)) / (2 * step), rtol=1e-6)
        self.assertAlmostEqual(curve(0.51 + 4), curve(0.51), 12)
        self.assertIsInstance(curve(0.51), float)
        self.assertTrue(np.isnan(curve(np.nan)) and curve([]).shape == (0,))
        np.testing.assert_allclose(curve(curve.times), curve.total, atol=1e-15)

    def test_the_derivative_at_a_knot_with_a_slope_is_the_slope(self):
        knots = [Knot(0, 0, slope=2, stiffness=1e9), Knot(1, 1, slope=-3, stiffness=1e9), Knot(2, 0.5, slope=1, stiffness=1e9)]
        for mode in ("complex", "real", "cubic"):
            curve = Spline(knots, frequency=1.5, damping=0.1, mode=mode).solve(49)
            for read in (curve, pickle.loads(pickle.dumps(curve))):
                np.testing.assert_allclose(read.derivative([0, 1 - 1e-9, 1, 2]), [2, -3, -3, 1], atol=1e-6)

    def test_a_prepared_solver_has_the_same_bits(self):
        solver = Spline(KNOTS, frequency=1, damping=0.1, limits=(-2, 2)).prepare(97)
        for value in (0.5, -1, 1.9):
            solver.knots["value"][1] = value
            knots = [KNOTS[0], (1, value), *KNOTS[2:]]
            expected = Spline(knots, frequency=1, damping=0.1, limits=(-2, 2)).solve(97)
            np.testing.assert_array_equal(solver.solve()._block, expected._block)
        solver.knots["sample"][1] = 60
        with self.assertRaises(wiggly.Error) as caught:
            solver.solve()
        self.assertEqual(caught.exception.status, Status.KNOT_TWICE)

    def test_a_prepared_solver_keeps_its_memory_whatever_is_assigned(self):
        solver = Spline(KNOTS, frequency=1).prepare(97)
        knots = solver.knots.copy()
        knots["value"][1] = 0.3
        solver.knots = knots
        knots["value"][1] = 9
        self.assertEqual(solver.solve().total[24], 0.3)
        for wrong in (knots[:2], knots["value"], [0, 1, 2, 3], None):
            with self.assertRaisesRegex(ValueError, r"knots: expected an array of shape \(4,\) like the solver's own, got"):
                solver.knots = wrong
        with self.assertRaises(ValueError):
            solver.knots.resize(2, refcheck=False)
        with self.assertRaisesRegex(AttributeError, "curve: a solver fills the same curve each time; copy it"):
            solver.curve = Spline().solve(5)
        total = solver.solve().total
        self.assertEqual(total[24], 0.3)
        solver.curve.__init__(3, 1)
        others = [np.zeros((5, 97)) for _ in range(9)]
        total[24] = 9
        solver.solve()
        self.assertEqual(total[24], 0.3)
        self.assertFalse(np.any(others))

    def test_a_prepared_solver_is_copied_with_memory_of_its_own(self):
        solver = Tail(KNOTS, frequency=np.full(97, 1.5)).prepare(97)
        solver.knots["value"][1] = 0.7
        expected = solver.solve().total.copy()
        for copied in (copy.copy(solver), copy.deepcopy(solver), pickle.loads(pickle.dumps(solver))):
            np.testing.assert_array_equal(copied.curve.total, expected)
            np.testing.assert_array_equal(copied.solve().total, expected)
            copied.knots["value"][1] = -0.5
            self.assertEqual(copied.solve().total[24], -0.5)
            del copied
        np.testing.assert_array_equal(solver.solve().total, expected)
        with self.assertRaisesRegex(TypeError, "cannot be copied"):
            copy.copy(solver._handle)

    def test_a_track_keeps_its_memory_whatever_becomes_of_its_array(self):
        track = np.full(97, 1.5)
        spline = Spline(KNOTS, frequency=track)
        solver = spline.prepare(97)
        expected = solver.solve().total.copy()
        with self.assertRaises(ValueError):
            track.resize(10**6, refcheck=False)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            track.dtype = np.float32
        with self.assertRaisesRegex(ValueError, r"expected an array of shape \(194,\), .* got \(97,\)"):
            spline.solve(194)
        np.testing.assert_array_equal(solver.solve().total, expected)
        spline.__init__([])
        np.testing.assert_array_equal(solver.solve().total, expected)

    def test_tracks_change_in_place(self):
        arrays = (
            np.zeros(97), np.zeros(97, "f4"), np.zeros(97, ">f8"), np.zeros(97, int), np.zeros(194)[::2], np.zeros(97)[::-1],
            np.ma.zeros(97), np.zeros((97, 2))[:, 1],
        )  # fmt: skip
        for frequency in arrays:
            for equilibrium in arrays:
                frequency[:], equilibrium[:] = 2, 0
                spline = Spline(KNOTS, frequency=frequency, equilibrium=equilibrium)
                solver = spline.prepare(97)
                solver.solve()
                frequency[40:], equilibrium[20:] = 3, 1
                expected = Spline(KNOTS, frequency=frequency.tolist(), equilibrium=equilibrium.tolist()).solve(97)
                np.testing.assert_array_equal(solver.solve()._block, expected._block)
                np.testing.assert_array_equal(spline.solve(97)._block, expected._block)

    def test_a_masked_knot_is_no_knot(self):
        mask = [[0, 0], [1, 1], [0, 1], [0, 0]]
        masked = np.ma.array(KNOTS, mask=mask)
        expected = Spline([KNOTS[0], KNOTS[3]], frequency=1).solve(97)
        np.testing.assert_array_equal(Spline(masked, frequency=1).solve(97)._block, expected._block)
        times = np.ma.array([t for t, _ in KNOTS], mask=[0, 1, 1, 0])
        many = solve_many(Spline(frequency=1), times, [v for _, v in KNOTS], 97)
        np.testing.assert_array_equal(many.total[0], expected.total)
        plain = Knot(1, 1, slope=np.ma.masked, phase=np.ma.masked)
        np.testing.assert_array_equal(Spline([plain, (0, 0)]).solve(97)._block, Spline([(1, 1), (0, 0)]).solve(97)._block)
        with self.assertRaises(wiggly.Error):
            Spline(KNOTS, frequency=np.ma.array(np.ones(97), mask=[1] + 96 * [0])).solve(97)
        self.assertEqual(np.isnan(expected(np.ma.array([0.1, 0.2], mask=[0, 1]))).tolist(), [False, True])

    def test_splines_can_be_pickled(self):
        spline = Tail(iter(KNOTS), frequency=np.full(97, 1.5), limits=(-1, None), variation=0.2, seed=4)
        other = pickle.loads(pickle.dumps(spline))
        self.assertIs(type(other), Tail)
        np.testing.assert_array_equal(other.solve(97)._block, spline.solve(97)._block)
        named = Named("tail")
        for other in (copy.copy(named), copy.deepcopy(named), pickle.loads(pickle.dumps(named))):
            self.assertEqual((type(other), other.name), (Named, "tail"))
            np.testing.assert_array_equal(other.solve(97)._block, named.solve(97)._block)

    def test_curves_can_be_copied_and_pickled(self):
        curve = Spline(KNOTS, frequency=1).solve(97)
        for other in (pickle.loads(pickle.dumps(curve)), copy.deepcopy(curve)):
            np.testing.assert_array_equal(other._block, curve._block)
            self.assertEqual(other(0.51), curve(0.51))
            other.total[0] = 9
            self.assertEqual(curve.total[0], 0)

    def test_threads_have_the_same_bits(self):
        expected, wrong = Spline(KNOTS, frequency=1).solve(97).total, []

        def work():
            for i in range(50):
                Spline(KNOTS, frequency=2).solve(97 + i)
                if not np.array_equal(Spline(KNOTS, frequency=1).solve(97).total, expected):
                    wrong.append(i)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_explanation_and_poles(self):
        self.assertEqual(wiggly.explain(KNOTS[:3]), [])
        poles = Spline(frequency=2, damping=0.1, mode="real").poles(fps=30)
        omega = 4 * np.pi
        np.testing.assert_allclose(sorted(poles.s.imag), [-omega * np.sqrt(0.99), omega * np.sqrt(0.99)])
        np.testing.assert_allclose(poles.z, np.exp(poles.s / 30))


class Crowds(unittest.TestCase):
    def test_many_have_the_bits_of_one_by_one(self):
        random = np.random.default_rng(3)
        spline = Spline(frequency=1.5, damping=0.1, wind_up=0.5, equilibrium=0.2)
        times = np.sort(random.choice(96, (40, 4)) + np.arange(4) * 100, axis=1) / 24
        times[7, 2:] = np.nan
        values, slopes = random.normal(size=(4, 40)).T, np.where(random.random((40, 4)) < 0.3, 1.0, np.nan)
        settles = random.random((40, 4)) < 0.3
        many = solve_many(spline, times, values, 401, slopes=slopes, settles=settles, parts=("total", "y", "re", "im"), threads=3)
        for i in range(40):
            rows = zip(times[i], values[i], slopes[i], settles[i])
            knots = [Knot(t, v, None if np.isnan(s) else s, settles=o) for t, v, s, o in rows if not np.isnan(t)]
            one = Spline(knots, **spline.parameters).solve(401)
            for part in ("total", "y", "re", "im"):
                np.testing.assert_array_equal(getattr(many, part)[i], getattr(one, part))

    def test_portions_join(self):
        values = np.random.default_rng(5).normal(size=(5000, 2))
        values[[7, 4000]] = np.inf
        many = solve_many(Spline(frequency=1), [[0, 1]], values, 97, check=False)
        self.assertEqual(np.flatnonzero(many.status).tolist(), [7, 4000])
        for i in (0, 1029, 1030, 1031, 3091, 4999):
            one = Spline([(0, values[i, 0]), (1, values[i, 1])], frequency=1).solve(97)
            np.testing.assert_array_equal(many.total[i], one.total)
        with self.assertRaises(wiggly.Error) as caught:
            solve_many(Spline(frequency=1), [0, 1], values[8:], 97)
        self.assertEqual((caught.exception.spline, caught.exception.knot), (3992, 0))

    def test_threads_are_as_many_as_this_process_may_use(self):
        with unittest.mock.patch.object(os, "sched_getaffinity", lambda _: {3, 5, 7}, create=True):
            self.assertEqual(_many._threads(None), 3)

    @unittest.skipIf(os.name == "nt", "Windows has no such signal")
    def test_ctrl_c_stops_a_batch(self):
        values = np.broadcast_to([0.0, 1.0], (10**7, 2))
        timer, began = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)), time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            solve_many(Spline(frequency=np.full(97, 1.5)), [0, 1], values, 97, parts=())
        self.assertLess(time.monotonic() - began, 30)

    def test_the_first_wrong_spline_is_named(self):
        times = np.array([[0, 1], [0, 0], [0, 9]])
        with self.assertRaises(wiggly.Error) as caught:
            solve_many(Spline(frequency=1), times, [0, 1], 97)
        self.assertEqual((caught.exception.spline, caught.exception.knot), (1, 1))
        many = solve_many(Spline(frequency=1), times, [0, 1], 97, check=False)
        self.assertEqual(many.status.tolist(), [0, Status.KNOT_TWICE, Status.KNOT_OUTSIDE])
        self.assertTrue(np.isnan(many.total[1:]).all() and np.isfinite(many.total[0]).all())


class Groups(unittest.TestCase):
    def test_pins_have_the_exact_answers(self):
        for name in ("one_hand", "loop", "two_points_in_one_frame"):
            path = TREE / "tests" / "vectors" / "pins" / name
            case = json.loads(path.with_suffix(".json").read_text())
            scene = Scene(path, case["scene"])
            table = np.loadtxt(path.with_suffix(".csv"), delimiter=",", skiprows=1).T
            sources = {source["name"]: source for source in case["scene"]["splines"]}
            splines = []
            for member in case["group"]:
                source = dict(sources[member])
                del source["name"]
                knots = [(k["frame"] / 24, k["value"]) for k in source.pop("knots", [])]
                splines.append(Spline(knots, **source))
            pins = [
                Pin(p["sample"] / scene.fps, {case["group"].index(s): np.array(c) @ [1, 1j] for s, c in p["pulls"].items()}, p["to"])
                for p in case["pins"]
            ]
            together = Group(splines, [case["weight"][member] for member in case["group"]]).solve(scene.n, scene.fps, pins=pins)
            for member, curve in zip(case["group"], together.curves):
                column = 1 + 3 * list(sources).index(member)
                np.testing.assert_allclose([curve.total, curve.re, curve.im], table[column : column + 3], rtol=0, atol=1e-8)
                self.assertAlmostEqual(curve(0.51), np.interp(0.51 * scene.fps, np.arange(scene.n), curve.total), 1)
            np.testing.assert_allclose(together.left, case["left"], rtol=0, atol=1e-9)

    def test_a_bound_keeps_a_point_on_its_side(self):
        spline = Spline(KNOTS, frequency=2)
        free = spline.solve(97)
        lowest = int(free.total.argmin())
        bound = Bound(lowest / 24, [1], free.total[lowest] + 0.1)
        held = Group([spline]).solve(97, bounds=[bound])
        self.assertAlmostEqual(held.curves[0].total[lowest], bound.least, 8)
        self.assertGreater(held.push[0], 0)
        self.assertLess(held.missing[0], 1e-8)

    def test_weights_that_change_later_are_checked_again(self):
        group = Group([Spline(KNOTS, frequency=1), Spline(frequency=1)], [1, 2])
        group.weights = np.ones(4)[::2]
        expected = group.solve(97).curves[0].total
        group.weights = [1, 1]
        np.testing.assert_array_equal(group.solve(97).curves[0].total, expected)
        for change in (lambda: setattr(group, "weights", np.ones(1)), lambda: group.splines.append(Spline(frequency=1))):
            change()
            with self.assertRaisesRegex(ValueError, f"weights: expected one a spline, {len(group.splines)}, got an array of shape"):
                group.solve(97)
            group.weights = np.ones(2)

    def test_errors_name_spline_and_knot(self):
        with self.assertRaises(wiggly.Error) as caught:
            Group([Spline(KNOTS, frequency=1), Spline([(0, 0), (9, 0)], frequency=1)]).solve(97)
        self.assertEqual((caught.exception.spline, caught.exception.knot), (1, 1))


if __name__ == "__main__":
    unittest.main()
