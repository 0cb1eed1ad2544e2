#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "dolphin/syntax/ast.hpp"
#include "dolphin/syntax/token.hpp"

namespace lapwing::dolphin {

/// Where statements begin, for formatters: the byte offset of their first word, and by how many levels they are
/// indented below what the brackets round them say (the body of an `if` without braces, the statements of a `case`).
/// `else`, `catch` and `finally` are in it too, with the level of what they belong to.
using StatementPlaces = std::unordered_map<std::uint32_t, std::size_t>;

/// `source` and `tokens` are what `program` was parsed from.
[[nodiscard]] StatementPlaces statement_places(ast::Program const& program, std::span<Token const> tokens,
                                               base::SourceFile const& source);

}  // namespace lapwing::dolphin
