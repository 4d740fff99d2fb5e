// The kernels of contact_kernels.h, written once. See there; formulas in docs/formulation.md 2.
//
// Included inside a namespace of the instruction set, after simd_lanes.inl.

/// Records of four numbers as a row of numbers.
template <class Real>
inline Real* numbers(BodyGroup<Real>* records) {
  return reinterpret_cast<Real*>(records);
}
template <class Real>
inline const Real* numbers(const BodyGroup<Real>* records) {
  return reinterpret_cast<const Real*>(records);
}
template <class Real>
inline Real* numbers(Before<Real>* records) {
  return reinterpret_cast<Real*>(records);
}
template <class Real>
inline const Real* numbers(const Before<Real>* records) {
  return reinterpret_cast<const Real*>(records);
}
template <class Real>
inline const Real* numbers(const Push<Real>* records) {
  return reinterpret_cast<const Real*>(records);
}
inline const double* numbers(const Disc* records) { return reinterpret_cast<const double*>(records); }

/// Adds sixteen lanes in their order.
template <class Real>
inline double ordered_sum(const Real* lane) {
  double sum = 0;
  for (int k = 0; k < kLanes; ++k) sum += static_cast<double>(lane[k]);
  return sum;
}

/// Asks for the block that comes a few after this one: short colours and resting blocks lead the processor's own guess astray.
template <class Real>
inline void fetch_ahead(const ContactBlock<Real>& block) {
  constexpr int kAhead = 3;
  const char* there = reinterpret_cast<const char*>(&block + kAhead);
  for (std::size_t line = 0; line < sizeof block; line += 64) __builtin_prefetch(there + line);
}

template <class Real>
void refresh(ContactBlock<Real>* blocks, std::uint8_t* active, double* wake, std::int32_t first, std::int32_t last,
             const Disc* disc, const BodyGroup<Real>* bodies, Before<Real>* warm, const Nearness& near) {
  using V = typename Lanes<Real>::V;
  using D = Lanes<double>::V;
  constexpr int W = Lanes<Real>::kWidth;
  constexpr int DW = Lanes<double>::kWidth;
  using Narrow = typename Lanes<Real>::FromDoubles;
  const double* discs = numbers(disc);
  const Real* motions = numbers(bodies);
  Real* warms = numbers(warm);
  const V zero = {}, one = zero + Real(1), twist = zero + static_cast<Real>(near.twist);
  const V margin = zero + static_cast<Real>(near.margin), time = zero + static_cast<Real>(2 * near.time);

  for (std::int32_t b = first; b < last; ++b) {
    ContactBlock<Real>& block = blocks[b];
    if (near.closing + near.reach < wake[b]) {
      if (active[b])
        for (int k = 0; k < kLanes; k += W) store(block.pn + k, zero), store(block.pt + k, zero);
      active[b] = 0;
      continue;
    }
    alignas(64) std::int32_t i[kLanes], j[kLanes];
    for (int k = 0; k < kLanes; ++k) {
      i[k] = 4 * body_at(block.i[k]);
      j[k] = 4 * body_at(block.j[k]);
    }

    // Differences in double: centre to centre, and distance squared less reach squared, which loses no digits.
    alignas(64) Real dx[kLanes], dy[kLanes], square[kLanes], excess[kLanes], radii[kLanes];
    for (int k = 0; k < kLanes; k += DW) {
      D xi, yi, ri, xj, yj, rj, unused;
      gather<double>(discs, i + k, xi, yi, ri, unused);
      gather<double>(discs, j + k, xj, yj, rj, unused);
      const D x = xj - xi, y = yj - yi, r = ri + rj;
      const D s = x * x + y * y;
      store(dx + k, __builtin_convertvector(x, Narrow));
      store(dy + k, __builtin_convertvector(y, Narrow));
      store(square + k, __builtin_convertvector(s, Narrow));
      store(excess + k, __builtin_convertvector(D(s - r * r), Narrow));
      store(radii + k, __builtin_convertvector(r, Narrow));
    }

    // gap = (distance^2 - r^2) / (distance + r); may it close in this step at twice the present relative speed?
    const V never = zero + std::numeric_limits<Real>::max();
    Real slack = 1, least = std::numeric_limits<Real>::max();
    for (int k = 0; k < kLanes; k += W) {
      V vxi, vyi, ui, mi, vxj, vyj, uj, mj;
      gather<Real>(motions, block.i + k, vxi, vyi, ui, mi);
      gather<Real>(motions, block.j + k, vxj, vyj, uj, mj);
      const V distance = roots(load<V>(square + k));
      const V inverse = one / distance;
      const V gap = load<V>(excess + k) / (distance + load<V>(radii + k));
      store(block.nx + k, V(load<V>(dx + k) * inverse));
      store(block.ny + k, V(load<V>(dy + k) * inverse));
      store(block.gap + k, gap);
      const V wx = vxj - vxi, wy = vyj - vyi;
      const V reach = larger(wx, V(zero - wx)) + larger(wy, V(zero - wy));
      const auto filled = load<V>(block.mass + k) > zero;
      const V room = filled ? V(gap - margin - time * reach) : one;
      const V present = filled ? gap : never;
      for (int q = 0; q < W; ++q) {
        slack = room[q] < slack ? room[q] : slack;
        least = present[q] < least ? present[q] : least;
      }
    }
    wake[b] = near.closing + static_cast<double>(least);
    active[b] = slack < 0;
    if (!active[b]) {
      for (int k = 0; k < kLanes; k += W) store(block.pn + k, zero), store(block.pt + k, zero);
      continue;
    }

    // What the impulses of the last sub-step do to the bodies now that the normals have turned.
    for (int k = 0; k < kLanes; k += W) {
      V unused0, unused1, unused2, mi, mj, ax, ay, au, am, bx, by, bu, bm;
      gather<Real>(motions, block.i + k, unused0, unused1, unused2, mi);
      gather<Real>(motions, block.j + k, unused0, unused1, unused2, mj);
      gather<Real>(warms, i + k, ax, ay, au, am);
      gather<Real>(warms, j + k, bx, by, bu, bm);
      const V nx = load<V>(block.nx + k), ny = load<V>(block.ny + k);
      const V pn = load<V>(block.pn + k), pt = load<V>(block.pt + k);
      const V px = pn * nx - pt * ny, py = pn * ny + pt * nx;
      const V turn = twist * pt;
      scatter<Real>(warms, i + k, V(ax - mi * px), V(ay - mi * py), V(au - mi * turn), am);
      scatter<Real>(warms, j + k, V(bx + mj * px), V(by + mj * py), V(bu - mj * turn), bm);
    }
  }
}

