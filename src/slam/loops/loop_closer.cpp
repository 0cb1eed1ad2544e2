#include "slam/loops/loop_closer.hpp"

#include <algorithm>
#include <cmath>

#include "slam/graph/pose_graph.hpp"

namespace lapwing::slam {
namespace {

Pose2 claimed_pose(Graph const& graph, Closure const& closure) {
  return graph.poses[closure.target] * closure.target_to_query;
}

/// How far the closure would move its query.
struct Correction {
  double shift_m;
  double turn_rad;
};
Correction correction(Graph const& graph, Closure const& closure) {
  auto const claimed = claimed_pose(graph, closure);
  return {distance_m(claimed, graph.poses[closure.query]), turn_rad(claimed, graph.poses[closure.query])};
}

}  // namespace

std::string_view to_string(LoopRecord::Verdict verdict) {
  using enum LoopRecord::Verdict;
  switch (verdict) {
    case not_found: return "not found";
    case mismatched: return "mismatched";
    case doubted: return "doubted";
    case revoked: return "revoked";
    case closed: return "closed";
  }
  return "";
}

std::vector<LoopCloser::Candidate> LoopCloser::candidates(Graph const& graph, int query) const {
  auto const drifts = drift_from(query, graph.poses, graph.constraints, options_.rates);
  struct Near {
    double apart_m;
    int submap;
  };
  std::vector<Near> near;
  auto const window_of = [&](Drift const& drift) {
    return std::min(options_.most_window_m, options_.window_m + options_.window_sigmas * drift.shift_m);
  };
  constexpr double sight_m = 3.0;  // a query sees so far into its neighbours
  for (int s = 0; s < static_cast<int>(submaps_.size()); ++s) {
    auto const reference = submaps_[s].reference;
    if (std::abs(graph.frames[query].path_m - graph.frames[reference].path_m) < options_.least_gap_m) continue;
    auto const apart = distance_m(graph.poses[query], graph.poses[reference]);
    if (apart < window_of(drifts[reference]) + sight_m) near.push_back({apart, s});
  }
  std::ranges::sort(near, {}, [](Near const& n) { return std::pair(n.apart_m, n.submap); });
  std::vector<Candidate> chosen;
  for (auto const& n : near) {
    auto const reference = submaps_[n.submap].reference;
    auto const& pose = graph.poses[reference];
    auto const is_known = [&](Candidate const& c) {
      return std::abs(c.submap - n.submap) < 3 || distance_m(graph.poses[submaps_[c.submap].reference], pose) < 1.0;
    };
    if (std::ranges::any_of(chosen, is_known)) continue;
    auto const& drift = drifts[reference];
    chosen.push_back({n.submap,
                      {.guess = between(pose, graph.poses[query]),
                       .reach_m = window_of(drift),
                       .reach_rad = std::min(options_.most_window_rad,
                                             options_.window_rad + options_.window_sigmas * drift.turn_rad)}});
    if (static_cast<int>(chosen.size()) >= options_.most_candidates) break;
  }
  return chosen;
}

std::vector<Closure> LoopCloser::search(Graph const& graph, int query) {
  constexpr std::size_t least_points = 60;
  auto const cloud = query_cloud(graph, query, options_.query_frames);
  if (cloud.size() < least_points) return {};
  auto const places = candidates(graph, query);
  std::vector<std::optional<LoopMatch>> matches(places.size());
  std::vector<std::optional<Closure>> found(places.size());
  for_each_(places.size(), [&](std::size_t i) {
    auto const& [submap, window] = places[i];
    matches[i] = branch_and_bound(submaps_[submap].pyramid, cloud, window, options_.least_score);
    if (matches[i]) found[i] = make_closure(graph, submaps_[submap], query, *matches[i], options_);
    if (found[i]) found[i]->window_m = window.reach_m;
  });
  counts_.searches += static_cast<int>(places.size());
  std::vector<Closure> closures;
  for (std::size_t i = 0; i < places.size(); ++i) {
    records_.push_back({.query = query,
                        .target = submaps_[places[i].submap].reference,
                        .window = places[i].window,
                        .score = matches[i] ? matches[i]->score : 0.0,
                        .rival = matches[i] ? matches[i]->rival : 0.0});
    if (matches[i]) records_.back().verdict = LoopRecord::Verdict::mismatched;
    if (!found[i]) continue;
    found[i]->record = static_cast<int>(records_.size()) - 1;
    records_.back().conflict = found[i]->agreement.conflict();
    records_.back().matches = found[i]->matches;
    if (found[i]->fits(options_)) closures.push_back(*found[i]);
  }
  return closures;
}

std::vector<Closure> LoopCloser::witnesses_of(Graph const& graph, Closure const& closure) const {
  constexpr double together_m = 10.0;  // over which the front end does not drift by more than is allowed here
  constexpr double shift_m = 0.35;
  constexpr double turn = 0.05;
  auto const claimed = claimed_pose(graph, closure);
  std::vector<Closure> witnesses;
  for (auto const& other : pending_) {
    if (other.query == closure.query) continue;
    if (std::abs(graph.frames[closure.query].path_m - graph.frames[other.query].path_m) > together_m) continue;
    auto const by_other = claimed_pose(graph, other) * between(graph.poses[other.query], graph.poses[closure.query]);
    if (distance_m(by_other, claimed) < shift_m && turn_rad(by_other, claimed) < turn) witnesses.push_back(other);
  }
  return witnesses;
}

bool LoopCloser::is_believed(Graph const& graph, Closure const& closure, std::size_t witnesses) const {
  auto const [shift, turn] = correction(graph, closure);
  auto const is_ambiguous = closure.rival > options_.ambiguous_rival * closure.score;
  if (shift < options_.small_shift_m && turn < options_.small_turn_rad) return true;
  auto needed = static_cast<std::size_t>(options_.witnesses);
  if (closure.window_m > 4.0) ++needed;
  if (is_ambiguous) needed += 2;
  return witnesses >= needed;
}

bool LoopCloser::close(Graph& graph, std::vector<Closure> const& closures) {
  auto const before = graph.constraints.size();
  auto const poses = graph.poses;
  for (auto const& closure : closures) graph.constraints.push_back(closure.constraint());
  // First as if all were true, for a robust kernel would not feel a loop that is metres open; then robustly.
  graph.poses =
      optimize(graph.poses, graph.constraints, {.most_rounds = 10, .small_step = 1e-3, .small_gain = 1e-3}).poses;
  graph.poses =
      optimize(graph.poses, graph.constraints,
               {.most_rounds = 10, .loop_tolerance = options_.tolerance, .small_step = 1e-3, .small_gain = 1e-4})
          .poses;
  constexpr double most_shift_m = 0.3;
  constexpr double most_turn = 0.05;
  auto const holds = [&](Closure const& closure) {
    auto const [shift, turn] = correction(graph, closure);
    return shift < most_shift_m && turn < most_turn;
  };
  if (std::ranges::all_of(closures, holds)) {
    counts_.closures += static_cast<int>(closures.size());
    return true;
  }
  graph.constraints.resize(before);
  graph.poses = poses;
  counts_.revoked += static_cast<int>(closures.size());
  return false;
}

bool LoopCloser::look(Graph& graph, int query) {
  bool has_closed = false;
  for (auto& closure : search(graph, query)) {
    auto witnesses = witnesses_of(graph, closure);
    auto const [shift, turn] = correction(graph, closure);
    auto& record = records_[closure.record];
    record.shift_m = shift;
    record.turn_rad = turn;
    record.witnesses = static_cast<int>(witnesses.size());
    pending_.push_back(closure);
    if (pending_.size() > 100) pending_.erase(pending_.begin());
    if (!is_believed(graph, closure, witnesses.size())) {
      ++counts_.doubted;
      record.verdict = LoopRecord::Verdict::doubted;
      continue;
    }
    if (shift < options_.small_shift_m && turn < options_.small_turn_rad) witnesses.clear();
    witnesses.push_back(closure);
    auto const holds = close(graph, witnesses);
    record.verdict = holds ? LoopRecord::Verdict::closed : LoopRecord::Verdict::revoked;
    has_closed = has_closed || holds;
  }
  return has_closed;
}

bool LoopCloser::follow(Graph& graph) {
  auto const last = graph.size() - 1;
  auto const size = options_.submap_frames;
  if ((last + 1) % size == 0)
    if (auto submap = make_submap(graph, last - size + 1, last)) submaps_.push_back(*std::move(submap));
  auto const path_m = graph.frames[last].path_m;
  if (path_m < options_.least_gap_m || path_m - last_search_m_ < options_.every_m) return false;
  last_search_m_ = path_m;
  return look(graph, last);
}

void LoopCloser::finish(Graph& graph) {
  auto result = optimize(graph.poses, graph.constraints, {.most_rounds = 30, .loop_tolerance = options_.tolerance});
  graph.poses = std::move(result.poses);
}

}  // namespace lapwing::slam
