"""Folders of simulated devices for the studies of a batch."""

import os
import subprocess

KINDS = 40


def linked_devices(program, folder, spec, count, **session):
    """A folder per device: forty sessions of `spec` are simulated, and the other devices are links to them."""
    folder.mkdir()
    for k in range(count):
        device, first = folder / f"d{k:07}", folder / f"d{k % KINDS:07}"
        if k < KINDS:
            written = folder.parent / "spec.toml"
            written.write_text(spec.format(seed=k, **session))
            subprocess.run([program, "simulate", written, "-o", device], check=True, capture_output=True)
            (device / "truth.json").unlink()
        else:
            device.mkdir()
            for member in first.iterdir():
                os.link(member, device / member.name)
