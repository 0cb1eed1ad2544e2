#include "host/files/key_file.hpp"

#include <sys/random.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "base/files/replace_file.hpp"
#include "host/files/secret_file.hpp"
#include "mavlink/signing/key_store.hpp"

namespace lapwing::host {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t shortest_passphrase = 12;
constexpr base::Duration write_period = 10s;

std::string time_file_of(std::string const& path) {
  return path + ".time";
}

/// What no earlier run has written is zero.
base::Result<mavlink::SigningTime> read_time(std::string const& path) {
  constexpr mavlink::SigningTime latest = (1ULL << 48U) - 1;
  std::ifstream file(path);
  if (!file) return 0;
  std::string text;
  std::getline(file, text);
  mavlink::SigningTime time = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error == std::errc() && end == text.data() + text.size() && time < latest) return time;
  return base::fail(base::ErrorKind::invalid_input, fmt::format("{}: this is no time of a signature", path),
                    "if this machine's clock is right, remove the file");
}

bool is_store(std::string_view text) {
  return text.starts_with("[keys]") || text.contains("\n[keys]");
}

SecretFile secret_of(std::string const& path) {
  return {path, "signing key", fmt::format("make one: lapwing signing new NAME --keys {}", path)};
}

base::Result<mavlink::KeyRing> ring_from(std::string const& path, std::string const& text) {
  if (is_store(text)) return mavlink::parse_key_store(path, text);
  if (auto const key = mavlink::parse_key(text)) return mavlink::ring_of(*key);
  if (text.size() < shortest_passphrase)
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("signing key {}: a pass phrase has at least {} characters", path, shortest_passphrase),
        secret_of(path).hint);
  return mavlink::ring_of(mavlink::key_from_passphrase(text));
}

}  // namespace

base::Result<SigningSetup> read_signing(std::string const& path) {
  if (path.empty()) return SigningSetup{};
  auto const text = read_secret(secret_of(path));
  if (!text) return std::unexpected(text.error());
  auto ring = ring_from(path, *text);
  if (!ring) return std::unexpected(ring.error());
  auto const time = read_time(time_file_of(path));
  if (!time) return std::unexpected(time.error());
  return SigningSetup{.ring = *std::move(ring), .signed_until = *time, .time_file = time_file_of(path)};
}

base::Result<mavlink::KeyRing> read_key_store(std::string const& path) {
  auto const text = read_secret({path, "key store", fmt::format("make one: lapwing signing new NAME --keys {}", path)});
  if (!text) return std::unexpected(text.error());
  if (!is_store(*text))
    return base::fail(base::ErrorKind::invalid_input, fmt::format("key store {}: it has no table [keys]", path),
                      "a single key is taken over with: lapwing signing new NAME --keys STORE --import FILE");
  return mavlink::parse_key_store(path, *text);
}

base::Result<> write_key_store(std::string const& path, mavlink::KeyRing const& ring) {
  return base::replace_file(path, to_text(ring), base::Readers::owner);
}

base::Result<mavlink::SigningKey> random_key() {
  mavlink::SigningKey key{};
  if (::getrandom(key.data(), key.size(), 0) == static_cast<ssize_t>(key.size())) return key;
  return base::fail(base::ErrorKind::io, fmt::format("no random numbers: {}", std::strerror(errno)));
}

SigningTimeKeeper::SigningTimeKeeper(base::Loop& loop, std::function<mavlink::SigningTime()> signed_until,
                                     std::string file, base::Logger log)
    : loop_(loop), signed_until_(std::move(signed_until)), file_(std::move(file)), log_(std::move(log)), scope_(loop) {
  if (!file_.empty()) scope_.spawn(keep());
}

SigningTimeKeeper::~SigningTimeKeeper() {
  if (!file_.empty()) write(signed_until_());
}

base::Task<> SigningTimeKeeper::keep() {
  for (;;) {
    auto const now = mavlink::signing_time(loop_.utc_now());
    write(std::max(now, signed_until_()) + mavlink::signing_span(write_period));
    co_await loop_.sleep(write_period);
  }
}

/// Another program with the same key may have come further.
void SigningTimeKeeper::write(mavlink::SigningTime time) {
  if (auto const there = read_time(file_); there && *there != written_) time = std::max(time, *there);
  written_ = time;
  auto const text = fmt::format("{}\n", time);
  auto const done = base::replace_file(file_, text, base::Readers::owner);
  if (done || std::exchange(has_warned_, true)) return;
  log_.warn(done.error().message + "; after a restart with a wrong clock vehicles may not listen");
}

}  // namespace lapwing::host
