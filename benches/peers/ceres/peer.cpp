// Bundle adjustment (BAL) and pose graphs (g2o) by Ceres, one thread, for comparison.
//
//   peer bal FILE auto|analytic fixed|free dense|sparse  |  peer g2o FILE
//
// Prints one line: cost at the start and the end (of 1/2 |r|^2), steps, seconds from the problem in
// memory to the solution (setting up included), largest memory in MB.
#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using ceres::CostFunction;

struct Reprojection {
  double u, v;
  template <typename T>
  bool operator()(const T* c, const T* x, T* r) const {
    T p[3];
    ceres::AngleAxisRotatePoint(c, x, p);
    p[0] += c[3];
    p[1] += c[4];
    p[2] += c[5];
    T a = -p[0] / p[2], b = -p[1] / p[2];
    T n = a * a + b * b;
    T s = c[6] * (T(1) + n * (c[7] + c[8] * n));
    r[0] = s * a - T(u);
    r[1] = s * b - T(v);
    return true;
  }
};

// The same Jacobian by hand as the factor `AnalyticReprojection` of the benches.
class Analytic : public ceres::SizedCostFunction<2, 9, 3> {
 public:
  Analytic(double u, double v) : u_(u), v_(v) {}
  bool Evaluate(double const* const* q, double* out, double** jac) const override {
    const double *c = q[0], *x = q[1];
    double s2 = c[0] * c[0] + c[1] * c[1] + c[2] * c[2], A, B, C;
    if (s2 < 1e-10) {
      A = 1 - s2 / 6;
      B = 0.5 - s2 / 24;
      C = 1.0 / 6;
    } else {
      double t = std::sqrt(s2), s = std::sin(t), k = std::cos(t);
      A = s / t;
      B = (1 - k) / s2;
      C = (t - s) / (s2 * t);
    }
    double hat[3][3] = {{0, -c[2], c[1]}, {c[2], 0, -c[0]}, {-c[1], c[0], 0}}, R[3][3], J[3][3];
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) {
        double one = i == k, sq = c[i] * c[k] - one * s2;
        R[i][k] = one + A * hat[i][k] + B * sq;
        J[i][k] = one - B * hat[i][k] + C * sq;
      }
    double p[3];
    for (int i = 0; i < 3; i++) p[i] = R[i][0] * x[0] + R[i][1] * x[1] + R[i][2] * x[2] + c[3 + i];
    double inv = -1 / p[2], u = p[0] * inv, v = p[1] * inv, n = u * u + v * v;
    double f = c[6], k1 = c[7], k2 = c[8], d = 1 + n * (k1 + k2 * n), bend = 2 * (k1 + 2 * k2 * n);
    out[0] = f * d * u - u_;
    out[1] = f * d * v - v_;
    if (!jac) return true;
    double uu = f * (d + bend * u * u), uv = f * bend * u * v, vv = f * (d + bend * v * v);
    double by[2][3] = {{uu * inv, uv * inv, (uu * u + uv * v) * inv},
                       {uv * inv, vv * inv, (uv * u + vv * v) * inv}};
    double own[2] = {u, v};
    for (int r = 0; r < 2; r++) {
      double b[3];
      for (int k = 0; k < 3; k++) b[k] = by[r][0] * R[0][k] + by[r][1] * R[1][k] + by[r][2] * R[2][k];
      if (jac[1]) std::memcpy(jac[1] + 3 * r, b, sizeof b);
      if (jac[0]) {
        double a[3] = {b[2] * x[1] - b[1] * x[2], b[0] * x[2] - b[2] * x[0], b[1] * x[0] - b[0] * x[1]};
        double* row = jac[0] + 9 * r;
        for (int k = 0; k < 3; k++) row[k] = a[0] * J[0][k] + a[1] * J[1][k] + a[2] * J[2][k];
        std::memcpy(row + 3, by[r], sizeof by[r]);
        row[6] = d * own[r];
        row[7] = f * n * own[r];
        row[8] = f * n * n * own[r];
      }
    }
    return true;
  }

 private:
  double u_, v_;
};

