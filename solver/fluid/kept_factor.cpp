#include "solver/fluid/kept_factor.h"

#include <umfpack.h>

#include <cmath>

#include <algorithm>
#include <vector>

#include "solver/fluid/boundary_terms.h"
#include "solver/fluid/dual.h"

// Present when OpenBLAS does UMFPACK's dense work. Its threads would change the order of sums, and the bits.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace seapile::fluid {

struct KeptFactor::Factors {
  Eigen::SparseMatrix<double> matrix;
  void* symbolic = nullptr;
  void* numeric = nullptr;
  double control[UMFPACK_CONTROL];
  mutable std::vector<int> workspace;
  mutable std::vector<double> values;

  Factors() {
    if (openblas_set_num_threads) openblas_set_num_threads(1);
    umfpack_di_defaults(control);
    control[UMFPACK_IRSTEP] = 0;
    control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
  }
  ~Factors() {
    umfpack_di_free_numeric(&numeric);
    umfpack_di_free_symbolic(&symbolic);
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  bool has_pattern_of(const Eigen::SparseMatrix<double>& other) const {
    return matrix.rows() == other.rows() && matrix.nonZeros() == other.nonZeros() &&
           std::equal(other.outerIndexPtr(), other.outerIndexPtr() + other.outerSize() + 1, matrix.outerIndexPtr()) &&
           std::equal(other.innerIndexPtr(), other.innerIndexPtr() + other.nonZeros(), matrix.innerIndexPtr());
  }
};

KeptFactor::KeptFactor() = default;
KeptFactor::~KeptFactor() = default;
KeptFactor::KeptFactor(KeptFactor&&) noexcept = default;
KeptFactor& KeptFactor::operator=(KeptFactor&&) noexcept = default;

bool KeptFactor::empty() const { return !factors_ || !factors_->numeric; }
const Eigen::SparseMatrix<double>& KeptFactor::matrix() const { return factors_->matrix; }

bool KeptFactor::factorise(Eigen::SparseMatrix<double> matrix) {
  if (!factors_) factors_ = std::make_unique<Factors>();
  Factors& f = *factors_;
  umfpack_di_free_numeric(&f.numeric);
  const bool same = f.symbolic && f.has_pattern_of(matrix);
  f.matrix = std::move(matrix);
  const int size = static_cast<int>(f.matrix.rows());
  const int *outer = f.matrix.outerIndexPtr(), *inner = f.matrix.innerIndexPtr();
  const double* values = f.matrix.valuePtr();
  if (!same) {
    umfpack_di_free_symbolic(&f.symbolic);
    if (umfpack_di_symbolic(size, size, outer, inner, values, &f.symbolic, f.control, nullptr) != UMFPACK_OK)
      return false;
    f.workspace.resize(size);
    f.values.resize(5 * static_cast<std::size_t>(size));
  }
  if (umfpack_di_numeric(outer, inner, values, f.symbolic, &f.numeric, f.control, nullptr) == UMFPACK_OK) return true;
  umfpack_di_free_numeric(&f.numeric);
  return false;
}

void KeptFactor::solve(std::span<const double> b, std::span<double> x) const {
  const Factors& f = *factors_;
  umfpack_di_wsolve(UMFPACK_A, f.matrix.outerIndexPtr(), f.matrix.innerIndexPtr(), f.matrix.valuePtr(), x.data(),
                    b.data(), f.numeric, f.control, nullptr, f.workspace.data(), f.values.data());
}

Eigen::SparseMatrix<double> jacobian(const Flow& flow, const TimeScheme& scheme) {
  const auto size = static_cast<Eigen::Index>(flow.unknown.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(flow.mesh.triangles() * kUnknowns * kUnknowns);
  const auto add = [&](int row, int column, double value) {
    if (!flow.held[row] && !flow.held[column]) entries.emplace_back(row, column, value);
  };

  using D = Dual<kUnknowns>;
  for (std::size_t t = 0; t < flow.mesh.triangles(); ++t) {
    const auto& vertex = flow.mesh.triangle[t];
    std::array<D, 3> x, y;
    std::array<D, kUnknowns> u;
    for (int i = 0; i < 3; ++i) {
      x[i] = constant<kUnknowns>(flow.mesh.position[vertex[i]].x);
      y[i] = constant<kUnknowns>(flow.mesh.position[vertex[i]].y);
      for (int c = 0; c < 3; ++c) u[3 * i + c] = variable<kUnknowns>(flow.unknown[3 * vertex[i] + c], 3 * i + c);
    }
    const auto residual = element_residual(flow.fluid, input_of(flow, scheme, t), x, y, u);
    for (int row = 0; row < kUnknowns; ++row)
      for (int column = 0; column < kUnknowns; ++column)
        add(3 * vertex[row / 3] + row % 3, 3 * vertex[column / 3] + column % 3, residual[row].derivatives()[column]);
  }

  // Pressure from outside does not depend on the unknowns; slip does.
  using E = Dual<4>;
  for (const SlipEdge& e : flow.slip) {
    const std::int32_t vertex[] = {e.from, e.to};
    std::array<EdgeEnd<E>, 2> end;
    for (int i = 0; i < 2; ++i)
      end[i] = {constant<4>(flow.mesh.position[vertex[i]].x), constant<4>(flow.mesh.position[vertex[i]].y),
                variable<4>(flow.u(vertex[i], kVelocityX), 2 * i),
                variable<4>(flow.u(vertex[i], kVelocityY), 2 * i + 1)};
    const auto force = slip_force(flow.fluid.geometry, end, porosity_at(flow, e.from, e.to), e.friction, e.wall);
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        add(3 * vertex[row / 2] + row % 2, 3 * vertex[column / 2] + column % 2,
            force[row / 2][row % 2].derivatives()[column]);
  }

  // A film that follows rises by u_y/rate, and with it weight and tension; as if it were level.
  for (const FilmEdge& e : flow.film) {
    if (!e.follows || !(scheme.rate > 0)) continue;
    const std::int32_t vertex[] = {e.from, e.to};
    const double dx = std::abs(flow.mesh.position[e.to].x - flow.mesh.position[e.from].x);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        add(3 * vertex[i] + kVelocityY, 3 * vertex[j] + kVelocityY,
            (e.weight * dx * (i == j ? 1.0 / 3 : 1.0 / 6) + e.tension / dx * (i == j ? 1 : -1)) / scheme.rate);
  }

  for (int i = 0; i < size; ++i)
    if (flow.held[i]) entries.emplace_back(i, i, 1.0);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace seapile::fluid
