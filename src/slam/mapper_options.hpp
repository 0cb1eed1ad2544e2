#pragma once

#include "slam/front_end.hpp"
#include "slam/loops/loop_options.hpp"
#include "slam/prune/prune_options.hpp"
#include "slam/refine/fill.hpp"
#include "slam/refine/joint.hpp"
#include "slam/scan/gather.hpp"

namespace lapwing::slam {

struct MapperOptions {
  FrameOptions frame;
  FrontEndOptions front_end;
  LoopOptions loops;
  PruneOptions prune;
  JointOptions joint;
  FillOptions fill;
  GatherOptions gather;
};

}  // namespace lapwing::slam
