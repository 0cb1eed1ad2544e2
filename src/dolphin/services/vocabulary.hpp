#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "dolphin/names/instruction_table.hpp"
#include "dolphin/syntax/ast.hpp"
#include "tasks/vocabulary.hpp"

namespace lapwing::dolphin {

/// The words that are known only inside the block of one word: `count` in pick { ... }.
struct BlockWords {
  std::string_view name;  ///< "pick", "mission", "onError"
  BlockKind kind = BlockKind::none;
  std::span<InstructionSpec const> words;
  tasks::BuilderSpec const* builder = nullptr;  ///< of a platform's block; its commands stand in the order of `words`
};

/// A word that makes a task of a closure and another task.
struct ChainSpec {
  ast::ChainKind kind;
  std::string_view name;
  std::string_view usage;
  std::string_view doc;
};
[[nodiscard]] std::span<ChainSpec const> chain_words();

/// Everything that a script can say by name on one platform: the language's own tables and what the platform adds.
/// `added` outlives it.
class Vocabulary {
 public:
  explicit Vocabulary(tasks::Vocabulary const& added);
  Vocabulary(Vocabulary const&) = delete;
  Vocabulary& operator=(Vocabulary const&) = delete;

  /// What the platform adds.
  [[nodiscard]] tasks::Vocabulary const& added() const { return added_; }
  /// The language's and the platform's.
  [[nodiscard]] InstructionTable const& instructions() const { return instructions_; }
  [[nodiscard]] std::span<BlockWords const> blocks() const { return blocks_; }
  /// The block that the closure behind this word is, or null.
  [[nodiscard]] BlockWords const* block(std::string_view name) const;
  [[nodiscard]] tasks::BuilderSpec const* builder(std::string_view name) const;
  /// Whether the language gives the word a meaning everywhere: instruction, block word, chain, constant, type,
  /// reserved.
  [[nodiscard]] bool is_taken(std::string_view name) const;

 private:
  tasks::Vocabulary const& added_;
  InstructionTable instructions_;
  std::vector<std::vector<InstructionSpec>> commands_;  ///< of each builder
  std::vector<BlockWords> blocks_;
};

}  // namespace lapwing::dolphin
