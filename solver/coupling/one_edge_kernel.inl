// The kernel of one_edge_kernels.h for one instruction set. Included inside an anonymous namespace.

// Loops that look things up for one disc after the other take turns with loops of arithmetic alone, which become
// vector instructions.
void by_one_edge(const Edge* edges, std::span<const grains::Disc> discs, const std::int32_t* last, OneEdge& result) {
  constexpr int kMost = OneEdge::kDiscs;
  using Each = double[kMost];
  Each x[3], y[3], per_length[3], per_height[3], radius;  // corners relative to the centre
  for (int n = 0; n < kMost; ++n) {
    const std::size_t i = std::min<std::size_t>(n, discs.size() - 1);
    const Edge* const side = edges + 3 * std::max(last[i], 0);
    for (int k = 0; k < 3; ++k) {
      x[k][n] = side[k].from.x - discs[i].x;
      y[k][n] = side[k].from.y - discs[i].y;
      per_length[k][n] = side[k].per_length;
      per_height[k][n] = side[k].kink_opposite;
    }
    radius[n] = discs[i].radius;
  }

  // The nearest edge, the third by its number; it runs from a to b, c is opposite to it.
  Each nearest, distance, ax, ay, bx, by, share_a, share_b, share_c, free;
  for (int n = 0; n < kMost; ++n) {
    const double d0 = (x[0][n] * y[1][n] - y[0][n] * x[1][n]) * per_length[0][n],
                 d1 = (x[1][n] * y[2][n] - y[1][n] * x[2][n]) * per_length[1][n],
                 d2 = (x[2][n] * y[0][n] - y[2][n] * x[0][n]) * per_length[2][n];
    const double n0 = d1 * per_height[1][n], n1 = d2 * per_height[2][n], n2 = d0 * per_height[0][n];
    const double d01 = d1 < d0 ? d1 : d0, larger = d1 < d0 ? d0 : d1;
    const bool second = d1 < d0, third = d2 < d01;
    nearest[n] = third ? 2.0 : second ? 1.0 : 0.0;
    distance[n] = third ? d2 : d01;
    const double other = third ? d01 : (d2 < larger ? d2 : larger);
    ax[n] = third ? x[2][n] : second ? x[1][n] : x[0][n];
    ay[n] = third ? y[2][n] : second ? y[1][n] : y[0][n];
    bx[n] = third ? x[0][n] : second ? x[2][n] : x[1][n];
    by[n] = third ? y[0][n] : second ? y[2][n] : y[1][n];
    share_a[n] = third ? n2 : second ? n1 : n0;
    share_b[n] = third ? n0 : second ? n2 : n1;
    share_c[n] = third ? n1 : second ? n0 : n2;
    free[n] = distance[n] > 0 ? other - radius[n] : -1.0;
  }

  // The corner beyond it, and the neighbour's edges from a and to b.
  Each far_x, far_y, per_length_a, per_length_b, inside, kink_from, kink_opposite, kink_far;
  for (int n = 0; n < kMost; ++n) {
    const std::size_t i = std::min<std::size_t>(n, discs.size() - 1);
    const int k = static_cast<int>(nearest[n]);
    const Edge* const side = edges + 3 * std::max(last[i], 0);
    const Edge& edge = side[k];
    const Edge &to_far = edges[std::max(edge.to_far, 0)], &from_far = edges[std::max(edge.from_far, 0)];
    far_x[n] = from_far.from.x - discs[i].x;
    far_y[n] = from_far.from.y - discs[i].y;
    per_length_a[n] = to_far.per_length;
    per_length_b[n] = from_far.per_length;
    inside[n] = edge.from_far;
    kink_from[n] = edge.kink_from;
    kink_opposite[n] = edge.kink_opposite;
    kink_far[n] = edge.kink_far;
    constexpr int kNext[] = {1, 2, 0, 1};
    result.vertex[n] = {edge.vertex, side[kNext[k]].vertex, side[kNext[k + 1]].vertex, from_far.vertex};
  }

  Each entries, volume[4];
  for (int n = 0; n < kMost; ++n) {
    const double r = radius[n];
    const double beside_a = (ax[n] * far_y[n] - ay[n] * far_x[n]) * per_length_a[n],
                 beside_b = (far_x[n] * by[n] - far_y[n] * bx[n]) * per_length_b[n];
    const double beside = beside_a < beside_b ? beside_a : beside_b;
    const double alone = inside[n] >= 0 ? beside - r : -1.0;
    const bool crosses = distance[n] < r;
    const double fits = crosses ? alone : 0.0, counted = inside[n] >= 0 ? 4.0 : 3.0;
    const double worst = fits < free[n] ? fits : free[n];
    entries[n] = worst >= 0 ? counted : 0.0;
    const double all = std::numbers::pi * r * r, integral = beyond_line(r, distance[n] / r);
    const double at_a = integral * kink_from[n], opposite = integral * kink_opposite[n],
                 at_far = integral * kink_far[n];
    const double a = all * share_a[n] + at_a, b = all * share_b[n] - (at_a + opposite + at_far),
                 c = all * share_c[n] + opposite;
    volume[0][n] = a > 0 ? a : 0;
    volume[1][n] = b > 0 ? b : 0;
    volume[2][n] = c > 0 ? c : 0;
    volume[3][n] = at_far > 0 ? at_far : 0;
  }
  for (int n = 0; n < kMost; ++n) {
    result.entries[n] = static_cast<int>(entries[n]);
    for (int k = 0; k < 4; ++k) result.volume[n][k] = volume[k][n];
  }
}