template <class Real>
void sweep(ContactBlock<Real>* blocks, const std::uint8_t* active, std::int32_t first, std::int32_t last,
           BodyGroup<Real>* bodies, Real friction, const Softness<Real>& soft, SweepSums* sums) {
  using V = typename Lanes<Real>::V;
  constexpr int W = Lanes<Real>::kWidth;
  constexpr int P = kLanes / W;
  Real* motions = numbers(bodies);
  const Real* drifts = motions + 16;
  const V zero = {}, one = zero + Real(1), half = zero + Real(0.5);
  const V mu = zero + friction, twist = zero + soft.twist, arms = one + twist, share = one / arms;
  const V inverse_h = zero + soft.inverse_h, bias_rate = zero + soft.bias_rate, push = zero - soft.push_speed;
  const V mass_scale = zero + soft.mass_scale, impulse_scale = zero + soft.impulse_scale;

  V work[P], residual[P];
  for (int p = 0; p < P; ++p) work[p] = residual[p] = zero;

  for (std::int32_t b = first; b < last; ++b) {
    if (!active[b]) continue;
    ContactBlock<Real>& block = blocks[b];
    fetch_ahead(block);

    // All parts of the block are gathered before any is put back: their chains of dependent operations run side by side.
    V vxi[P], vyi[P], ui[P], mi[P], vxj[P], vyj[P], uj[P], mj[P], closed[P];
#pragma GCC unroll 16
    for (int p = 0; p < P; ++p) {
      const int k = p * W;
      gather<Real>(motions, block.i + k, vxi[p], vyi[p], ui[p], mi[p]);
      gather<Real>(motions, block.j + k, vxj[p], vyj[p], uj[p], mj[p]);
      V dxi, dyi, dxj, dyj, unused0, unused1;
      gather<Real>(drifts, block.i + k, dxi, dyi, unused0, unused1);
      gather<Real>(drifts, block.j + k, dxj, dyj, unused0, unused1);
      closed[p] = load<V>(block.nx + k) * (dxj - dxi) + load<V>(block.ny + k) * (dyj - dyi);
    }

#pragma GCC unroll 16
    for (int p = 0; p < P; ++p) {
      const int k = p * W;
      const V nx = load<V>(block.nx + k), ny = load<V>(block.ny + k), mass = load<V>(block.mass + k);
      const V pn = load<V>(block.pn + k), pt = load<V>(block.pt + k);

      // Gap now, and the velocities across the contact.
      const V gap = load<V>(block.gap + k) + closed[p];
      const V wx = vxj[p] - vxi[p], wy = vyj[p] - vyi[p];
      const V vn = nx * wx + ny * wy;
      const V vt = (nx * wy - ny * wx) - (ui[p] + uj[p]);

      // Normal: an open gap may close but not overshoot; an overlap is pushed apart softly.
      const auto open = gap > zero;
      const V bias = open ? gap * inverse_h : larger(V(gap * bias_rate), push);
      const V scale = open ? one : mass_scale;
      const V memory = open ? zero : impulse_scale;
      const V wanted = pn - mass * scale * (vn + bias) - memory * pn;
      const V new_pn = larger(wanted, zero);
      const V dpn = new_pn - pn;

      // Friction: no slip, or the edge of the Coulomb cone. The tangential mass is a third of the normal one, or all of
      // it without spin.
      const V cone = mu * new_pn;
      const V stick = pt - mass * share * vt;
      const V new_pt = smaller(larger(stick, V(zero - cone)), cone);
      const V dpt = new_pt - pt;

      store(block.pn + k, new_pn);
      store(block.pt + k, new_pt);

      const V px = dpn * nx - dpt * ny, py = dpn * ny + dpt * nx, turn = twist * dpt;
      vxi[p] = vxi[p] - mi[p] * px, vyi[p] = vyi[p] - mi[p] * py, ui[p] = ui[p] - mi[p] * turn;
      vxj[p] = vxj[p] + mj[p] * px, vyj[p] = vyj[p] + mj[p] * py, uj[p] = uj[p] - mj[p] * turn;

      // Work of the change on the mean of the velocities before and after it; the normal velocity it changed.
      const V inverse_mass = mi[p] + mj[p];
      const V dvn = inverse_mass * dpn, dvt = (arms * inverse_mass) * dpt;
      work[p] = work[p] + dpn * (vn + half * dvn) + dpt * (vt + half * dvt);
      residual[p] = residual[p] + dvn * dvn;
    }

#pragma GCC unroll 16
    for (int p = 0; p < P; ++p) {
      const int k = p * W;
      scatter<Real>(motions, block.i + k, vxi[p], vyi[p], ui[p], mi[p]);
      scatter<Real>(motions, block.j + k, vxj[p], vyj[p], uj[p], mj[p]);
    }
  }

  alignas(64) Real lane[kLanes];
  for (int p = 0; p < P; ++p) store(lane + p * W, work[p]);
  sums->work += ordered_sum(lane);
  for (int p = 0; p < P; ++p) store(lane + p * W, residual[p]);
  sums->residual += ordered_sum(lane);
}

