#include "apps/onboard/stream_config.hpp"

#include "host/files/secret_file.hpp"

namespace lapwing::apps {

std::optional<StreamConfig> read_stream(base::ConfigReader& root, std::filesystem::path const& beside) {
  auto table = root.table("stream");
  if (!table) return std::nullopt;
  StreamConfig config;
  auto& serve = config.serve;
  if (auto const pictures = table->number("pictures_a_s", 0.2, 60.0)) config.pictures_a_s = pictures->value;
  if (auto const address = table->text("address")) serve.address = address->value;
  if (auto const port = table->integer("port", 0, 65535)) serve.port = static_cast<std::uint16_t>(port->value);
  if (auto const most = table->integer("most_viewers", 1, 64))
    serve.most_viewers = static_cast<std::size_t>(most->value);
  if (auto const file = table->text("token_file")) config.token_file = beside / file->value;
  table->refuse("token", "keep it in a file of its own (mode 0600): token_file = \"camera.token\"");
  table->refuse_unknown();
  return config;
}

base::Result<std::string> stream_token(std::filesystem::path const& file) {
  return host::read_secret(
      {.path = file.string(), .what = "token file", .hint = "make one: openssl rand -hex 32 > FILE; chmod 600 FILE"});
}

}  // namespace lapwing::apps
