#include "runner/store/sealed_text.h"

#include <string_view>

#include "runner/store/sha256.h"
#include "runner/store/store_error.h"

namespace seapile::store {

namespace {

constexpr std::string_view kSealHead = ",\n  \"seal\": \"";
constexpr std::string_view kSealTail = "\"\n}\n";
constexpr std::size_t kDigestDigits = 64;

[[noreturn]] void damaged(const std::filesystem::path& where, const std::string& what) {
  throw StoreError(StoreError::Kind::damaged, where.string() + " is damaged: " + what);
}

/// The document before the seal. Nothing is parsed before the seal has been found to hold.
std::string_view sealed_part(const std::string& text, const std::filesystem::path& where) {
  const std::size_t tail = kSealHead.size() + kDigestDigits + kSealTail.size();
  if (text.size() < tail) damaged(where, "it is too short");
  const std::string_view sealed = std::string_view(text).substr(0, text.size() - tail);
  if (text.substr(sealed.size()) != std::string(kSealHead) + sha256(sealed) + std::string(kSealTail)) {
    damaged(where, "its seal is not that of its text");
  }
  return sealed;
}

}  // namespace

std::string with_seal(std::string object) {
  object.resize(object.rfind("\n}"));
  return object + std::string(kSealHead) + sha256(object) + std::string(kSealTail);
}

std::string unsealed(const std::string& text, const std::filesystem::path& where) {
  return std::string(sealed_part(text, where)) + "}";
}

std::string seal_of(const std::string& text, const std::filesystem::path& where) {
  return sha256(sealed_part(text, where));
}

}  // namespace seapile::store