// Bodies: four of them are one row of sixteen numbers; which number is which of a body's four never changes.

/// The rows' constants. The last number of a body is no velocity and stays: its inverse mass, or half its mass.
/// Weights are 1, 1, 1/2 half masses for vx, vy, u, because I omega^2 / 2 = m u^2 / 4.
template <class Real>
struct Row {
  alignas(64) Real time[kLanes], fall[kLanes], moving[kLanes], still[kLanes], weight[kLanes];
  Row(Real h, Real gravity) {
    for (int k = 0; k < kLanes; ++k) {
      const int number = k % 4;
      moving[k] = number == 3 ? Real(0) : Real(1);
      still[k] = number == 3 ? Real(1) : Real(0);
      time[k] = number == 3 ? Real(0) : h;
      fall[k] = number == 1 ? -gravity * h : Real(0);
      weight[k] = number == 3 ? Real(0) : number == 2 ? Real(0.5) : Real(1);
    }
  }
};

/// The last number of each body of a row's part p, repeated for all four.
template <class Real>
inline __attribute__((always_inline)) typename Lanes<Real>::V last_numbers(const Real* row, int p) {
  using V = typename Lanes<Real>::V;
  constexpr int W = Lanes<Real>::kWidth;
  const V v = load<V>(row + p * W);
  if constexpr (W == 16) {
    return __builtin_shufflevector(v, v, 3, 3, 3, 3, 7, 7, 7, 7, 11, 11, 11, 11, 15, 15, 15, 15);
  } else if constexpr (W == 8) {
    return __builtin_shufflevector(v, v, 3, 3, 3, 3, 7, 7, 7, 7);
  } else if constexpr (W == 4) {
    return __builtin_shufflevector(v, v, 3, 3, 3, 3);
  } else {
    return V{} + row[(p * W) | 3];
  }
}

