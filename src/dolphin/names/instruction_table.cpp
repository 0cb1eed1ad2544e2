#include "dolphin/names/instruction_table.hpp"

#include <algorithm>
#include <unordered_map>

namespace lapwing::dolphin {

InstructionTable::InstructionTable(std::span<tasks::VehicleInstruction const> added) {
  for (auto const& instruction : added) added_.push_back(instruction_of(instruction));
}

InstructionSpec const* InstructionTable::find(std::string_view name) const {
  if (auto const* own = find_instruction(name)) return own;
  auto const found = std::ranges::find(added_, name, &InstructionSpec::name);
  return found == added_.end() ? nullptr : &*found;
}

std::vector<std::string_view> names_of(tasks::Vocabulary const& vocabulary) {
  std::vector<std::string_view> names;
  for (auto const& one : vocabulary.instructions) names.push_back(one.name);
  return names;
}

InstructionSpec const* find_instruction(std::string_view name) {
  static auto const table = [] {
    std::unordered_map<std::string_view, InstructionSpec const*> out;
    for (auto const& one : instructions()) out.emplace(one.name, &one);
    return out;
  }();
  auto const found = table.find(name);
  return found == table.end() ? nullptr : found->second;
}

}  // namespace lapwing::dolphin
