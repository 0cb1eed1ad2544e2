#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "link/pictures/picture_client.hpp"
#include "video/rtsp/rtsp_server.hpp"
#include "video/webrtc/webrtc_server.hpp"

namespace lapwing::apps {

/// The views of a drone's camera, in the order of their numbers at the server; and their paths there.
inline constexpr std::array relayed_views{link::pictures::View::raw, link::pictures::View::annotated};
[[nodiscard]] std::vector<std::string> relayed_paths();
/// The same without their slashes.
[[nodiscard]] std::vector<std::string> view_names();

/// Who shows them on; null where it does not. They outlive the relay.
struct Outlets {
  video::RtspServer* rtsp = nullptr;
  video::WebRtcServer* webrtc = nullptr;
};

/// Asks for a view's pictures as long as somebody looks at it, and hands them on, the newest each time. That none come,
/// or torn ones, is said and waited out.
class PictureRelay {
 public:
  PictureRelay(base::Loop& loop, Outlets outlets, link::pictures::Source source, base::Logger log);
  PictureRelay(PictureRelay const&) = delete;
  PictureRelay& operator=(PictureRelay const&) = delete;

 private:
  base::Task<> serve(std::size_t path);
  base::Task<> hand_on(std::size_t path, link::pictures::PictureClient& pictures);
  template <class Server>
  base::Task<> pass_on_changes(Server& server);
  [[nodiscard]] bool is_watched(std::size_t path) const;
  void show(std::size_t path, video::RawPicture const& picture, base::UtcTime taken);
  void note(std::size_t path, std::string const& fault);

  base::Loop& loop_;
  Outlets outlets_;
  base::Notifier changed_;  ///< somebody has begun to look, or nobody does any more
  link::pictures::Source source_;
  base::Logger log_;
  std::array<std::string, relayed_views.size()> faults_;  ///< that were said last; empty: pictures come
  base::Scope scope_;
};

}  // namespace lapwing::apps
