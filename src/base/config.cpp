#include "base/config.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include "base/spelling.hpp"

namespace lapwing::base {

namespace {

constexpr std::array<std::string_view, 7> type_names{"true or false", "a whole number", "a number", "text",
                                                     "a date",        "an array",       "a table"};

/// toml++ counts lines and columns (in code points) from 1; 0 stands for a place it does not know.
std::uint32_t offset_of(SourceFile const& source, toml::source_position at) {
  if (at.line == 0) return 0;
  auto const line = source.line_span(at.line);
  auto const bytes = source.text(line);
  std::size_t offset = 0;
  for (auto column = at.column; column > 1 && offset < bytes.size(); --column) {
    do {
      ++offset;
    } while (offset < bytes.size() && (static_cast<unsigned char>(bytes[offset]) & 0xC0u) == 0x80u);
  }
  return line.begin + static_cast<std::uint32_t>(offset);
}

Span span_of(SourceFile const& source, toml::source_region const& region) {
  auto const begin = offset_of(source, region.begin);
  return {begin, std::max(begin + 1, offset_of(source, region.end))};
}

ConfigValue::Table convert(SourceFile const& source, toml::table const& table);

ConfigValue convert(SourceFile const& source, toml::node const& node) {
  ConfigValue value{.span = span_of(source, node.source()), .content = ConfigValue::Date{}};
  if (auto const* flag = node.as_boolean()) value.content = flag->get();
  if (auto const* integer = node.as_integer()) value.content = integer->get();
  if (auto const* number = node.as_floating_point()) value.content = number->get();
  if (auto const* text = node.as_string()) value.content = text->get();
  if (auto const* table = node.as_table()) value.content = convert(source, *table);
  if (auto const* array = node.as_array()) {
    ConfigValue::Array elements;
    for (auto const& element : *array) elements.push_back(convert(source, element));
    value.content = std::move(elements);
  }
  return value;
}

/// In the middle of a bare word a quote is no quote but a mistake.
bool begins_quoted(std::string_view text, std::size_t at) {
  constexpr std::string_view before = " \t\r\n=[{,.\xBF";  // the last is the end of a byte order mark
  return (text[at] == '"' || text[at] == '\'') && (at == 0 || before.find(text[at - 1]) != std::string_view::npos);
}

/// Behind the quoted text that begins at `begin`; what is wrong with it, the parser says.
std::size_t end_of_quoted(std::string_view text, std::size_t begin) {
  char const quote = text[begin];
  std::string const fence(text.substr(begin, 3) == std::string(3, quote) ? 3 : 1, quote);
  for (auto i = begin + fence.size(); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text[i] == '\n' && fence.size() == 1) {
      return i;
    } else if (text.substr(i, fence.size()) == fence) {
      i += fence.size();
      // Of many lines, the text may end with quotes of its own.
      while (fence.size() == 3 && i < text.size() && text[i] == quote) ++i;
      return i;
    }
  }
  return text.size();
}

/// The first character beyond ASCII outside of quotes and comments, where TOML has none. toml++ 3.3 is not prepared for
/// all of them: for some its code says "unreachable".
std::optional<std::uint32_t> stray_character(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  for (std::size_t i = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; i < text.size();) {
    if ((static_cast<unsigned char>(text[i]) & 0x80U) != 0) return static_cast<std::uint32_t>(i);
    if (text[i] == '#')
      i = std::min(text.find('\n', i), text.size());
    else if (begins_quoted(text, i))
      i = end_of_quoted(text, i);
    else
      ++i;
  }
  return std::nullopt;
}

ConfigValue::Table convert(SourceFile const& source, toml::table const& table) {
  ConfigValue::Table entries;
  for (auto const& [key, node] : table) {
    entries.push_back({std::string(key.str()), span_of(source, key.source()), convert(source, node)});
  }
  return entries;
}

}  // namespace

ConfigValue::Table parse_config(SourceFile const& source, Diagnostics& diagnostics) {
  if (auto const stray = stray_character(source.text())) {
    diagnostics.report(config_kinds::not_toml, {*stray, *stray + 1},
                       "outside of quotes and comments there are only ASCII characters", "put it in quotes");
    return {};
  }
  auto const parsed = toml::parse(source.text(), source.name());
  if (!parsed) {
    diagnostics.report(config_kinds::not_toml, span_of(source, parsed.error().source()),
                       std::string(parsed.error().description()));
    return {};
  }
  return convert(source, parsed.table());
}

ConfigEntry const* ConfigReader::find(std::string_view key) {
  known_.emplace(key);
  auto const found = std::ranges::find(table_, key, &ConfigEntry::key);
  return found == table_.end() ? nullptr : &*found;
}

void ConfigReader::wrong_type(ConfigEntry const& entry, std::string_view wanted) {
  diagnostics_.report(
      config_kinds::wrong_type, entry.value.span,
      fmt::format("{} must be {}, not {}", entry.key, wanted, type_names.at(entry.value.content.index())));
}

std::optional<Placed<bool>> ConfigReader::flag(std::string_view key) {
  auto const* entry = find(key);
  if (!entry) return std::nullopt;
  if (auto const* value = std::get_if<bool>(&entry->value.content)) return Placed{*value, entry->value.span};
  wrong_type(*entry, "true or false");
  return std::nullopt;
}

