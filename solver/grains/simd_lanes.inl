// Vectors of the width of this instruction set, and the two operations that compilers do not find by themselves:
// gathering records of four numbers into four vectors, and putting them back.
//
// Included inside a namespace of the instruction set, once per translation unit, after SEAPILE_VECTOR_BYTES is set.
// Everything here has internal linkage: nothing compiled for a demanding processor can be picked up elsewhere.

template <class Real>
struct Lanes;
template <>
struct Lanes<float> {
  typedef float V __attribute__((vector_size(SEAPILE_VECTOR_BYTES)));
  typedef float FromDoubles __attribute__((vector_size(SEAPILE_VECTOR_BYTES / 2)));  // as many as doubles fit
  static constexpr int kWidth = SEAPILE_VECTOR_BYTES / 4;
};
template <>
struct Lanes<double> {
  typedef double V __attribute__((vector_size(SEAPILE_VECTOR_BYTES)));
  typedef double FromDoubles __attribute__((vector_size(SEAPILE_VECTOR_BYTES)));
  static constexpr int kWidth = SEAPILE_VECTOR_BYTES / 8;
};

template <class V, class Real>
inline __attribute__((always_inline)) V load(const Real* p) {
  V v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
template <class V, class Real>
inline __attribute__((always_inline)) void store(Real* p, V v) {
  __builtin_memcpy(p, &v, sizeof v);
}
template <class V>
inline __attribute__((always_inline)) V smaller(V a, V b) {
  return a < b ? a : b;
}
template <class V>
inline __attribute__((always_inline)) V larger(V a, V b) {
  return a > b ? a : b;
}

/// Square roots, correctly rounded.
template <class V>
inline __attribute__((always_inline)) V roots(V a) {
  for (unsigned k = 0; k < sizeof(V) / sizeof(a[0]); ++k) a[k] = root(a[k]);
  return a;
}

// Records k = 0..W-1 stand at base + at[k]; their four fields go to a, b, c, d.
template <class Real, class V>
inline __attribute__((always_inline)) void gather(const Real* base, const std::int32_t* at, V& a, V& b, V& c, V& d) {
  alignas(V) Real field[4][Lanes<Real>::kWidth];
  for (int k = 0; k < Lanes<Real>::kWidth; ++k)
    for (int number = 0; number < 4; ++number) field[number][k] = base[at[k] + number];
  a = load<V>(field[0]);
  b = load<V>(field[1]);
  c = load<V>(field[2]);
  d = load<V>(field[3]);
}
template <class Real, class V>
inline __attribute__((always_inline)) void scatter(Real* base, const std::int32_t* at, V a, V b, V c, V d) {
  for (int k = 0; k < Lanes<Real>::kWidth; ++k) {
    Real* record = base + at[k];
    record[0] = a[k];
    record[1] = b[k];
    record[2] = c[k];
    record[3] = d[k];
  }
}

#if SEAPILE_VECTOR_BYTES >= 32

inline __attribute__((always_inline)) const float* record(const float* base, std::int32_t k) {
  return base + k;
}
inline __attribute__((always_inline)) const double* record(const double* base, std::int32_t k) {
  return base + k;
}
inline __attribute__((always_inline)) float* record(float* base, std::int32_t k) {
  return base + k;
}
inline __attribute__((always_inline)) double* record(double* base, std::int32_t k) {
  return base + k;
}

// 4 x 4 transposition of doubles in four 256-bit registers; its own inverse.
inline __attribute__((always_inline)) void transpose(__m256d& r0, __m256d& r1, __m256d& r2, __m256d& r3) {
  const __m256d lo01 = _mm256_unpacklo_pd(r0, r1), hi01 = _mm256_unpackhi_pd(r0, r1);
  const __m256d lo23 = _mm256_unpacklo_pd(r2, r3), hi23 = _mm256_unpackhi_pd(r2, r3);
  r0 = _mm256_permute2f128_pd(lo01, lo23, 0x20);
  r1 = _mm256_permute2f128_pd(hi01, hi23, 0x20);
  r2 = _mm256_permute2f128_pd(lo01, lo23, 0x31);
  r3 = _mm256_permute2f128_pd(hi01, hi23, 0x31);
}
inline __attribute__((always_inline)) void gather4(const double* base, const std::int32_t* k, __m256d& a, __m256d& b,
                                                   __m256d& c, __m256d& d) {
  a = _mm256_load_pd(record(base, k[0]));
  b = _mm256_load_pd(record(base, k[1]));
  c = _mm256_load_pd(record(base, k[2]));
  d = _mm256_load_pd(record(base, k[3]));
  transpose(a, b, c, d);
}
inline __attribute__((always_inline)) void scatter4(double* base, const std::int32_t* k, __m256d a, __m256d b,
                                                    __m256d c, __m256d d) {
  transpose(a, b, c, d);
  _mm256_store_pd(record(base, k[0]), a);
  _mm256_store_pd(record(base, k[1]), b);
  _mm256_store_pd(record(base, k[2]), c);
  _mm256_store_pd(record(base, k[3]), d);
}

#endif

#if SEAPILE_VECTOR_BYTES == 32

template <>
inline __attribute__((always_inline)) Lanes<float>::V roots(Lanes<float>::V a) {
  return _mm256_sqrt_ps(a);
}
template <>
inline __attribute__((always_inline)) Lanes<double>::V roots(Lanes<double>::V a) {
  return _mm256_sqrt_pd(a);
}

// Four transpositions of 4 x 4 floats, one per 128-bit half; its own inverse.
inline __attribute__((always_inline)) void transpose(__m256& r0, __m256& r1, __m256& r2, __m256& r3) {
  const __m256d lo01 = _mm256_castps_pd(_mm256_unpacklo_ps(r0, r1)), hi01 = _mm256_castps_pd(_mm256_unpackhi_ps(r0, r1));
  const __m256d lo23 = _mm256_castps_pd(_mm256_unpacklo_ps(r2, r3)), hi23 = _mm256_castps_pd(_mm256_unpackhi_ps(r2, r3));
  r0 = _mm256_castpd_ps(_mm256_unpacklo_pd(lo01, lo23));
  r1 = _mm256_castpd_ps(_mm256_unpackhi_pd(lo01, lo23));
  r2 = _mm256_castpd_ps(_mm256_unpacklo_pd(hi01, hi23));
  r3 = _mm256_castpd_ps(_mm256_unpackhi_pd(hi01, hi23));
}
inline __attribute__((always_inline)) __m256 two(const float* base, std::int32_t k0, std::int32_t k1) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(record(base, k0))), _mm_load_ps(record(base, k1)), 1);
}
template <>
inline __attribute__((always_inline)) void gather<float, Lanes<float>::V>(const float* base, const std::int32_t* k,
                                                                          Lanes<float>::V& a, Lanes<float>::V& b,
                                                                          Lanes<float>::V& c, Lanes<float>::V& d) {
  __m256 r0 = two(base, k[0], k[4]), r1 = two(base, k[1], k[5]);
  __m256 r2 = two(base, k[2], k[6]), r3 = two(base, k[3], k[7]);
  transpose(r0, r1, r2, r3);
  a = r0, b = r1, c = r2, d = r3;
}
template <>
inline __attribute__((always_inline)) void scatter<float, Lanes<float>::V>(float* base, const std::int32_t* k,
                                                                           Lanes<float>::V a, Lanes<float>::V b,
                                                                           Lanes<float>::V c, Lanes<float>::V d) {
  __m256 r[4] = {a, b, c, d};
  transpose(r[0], r[1], r[2], r[3]);
  for (int q = 0; q < 4; ++q) {
    _mm_store_ps(record(base, k[q]), _mm256_castps256_ps128(r[q]));
    _mm_store_ps(record(base, k[4 + q]), _mm256_extractf128_ps(r[q], 1));
  }
}
template <>
inline __attribute__((always_inline)) void gather<double, Lanes<double>::V>(const double* base, const std::int32_t* k,
                                                                            Lanes<double>::V& a, Lanes<double>::V& b,
                                                                            Lanes<double>::V& c, Lanes<double>::V& d) {
  __m256d r[4];
  gather4(base, k, r[0], r[1], r[2], r[3]);
  a = r[0], b = r[1], c = r[2], d = r[3];
}
template <>
inline __attribute__((always_inline)) void scatter<double, Lanes<double>::V>(double* base, const std::int32_t* k,
                                                                             Lanes<double>::V a, Lanes<double>::V b,
                                                                             Lanes<double>::V c, Lanes<double>::V d) {
  scatter4(base, k, a, b, c, d);
}

