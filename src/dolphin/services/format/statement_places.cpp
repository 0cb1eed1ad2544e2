#include "dolphin/services/format/statement_places.hpp"

#include <algorithm>

#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

class Placing {
 public:
  Placing(std::span<Token const> tokens, base::SourceFile const& source) : tokens_(tokens), source_(source) {}

  void statements(ast::Block const& block, std::size_t level) {
    for (auto const& one : block.statements) statement(*one, level);
  }
  [[nodiscard]] StatementPlaces take() { return std::move(places_); }

 private:
  void statement(ast::Stmt const& one, std::size_t level) {
    places_.emplace(one.span.begin, level);
    std::visit([&](auto const& node) { visit(node, one, level); }, one.node);
  }

  /// Statements without statements of their own.
  template <class Node>
  void visit(Node const&, ast::Stmt const& one, std::size_t) {
    ast::for_each_child(one.node, child_);
  }
  void visit(ast::FunctionDecl const& n, ast::Stmt const&, std::size_t level) {
    for (auto const& parameter : n.parameters) expression(parameter.fallback);
    body(n.body, level);
  }
  void visit(ast::If const& n, ast::Stmt const&, std::size_t level) {
    expression(n.condition);
    body(n.then, level);
    if (!n.otherwise) return;
    auto const& other = *n.otherwise;
    auto const keyword = word(TokenKind::kw_else, n.then.span.end, level);
    bool const is_else_if = !has_braces(other) && other.statements.size() == 1 && keyword + 1 < tokens_.size() &&
                            std::holds_alternative<ast::If>(other.statements[0]->node) &&
                            !tokens_[keyword + 1].newline_before;
    if (is_else_if) return statement(*other.statements[0], level);
    body(other, level);
  }
  void visit(ast::While const& n, ast::Stmt const&, std::size_t level) {
    if (!n.body_first) expression(n.condition);
    body(n.body, level);
    if (!n.body_first) return;
    word(TokenKind::kw_while, n.body.span.end, level);
    expression(n.condition);
  }
  void visit(ast::For const& n, ast::Stmt const&, std::size_t level) {
    if (n.init) statement(*n.init, 0);
    expression(n.condition);
    if (n.update) statement(*n.update, 0);
    body(n.body, level);
  }
  void visit(ast::ForIn const& n, ast::Stmt const&, std::size_t level) {
    expression(n.iterable);
    body(n.body, level);
  }
  void visit(ast::Switch const& n, ast::Stmt const&, std::size_t) {
    expression(n.subject);
    for (auto const& one : n.cases) {
      expression(one.value);
      statements(one.body, 1);
    }
  }
  void visit(ast::Try const& n, ast::Stmt const&, std::size_t level) {
    body(n.body, level);
    auto end = n.body.span.end;
    for (auto const& one : n.catches) {
      word(TokenKind::kw_catch, end, level);
      body(one.body, level);
      end = one.body.span.end;
    }
    if (!n.finally) return;
    word(TokenKind::kw_finally, end, level);
    body(*n.finally, level);
  }

  void expression(ast::ExprPtr const& expr) {
    if (expr) visit_child(*expr);
  }
  void visit_child(ast::Stmt const& one) { statement(one, 0); }
  void visit_child(ast::Expr const& expr) {
    if (auto const* closure = std::get_if<ast::Closure>(&expr.node)) {
      for (auto const& parameter : closure->parameters) expression(parameter.fallback);
      return statements(closure->body, 0);
    }
    ast::for_each_child(expr.node, child_);
  }

  [[nodiscard]] bool has_braces(ast::Block const& block) const { return source_.text(block.span).starts_with('{'); }
  void body(ast::Block const& block, std::size_t level) { statements(block, has_braces(block) ? 0 : level + 1); }

  /// Notes the keyword that follows `offset` closely; its index.
  std::size_t word(TokenKind kind, std::uint32_t offset, std::size_t level) {
    auto const begins_before = [](Token const& token, std::uint32_t at) { return token.span.begin < at; };
    auto const first = std::lower_bound(tokens_.begin(), tokens_.end(), offset, begins_before);
    auto const found = std::ranges::find(first, tokens_.end(), kind, &Token::kind);
    places_.emplace(found->span.begin, level);
    return static_cast<std::size_t>(found - tokens_.begin());
  }

  struct Child {
    Placing& self;
    void operator()(ast::Stmt const& one) const { self.visit_child(one); }
    void operator()(ast::Expr const& one) const { self.visit_child(one); }
  };

  std::span<Token const> tokens_;
  base::SourceFile const& source_;
  StatementPlaces places_;
  Child child_{*this};
};

}  // namespace

StatementPlaces statement_places(ast::Program const& program, std::span<Token const> tokens,
                                 base::SourceFile const& source) {
  Placing placing(tokens, source);
  placing.statements(program.body, 0);
  return placing.take();
}

}  // namespace lapwing::dolphin
