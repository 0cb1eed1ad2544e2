#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "slam/key_frame.hpp"

/// Pose graphs as text in the format of g2o: VERTEX_SE2 and EDGE_SE2 (Kuemmerle et al. 2011, g2o).
namespace lapwing::slam {

struct PoseGraph {
  std::vector<Pose2> poses;
  std::vector<Constraint> constraints;  ///< between neighbours, or else loops
};

/// Numbers of the file may have gaps; here they are counted in the order of the numbers. Lines of other kinds than
/// SE2 are refused, FIX is passed over; where there is no VERTEX at all, the edges name the poses. Errors:
/// invalid_input, with the line.
[[nodiscard]] base::Result<PoseGraph> read_g2o(std::string_view text);
[[nodiscard]] std::string write_g2o(std::vector<Pose2> const& poses, std::vector<Constraint> const& constraints);

}  // namespace lapwing::slam