/// What gravity, and the push where there is one, add to the velocities of a group in a sub-step, from number k on.
template <bool pushed, class Real>
inline __attribute__((always_inline)) typename Lanes<Real>::V fall_of(const Row<Real>& row, const Push<Real>* push,
                                                                      std::int32_t group, int k) {
  using V = typename Lanes<Real>::V;
  const V fall = load<V>(row.fall + k);
  if constexpr (!pushed) return fall;
  return fall + load<V>(row.time + k) * load<V>(numbers(push + 4 * static_cast<std::ptrdiff_t>(group)) + k);
}

template <bool pushed, class Real>
void begin_rows(BodyGroup<Real>* bodies, Before<Real>* before, const Push<Real>* push, std::int32_t first,
                std::int32_t last, Real h, Real gravity, BodySums* sums) {
  using V = typename Lanes<Real>::V;
  constexpr int W = Lanes<Real>::kWidth;
  const Row<Real> row(h, gravity);
  V work[kLanes / W] = {};
  for (std::int32_t group = first; group < last; ++group) {
    Real* motion = numbers(bodies + group);
    Real* old = numbers(before + 4 * static_cast<std::ptrdiff_t>(group));
    for (int p = 0; p < kLanes / W; ++p) {
      const int k = p * W;
      const V now = load<V>(motion + k), kept = load<V>(old + k), moving = load<V>(row.moving + k);
      const V contact = moving * kept, half_mass = load<V>(row.weight + k) * last_numbers(old, p);
      const V start = now + fall_of<pushed>(row, push, group, k);
      store(motion + kLanes + k, V{});
      store(motion + k, V(start + contact));
      store(old + k, V(moving * now + load<V>(row.still + k) * kept));
      work[p] = work[p] + half_mass * contact * (start + start + contact);
    }
  }
  alignas(64) Real lane[kLanes];
  for (int p = 0; p < kLanes / W; ++p) store(lane + p * W, work[p]);
  sums->work += ordered_sum(lane);
}

template <class Real>
void begin(BodyGroup<Real>* bodies, Before<Real>* before, const Push<Real>* push, std::int32_t first, std::int32_t last,
           Real h, Real gravity, BodySums* sums) {
  (push ? begin_rows<true, Real> : begin_rows<false, Real>)(bodies, before, push, first, last, h, gravity, sums);
}

template <bool pushed, class Real>
void advance_rows(BodyGroup<Real>* bodies, Before<Real>* before, const Push<Real>* push, std::int32_t first,
                  std::int32_t last, Real h, Real gravity, BodySums* sums) {
  using V = typename Lanes<Real>::V;
  constexpr int W = Lanes<Real>::kWidth;
  const Row<Real> row(h, gravity);
  V work[kLanes / W] = {}, lift[kLanes / W] = {};
  for (std::int32_t group = first; group < last; ++group) {
    Real* motion = numbers(bodies + group);
    Real* drift = motion + kLanes;
    Real* old = numbers(before + 4 * static_cast<std::ptrdiff_t>(group));
    for (int p = 0; p < kLanes / W; ++p) {
      const int k = p * W;
      const V now = load<V>(motion + k), kept = load<V>(old + k), moving = load<V>(row.moving + k);
      const V fall = fall_of<pushed>(row, push, group, k), half_mass = load<V>(row.weight + k) * last_numbers(old, p);
      const V change = moving * (now - kept), contact = change - fall, start = now + fall;
      store(drift + k, V(load<V>(drift + k) + load<V>(row.time + k) * now));
      store(motion + k, V(now + change));
      store(old + k, V(moving * now + load<V>(row.still + k) * kept));
      work[p] = work[p] + half_mass * contact * (start + start + contact);
      lift[p] = lift[p] + (half_mass + half_mass) * contact;
    }
  }
  alignas(64) Real lane[kLanes];
  for (int p = 0; p < kLanes / W; ++p) store(lane + p * W, work[p]);
  sums->work += ordered_sum(lane);
  for (int p = 0; p < kLanes / W; ++p) store(lane + p * W, lift[p]);
  for (int k = 0; k < kLanes; ++k)
    if (k % 4 != 1) lane[k] = 0;
  sums->lift += ordered_sum(lane);
}

