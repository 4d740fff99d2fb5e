// What tells a case from others of its study, in words: a label is a path and the text of the value there.
#pragma once

#include <string>

namespace seapile::store {

/// By the paths of a study: "pile.tip=flat", of a part's members "fluid.density=1300 kg/m3", of a part that is there or
/// not "fluid" and "no fluid".
std::string label_text(const std::string& path, const std::string& value);

/// For a legend: "tip flat", "fluid density 1300 kg/m3", "fluid", "no fluid".
std::string short_label_text(const std::string& path, const std::string& value);

}  // namespace seapile::store
