#include "dolphin/syntax/internal/literals.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "dolphin/syntax/characters.hpp"
#include "dolphin/syntax/codes.hpp"

namespace lapwing::dolphin {

namespace {

std::optional<char> simple_escape(char c) {
  switch (c) {
    case 'n': return '\n';
    case 't': return '\t';
    case 'r': return '\r';
    case 'b': return '\b';
    case 'f': return '\f';
    case '\\':
    case '\'':
    case '"':
    case '$': return c;
    default: return std::nullopt;
  }
}

class StringDecoder {
 public:
  StringDecoder(base::Span span, base::Diagnostics& diagnostics)
      : begin_(span.begin), text_(diagnostics.source().text(span)), diagnostics_(diagnostics) {}

  std::string run() {
    while (at_ < text_.size()) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
        read_escape();
      } else if (text_[at_] == '\r') {
        skip_line_end();
        out_ += '\n';
      } else {
        copy_character();
      }
    }
    return std::move(out_);
  }

 private:
  /// Texts go into JSON and onto terminals: what is no character stops here.
  void copy_character() {
    auto const c = text_[at_];
    auto const size = c > 0 ? 1 : decode_utf8(text_.substr(at_)).size;
    bool const is_control = (c >= 0 && c < ' ' && c != '\n' && c != '\t') || c == '\x7F';
    if (size > 0 && !is_control) {
      out_ += text_.substr(at_, size);
      at_ += size;
      return;
    }
    auto const mistake = unreadable_character(text_.substr(at_));
    auto const begin = at_++;
    if (std::exchange(has_unreadable_, true)) return;  // once a text
    diagnostics_.report(code("invalid-character"), span_since(begin), std::string(mistake.message),
                        std::string(mistake.hint));
  }

  [[nodiscard]] base::Span span_since(std::size_t begin) const {
    return {static_cast<std::uint32_t>(begin_ + begin), static_cast<std::uint32_t>(begin_ + at_)};
  }

  void skip_line_end() { at_ += text_.substr(at_).starts_with("\r\n") ? 2 : 1; }

  void read_escape() {
    auto const begin = at_++;
    auto const c = text_[at_];
    if (auto const plain = simple_escape(c)) {
      out_ += *plain;
      ++at_;
    } else if (c == '\n' || c == '\r') {
      skip_line_end();  // a line end after a backslash is not part of the text
    } else if (c == 'u') {
      read_unicode(begin);
    } else {
      at_ += std::max<std::size_t>(decode_utf8(text_.substr(at_)).size, 1);
      error(begin, fmt::format("'{}' is not an escape", text_.substr(begin, at_ - begin)),
            R"(write \\ for a backslash)");
    }
  }

  /// Four hexadecimal digits after \u, as a UTF-16 unit.
  std::optional<char32_t> read_unit() {
    unsigned value = 0;
    auto const digits = text_.substr(at_ + 1, 4);
    auto const [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (failure != std::errc{} || digits.size() != 4 || end != digits.data() + 4) return std::nullopt;
    at_ += 5;
    return value;
  }

  void read_unicode(std::size_t begin) {
    auto unit = read_unit();
    if (!unit) {
      ++at_;
      return error(begin, R"(\u needs four hexadecimal digits)", {});
    }
    if (*unit >= 0xD800 && *unit < 0xDC00 && text_.substr(at_).starts_with("\\u")) {
      ++at_;
      auto const low = read_unit();
      unit = low && *low >= 0xDC00 && *low < 0xE000 ? 0x10000 + ((*unit - 0xD800) << 10u) + (*low - 0xDC00) : *unit;
    }
    if (*unit >= 0xD800 && *unit < 0xE000) return error(begin, "this is half a character", "write both halves");
    append_utf8(out_, *unit);
  }

  void error(std::size_t begin, std::string message, std::string hint) {
    diagnostics_.report(code("invalid-escape"), span_since(begin), std::move(message), std::move(hint));
  }

  std::uint32_t begin_;
  std::string_view text_;
  base::Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  bool has_unreadable_ = false;
  std::string out_;
};

std::string digits_of(std::string_view text) {
  std::string out;
  for (char const c : text) {
    if (c != '_') out += c;
  }
  return out;
}

}  // namespace

std::string decode_string(base::Span span, base::Diagnostics& diagnostics) {
  return StringDecoder(span, diagnostics).run();
}

ast::Expr::Node decode_number(base::Span span, bool is_decimal, base::Diagnostics& diagnostics) {
  auto const digits = digits_of(diagnostics.source().text(span));
  auto const* const end = digits.data() + digits.size();
  if (is_decimal) {
    double value = 0.0;
    if (std::from_chars(digits.data(), end, value).ec == std::errc::result_out_of_range) {
      value = std::strtod(digits.c_str(), nullptr);  // tells too small (0) from too large (infinity)
      if (std::isinf(value)) diagnostics.report(code("number-too-large"), span, "this number is too large");
    }
    return ast::DecimalLiteral{value};
  }
  auto const prefix = digits.size() > 1 && digits[0] == '0' ? digits[1] : '\0';
  int const base = prefix == 'x' || prefix == 'X' ? 16 : prefix == 'b' || prefix == 'B' ? 2 : 10;
  std::int64_t value = 0;
  auto const failure = std::from_chars(digits.data() + (base == 10 ? 0 : 2), end, value, base).ec;
  if (failure == std::errc::result_out_of_range) {
    diagnostics.report(code("number-too-large"), span, "this number does not fit into 64 bits",
                       "write it with a decimal point");
  }
  return ast::IntegerLiteral{value};
}

}  // namespace lapwing::dolphin
