#include "map/store/place/address.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "map/store/sql/postgres.hpp"

namespace lapwing::map::place {

namespace {

namespace fs = std::filesystem;
using base::ErrorKind;

std::string holder_of(int descriptor) {
  char text[32] = {};
  auto const read = ::pread(descriptor, text, sizeof(text) - 1, 0);
  return read > 0 ? std::string(text, static_cast<std::size_t>(read)) : std::string("another one");
}

}  // namespace

Address::Address(std::string text)
    : text_(std::move(text)), is_server_(text_.starts_with("postgresql://") || text_.starts_with("postgres://")) {}

std::string Address::name() const {
  auto const at = text_.find('@');
  auto const user = text_.find("://");
  if (!is_server_ || at == std::string::npos) return text_;
  auto const colon = text_.find(':', user + 3);
  if (colon == std::string::npos || colon > at) return text_;
  return text_.substr(0, colon) + text_.substr(at);
}

base::Result<FolderLock> FolderLock::take(Address const& address) {
  std::error_code fault;
  fs::create_directories(address.folder(), fault);
  if (fault)
    return base::fail(ErrorKind::io, fmt::format("{}: {}", address.name(), fault.message()),
                      "name a folder that may be written to");
  auto const file = address.folder() / "lock";
  int const descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0)
    return base::fail(ErrorKind::io, fmt::format("{}: {}", file.string(), std::strerror(errno)),
                      "name a folder that may be written to");
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    auto refused = base::fail(
        ErrorKind::refused,
        fmt::format("{}: another program writes to this store (process {})", address.name(), holder_of(descriptor)),
        "end it, or keep this one's map elsewhere; several stations can share a postgresql:// store");
    ::close(descriptor);
    return refused;
  }
  auto const process = std::to_string(::getpid());
  // Only for that message: the lock holds without.
  if (::ftruncate(descriptor, 0) == 0) (void)!::pwrite(descriptor, process.data(), process.size(), 0);
  return FolderLock(descriptor);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

base::Result<std::unique_ptr<sql::Database>> open_database(Address const& address, sql::Access access) {
  if (address.is_server()) return sql::open_postgres(address.text(), address.name(), access);
  if (access == sql::Access::read && !fs::exists(address.database()))
    return base::fail(ErrorKind::not_found, fmt::format("{}: there is no store in this folder", address.name()),
                      "name the folder that `station --store` was given");
  return sql::open_sqlite(address.database(), access);
}

std::unique_ptr<blobs::Bytes> open_bytes(Address const& address, sql::Database& database) {
  return address.is_server() ? blobs::in_table(database) : blobs::in_folder(address.pictures());
}

std::optional<std::uint64_t> free_bytes(Address const& address) {
  struct statvfs disk = {};
  if (address.is_server() || ::statvfs(address.folder().c_str(), &disk) != 0) return std::nullopt;
  return std::uint64_t{disk.f_bavail} * disk.f_frsize;
}

}  // namespace lapwing::map::place