template <class Real>
void advance(BodyGroup<Real>* bodies, Before<Real>* before, const Push<Real>* push, std::int32_t first,
             std::int32_t last, Real h, Real gravity, BodySums* sums) {
  (push ? advance_rows<true, Real> : advance_rows<false, Real>)(bodies, before, push, first, last, h, gravity, sums);
}

template <class Real>
void extrapolate(BodyGroup<Real>* bodies, std::int32_t first, std::int32_t last, Real momentum) {
  using V = typename Lanes<Real>::V;
  constexpr int W = Lanes<Real>::kWidth;
  const Row<Real> row(momentum, 0);
  for (std::int32_t group = first; group < last; ++group) {
    Real* motion = numbers(bodies + group);
    Real* old = motion + kLanes;
    for (int k = 0; k < kLanes; k += W) {
      const V now = load<V>(motion + k);
      store(motion + k, V(now + load<V>(row.time + k) * (now - load<V>(old + k))));
      store(old + k, now);
    }
  }
}

template <class Real>
void solve(ContactBlock<Real>* blocks, Iterate<Real>* iterates, const std::uint8_t* active, std::int32_t first,
           std::int32_t last, BodyGroup<Real>* bodies, Real friction, Real spin, Real momentum, SolveSums* sums) {
  using V = typename Lanes<Real>::V;
  constexpr int W = Lanes<Real>::kWidth;
  constexpr int P = kLanes / W;
  Real* motions = numbers(bodies);
  const V zero = {}, one = zero + Real(1), twist = zero + spin, arms = one + twist, share = one / arms;
  const V mu = zero + friction, beta = zero + momentum;

  V residual[P], touching[P];
  for (int p = 0; p < P; ++p) residual[p] = touching[p] = zero;

  for (std::int32_t b = first; b < last; ++b) {
    if (!active[b]) continue;
    ContactBlock<Real>& block = blocks[b];
    Iterate<Real>& iterate = iterates[b];

    V vxi[P], vyi[P], ui[P], mi[P], vxj[P], vyj[P], uj[P], mj[P];
#pragma GCC unroll 16
    for (int p = 0; p < P; ++p) {
      const int k = p * W;
      gather<Real>(motions, block.i + k, vxi[p], vyi[p], ui[p], mi[p]);
      gather<Real>(motions, block.j + k, vxj[p], vyj[p], uj[p], mj[p]);
    }

#pragma GCC unroll 16
    for (int p = 0; p < P; ++p) {
      const int k = p * W;
      const V nx = load<V>(block.nx + k), ny = load<V>(block.ny + k), mass = load<V>(block.mass + k);
      const V kept_pn = load<V>(block.pn + k), kept_pt = load<V>(block.pt + k);
      const V pn = kept_pn + beta * (kept_pn - load<V>(iterate.old_pn + k));
      const V pt = kept_pt + beta * (kept_pt - load<V>(iterate.old_pt + k));

      const V wx = vxj[p] - vxi[p], wy = vyj[p] - vyi[p];
      const V vn = nx * wx + ny * wy;
      const V vt = (nx * wy - ny * wx) - (ui[p] + uj[p]);

      // Signorini, then Coulomb: each exact for its contact, because the local problem is diagonal.
      const V new_pn = larger(V(pn - mass * (vn + load<V>(iterate.bias + k))), zero);
      const V cone = mu * new_pn;
      const V new_pt = smaller(larger(V(pt - mass * share * vt), V(zero - cone)), cone);
      const V dpn = new_pn - pn, dpt = new_pt - pt;

      store(iterate.old_pn + k, kept_pn);
      store(iterate.old_pt + k, kept_pt);
      store(block.pn + k, new_pn);
      store(block.pt + k, new_pt);

      const V px = dpn * nx - dpt * ny, py = dpn * ny + dpt * nx, turn = twist * dpt;
      vxi[p] = vxi[p] - mi[p] * px, vyi[p] = vyi[p] - mi[p] * py, ui[p] = ui[p] - mi[p] * turn;
      vxj[p] = vxj[p] + mj[p] * px, vyj[p] = vyj[p] + mj[p] * py, uj[p] = uj[p] - mj[p] * turn;

      const V inverse_mass = mi[p] + mj[p];
      const V dvn = inverse_mass * dpn, dvt = (arms * inverse_mass) * dpt;
      residual[p] = residual[p] + (dvn * dvn + dvt * dvt);
      touching[p] = touching[p] + (new_pn > zero ? one : zero);
    }

#pragma GCC unroll 16
    for (int p = 0; p < P; ++p) {
      const int k = p * W;
      scatter<Real>(motions, block.i + k, vxi[p], vyi[p], ui[p], mi[p]);
      scatter<Real>(motions, block.j + k, vxj[p], vyj[p], uj[p], mj[p]);
    }
  }

  alignas(64) Real lane[kLanes];
  for (int p = 0; p < P; ++p) store(lane + p * W, residual[p]);
  sums->residual += ordered_sum(lane);
  for (int p = 0; p < P; ++p) store(lane + p * W, touching[p]);
  sums->touching += ordered_sum(lane);
}

