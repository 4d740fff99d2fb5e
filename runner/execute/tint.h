// Colour for a few words on a terminal, and only there.
#pragma once

#include <cstdio>
#include <string>

namespace seapile::execute {

/// Whether colours belong on a stream: it is a terminal that knows them (TERM is set and not "dumb"), and NO_COLOR is
/// unset or empty (https://no-color.org).
bool has_colours(std::FILE* stream);

/// Text for a stream, in which the words for how something stands have their colour where it has colours: green what is
/// well ("completed", "fresh", "confirmed"), red what failed, yellow what is undecided. Such a word begins a line or is
/// a cell of a table, with two blanks around it; words within sentences are left alone. Elsewhere the text as it is.
std::string tinted(const std::string& text, std::FILE* stream);

}  // namespace seapile::execute
