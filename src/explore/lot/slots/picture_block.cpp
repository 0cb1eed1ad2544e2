#include "explore/lot/slots/picture_block.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>

namespace lapwing::explore {

namespace {

Corners mean_outline(KnownSlot const& slot, PictureBlock const& block) {
  Corners sum;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i].v = slot.fixed_weight * slot.fixed[i].v;
  for (auto const& find : slot.finds) {
    auto const corners = block.placed(find);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i].v += find.weight * corners[i].v;
  }
  for (auto& corner : sum) corner.v /= slot.weight();
  return sum;
}

}  // namespace

/// The rows of one slot, or of one tie point.
struct PictureBlock::Sheaf {
  /// Where the slot's middle lies by one picture.
  struct Row {
    Eigen::Index picture;               ///< its first unknown
    Eigen::Matrix<double, 2, 4> parts;  ///< of the middle by the picture's shift
    Eigen::Vector2d at;                 ///< of the middle while the picture is not moved
    double weight;
  };
  std::vector<Row> rows;
  double weight = 0.0;                                  ///< of all rows, and of what is fixed
  Eigen::Vector2d fixed_sum = Eigen::Vector2d::Zero();  ///< of what is fixed, times its weight

  void fix(map::SitePoint const& at, double by) {
    weight += by;
    fixed_sum += by * at.v;
  }
  void add(Row row) {
    weight += row.weight;
    rows.push_back(std::move(row));
  }
  /// As no picture is moved.
  [[nodiscard]] Eigen::Vector2d mean() const {
    Eigen::Vector2d sum = fixed_sum;
    for (auto const& row : rows) sum += row.weight * row.at;
    return sum / weight;
  }
};

/// H x = b in the pictures' shifts, with the slots eliminated: a slot lies at the weighted mean of its rows.
struct PictureBlock::Equations {
  std::vector<Sheaf> sheaves;
  std::vector<Expectation> expectations;  ///< of each picture's pose
  Eigen::VectorXd right;
  std::vector<Eigen::Matrix4d> preconditioner;  ///< inverse diagonal blocks of H

  void add(Sheaf sheaf, std::vector<Eigen::Matrix4d>& blocks) {
    Eigen::Vector2d const mean = sheaf.mean();
    for (auto const& row : sheaf.rows) {
      right.segment<4>(row.picture) += row.weight * row.parts.transpose() * (mean - row.at);
      blocks[static_cast<std::size_t>(row.picture / 4)] +=
          row.weight * (1.0 - row.weight / sheaf.weight) * row.parts.transpose() * row.parts;
    }
    sheaves.push_back(std::move(sheaf));
  }

  /// A row of the expectations, s (x_i - k x_before)^2, as part of a product with `x`.
  void add_expectation(std::size_t picture, Eigen::VectorXd const& x, Eigen::VectorXd& product) const {
    auto const& [before, kept, stiffness] = expectations[picture];
    auto const at = static_cast<Eigen::Index>(4 * picture);
    Eigen::Vector4d off = x.segment<4>(at);
    if (before) off -= kept * x.segment<4>(static_cast<Eigen::Index>(4 * *before));
    Eigen::Vector4d const pull = stiffness.cwiseProduct(off);
    product.segment<4>(at) += pull;
    if (before) product.segment<4>(static_cast<Eigen::Index>(4 * *before)) -= kept * pull;
  }

  /// H x.
  [[nodiscard]] Eigen::VectorXd times(Eigen::VectorXd const& x) const {
    Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
    for (std::size_t i = 0; i < expectations.size(); ++i) add_expectation(i, x, product);
    for (auto const& sheaf : sheaves) {
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      for (auto const& row : sheaf.rows) mean += row.weight * (row.parts * x.segment<4>(row.picture));
      mean /= sheaf.weight;
      for (auto const& row : sheaf.rows)
        product.segment<4>(row.picture) +=
            row.weight * row.parts.transpose() * (row.parts * x.segment<4>(row.picture) - mean);
    }
    return product;
  }

  [[nodiscard]] Eigen::VectorXd preconditioned(Eigen::VectorXd const& rest) const {
    Eigen::VectorXd result(rest.size());
    for (std::size_t i = 0; i < preconditioner.size(); ++i) {
      auto const at = static_cast<Eigen::Index>(4 * i);
      result.segment<4>(at) = preconditioner[i] * rest.segment<4>(at);
    }
    return result;
  }

