#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "dolphin/syntax/token.hpp"

/// The words and signs that the language reserves, and those of other languages that it names.
namespace lapwing::dolphin {

/// The reserved word, or `identifier`.
[[nodiscard]] TokenKind kind_of_word(std::string_view word);

struct Sign {
  TokenKind kind;
  std::size_t size;
};
/// The longest operator, bracket or separator that the text begins with.
[[nodiscard]] std::optional<Sign> sign_at(std::string_view text);

/// An operator of other languages, what it is read as, and what to write.
struct ForeignSign {
  std::string_view theirs;
  TokenKind kind;
  std::string_view hint;
};
[[nodiscard]] ForeignSign const* foreign_sign_at(std::string_view text);

/// Whether a value may begin behind this token, so that a slash begins a pattern and does not divide.
[[nodiscard]] bool asks_for_value(TokenKind kind);

}  // namespace lapwing::dolphin
