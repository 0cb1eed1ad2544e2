#include "route/config.hpp"

#include <charconv>
#include <set>

#include <fmt/format.h>

#include "base/text/spelling.hpp"
#include "mavlink/wire/dialect_names.hpp"

namespace lapwing::route {

namespace {

using base::ConfigReader;
using base::config_kinds::invalid_value;

double constexpr lowest_rate = 0.1;
double constexpr highest_rate = 1e9;
std::uint32_t constexpr highest_message_id = 0xFF'FFFF;

std::optional<std::uint32_t> message_number(std::string_view digits) {
  std::uint32_t id = 0;
  auto const* end = digits.data() + digits.size();
  auto const [stopped, error] = std::from_chars(digits.data(), end, id);
  if (error != std::errc{} || stopped != end || id > highest_message_id) return std::nullopt;
  return id;
}

/// The messages of `key`, by name or, where the dialect lacks them, by number.
std::vector<std::uint32_t> read_messages(ConfigReader& table, std::string_view key) {
  std::vector<std::uint32_t> ids;
  auto const texts = table.texts(key);
  if (!texts) return ids;
  for (auto const& [text, span] : *texts) {
    if (auto const known = mavlink::find_message(text)) {
      ids.push_back(known->id);
    } else if (auto const number = message_number(text)) {
      ids.push_back(*number);
    } else {
      auto hint = base::did_you_mean(text, mavlink::message_names());
      if (hint.empty()) hint = "a name such as HEARTBEAT, or a number such as \"33000\" where the dialect lacks it";
      table.diagnostics().report(invalid_value, span, fmt::format("there is no message {}", text), std::move(hint));
    }
  }
  return ids;
}

std::vector<std::uint8_t> read_ids(ConfigReader& table, std::string_view key) {
  std::vector<std::uint8_t> ids;
  for (auto const& [id, span] : table.integers(key, 0, 255)) ids.push_back(static_cast<std::uint8_t>(id));
  return ids;
}

Filter read_filter(ConfigReader table) {
  Filter filter;
  for (auto const id : read_messages(table, "allow_messages")) filter.allow_message(id);
  for (auto const id : read_messages(table, "block_messages")) filter.block_message(id);
  for (auto const id : read_ids(table, "allow_systems")) filter.allow_system(id);
  for (auto const id : read_ids(table, "block_systems")) filter.block_system(id);
  for (auto const id : read_ids(table, "allow_components")) filter.allow_component(id);
  for (auto const id : read_ids(table, "block_components")) filter.block_component(id);
  table.refuse_unknown();
  return filter;
}

Rate read_rate(ConfigReader& table) {
  Rate rate;
  if (auto const bytes = table.number("bytes_per_s", lowest_rate, highest_rate)) rate.bytes_per_s = bytes->value;
  if (auto const messages = table.number("messages_per_s", lowest_rate, highest_rate))
    rate.messages_per_s = messages->value;
  return rate;
}

void read_limits(ConfigReader& table, Limits& limits) {
  limits.all = read_rate(table);
  for (auto const c : {MessageClass::command, MessageClass::telemetry, MessageClass::bulk}) {
    auto inner = table.table(to_string(c));
    if (!inner) continue;
    limits.by_class[static_cast<std::size_t>(c)] = read_rate(*inner);
    inner->refuse_unknown();
  }
}

void read_url(ConfigReader& table, base::Span span, EndpointOptions& endpoint) {
  auto const text = table.text("url");
  if (!text) {
    // One of the wrong type was complained of already.
    if (!table.has("url"))
      table.diagnostics().report(invalid_value, span, "an endpoint needs a url", "url = \"udpin://0.0.0.0:14550\"");
    return;
  }
  if (auto url = link::parse_url(text->value))
    endpoint.url = *std::move(url);
  else
    table.diagnostics().report(invalid_value, text->span, url.error().message, url.error().hint);
}

}  // namespace

EndpointOptions read_endpoint(base::Placed<ConfigReader> placed) {
  auto& [table, span] = placed;
  EndpointOptions endpoint;
  read_url(table, span, endpoint);
  if (auto const name = table.text("name")) endpoint.name = name->value;
  if (auto const flag = table.flag("sniffer")) endpoint.is_sniffer = flag->value;
  if (auto const flag = table.flag("read_only")) endpoint.is_read_only = flag->value;
  if (auto const flag = table.flag("between_members")) endpoint.between_members = flag->value;
  if (auto const flag = table.flag("coalesce")) endpoint.coalesces = flag->value;
  if (auto filter = table.table("in")) endpoint.in = read_filter(*std::move(filter));
  if (auto filter = table.table("out")) endpoint.out = read_filter(*std::move(filter));
  read_limits(table, endpoint.limits);
  table.refuse_unknown();
  return endpoint;
}

RouterConfig read_router_config(base::SourceFile const& source, base::Diagnostics& diagnostics) {
  RouterConfig config;
  auto const entries = base::parse_config(source, diagnostics);
  if (diagnostics.has_errors()) return config;
  ConfigReader root(entries, diagnostics);
  if (auto const port = root.integer("metrics_port", 0, 65535)) config.metrics_port = static_cast<int>(port->value);
  if (auto const flag = root.flag("drop_duplicates")) config.options.drops_duplicates = flag->value;
  std::set<std::string> names;
  for (auto& table : root.tables("endpoint")) {
    auto const span = table.span;
    auto endpoint = read_endpoint(std::move(table));
    if (!endpoint.name.empty() && !names.insert(endpoint.name).second)
      diagnostics.report(invalid_value, span, fmt::format("two endpoints are called {}", endpoint.name),
                         "metrics and the log tell them apart by their names");
    config.endpoints.push_back(std::move(endpoint));
  }
  root.refuse_unknown();
  return config;
}

}  // namespace lapwing::route