  /// Conjugate gradients (Hestenes, Stiefel 1952) from `x` on.
  void solve(Eigen::VectorXd& x) const {
    constexpr int most_steps = 60;
    constexpr double close = 1e-10;
    Eigen::VectorXd rest = right - times(x);
    Eigen::VectorXd way = preconditioned(rest);
    double energy = rest.dot(way);
    double const enough = close * close * (energy + right.dot(preconditioned(right)));
    for (int step = 0; step < most_steps && energy > enough; ++step) {
      Eigen::VectorXd const along = times(way);
      double const length = energy / way.dot(along);
      x += length * way;
      rest -= length * along;
      Eigen::VectorXd const next = preconditioned(rest);
      double const next_energy = rest.dot(next);
      way = next + (next_energy / energy) * way;
      energy = next_energy;
    }
  }
};

void PictureBlock::add(PlacedSight const& placed) {
  auto const below = below_camera(placed.sight);
  pictures_.push_back({.told_below = map::SitePoint(Eigen::Vector2d(below.v - placed.shift.v.head<2>())),
                       .below = below,
                       .came_by = placed.shift.v,
                       .expected = placed.expected,
                       .vehicle = placed.sight.vehicle,
                       .at = placed.sight.at,
                       .moved = {},
                       .ties = held(placed.sight.tie_points, placed.sight.vehicle)});
}

std::vector<PictureBlock::HeldTie> PictureBlock::held(std::span<TiePoint const> ties,
                                                      std::string const& vehicle) const {
  constexpr double both = 2.0;  // the one errs no more than the other
  std::vector<HeldTie> held;
  for (auto const& tie : ties)
    if (auto const earlier = number_of(vehicle, tie.earlier))
      held.push_back({.earlier = earlier,
                      .here = tie.here,
                      .there = picture(*earlier).came_to(tie.there),
                      .weight = both / (tie.sigma_m * tie.sigma_m)});
  return held;
}

std::optional<std::size_t> PictureBlock::number_of(std::string const& vehicle, base::UtcTime at) const {
  for (std::size_t i = pictures_.size(); i-- > 0;)
    if (pictures_[i].at == at && pictures_[i].vehicle == vehicle) return first_ + i;
  return std::nullopt;
}

std::optional<map::SitePoint> PictureBlock::placed(TiePoint const& tie, std::string const& vehicle) const {
  auto const number = number_of(vehicle, tie.earlier);
  if (!number) return std::nullopt;
  auto const& earlier = picture(*number);
  return earlier.now_at(earlier.came_to(tie.there));
}

Corners PictureBlock::placed(SlotFind const& find) const {
  auto const& by = picture(find.picture);
  auto corners = find.in_picture;
  for (auto& corner : corners) corner = by.now_at(corner);
  return corners;
}

/// What pictures say of a slot, and how much each counts where it lies now.
PictureBlock::Sheaf PictureBlock::sheaf_of(KnownSlot const& slot) const {
  Sheaf sheaf;
  if (slot.fixed_weight > 0.0) sheaf.fix(middle_of(slot.fixed), slot.fixed_weight);
  auto const middle = middle_of(slot.outline);
  for (auto const& find : slot.finds) {
    auto const& by = picture(find.picture);
    auto const at = middle_of(find.in_picture);
    double const left_m = geo::distance_m(by.now_at(at), middle);
    sheaf.add({.picture = static_cast<Eigen::Index>(4 * (find.picture - first_)),
               .parts = shift_of_place(at.v - by.below.v),
               .at = at.v,
               .weight = find.weight * huber_share(left_m * std::sqrt(find.weight))});
  }
  return sheaf;
}

PictureBlock::Sheaf PictureBlock::sheaf_of(std::size_t number, HeldTie const& tie) const {
  auto const there = tie.earlier ? picture(*tie.earlier).now_at(tie.there) : tie.there;
  double const left_m = geo::distance_m(picture(number).now_at(tie.here), there);
  double const weight = tie.weight * huber_share(left_m * std::sqrt(tie.weight / 2.0));
  Sheaf sheaf;
  auto const add = [&](std::size_t of, map::SitePoint const& at) {
    sheaf.add({.picture = static_cast<Eigen::Index>(4 * (of - first_)),
               .parts = shift_of_place(at.v - picture(of).below.v),
               .at = at.v,
               .weight = weight});
  };
  add(number, tie.here);
  if (tie.earlier)
    add(*tie.earlier, tie.there);
  else
    sheaf.fix(tie.there, weight);
  return sheaf;
}

