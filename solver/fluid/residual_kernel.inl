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

/// What the residual of some triangles asks for, side by side.
struct Group {
  ElementInput<Lanes> in;
  std::array<Lanes, 3> x, y;
  std::array<Lanes, kUnknowns> u;
};

void gather(Group& to, const PackedFlow& packed, const double* unknown, std::int32_t first) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < kWidth; ++k) {
      const std::int32_t vertex = packed.corner[3 * (first + k) + i];
      const VertexInput& from = packed.vertex[vertex];
      to.x[i].v[k] = from.x;
      to.y[i].v[k] = from.y;
      to.in.porosity[i].v[k] = from.porosity;
      to.in.porosity_rate[i].v[k] = from.porosity_rate;
      to.in.mesh_velocity[i][0].v[k] = from.mesh_x;
      to.in.mesh_velocity[i][1].v[k] = from.mesh_y;
      to.in.history[i][0].v[k] = from.history_x;
      to.in.history[i][1].v[k] = from.history_y;
      to.in.source[i][0].v[k] = from.source_x;
      to.in.source[i][1].v[k] = from.source_y;
      to.in.drag[i].v[k] = from.drag;
      to.in.carried[i][0].v[k] = from.carried_x;
      to.in.carried[i][1].v[k] = from.carried_y;
      to.in.mobility[i].v[k] = from.mobility;
      to.in.response[i].v[k] = from.response;
      for (int c = 0; c < 3; ++c) to.u[3 * i + c].v[k] = unknown[3 * vertex + c];
    }
}

void add_triangles(const Properties& fluid, const PackedFlow& packed, const double* unknown, double* residual) {
  // The next group is gathered before this one is worked on: numbers that were just stored one by one can't be loaded
  // together until they are all in the cache.
  Group groups[2];
  for (Group& group : groups) {
    group.in.rate = packed.rate;
    group.in.unsteadiness = packed.unsteadiness;
  }
  if (packed.triangles > 0) gather(groups[0], packed, unknown, 0);
  for (std::int32_t first = 0, now = 0; first < packed.triangles; first += kWidth, now = 1 - now) {
    if (first + kWidth < packed.triangles) gather(groups[1 - now], packed, unknown, first + kWidth);
    const Group& group = groups[now];
    const std::array<Lanes, kUnknowns> part =
        element_residual<Lanes, Lanes>(fluid, group.in, group.x, group.y, group.u);
    const int lanes = std::min(kWidth, packed.triangles - first);
    for (int k = 0; k < lanes; ++k)
      for (int i = 0; i < 3; ++i) {
        double* to = residual + 3 * packed.corner[3 * (first + k) + i];
        for (int c = 0; c < 3; ++c) to[c] += part[3 * i + c].v[k];
      }
  }
}
