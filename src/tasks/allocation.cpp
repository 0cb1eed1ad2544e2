#include "tasks/allocation.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lapwing::tasks {
namespace {

using base::ErrorKind;
using base::fail;
using base::Result;

int constexpr nobody = -1;
/// For each vehicle, by its place in the list: the occurrence that took it, or nobody.
using Takers = std::vector<int>;

class Allocator {
 public:
  Allocator(std::vector<VehicleInfo> const& vehicles, Unsuited const& unsuited)
      : vehicles_(vehicles), unsuited_(unsuited), serve_already_(vehicles.size(), false) {}

  /// Serves all of `task`; its first platform task is occurrence `first`.
  Result<> serve(TaskTree const& task, int first, Takers& takers) {
    return std::visit([&](auto const& kind) { return serve_kind(kind, first, takers); }, task->kind);
  }
  Allocation take() { return std::move(allocation_); }

 private:
  Result<> serve_kind(Sequence const& kind, int first, Takers& takers);
  Result<> serve_kind(Concurrent const& kind, int first, Takers& takers);
  Result<> serve_kind(Choice const& kind, int first, Takers& takers) {
    return serve_branches(kind.branches, first, takers);
  }
  Result<> serve_kind(AllOf const& kind, int first, Takers& takers) {
    return serve_branches(kind.branches, first, takers);
  }
  Result<> serve_kind(Until const& kind, int first, Takers& takers) { return serve(kind.body, first, takers); }
  Result<> serve_kind(During const& kind, int first, Takers& takers) { return serve(kind.body, first, takers); }
  Result<> serve_kind(Watch const& kind, int first, Takers& takers) { return serve(kind.body, first, takers); }
  Result<> serve_kind(Restricted const& kind, int first, Takers& takers);
  Result<> serve_kind(Performed const& kind, int first, Takers& takers);
  Result<> serve_kind(Action const&, int, Takers&) { return {}; }
  Result<> serve_kind(Condition const&, int, Takers&) { return {}; }
  Result<> serve_kind(Idle const&, int, Takers&) { return {}; }

  Result<> serve_sharing(std::vector<TaskTree> const& parts, int first, Takers& takers, bool is_sequence);
  Result<> serve_branches(std::vector<Branch> const& branches, int first, Takers& takers);
  void keep_nearest(PlatformTask const& task, std::vector<std::size_t>& candidates) const;
  [[nodiscard]] std::optional<std::string> rejection(PlatformTask const& task, std::size_t vehicle,
                                                     Takers const& takers) const;
  [[nodiscard]] std::unexpected<base::Error> failure(PlatformTask const& task, Takers const& takers) const;

  std::vector<VehicleInfo> const& vehicles_;
  Unsuited const& unsuited_;
  std::vector<Restricted const*> restrictions_;  ///< round the task being served, outermost first
  std::vector<bool> serve_already_;              ///< the sequence round the task being served, by vehicle
  Allocation allocation_;
};

/// Every part chooses from the same vehicles; what any of them took is gone for others.
Result<> Allocator::serve_sharing(std::vector<TaskTree> const& parts, int first, Takers& takers, bool is_sequence) {
  auto const before = takers;
  for (auto const& part : parts) {
    auto own = before;
    if (auto served = serve(part, first, own); !served) return served;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (takers[i] == nobody) takers[i] = own[i];
      if (is_sequence && before[i] == nobody && own[i] != nobody) serve_already_[i] = true;
    }
    first += part->performed;
  }
  return {};
}

/// The vehicle that has flown the first half is where the second one begins.
Result<> Allocator::serve_kind(Sequence const& kind, int first, Takers& takers) {
  auto const round_it = serve_already_;
  auto served = serve_sharing(kind.parts, first, takers, true);
  serve_already_ = round_it;
  return served;
}

Result<> Allocator::serve_branches(std::vector<Branch> const& branches, int first, Takers& takers) {
  std::vector<TaskTree> parts;
  for (auto const& branch : branches) parts.push_back(branch.then);
  return serve_sharing(parts, first, takers, false);
}

Result<> Allocator::serve_kind(Concurrent const& kind, int first, Takers& takers) {
  std::vector<std::pair<TaskTree const*, int>> queue;
  for (auto const& part : kind.parts) {
    queue.emplace_back(&part, first);
    first += part->performed;
  }
  // A part that may use any vehicle must not take the only one of a part that may not (REC-2b).
  std::ranges::stable_partition(queue, [](auto const& entry) { return (*entry.first)->is_restricted; });
  for (auto const& [part, occurrence] : queue) {
    if (auto served = serve(*part, occurrence, takers); !served) return served;
  }
  return {};
}

