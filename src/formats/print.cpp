#include "formats/print.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "formats/internal/grid_cells.hpp"

namespace lapwing::formats {

namespace {

using base::ErrorKind;
using base::fail;
using map::SiteBox;
using map::SitePoint;

constexpr double points_a_mm = 72.0 / 25.4;
constexpr double margin_mm = 12.0;
constexpr double largest_page_mm = 5000.0;  ///< PDF readers take no page beyond 14,400 points (ISO 32000-1, annex C)

struct Colour {
  double red;
  double green;
  double blue;
  double opacity = 1.0;
};

constexpr Colour ink = {0.10, 0.12, 0.15};
constexpr Colour faint = {0.55, 0.58, 0.62};
constexpr Colour free_green = {0.18, 0.55, 0.34};
constexpr Colour taken_red = {0.75, 0.22, 0.20};
constexpr Colour unknown_grey = {0.55, 0.58, 0.62};
constexpr Colour area_blue = {0.15, 0.40, 0.75};
constexpr Colour track_orange = {0.85, 0.50, 0.10};

/// What of the map goes on the paper, and the part of the plane that it covers.
struct Plan {
  std::vector<map::Feature const*> features;
  std::vector<map::OccupancyGrid const*> grids;
  std::optional<SiteBox> extent;

  void cover(SiteBox const& box) {
    if (!extent) extent = box;
    extent->least.v = extent->least.v.cwiseMin(box.least.v);
    extent->most.v = extent->most.v.cwiseMax(box.most.v);
  }
};

bool is_on_paper(std::string const& site, std::string const& floor, PrintOptions const& options, bool has_one_floor) {
  return site == options.site && (floor == options.floor || (options.floor.empty() && has_one_floor));
}

SiteBox extent_of(map::OccupancyGrid const& grid, map::CellBox const& box) {
  auto const corner = [&](std::int64_t x, std::int64_t y) {
    return grid.site_from_grid() *
           geo::Point<map::GridFrame>(static_cast<double>(box.least.x + x) * grid.resolution_m(),
                                      static_cast<double>(box.least.y + y) * grid.resolution_m());
  };
  return map::bounds(
      map::SitePolygon{{{corner(0, 0), corner(box.width, 0), corner(box.width, box.height), corner(0, box.height)}}});
}

base::Result<Plan> plan_of(MapContents const& contents, PrintOptions const& options) {
  auto const site = contents.sites.find(options.site);
  if (site == contents.sites.end())
    return fail(ErrorKind::not_found, fmt::format("there is no site `{}`", options.site));
  if (!options.floor.empty() && !site->second.floor(options.floor))
    return fail(ErrorKind::not_found, fmt::format("the site `{}` has no floor `{}`", options.site, options.floor));
  bool const has_one_floor = site->second.floors().size() == 1;
  Plan plan;
  for (auto const& feature : contents.features) {
    if (!is_on_paper(feature.site, feature.floor, options, has_one_floor)) continue;
    plan.features.push_back(&feature);
    plan.cover(map::bounds(map::geometry_of(feature.content)));
  }
  for (auto const& [key, grid] : contents.grids) {
    if (!is_on_paper(key.site, key.floor, options, has_one_floor)) continue;
    auto const box = internal::seen_cells(grid, key.name);
    if (!box) continue;
    plan.grids.push_back(&grid);
    plan.cover(extent_of(grid, *box));
  }
  if (!plan.extent)
    return fail(ErrorKind::invalid_input, fmt::format("nothing lies on that floor of the site `{}`", options.site));
  return plan;
}

/// Draws in millimetres on the paper, at the plan's scale.
class Paper {
 public:
  Paper(cairo_t* cairo, SiteBox const& extent, double scale)
      : cairo_(cairo), extent_(extent), mm_a_m_(1000.0 / scale), height_mm_(size(extent.most.y() - extent.least.y())) {}

  [[nodiscard]] double width_mm() const { return size(extent_.most.x() - extent_.least.x()); }
  [[nodiscard]] double height_mm() const { return height_mm_; }

  void draw(map::OccupancyGrid const& grid);
  void draw(map::Content const& content) {
    std::visit([this](auto const& thing) { draw_thing(thing); }, content);
  }
  void draw_ruler();

 private:
  struct OnPaper {
    double x;
    double y;
  };
  [[nodiscard]] double size(double metres) const { return metres * mm_a_m_; }
  [[nodiscard]] OnPaper at(SitePoint const& point) const {
    return {margin_mm + size(point.x() - extent_.least.x()),
            margin_mm + height_mm_ - size(point.y() - extent_.least.y())};
  }
  void use(Colour const& colour) {
    cairo_set_source_rgba(cairo_, colour.red, colour.green, colour.blue, colour.opacity);
  }
  void trace(std::span<SitePoint const> points);
  void stroke(double width_mm, Colour const& colour) {
    use(colour);
    cairo_set_line_width(cairo_, width_mm);
    cairo_stroke(cairo_);
  }
  void outline(map::SitePolygon const& polygon, Colour const& colour, double width_mm);
  void write(OnPaper const& place, std::string const& text, double height_mm, Colour const& colour);

