#include "slam/grid/draw_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/assert.hpp"
#include "slam/grid/draw_cone.hpp"
#include "slam/grid/sheet.hpp"

namespace lapwing::slam {
namespace {

constexpr float steps_per_log_odds = 256.0F;

bool is_hit(float range, Sensor const& sensor, BeamModel const& model) {
  return range > 0.05F && range < sensor.no_return_m && range <= static_cast<float>(model.most_range_m);
}

double noise_of(double range, BeamModel const& model) {
  return model.noise_m + model.noise_per_m * range;
}

Sheet sheet_for(ScanLog const& log, std::vector<Pose2> const& poses, BeamModel const& model) {
  Eigen::Vector2d low = place(poses.front());
  Eigen::Vector2d high = low;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto const& sensor = log.sensors[log.scans[i].sensor];
    auto longest = static_cast<float>(silence_m);
    for (auto const range : log.scans[i].ranges_m)
      if (range < sensor.no_return_m)
        longest = std::max(longest, std::min(range, static_cast<float>(model.most_range_m)));
    auto const reach = Eigen::Vector2d::Constant(longest + sensor.mount_m.norm());
    low = low.cwiseMin(place(poses[i]) - reach);
    high = high.cwiseMax(place(poses[i]) + reach);
  }
  constexpr double most_cells = 1e8;
  Sheet sheet{.origin = low, .cell_m = model.cell_m};
  auto const size = [&] { return ((high - low) / sheet.cell_m).array().ceil() + 1.0; };
  while (size().prod() > most_cells) sheet.cell_m *= 2.0;
  sheet.origin = (low / sheet.cell_m).array().floor() * sheet.cell_m;
  sheet.width = static_cast<int>(size().x()) + 1;
  sheet.height = static_cast<int>(size().y()) + 1;
  auto const cells = static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height);
  sheet.log_odds.assign(cells, Sheet::unseen);
  return sheet;
}

/// Along a line from `begin_m` to `end_m` nothing stands.
void draw_free(Sheet& sheet, Ray const& ray, double begin_m, double end_m, double log_odds, BeamModel const& model) {
  Eigen::Vector2d const begin = (ray.from - sheet.origin) / sheet.cell_m;
  double const end = end_m / sheet.cell_m;
  double const wide_from = 1.0 / model.width_rad;  // cells away, it is wider than one
  constexpr double step = 0.7;                     // cells: none on the way is left out by more than a corner
  auto last = std::numeric_limits<std::size_t>::max();
  for (double way = begin_m / sheet.cell_m; way < end; way += step) {
    Eigen::Vector2d const at = begin + way * ray.direction;
    auto const x = static_cast<int>(at.x());
    auto const y = static_cast<int>(at.y());
    if (!sheet.contains(x, y)) return;
    auto const index = sheet.index(x, y);
    if (index == last) continue;
    last = index;
    sheet.add(index, static_cast<float>(way < wide_from ? log_odds : log_odds * wide_from / way));
  }
}

/// Taken as likely as the end lies in each cell.
void draw_end(Sheet& sheet, Ray const& ray, double range, BeamModel const& model) {
  Eigen::Vector2d const begin = (ray.from - sheet.origin) / sheet.cell_m;
  auto const noise = noise_of(range, model);
  auto const reach = static_cast<int>(std::ceil(2.0 * noise / sheet.cell_m));
  double sum = 0.0;
  for (int c = -reach; c <= reach; ++c) sum += std::exp(-0.5 * std::pow(c * sheet.cell_m / noise, 2));
  for (int c = -reach; c <= reach; ++c) {
    Eigen::Vector2d const at = begin + (range / sheet.cell_m + c) * ray.direction;
    auto const share = std::exp(-0.5 * std::pow(c * sheet.cell_m / noise, 2)) / sum;
    auto const x = static_cast<int>(at.x());
    auto const y = static_cast<int>(at.y());
    if (share > 0.05 && sheet.contains(x, y))
      sheet.add(sheet.index(x, y), static_cast<float>(share * model.taken_log_odds));
  }
}

/// Draws one scan.
class Drawing {
 public:
  Drawing(Sheet& sheet, Scan const& scan, Sensor const& sensor, Pose2 const& pose, BeamModel const& model)
      : sheet_(sheet), scan_(scan), sensor_(sensor), bearings_(bearings_of(scan, sensor)), pose_(pose), model_(model) {
    from_ = place(pose) + Turn(pose.yaw) * sensor.mount_m.cast<double>();
  }

