#include "mavlink/wire/dialect_names.hpp"

#include <algorithm>

namespace lapwing::mavlink {

namespace {

constexpr FieldName fields[] = {
#include <tables/dialect_fields.inc>
};

struct MessageRow {
  std::string_view name;
  std::uint32_t id;
  std::size_t first;  ///< of its fields
  std::size_t count;
};
constexpr MessageRow messages[] = {
#include <tables/dialect_messages.inc>
};
static_assert(std::ranges::is_sorted(messages, {}, &MessageRow::name));

struct EntryRow {
  std::string_view name;
  std::int64_t value;
};
constexpr EntryRow entries[] = {
#include <tables/dialect_names.inc>
};

template <class Row>
Row const* find(std::span<Row const> rows, std::string_view name) {
  auto const found = std::ranges::lower_bound(rows, name, {}, &Row::name);
  return found != rows.end() && found->name == name ? &*found : nullptr;
}

template <class Row>
std::vector<std::string_view> names_of(std::span<Row const> rows) {
  std::vector<std::string_view> names;
  for (auto const& row : rows) names.push_back(row.name);
  return names;
}

}  // namespace

std::optional<MessageName> find_message(std::string_view name) {
  auto const* row = find(std::span<MessageRow const>(messages), name);
  if (!row) return std::nullopt;
  return MessageName{row->name, row->id, std::span(fields).subspan(row->first, row->count)};
}

std::vector<std::string_view> message_names() {
  return names_of(std::span<MessageRow const>(messages));
}

std::string_view message_name(std::uint32_t id) {
  auto const found = std::ranges::find(messages, id, &MessageRow::id);
  return found == std::ranges::end(messages) ? std::string_view() : found->name;
}

std::optional<std::int64_t> find_enum_entry(std::string_view name) {
  auto const* row = find(std::span<EntryRow const>(entries), name);
  return row ? std::optional(row->value) : std::nullopt;
}

std::vector<std::string_view> enum_entry_names() {
  return names_of(std::span<EntryRow const>(entries));
}

}  // namespace lapwing::mavlink
