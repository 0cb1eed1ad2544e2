// The survey of simulated car parks: our planner beside lawn-mowers of the same drone and camera. Prints a row each;
// the percentages are beside a lawn-mower at the desired height with a sidelap of 0.3, or beside the planner as it is.
//
//   bench_survey [SEEDS] [sensitivity]
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "explore/run/survey_run.hpp"

namespace {

using namespace lapwing::explore;

/// 1280 by 720 pixels and 62 degrees across, as small drones have them.
SurveyRunSettings standard() {
  SurveyRunSettings settings;
  constexpr double across_rad = 1.08;
  settings.survey.camera = lapwing::geo::pinhole(1280, 720, across_rad);
  return settings;
}

struct Row {
  double to_90_s = 0.0;
  double took_s = 0.0;
  double coverage = 0.0;
  double least_coverage = 1.0;
  double right = 0.0;
  double found = 0.0;
  double information = 0.0;
  double off_m = 0.0;
  double flown_m = 0.0;
  std::size_t wrong = 0;
  std::size_t reached = 0;
  std::size_t runs = 0;
};

/// A run that never had 90 % counts with all its time.
void add(Row& row, SurveyReport const& report) {
  row.to_90_s += report.to_90_s.value_or(report.took_s);
  row.took_s += report.took_s;
  row.coverage += report.coverage;
  row.least_coverage = std::min(row.least_coverage, report.coverage);
  row.right += report.occupancy_right;
  row.found += report.slots_found;
  row.information += report.information;
  row.off_m += report.off_m;
  row.flown_m += report.flown_m;
  row.wrong += report.wrong_slots;
  row.reached += report.to_90_s ? 1 : 0;
  ++row.runs;
}

using Fly = std::function<lapwing::base::Result<SurveyReport>(CarPark const&)>;

Row over_seeds(int seeds, DetectorFaults const& faults, Fly const& fly) {
  Row row;
  for (int seed = 1; seed <= seeds; ++seed) {
    CarPark const park(static_cast<std::uint64_t>(seed), faults);
    auto const report = fly(park);
    if (!report) {
      std::fprintf(stderr, "seed %d: %s\n", seed, report.error().message.c_str());
      std::exit(1);
    }
    add(row, *report);
  }
  return row;
}

void print(std::string const& name, Row const& row, Row const& base) {
  auto const n = static_cast<double>(row.runs);
  std::printf(
      "%-34s %6.0f s (%+4.0f %%) %2zu/%zu %6.0f s (%+4.0f %%)  info %.3f  coverage %.3f (least %.3f)  slots %.3f wrong "
      "%.1f off %.2f m  right %.4f  %5.0f m\n",
      name.c_str(), row.to_90_s / n, 100.0 * (row.to_90_s / base.to_90_s - 1.0), row.reached, row.runs, row.took_s / n,
      100.0 * (row.took_s / base.took_s - 1.0), row.information / n, row.coverage / n, row.least_coverage,
      row.found / n, static_cast<double>(row.wrong) / n, row.off_m / n, row.right / n, row.flown_m / n);
  std::fflush(stdout);
}

void compare(int seeds) {
  auto const settings = standard();
  auto const mow = [&](LawnMower mower) {
    return over_seeds(seeds, {}, [&](CarPark const& park) { return fly_lawn_mower(park, settings, mower); });
  };
  auto const base = mow({.height_m = settings.survey.desired_m, .sidelap = 0.3});
  std::printf("%-34s %8s %18s\n", "", "to 90 %", "in all");
  print("planner", over_seeds(seeds, {}, [&](CarPark const& park) { return fly_survey(park, settings); }), base);
  // As a drone with plain GPS has it.
  DetectorFaults loose;
  loose.camera_off_m = 1.0;
  print("planner, places off by 1 m",
        over_seeds(seeds, loose, [&](CarPark const& park) { return fly_survey(park, settings); }), base);
  for (double const height_m : {settings.survey.desired_m, settings.survey.highest_m}) {
    for (double const sidelap : {0.22, 0.3, 0.5, 0.7}) {
      char name[64];
      std::snprintf(name, sizeof name, "lawn-mower, %.0f m, sidelap %.2f", height_m, sidelap);
      print(name, mow({.height_m = height_m, .sidelap = sidelap}), base);
    }
  }
}

struct Knob {
  char const* name;
  std::function<void(SurveyRunSettings&, DetectorFaults&, double)> turn;
};

std::vector<Knob> knobs() {
  using S = SurveyRunSettings&;
  using F = DetectorFaults&;
  return {{"row_share", [](S s, F, double k) { s.survey.row_share *= k; }},
          {"least_bits", [](S s, F, double k) { s.survey.least_bits *= k; }},
          {"least_bits_a_s", [](S s, F, double k) { s.survey.least_bits_a_s *= k; }},
          {"slot_error (planner's)", [](S s, F, double k) { s.survey.errors.slot_error *= k; }},
          {"cell_error (planner's)", [](S s, F, double k) { s.survey.errors.cell_error *= k; }},
          {"step_m", [](S s, F, double k) { s.survey.step_m *= k; }},
          {"edge_m", [](S s, F, double k) { s.lot.edge_m *= k; }},
          {"independence.apart_m", [](S s, F, double k) { s.lot.independence.apart_m *= k; }},
          {"found_share's misses", [](S s, F, double k) { s.lot.found_share = 1.0 - k * (1.0 - s.lot.found_share); }},
          {"false_share", [](S s, F, double k) { s.lot.false_share *= k; }},
          {"slot_prior", [](S s, F, double k) { s.lot.slot_prior *= k; }},
          {"turnover.memory",
           [](S s, F, double k) {
             s.lot.turnover.memory = lapwing::base::from_seconds(k * lapwing::base::to_seconds(s.lot.turnover.memory));
           }},
          {"picture_s", [](S s, F, double k) { s.picture_s *= k; }},
          {"true errors of the detector",
           [](S, F f, double k) {
             f.wrong_share *= k;
             f.missed_share *= k;
           }},
          {"true error of the camera's place", [](S, F f, double k) { f.camera_off_m *= k; }}};
}

void sensitivity(int seeds) {
  auto const base = over_seeds(seeds, {}, [&](CarPark const& park) { return fly_survey(park, standard()); });
  print("as it is", base, base);
  for (auto const& knob : knobs()) {
    for (double const factor : {0.7, 1.3}) {
      auto settings = standard();
      DetectorFaults faults;
      knob.turn(settings, faults, factor);
      char name[64];
      std::snprintf(name, sizeof name, "%s x %.1f", knob.name, factor);
      print(name, over_seeds(seeds, faults, [&](CarPark const& park) { return fly_survey(park, settings); }), base);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  int const seeds = argc > 1 ? std::atoi(argv[1]) : 20;
  if (seeds < 1) {
    std::fputs("usage: bench_survey [SEEDS] [sensitivity]\n", stderr);
    return 2;
  }
  if (argc > 2 && std::string_view(argv[2]) == "sensitivity")
    sensitivity(seeds);
  else
    compare(seeds);
}
