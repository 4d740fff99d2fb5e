// A run as the solver could have made it, from exact arithmetic only: small, the same on every machine, and with other
// values in every place, so that a swapped or shifted one is noticed.
#pragma once

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/run_folder.h"

namespace seapile::store::sample {

inline constexpr std::size_t kGrains = 50;

/// A number in [0, 1), another one for each pair of arguments.
double uniform(std::uint64_t stream, std::uint64_t index);

bool same_bits(const auto& a, const auto& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

RunHeader bed_header();
RunHeader drive_header();

simulation::Bed bed();
simulation::RunResult bed_result();

simulation::Record record(std::size_t index);
std::vector<simulation::Record> records(std::size_t first, std::size_t count);
/// With another number of contacts in each frame; none when `contacts` is 0.
simulation::Frame frame(std::size_t index, std::size_t contacts);
inline simulation::Frame frame(std::size_t index) { return frame(index, 80 + 7 * index); }

/// What a solver would carry along, one array of each type.
std::vector<simulation::Array> state(std::size_t index);

simulation::RunResult drive_result();
Provenance provenance();

/// Writes the sample's bed and drive below a store's root; the drive with two frames, `records` records and a
/// checkpoint in their middle. Returns the two run folders.
struct Written {
  std::filesystem::path bed, drive;
};
Written write(const std::filesystem::path& root, std::size_t records = 20);

/// The first difference bit for bit; empty: none.
std::string difference(const std::vector<simulation::Record>& a, const std::vector<simulation::Record>& b);
std::string difference(const std::vector<simulation::Array>& a, const std::vector<simulation::Array>& b);
std::string difference(const simulation::Frame& a, const simulation::Frame& b);
std::string difference(const simulation::Bed& a, const simulation::Bed& b);

}  // namespace seapile::store::sample