#endif

#if SEAPILE_VECTOR_BYTES == 64

template <>
inline __attribute__((always_inline)) Lanes<float>::V roots(Lanes<float>::V a) {
  return _mm512_sqrt_ps(a);
}
template <>
inline __attribute__((always_inline)) Lanes<double>::V roots(Lanes<double>::V a) {
  return _mm512_sqrt_pd(a);
}

inline __attribute__((always_inline)) void transpose(__m512& r0, __m512& r1, __m512& r2, __m512& r3) {
  const __m512d lo01 = _mm512_castps_pd(_mm512_unpacklo_ps(r0, r1)), hi01 = _mm512_castps_pd(_mm512_unpackhi_ps(r0, r1));
  const __m512d lo23 = _mm512_castps_pd(_mm512_unpacklo_ps(r2, r3)), hi23 = _mm512_castps_pd(_mm512_unpackhi_ps(r2, r3));
  r0 = _mm512_castpd_ps(_mm512_unpacklo_pd(lo01, lo23));
  r1 = _mm512_castpd_ps(_mm512_unpackhi_pd(lo01, lo23));
  r2 = _mm512_castpd_ps(_mm512_unpacklo_pd(hi01, hi23));
  r3 = _mm512_castpd_ps(_mm512_unpackhi_pd(hi01, hi23));
}
inline __attribute__((always_inline)) __m512 four(const float* base, const std::int32_t* k) {
  __m512 r = _mm512_castps128_ps512(_mm_load_ps(record(base, k[0])));
  r = _mm512_insertf32x4(r, _mm_load_ps(record(base, k[4])), 1);
  r = _mm512_insertf32x4(r, _mm_load_ps(record(base, k[8])), 2);
  return _mm512_insertf32x4(r, _mm_load_ps(record(base, k[12])), 3);
}
template <>
inline __attribute__((always_inline)) void gather<float, Lanes<float>::V>(const float* base, const std::int32_t* k,
                                                                          Lanes<float>::V& a, Lanes<float>::V& b,
                                                                          Lanes<float>::V& c, Lanes<float>::V& d) {
  __m512 r0 = four(base, k), r1 = four(base, k + 1), r2 = four(base, k + 2), r3 = four(base, k + 3);
  transpose(r0, r1, r2, r3);
  a = r0, b = r1, c = r2, d = r3;
}
template <>
inline __attribute__((always_inline)) void scatter<float, Lanes<float>::V>(float* base, const std::int32_t* k,
                                                                           Lanes<float>::V a, Lanes<float>::V b,
                                                                           Lanes<float>::V c, Lanes<float>::V d) {
  __m512 r[4] = {a, b, c, d};
  transpose(r[0], r[1], r[2], r[3]);
  for (int q = 0; q < 4; ++q) {
    _mm_store_ps(record(base, k[q]), _mm512_castps512_ps128(r[q]));
    _mm_store_ps(record(base, k[4 + q]), _mm512_extractf32x4_ps(r[q], 1));
    _mm_store_ps(record(base, k[8 + q]), _mm512_extractf32x4_ps(r[q], 2));
    _mm_store_ps(record(base, k[12 + q]), _mm512_extractf32x4_ps(r[q], 3));
  }
}
template <>
inline __attribute__((always_inline)) void gather<double, Lanes<double>::V>(const double* base, const std::int32_t* k,
                                                                            Lanes<double>::V& a, Lanes<double>::V& b,
                                                                            Lanes<double>::V& c, Lanes<double>::V& d) {
  __m256d lo[4], hi[4];
  gather4(base, k, lo[0], lo[1], lo[2], lo[3]);
  gather4(base, k + 4, hi[0], hi[1], hi[2], hi[3]);
  a = _mm512_insertf64x4(_mm512_castpd256_pd512(lo[0]), hi[0], 1);
  b = _mm512_insertf64x4(_mm512_castpd256_pd512(lo[1]), hi[1], 1);
  c = _mm512_insertf64x4(_mm512_castpd256_pd512(lo[2]), hi[2], 1);
  d = _mm512_insertf64x4(_mm512_castpd256_pd512(lo[3]), hi[3], 1);
}
template <>
inline __attribute__((always_inline)) void scatter<double, Lanes<double>::V>(double* base, const std::int32_t* k,
                                                                             Lanes<double>::V a, Lanes<double>::V b,
                                                                             Lanes<double>::V c, Lanes<double>::V d) {
  const __m512d v[4] = {a, b, c, d};
  scatter4(base, k, _mm512_castpd512_pd256(v[0]), _mm512_castpd512_pd256(v[1]), _mm512_castpd512_pd256(v[2]),
           _mm512_castpd512_pd256(v[3]));
  scatter4(base, k + 4, _mm512_extractf64x4_pd(v[0], 1), _mm512_extractf64x4_pd(v[1], 1),
           _mm512_extractf64x4_pd(v[2], 1), _mm512_extractf64x4_pd(v[3], 1));
}

#endif
