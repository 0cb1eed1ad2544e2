#include "apps/stream/rtsp_config.hpp"

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

}  // namespace

RtspConfig read_rtsp_config(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  auto const tree = base::parse_config(source, diagnostics);
  base::ConfigReader root(tree, diagnostics);
  RtspConfig config;
  if (auto table = root.table("rtsp")) {
    if (auto const address = table->text("address")) config.rtsp.address = address->value;
    if (auto const port = table->integer("port", 0, 65535)) config.rtsp.port = static_cast<std::uint16_t>(port->value);
    if (auto const most = table->integer("most_viewers", 1, 64))
      config.rtsp.most_viewers = static_cast<unsigned>(most->value);
    if (auto const rate = table->integer("kbit_a_s", 100, 20'000))
      config.rtsp.kbit_a_s = static_cast<unsigned>(rate->value);
    table->refuse("token_file", "viewers need the token of the pictures: [stream] token_file");
    table->refuse_unknown();
  } else if (!root.has("rtsp")) {
    diagnostics.report(invalid_value, beginning, "nothing is to be served", "[rtsp], which may be empty");
  }
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
  config.rtsp.pictures_a_s = stream->pictures_a_s;
  if (config.token_file.empty() && !link::operator_link::is_loopback(config.rtsp.address))
    diagnostics.report(
        invalid_value, beginning,
        fmt::format("other machines reach {}: whoever is on the network would see the pictures", config.rtsp.address),
        "name a token_file under [stream], or keep [rtsp] address = \"127.0.0.1\"");
  return config;
}

}  // namespace lapwing::apps
