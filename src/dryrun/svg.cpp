#include "dryrun/svg.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dryrun/internal/picture.hpp"
#include "dryrun/words.hpp"

namespace lapwing::dryrun {

using namespace internal;

std::string internal::colour_of(std::size_t vehicle) {
  constexpr std::size_t colours = 7;
  return fmt::format("v{}", vehicle % colours);
}

namespace {

constexpr double width = 1040.0;
constexpr double margin = 24.0;
constexpr double head_height = 74.0;

/// Colours that colour-blind people tell apart (Okabe and Ito 2008), lighter ones on dark ground.
constexpr std::string_view style = R"svg(<style>
svg{--ground:#ffffff;--panel:#f6f7f5;--ink:#1d2733;--soft:#5d6b7a;--line:#d5dae0;--faint:#e6e9ec;--alarm:#c4161c;--fence:#2b7a4b;
font-family:system-ui,-apple-system,"Segoe UI","DejaVu Sans",Helvetica,Arial,sans-serif;font-size:12px}
.v0{--c:#0072b2}.v1{--c:#d55e00}.v2{--c:#009e73}.v3{--c:#b0578d}.v4{--c:#b07d00}.v5{--c:#3a96cc}.v6{--c:#5d6b7a}
@media (prefers-color-scheme:dark){svg{--ground:#12171d;--panel:#1a2129;--ink:#e8edf2;--soft:#9aa7b4;--line:#38434f;--faint:#242d37;--alarm:#ff6b66;--fence:#63c08a}
.v0{--c:#4aa8e0}.v1{--c:#ff8a3d}.v2{--c:#2fcfa2}.v3{--c:#e495c4}.v4{--c:#f0b93a}.v5{--c:#8fd0f5}.v6{--c:#9aa7b4}}
text{fill:var(--ink)}.soft{fill:var(--soft)}.small{font-size:11px}.tiny{font-size:10px}.title{font-size:19px;font-weight:600}
.name{font-size:13px;font-weight:600;fill:var(--c)}.ground{fill:var(--ground)}.panel{fill:var(--panel);stroke:var(--line)}
.grid{stroke:var(--faint);fill:none}.axis{stroke:var(--line);fill:none}.halo{paint-order:stroke;stroke:var(--panel);stroke-width:3px;stroke-linejoin:round}
.track{fill:none;stroke:var(--c);stroke-width:2;stroke-linejoin:round;stroke-linecap:round}.under{fill:none;stroke:var(--panel);stroke-width:4.5;stroke-linejoin:round}
.mark{fill:var(--c)}.item{fill:var(--panel);stroke:var(--c);stroke-width:1.5}.number{font-size:10px;font-weight:600;fill:var(--c)}
.bar{fill:var(--c);opacity:.92}.onbar{font-size:11px;font-weight:600;fill:var(--ground)}.area{fill:var(--c);opacity:.2;stroke:none}.curve{fill:none;stroke:var(--c);stroke-width:1.5}
.battery{fill:none;stroke:var(--ink);stroke-width:1.2;stroke-dasharray:4 3}.alarm{fill:var(--alarm)}.alarmline{stroke:var(--alarm);stroke-width:1.8;fill:none}
.inside{stroke:var(--fence);stroke-width:1.6;stroke-dasharray:7 4;fill:var(--fence);fill-opacity:.05}.fencename{fill:var(--fence);font-size:11px}
.outside{stroke:var(--alarm);stroke-width:1.4;fill:url(#hatch)}.ink{fill:var(--ink)}.onhome{fill:var(--panel);font-weight:700;text-anchor:middle}.inkline{stroke:var(--ink);fill:none}.said{stroke:var(--soft);stroke-dasharray:1 3;fill:none}
</style>
<defs><pattern id="hatch" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><path d="M0 0V7" style="stroke:var(--alarm);stroke-width:1.6;opacity:.45"/></pattern></defs>)svg";

std::string summary(Subject const& subject) {
  auto const& [record, analysis, fence] = subject;
  double path_m = 0.0;
  double energy_wh = 0.0;
  for (auto const& sums : analysis.vehicles) {
    path_m += sums.path_m;
    energy_wh += sums.energy_wh;
  }
  auto const count = record.vehicles.size();
  return fmt::format("{} after {}  ·  {} vehicle{}  ·  {} of path  ·  {:.1f} Wh", record.outcome,
                     clock_text(record.duration), count, count == 1 ? "" : "s", length_text(path_m), energy_wh);
}

void draw_head(Drawing& drawing, Subject const& subject) {
  auto const& [record, analysis, fence] = subject;
  double const right = width - margin;
  drawing.add(R"(<text x="{0}" y="34" class="title">{1}</text><text x="{0}" y="56" class="soft">{2}</text>)", margin,
              fitted(record.script, 19.0, 560.0), summary(subject));
  if (!analysis.pairs.empty()) {
    auto const& nearest = analysis.pairs.front();
    drawing.add(R"(<text x="{}" y="34" text-anchor="end">closest approach {} · {} and {} at {}</text>)", right,
                length_text(nearest.approach.distance_m), record.vehicles[nearest.first].name,
                record.vehicles[nearest.second].name, clock_text(nearest.approach.time));
  }
  if (fence.zones.empty()) return;
  auto const count = analysis.breaches.size();
  drawing.add(R"(<text x="{}" y="56" text-anchor="end" class="{}">{}</text>)", right, count == 0 ? "" : "alarm",
              count == 0 ? "fence kept" : fmt::format("{} fence breach{}", count, count == 1 ? "" : "es"));
}

}  // namespace

std::string to_svg(FlightRecord const& record, Analysis const& analysis, plan::Fence const& fence) {
  Subject const subject{record, analysis, fence};
  double const inner = width - 2.0 * margin;
  Box const map{{margin, head_height}, inner, std::round(std::clamp(inner * map_shape(subject), 260.0, 640.0))};
  Box const lanes{{margin, map.bottom() + 18.0}, inner, time_line_height(subject)};
  double const height = std::round(lanes.bottom() + 34.0);

  Drawing drawing;
  drawing.add(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" role="img">)"
              "\n<title>Dry run of {2}: {3}</title>",
              width, height, record.script, summary(subject));
  drawing.add_whole(style);
  drawing.add(R"(<rect width="{}" height="{}" class="ground"/>)", width, height);
  draw_head(drawing, subject);
  draw_map(drawing, subject, map);
  draw_time_line(drawing, subject, lanes);
  drawing.add(
      R"(<text x="{}" y="{}" class="soft tiny">simulated by Lapwing on level ground at {} m, home {}, {}, seed {}</text>)",
      margin, height - 12.0, number_text(record.home.alt_m, 0),
      fmt::format("{:.6f}, {:.6f}", record.home.lat_deg(), record.home.lon_deg()),
      wind_text(record.wind_m_s, record.gust_m_s), record.seed);
  drawing.add("</svg>");
  return drawing.take();
}

}  // namespace lapwing::dryrun
