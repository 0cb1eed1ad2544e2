#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "link/pictures/picture_client.hpp"
#include "video/rtsp/rtsp_server.hpp"

namespace lapwing::apps {

/// The views of a drone's camera, in the order of their numbers at the server; and their paths there.
inline constexpr std::array relayed_views{link::pictures::View::raw, link::pictures::View::annotated};
[[nodiscard]] std::vector<std::string> relayed_paths();

/// Asks for a view's pictures as long as somebody looks at it, and hands them on, the newest each time. That none come,
/// or torn ones, is said and waited out. Both ends outlive it.
class PictureRelay {
 public:
  PictureRelay(base::Loop& loop, video::RtspServer& server, link::pictures::Source source, base::Logger log);
  PictureRelay(PictureRelay const&) = delete;
  PictureRelay& operator=(PictureRelay const&) = delete;

 private:
  base::Task<> serve(std::size_t path);
  base::Task<> hand_on(std::size_t path, link::pictures::PictureClient& pictures);
  void note(std::size_t path, std::string const& fault);

  base::Loop& loop_;
  video::RtspServer& server_;
  link::pictures::Source source_;
  base::Logger log_;
  std::array<std::string, relayed_views.size()> faults_;  ///< that were said last; empty: pictures come
  base::Scope scope_;
};

}  // namespace lapwing::apps
