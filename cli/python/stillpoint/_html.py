"""Tables for people, in text and in notebooks."""

from __future__ import annotations

import html
import math
from typing import Any, Sequence


def _figures(value: float, std: Any) -> tuple[str, str]:
    """Value and standard error with the decimals that the error warrants."""
    if std is None:
        return f"{value:.6g}", "fixed"
    if not (std > 0 and math.isfinite(std)):
        return f"{value:.6g}", f"{std}"
    decimals = min(max(1 - math.floor(math.log10(std)), 0), 12)
    return f"{value:.{decimals}f}", f"{std:.{decimals}f}"


def text_table(parameters: Sequence[Any]) -> str:
    """Name, value, standard error and unit in columns."""
    rows = [(p.name, *_figures(p.value, p.std), p.unit) for p in parameters]
    widths = [max((len(row[k]) for row in rows), default=0) for k in range(3)]
    lines = (
        f"  {row[0]:<{widths[0]}}  {row[1]:>{widths[1]}} ± {row[2]:<{widths[2]}}  {row[3]}".rstrip() for row in rows
    )
    return "\n".join(lines)


def page(title: str, parameters: Sequence[Any], notes: Sequence[str], figures: Sequence[tuple[str, str]]) -> str:
    """A compact table with the report's figures behind it."""
    rows = []
    for p in parameters:
        value, std = _figures(p.value, p.std)
        cells = "".join(f'<td style="text-align:right">{html.escape(c)}</td>' for c in (value, std))
        rows.append(f"<tr><td>{html.escape(p.name)}</td>{cells}<td>{html.escape(p.unit)}</td></tr>")
    said = "".join(f"<li>{html.escape(note)}</li>" for note in notes)
    said = f"<details><summary>{len(notes)} notes</summary><ul>{said}</ul></details>" if notes else ""
    drawn = "".join(f'<div style="max-width:640px">{svg[svg.find("<svg"):]}</div>' for _, svg in figures)
    head = "<tr><th>parameter</th><th>value</th><th>std error</th><th>unit</th></tr>"
    return (
        f"<div><b>{html.escape(title)}</b>{said}<table>{head}{''.join(rows)}</table>"
        f"<details><summary>{len(figures)} figures</summary>{drawn}</details></div>"
        if figures
        else f"<div><b>{html.escape(title)}</b>{said}<table>{head}{''.join(rows)}</table></div>"
    )
