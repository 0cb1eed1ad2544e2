#include "sim/building/scene/faces.hpp"

#include <cmath>
#include <limits>

#include "map/grid/cell_line.hpp"

namespace lapwing::sim::building {

namespace {

constexpr int most_cells_a_side = 4'000;

}  // namespace

std::string_view to_string(Thing thing) {
  switch (thing) {
    case Thing::wall: return "wall";
    case Thing::door: return "door";
    case Thing::furniture: return "furniture";
    case Thing::person: return "person";
    case Thing::robot: return "robot";
  }
  return "";
}

std::optional<Hit> meet(Face const& face, Place const& from, Shift const& way, double range_m) {
  auto const along = face.to - face.from;
  double const turn = along.cross(way);
  // Rays that come from the solid side have met its other faces before.
  if (turn <= 0.0) return std::nullopt;
  auto const to = from - face.from;
  double const share = -way.cross(to) / turn;
  if (share < 0.0 || share > 1.0) return std::nullopt;
  double const range = -along.cross(to) / turn;
  if (range < 0.0 || range > range_m) return std::nullopt;
  double const length_m = along.length();
  return Hit{.range_m = range,
             .normal = Shift(along.y() / length_m, -along.x() / length_m),
             .to_edge_m = std::min(share, 1.0 - share) * length_m,
             .material = face.material,
             .thing = face.thing,
             .number = face.number};
}

std::optional<Hit> meet(Post const& post, Place const& from, Shift const& way, double range_m) {
  auto const to = post.middle - from;
  double const along_m = to.dot(way);
  double const aside_m = way.cross(to);
  if (along_m <= 0.0 || std::abs(aside_m) >= post.radius_m || to.length() <= post.radius_m) return std::nullopt;
  double const range = along_m - std::sqrt(post.radius_m * post.radius_m - aside_m * aside_m);
  if (range > range_m) return std::nullopt;
  return Hit{.range_m = range,
             .normal = (from + range * way - post.middle) * (1.0 / post.radius_m),
             .to_edge_m = std::numeric_limits<double>::infinity(),
             .material = post.material,
             .thing = post.thing,
             .number = post.number};
}

Place nearest_point(Face const& face, Place const& to) {
  auto const along = face.to - face.from;
  double const square = along.dot(along);
  double const share = square > 0.0 ? std::clamp((to - face.from).dot(along) / square, 0.0, 1.0) : 0.0;
  return face.from + share * along;
}

FaceIndex::FaceIndex(std::vector<Face> faces) : faces_(std::move(faces)) {
  if (faces_.empty()) return;
  geo::Box<geo::FloorFrame> box{faces_.front().from, faces_.front().from};
  for (auto const& face : faces_) {
    for (auto const* end : {&face.from, &face.to}) {
      box.least.v = box.least.v.cwiseMin(end->v);
      box.most.v = box.most.v.cwiseMax(end->v);
    }
  }
  auto const size = box.most - box.least;
  cell_m_ = std::max({cell_m_, size.x() / most_cells_a_side, size.y() / most_cells_a_side});
  corner_ = box.least - Shift(cell_m_ / 2.0, cell_m_ / 2.0);
  width_ = static_cast<int>(size.x() / cell_m_) + 2;
  height_ = static_cast<int>(size.y() / cell_m_) + 2;
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1, 0);
  for (auto const& face : faces_) each_cell(face, [&](std::size_t cell) { ++counts[cell + 1]; });
  for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
  begins_ = counts;
  in_cells_.resize(counts.back());
  for (std::size_t i = 0; i < faces_.size(); ++i)
    each_cell(faces_[i], [&](std::size_t cell) { in_cells_[counts[cell]++] = static_cast<std::uint32_t>(i); });
}

map::Cell FaceIndex::cell_at(Place const& place) const {
  auto const within = (place - corner_) * (1.0 / cell_m_);
  auto const whole = [](double cells) {
    return static_cast<std::int32_t>(std::floor(std::clamp(cells, -1.0, 2.0 * most_cells_a_side)));
  };
  return {whole(within.x()), whole(within.y())};
}

std::span<std::uint32_t const> FaceIndex::in(map::Cell cell) const {
  auto const index =
      static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(cell.x);
  return std::span(in_cells_).subspan(begins_[index], begins_[index + 1] - begins_[index]);
}

/// The cells that a face's line comes near, those at its border, too: a ray along a border must find it from both
/// sides.
template <class Visit>
void FaceIndex::each_cell(Face const& face, Visit const& visit) const {
  auto const a = cell_at(face.from);
  auto const b = cell_at(face.to);
  // Half of a cell's diagonal, and a little.
  double const reach_m = 0.7072 * cell_m_ + 1e-6;
  for (auto y = std::max(std::min(a.y, b.y) - 1, 0); y <= std::min(std::max(a.y, b.y) + 1, height_ - 1); ++y) {
    for (auto x = std::max(std::min(a.x, b.x) - 1, 0); x <= std::min(std::max(a.x, b.x) + 1, width_ - 1); ++x) {
      auto const middle = corner_ + cell_m_ * Shift(x + 0.5, y + 0.5);
      if (distance_m(nearest_point(face, middle), middle) > reach_m) continue;
      visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
    }
  }
}

std::optional<Hit> FaceIndex::cast(Place const& from, Shift const& way, double range_m) const {
  std::optional<Hit> best;
  if (width_ == 0) return best;
  double limit_m = range_m;
  auto const start = (from - corner_) * (1.0 / cell_m_);
  map::walk_line(start.x(), start.y(), way.x(), way.y(), range_m / cell_m_, [&](map::Cell cell, double enters_at) {
    if (enters_at * cell_m_ > limit_m) return false;
    if (cell.x < 0 || cell.y < 0 || cell.x >= width_ || cell.y >= height_) {
      bool const leads_away = (cell.x < 0 && way.x() <= 0.0) || (cell.x >= width_ && way.x() >= 0.0) ||
                              (cell.y < 0 && way.y() <= 0.0) || (cell.y >= height_ && way.y() >= 0.0);
      return !leads_away;
    }
    for (auto const index : in(cell)) {
      if (auto const hit = meet(faces_[index], from, way, limit_m); hit) {
        best = hit;
        limit_m = hit->range_m;
      }
    }
    return true;
  });
  return best;
}

std::optional<Hit> Surroundings::cast(Place const& from, Shift const& way, double range_m) const {
  auto best = fixed.cast(from, way, range_m);
  double limit_m = best ? best->range_m : range_m;
  auto const take = [&](std::optional<Hit> const& hit) {
    if (!hit) return;
    best = hit;
    limit_m = hit->range_m;
  };
  for (auto const& face : moving) take(meet(face, from, way, limit_m));
  for (auto const& post : posts) take(meet(post, from, way, limit_m));
  return best;
}

}  // namespace lapwing::sim::building
