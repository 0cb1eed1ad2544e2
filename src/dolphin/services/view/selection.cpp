#include "dolphin/services/view/selection.hpp"

#include <algorithm>

#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

using base::Span;

class Selector {
 public:
  Selector(Document const& document, std::uint32_t offset) : document_(document), offset_(offset) {}

  std::vector<Span> run() {
    if (auto const* word = document_.occurrence_at(offset_)) add(word->span);
    brackets();
    for (auto const& one : document_.program().body.statements) child_(*one);
    add({0, static_cast<std::uint32_t>(document_.source().text().size())});
    std::ranges::sort(all_, {}, &Span::size);
    std::vector<Span> out;
    for (auto const one : all_) {
      bool const is_round = out.empty() || (one.begin <= out.back().begin && out.back().end <= one.end);
      if (is_round && (out.empty() || out.back() != one)) out.push_back(one);
    }
    return out;
  }

 private:
  [[nodiscard]] bool holds(Span span) const { return span.begin <= offset_ && offset_ <= span.end; }
  void add(Span span) {
    if (holds(span)) all_.push_back(span);
  }

  void brackets() {
    auto const& tokens = document_.stream().tokens;
    for (auto const& token : tokens) {
      if (token.span.begin > offset_) break;
      if (token.partner == Token::unclosed || tokens[token.partner].span.begin < token.span.begin) {
        add(token.span);
        continue;
      }
      add({token.span.end, tokens[token.partner].span.begin});
      add({token.span.begin, tokens[token.partner].span.end});
    }
  }

  struct Child {
    Selector& self;
    template <class Node>
    void operator()(Node const& one) const {
      self.add(one.span);
      ast::for_each_child(one.node, *this);
    }
  };

  Document const& document_;
  std::uint32_t offset_;
  std::vector<Span> all_;
  Child child_{*this};
};

}  // namespace

std::vector<Span> selections(Document const& document, std::uint32_t offset) {
  return Selector(document, offset).run();
}

}  // namespace lapwing::dolphin
