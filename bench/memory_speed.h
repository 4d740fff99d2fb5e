// How fast this machine moves memory: plain loops over an array, and a cache line that goes back and forth.
#pragma once

#include <cstddef>

namespace seapile::bench {

enum class Access {
  read,    ///< every byte once
  write,   ///< whole cache lines, without reading them in the program
  update,  ///< read, changed, written back: counted once, moved twice
};
inline constexpr Access kAccesses[] = {Access::read, Access::write, Access::update};
const char* name_of(Access access);

/// Bytes per nanosecond of all threads together, each walking again and again through an array of its own of `bytes`
/// (rounded up to 2 KB), in the time that the thread itself had. The median of `repeat` measurements. `huge`: pages of
/// 2 MB are asked for; the solver does not.
double memory_speed(Access access, std::size_t bytes, int threads, int repeat = 7, bool huge = false);

/// Nanoseconds until a store of one thread is seen by another that waits for it: half a round trip, the median of many.
double handover_time();

}  // namespace seapile::bench
