#include "dolphin/value/text.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/objects.hpp"

namespace lapwing::dolphin {
namespace {

/// Significant digits and decimal exponent of "d.ddde+xx".
struct Decimal {
  std::string digits;
  int exponent = 0;
};

Decimal take_apart(std::string_view scientific) {
  Decimal result;
  auto const e = scientific.find('e');
  for (char const c : scientific.substr(0, e)) {
    if (c != '.') result.digits += c;
  }
  auto exponent = scientific.substr(e + 1);
  if (exponent.front() == '+') exponent.remove_prefix(1);
  std::from_chars(exponent.data(), exponent.data() + exponent.size(), result.exponent);
  while (result.digits.size() > 1 && result.digits.back() == '0') result.digits.pop_back();
  return result;
}

Decimal shortest_decimal(double number) {
  std::array<char, 64> buffer{};
  auto const end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::scientific).ptr;
  auto exact = take_apart({buffer.data(), static_cast<std::size_t>(end - buffer.data())});
  if (exact.digits.size() < 16) return exact;
  // 0.30000000000000004 is 0.3 with the noise of one addition; 1.4142135623730951 stays what it is.
  auto rounded = take_apart(fmt::format("{:.14e}", number));
  return rounded.digits.size() <= 12 ? rounded : exact;
}

std::string plain(Decimal const& decimal) {
  auto const& digits = decimal.digits;
  int const point = decimal.exponent + 1;
  int const count = static_cast<int>(digits.size());
  if (point <= 0) return "0." + std::string(static_cast<std::size_t>(-point), '0') + digits;
  if (point >= count) return digits + std::string(static_cast<std::size_t>(point - count), '0') + ".0";
  return digits.substr(0, static_cast<std::size_t>(point)) + "." + digits.substr(static_cast<std::size_t>(point));
}

std::string position_text(geo::Wgs84 const& p) {
  return fmt::format("({:.6f},{:.6f},{:.3f})", p.lat_deg(), p.lon_deg(), p.alt_m);
}

class Printer {
 public:
  void print(Value const& value, int depth) {
    if (depth > max_printed_depth || out_.size() > max_printed_size) {
      out_ += "…";
      return;
    }
    switch (value.kind()) {
      case ValueKind::null: out_ += "null"; break;
      case ValueKind::boolean: out_ += value.boolean() ? "true" : "false"; break;
      case ValueKind::integer: out_ += std::to_string(value.integer()); break;
      case ValueKind::real: out_ += to_text(value.real()); break;
      case ValueKind::text: out_ += value.as<Text>()->text; break;
      case ValueKind::list: print_list(*value.as<List>(), depth); break;
      case ValueKind::map: print_map(*value.as<Map>(), depth); break;
      case ValueKind::entry:
        print(value.as<Entry>()->key, depth + 1);
        out_ += '=';
        print(value.as<Entry>()->value, depth + 1);
        break;
      default: out_ += object_text(value); break;
    }
  }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  void print_list(List const& list, int depth) {
    out_ += '[';
    for (std::size_t i = 0; i < list.items.size() && out_.size() <= max_printed_size; ++i) {
      if (i > 0) out_ += ", ";
      print(list.items[i], depth + 1);
    }
    out_ += ']';
  }
  void print_map(Map const& map, int depth) {
    if (map.size() == 0) {
      out_ += "[:]";
      return;
    }
    out_ += '[';
    bool first = true;
    for (auto const& [key, value] : map.items()) {
      if (out_.size() > max_printed_size) break;
      if (!first) out_ += ", ";
      first = false;
      print(key, depth + 1);
      out_ += ':';
      print(value, depth + 1);
    }
    out_ += ']';
  }
  static std::string vehicles_text(Vehicles const& set) {
    std::string text = "{ ";
    for (auto const& id : set.ids) text += id.text + " ";
    return text + "}";
  }
  static std::string object_text(Value const& value) {
    switch (value.kind()) {
      case ValueKind::range: {
        auto const& range = *value.as<Range>();
        return range.size == 0 ? "[]" : fmt::format("{}..{}", range.first, range.last);
      }
      case ValueKind::vehicles: return vehicles_text(*value.as<Vehicles>());
      case ValueKind::vehicle: return value.as<Vehicle>()->value.text;
      case ValueKind::position: return position_text(value.as<Position>()->value);
      case ValueKind::displacement: {
        auto const& d = value.as<Displacement>()->value;
        return fmt::format("({:.3f},{:.3f},{:.3f})", d.north, d.east, d.down);
      }
      case ValueKind::area: return to_text(value.as<Area>()->value);
      case ValueKind::task: return tasks::name(value.as<TaskValue>()->value);
      case ValueKind::error: return value.as<Error>()->value.type + ": " + value.as<Error>()->value.message;
      case ValueKind::outcome: {
        auto const& outcome = value.as<ExecuteOutcome>()->value;
        return outcome.done ? "done" : "failed: " + outcome.error;
      }
      case ValueKind::type: return value.as<TypeValue>()->value.name;
      case ValueKind::pattern: return value.as<PatternValue>()->value->text();
      default: return std::string(kind_name(value));
    }
  }

  std::string out_;
};

}  // namespace

std::string to_text(double number) {
  if (std::isnan(number)) return "NaN";
  if (std::isinf(number)) return number > 0 ? "Infinity" : "-Infinity";
  if (number == 0.0) return "0.0";
  auto const decimal = shortest_decimal(std::fabs(number));
  std::string const sign = number < 0 ? "-" : "";
  if (decimal.exponent >= -6 && decimal.exponent < 15) return sign + plain(decimal);
  auto const rest = decimal.digits.size() > 1 ? decimal.digits.substr(1) : "0";
  return fmt::format("{}{}.{}E{}", sign, decimal.digits[0], rest, decimal.exponent);
}

std::string to_text(geo::Disc const& area) {
  return fmt::format("area({} <> {:.6f})", position_text(area.center), area.radius_m);
}

std::string to_text(Value const& value) {
  Printer printer;
  printer.print(value, 0);
  return printer.take();
}

Checked<Value> make_text(Heap& heap, std::string text) {
  if (text.size() > max_text_size) {
    return fault(fmt::format("a text cannot be longer than {} KiB", max_text_size >> 10U), "OutOfMemoryError");
  }
  return Value(heap.make<Text>(std::move(text)));
}

std::size_t find_text(std::string_view text, std::string_view wanted, std::size_t from) {
  if (from > text.size()) return std::string_view::npos;
  // memmem is linear, which std::string::find and std::search are not: 'aaa...' in 'aaa...' would take minutes.
  auto const* const found = ::memmem(text.data() + from, text.size() - from, wanted.data(), wanted.size());
  return found ? static_cast<std::size_t>(static_cast<char const*>(found) - text.data()) : std::string_view::npos;
}

std::string_view kind_name(ValueKind kind) {
  static constexpr std::array names = {
      "null",       "a boolean",      "an integer", "a number",  "a text",        "a list",
      "a map",      "an entry",       "a range",    "a closure", "a vehicle set", "a vehicle",
      "a position", "a displacement", "an area",    "a task",    "an exception",  "a result of execute",
      "a type",     "a pattern",      "a variable"};
  static_assert(names.size() == static_cast<std::size_t>(ValueKind::cell) + 1);
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace lapwing::dolphin
