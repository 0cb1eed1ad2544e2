#include "video/webrtc/video_encoder.hpp"

#include <utility>

#include <fmt/format.h>
#include <gst/app/gstappsink.h>
#include <gst/app/gstappsrc.h>
#include <gst/video/video.h>

namespace lapwing::video {

namespace {

Owned<GstElement> part_of(GstElement* pipeline, char const* name) {
  return Owned<GstElement>(gst_bin_get_by_name(GST_BIN(pipeline), name));
}

}  // namespace

VideoEncoder::VideoEncoder(EncodingSettings const& settings, base::UtcTime epoch,
                           std::function<void(CodedPicture)> made)
    : pictures_a_s_(settings.pictures_a_s),
      epoch_(epoch),
      made_(std::move(made)),
      pipeline_(gst_parse_launch(
          fmt::format("{},stream-format=byte-stream,alignment=au ! appsink name=coded sync=false async=false",
                      h264_encoding(settings))
              .c_str(),
          nullptr)),
      source_(part_of(pipeline_.get(), "pictures")),
      encoder_(part_of(pipeline_.get(), "encoder")) {
  auto const coded = part_of(pipeline_.get(), "coded");
  GstAppSinkCallbacks calls{};
  calls.new_sample = [](GstAppSink* sink, gpointer encoder) { return take(GST_ELEMENT(sink), encoder); };
  gst_app_sink_set_callbacks(GST_APP_SINK(coded.get()), &calls, this, nullptr);
  gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
}

VideoEncoder::~VideoEncoder() {
  gst_element_set_state(pipeline_.get(), GST_STATE_NULL);
}

void VideoEncoder::show(RawPicture picture, base::UtcTime taken) {
  auto* const source = GST_APP_SRC(source_.get());
  gst_app_src_set_caps(source, caps_of(picture, pictures_a_s_).get());  // nothing happens where they are what they were
  auto* const buffer = wrapped(std::move(picture.bytes));
  GST_BUFFER_PTS(buffer) = static_cast<GstClockTime>(std::chrono::nanoseconds(taken - epoch_).count());
  gst_app_src_push_buffer(source, buffer);
}

void VideoEncoder::ask_for_whole_picture() {
  gst_element_send_event(encoder_.get(), gst_video_event_new_upstream_force_key_unit(GST_CLOCK_TIME_NONE, TRUE, 0));
}

GstFlowReturn VideoEncoder::take(GstElement* sink, gpointer encoder) {
  auto const& self = *static_cast<VideoEncoder const*>(encoder);
  auto* const sample = gst_app_sink_pull_sample(GST_APP_SINK(sink));
  if (sample == nullptr) return GST_FLOW_EOS;
  auto* const buffer = gst_sample_get_buffer(sample);
  // The encoder counts from another beginning than its source, and says from which.
  auto const since =
      gst_segment_to_running_time(gst_sample_get_segment(sample), GST_FORMAT_TIME, GST_BUFFER_PTS(buffer));
  self.made_({.bytes = std::shared_ptr<GstBuffer>(gst_buffer_ref(buffer), UnrefBuffer()),
              .taken = self.epoch_ + std::chrono::nanoseconds(since),
              .stands_alone = !GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT)});
  gst_sample_unref(sample);
  return GST_FLOW_OK;
}

}  // namespace lapwing::video
