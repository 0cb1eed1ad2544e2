#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/loop.hpp"
#include "base/error.hpp"
#include "station/feeds/feed.hpp"
#include "station/http/http_server.hpp"
#include "station/messages/client_request.hpp"
#include "station/messages/messages.hpp"

namespace lapwing::station {

/// Who watches, what of each feed each of them has, and that it is sent what it lacks.
///
/// A viewer that is too slow for a feed misses it for a while and is then told what leads from what it has to the
/// present, of that feed alone: a bad network shows old data for a while, but never wrong data.
class Viewers {
 public:
  /// All viewers are sent the `usual` feeds, until they subscribe to others; the `further` ones only those who do. The
  /// server outlives the viewers.
  Viewers(base::Loop& loop, HttpServer& server, std::vector<std::unique_ptr<Feed>> usual,
          std::vector<std::unique_ptr<Feed>> further);

  [[nodiscard]] std::size_t size() const { return viewers_.size(); }
  /// What a viewer may subscribe to, for `hello`.
  [[nodiscard]] FeedList feeds() const;
  /// All of them, for whoever keeps what is shown; they live as long as this.
  [[nodiscard]] std::vector<Feed*> all_feeds() const;
  /// Of this run of the station, by which its revisions, and what is kept of it, are known.
  [[nodiscard]] std::string const& run() const { return run_; }

  /// Sends it the usual feeds; one that waits gets nothing before it has subscribed.
  void open(SessionId session, bool waits);
  void close(SessionId session) { viewers_.erase(session); }
  /// From now on exactly these feeds. Those that it has not had so far begin with what leads from the revisions that it
  /// names, if they are of this run. Error: invalid_input for a feed that there is not; then all stays as it was.
  [[nodiscard]] base::Result<> subscribe(SessionId session, Subscribe const& wanted);
  /// To one that waited and has subscribed. Others get theirs with the next news: who subscribes again and again costs
  /// no more than who watches.
  void begin(SessionId session);

  /// To everybody what he lacks and has room for; only of feeds whose names begin so.
  void send_news(std::string_view group = {});
  /// The network has taken all that waited: what had no room may follow.
  void go_on(SessionId session);

 private:
  struct Channel {
    std::unique_ptr<Feed> feed;
    std::uint16_t id = 0;  ///< also the lane
    bool is_usual = false;
    std::uint64_t revision = 0;  ///< that `refresh` gave last
  };
  struct Standing {
    std::uint64_t revision = 0;  ///< what the viewer has, or will have when its backlog is gone
    bool is_cut = false;         ///< there was no room for all of it
  };
  struct Viewer {
    std::map<std::uint16_t, Standing> feeds;  ///< by id, those to which it has subscribed
    bool waits = false;                       ///< for its subscription, or for what it gets first
  };
  struct Round;

  [[nodiscard]] Channel const* find(std::string_view name) const;
  [[nodiscard]] bool is_watched(Channel const& channel) const;
  void refresh(Channel& channel, base::TimePoint now);
  void serve(SessionId session, Standing& standing, Channel const& channel, Round& round);
  void serve_at_once(SessionId session, Viewer& viewer);

  base::Loop& loop_;
  HttpServer& server_;
  std::vector<Channel> channels_;  ///< in the order of their ids, which begin with 1
  std::string run_;                ///< tells the revisions of this process from those of the one before it
  std::map<SessionId, Viewer> viewers_;
};

}  // namespace lapwing::station
