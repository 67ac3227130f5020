"""Calibrations, findings, noise."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Sequence, Union

from . import _html, _native
from ._errors import UsageError
from ._recording import Recording, contiguous

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
    import pandas

_Path = Union[str, "os.PathLike[str]"]


class Parameter(NamedTuple):
    """A parameter with its standard error; ``std`` is None where it was held fixed."""

    name: str
    value: float
    std: Optional[float]
    unit: str


def frame(rows: Sequence[Any], columns: Sequence[str]) -> "pandas.DataFrame":
    """A table of pandas, which must be installed."""
    try:
        import pandas
    except ImportError as missing:
        raise ImportError("to_frame needs pandas: pip install pandas") from missing
    return pandas.DataFrame(list(rows), columns=list(columns))


class Calibration:
    """A calibration of one device: ``a = T (A - b)`` for each sensor, and effects on top."""

    __slots__ = ("_native",)

    def __init__(self) -> None:
        raise TypeError("use stillpoint.calibrate or Calibration.load")

    @classmethod
    def _of(cls, native: _native.Calibration) -> "Calibration":
        own = object.__new__(cls)
        own._native = native
        return own

    @classmethod
    def load(cls, path: _Path, *, effect_files: Sequence[_Path] = ()) -> "Calibration":
        """Reads a cal.json."""
        return cls._of(_native.Calibration.load(path, list(effect_files)))

    @classmethod
    def from_json(cls, text: str, *, effect_files: Sequence[_Path] = ()) -> "Calibration":
        """Reads the text of a cal.json."""
        return cls._of(_native.Calibration.from_json(text, list(effect_files)))

    @classmethod
    def from_dict(cls, document: dict[str, Any]) -> "Calibration":
        """Reads what :meth:`to_dict` gave."""
        return cls.from_json(json.dumps(document))

    def to_json(self) -> str:
        """The bytes that ``stillpoint calibrate -o`` writes."""
        return self._native.to_json()

    def to_dict(self) -> dict[str, Any]:
        """cal.json as a dictionary."""
        return json.loads(self.to_json())

    def save(self, path: _Path) -> None:
        """Writes cal.json, whole or not at all."""
        partial = f"{os.fspath(path)}.partial"
        with open(partial, "w", encoding="utf-8", newline="\n") as out:
            out.write(self.to_json())
        os.replace(partial, path)

    @property
    def parameters(self) -> list[Parameter]:
        """Every parameter: both base models, then effects."""
        return [Parameter(*p) for p in self._native.parameters()]

    def __getitem__(self, name: str) -> Parameter:
        """The parameter of that name, such as ``accel.s_x``."""
        for p in self.parameters:
            if p.name == name:
                return p
        raise KeyError(name)

    def to_frame(self) -> "pandas.DataFrame":
        """The parameters as a table of pandas: name, value, std, unit."""
        return frame(self.parameters, Parameter._fields)

    @property
    def verdict(self) -> dict[str, Any]:
        """The verdict: ``level`` (good, care or bad), ``reasons`` in order, ``reason`` in words, ``next`` steps."""
        return self.to_dict()["verdict"]

    @property
    def findings(self) -> list[dict[str, Any]]:
        """Everything that was found: ``kind``, ``level``, place, ``numbers``, ``consequence``, ``remedy``, ``text``."""
        return self.to_dict()["findings"]

    @property
    def warnings(self) -> list[str]:
        """What one should know."""
        return self._native.warnings

    @property
    def failed_gates(self) -> list[str]:
        """Reasons not to use it as it stands."""
        return self._native.failed_gates

    def matrix(self, sensor: str) -> "npt.NDArray[np.float64]":
        """``T`` of ``accelerometer``, ``gyroscope`` or ``magnetometer``, (3, 3), no unit."""
        return self._array(sensor, "T")

    def bias(self, sensor: str) -> "npt.NDArray[np.float64]":
        """``b`` of ``accelerometer`` (m/s²), ``gyroscope`` (rad/s) or ``magnetometer``, (3,)."""
        return self._array(sensor, "bias")

    def _array(self, sensor: str, key: str) -> "npt.NDArray[np.float64]":
        import numpy

        own = self.to_dict().get(sensor)
        if not own or key not in own:
            raise KeyError(f"sensor: {sensor} is not calibrated")
        return numpy.array(own[key])

    def corrector(self) -> "Corrector":
        """Corrects samples one by one, as they come from a device, effects included.

        Raises:
            NotEnoughInformation: an effect looks at more than one sample.
        """
        return Corrector._of(self._native.corrector())

    def apply(
        self,
        recording: Optional[Recording] = None,
        *,
        accel: "Optional[npt.ArrayLike]" = None,
        gyro: "Optional[npt.ArrayLike]" = None,
        mag: "Optional[npt.ArrayLike]" = None,
        out: "Optional[npt.NDArray[np.float64]]" = None,
    ) -> "Union[Recording, npt.NDArray[np.float64]]":
        """The corrected recording, or corrected readings of one sensor.

        Args:
            recording: base model and effects are applied, each sensor on its own clock.
            accel: readings, m/s², (N, 3), read where they are; for calibrations without effects.
            gyro: readings, rad/s, (N, 3), the same.
            mag: readings, µT, (N, 3), the same.
            out: where to write corrected readings, (N, 3), contiguous float64, not the readings themselves; a new array
                where it is None.

        Raises:
            UsageError: not exactly one of the four; readings alone where there are effects, which look at more.
        """
        import numpy

        arrays = {"accelerometer": accel, "gyroscope": gyro, "magnetometer": mag}
        given = [sensor for sensor, array in arrays.items() if array is not None]
        if len(given) + (recording is not None) != 1:
            raise UsageError("apply: one of recording, accel, gyro and mag expected", "usage")
        if recording is not None:
            return Recording._of(self._native.apply(recording._native))
        sensor = given[0]
        raw = contiguous(arrays[sensor])
        corrected = numpy.empty_like(raw) if out is None else out
        self._native.correct(sensor, raw, corrected)
        return corrected

    def __repr__(self) -> str:
        return "<Calibration>\n" + _html.text_table(self.parameters)

    def _repr_html_(self) -> str:
        notes = self.failed_gates + self.warnings
        return _html.page("Calibration", self.parameters, notes, self._native.figures())


class Corrector:
    """Corrects samples one by one; see :meth:`Calibration.corrector`."""

    __slots__ = ("_native",)

    def __init__(self) -> None:
        raise TypeError("use Calibration.corrector")

    @classmethod
    def _of(cls, native: _native.Corrector) -> "Corrector":
        own = object.__new__(cls)
        own._native = native
        return own

    def correct(
        self,
        t: float,
        accel: Sequence[float],
        gyro: Sequence[float],
        temperature: Optional[float] = None,
    ) -> tuple[list[float], list[float]]:
        """Specific force (m/s²) and angular rate (rad/s) behind the raw readings at ``t`` (s).

        A temperature (°C) holds until the next one is given.
        """
        return self._native.correct(t, list(accel), list(gyro), temperature)


class Findings:
    """What the base models lack."""

    __slots__ = ("_native",)

    def __init__(self) -> None:
        raise TypeError("use stillpoint.discover")

    @classmethod
    def _of(cls, native: _native.Findings) -> "Findings":
        own = object.__new__(cls)
        own._native = native
        return own

    @property
    def verdict(self) -> str:
        """``none``, ``named``, ``unexplained`` or ``named+unexplained``."""
        return self._native.verdict

    @property
    def effects(self) -> list[dict[str, Any]]:
        """The effects that were missing, most evident first, as findings.json has them."""
        return self.to_dict()["effects"]

    @property
    def calibration(self) -> Calibration:
        """The calibration with what was named."""
        return Calibration._of(self._native.calibration)

    @property
    def warnings(self) -> list[str]:
        """What one should know."""
        return self._native.warnings

    def to_json(self) -> str:
        """The bytes that ``stillpoint discover -o`` writes."""
        return self._native.to_json()

    def to_dict(self) -> dict[str, Any]:
        """findings.json as a dictionary."""
        return json.loads(self.to_json())

    def to_frame(self) -> "pandas.DataFrame":
        """The effects as a table of pandas."""
        columns = ("name", "statistic", "dof", "adjusted_p_value", "gap_before", "gap_after")
        return frame([[e[c] for c in columns] for e in self.effects], columns)

    def __repr__(self) -> str:
        names = ", ".join(e["name"] for e in self.effects) or "nothing"
        return f"<Findings: {self.verdict}; missing: {names}>"

    def _repr_html_(self) -> str:
        parameters = self.calibration.parameters
        return _html.page(f"Findings: {self.verdict}", parameters, self.warnings, self._native.figures())


class Noise:
    """Allan deviations and noise terms of a recording at rest."""

    __slots__ = ("_document",)

    def __init__(self, document: dict[str, Any]) -> None:
        self._document = document

    def to_dict(self) -> dict[str, Any]:
        """The file of ``stillpoint allan -o`` as a dictionary; SI units."""
        return self._document

    @property
    def warnings(self) -> list[str]:
        """What one should know."""
        return self._document.get("warnings", [])

    def _curve(self) -> "list[tuple[str, str, float, float]]":
        axes = [
            (sensor, axis, noise)
            for sensor in ("gyroscope", "accelerometer")
            if self._document.get(sensor)
            for axis, noise in zip("xyz", self._document[sensor]["axes"])
        ]
        return [
            (sensor, axis, point["tau"], point["deviation"])
            for sensor, axis, noise in axes
            for point in noise["curve"]
        ]

    def to_frame(self) -> "pandas.DataFrame":
        """The curves as a table of pandas: sensor, axis, tau (s), deviation (rad/s, m/s²)."""
        return frame(self._curve(), ("sensor", "axis", "tau", "deviation"))

    def _terms(self) -> list[Parameter]:
        return [
            Parameter(f"{sensor}.{axis}.{term['term']}", term["value"], None, term["unit"])
            for sensor in ("gyroscope", "accelerometer")
            if self._document.get(sensor)
            for axis, noise in zip("xyz", self._document[sensor]["axes"])
            for term in noise["terms"]
        ]

    def __repr__(self) -> str:
        return "<Noise>\n" + _html.text_table(self._terms())

    def _repr_html_(self) -> str:
        return _html.page("Noise", self._terms(), self.warnings, [])
