#define GST_USE_UNSTABLE_API  // webrtcbin's library says so of itself in all of its releases

#include "video/webrtc/webrtc_peer.hpp"

#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <gst/app/gstappsrc.h>
#include <gst/sdp/sdp.h>
#include <gst/video/video.h>
#include <gst/webrtc/webrtc.h>

namespace lapwing::video {

using base::ErrorKind;
using base::fail;
using Kind = PeerNews::Kind;
using namespace std::chrono_literals;

namespace {

/// What waits to be packed is old when it goes; packing takes microseconds.
constexpr guint64 most_waiting = 4;
constexpr auto told_each = 1s;
constexpr std::uint64_t rtp_ticks_a_s = 90'000;

/// A packet with all that is put round it passes through the tunnels that there are.
std::string pipeline_of(Offer const& offer, base::UtcTime epoch) {
  auto const since_1970 = std::chrono::duration_cast<std::chrono::seconds>(epoch.time_since_epoch());
  auto const rtp_epoch = static_cast<std::uint32_t>(static_cast<std::uint64_t>(since_1970.count()) * rtp_ticks_a_s);
  return fmt::format(
      "appsrc name=pictures is-live=true format=time max-buffers=0 max-bytes=0 "
      "caps=\"video/x-h264,stream-format=byte-stream,alignment=au,profile=constrained-baseline,level=(string)3.1\" ! "
      "rtph264pay pt={0} mtu=1200 config-interval=-1 aggregate-mode=zero-latency timestamp-offset={1} ! "
      "application/x-rtp,media=video,encoding-name=H264,payload={0} ! "
      "webrtcbin name=peer bundle-policy=max-bundle",
      offer.payload_type, rtp_epoch);
}

Owned<GstElement> part_of(GstElement* pipeline, char const* name) {
  return Owned<GstElement>(gst_bin_get_by_name(GST_BIN(pipeline), name));
}

struct UnrefPromise {
  void operator()(GstPromise* promise) const { gst_promise_unref(promise); }
};
using Promise = std::unique_ptr<GstPromise, UnrefPromise>;
struct FreeDescription {
  void operator()(GstWebRTCSessionDescription* one) const { gst_webrtc_session_description_free(one); }
};
using Description = std::unique_ptr<GstWebRTCSessionDescription, FreeDescription>;

/// What webrtcbin answers, on this thread; why not, where it says no.
template <class Argument>
base::Result<Promise> asked(GstElement* peer, char const* signal, Argument* argument) {
  Promise promise(gst_promise_new());
  g_signal_emit_by_name(peer, signal, argument, promise.get());
  auto const result = gst_promise_wait(promise.get());
  auto const* const reply = result == GST_PROMISE_RESULT_REPLIED ? gst_promise_get_reply(promise.get()) : nullptr;
  GError* error = nullptr;
  if (reply != nullptr && gst_structure_has_field(reply, "error"))
    gst_structure_get(reply, "error", G_TYPE_ERROR, &error, nullptr);
  std::string why = error != nullptr ? error->message : "";
  g_clear_error(&error);
  if (result != GST_PROMISE_RESULT_REPLIED) why = "it gives no answer";
  if (why.empty()) return promise;
  return fail(ErrorKind::io, fmt::format("GStreamer's webrtcbin, {}: {}", signal, why));
}

base::Result<Description> description_of(std::string const& sdp) {
  GstSDPMessage* message = nullptr;
  gst_sdp_message_new(&message);
  auto const* const bytes = reinterpret_cast<guint8 const*>(sdp.data());
  if (gst_sdp_message_parse_buffer(bytes, static_cast<guint>(sdp.size()), message) != GST_SDP_OK) {
    gst_sdp_message_free(message);
    return fail(ErrorKind::io, "GStreamer does not read an offer of ours");
  }
  return Description(gst_webrtc_session_description_new(GST_WEBRTC_SDP_TYPE_OFFER, message));
}

std::string local_description(GstElement* peer) {
  GstWebRTCSessionDescription* local = nullptr;
  g_object_get(peer, "local-description", &local, nullptr);
  Description const held(local);
  if (!held) return {};
  std::unique_ptr<gchar, decltype(&g_free)> const text(gst_sdp_message_as_text(held->sdp), &g_free);
  return text.get();
}

/// Errors are told, and nothing piles up unread.
GstBusSyncReply drop_message(GstBus*, GstMessage* message, gpointer tell) {
  if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR)
    (*static_cast<std::function<void(PeerNews)>*>(tell))({.kind = Kind::over, .text = "GStreamer has given up"});
  gst_message_unref(message);
  return GST_BUS_DROP;
}

GstPadProbeReturn hear_request(GstPad*, GstPadProbeInfo* info, gpointer tell) {
  if (gst_video_event_is_force_key_unit(GST_PAD_PROBE_INFO_EVENT(info)) != FALSE)
    (*static_cast<std::function<void(PeerNews)>*>(tell))({.kind = Kind::asks_whole});
  return GST_PAD_PROBE_OK;
}

struct Ear {
  std::function<void(PeerNews)>* tell;
  std::chrono::steady_clock::time_point* told;
};

GstPadProbeReturn hear(GstPad*, GstPadProbeInfo*, gpointer data) {
  auto const& ear = *static_cast<Ear*>(data);
  auto const now = std::chrono::steady_clock::now();
  if (now - *ear.told < told_each) return GST_PAD_PROBE_OK;
  *ear.told = now;
  (*ear.tell)({.kind = Kind::heard});
  return GST_PAD_PROBE_OK;
}

}  // namespace

