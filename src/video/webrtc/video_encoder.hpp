#pragma once

#include <functional>
#include <memory>

#include <gst/gst.h>

#include "base/time.hpp"
#include "video/rtsp/encoding.hpp"
#include "video/rtsp/owned.hpp"

namespace lapwing::video {

struct UnrefBuffer {
  void operator()(GstBuffer* buffer) const { gst_buffer_unref(buffer); }
};
/// One picture as H.264, shared by all whom it is sent to.
struct CodedPicture {
  std::shared_ptr<GstBuffer> bytes = {};
  base::UtcTime taken{};
  bool stands_alone = false;  ///< needs none of those before it
};

/// Makes H.264 of pictures, the newest first, on a thread of GStreamer's.
class VideoEncoder {
 public:
  /// `made` is called on that thread, in the pictures' order. Pictures are younger than `epoch`.
  VideoEncoder(EncodingSettings const& settings, base::UtcTime epoch, std::function<void(CodedPicture)> made);
  ~VideoEncoder();
  VideoEncoder(VideoEncoder const&) = delete;
  VideoEncoder& operator=(VideoEncoder const&) = delete;

  /// Each was taken later than the one before. Where one waits to be encoded, it takes its place.
  void show(RawPicture picture, base::UtcTime taken);
  /// The next one stands alone, unless one has within half a second.
  void ask_for_whole_picture();

 private:
  static GstFlowReturn take(GstElement* sink, gpointer encoder);

  double pictures_a_s_;
  base::UtcTime epoch_;
  std::function<void(CodedPicture)> made_;
  Owned<GstElement> pipeline_;
  Owned<GstElement> source_;
  Owned<GstElement> encoder_;
};

}  // namespace lapwing::video
