#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <gst/app/gstappsink.h>
#include <gst/gst.h>

#include "video/rtsp/owned.hpp"

namespace lapwing::video::testing {

inline Owned<GstElement> launched(std::string const& description) {
  gst_init(nullptr, nullptr);
  return Owned<GstElement>(gst_parse_launch(description.c_str(), nullptr));
}

inline Owned<GstElement> part_of(GstElement* pipeline, char const* name) {
  return Owned<GstElement>(gst_bin_get_by_name(GST_BIN(pipeline), name));
}

/// Calls `use` with the bytes of a sample, and lets go of it.
template <class Use>
auto with_bytes(GstSample* sample, Use use) {
  auto* const buffer = gst_sample_get_buffer(sample);
  GstMapInfo map;
  gst_buffer_map(buffer, &map, GST_MAP_READ);
  auto result = use(map.data, map.size);
  gst_buffer_unmap(buffer, &map);
  gst_sample_unref(sample);
  return result;
}

/// A picture of one grey, 0 black to 255 white.
inline std::shared_ptr<std::string const> grey_jpeg(unsigned grey, int width = 320, int height = 240) {
  auto const pipeline = launched(
      fmt::format("videotestsrc num-buffers=1 pattern=solid-color foreground-color=0xff{0:02x}{0:02x}{0:02x} ! "
                  "video/x-raw,width={1},height={2} ! jpegenc ! appsink name=out",
                  grey, width, height));
  auto const out = part_of(pipeline.get(), "out");
  gst_element_set_state(pipeline.get(), GST_STATE_PLAYING);
  auto jpeg = with_bytes(gst_app_sink_pull_sample(GST_APP_SINK(out.get())), [](guint8 const* data, gsize size) {
    return std::make_shared<std::string const>(reinterpret_cast<char const*>(data), size);
  });
  gst_element_set_state(pipeline.get(), GST_STATE_NULL);
  return jpeg;
}

/// A player of GStreamer's, which knows nothing of who serves.
class Player {
 public:
  struct As {
    std::string protocols = "tcp";
    std::string password = {};
  };
  Player(std::uint16_t port, std::string const& path) : Player(port, path, As()) {}
  Player(std::uint16_t port, std::string const& path, As const& as)
      : pipeline_(launched(
            fmt::format("rtspsrc location=rtsp://127.0.0.1:{}{} latency=0 protocols={} user-id=viewer user-pw=\"{}\" ! "
                        "rtph264depay ! h264parse ! openh264dec ! appsink name=out sync=false max-buffers=1 drop=true",
                        port, path, as.protocols, as.password))),
        out_(part_of(pipeline_.get(), "out")) {
    gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
  }
  Player(Player const&) = delete;
  Player& operator=(Player const&) = delete;
  ~Player() { gst_element_set_state(pipeline_.get(), GST_STATE_NULL); }

  /// How bright the newest picture is, 0 to 255; nothing where none has come since.
  std::optional<double> brightness() {
    auto* const sample = gst_app_sink_try_pull_sample(GST_APP_SINK(out_.get()), 0);
    if (sample == nullptr) return std::nullopt;
    auto const* const caps = gst_caps_get_structure(gst_sample_get_caps(sample), 0);
    gst_structure_get_int(caps, "width", &width_);
    return with_bytes(sample, [](guint8 const* data, gsize size) {
      auto const pixels = size * 2 / 3;  // of brightness; those of colour lie behind
      return std::accumulate(data, data + pixels, 0.0) / static_cast<double>(pixels);
    });
  }
  [[nodiscard]] int width() const { return width_; }

  /// Why it has given up; empty: it has not.
  std::string fault() {
    std::unique_ptr<GstBus, Unref> const bus(gst_element_get_bus(pipeline_.get()));
    auto* const message = gst_bus_pop_filtered(bus.get(), GST_MESSAGE_ERROR);
    if (message == nullptr) return fault_;
    GError* error = nullptr;
    gst_message_parse_error(message, &error, nullptr);
    fault_ = error->message;
    g_error_free(error);
    gst_message_unref(message);
    return fault_;
  }

 private:
  Owned<GstElement> pipeline_;
  Owned<GstElement> out_;
  int width_ = 0;
  std::string fault_;
};

}  // namespace lapwing::video::testing
