#include "mavlink/signing/signing.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <span>

#include <openssl/evp.h>

namespace lapwing::mavlink {

namespace {

using Bytes = std::span<std::uint8_t const>;
using Digest = std::array<std::uint8_t, 32>;
using Tick = std::chrono::duration<std::int64_t, std::ratio<1, 100'000>>;

constexpr std::size_t time_size = 6;
constexpr std::size_t proof_size = 6;  ///< the first bytes of the digest

/// Errors of OpenSSL here mean that memory has run out.
Digest sha256(std::initializer_list<Bytes> parts) {
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> const context(EVP_MD_CTX_new());
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) std::abort();
  for (auto const part : parts) EVP_DigestUpdate(context.get(), part.data(), part.size());
  Digest digest{};
  EVP_DigestFinal_ex(context.get(), digest.data(), nullptr);
  return digest;
}

/// Over the key and everything of the packet up to the proof itself.
Digest digest_of(SigningKey const& key, FrameBytes const& packet) {
  return sha256({key, packet.bytes().first(packet.bytes().size() - proof_size)});
}

/// Takes the same time wherever they differ, so that nobody learns the proof byte by byte.
bool equal(Bytes a, Bytes b) {
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned>(a[i] ^ b[i]);
  return difference == 0;
}

}  // namespace

SigningKey key_from_passphrase(std::string_view words) {
  return sha256({Bytes(reinterpret_cast<std::uint8_t const*>(words.data()), words.size())});
}

SigningTime signing_span(base::Duration duration) {
  return static_cast<SigningTime>(std::chrono::duration_cast<Tick>(duration).count());
}

SigningTime signing_time(base::UtcTime time) {
  constexpr std::chrono::sys_days epoch = std::chrono::year{2015} / std::chrono::January / 1;
  auto const ticks = std::chrono::duration_cast<Tick>(time - epoch).count();
  return ticks > 0 ? static_cast<SigningTime>(ticks) : 0;
}

void sign(Frame& frame, SigningKey const& key, std::uint8_t link_id, SigningTime time) {
  frame.version = 2;
  frame.incompat_flags |= 0x01U;
  frame.signature[0] = link_id;
  for (std::size_t i = 1; i <= time_size; ++i) frame.signature[i] = static_cast<std::uint8_t>(time >> 8U * (i - 1));
  auto const digest = digest_of(key, serialize(frame));
  std::copy_n(digest.begin(), proof_size, frame.signature.begin() + 1 + time_size);
}

bool is_signed_with(Frame const& frame, SigningKey const& key) {
  if (!frame.is_signed()) return false;
  auto const digest = digest_of(key, serialize_as_received(frame));
  return equal(Bytes(digest).first(proof_size), Bytes(frame.signature).last(proof_size));
}

SigningTime time_of_signature(Frame const& frame) {
  SigningTime time = 0;
  for (std::size_t i = time_size; i > 0; --i) time = time << 8U | frame.signature[i];
  return time;
}

bool tells_a_key(std::uint32_t message_id) {
  constexpr std::uint32_t setup_signing = 256;
  return message_id == setup_signing;
}

}  // namespace lapwing::mavlink
