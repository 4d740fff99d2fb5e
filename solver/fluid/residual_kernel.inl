// The residual kernel of one instruction set. Included inside an anonymous namespace after SEAPILE_VECTOR_BYTES is set.

inline constexpr int kWidth = SEAPILE_VECTOR_BYTES / 8;

/// As many doubles as a vector holds, with the arithmetic that element_residual() asks of a number.
struct Lanes {
  typedef double V __attribute__((vector_size(SEAPILE_VECTOR_BYTES)));
  V v{};
  Lanes() = default;
  Lanes(double a) : v(a - V{}) {}
  Lanes(V a) : v(a) {}
  Lanes& operator+=(Lanes a) { return v += a.v, *this; }
  friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
  friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
  friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
  friend Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
  friend Lanes plain(Lanes a) { return a; }
  friend Lanes smaller(Lanes a, Lanes b) { return a.v < b.v ? a.v : b.v; }
  friend Lanes root(Lanes a) {
    for (int k = 0; k < kWidth; ++k) a.v[k] = __builtin_sqrt(a.v[k]);
    return a;
  }
};

void add_triangles(const Properties& fluid, const PackedFlow& packed, const double* unknown, double* residual) {
  for (std::int32_t first = 0; first < packed.triangles; first += kWidth) {
    ElementInput<Lanes> in;
    in.rate = packed.rate;
    in.unsteadiness = packed.unsteadiness;
    std::array<Lanes, 3> x, y;
    std::array<Lanes, kUnknowns> u;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < kWidth; ++k) {
        const std::int32_t vertex = packed.corner[3 * (first + k) + i];
        const VertexInput& from = packed.vertex[vertex];
        x[i].v[k] = from.x;
        y[i].v[k] = from.y;
        in.porosity[i].v[k] = from.porosity;
        in.porosity_rate[i].v[k] = from.porosity_rate;
        in.mesh_velocity[i][0].v[k] = from.mesh_x;
        in.mesh_velocity[i][1].v[k] = from.mesh_y;
        in.history[i][0].v[k] = from.history_x;
        in.history[i][1].v[k] = from.history_y;
        in.source[i][0].v[k] = from.source_x;
        in.source[i][1].v[k] = from.source_y;
        in.drag[i].v[k] = from.drag;
        in.carried[i][0].v[k] = from.carried_x;
        in.carried[i][1].v[k] = from.carried_y;
        in.mobility[i].v[k] = from.mobility;
        in.response[i].v[k] = from.response;
        for (int c = 0; c < 3; ++c) u[3 * i + c].v[k] = unknown[3 * vertex + c];
      }
    const std::array<Lanes, kUnknowns> part = element_residual<Lanes, Lanes>(fluid, in, x, y, u);
    const int lanes = std::min(kWidth, packed.triangles - first);
    for (int k = 0; k < lanes; ++k)
      for (int i = 0; i < 3; ++i) {
        double* to = residual + 3 * packed.corner[3 * (first + k) + i];
        for (int c = 0; c < 3; ++c) to[c] += part[3 * i + c].v[k];
      }
  }
}
