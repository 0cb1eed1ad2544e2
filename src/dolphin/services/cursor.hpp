#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "dolphin/services/document.hpp"

/// What stands round a place in a script that may not parse yet: worked out from its tokens alone.
namespace lapwing::dolphin {

inline constexpr std::size_t no_token = static_cast<std::size_t>(-1);

struct Cursor {
  std::uint32_t offset = 0;
  base::Span word;                ///< the word that is being written; empty at the offset where there is none
  std::size_t before = no_token;  ///< the token before that word
  bool in_comment = false;
  bool in_number = false;
  bool in_text = false;  ///< of a string; the word is then what is between its quotes
  bool begins_statement = false;
};
[[nodiscard]] Cursor cursor_at(Document const& document, std::uint32_t offset);

/// The blocks of words (pick, mission, ...) round the cursor, innermost first.
[[nodiscard]] std::vector<BlockWords const*> blocks_round(Document const& document, Cursor const& cursor);

/// The call whose arguments the cursor stands in.
struct OpenCall {
  std::size_t callee = no_token;  ///< index of the last word of what is called
  std::size_t argument = 0;       ///< how many commas stand before the cursor
};
[[nodiscard]] std::optional<OpenCall> open_call(Document const& document, Cursor const& cursor);

/// The instruction, or command of one of the blocks round it, that a word means as a callee.
struct Callee {
  InstructionSpec const* spec = nullptr;
  BlockWords const* block = nullptr;  ///< of a command
};
[[nodiscard]] Callee callee_named(std::string_view name, std::vector<BlockWords const*> const& blocks,
                                  Vocabulary const& vocabulary);

}  // namespace lapwing::dolphin
