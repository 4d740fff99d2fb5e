// The studies that ship with the program, to begin one's own from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seapile::commands {

/// The folder of the studies that ship: beside an installed program <prefix>/share/seapile/studies, else that of the
/// source tree that it was built in; empty when there is neither.
std::filesystem::path shipped_studies();

/// Their names, sorted.
std::vector<std::string> shipped_names();

struct NewStudy {
  std::string text;
  std::vector<std::string> left_out;  ///< what of the template does not fit its new place, a sentence each
};

/// The text of a study file under another name and question, in the layout that it had. Checks whose published values
/// lie in a file that is not below `folder` are left out. Without a question it says what it began as.
NewStudy derived(const std::filesystem::path& from, const std::string& name, const std::string& question,
                 const std::filesystem::path& folder);

/// A small study with one axis, to be changed: about a second of work for each case.
std::string smallest_study(const std::string& name, const std::string& question);

}  // namespace seapile::commands
