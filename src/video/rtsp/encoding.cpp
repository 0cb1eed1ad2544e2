#include "video/rtsp/encoding.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "video/rtsp/owned.hpp"

namespace lapwing::video {

namespace {

constexpr auto encoder = "x264enc";
/// Who has lost a picture sees again after so long.
constexpr double group_s = 2.0;

}  // namespace

/// Zero latency: neither the encoder nor what packs holds back a picture for the ones behind it. Sides are
/// even, as the profile that every player knows demands.
std::string h264_encoding(EncodingSettings const& settings) {
  return fmt::format(
      "appsrc name=pictures is-live=true format=time do-timestamp={} max-buffers=1 max-bytes=0 "
      "leaky-type=downstream ! videoconvertscale ! "
      "video/x-raw,format=I420,width=[2,4096,2],height=[2,4096,2] ! "
      "{} name=encoder tune=zerolatency speed-preset=ultrafast threads=1 bitrate={} key-int-max={} "
      "min-force-key-unit-interval=500000000 ! video/x-h264,profile=constrained-baseline",
      settings.is_stamped_on_entry, encoder, settings.kbit_a_s,
      static_cast<unsigned>(std::ceil(group_s * settings.pictures_a_s)));
}

base::Result<> find_encoder() {
  gst_init(nullptr, nullptr);
  Owned<GstElementFactory> const found(gst_element_factory_find(encoder));
  if (found) return {};
  return base::fail(base::ErrorKind::io, "GStreamer's encoder for H.264 is not installed",
                    "apt install gstreamer1.0-plugins-ugly (setup/packages-stream.txt)");
}

GstBuffer* wrapped(std::shared_ptr<std::string const> picture) {
  auto const size = picture->size();
  auto* const bytes = const_cast<char*>(picture->data());  // read only, as the flag says
  auto* const kept = new std::shared_ptr<std::string const>(std::move(picture));
  return gst_buffer_new_wrapped_full(GST_MEMORY_FLAG_READONLY, bytes, size, 0, size, kept, [](gpointer held) {
    delete static_cast<std::shared_ptr<std::string const>*>(held);
  });
}

std::unique_ptr<GstCaps, UnrefCaps> caps_of(RawPicture const& picture, double pictures_a_s) {
  auto const rate = std::max(1, static_cast<int>(std::ceil(pictures_a_s)));
  return std::unique_ptr<GstCaps, UnrefCaps>(
      gst_caps_new_simple("video/x-raw", "format", G_TYPE_STRING, "BGRx", "width", G_TYPE_INT, picture.width, "height",
                          G_TYPE_INT, picture.height, "framerate", GST_TYPE_FRACTION, rate, 1, nullptr));
}

}  // namespace lapwing::video
