#pragma once

#include "map/features/contents.hpp"

namespace lapwing::map::internal {

/// With at most `most_track_samples`: as long as there are more, only the first in each span of time and the last of
/// all are kept, the spans being an eighth of a second and doubling. Spans are cut at the same moments for all, and
/// what falls away at one length is not missed at the next, so that it does not matter in what order tracks are joined
/// and thinned.
void thin(Track& track);

/// Adds those of another, of which the coarser of both is thinned. Of two samples of one moment the same is kept,
/// whichever track it is in.
void take_samples(Track& track, Track const& other);

}  // namespace lapwing::map::internal
