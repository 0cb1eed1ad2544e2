#include "slam/loops/loop_closer.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "slam/graph/pose_graph.hpp"
#include "slam/loops/consistency.hpp"
#include "slam/loops/contradiction.hpp"

namespace lapwing::slam {
namespace {

using Verdict = LoopRecord::Verdict;

/// How far the closure would move its query.
struct Correction {
  double shift_m;
  double turn_rad;
};
Correction correction(Graph const& graph, Closure const& closure) {
  auto const claimed = claimed_pose(graph, closure);
  return {distance_m(claimed, graph.poses[closure.query]), turn_rad(claimed, graph.poses[closure.query])};
}

/// Whether the poses are as the loop says.
bool holds(std::vector<Pose2> const& poses, int from, int to, Pose2 const& from_to) {
  constexpr double most_shift_m = 0.3;
  constexpr double most_turn = 0.05;
  auto const claimed = poses[from] * from_to;
  return distance_m(claimed, poses[to]) < most_shift_m && turn_rad(claimed, poses[to]) < most_turn;
}

}  // namespace

LoopCounts counts_of(std::vector<LoopRecord> const& records) {
  LoopCounts counts{.searches = static_cast<int>(records.size())};
  for (auto const& record : records) {
    counts.closures += record.verdict == Verdict::closed ? 1 : 0;
    counts.doubted += record.verdict == Verdict::doubted ? 1 : 0;
    counts.revoked += record.verdict == Verdict::revoked ? 1 : 0;
  }
  return counts;
}

bool LoopCloser::is_small(Graph const& graph, Closure const& closure) const {
  auto const [shift, turn] = correction(graph, closure);
  return shift < options_.small_shift_m && turn < options_.small_turn_rad;
}

LoopCloser::Group LoopCloser::witnesses_of(Graph const& graph, Closure const& closure) const {
  constexpr double together_m = 10.0;  // over which the front end does not drift by more than is allowed here
  constexpr double shift_m = 0.35;
  constexpr double turn = 0.05;
  auto const claimed = claimed_pose(graph, closure);
  Group witnesses;
  for (auto const& other : pending_) {
    if (other.query == closure.query) continue;
    if (std::abs(graph.frames[closure.query].path_m - graph.frames[other.query].path_m) > together_m) continue;
    auto const by_other = claimed_pose(graph, other) * between(graph.poses[other.query], graph.poses[closure.query]);
    if (distance_m(by_other, claimed) < shift_m && turn_rad(by_other, claimed) < turn) witnesses.push_back(other);
  }
  return witnesses;
}

LoopCloser::Evidence LoopCloser::evidence_of(Group const& group) const {
  std::set<int> queries;
  std::set<int> unmistakable;
  double window_m = 0.0;
  bool is_expected = false;
  for (auto const& closure : group) {
    is_expected = is_expected || closure.is_expected;
    queries.insert(closure.query);
    if (closure.rival <= options_.ambiguous_rival * closure.score) unmistakable.insert(closure.query);
    window_m = std::max(window_m, closure.window_m);
  }
  constexpr double wide_m = 4.0;
  auto const is_wide = window_m > wide_m;
  auto const needed = 1 + options_.witnesses + (is_wide ? 1 : 0);
  auto const is_clear = static_cast<int>(unmistakable.size()) >= needed && (is_expected || !is_wide);
  // Along a corridor any number of claims agree on a wrong place, for each sees what the last one saw.
  if (is_wide && unmistakable.empty()) return {};
  auto const doubt = unmistakable.empty() ? 2 : 0;
  return {.is_enough = static_cast<int>(queries.size()) >= needed + doubt, .is_clear = is_clear};
}

void LoopCloser::settle_with(Graph& graph, Group const& group) const {
  for (auto const& closure : group) graph.constraints.push_back(closure.constraint());
  // First as if all were true, for a robust kernel would not feel a loop that is metres open; then robustly.
  graph.poses =
      optimize(graph.poses, graph.constraints, {.most_rounds = 10, .small_step = 1e-3, .small_gain = 1e-3}).poses;
  graph.poses =
      optimize(graph.poses, graph.constraints,
               {.most_rounds = 10, .loop_tolerance = options_.tolerance, .small_step = 1e-3, .small_gain = 1e-4})
          .poses;
}

LoopCloser::Group LoopCloser::held_of(Graph const& graph, Group const& group) const {
  Group held;
  for (auto const& closure : group)
    if (holds(graph.poses, closure.target, closure.query, closure.target_to_query)) held.push_back(closure);
  return held;
}

void LoopCloser::mark(Group const& group, Verdict verdict) {
  for (auto const& closure : group) search_.record_of(closure).verdict = verdict;
}

bool LoopCloser::close(Graph& graph, Group const& group) {
  auto const constraints = graph.constraints;
  auto const poses = graph.poses;
  auto const undo = [&] {
    graph.constraints = constraints;
    graph.poses = poses;
  };
  settle_with(graph, group);
  auto held = held_of(graph, group);
  if (held.size() < group.size() && evidence_of(held).is_enough) {
    undo();
    settle_with(graph, held);
    held = held_of(graph, held);
  }
  auto const passes = agreement_of_passes(graph, graph.poses, poses, options_.least_gap_m, for_each_);
  auto const were = agreement_of_passes(graph, poses, graph.poses, options_.least_gap_m, for_each_);
  for (auto const& closure : group) {
    search_.record_of(closure).contradiction = passes.conflict();
    search_.record_of(closure).was_contradiction = were.conflict();
  }
  mark(group, Verdict::revoked);
  // What lay together before in good agreement was not in need of a correction.
  constexpr double worse = 0.03;
  auto const is_better = were.seen() < options_.least_matches || passes.conflict() <= were.conflict() + worse;
  auto const evidence = evidence_of(held);
  auto const most = evidence.is_clear ? options_.most_contradiction : options_.most_contradiction_in_doubt;
  if (evidence.is_enough && is_better && passes.conflict() <= most) {
    mark(held, Verdict::closed);
    return true;
  }
  undo();
  return false;
}

bool LoopCloser::close_small(Graph& graph) {
  if (small_.empty()) return false;
  auto const constraints = graph.constraints;
  settle_with(graph, small_);
  auto const held = held_of(graph, small_);
  mark(small_, Verdict::revoked);
  mark(held, Verdict::closed);
  if (held.size() < small_.size()) {
    graph.constraints = constraints;
    settle_with(graph, held);
  }
  small_.clear();
  return !held.empty();
}

void LoopCloser::note(Graph const& graph, Closure const& closure, int witnesses, Verdict verdict) {
  auto const [shift, turn] = correction(graph, closure);
  auto& record = search_.record_of(closure);
  record.shift_m = shift;
  record.turn_rad = turn;
  record.witnesses = witnesses;
  record.verdict = verdict;
}

bool LoopCloser::look(Graph& graph, int query) {
  bool has_closed = false;
  // Not as far as what no scan saw may be off: that window holds many places, and on the way little speaks against a
  // wrong one yet.
  LoopSearch::Scope const scope{.window_sigmas = options_.window_sigmas,
                                .most_deviations = options_.most_deviations,
                                .most_places = options_.most_candidates};
  for (auto& closure : search_.look(graph, query, scope)) {
    if (is_small(graph, closure)) {
      note(graph, closure, 0, Verdict::doubted);
      small_.push_back(closure);
      continue;
    }
    auto group = witnesses_of(graph, closure);
    note(graph, closure, static_cast<int>(group.size()), Verdict::doubted);
    group.push_back(closure);
    if (evidence_of(group).is_enough) {
      close_small(graph);
      if (close(graph, group)) {
        has_closed = true;
        std::erase_if(pending_, [&](Closure const& p) { return search_.record_of(p).verdict == Verdict::closed; });
        continue;
      }
    }
    constexpr std::size_t most_pending = 100;
    pending_.push_back(closure);
    if (pending_.size() > most_pending) pending_.erase(pending_.begin());
  }
  if (static_cast<int>(small_.size()) >= options_.small_batch) has_closed = close_small(graph) || has_closed;
  return has_closed;
}

LoopCounts LoopCloser::counts() const {
  auto counts = forgotten_;
  return counts += counts_of(records());
}

void LoopCloser::renumber(Graph const& graph, Renumbering const& renumbering) {
  forgotten_ = counts();
  auto const record_now = search_.renumber(graph, renumbering);
  for (auto* group : {&pending_, &small_}) {
    std::erase_if(*group,
                  [&](Closure const& c) { return !renumbering.stays(c.query) || !renumbering.stays(c.target); });
    for (auto& closure : *group) {
      closure.query = renumbering.now[closure.query];
      closure.target = renumbering.now[closure.target];
      closure.record = record_now[static_cast<std::size_t>(closure.record)];
    }
  }
  forgotten_ -= counts_of(records());
}

void LoopCloser::know(Graph const& graph) {
  search_.know(graph);
  last_search_m_ = graph.frames.empty() ? 0.0 : graph.frames.back().path_m;
}

bool LoopCloser::follow(Graph& graph) {
  search_.follow(graph);
  auto const last = graph.size() - 1;
  auto const path_m = graph.frames[last].path_m;
  if (path_m < options_.least_gap_m || path_m - last_search_m_ < options_.every_m) return false;
  last_search_m_ = path_m;
  return look(graph, last);
}

bool LoopCloser::look_everywhere(Graph& graph, int first) {
  LoopSearch::Scope const scope{.window_sigmas = options_.late_sigmas,
                                .most_deviations = options_.late_deviations,
                                .most_places = 2 * options_.most_candidates,
                                .counts_unseen = true,
                                .skips_joined = true};
  Group claims;
  auto next_m = options_.least_gap_m;
  for (int query = first; query < graph.size(); ++query) {
    if (graph.frames[query].path_m < next_m) continue;
    next_m = graph.frames[query].path_m + options_.every_m;
    for (auto const& closure : search_.look(graph, query, scope)) claims.push_back(closure);
  }
  bool has_closed = false;
  Group refuted;
  int refuted_groups = 0;
  for (auto const& numbers : consistent_groups(graph, claims, options_.rates)) {
    Group group;
    for (auto const i : numbers) group.push_back(claims[static_cast<std::size_t>(i)]);
    for (auto const& closure : group) note(graph, closure, static_cast<int>(group.size()) - 1, Verdict::doubted);
    if (std::ranges::all_of(group, [&](Closure const& c) { return is_small(graph, c); })) {
      small_.insert(small_.end(), group.begin(), group.end());
    } else if (evidence_of(group).is_enough) {
      if (close(graph, group)) {
        has_closed = true;
      } else {
        ++refuted_groups;
        refuted.insert(refuted.end(), group.begin(), group.end());
      }
    }
  }
  // Of two loops that are open each may contradict the map as long as the other one is.
  if (refuted_groups > 1) has_closed = close(graph, refuted) || has_closed;
  return close_small(graph) || has_closed;
}

void LoopCloser::drop_open_loops(Graph& graph) {
  std::erase_if(graph.constraints,
                [&](Constraint const& c) { return c.is_loop && !holds(graph.poses, c.from, c.to, c.from_to); });
}

void LoopCloser::finish(Graph& graph, int first) {
  auto const settle = [&] {
    graph.poses =
        optimize(graph.poses, graph.constraints, {.most_rounds = 30, .loop_tolerance = options_.tolerance}).poses;
  };
  close_small(graph);
  settle();
  for (int round = 0; round < options_.late_rounds && look_everywhere(graph, first); ++round) settle();
  drop_open_loops(graph);
  settle();
}

}  // namespace lapwing::slam
