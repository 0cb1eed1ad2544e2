#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include "base/error.hpp"
#include "base/log.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::host {

/// Everything that goes over the links of a connection, kept in a telemetry log from construction to destruction.
///
/// What was seen is on disk a second later at the most, so a crash or a pulled plug costs no more than that. When the
/// disk refuses, the recording ends with a word in the log; whatever flies, flies on.
class Recording {
 public:
  /// Makes `folder` where it is missing, and in it a file named by the time: `2026-11-21T10-12-52Z.tlog`. Errors: io.
  /// `connection` outlives the recording.
  [[nodiscard]] static base::Result<std::unique_ptr<Recording>> begin(std::filesystem::path const& folder,
                                                                      mavlink::Connection& connection,
                                                                      base::Logger log);
  ~Recording();
  Recording(Recording const&) = delete;
  Recording& operator=(Recording const&) = delete;

  [[nodiscard]] std::filesystem::path const& file() const { return path_; }
  /// Of what belongs to this recording: the same name with another extension.
  [[nodiscard]] std::string beside(std::string_view extension) const;

 private:
  Recording(std::filesystem::path path, mavlink::Connection& connection, base::Logger log);
  void take(mavlink::Frame const& frame, base::TimePoint at);
  void write();

  std::filesystem::path path_;
  mavlink::Connection& connection_;
  base::Logger log_;
  std::ofstream out_;
  std::vector<std::uint8_t> pending_;
  base::TimePoint written_at_{};
};

/// Of the option --record.
inline constexpr auto record_help = "Keep everything that goes over the links in a new .tlog file of this folder";

/// The recording that `place` names: the file itself, or the youngest of a folder. Errors: not_found.
[[nodiscard]] base::Result<std::filesystem::path> find_recording(std::filesystem::path const& place);

}  // namespace lapwing::host
