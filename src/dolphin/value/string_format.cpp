#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "dolphin/builtin/method_call.hpp"
#include "dolphin/syntax/characters.hpp"
#include "dolphin/syntax/code_points.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/equality.hpp"

/// `String.format`, as java.util.Formatter has it for numbers, texts and truths. What is not here is refused.
namespace lapwing::dolphin::internal {
namespace {

constexpr std::size_t widest = 10'000;

/// One "%2$-8.2f".
struct Field {
  std::string_view written;  ///< the whole of it, for messages
  std::size_t index = 0;     ///< 2 of 2$; 0: the next argument
  bool again = false;        ///< <: the argument of the field before
  bool at_left = false;      ///< -
  bool alternative = false;  ///< #
  bool plus = false;         ///< +
  bool blank = false;        ///< a space
  bool zeros = false;        ///< 0
  bool grouped = false;      ///< ,
  bool bracketed = false;    ///< (
  std::optional<std::size_t> width;
  std::optional<std::size_t> precision;
  char conversion = '\0';
};

std::unexpected<Fault> refused(std::string message) {
  return fault(std::move(message), "IllegalFormatException");
}

class FieldReader {
 public:
  /// `text` begins behind the percent sign.
  explicit FieldReader(std::string_view text) : text_(text) {}

  Checked<Field> run() {
    read_index();
    while (read_flag()) {
    }
    bool is_short = read_number(field_.width);
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      is_short = read_number(field_.precision) && is_short;
      if (!field_.precision) return refused(fmt::format("a precision is missing behind the point of {}", written()));
    }
    if (at_ == text_.size()) return refused(fmt::format("{} is no field of format: its letter is missing", written()));
    field_.conversion = text_[at_++];
    field_.written = text_.substr(0, at_);
    if (!is_short) return refused(fmt::format("%{} is wider than {} characters", field_.written, widest));
    return field_;
  }
  [[nodiscard]] std::size_t size() const { return at_; }

 private:
  [[nodiscard]] std::string written() const { return "%" + std::string(text_.substr(0, at_)); }

