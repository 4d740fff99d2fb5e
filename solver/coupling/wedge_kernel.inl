// The kernel of wedge_kernels.h for one instruction set. Included inside an anonymous namespace.

// Around a vertex are six triangles, seldom more than eight: a loop of eight is one wide vector.
void by_rays(double r, double away, Rays& rays) {
  constexpr int kTogether = 8;
  for (int from = 0; from < rays.count; from += kTogether)
    for (int m = 0; m < kTogether; ++m)
      rays.beyond[from + m] = beyond_ray(r, away, rays.x[from + m], rays.y[from + m]);
}
