"""How far two documents of numbers are from each other."""

# Numbers below this are compared with it: a rounded zero is not a whole difference.
FLOOR = 1e-9


def furthest(one, other, path=""):
    """The largest relative difference of the numbers of two documents, and its place; 1 where something else differs.

    Seals are left out: they are hashes of the numbers. A covariance is compared with the standard errors of its two parameters, for
    those of parameters that hardly depend on each other are differences of large numbers.
    """
    if path.endswith(".covariance") and isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        stds = [max(abs(row[k]), FLOOR) ** 0.5 for k, row in enumerate(one)]
        pairs = [(i, k) for i in range(len(one)) for k in range(len(one))]
        return max((abs(one[i][k] - other[i][k]) / (stds[i] * stds[k]), f"{path}[{i}][{k}]") for i, k in pairs)
    if isinstance(one, dict) and isinstance(other, dict):
        names = [name for name in one.keys() | other.keys() if "sha256" not in name]
        missing = [name for name in names if name not in one or name not in other]
        if missing:
            return (1.0, f"{path}.{missing[0]}")
        parts = [furthest(one[name], other[name], f"{path}.{name}") for name in sorted(names)]
        return max(parts, default=(0.0, path))
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        parts = [furthest(a, b, f"{path}[{k}]") for k, (a, b) in enumerate(zip(one, other))]
        return max(parts, default=(0.0, path))
    if isinstance(one, float) and isinstance(other, float):
        return (abs(one - other) / max(abs(one), abs(other), FLOOR), path)
    return (0.0 if one == other else 1.0, path)


def in_errors(one, other):
    """The largest difference of a parameter, in stated standard errors."""
    largest = 0.0
    for sensor in ("accelerometer", "gyroscope"):
        for value, std in (("T", "T_std"), ("bias", "bias_std")):
            triples = zip(*(numbers((of.get(sensor) or {}).get(name)) for of, name in ((one, value), (other, value), (one, std))))
            largest = max([largest, *(abs(a - b) / s for a, b, s in triples if s)])
    return largest


def numbers(part):
    """The numbers of a vector or a matrix, in order."""
    return [cell for row in part or [] for cell in (row if isinstance(row, list) else [row])]
