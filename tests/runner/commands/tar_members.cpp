#include "tests/runner/commands/tar_members.h"

#include <fmt/format.h>

#include <stdexcept>

#include "runner/store/dropped.h"
#include "runner/store/manifest.h"
#include "runner/store/sealed_text.h"
#include "runner/store/sha256.h"

namespace seapile::commands {
namespace {

constexpr std::size_t kBlock = 512;

std::size_t padded(std::size_t bytes) { return (bytes + kBlock - 1) / kBlock * kBlock; }

/// A header of POSIX ustar.
std::string header(const Member& member) {
  std::string block(kBlock, '\0');
  const auto put = [&](std::size_t at, const std::string& text) { block.replace(at, text.size(), text); };
  put(0, member.name);
  put(100, "0000644");
  put(108, "0000000");
  put(116, "0000000");
  put(124, fmt::format("{:011o}", member.bytes.size()));
  put(136, "00000000000");
  put(148, "        ");
  put(156, std::string(1, member.type));
  put(157, member.target);
  put(257, std::string("ustar\0", 6) + "00");
  unsigned sum = 0;
  for (const char c : block) sum += static_cast<unsigned char>(c);
  put(148, fmt::format("{:06o}", sum) + std::string("\0 ", 2));
  return block;
}

}  // namespace

Members members_of(const std::string& tar) {
  Members members;
  for (std::size_t at = 0; at + kBlock <= tar.size() && tar[at] != '\0';) {
    const std::size_t bytes = std::stoull(tar.substr(at + 124, 11), nullptr, 8);
    members.push_back({tar.c_str() + at, tar.substr(at + kBlock, bytes), tar[at + 156]});
    at += kBlock + padded(bytes);
  }
  return members;
}

std::string tar_of(const Members& members) {
  std::string tar;
  for (const Member& member : members) {
    tar += header(member) + member.bytes;
    tar.resize(padded(tar.size()));
  }
  return tar + std::string(2 * kBlock, '\0');
}

Member& member(Members& members, const std::string& ending) {
  for (Member& one : members)
    if (one.name.ends_with(ending)) return one;
  throw std::out_of_range(ending);
}

void change_index(Members& members, const std::function<void(store::BundleIndex&)>& change) {
  store::BundleIndex index = store::parse_index(members.front().bytes, "index");
  change(index);
  members.front().bytes = store::index_text(index);
}

void list_again(Members& members) {
  change_index(members, [&](store::BundleIndex& index) {
    index.members.clear();
    for (std::size_t i = 1; i < members.size(); ++i)
      index.members.push_back({members[i].name, members[i].bytes.size(), store::sha256(members[i].bytes)});
  });
}

void change_manifest(Members& members, const std::string& kind, const std::function<void(store::Manifest&)>& change) {
  for (Member& one : members) {
    if (!one.name.ends_with("manifest.json")) continue;
    store::Manifest manifest = store::parse_manifest(one.bytes, "manifest");
    if (manifest.header.kind != kind) continue;
    change(manifest);
    one.bytes = store::manifest_text(manifest);
    manifest.seal = store::seal_of(one.bytes, "manifest");
    const std::string folder = one.name.substr(0, one.name.rfind('/') + 1);
    for (Member& other : members) {
      if (other.name != folder + store::kDroppedFile) continue;
      std::vector<std::string> dropped;
      for (const store::FileEntry& file : manifest.files)
        if (file.path.ends_with(".vtkhdf") || file.path.ends_with(".xdmf")) dropped.push_back(file.path);
      other.bytes = store::dropped_text(manifest, dropped);
    }
  }
  list_again(members);
}

}  // namespace seapile::commands
