#include "slam/graph/g2o.hpp"

#include <iterator>
#include <map>

#include "slam/readers/text_lines.hpp"

namespace lapwing::slam {
namespace {

constexpr std::size_t most_lines = 10'000'000;

struct Edge {
  std::int64_t from;
  std::int64_t to;
  Pose2 motion;
  Eigen::Matrix3d information;
  std::size_t line;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : lines_(text) {}

  base::Result<PoseGraph> run() {
    while (auto const line = lines_.next()) {
      if (lines_.number() > most_lines) return fail_at(lines_.number(), "too many lines");
      Words words(*line);
      auto const kind = words.next();
      if (kind.empty() || kind.starts_with('#') || kind == "FIX") continue;
      base::Result<> done =
          fail_at(lines_.number(), fmt::format("'{}' is no pose or edge of the plane", kind.substr(0, 40)),
                  "VERTEX_SE2 and EDGE_SE2 are read");
      if (kind == "VERTEX_SE2") done = vertex(words);
      if (kind == "EDGE_SE2") done = edge(words);
      if (!done) return std::unexpected(done.error());
    }
    return connected();
  }

 private:
  [[nodiscard]] base::Result<std::vector<double>> numbers(Words& words, int count) const {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
      auto const value = words.finite();
      if (!value) return fail_at(lines_.number(), fmt::format("expected {} numbers", count));
      values.push_back(*value);
    }
    return values;
  }
  [[nodiscard]] static bool is_number(double id) { return id >= 0.0 && id < 1e15 && id == std::floor(id); }

  base::Result<> vertex(Words& words) {
    auto const v = numbers(words, 4);
    if (!v) return std::unexpected(v.error());
    if (!is_number((*v)[0])) return fail_at(lines_.number(), "a pose's number must be whole and not negative");
    poses_[static_cast<std::int64_t>((*v)[0])] = {(*v)[1], (*v)[2], (*v)[3]};
    return {};
  }

  base::Result<> edge(Words& words) {
    auto const read = numbers(words, 11);
    if (!read) return std::unexpected(read.error());
    auto const& v = *read;
    if (!is_number(v[0]) || !is_number(v[1]))
      return fail_at(lines_.number(), "a pose's number must be whole and not negative");
    if (v[0] == v[1]) return fail_at(lines_.number(), "an edge from a pose to itself");
    Edge edge{
        static_cast<std::int64_t>(v[0]), static_cast<std::int64_t>(v[1]), {v[2], v[3], v[4]}, {}, lines_.number()};
    edge.information << v[5], v[6], v[7], v[6], v[8], v[9], v[7], v[9], v[10];
    edges_.push_back(edge);
    return {};
  }

  /// Where a file names no pose, those that its edges name are, each where the edge that names it first puts it.
  void pose_by_edges() {
    if (!poses_.empty()) return;
    for (auto const& edge : edges_) {
      auto const from = poses_.try_emplace(edge.from, Pose2{}).first->second;
      poses_.try_emplace(edge.to, from * edge.motion);
    }
  }

  base::Result<PoseGraph> connected() {
    pose_by_edges();
    PoseGraph graph;
    std::map<std::int64_t, int> place_of;
    for (auto const& [id, pose] : poses_) {
      place_of[id] = static_cast<int>(graph.poses.size());
      graph.poses.push_back(pose);
    }
    for (auto const& edge : edges_) {
      auto const from = place_of.find(edge.from);
      auto const to = place_of.find(edge.to);
      if (from == place_of.end() || to == place_of.end())
        return fail_at(edge.line, fmt::format("there is no pose {}", from == place_of.end() ? edge.from : edge.to));
      graph.constraints.push_back({.from = from->second,
                                   .to = to->second,
                                   .from_to = edge.motion,
                                   .information = edge.information,
                                   .is_loop = std::abs(edge.from - edge.to) != 1});
    }
    if (graph.poses.empty()) return base::fail(base::ErrorKind::invalid_input, "no VERTEX_SE2 or EDGE_SE2");
    return graph;
  }

  Lines lines_;
  std::map<std::int64_t, Pose2> poses_;
  std::vector<Edge> edges_;
};

}  // namespace

base::Result<PoseGraph> read_g2o(std::string_view text) {
  return Reader(text).run();
}

std::string write_g2o(std::vector<Pose2> const& poses, std::vector<Constraint> const& constraints) {
  std::string text;
  auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < poses.size(); ++k)
    fmt::format_to(out, "VERTEX_SE2 {} {} {} {}\n", k, poses[k].x, poses[k].y, poses[k].yaw);
  for (auto const& c : constraints) {
    auto const& i = c.information;
    fmt::format_to(out, "EDGE_SE2 {} {} {} {} {} {} {} {} {} {} {}\n", c.from, c.to, c.from_to.x, c.from_to.y,
                   c.from_to.yaw, i(0, 0), i(0, 1), i(0, 2), i(1, 1), i(1, 2), i(2, 2));
  }
  return text;
}

}  // namespace lapwing::slam
