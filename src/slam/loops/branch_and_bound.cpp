#include "slam/loops/branch_and_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

namespace lapwing::slam {
namespace {

constexpr double step_rad = std::numbers::pi / 180.0;

/// Some poses at once: one turn, and shifts from x, y on up to 2^level cells.
struct Branch {
  double score = 0.0;  ///< none of them is better
  int level = 0;
  int x = 0;
  int y = 0;
  int turn = 0;
};

/// Equal scores come in one order on every machine.
bool operator<(Branch const& a, Branch const& b) {
  return std::tie(a.score, b.level, b.turn, b.x, b.y) < std::tie(b.score, a.level, a.turn, a.x, a.y);
}

class Search {
 public:
  Search(Pyramid const& pyramid, std::vector<Eigen::Vector2f> const& query, LoopWindow const& window)
      : pyramid_(pyramid),
        window_(window),
        count_(static_cast<double>(query.size())),
        shifts_(static_cast<int>(std::ceil(window.reach_m / Pyramid::cell_m))),
        turns_(static_cast<int>(std::ceil(window.reach_rad / step_rad))),
        turned_(static_cast<std::size_t>(2 * turns_ + 1)),
        coarse_sums_(2 * shifts_ / StridedLevel::stride + 1) {
    for (int a = 0; a <= 2 * turns_; ++a) {
      auto const cosine = static_cast<float>(std::cos(yaw(a)));
      auto const sine = static_cast<float>(std::sin(yaw(a)));
      Eigen::Vector2f const origin = place(window.guess).cast<float>();
      for (auto const& p : query) {
        Eigen::Vector2f const at =
            (origin + Eigen::Vector2f(cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y()) -
             pyramid.origin()) /
            Pyramid::cell_m;
        turned_[a].emplace_back(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
      }
    }
  }

  std::optional<LoopMatch> run(double least_score) {
    least_share_ = least_score;
    for (int a = 0; a <= 2 * turns_; ++a) push_coarsest(a);
    std::optional<Branch> best;
    for (int count = 0; !queue_.empty() && count < window_.most_branches; ++count) {
      auto const branch = queue_.top();
      queue_.pop();
      if (best && is_same_place(*best, branch)) continue;
      if (branch.level > 0) {
        split(branch);
      } else if (best) {
        return match(*best, branch.score);
      } else {
        best = branch;
        // From here on only rivals are looked for, and only near ones matter.
        floor_ = std::max(floor_, rival_share * branch.score);
      }
    }
    if (!best) return std::nullopt;
    return match(*best, queue_.empty() ? floor_ : queue_.top().score);
  }

 private:
  static constexpr double rival_share = 0.7;
  static constexpr double most_of_a_point = 255.0;

  [[nodiscard]] double yaw(int turn) const { return window_.guess.yaw + (turn - turns_) * step_rad; }

  /// Whether all of a branch's poses are those around the best one.
  [[nodiscard]] static bool is_same_place(Branch const& best, Branch const& other) {
    constexpr int cells = 7;
    constexpr int degrees = 8;
    constexpr int round = 360;
    auto const turned = std::abs(other.turn - best.turn);
    auto const width = (1 << other.level) - 1;
    return other.x >= best.x - cells && other.x + width <= best.x + cells && other.y >= best.y - cells &&
           other.y + width <= best.y + cells && std::min(turned, round - turned) <= degrees;
  }

  /// Of the branch's pose that is nearest to the guess.
  [[nodiscard]] double cost(Branch const& branch) const {
    constexpr double of_deviation = 0.015;  // of the score a squared standard deviation costs
    auto const width = (1 << branch.level) - 1;
    auto const off = [&](int low) { return Pyramid::cell_m * static_cast<double>(std::max({0, low, -(low + width)})); };
    auto const shift2 =
        (off(branch.x) * off(branch.x) + off(branch.y) * off(branch.y)) / (window_.sigma_m * window_.sigma_m);
    auto const turned = (branch.turn - turns_) * step_rad / window_.sigma_rad;
    return of_deviation * (shift2 + turned * turned);
  }

  /// All shifts of one turn, in steps of the coarsest level.
  void push_coarsest(int turn) {
    constexpr int level = Pyramid::levels - 1;
    coarse_sums_.clear();
    for (auto const& p : turned_[turn]) pyramid_.coarsest().add(p.x() - shifts_, p.y() - shifts_, coarse_sums_);
    for (int j = 0; j < coarse_sums_.side(); ++j)
      for (int i = 0; i < coarse_sums_.side(); ++i)
        push({.level = level, .x = (i << level) - shifts_, .y = (j << level) - shifts_, .turn = turn},
             coarse_sums_.at(i, j));
  }

  /// A branch over which the points have this sum.
  void push(Branch branch, int sum) {
    auto const share = sum / (most_of_a_point * count_);
    if (share <= least_share_) return;
    branch.score = share - cost(branch);
    if (branch.score > floor_) queue_.push(branch);
  }

  void split(Branch const& branch) {
    auto const level = branch.level - 1;
    std::array<int, 4> sums{};
    for (auto const& p : turned_[branch.turn]) {
      auto const quarters = pyramid_.quarters(level, p.x() + branch.x, p.y() + branch.y);
      for (std::size_t q = 0; q < sums.size(); ++q) sums[q] += quarters[q];
    }
    auto const half = 1 << level;
    for (auto const q : {0, 1, 2, 3}) {
      Branch const quarter{.level = level,
                           .x = branch.x + (q % 2 == 0 ? 0 : half),
                           .y = branch.y + (q / 2 == 0 ? 0 : half),
                           .turn = branch.turn};
      if (quarter.x <= shifts_ && quarter.y <= shifts_) push(quarter, sums[static_cast<std::size_t>(q)]);
    }
  }

  [[nodiscard]] LoopMatch match(Branch const& best, double rival) const {
    auto const& guess = window_.guess;
    return {.pose = {guess.x + best.x * double{Pyramid::cell_m}, guess.y + best.y * double{Pyramid::cell_m},
                     yaw(best.turn)},
            .score = best.score,
            .rival = std::max(0.0, rival),
            .is_at_edge = std::max(std::abs(best.x), std::abs(best.y)) >= shifts_ - 1};
  }

  Pyramid const& pyramid_;
  LoopWindow window_;
  double count_;
  int shifts_;
  int turns_;
  double least_share_ = 0.0;
  double floor_ = 0.0;
  std::vector<std::vector<Eigen::Vector2i>> turned_;  ///< the query's cells at each turn
  ShiftSums coarse_sums_;
  std::priority_queue<Branch> queue_;
};

}  // namespace

std::optional<LoopMatch> branch_and_bound(Pyramid const& pyramid, std::vector<Eigen::Vector2f> const& query,
                                          LoopWindow const& window, double least_score) {
  if (query.empty()) return std::nullopt;
  return Search(pyramid, query, window).run(least_score);
}

}  // namespace lapwing::slam