template <class Real>
void assess(const ContactBlock<Real>* blocks, const Iterate<Real>* iterates, const std::uint8_t* active,
            std::int32_t first, std::int32_t last, const BodyGroup<Real>* bodies, const Before<Real>* before,
            Real friction, Real twist, SolveSums* sums) {
  using V = typename Lanes<Real>::V;
  constexpr int W = Lanes<Real>::kWidth;
  constexpr int P = kLanes / W;
  const Real* motions = numbers(bodies);
  const Real* olds = numbers(before);
  const V zero = {}, one = zero + Real(1), half = zero + Real(0.5), arms = one + twist, share = one / arms;
  const V mu = zero + friction;

  V residual[P], touching[P], work[P];
  for (int p = 0; p < P; ++p) residual[p] = touching[p] = work[p] = zero;

  for (std::int32_t b = first; b < last; ++b) {
    if (!active[b]) continue;
    const ContactBlock<Real>& block = blocks[b];
    alignas(64) std::int32_t i[kLanes], j[kLanes];
    for (int k = 0; k < kLanes; ++k) {
      i[k] = 4 * body_at(block.i[k]);
      j[k] = 4 * body_at(block.j[k]);
    }
#pragma GCC unroll 16
    for (int p = 0; p < P; ++p) {
      const int k = p * W;
      V vxi, vyi, ui, mi, vxj, vyj, uj, mj, unused;
      gather<Real>(motions, block.i + k, vxi, vyi, ui, mi);
      gather<Real>(motions, block.j + k, vxj, vyj, uj, mj);
      const V nx = load<V>(block.nx + k), ny = load<V>(block.ny + k), mass = load<V>(block.mass + k);
      const V pn = load<V>(block.pn + k), pt = load<V>(block.pt + k);
      const V wx = vxj - vxi, wy = vyj - vyi;
      const V vn = nx * wx + ny * wy, vt = (nx * wy - ny * wx) - (ui + uj);

      const V new_pn = larger(V(pn - mass * (vn + load<V>(iterates[b].bias + k))), zero);
      const V cone = mu * new_pn;
      const V new_pt = smaller(larger(V(pt - mass * share * vt), V(zero - cone)), cone);
      const V inverse_mass = mi + mj;
      const V dvn = inverse_mass * (new_pn - pn);
      const V dvt = (arms * inverse_mass) * (new_pt - pt);
      residual[p] = residual[p] + (dvn * dvn + dvt * dvt);
      touching[p] = touching[p] + (pn > zero ? one : zero);

      gather<Real>(olds, i + k, vxi, vyi, ui, unused);
      gather<Real>(olds, j + k, vxj, vyj, uj, unused);
      const V ox = vxj - vxi, oy = vyj - vyi;
      const V on = nx * ox + ny * oy, ot = (nx * oy - ny * ox) - (ui + uj);
      work[p] = work[p] + half * (pn * (vn + on) + pt * (vt + ot));
    }
  }

  alignas(64) Real lane[kLanes];
  for (int p = 0; p < P; ++p) store(lane + p * W, residual[p]);
  sums->residual += ordered_sum(lane);
  for (int p = 0; p < P; ++p) store(lane + p * W, touching[p]);
  sums->touching += ordered_sum(lane);
  for (int p = 0; p < P; ++p) store(lane + p * W, work[p]);
  sums->work += ordered_sum(lane);
}

template <class Real>
constexpr ContactKernels<Real> table(const char* name) {
  return {name,           &refresh<Real>,     &sweep<Real>, &begin<Real>,
          &advance<Real>, &extrapolate<Real>, &solve<Real>, &assess<Real>};
}
