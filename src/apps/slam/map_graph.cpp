#include "apps/slam/map_graph.hpp"

#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/files/replace_file.hpp"
#include "base/text/json.hpp"
#include "slam/graph/chordal.hpp"
#include "slam/graph/g2o.hpp"
#include "slam/graph/pose_graph.hpp"

namespace lapwing::apps {

bool is_pose_graph(std::string_view text) {
  constexpr std::size_t head = 4096;
  auto const begin = text.substr(0, head);
  return begin.starts_with("VERTEX_") || begin.starts_with("EDGE_") || begin.contains("\nVERTEX_") ||
         begin.contains("\nEDGE_");
}

base::Result<> settle_graph(std::string_view text, std::filesystem::path const& out) {
  auto const started = std::chrono::steady_clock::now();
  auto const graph = slam::read_g2o(text);
  if (!graph) return std::unexpected(graph.error());
  auto const given = slam::squared_error(graph->constraints, graph->poses);
  auto result = slam::optimize(graph->poses, graph->constraints);
  auto const from_given = result.squared_error;
  auto other = slam::optimize(slam::chordal_poses(graph->poses.size(), graph->poses.front(), graph->constraints),
                              graph->constraints);
  // Not a number: constraints that do not join all poses.
  if (std::isfinite(other.squared_error) && !(result.squared_error <= other.squared_error)) result = std::move(other);
  auto const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  nlohmann::ordered_json const report{{"poses", graph->poses.size()},
                                      {"constraints", graph->constraints.size()},
                                      {"squared_error_given", given},
                                      {"squared_error_from_given", from_given},
                                      {"squared_error", result.squared_error},
                                      {"rounds", result.rounds},
                                      {"wall_s", seconds}};
  if (auto done = base::replace_file(out / "graph.g2o", slam::write_g2o(result.poses, graph->constraints)); !done)
    return done;
  if (auto done = base::replace_file(out / "report.json", base::to_text(report, 2) + "\n"); !done) return done;
  fmt::print("{} poses, {} constraints: squared error {:.6g}, was {:.6g}; {} rounds, {:.2f} s\n", graph->poses.size(),
             graph->constraints.size(), result.squared_error, given, result.rounds, seconds);
  return {};
}

}  // namespace lapwing::apps
