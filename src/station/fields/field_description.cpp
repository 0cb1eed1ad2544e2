#include "station/fields/field_description.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "station/fields/vehicle_fields.hpp"

namespace lapwing::station::internal {

namespace {

/// What is said of a value: its type in TypeScript, the expression that reads it, the words of the reference for it,
/// its schema in YAML without the braces.
struct Said {
  std::string type;
  std::string parser;
  std::string about;
  std::string schema;
};

struct Line {
  Member member;
  std::string key;
  Said said;
};

/// "lowerFirst": as constants of the web app are written.
std::string constant_name(std::string_view type) {
  std::string name(type);
  name.front() = static_cast<char>(name.front() | 0x20);
  return name;
}

std::string number_text(double value) {
  return std::abs(value) < 1e16 && value == std::floor(value) ? fmt::format("{}", static_cast<std::int64_t>(value))
                                                              : fmt::format("{}", value);
}

std::string about_unit(Unit const& unit) {
  if (unit.name.empty() && unit.decimals == 0) return "";
  std::string const step = unit.decimals == 0 ? "whole"
                           : unit.decimals > 0
                               ? fmt::format("{} decimal{}", unit.decimals, unit.decimals > 1 ? "s" : "")
                               : fmt::format("in steps of {}", std::pow(10.0, -unit.decimals));
  return unit.name.empty() ? step : fmt::format("{}, {}", unit.name, step);
}

std::string doc_comment(std::string_view doc, std::string_view indent) {
  return doc.empty() ? "" : fmt::format("{}/** {} */\n", indent, doc);
}

/// "control," where key and value are called the same.
std::string entry_text(std::string_view key, std::string_view value, std::string_view indent) {
  return key == value ? fmt::format("{}{},\n", indent, key) : fmt::format("{}{}: {},\n", indent, key, value);
}

/// As messages write them: see `FieldJson`.
std::string number_schema(Unit const& unit, bool may_be_null) {
  auto const* const type = unit.decimals > 0 ? "number" : "integer";
  return fmt::format("type: {}, minimum: {}, maximum: {}", may_be_null ? fmt::format("[{}, \"null\"]", type) : type,
                     number_text(unit.low), number_text(unit.high));
}

/// What JSON quotes is quoted for YAML, too.
std::string property(std::string_view key, std::string_view schema, std::string_view doc) {
  auto const description = doc.empty() ? "" : fmt::format(", description: {}", nlohmann::json(doc).dump());
  return fmt::format("        {}: {{{}{}}}\n", key, schema, description);
}

std::string schema_head(std::string_view name, std::string_view doc) {
  auto const description = doc.empty() ? "" : fmt::format("      description: {}\n", nlohmann::json(doc).dump());
  return fmt::format("    {}:\n      type: object\n{}", name, description);
}

std::string quoted(std::vector<std::string> const& words) {
  return words.empty() ? "[]" : fmt::format("['{}']", fmt::join(words, "', '"));
}

/// Collects the types that the lines need, each once, in the order in which they are needed.
class Describer : public FieldVisitor {
 public:
  [[nodiscard]] bool wants_all() const override { return true; }

  void number(Member const& member, std::optional<double> value, Unit const& unit) override {
    auto parser = fmt::format("number({}, {})", number_text(unit.low), number_text(unit.high));
    if (member.key.empty() && !value)
      return add(member,
                 {"number | null", fmt::format("orNull({})", parser), about_unit(unit), number_schema(unit, true)});
    add(member, {"number", std::move(parser), about_unit(unit), number_schema(unit, false)});
  }
  void flag(Member const& member, bool) override { add(member, {"boolean", "flag", "true or false", "type: boolean"}); }
  void text(Member const& member, std::string_view) override {
    add(member, {"string", "text", "text", "type: string"});
  }
  void word(Member const& member, std::string_view, Words const& words) override {
    std::vector<std::string> all;
    for (auto const word : words.words) all.emplace_back(word);
    note_type(std::string(words.type), fmt::format("export type {} = '{}';\n", words.type, fmt::join(all, "' | '")), "",
              "");
    auto const otherwise = words.otherwise.empty() ? std::string() : fmt::format(", '{}'", words.otherwise);
    auto const about = fmt::format("`{}`", fmt::join(words.words, "`, `"));
    add(member, {std::string(words.type), fmt::format("word({}{})", quoted(all), otherwise), about,
                 fmt::format("enum: [{}]", fmt::join(words.words, ", "))});
  }
  void begin_object(Member const& member, Type const& type) override {
    open_.push_back({.line = member, .key = std::string(member.key), .type = type, .is_list = false});
  }
  void begin_list(Member const& member, Unique unique) override {
    open_.push_back({.line = member, .key = std::string(member.key), .unique = unique, .is_list = true});
  }
  void end() override {
    auto const done = std::move(open_.back());
    open_.pop_back();
    add(done.line, done.is_list ? list_of(done) : object_of(done));
  }

  [[nodiscard]] std::vector<Line> const& lines() const { return lines_; }
  [[nodiscard]] std::string types() const;
  [[nodiscard]] std::string parsers() const;
  [[nodiscard]] std::string schemas() const;
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  struct Open {
    Member line;
    std::string key;
    Type type = {};
    Unique unique = Unique::no;
    bool is_list = false;
    std::vector<Line> lines = {};
  };
  struct NamedType {
    std::string name;
    std::string definition;
    std::string parser;  ///< empty for words, as the schema
    std::string schema;
  };

