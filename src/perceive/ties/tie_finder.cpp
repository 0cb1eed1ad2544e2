#include "perceive/ties/tie_finder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "base/median.hpp"

namespace lapwing::perceive {

namespace {

using explore::TiePoint;

constexpr int piece_px = 42;
/// Beside where a piece is looked for: less than half of a slot's width, as slots look alike.
constexpr double search_m = 0.6;
/// From a peak of the score to where it is to have fallen.
constexpr int around_px = 4;
constexpr double sigma_m = 0.08;
/// Plans that are kept: of at most half a megabyte each.
constexpr std::size_t most_plans = 100;
/// Two pictures so near in time have poses that err about alike.
constexpr base::Duration shortly = std::chrono::seconds(2);
constexpr base::Duration long_before = std::chrono::seconds(4);

/// A piece of a plan, and how much there is to see on it that runs both ways.
struct Piece {
  cv::Rect at;
  double texture = 0.0;
};

double share_of(cv::Mat const& mask, cv::Rect const& at) {
  return cv::countNonZero(mask(at)) / static_cast<double>(at.area());
}

/// Where pieces of a plan are looked for in an earlier one.
class Overlay {
 public:
  Overlay(GroundPlan const& plan, GroundPlan const& earlier)
      : plan_(plan), earlier_(earlier), search_px_(plan.in_pixels(search_m) + around_px) {
    Eigen::Vector2d const expected = plan.shift - earlier.shift;
    corner_ = {plan.in_pixels(earlier.north_west.x() - expected.x() - plan.north_west.x()),
               plan.in_pixels(plan.north_west.y() + expected.y() - earlier.north_west.y())};
  }

  /// Of the plan: where a piece may lie so that all of what is searched through lies in the earlier one.
  [[nodiscard]] cv::Rect common() const {
    cv::Rect const room(corner_.x + search_px_, corner_.y + search_px_, earlier_.shades.cols - 2 * search_px_,
                        earlier_.shades.rows - 2 * search_px_);
    return cv::Rect({0, 0}, plan_.shades.size()) & room;
  }
  /// In the earlier one.
  [[nodiscard]] cv::Rect searched(cv::Rect const& piece) const {
    return {piece.x - corner_.x - search_px_, piece.y - corner_.y - search_px_, piece.width + 2 * search_px_,
            piece.height + 2 * search_px_};
  }

