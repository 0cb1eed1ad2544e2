#include "mavlink/signing.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <span>

#include <openssl/evp.h>

namespace lapwing::mavlink {

namespace {

using Bytes = std::span<std::uint8_t const>;
using Digest = std::array<std::uint8_t, 32>;

constexpr std::size_t time_size = 6;
constexpr std::size_t proof_size = 6;  ///< the first bytes of the digest
constexpr std::uint32_t radio_status = 109;
constexpr SigningTime minute = 6'000'000;

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

SigningTime time_of(Frame const& frame) {
  SigningTime time = 0;
  for (std::size_t i = time_size; i > 0; --i) time = time << 8U | frame.signature[i];
  return time;
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

SigningTime signing_time(base::UtcTime time) {
  using Tick = std::chrono::duration<std::int64_t, std::ratio<1, 100'000>>;
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

SigningTime SigningGuard::tick(base::UtcTime now) const {
  return std::max(last_, signing_time(now));
}

void SigningGuard::sign(Frame& frame, std::uint8_t link_id, base::UtcTime now) {
  last_ = std::max(last_ + 1, signing_time(now));
  mavlink::sign(frame, key_, link_id, last_);
}

bool SigningGuard::accepts(Frame const& frame, base::UtcTime now) {
  if (!frame.is_signed()) {
    if (frame.message_id == radio_status) return true;
    ++counters_.unsigned_frames;
    return false;
  }
  if (!is_signed_with(frame, key_)) {
    ++counters_.wrong_key;
    return false;
  }
  auto const time = time_of(frame);
  auto const [sender, is_new] = heard_.try_emplace({frame.source, frame.signature[0]}, 0);
  bool const is_late = is_new ? time + minute < tick(now) : time <= sender->second;
  if (is_late) {
    if (is_new) heard_.erase(sender);
    ++counters_.replayed;
    return false;
  }
  sender->second = time;
  last_ = std::max(last_, time);
  ++counters_.accepted;
  return true;
}

}  // namespace lapwing::mavlink
