#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/ast.hpp"

/// Hints that carry the changes which they speak of.
namespace lapwing::dolphin {

/// "did you mean UAV?" of a text in quotes; the quotes stay. Of an expression that is no such text, words alone.
[[nodiscard]] base::Hint did_you_mean_in_quotes(base::SourceFile const& source, ast::Expr const& expr,
                                                std::string_view word, std::span<std::string_view const> candidates);

/// `type: 'UAV'` without its colon.
[[nodiscard]] base::Hint without_colon(base::SourceFile const& source, base::Span word);

/// `action { ... }` for a closure where a task is needed.
[[nodiscard]] base::Hint wrapped_in_action(ast::Expr const& closure);

/// `execute` before a task that is a statement.
[[nodiscard]] base::Hint executed(base::SourceFile const& source, base::Span task);

/// `type = 'UAV'` as `type 'UAV'`.
[[nodiscard]] base::Hint without_equals_sign(base::SourceFile const& source, base::Span word);

/// `callee argument` with parentheses round the argument: `execute (a) | b`, `message [1]`.
[[nodiscard]] std::vector<base::Edit> with_parentheses(base::Span callee, base::Span argument);

/// `lon -8.64` as `lon (-8.64)`; `callee` is the word, `all` the whole expression.
[[nodiscard]] std::vector<base::Edit> argument_in_parentheses(base::SourceFile const& source, base::Span callee,
                                                              base::Span all);

/// `task during 2.seconds` and `task.during(2.seconds)` as `during 2.seconds run task`; `all` is the whole of it.
[[nodiscard]] base::Hint in_front(base::SourceFile const& source, base::Span during, base::Span all);

/// A number with its unit: 30 as 30.percent. Of what is no plain number, words alone.
[[nodiscard]] base::Hint with_unit(base::SourceFile const& source, ast::Expr const& number, std::string_view unit);

}  // namespace lapwing::dolphin
