#include "runner/study/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace seapile::study {
namespace {

std::string reason(int error) { return std::system_category().message(error); }

/// Closes what was open for reading, where a close cannot lose anything.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

std::optional<std::string> read_text(const std::filesystem::path& file, std::size_t most_bytes, std::string& trouble) {
  // O_NONBLOCK: opening a FIFO would otherwise wait for its writer.
  const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
  if (descriptor.number < 0) {
    trouble = fmt::format("cannot be read: {}", reason(errno));
    return {};
  }
  struct stat status {};
  if (::fstat(descriptor.number, &status) != 0) {
    trouble = fmt::format("cannot be read: {}", reason(errno));
    return {};
  }
  if (!S_ISREG(status.st_mode)) {
    trouble = S_ISDIR(status.st_mode) ? "is a directory, not a file" : "is not a regular file";
    return {};
  }

  std::string bytes;
  while (bytes.size() <= most_bytes) {
    const std::size_t had = bytes.size();
    bytes.resize(std::min(had + (std::size_t{1} << 20), most_bytes + 1));
    const ssize_t got = ::read(descriptor.number, bytes.data() + had, bytes.size() - had);
    if (got < 0 && errno == EINTR) {
      bytes.resize(had);
      continue;
    }
    if (got < 0) {
      trouble = fmt::format("cannot be read: {}", reason(errno));
      return {};
    }
    bytes.resize(had + static_cast<std::size_t>(got));
    if (got == 0) return bytes;
  }
  trouble = fmt::format("is larger than {} MiB", most_bytes >> 20);
  return {};
}

std::optional<std::filesystem::path> path_below(const std::filesystem::path& folder, const std::string& relative,
                                                std::string& trouble) {
  const std::filesystem::path path(relative);
  if (path.is_absolute()) {
    trouble = "is an absolute path";
    return {};
  }
  if (std::find(path.begin(), path.end(), "..") != path.end()) {
    trouble = "leaves the study's folder through \"..\"";
    return {};
  }
  std::error_code error;
  const auto root = std::filesystem::canonical(folder.empty() ? "." : folder, error);
  const auto real = error ? root : std::filesystem::canonical(root / path, error);
  if (error) {
    trouble = fmt::format("cannot be read: {}", error.message());
    return {};
  }
  if (std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end()) {
    trouble = "leaves the study's folder through a symbolic link";
    return {};
  }
  return real;
}

}  // namespace seapile::study