struct Edge2 {
  double m[3];
  double root[9];
  template <typename T>
  bool operator()(const T* a, const T* b, T* r) const {
    using std::cos;
    using std::sin;
    T s = sin(a[2]), c = cos(a[2]), x = b[0] - a[0], y = b[1] - a[1];
    T turn = b[2] - a[2] - T(m[2]);
    turn -= T(2 * M_PI * std::round(Value(turn) / (2 * M_PI)));
    // The translation that is left, in the frame that the measured motion leads to, as g2o has it.
    T dx = c * x + s * y - T(m[0]), dy = c * y - s * x - T(m[1]);
    double sm = std::sin(m[2]), cm = std::cos(m[2]);
    T e[3] = {T(cm) * dx + T(sm) * dy, T(cm) * dy - T(sm) * dx, turn};
    for (int i = 0; i < 3; i++) {
      r[i] = T(0);
      for (int k = i; k < 3; k++) r[i] += T(root[3 * i + k]) * e[k];
    }
    return true;
  }
  static double Value(double v) { return v; }
  template <int N>
  static double Value(const ceres::Jet<double, N>& v) {
    return v.a;
  }
};

// Poses as t[3] and q[4] = (w, x, y, z).
struct Edge3 {
  double m[7];
  double root[36];
  template <typename T>
  bool operator()(const T* ta, const T* qa, const T* tb, const T* qb, T* r) const {
    T inverse[4] = {qa[0], -qa[1], -qa[2], -qa[3]};
    T between[3] = {tb[0] - ta[0], tb[1] - ta[1], tb[2] - ta[2]}, moved[3], turned[4], turn[4];
    ceres::UnitQuaternionRotatePoint(inverse, between, moved);
    ceres::QuaternionProduct(inverse, qb, turned);
    T back[4] = {T(m[3]), T(-m[4]), T(-m[5]), T(-m[6])};
    ceres::QuaternionProduct(back, turned, turn);
    T e[6], missed[3];
    for (int k = 0; k < 3; k++) missed[k] = moved[k] - T(m[k]);
    ceres::UnitQuaternionRotatePoint(back, missed, e);
    ceres::QuaternionToAngleAxis(turn, e + 3);
    for (int i = 0; i < 6; i++) {
      r[i] = T(0);
      for (int k = i; k < 6; k++)
        if (root[6 * i + k] != 0) r[i] += T(root[6 * i + k]) * e[k];
    }
    return true;
  }
};

