// Tests in the field that are laid over simulated curves.
#pragma once

#include <string>
#include <vector>

#include "runner/commands/command.h"
#include "runner/present/figure.h"

namespace seapile::commands {

/// The files, and what of the ground and the cone they do not say; as on the command line, "" where it was not given.
struct SiteArguments {
  std::vector<std::string> files;
  std::string unit_weight, water_depth, cone_diameter;
};

/// Adds `--overlay` and the options `--site-...`.
void add_site_options(CLI::App& command, SiteArguments& site);

/// The tests, with the ground of each: one layer of the given unit weight, water of 9.81 kN/m3 below its table, B the
/// diameter of the cone. Readings without depth or resistance are left out. Throws study::BadInput with what is wrong
/// in a file or missing for it, UsageError for a wrong option.
std::vector<present::SiteCurve> read_sites(const SiteArguments& site);

}  // namespace seapile::commands
