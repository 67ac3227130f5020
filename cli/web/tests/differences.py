"""How far two documents of numbers are from each other."""

# Numbers below this are compared with it: a rounded zero is not a whole difference.
FLOOR = 1e-9


def furthest(one, other, path=""):
    """The largest relative difference of the numbers of two documents, and its place; 1 where something else differs.

    Seals are left out: they are hashes of the numbers.
    """
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
