"""g2o's own errors and costs: `pip install g2o-python "numpy<2"`.

    python3 benches/peers/g2o_convention.py                 errors of two edges: the numbers in solver/src/pose_graph/edge.rs
    python3 benches/peers/g2o_convention.py FILE.g2o …      ½ Σ eᵀΩe of the files' poses by g2o's EdgeSE2 and EdgeSE3

The second is what `graph-table cost FILE quaternion` prints: they agree to all digits on seven sets (cubicle's
indefinite matrices, which g2o takes, are refused there; manhattan has no poses).
"""

import sys

import g2o
import numpy as np


def full(n, upper):
    m = np.zeros((n, n))
    m[np.triu_indices(n)] = upper
    return m + np.triu(m, 1).T


def pose(v):
    """(x, y, angle) or (t, x, y, z, w)."""
    if len(v) == 3:
        return g2o.SE2(*v)
    q = g2o.Quaternion(v[6], v[3], v[4], v[5])
    q.normalize()
    return g2o.Isometry3d(q, np.array(v[:3]))


def vertex(v):
    p = g2o.VertexSE2() if len(v) == 3 else g2o.VertexSE3()
    p.set_estimate(pose(v))
    return p


def edge(a, b, measured, information):
    e = g2o.EdgeSE2() if len(measured) == 3 else g2o.EdgeSE3()
    e.set_vertex(0, a)
    e.set_vertex(1, b)
    e.set_measurement(pose(measured))
    e.set_information(information)
    e.compute_error()
    return e


if not sys.argv[1:]:
    np.set_printoptions(precision=17)
    a, b = vertex([0.3, -1.0, 0.4]), vertex([1.1, 0.4, 1.7])
    print(list(map(float, edge(a, b, [0.9, 0.7, 1.5], np.eye(3)).error())))
    a, b = vertex([0.3, -1.0, 2.0, 0.5, -0.5, 0.5, 0.5]), vertex([1.1, 0.4, 2.2, 0.1, -0.7, 0.1, 0.7])
    print(list(map(float, edge(a, b, [0.4, 0.1, 1.3, 0.2, -0.1, 0.6, 0.8], np.eye(6)).error())))

for file in sys.argv[1:]:
    poses, cost, edges = {}, 0.0, []
    for line in open(file):
        kind, *words = line.split()
        v = [float(w) for w in words]
        if kind.startswith("VERTEX"):
            poses[int(v[0])] = vertex(v[1:])
        elif kind.startswith("EDGE"):
            n, k = (3, 5) if kind == "EDGE_SE2" else (6, 9)
            e = edge(poses[int(v[0])], poses[int(v[1])], v[2:k], full(n, v[k:]))
            cost += 0.5 * e.chi2()
            edges.append(e)
    print(file, repr(cost), flush=True)
