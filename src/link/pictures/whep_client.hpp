#pragma once

#include <string>

#include "base/async/loop.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "link/pictures/picture.hpp"
#include "link/pictures/picture_client.hpp"

namespace lapwing::link::pictures {

struct VideoSession {
  std::string answer = {};   ///< SDP
  std::string session = {};  ///< its name at the drone
};

/// Offers a viewer to a drone (WHEP). Errors: refused: the drone says no, in its own words; lost (FailedToSend): it is
/// not reached, or what answers there is something else.
[[nodiscard]] base::Task<base::Result<VideoSession>> begin_video(base::Loop& loop, Source source, View view,
                                                                 std::string offer);

/// Ends such a session. Errors: as above.
[[nodiscard]] base::Task<base::Result<>> end_video(base::Loop& loop, Source source, std::string session);

}  // namespace lapwing::link::pictures
