#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "dolphin/names/signatures.hpp"

namespace lapwing::dolphin {

/// The instructions that a script can give: the language's own, and those that the platform adds.
class InstructionTable {
 public:
  InstructionTable() = default;  ///< the language's own
  explicit InstructionTable(std::span<tasks::VehicleInstruction const> added);

  /// Null when there is none. What the language calls so is the language's.
  [[nodiscard]] InstructionSpec const* find(std::string_view name) const;
  [[nodiscard]] std::span<InstructionSpec const> added() const { return added_; }

 private:
  std::vector<InstructionSpec> added_;
};

/// Of the platform's instructions.
[[nodiscard]] std::vector<std::string_view> names_of(tasks::Vocabulary const& vocabulary);
/// The language's own instruction of that name, or null.
[[nodiscard]] InstructionSpec const* find_instruction(std::string_view name);

}  // namespace lapwing::dolphin