  void draw_thing(map::Slot const& slot);
  void draw_thing(map::Wall const& wall);
  void draw_thing(map::PointOfInterest const& point);
  void draw_thing(map::Picture const& picture);
  void draw_thing(map::Track const& track);
  void draw_thing(map::Area const& area);

  cairo_t* cairo_;
  SiteBox extent_;
  double mm_a_m_;
  double height_mm_;
};

void Paper::trace(std::span<SitePoint const> points) {
  for (auto const& point : points) {
    auto const place = at(point);
    cairo_line_to(cairo_, place.x, place.y);
  }
}

void Paper::outline(map::SitePolygon const& polygon, Colour const& colour, double width_mm) {
  for (auto const& ring : polygon.rings) {
    trace(ring);
    cairo_close_path(cairo_);
  }
  auto fill = colour;
  fill.opacity = 0.15;
  use(fill);
  cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill_preserve(cairo_);
  stroke(width_mm, colour);
}

void Paper::write(OnPaper const& place, std::string const& text, double height_mm, Colour const& colour) {
  cairo_select_font_face(cairo_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, height_mm);
  use(colour);
  cairo_move_to(cairo_, place.x, place.y);
  cairo_show_text(cairo_, text.c_str());
}

void Paper::draw_thing(map::Slot const& slot) {
  auto const colour = slot.state == map::SlotState::taken  ? taken_red
                      : slot.state == map::SlotState::free ? free_green
                                                           : unknown_grey;
  outline(slot.outline, colour, 0.25);
  if (slot.name.empty()) return;
  auto const middle = at(geo::centroid(slot.outline));
  write({middle.x - 1.5, middle.y + 1.0}, slot.name, 2.5, ink);
}

void Paper::draw_thing(map::Wall const& wall) {
  cairo_new_path(cairo_);
  trace(wall.line.points);
  stroke(std::max(0.35, size(wall.thickness_m.value_or(0.0))), ink);
}

void Paper::draw_thing(map::PointOfInterest const& point) {
  auto const place = at(point.position);
  cairo_new_path(cairo_);
  cairo_arc(cairo_, place.x, place.y, 1.0, 0.0, 2.0 * std::numbers::pi);
  use(area_blue);
  cairo_fill(cairo_);
  auto const& label = point.name.empty() ? point.kind : point.name;
  if (!label.empty()) write({place.x + 1.6, place.y + 1.0}, label, 3.0, ink);
}

void Paper::draw_thing(map::Picture const& picture) {
  if (picture.footprint.size() >= 3) outline({{picture.footprint}}, faint, 0.15);
}

void Paper::draw_thing(map::Track const& track) {
  cairo_new_path(cairo_);
  for (auto const& sample : track.samples) {
    auto const place = at(sample.position);
    cairo_line_to(cairo_, place.x, place.y);
  }
  stroke(0.3, track_orange);
}

void Paper::draw_thing(map::Area const& area) {
  outline(area.outline, area.purpose == map::AreaPurpose::no_go ? taken_red : area_blue, 0.5);
}

void Paper::draw(map::OccupancyGrid const& grid) {
  auto const box = internal::seen_cells(grid, "grid");
  if (!box) return;
  auto const width = static_cast<int>(box->width);
  auto const height = static_cast<int>(box->height);
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> const picture(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height), &cairo_surface_destroy);
  if (cairo_surface_status(picture.get()) != CAIRO_STATUS_SUCCESS) return;
  cairo_surface_flush(picture.get());
  auto* data = cairo_image_surface_get_data(picture.get());
  int const stride = cairo_image_surface_get_stride(picture.get());
  for (int row = 0; row < height; ++row) {
    for (int x = 0; x < width; ++x) {
      auto const evidence = grid.at({box->least.x + x, static_cast<std::int32_t>(box->least.y + height - 1 - row)});
      // Paper is white where it is free, and where nobody looked it is left as it is, but for a tint.
      auto const grey =
          evidence.is_seen() ? static_cast<std::uint32_t>(std::lround(255.0 * (1.0 - evidence.probability()))) : 225U;
      auto const pixel = 0xff000000U | grey << 16U | grey << 8U | grey;
      std::memcpy(data + std::ptrdiff_t{row} * stride + std::ptrdiff_t{x} * 4, &pixel, sizeof(pixel));
    }
  }
  cairo_surface_mark_dirty(picture.get());
  auto const upper_left =
      at(grid.site_from_grid() *
         geo::Point<map::GridFrame>(box->least.x * grid.resolution_m(),
                                    static_cast<double>(box->least.y + height) * grid.resolution_m()));
  cairo_save(cairo_);
  cairo_translate(cairo_, upper_left.x, upper_left.y);
  cairo_rotate(cairo_, -grid.site_from_grid().yaw_rad());
  cairo_scale(cairo_, size(grid.resolution_m()), size(grid.resolution_m()));
  cairo_set_source_surface(cairo_, picture.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(cairo_), CAIRO_FILTER_NEAREST);
  cairo_paint(cairo_);
  cairo_restore(cairo_);
}

void Paper::draw_ruler() {
  double const left = margin_mm;
  double const bottom = margin_mm + height_mm_;
  auto const mark = [this](double x, double y, double dx, double dy) {
    cairo_move_to(cairo_, x, y);
    cairo_line_to(cairo_, x + dx, y + dy);
  };
  cairo_new_path(cairo_);
  // At small scales a mark a metre would be a black bar.
  double const step_m = size(1.0) >= 2.0 ? 1.0 : size(10.0) >= 2.0 ? 10.0 : 100.0;
  for (int i = 0; size(i * step_m) <= width_mm(); ++i)
    mark(left + size(i * step_m), bottom, 0.0, i % 5 == 0 ? 3.0 : 1.5);
  for (int i = 0; size(i * step_m) <= height_mm_; ++i)
    mark(left, bottom - size(i * step_m), i % 5 == 0 ? -3.0 : -1.5, 0.0);
  stroke(0.2, faint);
  for (int i = 0; size(i * step_m) <= width_mm(); i += 5)
    write({left + size(i * step_m) - 1.0, bottom + 6.5}, fmt::format("{:g}", i * step_m), 2.8, faint);
  for (int i = 5; size(i * step_m) <= height_mm_; i += 5)
    write({left - 9.0, bottom - size(i * step_m) + 1.0}, fmt::format("{:g}", i * step_m), 2.8, faint);
}

/// Lower things first: a label on a filled slot is to be read.
int rank_of(map::Feature const& feature) {
  switch (map::layer_of(feature.content)) {
    case map::LayerKind::pictures: return 0;
    case map::LayerKind::areas: return 1;
    case map::LayerKind::slots: return 2;
    case map::LayerKind::tracks: return 3;
    case map::LayerKind::walls: return 4;
    case map::LayerKind::points_of_interest: return 5;
  }
  return 5;
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

Surface surface_for(std::filesystem::path const& path, double width_mm, double height_mm) {
  double const width = width_mm * points_a_mm;
  double const height = height_mm * points_a_mm;
  if (path.extension() == ".pdf")
    return {cairo_pdf_surface_create(path.c_str(), width, height), &cairo_surface_destroy};
  auto* svg = cairo_svg_surface_create(path.c_str(), width, height);
  cairo_svg_surface_set_document_unit(svg, CAIRO_SVG_UNIT_PT);
  return {svg, &cairo_surface_destroy};
}

}  // namespace

base::Result<> write_print(MapContents const& contents, PrintOptions const& options,
                           std::filesystem::path const& path) {
  if (!(options.scale >= 1.0 && options.scale <= 100'000.0))
    return fail(ErrorKind::invalid_input, fmt::format("1 : {} is no scale from 1 : 1 to 1 : 100000", options.scale));
  auto plan = plan_of(contents, options);
  if (!plan) return std::unexpected(plan.error());
  double const width_mm = (plan->extent->most.x() - plan->extent->least.x()) * 1000.0 / options.scale + 2.0 * margin_mm;
  double const height_mm =
      (plan->extent->most.y() - plan->extent->least.y()) * 1000.0 / options.scale + 2.0 * margin_mm;
  if (std::max(width_mm, height_mm) > largest_page_mm)
    return fail(ErrorKind::invalid_input,
                fmt::format("at 1 : {:g} the plan is {:.1f} m x {:.1f} m of paper, more than 5 m", options.scale,
                            width_mm / 1000.0, height_mm / 1000.0),
                "print it at a smaller scale, such as --scale 500");
  auto const surface = surface_for(path, width_mm, height_mm);
  {
    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> const cairo(cairo_create(surface.get()), &cairo_destroy);
    cairo_scale(cairo.get(), points_a_mm, points_a_mm);
    Paper paper(cairo.get(), *plan->extent, options.scale);
    for (auto const* grid : plan->grids) paper.draw(*grid);
    std::ranges::stable_sort(plan->features, {}, [](map::Feature const* feature) { return rank_of(*feature); });
    for (auto const* feature : plan->features) paper.draw(feature->content);
    paper.draw_ruler();
  }
  cairo_surface_finish(surface.get());
  if (auto const status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS)
    return fail(ErrorKind::io, fmt::format("{} cannot be written: {}", path.string(), cairo_status_to_string(status)));
  return {};
}

}  // namespace lapwing::formats
