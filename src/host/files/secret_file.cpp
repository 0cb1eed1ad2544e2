#include "host/files/secret_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

namespace lapwing::host {

namespace {

constexpr std::size_t longest_secret = 64U << 10U;

std::string trimmed(std::string_view text) {
  constexpr auto blanks = " \t\r\n";
  auto const first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(blanks) + 1 - first));
}

}  // namespace

/// From one open file, so that what was looked at is what is read.
base::Result<std::string> read_secret(SecretFile const& file) {
  auto const fail = [&](base::ErrorKind kind, std::string const& why, std::string hint = {}) {
    return base::fail(kind, fmt::format("{} {}: {}", file.what, file.path, why), std::move(hint));
  };
  int const descriptor = ::open(file.path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    auto const kind = errno == ENOENT ? base::ErrorKind::not_found : base::ErrorKind::io;
    return fail(kind, std::strerror(errno), file.hint);
  }
  struct Closer {
    int descriptor;
    ~Closer() { ::close(descriptor); }
  } const closer{descriptor};
  struct stat about{};
  if (::fstat(descriptor, &about) != 0 || !S_ISREG(about.st_mode))
    return fail(base::ErrorKind::invalid_input, "not a file");
  if ((about.st_mode & 077u) != 0) {
    return fail(base::ErrorKind::invalid_input, fmt::format("others can read it (mode {:04o})", about.st_mode & 07777u),
                "chmod 600 " + file.path);
  }
  std::array<char, longest_secret> bytes{};
  auto const size = ::read(descriptor, bytes.data(), bytes.size());
  if (size < 0) return fail(base::ErrorKind::io, std::strerror(errno));
  return trimmed({bytes.data(), static_cast<std::size_t>(size)});
}

}  // namespace lapwing::host
