#include "video/rtsp/rtsp_server.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <gio/gio.h>
#include <gst/gst.h>
#include <gst/rtsp-server/rtsp-server.h>
#include <gst/video/video.h>
#include <boost/asio/ip/address.hpp>

#include "base/async/side_thread.hpp"
#include "video/rtsp/encoding.hpp"
#include "video/rtsp/owned.hpp"
#include "video/rtsp/rtsp_stream.hpp"

namespace lapwing::video {

using base::ErrorKind;
using base::fail;

namespace {

constexpr auto user = "viewer";
/// Connections that have not begun to look are no viewers; there may be some more of them.
constexpr unsigned connections_a_viewer = 4;
/// A player whose network has gone keeps its place for so long. Players say at half that time that they are there.
constexpr guint session_s = 30;
constexpr guint cleanup_s = 5;
/// What waits in the kernel is old when it comes: some 2 s over TCP, so that a radio may stutter.
constexpr int kernel_bytes = 256 * 1024;
/// Of a connection that has begun to look.
constexpr auto looks = "lapwing-looks";

std::string pipeline(RtspSettings const& settings) {
  return fmt::format("( {} ! rtph264pay name=pay0 pt=96 config-interval=-1 aggregate-mode=zero-latency )",
                     h264_encoding({.kbit_a_s = settings.kbit_a_s, .pictures_a_s = settings.pictures_a_s}));
}

bool is_loopback(std::string const& address) {
  boost::system::error_code fault;
  auto const parsed = boost::asio::ip::make_address(address, fault);
  return fault ? address == "localhost" : parsed.is_loopback();
}

/// The token is not sent as it is (digest, RFC 2617); the pictures are.
Owned<GstRTSPAuth> guard(std::string const& token) {
  Owned<GstRTSPAuth> auth(gst_rtsp_auth_new());
  gst_rtsp_auth_set_supported_methods(auth.get(), GST_RTSP_AUTH_DIGEST);
  gst_rtsp_auth_set_realm(auth.get(), "lapwing");
  auto* const role = gst_rtsp_token_new(GST_RTSP_TOKEN_MEDIA_FACTORY_ROLE, G_TYPE_STRING, user, nullptr);
  gst_rtsp_auth_add_digest(auth.get(), user, token.c_str(), role);
  gst_rtsp_token_unref(role);
  return auth;
}

// What GStreamer calls, on threads of its own.

/// Whose place is gone, because it is lost, was too slow or has left, is told so by the end of its connection.
GstRTSPFilterResult end_without_session(GstRTSPServer*, GstRTSPClient* client, gpointer) {
  if (g_object_get_data(G_OBJECT(client), looks) == nullptr) return GST_RTSP_FILTER_KEEP;
  auto* const sessions = gst_rtsp_client_session_filter(client, nullptr, nullptr);
  bool const has_none = sessions == nullptr;
  g_list_free_full(sessions, g_object_unref);
  return has_none ? GST_RTSP_FILTER_REMOVE : GST_RTSP_FILTER_KEEP;
}

gboolean forget_lost_viewers(gpointer server) {
  Owned<GstRTSPSessionPool> const sessions(gst_rtsp_server_get_session_pool(GST_RTSP_SERVER(server)));
  gst_rtsp_session_pool_cleanup(sessions.get());
  g_list_free_full(gst_rtsp_server_client_filter(GST_RTSP_SERVER(server), end_without_session, nullptr),
                   g_object_unref);
  return G_SOURCE_CONTINUE;
}

/// The pool's own limit ends the process (GStreamer 1.22: what was not made is freed).
GstRTSPStatusCode refuse_when_full(GstRTSPClient* client, GstRTSPContext* context, gpointer most) {
  Owned<GstRTSPSessionPool> const sessions(gst_rtsp_client_get_session_pool(client));
  bool const is_full = gst_rtsp_session_pool_get_n_sessions(sessions.get()) >= GPOINTER_TO_UINT(most);
  return context->session == nullptr && is_full ? GST_RTSP_STS_SERVICE_UNAVAILABLE : GST_RTSP_STS_OK;
}

void begin_session(GstRTSPClient* client, GstRTSPSession* session, gpointer) {
  g_object_set_data(G_OBJECT(client), looks, client);
  gst_rtsp_session_set_timeout(session, session_s);
}

/// Who comes begins with a picture that stands alone, instead of waiting for the next one.
void ask_for_whole_picture(GstRTSPClient*, GstRTSPContext* context, gpointer) {
  if (context->media == nullptr) return;
  gst_rtsp_media_set_rate_control(context->media, FALSE);  // what it was before, the request has undone
  Owned<GstElement> const bin(gst_rtsp_media_get_element(context->media));
  Owned<GstElement> const made_by(gst_bin_get_by_name_recurse_up(GST_BIN(bin.get()), "encoder"));
  if (made_by)
    gst_element_send_event(made_by.get(), gst_video_event_new_upstream_force_key_unit(GST_CLOCK_TIME_NONE, TRUE, 0));
}

void take_in(GstRTSPServer* server, GstRTSPClient* client, gpointer most_viewers) {
  auto* const all = gst_rtsp_server_client_filter(server, nullptr, nullptr);
  auto const count = g_list_length(all);
  g_list_free_full(all, g_object_unref);
  if (count > connections_a_viewer * GPOINTER_TO_UINT(most_viewers)) return gst_rtsp_client_close(client);
  auto* const socket = gst_rtsp_connection_get_write_socket(gst_rtsp_client_get_connection(client));
  g_socket_set_option(socket, SOL_SOCKET, SO_SNDBUF, kernel_bytes, nullptr);
  g_signal_connect(client, "pre-setup-request", G_CALLBACK(refuse_when_full), most_viewers);
  g_signal_connect(client, "new-session", G_CALLBACK(begin_session), nullptr);
  g_signal_connect(client, "play-request", G_CALLBACK(ask_for_whole_picture), nullptr);
}

gboolean stop_turning(gpointer turns) {
  g_main_loop_quit(static_cast<GMainLoop*>(turns));
  return G_SOURCE_REMOVE;
}

}  // namespace

class RtspServer::Core {
 public:
  Core(base::Loop& loop, RtspSettings settings, std::vector<std::string> const& paths)
      : settings_(std::move(settings)), changed_(loop) {
    thread_.emplace(loop, std::make_unique<Hand>());
    Owned<GstRTSPMountPoints> const mounts(gst_rtsp_server_get_mount_points(server_.get()));
    auto const* const role = settings_.token.empty() ? nullptr : user;
    for (auto const& path : paths) {
      streams_.push_back(std::make_unique<RtspStream>(loop, [this] { changed_.notify_all(); }, settings_.pictures_a_s));
      streams_.back()->mount(mounts.get(), path, pipeline(settings_), role);
    }
  }