PictureBlock::Equations PictureBlock::equations(std::span<KnownSlot const> slots) const {
  auto const unknowns = static_cast<Eigen::Index>(4 * pictures_.size());
  Equations all{.sheaves = {}, .expectations = {}, .right = Eigen::VectorXd::Zero(unknowns), .preconditioner = {}};
  std::vector<Eigen::Matrix4d> blocks(pictures_.size(), Eigen::Matrix4d::Zero());
  expect_poses(all, blocks);
  for (auto const& slot : slots) {
    if (slot.finds.size() + (slot.fixed_weight > 0.0 ? 1 : 0) < 2) continue;
    all.add(sheaf_of(slot), blocks);
  }
  for (std::size_t i = 0; i < pictures_.size(); ++i)
    for (auto const& tie : pictures_[i].ties) all.add(sheaf_of(first_ + i, tie), blocks);
  for (auto const& block : blocks) all.preconditioner.emplace_back(block.inverse());
  return all;
}

PictureBlock::Expectation PictureBlock::expectation(std::size_t picture) const {
  auto const& one = pictures_[picture];
  Expectation expected{.before = std::nullopt, .stiffness = one.expected.cwiseAbs2().cwiseInverse()};
  for (std::size_t i = picture; i-- > 0;) {
    if (pictures_[i].vehicle != one.vehicle) continue;
    double const apart_s = std::abs(base::to_seconds(one.at - pictures_[i].at));
    constexpr double most_kept = 0.999;  // two pictures of one moment
    expected.before = i;
    expected.kept = std::min(most_kept, std::exp(-apart_s / base::to_seconds(errors_last)));
    expected.stiffness /= 1.0 - expected.kept * expected.kept;
    break;
  }
  return expected;
}

/// The part of H that the poses have, and, as they are known up to where the pictures were put, of the right side.
void PictureBlock::expect_poses(Equations& all, std::vector<Eigen::Matrix4d>& blocks) const {
  Eigen::VectorXd came_by(all.right.size());
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    all.expectations.push_back(expectation(i));
    auto const& [before, kept, stiffness] = all.expectations.back();
    blocks[i] += stiffness.asDiagonal();
    if (before) blocks[*before] += (kept * kept * stiffness).asDiagonal();
    came_by.segment<4>(static_cast<Eigen::Index>(4 * i)) = pictures_[i].came_by;
  }
  for (std::size_t i = 0; i < pictures_.size(); ++i) all.add_expectation(i, came_by, all.right);
  all.right = -all.right;
}

void PictureBlock::settle(std::span<KnownSlot> slots) {
  while (pictures_.size() > most_pictures) fix_oldest(slots);
  Eigen::VectorXd shifts(static_cast<Eigen::Index>(4 * pictures_.size()));
  for (std::size_t i = 0; i < pictures_.size(); ++i)
    shifts.segment<4>(static_cast<Eigen::Index>(4 * i)) = pictures_[i].moved.v;
  equations(slots).solve(shifts);
  for (std::size_t i = 0; i < pictures_.size(); ++i)
    pictures_[i].moved.v = shifts.segment<4>(static_cast<Eigen::Index>(4 * i));
  for (auto& slot : slots)
    if (!slot.finds.empty()) slot.outline = mean_outline(slot, *this);
}

/// What the oldest picture says of the slots, and what others have in common with it, is kept as it lies now.
void PictureBlock::fix_oldest(std::span<KnownSlot> slots) {
  for (auto& slot : slots) {
    for (auto const& find : slot.finds)
      if (find.picture == first_) slot.fix(placed(find), find.weight);
    std::erase_if(slot.finds, [&](SlotFind const& find) { return find.picture == first_; });
  }
  auto const& oldest = pictures_.front();
  for (auto& picture : pictures_) {
    for (auto& tie : picture.ties) {
      if (tie.earlier != first_) continue;
      tie.there = oldest.now_at(tie.there);
      tie.earlier.reset();
    }
  }
  pictures_.pop_front();
  ++first_;
}

}  // namespace lapwing::explore
