// A run once more, from nothing but what its manifest says; and which runs count as that.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/run_folder.h"
#include "runner/study/study.h"

namespace seapile::execute {

/// The study whose only case is the run's. `grains`: the file with the grains of its bed, empty where they are drawn.
/// Throws study::BadInput in the name of `where` when the manifest's scene cannot be built, or is not that of its id.
study::Study repetition_of(const store::Manifest& manifest, const std::filesystem::path& grains,
                           const std::string& where);

/// What is not the same of two programs and their processors, in words: {"commit", "compiler"}. Threads and the width
/// of registers change no bit.
std::vector<std::string> differences(const store::Provenance& a, const store::Provenance& b);

/// Why a run that is there already is no repetition of the bundled one by this program; empty: it is one. Changes that
/// no commit names may be others every time.
std::string why_no_repetition(const store::Manifest& run, const store::Manifest& bundled,
                              const store::Provenance& today);

}  // namespace seapile::execute