base::Result<std::unique_ptr<WebRtcPeer>> WebRtcPeer::answer(Offer const& offer, Settings const& settings,
                                                             std::function<void(PeerNews)> tell) {
  std::unique_ptr<WebRtcPeer> peer(new WebRtcPeer(offer, settings, std::move(tell)));
  if (!peer->peer_)
    return fail(ErrorKind::io, "GStreamer's webrtcbin is not installed",
                "apt install gstreamer1.0-plugins-bad gstreamer1.0-nice (setup/packages-stream.txt)");
  peer->listen();
  peer->name_addresses(settings.address);
  peer->describe_video();
  gst_element_set_state(peer->pipeline_.get(), GST_STATE_PLAYING);
  if (auto const done = peer->negotiate(); !done) return std::unexpected(done.error());
  return peer;
}

WebRtcPeer::WebRtcPeer(Offer const& offer, Settings const& settings, std::function<void(PeerNews)> tell)
    : offer_(offer),
      epoch_(settings.epoch),
      tell_(std::move(tell)),
      pipeline_(gst_parse_launch(pipeline_of(offer, settings.epoch).c_str(), nullptr)) {
  if (!pipeline_ || !GST_IS_BIN(pipeline_.get())) return;
  source_ = part_of(pipeline_.get(), "pictures");
  peer_ = part_of(pipeline_.get(), "peer");
  // Reports of the sender compare RTP time with the clock: both count exposures and seconds since the epoch.
  Owned<GstClock> const clock(
      GST_CLOCK(g_object_new(GST_TYPE_SYSTEM_CLOCK, "clock-type", GST_CLOCK_TYPE_REALTIME, nullptr)));
  gst_pipeline_use_clock(GST_PIPELINE(pipeline_.get()), clock.get());
  gst_element_set_start_time(pipeline_.get(), GST_CLOCK_TIME_NONE);
  gst_element_set_base_time(pipeline_.get(),
                            static_cast<GstClockTime>(std::chrono::nanoseconds(epoch_.time_since_epoch()).count()));
}

WebRtcPeer::~WebRtcPeer() {
  if (pipeline_) gst_element_set_state(pipeline_.get(), GST_STATE_NULL);
}

void WebRtcPeer::listen() {
  auto const bus = Owned<GstBus>(gst_element_get_bus(pipeline_.get()));
  gst_bus_set_sync_handler(bus.get(), drop_message, &tell_, nullptr);
  auto const pad = Owned<GstPad>(gst_element_get_static_pad(source_.get(), "src"));
  gst_pad_add_probe(pad.get(), GST_PAD_PROBE_TYPE_EVENT_UPSTREAM, hear_request, &tell_, nullptr);
  auto const hear_it = +[](GstBin*, GstBin*, GstElement* part, gpointer self) {
    if (std::string_view(G_OBJECT_TYPE_NAME(part)) != "GstNiceSrc") return;
    auto& peer = *static_cast<WebRtcPeer*>(self);
    auto const source = Owned<GstPad>(gst_element_get_static_pad(part, "src"));
    gst_pad_add_probe(source.get(), GST_PAD_PROBE_TYPE_BUFFER, hear, new Ear{&peer.tell_, &peer.heard_},
                      [](gpointer ear) { delete static_cast<Ear*>(ear); });
  };
  g_signal_connect(pipeline_.get(), "deep-element-added", G_CALLBACK(hear_it), this);
  auto const gathered = +[](GstElement* peer, GParamSpec*, gpointer self) {
    GstWebRTCICEGatheringState state = GST_WEBRTC_ICE_GATHERING_STATE_NEW;
    g_object_get(peer, "ice-gathering-state", &state, nullptr);
    auto const& own = *static_cast<WebRtcPeer*>(self);
    if (state == GST_WEBRTC_ICE_GATHERING_STATE_COMPLETE)
      own.tell_({.kind = Kind::answered, .text = answer_to(own.offer_, local_description(peer))});
  };
  g_signal_connect(peer_.get(), "notify::ice-gathering-state", G_CALLBACK(gathered), this);
  auto const changed = +[](GstElement* peer, GParamSpec*, gpointer self) {
    GstWebRTCPeerConnectionState state = GST_WEBRTC_PEER_CONNECTION_STATE_NEW;
    g_object_get(peer, "connection-state", &state, nullptr);
    auto const& own = *static_cast<WebRtcPeer*>(self);
    if (state == GST_WEBRTC_PEER_CONNECTION_STATE_CONNECTED) own.tell_({.kind = Kind::connected});
    if (state == GST_WEBRTC_PEER_CONNECTION_STATE_FAILED || state == GST_WEBRTC_PEER_CONNECTION_STATE_CLOSED)
      own.tell_({.kind = Kind::over, .text = "the connection has ended"});
  };
  g_signal_connect(peer_.get(), "notify::connection-state", G_CALLBACK(changed), this);
}

