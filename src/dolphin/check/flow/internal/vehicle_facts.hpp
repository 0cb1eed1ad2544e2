#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/text/source.hpp"
#include "dolphin/names/resolver.hpp"

/// What is known of vehicles at one place of a script, for `vehicle_flow`.
namespace lapwing::dolphin {

/// One evaluation of `pick`, or vehicles of which only the variable is known.
struct Pick {
  base::Span place;
  std::optional<std::size_t> count;
  std::string type;                  ///< empty: any
  std::vector<std::string> payload;  ///< what each vehicle carries at least
};
using PickIndex = std::uint32_t;

/// A set of vehicles: some or all of those of its picks.
struct VehicleSet {
  std::vector<PickIndex> picks;     ///< in ascending order
  std::optional<std::size_t> most;  ///< it has no more than that
  bool is_part = false;             ///< not certainly all vehicles of the picks
};

enum class Released { no, maybe, yes };
struct ReleaseFact {
  Released is = Released::no;
  base::Span place;
  std::uint32_t epoch = 0;
};

/// Facts about variables and picks. Changes can be undone, so that the branches of a script are followed one after the
/// other without copying what is known.
class VehicleState {
 public:
  [[nodiscard]] VehicleSet const* find(Variable const* variable) const;
  void assign(Variable const* variable, VehicleSet set);
  void forget(Variable const* variable);

  [[nodiscard]] PickIndex add(Pick pick);
  [[nodiscard]] Pick const& pick(PickIndex index) const { return picks_[index]; }
  /// Every one that was followed so far, of all branches.
  [[nodiscard]] std::span<Pick const> picks() const { return picks_; }
  /// `yes` only while nothing has been picked since: a later pick may have taken the same vehicles again.
  [[nodiscard]] ReleaseFact release_of(PickIndex index) const;
  void release(PickIndex index, Released is, base::Span place);

  /// Vehicles are picked, so many at most.
  void note_pick(std::optional<std::size_t> count);
  /// The script holds no more vehicles than that; nothing: unknown.
  [[nodiscard]] std::optional<std::size_t> most_picked() const { return most_picked_; }

  struct Mark {
    std::size_t variables;
    std::size_t releases;
    std::optional<std::size_t> most_picked;
    std::uint32_t epoch;
  };
  [[nodiscard]] Mark mark() const { return {old_sets_.size(), old_releases_.size(), most_picked_, epoch_}; }
  void undo(Mark const& mark);

 private:
  std::unordered_map<Variable const*, VehicleSet> sets_;
  std::vector<Pick> picks_;
  std::vector<ReleaseFact> releases_;
  std::optional<std::size_t> most_picked_ = 0;
  std::uint32_t epoch_ = 0;
  std::vector<std::pair<Variable const*, std::optional<VehicleSet>>> old_sets_;
  std::vector<std::pair<PickIndex, ReleaseFact>> old_releases_;
};

/// Unions of more picks than this are not followed.
inline constexpr std::size_t max_picks_of_a_set = 16;

[[nodiscard]] std::optional<VehicleSet> united(VehicleSet const& a, VehicleSet const& b);

}  // namespace lapwing::dolphin
