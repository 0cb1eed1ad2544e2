#include "base/files/replace_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>

#include "base/descriptor.hpp"

namespace lapwing::base {

namespace {

namespace fs = std::filesystem;

/// False when not all of it is on the disk; errno says why.
bool write_new(fs::path const& path, std::string_view content, Readers readers) {
  // What an earlier process has left may be open to others still.
  (void)::unlink(path.c_str());
  auto const rights = readers == Readers::owner ? 0600 : 0644;
  Descriptor const file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, rights));
  return file.is_open() && file.write_all(content) && ::fsync(file.get()) == 0;
}

bool sync_folder_of(fs::path const& path) {
  auto const folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  Descriptor const opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.is_open() && ::fsync(opened.get()) == 0;
}

}  // namespace

Result<> replace_file(fs::path const& path, std::string_view content, Readers readers) {
  auto const cannot = [&](int why) {
    bool const is_full = why == ENOSPC || why == EDQUOT;
    return fail(ErrorKind::io, fmt::format("{}: cannot write: {}", path.string(), std::strerror(why)),
                is_full ? "make room on that disk" : "");
  };
  auto fresh = path;
  fresh += ".part";
  if (!write_new(fresh, content, readers) || std::rename(fresh.c_str(), path.c_str()) != 0) {
    int const why = errno;
    (void)::unlink(fresh.c_str());
    return cannot(why);
  }
  if (!sync_folder_of(path)) return cannot(errno);
  return {};
}

}  // namespace lapwing::base
