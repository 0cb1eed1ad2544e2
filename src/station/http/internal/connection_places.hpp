#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace lapwing::station::internal {

/// Who may stay connected to a server that has room for so many. Somebody new always finds a place as long as one is
/// held by who does nothing: whoever has a request to send, above all for an emergency stop, is never kept out by
/// those that only sit there.
///
/// Who goes: of strangers the one that is so for longest, of the address that has the most of them, so that a crowd
/// from elsewhere pushes out none but its own; when there are none, of those who rest likewise. Newcomers go only after
/// all strangers of their address: between a client's connecting and its first byte a busy machine may let many others
/// in. Who is being served never goes. Pure: knows neither sockets nor time.
class Places {
 public:
  struct Limits {
    std::size_t all = 0;
    std::size_t strangers_per_address = 0;  ///< newcomers among them
  };
  enum class Guest : std::uint64_t {};
  enum class Standing {
    newcomer,  ///< has said nothing yet
    stranger,  ///< has said something, but has not shown that it may ask for anything
    resting,   ///< has, and asks for nothing just now
    served,    ///< its request is being answered, or it watches over a WebSocket
  };

  explicit Places(Limits limits) : limits_(limits) {}

  struct Entrance {
    std::optional<Guest> guest;       ///< who came in; nothing when all places are taken by those who are served
    std::optional<Guest> must_leave;  ///< whose place it is; gone from here already
  };
  [[nodiscard]] Entrance enter(std::string address);
  /// A guest that is gone already is ignored.
  void set(Guest guest, Standing standing);
  void leave(Guest guest);
  [[nodiscard]] std::size_t size() const { return places_.size(); }

 private:
  struct Place {
    std::string address;
    Standing standing = Standing::newcomer;
    std::uint64_t since = 0;  ///< when it took this standing, counted in changes
  };
  [[nodiscard]] std::size_t count(Standing standing, std::string const& address) const;
  [[nodiscard]] std::optional<Guest> first(Standing standing, std::string const& address) const;
  [[nodiscard]] std::optional<Guest> first_of_the_largest_crowd(Standing standing) const;

  Limits limits_;
  std::map<Guest, Place> places_;
  std::map<std::pair<Standing, std::string>, std::size_t> counts_;  // newcomers as strangers
  std::uint64_t changes_ = 0;
};

}  // namespace lapwing::station::internal
