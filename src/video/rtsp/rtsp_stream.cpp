#include "video/rtsp/rtsp_stream.hpp"

#include <utility>

#include <gst/app/gstappsrc.h>

#include "video/rtsp/encoding.hpp"
#include "video/rtsp/owned.hpp"

namespace lapwing::video {

namespace {

/// The newest says how it is.
constexpr std::size_t most_news = 16;

}  // namespace

RtspStream::RtspStream(base::Loop& loop, std::function<void()> changed, double pictures_a_s)
    : changed_(std::move(changed)),
      pictures_a_s_(pictures_a_s),
      inbox_(loop, most_news, base::Overflow::drop_oldest),
      scope_(loop) {
  scope_.spawn(listen());
}

void RtspStream::mount(GstRTSPMountPoints* mounts, std::string const& path, std::string const& launch,
                       char const* role) const {
  auto* const factory = gst_rtsp_media_factory_new();  // the mounts own it
  gst_rtsp_media_factory_set_launch(factory, launch.c_str());
  gst_rtsp_media_factory_set_shared(factory, TRUE);
  gst_rtsp_media_factory_set_latency(factory, 0);
  gst_rtsp_media_factory_set_protocols(
      factory, static_cast<GstRTSPLowerTrans>(GST_RTSP_LOWER_TRANS_UDP | GST_RTSP_LOWER_TRANS_TCP));
  if (role != nullptr)
    gst_rtsp_media_factory_add_role(factory, role, GST_RTSP_PERM_MEDIA_FACTORY_ACCESS, G_TYPE_BOOLEAN, TRUE,
                                    GST_RTSP_PERM_MEDIA_FACTORY_CONSTRUCT, G_TYPE_BOOLEAN, TRUE, nullptr);
  connect(factory, "media-configure", G_CALLBACK(configured), inbox_.post());
  gst_rtsp_mount_points_add_factory(mounts, path.c_str(), factory);
}

void RtspStream::connect(gpointer object, char const* signal, GCallback callback, Post const& post) {
  g_signal_connect_data(
      object, signal, callback, new Post(post), [](gpointer kept, GClosure*) { delete static_cast<Post*>(kept); },
      static_cast<GConnectFlags>(0));
}

void RtspStream::configured(GstRTSPMediaFactory*, GstRTSPMedia* media, gpointer kept) {
  auto const& post = *static_cast<Post*>(kept);
  Owned<GstElement> const bin(gst_rtsp_media_get_element(media));
  std::shared_ptr<GstElement> source(gst_bin_get_by_name_recurse_up(GST_BIN(bin.get()), "pictures"), Unref());
  gst_rtsp_media_set_rate_control(media, FALSE);  // each picture goes when it is there
  connect(media, "unprepared", G_CALLBACK(unprepared), post);
  post({.media = media, .source = std::move(source)});
}

void RtspStream::unprepared(GstRTSPMedia* media, gpointer kept) {
  (*static_cast<Post*>(kept))({.media = media});
}

base::Task<> RtspStream::listen() {
  for (;;) {
    auto receiving = inbox_.receive(std::chrono::hours(1));
    auto news = co_await receiving;
    if (news) take(*std::move(news));
  }
}

void RtspStream::take(News news) {
  if (!news.source && news.media != media_) return;  // another one has begun since
  source_ = std::move(news.source);
  media_ = news.media;
  changed_();
}

void RtspStream::offer(RawPicture picture) {
  if (!source_) return;
  auto* const source = GST_APP_SRC(source_.get());
  gst_app_src_set_caps(source, caps_of(picture, pictures_a_s_).get());  // nothing happens where they are what they were
  gst_app_src_push_buffer(source, wrapped(std::move(picture.bytes)));
}

}  // namespace lapwing::video
