#include "dolphin/services/view/folding.hpp"

#include <algorithm>
#include <string_view>

namespace lapwing::dolphin {

namespace {

using base::Span;

class Folder {
 public:
  explicit Folder(Document const& document) : document_(document) {}

  std::vector<Fold> run() {
    for (auto const& token : document_.stream().tokens) look_at(token);
    comments();
    std::ranges::stable_sort(out_, {}, &Fold::first);
    auto const same_line = std::ranges::unique(out_, {}, &Fold::first);
    out_.erase(same_line.begin(), same_line.end());
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::uint32_t line(std::uint32_t offset) const { return document_.source().line(offset) - 1; }

  void add(std::uint32_t first, std::uint32_t last, FoldKind kind) {
    if (last > first) out_.push_back({first, last, kind});
  }

  /// Outer brackets come first, so that of several on one line the outermost folds.
  void look_at(Token const& token) {
    bool const opens = token.kind == TokenKind::left_brace || token.kind == TokenKind::left_bracket ||
                       token.kind == TokenKind::left_paren;
    if (opens && token.partner != Token::unclosed) {
      auto const last = line(document_.stream().tokens[token.partner].span.begin);
      if (last > 0) add(line(token.span.begin), last - 1, FoldKind::code);
    }
    if (token.kind == TokenKind::string) add(line(token.span.begin), line(token.span.end), FoldKind::code);
  }

  /// What a line holds beside its comment: nothing, for comments that fold.
  [[nodiscard]] bool stands_alone(Span comment) const {
    auto const begin = document_.source().line_span(line(comment.begin) + 1).begin;
    return document_.text({begin, comment.begin}).find_first_not_of(" \t") == std::string_view::npos;
  }

  /// "region" of `// region Pads` and `// #region Pads`.
  [[nodiscard]] std::string_view marker(Span comment) const {
    auto text = document_.text(comment);
    if (!text.starts_with("//")) return {};
    text.remove_prefix(std::min(text.find_first_not_of("/ \t#"), text.size()));
    return text.substr(0, std::min(text.find_first_of(" \t"), text.size()));
  }

  void comments() {
    std::vector<std::uint32_t> regions;
    std::vector<Span> row;
    for (auto const comment : document_.stream().comments) {
      auto const word = marker(comment);
      bool const is_line = document_.text(comment).starts_with("//") && stands_alone(comment);
      bool const goes_on = is_line && !row.empty() && line(comment.begin) == line(row.back().begin) + 1;
      if (!goes_on) end_row(row);
      if (is_line && word == "region") {
        end_row(row);
        regions.push_back(line(comment.begin));
      } else if (is_line && word == "endregion") {
        end_row(row);
        if (regions.empty()) continue;
        add(regions.back(), line(comment.begin), FoldKind::region);
        regions.pop_back();
      } else if (is_line) {
        row.push_back(comment);
      } else {
        add(line(comment.begin), line(comment.end), FoldKind::comment);
      }
    }
    end_row(row);
  }
  void end_row(std::vector<Span>& row) {
    if (!row.empty()) add(line(row.front().begin), line(row.back().begin), FoldKind::comment);
    row.clear();
  }

  Document const& document_;
  std::vector<Fold> out_;
};

}  // namespace

std::vector<Fold> folds(Document const& document) {
  return Folder(document).run();
}

}  // namespace lapwing::dolphin