  void draw() {
    if (sensor_.half_cone_rad > 0.0F) return draw_cones();
    find_what_is_free();
    for (std::size_t b = 0; b < free_m_.size(); ++b) {
      auto const ray = ray_at(bearings_[b]);
      bool const is_measured = is_hit(scan_.ranges_m[b], sensor_, model_);
      draw_free(sheet_, ray, 0.0, free_m_[b], model_.free_log_odds * (is_measured ? 1.0 : between_share), model_);
      if (is_measured) draw_end(sheet_, ray, scan_.ranges_m[b], model_);
    }
    for (std::size_t b = 0; b < free_m_.size(); ++b)
      if (has_next(b)) draw_between(b, next(b));
  }

 private:
  /// What no beam says itself is a hint where nothing else is known, and wears no wall away.
  static constexpr double between_share = 0.1;
  /// Beams farther apart than this say nothing of what is between them: single rangers, a ring of sonars.
  static constexpr double most_apart_rad = 0.04;
  /// Nothing comes back along a corridor that is longer than the sensor sees, and from what is dark or shines. It is
  /// the former where the beams on both sides, no farther apart than that, come to this share of the sensor's reach.
  static constexpr double far_share = 0.5;
  static constexpr double most_gap_rad = 2.0;
  /// Where more is silent than that, it is a hall that is larger than the sensor sees, or a black wall right before it:
  /// a hint for the next step, as from a single ranger. Nothing flat fills more than this.
  static constexpr double widest_rad = 3.1;
  static constexpr double beside_rad = 1.2;  ///< so far apart at most are sonars that may hear the same wall

  [[nodiscard]] Ray ray_at(double bearing) const {
    double const yaw = pose_.yaw + bearing;
    return {.from = from_, .direction = {std::cos(yaw), std::sin(yaw)}};
  }
  [[nodiscard]] double reach_m() const { return std::min(double{sensor_.no_return_m}, model_.most_range_m); }
  [[nodiscard]] double gap_rad(std::size_t from, std::size_t to) const {
    double const gap = double{bearings_[to]} - double{bearings_[from]};
    return to >= from ? gap : gap + 2.0 * std::numbers::pi;
  }
  /// The beam to the left of another; that of the last one is the first, where they go round.
  [[nodiscard]] std::size_t next(std::size_t b) const { return b + 1 < bearings_.size() ? b + 1 : 0; }
  /// It looks nearly the same way.
  [[nodiscard]] bool has_next(std::size_t b) const {
    double const gap = gap_rad(b, next(b));
    return gap > 0.0 && gap < most_apart_rad;
  }

  void draw_cones() {
    for (std::size_t b = 0; b < bearings_.size(); ++b) {
      auto const axis = ray_at(bearings_[b]);
      float const range = scan_.ranges_m[b];
      double const half_cone_rad = sensor_.half_cone_rad;
      if (is_hit(range, sensor_, model_))
        draw_cone(sheet_, axis, half_cone_rad, range, model_);
      else if (is_silent(b))
        draw_silent_cone(sheet_, axis, half_cone_rad, heard_beside_m(b), model_);
    }
  }

  /// The nearest that the sonars next to one hear: it may be a wall that goes on before that one and mirrors its sound.
  [[nodiscard]] double heard_beside_m(std::size_t b) const {
    double nearest_m = reach_m();
    for (auto const other : {b, before(b)}) {
      bool const is_beside = gap_rad(other, next(other)) < beside_rad;
      auto const range = scan_.ranges_m[other == b ? next(b) : other];
      if (is_beside && is_hit(range, sensor_, model_)) nearest_m = std::min(nearest_m, double{range});
    }
    return nearest_m;
  }

  void find_what_is_free() {
    free_m_.assign(scan_.ranges_m.size(), 0.0);
    for (std::size_t b = 0; b < free_m_.size(); ++b) {
      double const range = scan_.ranges_m[b];
      if (is_hit(scan_.ranges_m[b], sensor_, model_))
        free_m_[b] = range - std::max(2.0 * noise_of(range, model_), sheet_.cell_m);
      else if (range < sensor_.no_return_m && range > model_.most_range_m)
        free_m_[b] = model_.most_range_m;
    }
    auto const count = free_m_.size();
    auto const begin = begin_of_a_run();
    for (std::size_t k = 0; k < count;) {
      auto const first = (begin + k) % count;
      std::size_t silent = 0;
      while (k + silent < count && is_silent((first + silent) % count) &&
             (silent == 0 || has_next((first + silent - 1) % count)))
        ++silent;
      if (silent > 0) find_what_silence_frees(first, silent);
      k += std::max<std::size_t>(silent, 1);
    }
  }

  [[nodiscard]] bool is_silent(std::size_t b) const { return scan_.ranges_m[b] >= sensor_.no_return_m; }
  [[nodiscard]] std::size_t before(std::size_t b) const { return b > 0 ? b - 1 : bearings_.size() - 1; }

