"""One pose graph of g2o by GTSAM (`pip install gtsam`), from the poses of the file, the first held; see `standard_graphs.py`.

    python3 benches/peers/gtsam_graph.py FILE lm|lm-small|gauss-newton|dogleg

Prints one line: cost at the start and the end by GTSAM, steps, seconds of the processor from the problem in memory to the
solution (optimiser and ordering included).
"""

import sys
import time

import gtsam
import numpy as np

file, method = sys.argv[1:3]
with open(file) as lines:
    space = any(line.startswith(("VERTEX_SE3", "EDGE_SE3")) for line in lines)
graph, start = gtsam.readG2o(file, space)
first = min(start.keys())
held = gtsam.noiseModel.Diagonal.Variances(np.full(6 if space else 3, 1e-12))
if space:
    graph.add(gtsam.PriorFactorPose3(first, start.atPose3(first), held))
else:
    graph.add(gtsam.PriorFactorPose2(first, start.atPose2(first), held))

params = {"lm": gtsam.LevenbergMarquardtParams, "lm-small": gtsam.LevenbergMarquardtParams,
          "gauss-newton": gtsam.GaussNewtonParams, "dogleg": gtsam.DoglegParams}[method]()
params.setRelativeErrorTol(1e-10)
params.setAbsoluteErrorTol(1e-10)
params.setMaxIterations(100)
if method == "lm-small":
    params.setlambdaInitial(1e-8)
kind = {"lm": gtsam.LevenbergMarquardtOptimizer, "lm-small": gtsam.LevenbergMarquardtOptimizer,
        "gauss-newton": gtsam.GaussNewtonOptimizer, "dogleg": gtsam.DoglegOptimizer}[method]
begin = time.process_time()
optimiser = kind(graph, start, params)
found = optimiser.optimize()
seconds = time.process_time() - begin
print(f"gtsam {graph.error(start):.12e} {graph.error(found):.12e} {optimiser.iterations()} {seconds:.6f}")