  void add(Member const& member, Said said) {
    auto& lines = open_.empty() ? lines_ : open_.back().lines;
    lines.push_back({member, std::string(member.key), std::move(said)});
  }
  void note_type(std::string name, std::string definition, std::string parser, std::string schema) {
    if (std::ranges::find(types_, name, &NamedType::name) == types_.end())
      types_.push_back({std::move(name), std::move(definition), std::move(parser), std::move(schema)});
  }
  static Said list_of(Open const& done);
  Said object_of(Open const& done);

  std::vector<Line> lines_;
  std::vector<Open> open_;
  std::vector<NamedType> types_;
};

Said Describer::list_of(Open const& done) {
  auto const& entry = done.lines.front().said;
  bool const is_union = entry.type.contains('|');
  std::string by;
  switch (done.unique) {
    case Unique::no: break;
    case Unique::by_value: by = ", (value) => value"; break;
    case Unique::by_name: by = ", ({ name }) => name"; break;
    case Unique::by_id: by = ", ({ id }) => id"; break;
  }
  return {is_union ? fmt::format("({})[]", entry.type) : entry.type + "[]", fmt::format("list({}{})", entry.parser, by),
          entry.about.empty() ? "list of numbers"
                              : fmt::format("list of {}", entry.about == "text" ? "texts" : entry.about),
          fmt::format("type: array, items: {{{}}}", entry.schema)};
}

Said Describer::object_of(Open const& done) {
  std::string definition = fmt::format("{}export interface {} {{\n", doc_comment(done.type.doc, ""), done.type.name);
  std::string parser = fmt::format("const {} = object<{}>(\n  {{\n", constant_name(done.type.name), done.type.name);
  std::string properties;
  std::vector<std::string> needed;
  std::vector<std::string> about;
  for (auto const& [member, key, said] : done.lines) {
    definition += doc_comment(member.doc, "  ");
    definition += fmt::format("  {}{}: {};\n", key, member.is_optional ? "?" : "", said.type);
    parser += entry_text(key, said.parser, "    ");
    properties += property(key, said.schema, member.doc);
    if (!member.is_optional) needed.push_back(key);
    about.push_back(member.is_optional ? key + "?" : key);
  }
  definition += "}\n";
  parser += fmt::format("  }},\n  {},\n);\n", quoted(needed));
  std::string const name(done.type.name);
  auto const required = needed.empty() ? "" : fmt::format("      required: [{}]\n", fmt::join(needed, ", "));
  note_type(name, std::move(definition), std::move(parser),
            schema_head(name, done.type.doc) + required + "      properties:\n" + properties);
  return {name, constant_name(name), fmt::format("`{{{}}}`", fmt::join(about, ", ")),
          fmt::format("$ref: \"#/components/schemas/{}\"", name)};
}

std::string Describer::types() const {
  std::string text;
  for (auto const& type : types_) text += type.definition + "\n";
  return text;
}

std::string Describer::parsers() const {
  std::string text;
  for (auto const& type : types_)
    if (!type.parser.empty()) text += type.parser + "\n";
  return text;
}

std::string Describer::schemas() const {
  std::string text;
  for (auto const& type : types_) text += type.schema;
  return text;
}

std::vector<std::string> Describer::names() const {
  std::vector<std::string> names;
  for (auto const& type : types_)
    if (!type.parser.empty()) names.push_back(type.name);
  std::ranges::sort(names);
  return names;
}

constexpr std::string_view made_by =
    "// Made from src/station/fields/vehicle_fields.cpp by `station_fields write`. Do not change it here.\n\n";

Describer described() {
  Describer describer;
  vehicle_fields(describer, {});
  return describer;
}

}  // namespace

std::string vehicle_types() {
  auto const fields = described();
  std::string text(made_by);
  text += fields.types();
  text +=
      "/** What may be known about a vehicle; a key that is missing was never heard. */\nexport interface "
      "VehicleFields {\n";
  for (auto const& [member, key, said] : fields.lines()) {
    text += doc_comment(member.doc, "  ");
    text += fmt::format("  {}?: {};\n", key, said.type);
  }
  return text + "}\n";
}

std::string vehicle_parsers() {
  auto const fields = described();
  auto names = fields.names();
  names.emplace_back("VehicleFields");
  std::string text(made_by);
  text += "import { flag, list, number, object, orNull, text, word, type Shape } from './parsers';\n";
  text += fmt::format("import type {{\n  {},\n}} from './vehicle_fields';\n\n", fmt::join(names, ",\n  "));
  text += fields.parsers();
  text += "export const VEHICLE: Shape<VehicleFields> = {\n";
  for (auto const& line : fields.lines()) text += entry_text(line.key, line.said.parser, "  ");
  return text + "};\n";
}

std::string vehicle_table() {
  auto const fields = described();
  std::string text = "| key | is | age | what it says | from |\n|---|---|---|---|---|\n";
  for (auto const& [member, key, said] : fields.lines())
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key, said.about.empty() ? "number" : said.about,
                        member.has_age ? "yes" : "", member.doc, member.from);
  return text;
}

std::string vehicle_schemas() {
  auto const fields = described();
  auto text =
      fields.schemas() + schema_head("VehicleFields", "What may be known about a vehicle.") + "      properties:\n";
  for (auto const& [member, key, said] : fields.lines()) text += property(key, said.schema, member.doc);
  return text;
}

}  // namespace lapwing::station::internal