  void read_index() {
    auto end = at_;
    while (end < text_.size() && is_digit(text_[end])) ++end;
    if (end == at_ || end - at_ > 3 || end == text_.size() || text_[end] != '$' || text_[at_] == '0') return;
    std::from_chars(text_.data() + at_, text_.data() + end, field_.index);
    at_ = end + 1;
  }
  bool read_flag() {
    if (at_ == text_.size()) return false;
    switch (text_[at_]) {
      case '-': field_.at_left = true; break;
      case '#': field_.alternative = true; break;
      case '+': field_.plus = true; break;
      case ' ': field_.blank = true; break;
      case '0': field_.zeros = true; break;
      case ',': field_.grouped = true; break;
      case '(': field_.bracketed = true; break;
      case '<': field_.again = true; break;
      default: return false;
    }
    ++at_;
    return true;
  }
  /// False when the number is beyond all widths.
  bool read_number(std::optional<std::size_t>& number) {
    bool is_short = true;
    for (; at_ < text_.size() && is_digit(text_[at_]); ++at_) {
      number = number.value_or(0) * 10 + static_cast<std::size_t>(text_[at_] - '0');
      if (*number <= widest) continue;
      number = widest;
      is_short = false;
    }
    return is_short;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Field field_;
};

// ---- numbers

/// The digits of a number and the power of ten of the first one.
struct Digits {
  std::string digits;
  int exponent = 0;
};

/// The fewest digits that tell the number from all others.
Digits digits_of(double number) {
  std::array<char, 64> buffer{};
  auto const end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::scientific).ptr;
  std::string_view const text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  Digits out;
  auto const e = text.find('e');
  for (char const c : text.substr(0, e)) {
    if (c != '.') out.digits += c;
  }
  auto const exponent = text.substr(text[e + 1] == '+' ? e + 2 : e + 1);
  std::from_chars(exponent.data(), exponent.data() + exponent.size(), out.exponent);
  return out;
}

/// The first `count` digits, a five rounded up; zeros where there are none.
Digits rounded(Digits number, std::int64_t count) {
  auto const size = static_cast<std::int64_t>(number.digits.size());
  if (count < 0) return {"0", number.exponent};
  bool const up = count < size && number.digits[static_cast<std::size_t>(count)] >= '5';
  number.digits.resize(static_cast<std::size_t>(count), '0');
  if (!up) return number;
  for (auto at = number.digits.size(); at-- > 0;) {
    if (number.digits[at] != '9') {
      ++number.digits[at];
      return number;
    }
    number.digits[at] = '0';
  }
  number.digits.insert(0, "1");
  ++number.exponent;
  return number;
}

std::string with_point(std::string digits, std::size_t places, bool always) {
  if (places > 0) digits.insert(digits.size() - places, ".");
  if (places == 0 && always) digits += '.';
  return digits;
}

/// 1234.57
std::string fixed(double number, std::size_t places, bool point) {
  auto const exact = digits_of(number);
  // Digits up to the last place; none when the number is less than half of that.
  auto const wanted =
      number == 0.0 ? 0 : static_cast<std::int64_t>(exact.exponent) + 1 + static_cast<std::int64_t>(places);
  auto const short_one = rounded(exact, wanted);
  auto digits = number == 0.0 || wanted < 0 ? std::string() : short_one.digits;
  if (digits.size() < places + 1) digits.insert(0, places + 1 - digits.size(), '0');
  return with_point(std::move(digits), places, point);
}

/// 1.235e+03
std::string scientific(double number, std::size_t places, bool point) {
  auto const short_one = rounded(digits_of(number), static_cast<std::int64_t>(places) + 1);
  auto const exponent = number == 0.0 ? 0 : short_one.exponent;
  auto const digits = short_one.digits.substr(0, places + 1);
  return fmt::format("{}e{}{:02}", with_point(digits, places, point), exponent < 0 ? '-' : '+', std::abs(exponent));
}

std::string general(double number, std::size_t precision) {
  auto const significant = std::max<std::size_t>(precision, 1);
  auto const exponent = number == 0.0 ? 0 : rounded(digits_of(number), static_cast<std::int64_t>(significant)).exponent;
  if (exponent < -4 || exponent >= static_cast<int>(significant)) return scientific(number, significant - 1, false);
  return fixed(number, static_cast<std::size_t>(static_cast<int>(significant) - 1 - exponent), false);
}

/// 1,234,567.5
std::string grouped(std::string digits) {
  auto const end = std::min(digits.find('.'), digits.size());
  for (auto at = static_cast<std::int64_t>(end) - 3; at > 0; at -= 3) digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

std::string with_sign(Field const& field, bool is_negative, std::string digits) {
  if (field.grouped) digits = grouped(std::move(digits));
  std::string const before = is_negative ? (field.bracketed ? "(" : "-") : field.plus ? "+" : field.blank ? " " : "";
  std::string const after = is_negative && field.bracketed ? ")" : "";
  auto const length = before.size() + digits.size() + after.size();
  if (field.zeros && length < field.width.value_or(0)) digits.insert(0, *field.width - length, '0');
  return before + digits + after;
}

std::unexpected<Fault> unfit(Field const& field, Value const& value) {
  return refused(fmt::format("%{} cannot show {}", field.conversion, kind_name(value)));
}

Checked<std::string> real_text(Field const& field, Value const& value) {
  if (!value.is_number()) return unfit(field, value);
  double const number = value.number();
  if (!std::isfinite(number)) return to_text(number);
  auto const precision = field.precision.value_or(6);
  auto const size = std::fabs(number);
  bool const is_small = field.conversion == 'f';
  auto const digits = is_small ? fixed(size, precision, field.alternative)
                      : field.conversion == 'g' || field.conversion == 'G'
                          ? general(size, precision)
                          : scientific(size, precision, field.alternative);
  return with_sign(field, std::signbit(number), digits);
}

Checked<std::string> integer_text(Field const& field, Value const& value) {
  if (!value.is(ValueKind::integer)) return unfit(field, value);
  if (field.precision) return refused(fmt::format("%{} takes no precision", field.written));
  auto const number = value.integer();
  auto const bits = static_cast<std::uint64_t>(number);
  if (field.conversion == 'd') {
    auto const digits = fmt::format("{}", number);
    return with_sign(field, number < 0, number < 0 ? digits.substr(1) : digits);
  }
  auto const* prefix = !field.alternative ? "" : field.conversion == 'o' ? "0" : "0x";
  auto digits = field.conversion == 'o' ? fmt::format("{:o}", bits) : fmt::format("{:x}", bits);
  auto const length = digits.size() + std::string_view(prefix).size();
  if (field.zeros && length < field.width.value_or(0)) digits.insert(0, *field.width - length, '0');
  return prefix + digits;
}

// ---- texts

Checked<std::string> character_text(Field const& field, Value const& value) {
  if (value.is_null()) return std::string("null");
  if (auto const* text = value.as<Text>(); text && count_code_points(text->text) == 1) return text->text;
  bool const is_code = value.is(ValueKind::integer) && value.integer() > 0 && value.integer() < 0x110000 &&
                       (value.integer() < 0xD800 || value.integer() > 0xDFFF);
  if (!is_code) return unfit(field, value);
  std::string out;
  append_utf8(out, static_cast<char32_t>(value.integer()));
  return out;
}

std::string cut(std::string text, std::optional<std::size_t> most) {
  if (!most) return text;
  auto const pieces = code_points(text);
  std::string out;
  for (std::size_t i = 0; i < std::min(*most, pieces.size()); ++i) out += pieces[i];
  return out;
}

Checked<std::string> field_text(Field const& field, Value const& value) {
  switch (field.conversion) {
    case 's':
    case 'S': return cut(to_text(value), field.precision);
    case 'b':
    case 'B': {
      bool const truth = value.is(ValueKind::boolean) ? value.boolean() : !value.is_null();
      return cut(truth ? "true" : "false", field.precision);
    }
    case 'c':
    case 'C': return character_text(field, value);
    case 'd':
    case 'o':
    case 'x':
    case 'X': return integer_text(field, value);
    case 'f':
    case 'e':
    case 'E':
    case 'g':
    case 'G': return real_text(field, value);
    default: break;
  }
  return refused(
      fmt::format("%{} is no field of format: it knows %d %o %x %f %e %g %s %b %c %n and %%", field.written));
}

/// Flags that do not go together, as in Java.
Checked<void> fitting(Field const& field) {
  bool const needs_width = (field.at_left || field.zeros) && !field.width;
  if (needs_width) return refused(fmt::format("%{} has a - or 0 and no width", field.written));
  if (field.at_left && field.zeros) return refused(fmt::format("%{} has both - and 0", field.written));
  if (field.plus && field.blank) return refused(fmt::format("%{} has both + and a blank", field.written));
  bool const is_text = std::string_view("sSbBcC").contains(field.conversion);
  bool const has_number_flag = field.plus || field.blank || field.zeros || field.grouped || field.bracketed;
  if (is_text && has_number_flag) return refused(fmt::format("%{} has a flag of numbers", field.written));
  bool const is_ungrouped = std::string_view("oxXeE").contains(field.conversion);
  if (is_ungrouped && field.grouped) return refused(fmt::format("%{} cannot have a comma", field.written));
  return {};
}

/// The values that the fields of one pattern take: the next one, the one with a number, or once more the one before.
class ValuesInTurn {
 public:
  explicit ValuesInTurn(Arguments values) : values_(values) {}

  Checked<std::string> text_for(Field const& field) {
    if (field.again && !before_) return refused(fmt::format("%{} has no field before it", field.written));
    auto const index = field.again ? *before_ : field.index > 0 ? field.index - 1 : next_++;
    if (index >= values_.size()) return refused(fmt::format("format has too few values for %{}", field.written));
    before_ = index;
    auto text = field_text(field, values_[index]);
    if (text && std::isupper(static_cast<unsigned char>(field.conversion))) text = in_capitals(*text);
    return text;
  }

 private:
  Arguments values_;
  std::size_t next_ = 0;
  std::optional<std::size_t> before_;
};

}  // namespace

Checked<std::string> formatted(std::string_view pattern, Arguments arguments) {
  std::string out;
  ValuesInTurn values(arguments);
  while (!pattern.empty() && out.size() <= max_text_size) {
    auto const sign = std::min(pattern.find('%'), pattern.size());
    out += pattern.substr(0, sign);
    if (sign == pattern.size()) break;
    pattern.remove_prefix(sign + 1);
    FieldReader reader(pattern);
    auto const field = reader.run();
    if (!field) return std::unexpected(field.error());
    pattern.remove_prefix(reader.size());
    if (field->conversion == 'n') {
      out += '\n';
      continue;
    }
    if (auto const fine = fitting(*field); !fine) return std::unexpected(fine.error());
    auto const text = field->conversion == '%' ? Checked<std::string>("%") : values.text_for(*field);
    if (!text) return std::unexpected(text.error());
    auto const length = count_code_points(*text);
    std::string const blanks(length < field->width.value_or(0) ? *field->width - length : 0, ' ');
    out += field->at_left ? *text + blanks : blanks + *text;
  }
  return out;
}

}  // namespace lapwing::dolphin::internal
