"""Curves through knots that swing, overshoot and follow through.

A few knots in, a whole curve out: it hits every knot and moves like something with mass.

>>> import wiggly
>>> curve = wiggly.Spline([(0, 0), (1.5, 1), (3.75, -0.5)], frequency=1, damping=0.1).solve(121, fps=24)
>>> curve.total.shape
(121,)
>>> float(curve.total[36])
1.0

Times are seconds, frequencies Hz, angles radians; values are in whatever you key. A knot sits on the sample nearest to its time.
"""

from ._curve import Curve
from ._group import Bound, Group, Pin, Together
from ._library import Error, Status, WigglyWarning, version
from ._many import Many, solve_many
from ._scene import Scene
from ._spline import Explanation, Knot, Poles, Solver, Spline, explain, from_spring

__version__ = "1.0.0"
__all__ = [
    "Bound", "Curve", "Error", "Explanation", "Group", "Knot", "Many", "Pin", "Poles", "Scene", "Solver", "Spline", "Status",
    "Together", "WigglyWarning", "explain", "from_spring", "solve_many", "version",
]  # fmt: skip
