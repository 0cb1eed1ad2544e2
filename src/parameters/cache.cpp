#include "parameters/cache.hpp"

#include <charconv>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "base/files/replace_file.hpp"
#include "parameters/parameter_file.hpp"

namespace lapwing::parameters {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view taken_line = "# Lapwing cache, taken (seconds since 1970): ";
constexpr std::string_view hash_line = "# Lapwing cache, hash: ";
constexpr std::uintmax_t largest_file = 4U << 20U;

template <class T>
std::optional<T> number_after(std::string_view text, std::string_view label, int base) {
  auto const at = text.find(label);
  if (at == std::string_view::npos) return std::nullopt;
  auto const digits = text.substr(at + label.size());
  T value{};
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  bool const is_line = error == std::errc() && end != digits.data() + digits.size() && *end == '\n';
  return is_line ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string to_text(CachedParameters const& cached) {
  auto const seconds = std::chrono::duration_cast<std::chrono::seconds>(cached.taken.time_since_epoch()).count();
  auto text = fmt::format("{}{}\n", taken_line, seconds);
  if (cached.hash) text += fmt::format("{}{:08x}\n", hash_line, *cached.hash);
  return text + qgroundcontrol_text(cached.parameters, {});
}

std::optional<CachedParameters> parse_cached(std::string_view text) {
  // A clock that was never set counts from 1970; the year 9999 is the last that the type holds.
  constexpr std::int64_t latest = 9'000'000'000;
  auto const seconds = number_after<std::int64_t>(text, taken_line, 10);
  if (!seconds || *seconds < 0 || *seconds > latest) return std::nullopt;
  auto file = read_parameter_file("cache", text);
  if (!file || !file->has_types) return std::nullopt;
  return CachedParameters{.parameters = std::move(file->parameters),
                          .taken = base::UtcTime{std::chrono::seconds(*seconds)},
                          .hash = number_after<std::uint32_t>(text, hash_line, 16)};
}

fs::path Cache::file_of(Identity const& identity) const {
  return folder_ / fmt::format("{}-{:08x}-{}.params", identity.uid, identity.firmware, identity.custom_version);
}

std::optional<CachedParameters> Cache::find(Identity const& identity) const {
  if (folder_.empty() || identity.uid.empty()) return std::nullopt;
  auto const path = file_of(identity);
  std::error_code error;
  if (auto const size = fs::file_size(path, error); error || size > largest_file) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  return parse_cached(std::string(std::istreambuf_iterator<char>(file), {}));
}

base::Result<> Cache::store(Identity const& identity, CachedParameters const& cached) const {
  if (folder_.empty() || identity.uid.empty()) return {};
  auto const path = file_of(identity);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    return base::fail(base::ErrorKind::io, fmt::format("{}: cannot write: {}", path.string(), error.message()));
  return base::replace_file(path, to_text(cached));
}

fs::path cache_folder(char const* xdg_cache_home, char const* home) {
  // Relative paths are to be ignored: XDG Base Directory Specification.
  if (xdg_cache_home && *xdg_cache_home == '/') return fs::path(xdg_cache_home) / "lapwing/parameters";
  if (home && *home == '/') return fs::path(home) / ".cache/lapwing/parameters";
  return {};
}

}  // namespace lapwing::parameters