  /// Players are told that it is over.
  ~Core() {
    attach(g_idle_source_new(), stop_turning, turns_.get());
    thread_.reset();  // when it has stopped
    drop(gst_rtsp_session_pool_filter(
        sessions_.get(), [](GstRTSPSessionPool*, GstRTSPSession*, gpointer) { return GST_RTSP_FILTER_REMOVE; },
        nullptr));
    drop(gst_rtsp_server_client_filter(
        server_.get(), [](GstRTSPServer*, GstRTSPClient*, gpointer) { return GST_RTSP_FILTER_REMOVE; }, nullptr));
    while (g_main_context_iteration(context_.get(), FALSE) != FALSE) continue;
  }
  Core(Core const&) = delete;
  Core& operator=(Core const&) = delete;

  base::Result<> serve() {
    auto* const server = server_.get();
    gst_rtsp_server_set_address(server, settings_.address.c_str());
    gst_rtsp_server_set_service(server, std::to_string(settings_.port).c_str());
    gst_rtsp_server_set_session_pool(server, sessions_.get());
    if (!settings_.token.empty()) gst_rtsp_server_set_auth(server, guard(settings_.token).get());
    // One thread for each: who waits for a camera's first picture holds nobody else up.
    Owned<GstRTSPThreadPool> const threads(gst_rtsp_thread_pool_new());
    gst_rtsp_thread_pool_set_max_threads(threads.get(),
                                         static_cast<int>(connections_a_viewer * settings_.most_viewers));
    gst_rtsp_server_set_thread_pool(server, threads.get());
    g_signal_connect(server, "client-connected", G_CALLBACK(take_in), GUINT_TO_POINTER(settings_.most_viewers));

    GError* error = nullptr;
    auto* const source = gst_rtsp_server_create_source(server, nullptr, &error);
    if (source == nullptr) {
      std::string const why = error != nullptr ? error->message : "it cannot be listened at";
      g_clear_error(&error);
      return fail(ErrorKind::io, fmt::format("rtsp://{}:{}: {}", settings_.address, settings_.port, why),
                  "choose another port, or an address of this machine: [rtsp] port and address");
    }
    attach(source);
    attach(g_timeout_source_new_seconds(cleanup_s), forget_lost_viewers, server);
    thread_->give([turns = turns_.get()](Hand&) { g_main_loop_run(turns); });
    return {};
  }

