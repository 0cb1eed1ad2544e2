#pragma once

#include <memory>
#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/async/side_thread.hpp"
#include "explore/lot/lot_sight.hpp"
#include "link/pictures/picture_server.hpp"

namespace lapwing::perceive {

/// The picture with the cars and slots that were found in it, and when it was taken; `sight` may be null: nothing was.
[[nodiscard]] cv::Mat with_findings(cv::Mat const& picture, base::UtcTime taken, explore::LotSight const* sight);

/// What the camera sees, for people who look: JPEG is made once a picture, on a thread of its own, and only while
/// somebody looks. Who sees waits for none of it; a picture that comes while the one before is being made takes the
/// place of what waits.
class LiveView {
 public:
  /// `loop` outlives it. Error: that of `PictureServer::open`.
  [[nodiscard]] static base::Result<std::unique_ptr<LiveView>> open(base::Loop& loop,
                                                                    link::pictures::ServeSettings const& settings);
  LiveView(LiveView const&) = delete;
  LiveView& operator=(LiveView const&) = delete;

  void show(cv::Mat picture, base::UtcTime taken);
  void show(cv::Mat picture, base::UtcTime taken, std::optional<explore::LotSight> sight);
  [[nodiscard]] bool is_watched(link::pictures::View view) const { return server_->is_watched(view); }
  [[nodiscard]] bool is_watched() const;
  [[nodiscard]] std::uint16_t port() const { return server_->port(); }

 private:
  struct Shown {
    cv::Mat picture;
    base::UtcTime taken;
    std::optional<explore::LotSight> sight = {};
  };
  struct Pen {};

  LiveView(base::Loop& loop, std::unique_ptr<link::pictures::PictureServer> server);
  void put(link::pictures::View view, std::optional<Shown>& place, Shown shown);
  base::Task<> work();
  base::Task<> make(link::pictures::View view, Shown shown);

  std::unique_ptr<link::pictures::PictureServer> server_;
  std::optional<Shown> raw_;
  std::optional<Shown> annotated_;
  base::Notifier came_;
  base::SideThread<Pen> pen_;
  base::Scope scope_;
};

}  // namespace lapwing::perceive