std::optional<Placed<std::int64_t>> ConfigReader::integer(std::string_view key, std::int64_t low, std::int64_t high) {
  auto const* entry = find(key);
  if (!entry) return std::nullopt;
  auto const* value = std::get_if<std::int64_t>(&entry->value.content);
  if (!value) {
    wrong_type(*entry, "a whole number");
    return std::nullopt;
  }
  if (*value < low || *value > high) {
    diagnostics_.report(config_kinds::invalid_value, entry->value.span,
                        fmt::format("{} must be from {} to {}", key, low, high));
    return std::nullopt;
  }
  return Placed{*value, entry->value.span};
}

std::optional<Placed<double>> ConfigReader::number(std::string_view key, double low, double high) {
  auto const* entry = find(key);
  if (!entry) return std::nullopt;
  auto const* whole = std::get_if<std::int64_t>(&entry->value.content);
  auto const* real = std::get_if<double>(&entry->value.content);
  if (!whole && !real) {
    wrong_type(*entry, "a number");
    return std::nullopt;
  }
  auto const value = real ? *real : static_cast<double>(*whole);
  if (value >= low && value <= high) return Placed{value, entry->value.span};
  diagnostics_.report(config_kinds::invalid_value, entry->value.span,
                      fmt::format("{} must be from {} to {}", key, low, high));
  return std::nullopt;
}

std::optional<Placed<std::string>> ConfigReader::text(std::string_view key) {
  auto const* entry = find(key);
  if (!entry) return std::nullopt;
  if (auto const* value = std::get_if<std::string>(&entry->value.content)) return Placed{*value, entry->value.span};
  wrong_type(*entry, "text");
  return std::nullopt;
}

std::optional<std::vector<Placed<std::string>>> ConfigReader::texts(std::string_view key) {
  auto const* entry = find(key);
  if (!entry) return std::nullopt;
  auto const* elements = std::get_if<ConfigValue::Array>(&entry->value.content);
  if (!elements) {
    wrong_type(*entry, "an array of texts");
    return std::nullopt;
  }
  std::vector<Placed<std::string>> texts;
  for (auto const& element : *elements) {
    if (auto const* text = std::get_if<std::string>(&element.content)) {
      texts.push_back({*text, element.span});
    } else {
      diagnostics_.report(
          config_kinds::wrong_type, element.span,
          fmt::format("every element of {} must be text, not {}", key, type_names.at(element.content.index())));
    }
  }
  return texts;
}

std::vector<Placed<std::int64_t>> ConfigReader::integers(std::string_view key, std::int64_t low, std::int64_t high) {
  auto const* entry = find(key);
  if (!entry) return {};
  auto const* elements = std::get_if<ConfigValue::Array>(&entry->value.content);
  if (!elements) {
    wrong_type(*entry, "an array of whole numbers");
    return {};
  }
  std::vector<Placed<std::int64_t>> values;
  for (auto const& element : *elements) {
    auto const* value = std::get_if<std::int64_t>(&element.content);
    if (value && *value >= low && *value <= high) {
      values.push_back({*value, element.span});
    } else {
      diagnostics_.report(value ? config_kinds::invalid_value : config_kinds::wrong_type, element.span,
                          fmt::format("every element of {} must be a whole number from {} to {}", key, low, high));
    }
  }
  return values;
}

std::optional<ConfigReader> ConfigReader::table(std::string_view key) {
  auto const* entry = find(key);
  if (!entry) return std::nullopt;
  if (auto const* table = std::get_if<ConfigValue::Table>(&entry->value.content)) {
    return ConfigReader(*table, diagnostics_);
  }
  wrong_type(*entry, fmt::format("a table: [{}]", key));
  return std::nullopt;
}

std::vector<Placed<ConfigReader>> ConfigReader::tables(std::string_view key) {
  auto const* entry = find(key);
  if (!entry) return {};
  std::vector<Placed<ConfigReader>> readers;
  auto const* elements = std::get_if<ConfigValue::Array>(&entry->value.content);
  bool all_are = elements != nullptr;
  if (elements) {
    for (auto const& element : *elements) {
      if (auto const* table = std::get_if<ConfigValue::Table>(&element.content))
        readers.push_back({ConfigReader(*table, diagnostics_), element.span});
      else
        all_are = false;
    }
  }
  if (!all_are) wrong_type(*entry, fmt::format("written as [[{}]]", key));
  return readers;
}

bool ConfigReader::has(std::string_view key) const {
  return std::ranges::find(table_, key, &ConfigEntry::key) != table_.end();
}

void ConfigReader::refuse(std::string_view key, std::string_view advice) {
  auto const found = std::ranges::find(table_, key, &ConfigEntry::key);
  if (found == table_.end()) return;
  diagnostics_.report(config_kinds::misplaced, found->key_span, fmt::format("{} does not belong here", key),
                      std::string(advice));
  refused_.emplace(key);
}

void ConfigReader::refuse_unknown() {
  std::vector<std::string_view> const candidates(known_.begin(), known_.end());
  for (auto const& entry : table_) {
    if (known_.contains(entry.key) || refused_.contains(entry.key)) continue;
    auto hint = did_you_mean(entry.key, candidates);
    if (hint.empty()) hint = fmt::format("known here: {}", fmt::join(candidates, ", "));
    diagnostics_.report(config_kinds::unknown_setting, entry.key_span, fmt::format("there is no setting {}", entry.key),
                        std::move(hint));
  }
}

}  // namespace lapwing::base