template <int N>
void Root(const std::vector<double>& v, size_t at, double* u) {
  for (int i = 0; i < N * N; i++) u[i] = 0;
  for (int i = 0; i < N; i++)
    for (int k = i; k < N; k++) u[N * i + k] = v[at++];
  for (int i = 0; i < N; i++) {
    for (int k = i; k < N; k++)
      for (int j = 0; j < i; j++) u[N * i + k] -= u[N * j + i] * u[N * j + k];
    double p = std::sqrt(u[N * i + i]);
    for (int k = i; k < N; k++) u[N * i + k] /= p;
  }
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  std::ifstream file(argv[2]);
  ceres::Solver::Options options;
  options.num_threads = 1;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-10;
  options.gradient_tolerance = 1e-300;
  options.parameter_tolerance = 1e-300;
  options.logging_type = ceres::SILENT;
  // The first damping is its inverse; 1e4 unless said.
  if (const char* radius = std::getenv("CERES_RADIUS")) options.initial_trust_region_radius = std::atof(radius);
  std::vector<double> x;
  std::clock_t begin = 0;
  ceres::Solver::Summary summary;
  if (!std::strcmp(argv[1], "bal")) {
    bool analytic = !std::strcmp(argv[3], "analytic"), fixed = !std::strcmp(argv[4], "fixed");
    size_t cameras, points, seen;
    file >> cameras >> points >> seen;
    std::vector<std::array<double, 4>> obs(seen);
    for (auto& o : obs) file >> o[0] >> o[1] >> o[2] >> o[3];
    x.resize(9 * cameras + 3 * points);
    for (auto& v : x) file >> v;
    begin = std::clock();
    ceres::Problem problem;
    auto order = std::make_shared<ceres::ParameterBlockOrdering>();
    for (auto& o : obs) {
      double *c = &x[9 * (size_t)o[0]], *p = &x[9 * cameras + 3 * (size_t)o[1]];
      CostFunction* f = analytic ? (CostFunction*)new Analytic(o[2], o[3])
                                 : new ceres::AutoDiffCostFunction<Reprojection, 2, 9, 3>(
                                       new Reprojection{o[2], o[3]});
      problem.AddResidualBlock(f, nullptr, c, p);
    }
    for (size_t k = 0; k < points; k++) order->AddElementToGroup(&x[9 * cameras + 3 * k], 0);
    for (size_t k = 0; k < cameras; k++) order->AddElementToGroup(&x[9 * k], 1);
    if (fixed) {
      problem.SetManifold(&x[0], new ceres::SubsetManifold(9, {0, 1, 2, 3, 4, 5}));
      problem.SetManifold(&x[9], new ceres::SubsetManifold(9, {3}));
    }
    options.linear_solver_ordering = order;
    options.linear_solver_type =
        argc > 5 && !std::strcmp(argv[5], "sparse") ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
    ceres::Solve(options, &problem, &summary);
  } else {
    std::vector<std::array<double, 7>> poses;
    std::vector<std::array<double, 3>> planar;
    struct E {
      size_t a, b;
      std::vector<double> v;
    };
    std::vector<E> edges;
    std::map<long, size_t> place;
    std::string line;
    bool space = false;
    while (std::getline(file, line)) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      std::vector<double> v;
      for (double d; words >> d;) v.push_back(d);
      if (kind == "VERTEX_SE2") {
        place[(long)v[0]] = planar.size();
        planar.push_back({v[1], v[2], v[3]});
      } else if (kind == "VERTEX_SE3:QUAT") {
        space = true;
        place[(long)v[0]] = poses.size();
        poses.push_back({v[1], v[2], v[3], v[7], v[4], v[5], v[6]});
      } else if (kind.substr(0, 4) == "EDGE") {
        edges.push_back({place[(long)v[0]], place[(long)v[1]], v});
      }
    }
    begin = std::clock();
    ceres::Problem problem;
    for (auto& e : edges) {
      if (space) {
        auto* f = new Edge3;
        double m[7] = {e.v[2], e.v[3], e.v[4], e.v[8], e.v[5], e.v[6], e.v[7]};
        std::memcpy(f->m, m, sizeof m);
        Root<6>(e.v, 9, f->root);
        double *a = poses[e.a].data(), *b = poses[e.b].data();
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Edge3, 6, 3, 4, 3, 4>(f), nullptr, a,
                                 a + 3, b, b + 3);
      } else {
        auto* f = new Edge2;
        std::memcpy(f->m, &e.v[2], sizeof f->m);
        Root<3>(e.v, 5, f->root);
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Edge2, 3, 3, 3>(f), nullptr,
                                 planar[e.a].data(), planar[e.b].data());
      }
    }
    if (space) {
      for (auto& p : poses) problem.SetManifold(p.data() + 3, new ceres::QuaternionManifold);
      problem.SetParameterBlockConstant(poses[0].data());
      problem.SetParameterBlockConstant(poses[0].data() + 3);
    } else {
      problem.SetParameterBlockConstant(planar[0].data());
    }
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    ceres::Solve(options, &problem, &summary);
  }
  double seconds =
      double(std::clock() - begin) / CLOCKS_PER_SEC;
  rusage use;
  getrusage(RUSAGE_SELF, &use);
  std::printf("ceres %.12e %.12e %d %.6f %.1f\n", summary.initial_cost, summary.final_cost,
              (int)summary.iterations.size() - 1, seconds, use.ru_maxrss / 1024.0);
}
