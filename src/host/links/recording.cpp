#include "host/links/recording.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "mavlink/wire/tlog.hpp"

namespace lapwing::host {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t largest_pending = 1 << 16;
constexpr base::Duration longest_pending = std::chrono::seconds(1);
constexpr std::string_view extension = ".tlog";

/// A name that no file has yet. Colons of a time are left out: not every file system takes them.
fs::path fresh_path(fs::path const& folder, base::UtcTime now) {
  auto const name = fmt::format("{:%Y-%m-%dT%H-%M-%S}Z", std::chrono::floor<std::chrono::seconds>(now));
  auto path = folder / (name + std::string(extension));
  for (int i = 2; fs::exists(path); ++i) path = folder / fmt::format("{}-{}{}", name, i, extension);
  return path;
}

base::Error io_error(fs::path const& path, std::string_view what) {
  return {base::ErrorKind::io, fmt::format("{}: {}", path.string(), what), "is the folder writable, the disk full?"};
}

}  // namespace

base::Result<std::unique_ptr<Recording>> Recording::begin(fs::path const& folder, mavlink::Connection& connection,
                                                          base::Logger log) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return std::unexpected(io_error(folder, error.message()));
  std::unique_ptr<Recording> recording(
      new Recording(fresh_path(folder, connection.loop().utc_now()), connection, std::move(log)));
  if (!recording->out_) return std::unexpected(io_error(recording->path_, std::strerror(errno)));
  return recording;
}

Recording::Recording(fs::path path, mavlink::Connection& connection, base::Logger log)
    : path_(std::move(path)), connection_(connection), log_(std::move(log)), out_(path_, std::ios::binary) {
  connection_.set_frame_hook(
      [this](mavlink::Connection::Direction, mavlink::Frame const& frame, base::TimePoint at) { take(frame, at); });
}

Recording::~Recording() {
  connection_.set_frame_hook({});
  write();
}

std::string Recording::beside(std::string_view other) const {
  return fs::path(path_).replace_extension(other).string();
}

void Recording::take(mavlink::Frame const& frame, base::TimePoint at) {
  if (!out_) return;
  mavlink::append_tlog(pending_, connection_.loop().utc_now(), frame);
  if (pending_.size() >= largest_pending || at - written_at_ >= longest_pending) {
    write();
    written_at_ = at;
  }
}

void Recording::write() {
  out_.write(reinterpret_cast<char const*>(pending_.data()), static_cast<std::streamsize>(pending_.size()));
  out_.flush();
  if (!out_ && !pending_.empty()) {
    log_.error(fmt::format("the recording {} ends here: {}", path_.string(), std::strerror(errno)));
  }
  pending_.clear();
}

base::Result<fs::path> find_recording(fs::path const& place) {
  std::error_code error;
  if (fs::is_regular_file(place, error)) return place;
  if (!fs::is_directory(place, error)) {
    return base::fail(base::ErrorKind::not_found, fmt::format("{}: no such file or folder", place.string()));
  }
  fs::path youngest;
  for (auto const& entry : fs::directory_iterator(place, error)) {
    if (entry.path().extension() == extension) youngest = std::max(youngest, entry.path());
  }
  if (!youngest.empty()) return youngest;
  return base::fail(
      base::ErrorKind::not_found, fmt::format("{}: there is no recording in it", place.string()),
      "run, demo and station make them with --record DIR; other programs' .tlog files can be played, too");
}

}  // namespace lapwing::host
