// Tar files member by member, also such as no program of ours writes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runner/store/bundle_index.h"
#include "runner/store/run_folder.h"

namespace seapile::commands {

struct Member {
  std::string name, bytes;
  char type = '0';          ///< as POSIX has it: '0' a plain file, '1' a hard link, '2' a symbolic one, '5' a directory
  std::string target = {};  ///< of a link
};
using Members = std::vector<Member>;

Members members_of(const std::string& tar);
std::string tar_of(const Members& members);

/// The first member whose name ends so, "" for none.
Member& member(Members& members, const std::string& ending);

/// Changes the index, the first member, and seals it again.
void change_index(Members& members, const std::function<void(store::BundleIndex&)>& change);

/// Lets the index say what the other members are.
void list_again(Members& members);

/// Changes a run's manifest, seals it again, and what is bound to its seal: dropped.json and the index.
void change_manifest(Members& members, const std::string& kind, const std::function<void(store::Manifest&)>& change);

}  // namespace seapile::commands
