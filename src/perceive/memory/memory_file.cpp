#include "perceive/memory/memory_file.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

namespace lapwing::perceive {

namespace fs = std::filesystem;

namespace {

/// Clocks are set by the network or by GPS, a moment after the start.
constexpr base::Duration ahead = std::chrono::minutes(1);

base::Result<std::string> content_of(fs::path const& file) {
  std::error_code error;
  auto const size = fs::file_size(file, error);
  if (error) return base::fail(base::ErrorKind::io, error.message());
  if (size > longest_memory) return base::fail(base::ErrorKind::invalid_input, "it is too long for a survey");
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) return base::fail(base::ErrorKind::io, "it cannot be read");
  return text;
}

Recalled put_aside(fs::path const& file, std::string const& why) {
  auto aside = file;
  aside += ".unread";
  std::error_code error;
  fs::rename(file, aside, error);
  return {.words = fmt::format("the map of before is not taken up, {}: {}; it begins empty{}", file.string(), why,
                               error ? "" : fmt::format(", and the file is {} now", aside.filename().string())),
          .is_fault = true};
}

Recalled left_alone(std::string const& why) {
  return {.words = fmt::format("the map of before is not taken up: {}; it begins empty", why)};
}

}  // namespace

Recalled recall(fs::path const& file, geo::Site const& site, base::UtcTime now, base::Duration lasts) {
  std::error_code error;
  if (lasts <= base::Duration::zero() || !fs::exists(file, error)) return {};
  auto const text = content_of(file);
  if (!text) return put_aside(file, text.error().message);
  auto memory = read_memory(*text, site);
  if (!memory) return put_aside(file, memory.error().message);
  if (memory->at > now + ahead) return left_alone("it was written later than now, by this machine's clock");
  auto const oldest = now - std::chrono::duration_cast<base::UtcTime::duration>(lasts);
  double const age_s = base::to_seconds(now - memory->at);
  if (memory->at < oldest) return left_alone(fmt::format("it is {:.0f} s old", age_s));
  std::erase_if(memory->sights, [&](auto const& sight) { return sight.at < oldest || sight.at > now + ahead; });
  auto words = fmt::format("the map of {:.1f} s ago is taken up: {} slots, {} sights", age_s, memory->slots.size(),
                           memory->sights.size());
  return {.memory = *std::move(memory), .words = std::move(words)};
}

}  // namespace lapwing::perceive
