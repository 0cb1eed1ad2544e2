#pragma once

#include <memory>
#include <string>

#include <gst/gst.h>

#include "base/error.hpp"
#include "video/rtsp/jpeg.hpp"

namespace lapwing::video {

struct EncodingSettings {
  unsigned kbit_a_s = 2000;
  double pictures_a_s = 10.0;       ///< at most, about
  bool is_stamped_on_entry = true;  ///< otherwise pictures bring their time
};

/// The part of a pipeline that makes H.264, constrained baseline, of raw pictures: from its source, `pictures`, to its
/// encoder, `encoder`. Of pictures that wait to be encoded the newest takes the place of the one before.
[[nodiscard]] std::string h264_encoding(EncodingSettings const& settings);

/// Error: io, what encodes is not installed. GStreamer is ready afterwards.
[[nodiscard]] base::Result<> find_encoder();

/// It has the bytes for as long as GStreamer needs them.
[[nodiscard]] GstBuffer* wrapped(std::shared_ptr<std::string const> picture);

struct UnrefCaps {
  void operator()(GstCaps* caps) const { gst_caps_unref(caps); }
};
/// With a rate: without one x264 keeps each picture until the next one has come, to know how long it lasts.
[[nodiscard]] std::unique_ptr<GstCaps, UnrefCaps> caps_of(RawPicture const& picture, double pictures_a_s);

}  // namespace lapwing::video
