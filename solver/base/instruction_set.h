// The vector instructions that kernels are compiled for, and what this processor has of them.
#pragma once

namespace seapile::base {

enum class InstructionSet { generic, avx2, avx512 };

/// Whether kernels for these instructions were built and this processor can execute them.
inline bool available(InstructionSet set) {
#if defined(__x86_64__)
  switch (set) {
    case InstructionSet::generic:
      return true;
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2");
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  }
#endif
  return set == InstructionSet::generic;
}

/// The fastest here. Zen 4 works through 512 bits in two halves: the 256-bit contact kernels take 12 % less time over a
/// whole run (bench/README.md).
inline InstructionSet fastest() {
#if defined(__x86_64__)
  // AMD's family 19h: Zen 3, which has no AVX-512, and Zen 4.
  if (available(InstructionSet::avx512) && !__builtin_cpu_is("amdfam19h")) return InstructionSet::avx512;
  if (available(InstructionSet::avx2)) return InstructionSet::avx2;
#endif
  return InstructionSet::generic;
}

}  // namespace seapile::base
