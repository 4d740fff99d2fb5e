// Small basins for tests.
#pragma once

#include "solver/base/profile.h"
#include "solver/basin/basin.h"
#include "solver/basin/step.h"

namespace seapile::basin::support {

/// The thesis' hump (Table 4.1) on a coarse mesh.
inline BasinSpec hump(int columns = 48, int rows = 6) {
  BasinSpec spec;
  spec.surface->initial = HumpSurface{};
  spec.mesh.pattern = StructuredMesh{columns, rows};
  spec.time.step = 2e-3;
  return spec;
}

/// A small standing wave, half a wave long.
inline BasinSpec wave(int columns, int rows, double step) {
  BasinSpec spec;
  spec.depth = 0.5;
  spec.gravity = 1;
  spec.viscosity = 10;
  spec.surface->initial = CosineSurface{};
  spec.mesh.pattern = StructuredMesh{columns, rows};
  spec.time.step = step;
  return spec;
}

/// The thesis' pile in water (Table 4.2), coarse in time.
inline BasinSpec pile_in_water() {
  BasinSpec spec;
  spec.width = 5;
  spec.depth = 2.4;
  spec.pile = BasinPileSpec{};
  spec.mesh.pattern = UnstructuredMesh{0.15, 0.125, 0.15};
  spec.mesh.motion = ZonesMotion{0.5};
  spec.time.step = 0.02;
  return spec;
}

inline Basin filled(const BasinSpec& spec) { return basin::filled(spec, base::fastest()); }

/// Empty when all steps were done; otherwise why not.
inline std::string run(Basin& basin, int steps) {
  base::Profile profile;
  for (int i = 0; i < steps; ++i)
    if (std::string why = step(basin, profile).why; !why.empty()) return why;
  return {};
}

inline double volume(const Basin& basin) { return volume_of(basin.flow.mesh); }

}  // namespace seapile::basin::support
