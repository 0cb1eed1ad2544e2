#include "mavlink/signing/key_store.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/config.hpp"
#include "mavlink/wire/dialect_names.hpp"
#include "mavlink/wire/system_name.hpp"

namespace lapwing::mavlink {

namespace {

using base::ConfigEntry;
using base::ConfigValue;

bool is_hex_digit(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/// Reads the tree; keeps the first mistake. Its messages tell what is expected, never what is there.
class Reader {
 public:
  explicit Reader(base::SourceFile const& source) : source_(source) {}

  void read(ConfigValue::Table const& root);
  KeyRing ring;
  std::optional<std::string> mistake;

 private:
  void wrong(base::Span span, std::string_view what) {
    if (mistake) return;
    auto const place = source_.place(span.begin);
    mistake = fmt::format("{}:{}:{}: {}", source_.name(), place.line, place.column, what);
  }
  [[nodiscard]] ConfigValue::Table const* table(ConfigEntry const& entry) {
    auto const* found = std::get_if<ConfigValue::Table>(&entry.value.content);
    if (!found) wrong(entry.value.span, "expected a table");
    return found;
  }
  void read_keys(ConfigValue::Table const& keys);
  void read_uses(ConfigValue::Table const& uses);
  void read_vehicles(ConfigValue::Table const& vehicles);
  [[nodiscard]] KeyRing::Use use(ConfigValue const& value);
  void read_unsigned(ConfigValue::Table const& table);
  void read_systems(ConfigValue const& value);
  void read_messages(ConfigValue const& value);

  base::SourceFile const& source_;
};

void Reader::read(ConfigValue::Table const& root) {
  // Keys first: what uses them names them.
  for (auto const& entry : root) {
    if (entry.key != "keys") continue;
    if (auto const* keys = table(entry)) read_keys(*keys);
  }
  for (auto const& entry : root) {
    if (entry.key == "keys") continue;
    if (entry.key != "use" && entry.key != "unsigned") return wrong(entry.key_span, "expected keys, use or unsigned");
    auto const* content = table(entry);
    if (!content) return;
    entry.key == "use" ? read_uses(*content) : read_unsigned(*content);
  }
}

void Reader::read_keys(ConfigValue::Table const& keys) {
  for (auto const& entry : keys) {
    if (!is_key_name(entry.key)) return wrong(entry.key_span, "a key's name has 1 to 40 letters, digits, - and _");
    auto const* digits = std::get_if<std::string>(&entry.value.content);
    auto const key = digits ? parse_key(*digits) : std::nullopt;
    if (!key) return wrong(entry.value.span, "a key is a text of 64 hexadecimal digits");
    ring.keys.emplace(entry.key, *key);
  }
}

KeyRing::Use Reader::use(ConfigValue const& value) {
  KeyRing::Use names;
  auto const add = [&](ConfigValue const& item) {
    auto const* name = std::get_if<std::string>(&item.content);
    if (!name || !ring.keys.contains(*name)) return wrong(item.span, "expected the name of a key of [keys]");
    names.push_back(*name);
  };
  if (auto const* list = std::get_if<ConfigValue::Array>(&value.content)) {
    for (auto const& item : *list) add(item);
    if (list->empty()) wrong(value.span, "expected at least one key's name");
  } else {
    add(value);
  }
  return names;
}

void Reader::read_uses(ConfigValue::Table const& uses) {
  for (auto const& entry : uses) {
    if (entry.key == "everybody") {
      ring.everybody = use(entry.value);
    } else if (entry.key == "links") {
      if (auto const* links = table(entry))
        for (auto const& link : *links) ring.links[link.key] = use(link.value);
    } else if (entry.key == "vehicles") {
      if (auto const* vehicles = table(entry)) read_vehicles(*vehicles);
    } else {
      wrong(entry.key_span, "expected everybody, links or vehicles");
    }
  }
}

void Reader::read_vehicles(ConfigValue::Table const& vehicles) {
  for (auto const& vehicle : vehicles) {
    if (auto const name = parse_system_name(vehicle.key))
      vehicles_of(ring, name->network)[name->system_id] = use(vehicle.value);
    else
      wrong(vehicle.key_span, "a vehicle is named by its system id, 1 to 255, or network/id");
  }
}

void Reader::read_systems(ConfigValue const& value) {
  auto const* list = std::get_if<ConfigValue::Array>(&value.content);
  if (!list) return wrong(value.span, "expected a list of system ids");
  for (auto const& item : *list) {
    auto const* id = std::get_if<std::int64_t>(&item.content);
    if (!id || *id < 1 || *id > 255) return wrong(item.span, "a system id is 1 to 255");
    ring.unsigned_frames.systems.insert(static_cast<std::uint8_t>(*id));
  }
}

void Reader::read_messages(ConfigValue const& value) {
  constexpr std::int64_t largest_id = 0xFFFFFF;
  auto const* list = std::get_if<ConfigValue::Array>(&value.content);
  if (!list) return wrong(value.span, "expected a list of messages");
  for (auto const& item : *list) {
    auto const* id = std::get_if<std::int64_t>(&item.content);
    auto const* name = std::get_if<std::string>(&item.content);
    auto const found = name ? find_message(*name) : std::nullopt;
    if (found) {
      ring.unsigned_frames.messages.insert(found->id);
    } else if (id && *id >= 0 && *id <= largest_id) {
      ring.unsigned_frames.messages.insert(static_cast<std::uint32_t>(*id));
    } else {
      return wrong(item.span, "expected a message's name, such as ADSB_VEHICLE, or number");
    }
  }
}

void Reader::read_unsigned(ConfigValue::Table const& content) {
  for (auto const& entry : content) {
    if (entry.key == "local-links") {
      auto const* flag = std::get_if<bool>(&entry.value.content);
      if (!flag) return wrong(entry.value.span, "expected true or false");
      ring.unsigned_frames.local_links = *flag;
    } else if (entry.key == "systems") {
      read_systems(entry.value);
    } else if (entry.key == "messages") {
      read_messages(entry.value);
    } else {
      return wrong(entry.key_span, "expected local-links, systems or messages");
    }
  }
}

std::string quoted(KeyRing::Use const& use) {
  std::string text;
  for (auto const& name : use) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  return "[" + text + "]";
}

/// URLs come from command lines: whatever TOML would take for its own is escaped.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (char const c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') {
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace

std::optional<SigningKey> parse_key(std::string_view digits) {
  SigningKey key{};
  if (digits.size() != 2 * key.size() || !std::ranges::all_of(digits, is_hex_digit)) return std::nullopt;
  for (std::size_t i = 0; i < key.size(); ++i) std::from_chars(&digits[2 * i], &digits[2 * i] + 2, key[i], 16);
  return key;
}

bool is_key_name(std::string_view name) {
  constexpr std::size_t longest = 40;
  auto const is_good = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= longest && std::ranges::all_of(name, is_good);
}

base::Result<KeyRing> parse_key_store(std::string_view file, std::string_view text) {
  base::SourceFile const source{std::string(file), std::string(text)};
  // All that belongs there is ASCII, and toml++ 3.3 has undefined behaviour on some of the rest.
  auto const strange = std::ranges::find_if(text, [](char c) { return static_cast<unsigned char>(c) > '~'; });
  if (strange != text.end()) {
    auto const place = source.place(static_cast<std::uint32_t>(strange - text.begin()));
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("{}:{}:{}: only ASCII characters belong here", file, place.line, place.column));
  }
  base::Diagnostics diagnostics(source);
  auto const root = base::parse_config(source, diagnostics);
  if (diagnostics.has_errors()) {
    // The diagnostic shows the line, and a key may stand in it.
    auto const place = source.place(diagnostics.sorted().front().span.begin);
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("{}:{}:{}: this breaks the grammar of TOML", file, place.line, place.column));
  }
  Reader reader(source);
  reader.read(root);
  if (reader.mistake) return base::fail(base::ErrorKind::invalid_input, *reader.mistake);
  return std::move(reader.ring);
}

std::string to_text(KeyRing const& ring) {
  std::string text = "# Keys that sign MAVLink. Secret: nobody but its owner may read this file.\n\n[keys]\n";
  for (auto const& [name, key] : ring.keys) {
    text += fmt::format("{} = \"", name);
    for (unsigned const byte : key) text += fmt::format("{:02x}", byte);
    text += "\"\n";
  }
  text += "\n[use]\n";
  if (!ring.everybody.empty()) text += fmt::format("everybody = {}\n", quoted(ring.everybody));
  if (!ring.links.empty()) text += "\n[use.links]\n";
  for (auto const& [url, use] : ring.links) text += fmt::format("{} = {}\n", quoted(url), quoted(use));
  if (!ring.vehicles.empty() || !ring.networks.empty()) text += "\n[use.vehicles]\n";
  for (auto const& [id, use] : ring.vehicles) text += fmt::format("{} = {}\n", id, quoted(use));
  for (auto const& [network, vehicles] : ring.networks)
    for (auto const& [id, use] : vehicles)
      text += fmt::format("{} = {}\n", quoted(to_string(SystemName{network, id})), quoted(use));
  auto const& allowed = ring.unsigned_frames;
  text += fmt::format("\n[unsigned]\nlocal-links = {}\nsystems = {}\nmessages = {}\n", allowed.local_links,
                      std::vector<int>(allowed.systems.begin(), allowed.systems.end()),
                      std::vector<unsigned>(allowed.messages.begin(), allowed.messages.end()));
  return text;
}

}  // namespace lapwing::mavlink
