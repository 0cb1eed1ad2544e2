#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/ast.hpp"
#include "dolphin/syntax/codes.hpp"
#include "dolphin/syntax/token.hpp"

namespace lapwing::dolphin {

/// How tightly a binary operator binds; 1 is the weakest. (Language specification 2: Groovy's order.)
struct Operator {
  int strength;
  enum class Form { binary, range, range_exclusive, cast, instance_of } form = Form::binary;
  ast::BinaryOp op = ast::BinaryOp::add;
};

/// Recursive descent over the tokens of one script; binary operators by precedence climbing (language specification 1.3
/// to 1.7).
///
/// Parsing functions never fail: after a mistake they return what they have, ErrorExpr for what is missing, and say
/// nothing more until the statement ends (`quiet_`), where the statement loop finds its footing again.
class Parser {
 public:
  Parser(std::vector<Token> const& tokens, base::Diagnostics& diagnostics,
         std::span<std::string_view const> instructions)
      : tokens_(tokens), diagnostics_(diagnostics), instructions_(instructions) {}

  /// The whole script.
  ast::Block script();
  /// What was passed over to find a footing again.
  [[nodiscard]] std::vector<base::Span> const& unread() const { return unread_; }

 private:
  // ---- tokens (parser.cpp)
  [[nodiscard]] Token const& token(std::size_t ahead = 0) const;
  [[nodiscard]] TokenKind kind(std::size_t ahead = 0) const { return token(ahead).kind; }
  [[nodiscard]] std::string_view text(Token const& token) const { return diagnostics_.source().text(token.span); }
  [[nodiscard]] bool at(TokenKind wanted) const { return kind() == wanted; }
  [[nodiscard]] bool at_word(std::string_view word, std::size_t ahead = 0) const;
  [[nodiscard]] bool on_same_line(std::size_t ahead = 0) const { return !token(ahead).newline_before; }
  Token const& advance();
  bool accept(TokenKind wanted);
  ast::Identifier identifier_of(Token const& token) const;
  [[nodiscard]] base::Span since(std::uint32_t begin) const;
  /// The span of the next token, or of the blank before it when that is on another line.
  [[nodiscard]] base::Span here() const;

  // ---- mistakes (parser.cpp)
  void error(base::DiagnosticKind const& kind, base::Span span, std::string message, base::Hint hint = {});
  /// "expected X, found Y" at the next token.
  void expected(std::string_view what, base::Hint hint = {});
  bool expect(TokenKind wanted, std::string_view what);
  [[nodiscard]] std::string describe(Token const& token) const;
  /// What people who come from other languages probably meant by the next token.
  [[nodiscard]] std::string hint_for_place() const;
  ast::ExprPtr broken();

  // ---- brackets and lines (parser.cpp)
  /// Whether the next token stands behind the end of the statement.
  [[nodiscard]] bool at_statement_end() const;
  /// Steps behind the bracket that closes `opener`, over whatever is left before it; nothing when it is never closed.
  void close(std::size_t opener);
  void skip_statement();

  // ---- nodes (parser.cpp)
  ast::ExprPtr make(ast::Expr::Node node, base::Span span);
  ast::StmtPtr make_statement(ast::Stmt::Node node, std::uint32_t begin);

  // ---- statements (parser_statements.cpp)
  ast::Block statements(TokenKind end);
  void statement_into(ast::Block& block);
  void unexpected_in_statement();
  ast::StmtPtr statement();
  ast::StmtPtr keyword_statement();
  ast::StmtPtr simple_statement();
  ast::StmtPtr assignment(ast::ExprPtr target, std::uint32_t begin);
  void assignable(ast::Expr const& target);
  [[nodiscard]] bool at_unpacking_assignment() const;
  ast::StmtPtr unpacking_assignment();
  ast::StmtPtr do_statement();
  [[nodiscard]] bool at_else_if_word() const;
  // words of other languages that begin statements (parser_foreign.cpp)
  [[nodiscard]] bool at_foreign_declaration() const;
  [[nodiscard]] bool at_foreign_function() const;
  ast::StmtPtr foreign_declaration();
  ast::StmtPtr foreign_function();
  ast::ExprPtr bare_condition(std::string_view keyword, std::uint32_t begin);
  ast::StmtPtr bare_for(std::uint32_t begin);
  ast::StmtPtr labelled();
  ast::StmtPtr if_statement();
  ast::StmtPtr while_statement();
  ast::StmtPtr for_statement();
  ast::StmtPtr for_in(std::size_t opener, std::uint32_t begin);
  ast::StmtPtr switch_statement();
  ast::SwitchCase switch_case();
  ast::StmtPtr try_statement();
  ast::Catch catch_clause();
  ast::StmtPtr return_statement();
  ast::StmtPtr throw_statement();
  ast::StmtPtr assert_statement();
  ast::StmtPtr import_statement();
  ast::StmtPtr unsupported_statement();
  ast::StmtPtr declaration();
  ast::StmtPtr function(ast::Identifier name, std::uint32_t begin);
  ast::StmtPtr unpacking(std::uint32_t begin);
  [[nodiscard]] bool at_typed_declaration() const;
  std::vector<ast::Parameter> parameters(TokenKind end);
  ast::ExprPtr condition(std::string_view keyword, std::string_view what);
  ast::Block block();
  ast::Block braces(std::string_view what);