Result<> Allocator::serve_kind(Restricted const& kind, int first, Takers& takers) {
  restrictions_.push_back(&kind);
  auto served = serve(kind.body, first, takers);
  restrictions_.pop_back();
  return served;
}

Result<> Allocator::serve_kind(Performed const& kind, int first, Takers& takers) {
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    // Taken ones first: looking up who took them is only worth it for the error.
    if (takers[i] == nobody && !rejection(*kind.task, i, takers)) candidates.push_back(i);
  }
  if (candidates.empty()) return failure(*kind.task, takers);
  keep_nearest(*kind.task, candidates);
  auto const best = candidates.front();
  takers[best] = first;
  allocation_.assignments.push_back({.occurrence = first, .task = kind.task, .vehicle = vehicles_[best].id});
  return {};
}

/// Leaves those that are about equally near. Nothing is measured for a task that begins anywhere.
void Allocator::keep_nearest(PlatformTask const& task, std::vector<std::size_t>& candidates) const {
  constexpr double about_as_near_m = 2.0;  // what GPS tells apart
  auto const reference = task.reference_position();
  if (!reference) return;
  auto const serves = [this](std::size_t i) { return serve_already_[i]; };
  if (std::ranges::any_of(candidates, serves)) std::erase_if(candidates, std::not_fn(serves));
  auto const distance_m = [&](std::size_t i) {
    auto const& position = vehicles_[i].position;
    return position ? geo::surface_distance_m(*reference, *position) : std::numeric_limits<double>::infinity();
  };
  double least_m = std::numeric_limits<double>::infinity();
  for (auto const i : candidates) least_m = std::min(least_m, distance_m(i));
  std::erase_if(candidates, [&](std::size_t i) { return distance_m(i) > least_m + about_as_near_m; });
}

std::optional<std::string> Allocator::rejection(PlatformTask const& task, std::size_t vehicle,
                                                Takers const& takers) const {
  auto const& info = vehicles_[vehicle];
  for (auto const* restriction : restrictions_) {
    if (std::ranges::find(restriction->vehicles, info.id) == restriction->vehicles.end()) {
      return "outside the task's vehicle set";
    }
  }
  if (!info.conflict.empty()) return info.conflict;
  if (!info.connected) return "lost";
  if (int const taker = takers[vehicle]; taker != nobody) {
    auto const taken = std::ranges::find(allocation_.assignments, taker, &Assignment::occurrence);
    return fmt::format("taken by {}", taken->task->name());
  }
  return unsuited_(task, info);
}

std::unexpected<base::Error> Allocator::failure(PlatformTask const& task, Takers const& takers) const {
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    reasons.push_back(fmt::format("{}: {}", vehicles_[i].id.text, rejection(task, i, takers).value_or("suitable")));
  }
  for (auto const* restriction : restrictions_) {
    for (auto const& id : restriction->vehicles) {
      if (std::ranges::find(vehicles_, id, &VehicleInfo::id) == vehicles_.end()) {
        reasons.push_back(fmt::format("{}: not picked, or released", id.text));
      }
    }
  }
  if (reasons.empty()) reasons.emplace_back("no vehicle is picked");
  return fail(ErrorKind::not_found,
              fmt::format("No vehicles to run task {}! ({})", task.name(), fmt::join(reasons, "; ")),
              "pick more vehicles, or run tasks that share one after the other with >>");
}

}  // namespace

Result<Allocation> allocate(TaskTree const& tree, std::vector<VehicleInfo> const& available, Unsuited const& unsuited) {
  if (tree->depth > max_task_depth) {
    return fail(ErrorKind::invalid_input, fmt::format("the task is nested deeper than {} levels", max_task_depth));
  }
  if (tree->size > max_task_size) {
    return fail(ErrorKind::invalid_input, fmt::format("the task has more than {} parts", max_task_size));
  }
  Allocator allocator(available, unsuited);
  Takers takers(available.size(), nobody);
  if (auto served = allocator.serve(tree, 0, takers); !served) return std::unexpected(served.error());
  return allocator.take();
}

}  // namespace lapwing::tasks
