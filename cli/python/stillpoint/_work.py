"""The functions."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Callable, Optional, Sequence, Union

from . import _native
from ._recording import Recording
from ._results import Calibration, Findings, Noise

if TYPE_CHECKING:
    from typing import Literal

_Path = Union[str, "os.PathLike[str]"]
_Recordings = Union[Recording, Sequence[Recording]]
_Progress = Optional[Callable[[str, int], object]]

_DEFAULTS: dict[str, Any] = {
    "method": "auto",
    "first_order": False,
    "gravity": None,
    "latitude": None,
    "altitude": None,
    "multiplier": None,
    "min_static": None,
    "min_dynamic": None,
    "window": None,
    "initial_static": None,
    "sections": [],
    "leave_out": [],
    "gyro_recordings": [],
    "frame": "triangular",
    "integrator": "exponential",
    "gyro_bias": "adjacent",
    "nominal_rate": None,
    "clock": "auto",
    "field": None,
    "effects": [],
    "effect_files": [],
    "force_device": False,
    "alpha": 0.01,
    "walks": None,
    "validation": None,
}


def _options(given: dict[str, Any]) -> dict[str, Any]:
    unknown = sorted(set(given) - set(_DEFAULTS))
    if unknown:
        raise TypeError(f"no option {unknown[0]!r}; there are {', '.join(_DEFAULTS)}")
    options = {**_DEFAULTS, **given}
    options["gyro_recordings"] = [r._native for r in _all(options["gyro_recordings"])]
    if options["validation"] is not None:
        options["validation"] = options["validation"]._native
    for name in ("effects", "effect_files", "sections", "leave_out"):
        options[name] = list(options[name])
    return options


def _all(recordings: _Recordings) -> list[Recording]:
    return [recordings] if isinstance(recordings, Recording) else list(recordings)


def calibrate(
    recordings: _Recordings,
    *,
    method: "Literal['auto', 'stepwise', 'joint', 'six-position']" = "auto",
    gravity: Optional[float] = None,
    latitude: Optional[float] = None,
    altitude: Optional[float] = None,
    effects: Sequence[str] = (),
    effect_files: Sequence[_Path] = (),
    progress: _Progress = None,
    **more: Any,
) -> Calibration:
    """Calibrates both sensors from recordings of one device.

    Args:
        recordings: one or several; they share scale factors and misalignments.
        method: ``auto`` (joint; stepwise where a recording has no accelerometer), ``stepwise`` as published
            (Liu et al. 2021), ``joint``, ``six-position``.
        gravity: local gravity, m/s²; that of the place where it is None, else 9.80665 with errors that cover the earth.
        latitude: ° north.
        altitude: m above sea level.
        effects: names of effects to fit on top of the base models, see :func:`effects`.
        effect_files: TOML files that define effects as expressions.
        progress: called as ``progress(stage, steps)`` at every step; what it raises ends the work.
        more: first_order, multiplier, min_static (s), min_dynamic (s), window (s), initial_static (s), sections (lists of
            (begin, end), s), leave_out (static intervals to leave out, each as (recording from 1, an instant within it, s)),
            gyro_recordings, frame, integrator, gyro_bias, nominal_rate (Hz), clock, field (µT), force_device: as the
            command's options of these names.

    Raises:
        NotEnoughInformation: too few orientations, a parameter that the data do not determine.
        NotConverged, InputError, UsageError
    """
    options = _options(
        dict(
            more,
            method=method,
            gravity=gravity,
            latitude=latitude,
            altitude=altitude,
            effects=effects,
            effect_files=effect_files,
        )
    )
    natives = [r._native for r in _all(recordings)]
    return Calibration._of(_native.calibrate(natives, options, progress))


def discover(
    recordings: _Recordings,
    *,
    alpha: float = 0.01,
    validation: Optional[Recording] = None,
    gravity: Optional[float] = None,
    latitude: Optional[float] = None,
    altitude: Optional[float] = None,
    effect_files: Sequence[_Path] = (),
    progress: _Progress = None,
    **more: Any,
) -> Findings:
    """Finds what the base models lack, names it, and measures the gap before and after.

    Args:
        recordings: one or several of one device.
        alpha: chance of any false claim about a device that lacks nothing.
        validation: another recording of the device, to show the gap on.
        gravity, latitude, altitude, effect_files, progress: as for :func:`calibrate`.
        more: walks (random walk densities of the biases, m/s²/√s and rad/s/√s), leave_out, clock, force_device and the detector's.
    """
    options = _options(
        dict(
            more,
            alpha=alpha,
            validation=validation,
            gravity=gravity,
            latitude=latitude,
            altitude=altitude,
            effect_files=effect_files,
        )
    )
    natives = [r._native for r in _all(recordings)]
    return Findings._of(_native.discover(natives, options, progress))


def apply(calibration: Calibration, recording: Recording) -> Recording:
    """The corrected recording: base model plus effects, each sensor on its own clock."""
    return Recording._of(calibration._native.apply(recording._native))


def evaluate(
    recording: Recording,
    calibration: Optional[Calibration] = None,
    *,
    gravity: Optional[float] = None,
    latitude: Optional[float] = None,
    altitude: Optional[float] = None,
    **more: Any,
) -> dict[str, Any]:
    """What a calibration, or the raw readings with None, leave of a recording.

    Returns:
        modulus_rms (norm of specific force less gravity over static intervals, m/s²), direction_rms (gravity's direction
        after each turn, °), static_rate (rad/s) and the numbers of static intervals and turns.
    """
    options = _options(dict(more, gravity=gravity, latitude=latitude, altitude=altitude))
    native = None if calibration is None else calibration._native
    return json.loads(_native.evaluate(recording._native, native, options))


def allan(recording: Recording, rest: Optional[tuple[float, float]] = None) -> Noise:
    """Overlapping Allan deviation and noise terms of a recording at rest, or of the stretch ``rest`` (s) of it.

    Raises:
        NotEnoughInformation: the device moved and was never at rest for a minute.
    """
    return Noise(json.loads(_native.allan(recording._native, rest)))


def simulate(
    spec: Union[str, "os.PathLike[str]"], *, progress: _Progress = None
) -> tuple[Recording, dict[str, Any]]:
    """A recording with known truth, and that truth as truth.json has it.

    Args:
        spec: a specification as TOML text, or the path of its file (a ``pathlib.Path``); the command
            ``stillpoint simulate --example`` prints every key.
    """
    if isinstance(spec, os.PathLike):
        with open(spec, encoding="utf-8") as text:
            spec = text.read()
    recording, truth = _native.simulate(spec, progress)
    return Recording._of(recording), json.loads(truth)


def effects(effect_files: Sequence[_Path] = ()) -> list[str]:
    """The names of all effects, those of ``effect_files`` last."""
    return _native.effect_names(list(effect_files))