  // ---- expressions (parser_expressions.cpp)
  ast::ExprPtr expression();
  ast::ExprPtr ternary();
  ast::ExprPtr binary(int weakest);
  [[nodiscard]] bool operator_continues() const;
  ast::ExprPtr unary();
  [[nodiscard]] bool at_least_integer() const;
  ast::ExprPtr power();
  ast::ExprPtr signed_postfix();
  [[nodiscard]] bool starts_value(std::size_t ahead) const;
  [[nodiscard]] bool at_joining_word(std::size_t ahead) const;
  std::optional<Operator> joining_word();
  [[nodiscard]] bool at_cast() const;
  ast::ExprPtr cast();
  ast::ExprPtr primary();
  ast::ExprPtr literal();
  ast::ExprPtr pattern_literal();
  ast::ExprPtr interpolated_string();
  ast::ExprPtr interpolated_name(Token const& token);
  ast::ExprPtr interpolated_expression();
  ast::ExprPtr list_or_map();
  ast::ExprPtr map_entries(std::size_t opener, std::uint32_t begin);
  ast::ExprPtr new_object();
  ast::ExprPtr in_parentheses();
  ast::ExprPtr closure();
  [[nodiscard]] bool has_arrow() const;

  // ---- calls and chains (parser_calls.cpp)
  ast::ExprPtr command();
  ast::ExprPtr command_call(std::size_t callee_size);
  ast::ExprPtr wrapped_argument();
  ast::ExprPtr callee_path(std::size_t size);
  [[nodiscard]] std::size_t path_size() const;
  [[nodiscard]] std::size_t command_callee_size() const;
  [[nodiscard]] bool starts_argument(std::size_t ahead) const;
  [[nodiscard]] bool at_bracketed_first_argument(std::size_t ahead) const;
  [[nodiscard]] bool at_argument_name(std::size_t ahead = 0) const;
  [[nodiscard]] bool is_void_instruction(std::string_view word) const;
  [[nodiscard]] bool at_wrapped_argument() const;
  ast::ExprPtr misplaced_chain_word(ast::ExprPtr left, std::uint32_t begin);
  std::vector<ast::Argument> arguments_until_line_end();
  ast::Argument argument();
  ast::ExprPtr postfix();
  ast::ExprPtr postfix_of(ast::ExprPtr object, std::uint32_t begin);
  ast::ExprPtr member(ast::ExprPtr object, std::uint32_t begin);
  ast::ExprPtr call(ast::ExprPtr callee, std::uint32_t begin);
  ast::ExprPtr trailing_closure(ast::ExprPtr callee, std::uint32_t begin);
  ast::ExprPtr index(ast::ExprPtr object, std::uint32_t begin);
  std::vector<ast::Argument> arguments_in_parentheses();
  [[nodiscard]] std::optional<ast::ChainKind> chain_head() const;
  [[nodiscard]] bool at_during_chain(std::size_t ahead) const;
  ast::ExprPtr chain(ast::ChainKind kind);
  ast::ExprPtr chain_subject(ast::ChainKind kind);
  ast::ExprPtr chain_body(ast::ChainKind kind);
  bool chain_word(ast::ChainKind kind);
  [[nodiscard]] bool at_otherwise() const;
  ast::ExprPtr otherwise();

  std::vector<Token> const& tokens_;
  base::Diagnostics& diagnostics_;
  std::span<std::string_view const> instructions_;  ///< those that a platform adds
  std::size_t next_ = 0;
  bool newlines_matter_ = true;  ///< false inside ( ) and [ ]
  bool quiet_ = false;           ///< a mistake of this statement has been reported
  bool depth_reported_ = false;
  std::size_t depth_ = 0;
  std::vector<base::Span> unread_;

  friend class Nesting;
};

/// One level of recursion; false when there are too many.
class Nesting {
 public:
  explicit Nesting(Parser& parser);
  Nesting(Nesting const&) = delete;
  Nesting& operator=(Nesting const&) = delete;
  ~Nesting() { --parser_.depth_; }
  explicit operator bool() const { return parser_.depth_ <= ast::max_tree_height; }

 private:
  Parser& parser_;
};

/// Lines and blanks mean something else within brackets; gives the old meaning back at the end.
class Lines {
 public:
  Lines(bool& matter, bool now) : matter_(matter), before_(matter) { matter_ = now; }
  Lines(Lines const&) = delete;
  Lines& operator=(Lines const&) = delete;
  ~Lines() { matter_ = before_; }

 private:
  bool& matter_;
  bool before_;
};

}  // namespace lapwing::dolphin
