#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/text/diagnostic.hpp"
#include "dolphin/check/inference.hpp"
#include "dolphin/names/resolver.hpp"
#include "dolphin/services/vocabulary.hpp"
#include "dolphin/syntax/ast.hpp"
#include "dolphin/syntax/lexer.hpp"

namespace lapwing::dolphin {

enum class WordKind : std::uint8_t {
  variable,
  function,     ///< declared with def
  instruction,  ///< of the language
  builder,      ///< a platform's block word: mission
  command,      ///< known only in its block: takeOff, count
  chain,        ///< waitFor, when, until, during, watch
  member,       ///< property or method
  unit,
  signal,
  plan,  ///< the name of a mission, in quotes
  constant,
  type,
};

/// One word of a script with what it means there. Pointers are null where they do not apply.
struct Occurrence {
  base::Span span;  ///< of a word in quotes: without them
  WordKind kind = WordKind::variable;
  bool is_definition = false;  ///< the first place that gives it a meaning
  bool is_call = false;
  Variable const* variable = nullptr;
  std::vector<ast::FunctionDecl const*> const* functions = nullptr;
  InstructionSpec const* instruction = nullptr;  ///< of instructions and commands
  BlockWords const* block = nullptr;             ///< of builders and commands
  ChainSpec const* chain = nullptr;
  MethodSpec const* method = nullptr;
  UnitSpec const* unit = nullptr;
  NameSpec const* name = nullptr;  ///< of constants and types
};

/// Where variables can be seen.
struct Scopes {
  std::unordered_map<Variable const*, base::Span> of_locals;
  std::vector<base::Span> functions;            ///< whose code sees no locals from outside
  std::vector<base::Span> implicit_parameters;  ///< closures that have `it`
};

/// One version of one script, read and understood as far as it goes: what all language services look at. Never changes.
/// The vocabulary outlives it.
class Document {
 public:
  Document(std::string name, std::string text, Vocabulary const& vocabulary);
  Document(Document const&) = delete;
  Document& operator=(Document const&) = delete;

  [[nodiscard]] base::SourceFile const& source() const { return source_; }
  [[nodiscard]] Vocabulary const& vocabulary() const { return vocabulary_; }
  [[nodiscard]] TokenStream const& stream() const { return stream_; }
  [[nodiscard]] ast::Program const& program() const { return program_; }
  [[nodiscard]] Resolution const& resolution() const { return resolution_; }
  [[nodiscard]] Scopes const& scopes() const { return scopes_; }
  /// In order of place.
  [[nodiscard]] std::vector<Occurrence> const& occurrences() const { return occurrences_; }
  /// The word that contains the offset or ends at it, or null.
  [[nodiscard]] Occurrence const* occurrence_at(std::uint32_t offset) const;
  [[nodiscard]] std::string_view text(base::Span span) const { return source_.text(span); }

  [[nodiscard]] Facts facts(ast::Expr const& expr) const { return inference_.facts(expr); }
  [[nodiscard]] Facts facts(Variable const& variable) const { return inference_.facts(variable); }

  /// The value, when it is the same in every run.
  [[nodiscard]] std::optional<tasks::Argument> constant(ast::Expr const& expr) const {
    return inference_.constant(expr);
  }

  /// What the reader and the checker say about it, in order of place.
  [[nodiscard]] std::vector<base::Diagnostic> diagnostics() const;

 private:
  base::SourceFile source_;
  Vocabulary const& vocabulary_;
  base::Diagnostics mistakes_;  ///< of the reader
  TokenStream stream_;
  ast::Program program_;
  Resolution resolution_;
  mutable Inference inference_;  // remembers what it worked out
  Scopes scopes_;
  std::vector<Occurrence> occurrences_;
};

}  // namespace lapwing::dolphin