  /// A beam with which no run of silent ones goes on; the first of all where they go round and none came back.
  [[nodiscard]] std::size_t begin_of_a_run() const {
    for (std::size_t b = 0; b < scan_.ranges_m.size(); ++b)
      if (!is_silent(b) || !has_next(before(b))) return b;
    return 0;
  }

  /// Of beams beside each other from which nothing came back.
  void find_what_silence_frees(std::size_t first, std::size_t count) {
    auto const last = (first + count - 1) % bearings_.size();
    bool const is_all = count == bearings_.size();
    bool const begins_beside = !is_all && has_next(before(first));
    bool const ends_beside = !is_all && has_next(last);
    double const begin_m = begins_beside ? free_m_[before(first)] : reach_m();
    double const end_m = ends_beside ? free_m_[next(last)] : reach_m();
    double const far_m = far_share * reach_m();
    bool const is_between_far = begin_m >= far_m && end_m >= far_m;
    double wide_rad = 2.0 * std::numbers::pi;
    if (!is_all || !has_next(last))
      wide_rad = gap_rad(begins_beside ? before(first) : first, ends_beside ? next(last) : last);
    bool const is_alone = count == 1 && !begins_beside && !ends_beside;  // no beam beside it says why
    double free_m = 0.0;
    if (is_alone || wide_rad > widest_rad || (wide_rad > most_gap_rad && is_between_far))
      free_m = silence_m;
    else if (begins_beside && ends_beside && is_between_far)
      free_m = std::min(begin_m, end_m);
    for (std::size_t k = 0; k < count; ++k) free_m_[(first + k) % bearings_.size()] = free_m;
  }

  /// Two beams that are nearly parallel leave cells between them far away, in which nothing wider than that stands
  /// before the nearer of their ends: a line in the middle from where they are a cell apart, lines in the quarters from
  /// where they are two, and so on.
  void draw_between(std::size_t left, std::size_t right) {
    double const gap = gap_rad(left, right);
    double const end_m = std::min(free_m_[left], free_m_[right]);
    double begin_m = sheet_.cell_m / gap;
    for (int parts = 2; begin_m < end_m; parts *= 2, begin_m *= 2.0) {
      for (int part = 1; part < parts; part += 2)
        draw_free(sheet_, ray_at(double{bearings_[left]} + gap * part / parts), begin_m, end_m,
                  between_share * model_.free_log_odds, model_);
    }
  }

  Sheet& sheet_;
  Scan const& scan_;
  Sensor const& sensor_;
  std::vector<float> const& bearings_;
  Pose2 pose_;
  BeamModel const& model_;
  Eigen::Vector2d from_ = Eigen::Vector2d::Zero();
  std::vector<double> free_m_;  ///< along each beam; 0 where nothing is known
};

map::OccupancyGrid as_grid(Sheet const& sheet) {
  map::OccupancyGrid grid(sheet.cell_m);
  auto const left = static_cast<int>(std::lround(sheet.origin.x() / sheet.cell_m));
  auto const bottom = static_cast<int>(std::lround(sheet.origin.y() / sheet.cell_m));
  map::GridTile* tile = nullptr;
  map::TileKey key;
  for (int y = 0; y < sheet.height; ++y) {
    tile = nullptr;
    for (int x = 0; x < sheet.width; ++x) {
      if (sheet.log_odds[sheet.index(x, y)] == Sheet::unseen) continue;
      map::Cell const cell{left + x, bottom + y};
      if (auto const of_cell = map::tile_of(cell); tile == nullptr || of_cell != key) {
        key = of_cell;
        tile = &grid.tile_to_write(key);
      }
      auto const within =
          static_cast<std::size_t>(cell.y & 255) * map::tile_cells + static_cast<std::size_t>(cell.x & 255);
      tile->cells[within] = map::Evidence::of_steps(
          static_cast<int>(std::lround(sheet.log_odds[sheet.index(x, y)] * steps_per_log_odds)));
    }
  }
  return grid;
}

}  // namespace

map::OccupancyGrid draw_grid(ScanLog const& log, std::vector<Pose2> const& poses, BeamModel const& model) {
  LAPWING_ASSERT(poses.size() == log.scans.size(), poses.size(), log.scans.size());
  if (poses.empty()) return map::OccupancyGrid(model.cell_m);
  auto sheet = sheet_for(log, poses, model);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto const& scan = log.scans[i];
    Drawing(sheet, scan, log.sensors[scan.sensor], poses[i], model).draw();
  }
  return as_grid(sheet);
}

}  // namespace lapwing::slam
