#include "dolphin/services/vocabulary.hpp"

#include <algorithm>
#include <array>

namespace lapwing::dolphin {

namespace {

constexpr auto all_chains = std::to_array<ChainSpec>({
    {ast::ChainKind::wait_for, "waitFor", "waitFor { condition } then task",
     "Waits until the closure is true, then runs the task."},
    {ast::ChainKind::when, "when", "when { condition } then task",
     "A branch of `oneOf`, `choose` or `allOf`: the task runs when the closure is true."},
    {ast::ChainKind::when, "otherwise", "otherwise task",
     "The last branch of `oneOf` or `choose`: the task runs when no guard before it is true."},
    {ast::ChainKind::until, "until", "until { condition } run task",
     "Runs the task, and stops it when the closure becomes true."},
    {ast::ChainKind::during, "during", "during 30.seconds run task", "Runs the task for that long at most."},
    {ast::ChainKind::watch, "watch", "watch task onError { message it }",
     "Runs the task; when it fails the closure is called with the reason, and says `ignore()` or `propagate()`."},
});

bool has(auto const& table, std::string_view name) {
  return std::ranges::any_of(table, [&](auto const& one) { return one.name == name; });
}

}  // namespace

std::span<ChainSpec const> chain_words() {
  return all_chains;
}

Vocabulary::Vocabulary(tasks::Vocabulary const& added) : added_(added), instructions_(added.instructions) {
  commands_.reserve(added.builders.size());
  for (auto const& builder : added.builders) {
    auto& words = commands_.emplace_back();
    for (auto const& command : builder.commands) words.push_back(instruction_of(command));
    blocks_.push_back({builder.name, BlockKind::platform, words, &builder});
  }
  for (auto const& instruction : dolphin::instructions()) {
    if (instruction.block == BlockKind::none) continue;
    blocks_.push_back({instruction.name, instruction.block, block_words(instruction.block)});
  }
  blocks_.push_back({"onError", BlockKind::handler, block_words(BlockKind::handler)});
}

BlockWords const* Vocabulary::block(std::string_view name) const {
  auto const found = std::ranges::find(blocks_, name, &BlockWords::name);
  return found == blocks_.end() ? nullptr : &*found;
}

tasks::BuilderSpec const* Vocabulary::builder(std::string_view name) const {
  auto const found = std::ranges::find(added_.builders, name, &tasks::BuilderSpec::name);
  return found == added_.builders.end() ? nullptr : &*found;
}

bool Vocabulary::is_taken(std::string_view name) const {
  constexpr auto others = std::to_array<std::string_view>({"it", "_", "then", "run", "onError", "this"});
  return instructions_.find(name) || builder(name) || has(constants(), name) || has(types(), name) ||
         has(all_chains, name) || std::ranges::find(others, name) != others.end();
}

}  // namespace lapwing::dolphin
