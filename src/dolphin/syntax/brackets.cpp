#include "dolphin/syntax/internal/brackets.hpp"
#include "dolphin/syntax/codes.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

namespace lapwing::dolphin {

namespace {

using enum TokenKind;

enum class Bracket : std::uint8_t { paren, bracket, brace, interpolation, string };
struct Side {
  Bracket bracket;
  bool opens;
};

std::optional<Side> side(TokenKind kind) {
  switch (kind) {
    case left_paren: return Side{Bracket::paren, true};
    case right_paren: return Side{Bracket::paren, false};
    case left_bracket: return Side{Bracket::bracket, true};
    case right_bracket: return Side{Bracket::bracket, false};
    case left_brace: return Side{Bracket::brace, true};
    case right_brace: return Side{Bracket::brace, false};
    case interpolation_open: return Side{Bracket::interpolation, true};
    case interpolation_close: return Side{Bracket::interpolation, false};
    case string_open: return Side{Bracket::string, true};
    case string_close: return Side{Bracket::string, false};
    default: return std::nullopt;
  }
}

class Matcher {
 public:
  Matcher(std::vector<Token>& tokens, base::Diagnostics& diagnostics) : tokens_(tokens), diagnostics_(diagnostics) {}

  void run() {
    std::size_t kept = 0;
    bool newline_pending = false;
    for (std::size_t read = 0; read < tokens_.size(); ++read) {
      auto token = tokens_[read];
      token.newline_before = token.newline_before || newline_pending;
      auto const bracket = side(token.kind);
      newline_pending = bracket && !bracket->opens && !closes(bracket->bracket, token);
      if (newline_pending) {
        newline_pending = token.newline_before;
        continue;
      }
      if (bracket) place(*bracket, token, static_cast<std::uint32_t>(kept));
      tokens_[kept++] = token;
    }
    tokens_.resize(kept);
    for (auto const opener : open_) never_closed(opener, std::nullopt);
  }

 private:
  std::uint32_t& open_count(Bracket bracket) { return open_counts_[static_cast<std::size_t>(bracket)]; }

  /// Whether a closing bracket has something to close; what was opened since then and not closed is reported.
  bool closes(Bracket bracket, Token const& closer) {
    if (open_count(bracket) == 0) {
      diagnostics_.report(code("unmatched-bracket"), closer.span,
                          fmt::format("this {} closes nothing", diagnostics_.source().text(closer.span)));
      return false;
    }
    while (side(tokens_[open_.back()].kind)->bracket != bracket) {
      never_closed(open_.back(), closer.span);
      pop();
    }
    return true;
  }

  void place(Side bracket, Token& token, std::uint32_t index) {
    if (bracket.opens) {
      if (bracket.bracket == Bracket::interpolation) outer_counts_.push_back(std::exchange(open_counts_, {}));
      open_.push_back(index);
      ++open_count(bracket.bracket);
      return;
    }
    token.partner = open_.back();
    tokens_[open_.back()].partner = index;
    pop();
    if (bracket.bracket == Bracket::interpolation) {
      open_counts_ = outer_counts_.back();
      outer_counts_.pop_back();
    }
  }
  void pop() {
    --open_count(side(tokens_[open_.back()].kind)->bracket);
    open_.pop_back();
  }

  void never_closed(std::uint32_t opener, std::optional<base::Span> before) {
    auto const span = tokens_[opener].span;
    std::vector<base::DiagnosticNote> notes;
    if (before) notes.push_back({*before, "it would have to be closed before this"});
    diagnostics_.report(code("unclosed-bracket"), span,
                        fmt::format("this {} is never closed", diagnostics_.source().text(span)), {}, std::move(notes));
  }

  std::vector<Token>& tokens_;
  base::Diagnostics& diagnostics_;
  std::vector<std::uint32_t> open_;
  using Counts = std::array<std::uint32_t, 5>;
  Counts open_counts_{};              ///< within the innermost interpolation: its brackets cannot close those outside
  std::vector<Counts> outer_counts_;  ///< of the interpolations round it
};

}  // namespace

void match_brackets(std::vector<Token>& tokens, base::Diagnostics& diagnostics) {
  Matcher(tokens, diagnostics).run();
}

}  // namespace lapwing::dolphin
