#include "host/survey/survey_link.hpp"

#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "host/files/secret_file.hpp"

namespace lapwing::host {

namespace wire = link::operator_link;
using base::ConfigReader;
using base::Diagnostics;
using base::config_kinds::invalid_value;

base::Result<wire::ConnectSettings> parse_survey(std::string_view text) {
  auto const colon = text.rfind(':');
  wire::ConnectSettings settings;
  settings.host = std::string(text.substr(0, colon));
  bool is_sound = !settings.host.empty() && !settings.host.contains('/');
  if (colon != std::string_view::npos) {
    auto const port = text.substr(colon + 1);
    auto const [end, fault] = std::from_chars(port.data(), port.data() + port.size(), settings.port);
    is_sound = is_sound && fault == std::errc{} && end == port.data() + port.size() && settings.port > 0;
  }
  if (is_sound) return settings;
  return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' is no operator link of a survey drone", text),
                    fmt::format("HOST:PORT, as 127.0.0.1:{}", wire::default_port));
}

base::Result<> add_survey_links(std::vector<std::string> const& texts, std::vector<SurveyLink>& links) {
  for (auto const& text : texts) {
    auto settings = parse_survey(text);
    if (!settings) return std::unexpected(settings.error());
    links.push_back({.name = fmt::format("drone{}", links.size() + 1), .settings = *std::move(settings)});
  }
  return {};
}

namespace {

void read_tls(ConfigReader& table, base::SourceFile const& source, Diagnostics& diagnostics,
              std::optional<wire::TlsClientSettings>& tls) {
  auto const beside = [&source](std::string const& path) {
    return std::filesystem::path(source.name()).parent_path() / path;
  };
  auto const authority = table.text("authority");
  auto const certificate = table.text("certificate");
  auto const key = table.text("key");
  if (!authority && (certificate || key))
    diagnostics.report(invalid_value, certificate ? certificate->span : key->span,
                       "TLS needs to know who has signed the drone's certificate", "authority = \"FILE.pem\"");
  if (certificate.has_value() != key.has_value())
    diagnostics.report(invalid_value, certificate ? certificate->span : key->span,
                       "a certificate and its key go together", "name both files, in PEM");
  if (!authority) return;
  tls = wire::TlsClientSettings{.authority = beside(authority->value)};
  if (certificate) tls->certificate = beside(certificate->value);
  if (key) tls->key = beside(key->value);
}

struct Told {
  char const* key;
  char const* what;
  std::uint16_t port;
};
void read_source(ConfigReader& table, Told const& told, Diagnostics& diagnostics,
                 std::optional<link::pictures::Source>& source) {
  auto const text = table.text(told.key);
  if (!text) return;
  if (auto const read = parse_survey(text->value))
    source = link::pictures::Source{.host = read->host, .port = read->port};
  else
    diagnostics.report(invalid_value, text->span, fmt::format("'{}' is no address of {}", text->value, told.what),
                       fmt::format("{} = \"127.0.0.1:{}\"", told.key, told.port));
}

}  // namespace

SurveyLink read_survey(base::Placed<ConfigReader>& table, base::SourceFile const& source, Diagnostics& diagnostics) {
  SurveyLink link;
  auto& reader = table.value;
  auto const address = reader.text("address");
  if (!address && !reader.has("address"))
    diagnostics.report(invalid_value, table.span, "a survey drone needs an address", "address = \"127.0.0.1:3000\"");
  if (address) {
    auto settings = parse_survey(address->value);
    if (settings)
      link.settings = *std::move(settings);
    else
      diagnostics.report(invalid_value, address->span, settings.error().message, settings.error().hint);
  }
  read_source(reader, {.key = "camera", .what = "a camera", .port = link::pictures::default_port}, diagnostics,
              link.camera);
  read_source(reader, {.key = "webrtc", .what = "video for browsers", .port = link::pictures::default_whep_port},
              diagnostics, link.webrtc);
  auto const name = reader.text("name");
  if (!name && !reader.has("name"))
    diagnostics.report(invalid_value, table.span, "a survey drone needs a name", "name = \"hawk\"");
  if (name) {
    link.name = name->value;
    if (auto const sound = wire::check_name(link.name); !sound)
      diagnostics.report(invalid_value, name->span, sound.error().message, sound.error().hint);
  }
  if (auto const file = reader.text("token_file"))
    link.token_file = std::filesystem::path(source.name()).parent_path() / file->value;
  if (auto const file = reader.text("camera_token_file"))
    link.camera_token_file = std::filesystem::path(source.name()).parent_path() / file->value;
  read_tls(reader, source, diagnostics, link.settings.tls);
  reader.refuse("token", "keep it in a file of its own (mode 0600): token_file = \"drone.token\"");
  reader.refuse_unknown();
  return link;
}

namespace {

link::pictures::Source source_of(SurveyLink const& link, std::optional<link::pictures::Source> const& told,
                                 std::uint16_t ports_above) {
  auto source = told.value_or(link::pictures::Source{
      .host = link.settings.host, .port = static_cast<std::uint16_t>(link.settings.port + ports_above)});
  source.token = link.camera_token;
  return source;
}

}  // namespace

link::pictures::Source camera_of(SurveyLink const& link) {
  return source_of(link, link.camera, link::pictures::ports_above_operator);
}

link::pictures::Source video_of(SurveyLink const& link) {
  return source_of(link, link.webrtc, link::pictures::whep_ports_above_operator);
}

base::Result<> take_tokens(SurveyLink& link) {
  auto const take = [&link](std::filesystem::path const& file, std::string& token) -> base::Result<> {
    if (file.empty()) return {};
    auto read =
        read_secret({.path = file.string(), .what = "token file", .hint = fmt::format("copy that of {}", link.name)});
    if (!read) return std::unexpected(read.error());
    token = *std::move(read);
    return {};
  };
  if (auto taken = take(link.token_file, link.settings.client.end.token); !taken) return taken;
  return take(link.camera_token_file, link.camera_token);
}

}  // namespace lapwing::host
