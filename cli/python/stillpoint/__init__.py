"""Calibrates an accelerometer and a gyroscope from a recording made by hand.

Units are SI: stamps in s, specific force in m/s² (+g on the axis that points up), angular rate in rad/s (right-handed),
temperature in °C. A sensor's base model is ``a = T (A - b)``. Results equal those of the command ``stillpoint`` to the
last bit.

>>> import stillpoint
>>> recording, truth = stillpoint.simulate("seed = 7")
>>> calibration = stillpoint.calibrate(recording)
>>> calibration["accel.s_x"].std < 1e-3
True

Long work lets other threads run and ends on Ctrl-C. What is wrong is a :class:`StillpointError` with its kind, place and
what to do.
"""

from ._errors import (
    Cancelled,
    InputError,
    NotConverged,
    NotEnoughInformation,
    OutputError,
    StillpointError,
    UsageError,
)
from ._native import version as _version
from ._recording import Recording
from ._results import Calibration, Corrector, Findings, Noise, Parameter
from ._tools import batch, export, plan, report
from ._work import allan, apply, calibrate, discover, effects, evaluate, simulate

__version__ = _version()

__all__ = [
    "Calibration",
    "Cancelled",
    "Corrector",
    "Findings",
    "InputError",
    "Noise",
    "NotConverged",
    "NotEnoughInformation",
    "OutputError",
    "Parameter",
    "Recording",
    "StillpointError",
    "UsageError",
    "allan",
    "apply",
    "batch",
    "calibrate",
    "discover",
    "effects",
    "evaluate",
    "export",
    "plan",
    "report",
    "simulate",
]
