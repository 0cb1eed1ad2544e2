#include "map/store/blobs/sha256.hpp"

#include <array>

#include <openssl/evp.h>

#include "base/assert.hpp"

namespace lapwing::map::blobs {

std::string sha256(std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::array<unsigned char, 32> digest = {};
  unsigned size = 0;
  int const done = EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  LAPWING_ASSERT(done == 1 && size == digest.size());
  std::string hex;
  hex.reserve(2 * digest.size());
  for (unsigned const byte : digest) {
    hex += digits[byte >> 4U];
    hex += digits[byte & 15U];
  }
  return hex;
}

}  // namespace lapwing::map::blobs
