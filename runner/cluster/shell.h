#pragma once

#include <string>
#include <vector>

namespace seapile::cluster {

/// A word that a POSIX shell reads back as `text`, whatever is in it.
std::string shell_word(const std::string& text);

/// A command line that a POSIX shell reads back as these words.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace seapile::cluster