 private:
  GroundPlan const& plan_;
  GroundPlan const& earlier_;
  int search_px_;
  cv::Point corner_;  ///< of the earlier one in the plan, if it lies as expected
};

/// Those with most to see first.
std::vector<Piece> pieces_of(GroundPlan const& plan, GroundPlan const& earlier, Overlay const& overlay) {
  constexpr int block_px = 5;
  constexpr double least_ground = 0.4;
  constexpr double least_seen = 0.9;
  constexpr double least_seen_there = 0.7;
  constexpr double least_texture = 1e-4;
  auto const common = overlay.common();
  std::vector<Piece> pieces;
  if (common.width < piece_px || common.height < piece_px) return pieces;
  cv::Mat corners;
  cv::Mat shades;
  plan.shades(common).convertTo(shades, CV_32F);
  cv::cornerMinEigenVal(shades, corners, block_px);
  for (int y = 0; y + piece_px <= common.height; y += piece_px / 2) {
    for (int x = 0; x + piece_px <= common.width; x += piece_px / 2) {
      cv::Rect const at(common.x + x, common.y + y, piece_px, piece_px);
      if (share_of(plan.is_ground, at) < least_ground || share_of(plan.is_seen, at) < least_seen ||
          share_of(earlier.is_seen, overlay.searched(at)) < least_seen_there)
        continue;
      double const texture = cv::mean(corners(at - common.tl()), plan.is_ground(at))[0];
      if (texture > least_texture) pieces.push_back({at, texture});
    }
  }
  std::ranges::stable_sort(pieces, std::ranges::greater(), &Piece::texture);
  return pieces;
}

/// Where the score is greatest, to parts of a pixel; nothing where it says little of where that is.
std::optional<cv::Point2d> peak_of(cv::Mat const& scores) {
  constexpr double least = 0.55;
  constexpr float least_fall = 0.08F;
  double most = 0.0;
  cv::Point at;
  cv::minMaxLoc(scores, nullptr, &most, nullptr, &at);
  cv::Rect const inner(around_px, around_px, scores.cols - 2 * around_px, scores.rows - 2 * around_px);
  if (!(most >= least) || !std::isfinite(most) || !inner.contains(at)) return std::nullopt;
  auto const score = [&](int x, int y) { return scores.at<float>(at.y + y, at.x + x); };
  // Along a line of paint the score does not fall.
  constexpr int aslant_px = 3;
  for (auto const& [x, y] : {std::pair(around_px, 0), {0, around_px}, {aslant_px, aslant_px}, {aslant_px, -aslant_px}})
    if (std::max(score(x, y), score(-x, -y)) > score(0, 0) - least_fall) return std::nullopt;
  auto const between = [](double before, double here, double after) {
    double const bend = before - 2.0 * here + after;
    return bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
  };
  return cv::Point2d(at.x + between(score(-1, 0), score(0, 0), score(1, 0)),
                     at.y + between(score(0, -1), score(0, 0), score(0, 1)));
}

std::optional<TiePoint> tie_point(GroundPlan const& plan, GroundPlan const& earlier, cv::Rect const& piece,
                                  cv::Rect const& searched) {
  cv::Mat scores;
  cv::matchTemplate(earlier.shades(searched), plan.shades(piece), scores, cv::TM_CCOEFF_NORMED, plan.is_ground(piece));
  auto const peak = peak_of(scores);
  if (!peak) return std::nullopt;
  cv::Point2d const middle(0.5 * piece.width, 0.5 * piece.height);
  return TiePoint{.earlier = earlier.at,
                  .here = plan.place(cv::Point2d(piece.tl()) + middle),
                  .there = earlier.place(cv::Point2d(searched.tl()) + *peak + middle),
                  .sigma_m = sigma_m};
}

/// Those whose pieces lie elsewhere by about the same.
std::vector<TiePoint> agreeing(std::vector<TiePoint> ties, double most_apart_m, std::size_t fewest) {
  if (ties.size() < fewest) return {};
  std::vector<double> east;
  std::vector<double> north;
  for (auto const& tie : ties) {
    east.push_back(tie.there.x() - tie.here.x());
    north.push_back(tie.there.y() - tie.here.y());
  }
  Eigen::Vector2d const usual(base::median(east), base::median(north));
  std::erase_if(ties, [&](TiePoint const& tie) { return (tie.there.v - tie.here.v - usual).norm() > most_apart_m; });
  return ties.size() < fewest ? std::vector<TiePoint>() : ties;
}

}  // namespace

std::vector<TiePoint> tie_points(GroundPlan const& plan, GroundPlan const& earlier) {
  constexpr std::size_t enough = 4;
  constexpr std::size_t most_tried = 6;
  Overlay const overlay(plan, earlier);
  std::vector<TiePoint> ties;
  std::vector<cv::Rect> tried;
  for (auto const& [at, texture] : pieces_of(plan, earlier, overlay)) {
    if (tried.size() == most_tried || ties.size() == enough) break;
    if (std::ranges::any_of(tried, [&](cv::Rect const& other) { return (other & at).area() > 0; })) continue;
    tried.push_back(at);
    if (auto const tie = tie_point(plan, earlier, at, overlay.searched(at))) ties.push_back(*tie);
  }
  // The longer ago, the more the headings differ, by which pieces lie elsewhere by more or less, and the more is alike.
  bool const is_next = plan.at - earlier.at < shortly;
  return agreeing(std::move(ties), is_next ? 0.1 : 0.2, is_next ? 2 : 3);
}

/// The one that was kept last, and of those long before it the three that show most of the same.
std::vector<GroundPlan const*> TieFinder::partners(GroundPlan const& plan) const {
  constexpr double least_common = 0.15;
  constexpr std::size_t most_others = 3;
  std::vector<std::pair<double, GroundPlan const*>> others;
  std::vector<GroundPlan const*> partners;
  for (auto const& other : plans_) {
    if (other.pixel_m != plan.pixel_m) continue;
    if (&other == &plans_.back()) partners.push_back(&other);
    double const common = (plan.box() & other.box()).area() / plan.box().area();
    if (plan.at - other.at > long_before && common > least_common) others.emplace_back(common, &other);
  }
  std::ranges::stable_sort(others, std::ranges::greater(), [](auto const& other) { return other.first; });
  if (others.size() > most_others) others.resize(most_others);
  for (auto const& [common, other] : others)
    if (other != &plans_.back()) partners.push_back(other);
  return partners;
}

void TieFinder::tie(explore::LotSight& sight, GroundPicture const& ground, geo::Polygon<geo::SiteFrame> const& seen,
                    cv::Mat const& standing) {
  auto plan = ground_plan(sight, ground, seen, standing);
  if (!plans_.empty()) plan.shift = plans_.back().shift;
  Eigen::Vector2d shifts = Eigen::Vector2d::Zero();
  for (auto const* const partner : partners(plan)) {
    for (auto const& tie : tie_points(plan, *partner)) {
      sight.tie_points.push_back(tie);
      shifts += partner->shift + tie.there.v - tie.here.v;
    }
    // The one before comes first, and says where to look in those that are older.
    if (!sight.tie_points.empty()) plan.shift = shifts / static_cast<double>(sight.tie_points.size());
  }
  constexpr double new_share = 0.15;
  bool const is_new = plans_.empty() || plan.pixel_m != plans_.back().pixel_m ||
                      geo::distance_m(plan.below, plans_.back().below) > new_share * plan.shorter_side_m();
  if (!is_new) return;
  sight.ties_later = true;
  plan.is_ground.release();
  plans_.push_back(std::move(plan));
  if (plans_.size() > most_plans) plans_.pop_front();
}

}  // namespace lapwing::perceive
