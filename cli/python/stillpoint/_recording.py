"""Recordings."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _native

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

_Path = Union[str, "os.PathLike[str]"]


def contiguous(array: Any) -> "npt.NDArray[np.float64]":
    """The array as contiguous float64: itself where it is that already."""
    import numpy

    return numpy.ascontiguousarray(array, dtype=numpy.float64)


class Recording:
    """What a device recorded, each sensor on its own clock, in SI units. It was checked."""

    __slots__ = ("_native",)

    def __init__(self) -> None:
        raise TypeError("use Recording.from_arrays or Recording.from_file")

    @classmethod
    def _of(cls, native: _native.Recording) -> "Recording":
        own = object.__new__(cls)
        own._native = native
        return own

    @classmethod
    def from_arrays(
        cls,
        t: "npt.ArrayLike",
        accel: "Optional[npt.ArrayLike]" = None,
        gyro: "Optional[npt.ArrayLike]" = None,
        temperature: "Optional[npt.ArrayLike]" = None,
        *,
        mag: "Optional[npt.ArrayLike]" = None,
        name: str = "arrays",
    ) -> "Recording":
        """The recording in arrays with one row per stamp.

        It is the recording that a plain CSV with these numbers gives, bit for bit. Samples are copied once, and not
        before: contiguous arrays of float64 are read where they are.

        Args:
            t: stamps, s, shape (N,), ascending.
            accel: specific force, m/s², shape (N, 3), +g on the axis that points up.
            gyro: angular rate, rad/s, shape (N, 3), right-handed.
            temperature: °C, shape (N,).
            mag: magnetic field, µT, shape (N, 3).
            name: what warnings and results call it.

        Raises:
            InputError: other lengths, a number that is not finite, time that goes backwards, and what else no working
                sensor gives; ``line`` is the row, from 1.
            NotEnoughInformation: a single row.
        """
        made = _native.Recording.from_arrays(
            contiguous(t),
            None if accel is None else contiguous(accel),
            None if gyro is None else contiguous(gyro),
            None if temperature is None else contiguous(temperature),
            None if mag is None else contiguous(mag),
            name,
        )
        return cls._of(made)

    @classmethod
    def from_file(
        cls,
        path: _Path,
        gyro_file: Optional[_Path] = None,
        *,
        columns: Optional[str] = None,
        rate: Optional[float] = None,
        na_drop: bool = False,
        sort_time: bool = False,
        skip_bad_rows: int = 0,
        accel_unit: Optional[str] = None,
        gyro_unit: Optional[str] = None,
        mag_unit: Optional[str] = None,
    ) -> "Recording":
        """The recording in a file or a folder of any known format, recognised by its content.

        Args:
            path: the file or folder; the accelerometer's file where `gyro_file` is given.
            gyro_file: the gyroscope's file, on the same clock.
            columns: which column is what, such as ``t=time,ax=acc_x``.
            rate: sampling rate, Hz: stamps are then ignored.
            na_drop: leave out rows with missing numbers.
            sort_time: sort rows by time.
            skip_bad_rows: broken rows that may be left out.
            accel_unit: unit of the accelerometer, such as ``g``; by the file and its readings where none is given.
            gyro_unit: unit of the gyroscope, such as ``deg/s``.
            mag_unit: unit of the magnetometer: ``uT``, ``nT``, ``mT``, ``T``, ``G``, ``mG`` or ``counts``.

        Raises:
            InputError: no recording, with file, line and column.
        """
        read = _native.Recording.from_file(
            path,
            gyro_file,
            columns,
            rate,
            na_drop,
            sort_time,
            skip_bad_rows,
            accel_unit,
            gyro_unit,
            mag_unit,
        )
        return cls._of(read)

    @property
    def name(self) -> str:
        """What it is called."""
        return self._native.name

    @property
    def duration(self) -> float:
        """From the first stamp to the last, s."""
        return self._native.duration

    @property
    def warnings(self) -> list[str]:
        """What was noticed in the samples."""
        return self._native.warnings

    @property
    def accel(self) -> "tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]":
        """Stamps (s, (N,)) and specific force (m/s², (N, 3)), as copies."""
        return self._stream("accelerometer")

    @property
    def gyro(self) -> "tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]":
        """Stamps (s, (N,)) and angular rate (rad/s, (N, 3)), as copies."""
        return self._stream("gyroscope")

    @property
    def mag(self) -> "tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]":
        """Stamps (s, (N,)) and magnetic field (µT, (N, 3); as recorded where the unit is not known), as copies."""
        return self._stream("magnetometer")

    def temperature_at(self, t: float) -> Optional[float]:
        """Temperature at a time (s), °C; None without a thermometer."""
        return self._native.temperature_at(t)

    def to_csv(self) -> str:
        """As a plain CSV that reads back to the same bits."""
        return self._native.to_csv()

    def _stream(self, sensor: str) -> "tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]":
        import numpy

        rows = self._native.rows(sensor)
        t, values = numpy.empty(rows), numpy.empty((rows, 3))
        self._native.fill(sensor, t, values)
        return t, values

    def __repr__(self) -> str:
        sensors = ("accelerometer", "gyroscope", "magnetometer")
        rows = [self._native.rows(sensor) for sensor in sensors]
        field = f", {rows[2]} of the magnetometer" if rows[2] else ""
        return (
            f"<Recording {self.name!r}: {rows[0]} samples of the accelerometer, {rows[1]} of the gyroscope{field}, "
            f"{self.duration:.1f} s>"
        )
