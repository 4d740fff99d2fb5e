#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // OpenSSL's

namespace seapile::store {

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// 64 lower-case hex digits; nothing may be added after it.
  std::string hex();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// SHA-256 of a text, 64 lower-case hex digits.
std::string sha256(std::string_view text);

/// SHA-256 of a file's bytes, as `sha256sum` prints it. Throws StoreError::io.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace seapile::store
