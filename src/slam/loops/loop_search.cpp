#include "slam/loops/loop_search.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::slam {
namespace {

/// Of what a claim may be off at most: beyond, it is hardly believed.
constexpr double expected_share = 0.7;

/// The earlier ends of loops that begin near the query.
std::vector<int> joined_with(Graph const& graph, int query, int frames) {
  std::vector<int> targets;
  for (auto const& constraint : graph.constraints)
    if (constraint.is_loop && std::abs(constraint.to - query) < frames) targets.push_back(constraint.from);
  return targets;
}

/// The score of the best match that puts the query elsewhere than this one, whichever place it was found at.
double rival_elsewhere(std::vector<std::optional<LoopMatch>> const& matches, std::vector<Pose2> const& claimed,
                       std::size_t own) {
  constexpr double same_m = 1.0;
  constexpr double same_rad = 0.15;
  auto rival = 0.0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (i == own || !matches[i]) continue;
    auto const is_same = distance_m(claimed[i], claimed[own]) < same_m && turn_rad(claimed[i], claimed[own]) < same_rad;
    if (!is_same) rival = std::max(rival, matches[i]->score);
  }
  return rival;
}

/// How far what a closure says is from where its target is now as seen from its query, in standard deviations of what
/// has drifted between them: of x, y and yaw together (Mahalanobis 1936).
double deviations_of(Graph const& graph, Closure const& closure, Eigen::Matrix3d const& drift,
                     LoopOptions const& options) {
  auto const& now = graph.poses[closure.target];
  auto const claimed = graph.poses[closure.query] * inverse(closure.target_to_query);
  Eigen::Vector3d const off(claimed.x - now.x, claimed.y - now.y, geo::wrap_pi(claimed.yaw - now.yaw));
  // What is not known even where nothing has drifted. What slips is off by more than it is turned.
  Eigen::Vector3d const least(options.window_m, options.window_m, 0.5 * options.window_rad);
  Eigen::Matrix3d covariance = drift;
  covariance.diagonal() += least.cwiseAbs2();
  return std::sqrt(off.dot(covariance.ldlt().solve(off)));
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

void LoopSearch::follow(Graph const& graph) {
  auto const last = graph.size() - 1;
  auto const size = options_.submap_frames;
  if (graph.frames[last].is_cut) end_drive(graph, last);
  if (last - next_first_ + 1 < size) return;
  if (auto submap = make_submap(graph, next_first_, last)) submaps_.push_back(*std::move(submap));
  next_first_ = last + 1;
}

void LoopSearch::end_drive(Graph const& graph, int next) {
  constexpr int few = 5;  // see too little to be looked for in
  if (next - next_first_ >= few)
    if (auto submap = make_submap(graph, next_first_, next - 1)) submaps_.push_back(*std::move(submap));
  next_first_ = next;
}

void LoopSearch::know(Graph const& graph) {
  auto const size = options_.submap_frames;
  for (next_first_ = 0; next_first_ + size <= graph.size(); next_first_ += size) {
    auto const last = next_first_ + size - 1;
    if (graph.frames[last].path_m - graph.frames[next_first_].path_m >= options_.least_gap_m) continue;
    if (auto submap = make_submap(graph, next_first_, last)) submaps_.push_back(*std::move(submap));
  }
}

std::optional<Submap> LoopSearch::left_of(Submap submap, Graph const& graph, Renumbering const& renumbering) const {
  std::vector<int> staying;
  for (int k = submap.first; k <= submap.last; ++k)
    if (renumbering.stays(k)) staying.push_back(renumbering.now[k]);
  if (static_cast<int>(staying.size()) <= submap.last - submap.first) {
    auto const is_enough = 2 * static_cast<int>(staying.size()) >= options_.submap_frames;
    return is_enough ? make_submap(graph, staying.front(), staying.back()) : std::nullopt;
  }
  submap.reference = renumbering.now[submap.reference];
  submap.first = staying.front();
  submap.last = staying.back();
  return submap;
}

std::vector<int> LoopSearch::renumber(Graph const& graph, Renumbering const& renumbering) {
  std::vector<Submap> submaps;
  for (auto& submap : submaps_)
    if (auto left = left_of(std::move(submap), graph, renumbering)) submaps.push_back(*std::move(left));
  submaps_ = std::move(submaps);
  auto const before = static_cast<std::ptrdiff_t>(next_first_);
  next_first_ = static_cast<int>(std::count_if(renumbering.now.begin(), renumbering.now.begin() + before,
                                               [](int now) { return now != Renumbering::gone; }));
  std::vector<int> now;
  std::vector<LoopRecord> records;
  for (auto& record : records_) {
    auto const stays = renumbering.stays(record.query) && renumbering.stays(record.target);
    now.push_back(stays ? static_cast<int>(records.size()) : Renumbering::gone);
    if (!stays) continue;
    record.query = renumbering.now[record.query];
    record.target = renumbering.now[record.target];
    records.push_back(record);
  }
  records_ = std::move(records);
  return now;
}

std::vector<LoopSearch::Candidate> LoopSearch::candidates(Graph const& graph, int query, Scope const& scope) const {
  auto rates = options_.rates;
  if (!scope.counts_unseen) rates.unseen_share = 0.0;
  auto const drifts = drift_from(query, graph.poses, graph.constraints, rates);
  auto const joined = scope.skips_joined ? joined_with(graph, query, options_.query_frames) : std::vector<int>();
  struct Near {
    double apart_m;
    int submap;
  };
  std::vector<Near> near;
  auto const window_of = [&](Drift const& drift) {
    return std::min(options_.most_window_m, options_.window_m + scope.window_sigmas * drift.shift_m);
  };
  constexpr double sight_m = 3.0;  // a query sees so far into its neighbours
  constexpr double narrow_m = 4.0;
  for (int s = 0; s < static_cast<int>(submaps_.size()); ++s) {
    auto const reference = submaps_[s].reference;
    if (graph.frames[query].path_m - graph.frames[reference].path_m < options_.least_gap_m) continue;
    auto const is_same = [&](int target) { return std::abs(target - reference) <= options_.submap_frames; };
    if (std::ranges::any_of(joined, is_same)) continue;
    auto const apart = distance_m(graph.poses[query], graph.poses[reference]);
    if (apart < window_of(drifts[reference]) + sight_m) near.push_back({apart, s});
  }
  std::ranges::sort(near, {}, [](Near const& n) { return std::pair(n.apart_m, n.submap); });
  std::vector<Candidate> chosen;
  for (auto const& n : near) {
    auto const reference = submaps_[n.submap].reference;
    auto const& pose = graph.poses[reference];
    auto const is_known = [&](Candidate const& c) {
      // Neighbours see the same, as long as it is known about which of them the query is at.
      auto const is_near = std::abs(c.submap - n.submap) < options_.near_submaps;
      return (is_near && window_of(drifts[reference]) < narrow_m) ||
             distance_m(graph.poses[submaps_[c.submap].reference], pose) < 1.0;
    };
    if (std::ranges::any_of(chosen, is_known)) continue;
    auto const& drift = drifts[reference];
    chosen.push_back(
        {n.submap,
         {.guess = between(pose, graph.poses[query]),
          .reach_m = window_of(drift),
          .reach_rad = std::min(options_.most_window_rad, options_.window_rad + scope.window_sigmas * drift.turn_rad),
          .sigma_m = options_.window_m + drift.shift_m,
          .sigma_rad = options_.window_rad + drift.turn_rad,
          .most_branches = options_.most_branches},
         drift.covariance});
    // The less is known of where the query is, the more places it may be at.
    auto const most = std::max(1.0, window_of(drift) / narrow_m) * scope.most_places;
    if (static_cast<double>(chosen.size()) >= most) break;
  }
  return chosen;
}

std::vector<Closure> LoopSearch::look(Graph const& graph, int query, Scope const& scope) {
  auto const cloud = query_cloud(graph, query, options_.query_frames);
  if (cloud.size() < static_cast<std::size_t>(options_.least_points)) return {};
  auto const places = candidates(graph, query, scope);
  std::vector<std::optional<LoopMatch>> matches(places.size());
  std::vector<std::optional<Closure>> found(places.size());
  for_each_(places.size(), [&](std::size_t i) {
    auto const& [submap, window, covariance] = places[i];
    matches[i] = branch_and_bound(submaps_[submap].pyramid, cloud, window, options_.least_score);
    if (matches[i] && !matches[i]->is_at_edge)
      found[i] = make_closure(graph, submaps_[submap], query, *matches[i], options_);
    if (found[i]) {
      found[i]->window_m = window.reach_m;
      found[i]->deviations = deviations_of(graph, *found[i], covariance, options_);
      found[i]->is_expected = found[i]->deviations <= expected_share * scope.most_deviations;
    }
  });
  std::vector<Pose2> claimed(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    if (matches[i]) claimed[i] = graph.poses[submaps_[places[i].submap].reference] * matches[i]->pose;
  std::vector<Closure> closures;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (found[i]) found[i]->rival = std::max(found[i]->rival, rival_elsewhere(matches, claimed, i));
    records_.push_back({.query = query,
                        .target = submaps_[places[i].submap].reference,
                        .window = places[i].window,
                        .score = matches[i] ? matches[i]->score : 0.0,
                        .rival = found[i] ? found[i]->rival : 0.0,
                        .is_late = scope.skips_joined});
    if (matches[i]) records_.back().verdict = LoopRecord::Verdict::mismatched;
    if (!found[i]) continue;
    found[i]->record = static_cast<int>(records_.size()) - 1;
    records_.back().conflict = found[i]->agreement.conflict();
    records_.back().matches = found[i]->matches;
    records_.back().deviations = found[i]->deviations;
    if (found[i]->fits(options_) && found[i]->deviations <= scope.most_deviations) closures.push_back(*found[i]);
  }
  return closures;
}

}  // namespace lapwing::slam