  [[nodiscard]] std::uint16_t port() const {
    return static_cast<std::uint16_t>(std::max(0, gst_rtsp_server_get_bound_port(server_.get())));
  }
  [[nodiscard]] RtspStream& stream(std::size_t path) const { return *streams_.at(path); }
  [[nodiscard]] base::Notifier& changed() { return changed_; }

 private:
  struct Hand {};

  void attach(GSource* source) {
    g_source_attach(source, context_.get());
    g_source_unref(source);
  }
  void attach(GSource* source, GSourceFunc function, gpointer data) {
    g_source_set_callback(source, function, data, nullptr);
    attach(source);
  }
  static void drop(GList* objects) { g_list_free_full(objects, g_object_unref); }

  RtspSettings settings_;
  base::Notifier changed_;
  std::vector<std::unique_ptr<RtspStream>> streams_;
  std::unique_ptr<GMainContext, decltype(&g_main_context_unref)> context_{g_main_context_new(), &g_main_context_unref};
  std::unique_ptr<GMainLoop, decltype(&g_main_loop_unref)> turns_{g_main_loop_new(context_.get(), FALSE),
                                                                  &g_main_loop_unref};
  Owned<GstRTSPSessionPool> sessions_{gst_rtsp_session_pool_new()};
  Owned<GstRTSPServer> server_{gst_rtsp_server_new()};
  std::optional<base::SideThread<Hand>> thread_;
};

base::Result<std::unique_ptr<RtspServer>> RtspServer::open(base::Loop& loop, RtspSettings const& settings,
                                                           std::vector<std::string> const& paths) {
  if (settings.token.empty() && !is_loopback(settings.address))
    return fail(
        ErrorKind::invalid_input,
        fmt::format("other machines reach {}: whoever is on the network would see the pictures", settings.address),
        "name a token_file under [stream], or keep address = \"127.0.0.1\"");
  if (auto found = find_encoder(); !found) return std::unexpected(found.error());
  auto core = std::make_unique<Core>(loop, settings, paths);
  if (auto served = core->serve(); !served) return std::unexpected(served.error());
  return std::unique_ptr<RtspServer>(new RtspServer(std::move(core)));
}

RtspServer::RtspServer(std::unique_ptr<Core> core) : core_(std::move(core)) {}
RtspServer::~RtspServer() = default;

std::uint16_t RtspServer::port() const {
  return core_->port();
}
bool RtspServer::is_watched(std::size_t path) const {
  return core_->stream(path).is_watched();
}
base::Notifier& RtspServer::watching_changed() {
  return core_->changed();
}
void RtspServer::offer(std::size_t path, RawPicture picture) {
  core_->stream(path).offer(std::move(picture));
}

}  // namespace lapwing::video
