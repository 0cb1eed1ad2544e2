#pragma once

#include <vector>

#include "base/log.hpp"
#include "station/http/router.hpp"
#include "video/webrtc/webrtc_server.hpp"

namespace lapwing::apps {

/// WHEP (draft-ietf-wish-whep): a viewer POSTs its offer to `/api/v1/whep/VIEW`, is answered with this end's and the
/// address of its session, and DELETEs that when it has seen enough. `views` are their names by their numbers. All of
/// it outlives the routes.
[[nodiscard]] station::Router whep_routes(video::WebRtcServer& server, std::vector<std::string> const& views,
                                          base::Logger const& log);

}  // namespace lapwing::apps
