#include "apps/stream/video_config.hpp"

#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "apps/onboard/stream_config.hpp"
#include "base/config.hpp"
#include "link/operator_link/carrier/tcp.hpp"

namespace lapwing::apps {

using base::config_kinds::invalid_value;

namespace {

/// Of what is missing: it has no place of its own.
constexpr base::Span beginning{0, 1};

/// Where a program of this machine reaches what listens there.
std::string reached_at(std::string const& address) {
  if (address == "0.0.0.0") return "127.0.0.1";
  return address == "::" ? "::1" : address;
}

/// What both kinds of video have in common.
template <class Settings>
void read_common(base::ConfigReader& table, Settings& settings) {
  constexpr int most = 64;
  constexpr int least_kbit_a_s = 100;
  constexpr int most_kbit_a_s = 20'000;
  if (auto const address = table.text("address")) settings.address = address->value;
  if (auto const viewers = table.integer("most_viewers", 1, most))
    settings.most_viewers = static_cast<unsigned>(viewers->value);
  if (auto const rate = table.integer("kbit_a_s", least_kbit_a_s, most_kbit_a_s))
    settings.kbit_a_s = static_cast<unsigned>(rate->value);
  table.refuse("token_file", "viewers need the token of the pictures: [stream] token_file");
}

void read_port(base::ConfigReader& table, std::uint16_t& port) {
  if (auto const told = table.integer("port", 0, std::numeric_limits<std::uint16_t>::max()))
    port = static_cast<std::uint16_t>(told->value);
}

void read_rtsp(base::ConfigReader& root, VideoConfig& config) {
  auto table = root.table("rtsp");
  if (!table) return;
  auto& rtsp = config.rtsp.emplace();
  read_common(*table, rtsp);
  read_port(*table, rtsp.port);
  table->refuse_unknown();
}

void read_webrtc(base::ConfigReader& root, VideoConfig& config) {
  auto table = root.table("webrtc");
  if (!table) return;
  auto& webrtc = config.webrtc.emplace();
  read_common(*table, webrtc.settings);
  read_port(*table, webrtc.port);
  table->refuse_unknown();
}

/// Who reaches it needs to know something.
void want_token(std::string_view table, std::string const& address, base::Diagnostics& diagnostics) {
  if (link::operator_link::is_loopback(address)) return;
  diagnostics.report(invalid_value, beginning,
                     fmt::format("other machines reach {}: whoever is on the network would see the pictures", address),
                     fmt::format("name a token_file under [stream], or keep [{}] address = \"127.0.0.1\"", table));
}

}  // namespace

VideoConfig read_video_config(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  auto const tree = base::parse_config(source, diagnostics);
  base::ConfigReader root(tree, diagnostics);
  VideoConfig config;
  read_rtsp(root, config);
  read_webrtc(root, config);
  if (!root.has("rtsp") && !root.has("webrtc"))
    diagnostics.report(invalid_value, beginning, "nothing is to be served", "[rtsp] or [webrtc], which may be empty");
  auto const stream = read_stream(root, std::filesystem::path(source.name()).parent_path());
  if (!stream) {
    if (!root.has("stream"))
      diagnostics.report(invalid_value, beginning, "there are no pictures to be handed on",
                         "[stream], which may be empty, has perceive offer them");
    return config;
  }
  if (stream->serve.port == 0)
    diagnostics.report(invalid_value, beginning, "the pictures have no port that others know", "[stream] port = 3080");
  config.pictures = {.host = reached_at(stream->serve.address), .port = stream->serve.port};
  config.token_file = stream->token_file;
  if (config.rtsp) config.rtsp->pictures_a_s = stream->pictures_a_s;
  if (config.webrtc) config.webrtc->settings.pictures_a_s = stream->pictures_a_s;
  if (!config.token_file.empty()) return config;
  if (config.rtsp) want_token("rtsp", config.rtsp->address, diagnostics);
  if (config.webrtc) want_token("webrtc", config.webrtc->settings.address, diagnostics);
  return config;
}

}  // namespace lapwing::apps
