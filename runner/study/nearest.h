// What the user probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seapile::study {

/// Edits from one word to another: insertions, deletions, substitutions and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate with the fewest edits from `word` (upper and lower case alike), the first of equals; "" when none is
/// near enough to be meant.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace seapile::study
