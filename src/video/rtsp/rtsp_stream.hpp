#pragma once

#include <functional>
#include <memory>
#include <string>

#include <gst/rtsp-server/rtsp-server.h>

#include "base/async/inbox.hpp"
#include "base/async/scope.hpp"
#include "video/rtsp/jpeg.hpp"

namespace lapwing::video {

/// One path of an RTSP server. GStreamer makes its pipeline when the first player comes, shares it among all of them,
/// and lets go of it after the last. Thread-bound to its loop, which outlives it.
class RtspStream {
 public:
  /// `changed`: somebody has begun to look, or nobody does any more.
  RtspStream(base::Loop& loop, std::function<void()> changed, double pictures_a_s);
  RtspStream(RtspStream const&) = delete;
  RtspStream& operator=(RtspStream const&) = delete;

  /// `launch` names its source of raw pictures `pictures`. `role` may look; null: everybody.
  void mount(GstRTSPMountPoints* mounts, std::string const& path, std::string const& launch, char const* role) const;
  [[nodiscard]] bool is_watched() const { return source_ != nullptr; }
  /// Where one waits to be encoded, it takes its place.
  void offer(RawPicture picture);

 private:
  /// A pipeline has been made, or is no more: from threads of GStreamer's, which may be slower to end than this.
  struct News {
    GstRTSPMedia const* media = nullptr;  ///< only compared
    std::shared_ptr<GstElement> source = {};
  };
  using Post = base::Inbox<News>::Post;

  static void connect(gpointer object, char const* signal, GCallback callback, Post const& post);
  static void configured(GstRTSPMediaFactory* factory, GstRTSPMedia* media, gpointer post);
  static void unprepared(GstRTSPMedia* media, gpointer post);
  base::Task<> listen();
  void take(News news);

  std::function<void()> changed_;
  double pictures_a_s_;
  std::shared_ptr<GstElement> source_;
  GstRTSPMedia const* media_ = nullptr;
  base::Inbox<News> inbox_;
  base::Scope scope_;
};

}  // namespace lapwing::video
