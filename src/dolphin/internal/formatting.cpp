#include <fmt/format.h>

#include <cmath>

#include "dolphin/internal/code_points.hpp"
#include "dolphin/internal/methods.hpp"
#include "dolphin/limits.hpp"

namespace lapwing::dolphin::internal {
namespace {

constexpr std::size_t widest = 1000;

/// One "%-8.2f": what stands between the percent sign and the letter, and the letter.
struct Field {
  bool at_left = false;
  bool zeros = false;
  bool plus = false;
  std::size_t width = 0;
  std::optional<std::size_t> precision;
  char conversion = '\0';
  std::size_t size = 0;  ///< characters, the percent sign not included
};

std::size_t read_number(std::string_view text, std::size_t& at) {
  std::size_t number = 0;
  for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at) {
    number = std::min(number * 10 + static_cast<std::size_t>(text[at] - '0'), widest);
  }
  return number;
}

Field read_field(std::string_view text) {
  Field field;
  std::size_t at = 0;
  for (; at < text.size() && std::string_view("-0+").contains(text[at]); ++at) {
    field.at_left = field.at_left || text[at] == '-';
    field.zeros = field.zeros || text[at] == '0';
    field.plus = field.plus || text[at] == '+';
  }
  field.width = read_number(text, at);
  if (at < text.size() && text[at] == '.') field.precision = read_number(text, ++at);
  field.conversion = at < text.size() ? text[at] : '\0';
  field.size = at + (at < text.size() ? 1 : 0);
  return field;
}

std::string signed_text(Field const& field, bool is_negative, std::string digits) {
  std::string const sign = is_negative ? "-" : field.plus ? "+" : "";
  auto const length = sign.size() + digits.size();
  if (field.zeros && length < field.width) digits.insert(0, field.width - length, '0');
  return sign + digits;
}

std::unexpected<Fault> unfit(Field const& field, Value const& value) {
  return fault(fmt::format("%{} cannot show {}", field.conversion, kind_name(value)), "IllegalFormatException");
}

Checked<std::string> real_text(Field const& field, Value const& value) {
  if (!value.is_number()) return unfit(field, value);
  double const number = value.number();
  if (!std::isfinite(number)) return to_text(number);
  auto const precision = static_cast<int>(field.precision.value_or(6));
  auto const digits = field.conversion == 'e' ? fmt::format("{:.{}e}", std::fabs(number), precision)
                                              : fmt::format("{:.{}f}", std::fabs(number), precision);
  return signed_text(field, std::signbit(number), digits);
}

Checked<std::string> integer_text(Field const& field, Value const& value) {
  if (!value.is(ValueKind::integer)) return unfit(field, value);
  auto const number = value.integer();
  if (field.conversion == 'x')
    return signed_text(field, false, fmt::format("{:x}", static_cast<std::uint64_t>(number)));
  auto const digits = fmt::format("{}", number);
  return signed_text(field, number < 0, number < 0 ? digits.substr(1) : digits);
}

Checked<std::string> field_text(Field const& field, Value const& value) {
  switch (field.conversion) {
    case 's':
    case 'b': {
      auto text = to_text(value);
      if (!field.precision) return text;
      auto const pieces = code_points(text);
      std::string cut;
      for (std::size_t i = 0; i < std::min(*field.precision, pieces.size()); ++i) cut += pieces[i];
      return cut;
    }
    case 'd':
    case 'x': return integer_text(field, value);
    case 'f':
    case 'e': return real_text(field, value);
    default: break;
  }
  return fault("format knows %d, %f, %e, %x, %s, %b, %n and %%", "IllegalFormatException");
}

}  // namespace

Checked<std::string> formatted(std::string_view pattern, Native::Arguments arguments) {
  std::string out;
  std::size_t next = 0;
  while (!pattern.empty() && out.size() <= max_text_size) {
    auto const sign = std::min(pattern.find('%'), pattern.size());
    out += pattern.substr(0, sign);
    if (sign == pattern.size()) break;
    pattern.remove_prefix(sign + 1);
    auto const field = read_field(pattern);
    pattern.remove_prefix(field.size);
    if (field.conversion == '%' || field.conversion == 'n') {
      out += field.conversion == '%' ? '%' : '\n';
      continue;
    }
    if (next == arguments.size()) return fault("format has too few values", "IllegalFormatException");
    auto const text = field_text(field, arguments[next++]);
    if (!text) return std::unexpected(text.error());
    auto const length = count_code_points(*text);
    std::string const blanks(length < field.width ? field.width - length : 0, ' ');
    out += field.at_left ? *text + blanks : blanks + *text;
  }
  return out;
}

}  // namespace lapwing::dolphin::internal