/// Nobody outside is asked for an address of ours, no router for a port, and TCP is not offered: what is late there
/// keeps back what is new.
void WebRtcPeer::name_addresses(std::string const& address) const {
  GObject* ice = nullptr;
  g_object_get(peer_.get(), "ice-agent", &ice, nullptr);
  Owned<GObject> const held(ice);
  gboolean is_taken = FALSE;
  if (!address.empty()) g_signal_emit_by_name(ice, "add-local-ip-address", address.c_str(), &is_taken);
  GObject* agent = nullptr;
  g_object_get(ice, "agent", &agent, nullptr);
  Owned<GObject> const held_agent(agent);
  g_object_set(agent, "ice-tcp", FALSE, "upnp", FALSE, nullptr);
}

void WebRtcPeer::describe_video() const {
  GstWebRTCRTPTransceiver* video = nullptr;
  g_signal_emit_by_name(peer_.get(), "get-transceiver", 0, &video);
  Owned<GstWebRTCRTPTransceiver> const held(video);
  std::unique_ptr<GstCaps, UnrefCaps> const caps(gst_caps_from_string(
      fmt::format("application/x-rtp,media=video,encoding-name=H264,payload={},clock-rate=90000,"
                  "packetization-mode=(string)1,profile-level-id=(string)42e01f,level-asymmetry-allowed=(string)1,"
                  "rtcp-fb-nack-pli=(boolean)true,rtcp-fb-ccm-fir=(boolean)true",
                  offer_.payload_type)
          .c_str()));
  g_object_set(video, "direction", GST_WEBRTC_RTP_TRANSCEIVER_DIRECTION_SENDONLY, "codec-preferences", caps.get(),
               nullptr);
}

base::Result<> WebRtcPeer::negotiate() {
  auto const offered = description_of(text_of(offer_));
  if (!offered) return std::unexpected(offered.error());
  auto const set = asked(peer_.get(), "set-remote-description", offered->get());
  if (!set) return std::unexpected(set.error());
  auto const made = asked(peer_.get(), "create-answer", static_cast<GstStructure*>(nullptr));
  if (!made) return std::unexpected(made.error());
  GstWebRTCSessionDescription* local = nullptr;
  gst_structure_get(gst_promise_get_reply(made->get()), "answer", GST_TYPE_WEBRTC_SESSION_DESCRIPTION, &local, nullptr);
  Description const answer(local);
  if (!answer) return fail(ErrorKind::io, "GStreamer's webrtcbin makes no answer");
  auto const kept = asked(peer_.get(), "set-local-description", answer.get());
  return kept ? base::Result<>() : std::unexpected(kept.error());
}

bool WebRtcPeer::send(CodedPicture const& picture) {
  auto* const source = GST_APP_SRC(source_.get());
  if (gst_app_src_get_current_level_buffers(source) >= most_waiting) return false;
  auto* const buffer = gst_buffer_copy(picture.bytes.get());  // its bytes are shared
  auto const since = static_cast<GstClockTime>(std::chrono::nanoseconds(picture.taken - epoch_).count());
  GST_BUFFER_PTS(buffer) = since;
  GST_BUFFER_DTS(buffer) = since;
  gst_app_src_push_buffer(source, buffer);
  return true;
}

}  // namespace lapwing::video
