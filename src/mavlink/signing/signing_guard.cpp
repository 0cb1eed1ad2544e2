#include "mavlink/signing/signing_guard.hpp"

#include <algorithm>
#include <utility>

#include "link/url.hpp"

namespace lapwing::mavlink {

namespace {

constexpr std::uint32_t radio_status = 109;
constexpr SigningTime minute = 6'000'000;

}  // namespace

KeyRing::Vehicles& vehicles_of(KeyRing& ring, std::string const& network) {
  return network.empty() ? ring.vehicles : ring.networks[network];
}

KeyRing ring_of_network(KeyRing ring, std::string const& network) {
  if (!network.empty()) ring.vehicles = std::move(ring.networks[network]);
  ring.networks.clear();
  return ring;
}

KeyRing ring_of(SigningKey const& key) {
  return {
      .keys = {{"key", key}}, .vehicles = {}, .networks = {}, .links = {}, .everybody = {"key"}, .unsigned_frames = {}};
}

std::optional<KeyRing> ring_of(std::optional<SigningKey> const& key) {
  return key ? std::optional(ring_of(*key)) : std::nullopt;
}

std::optional<SigningKey> key_for(KeyRing const& ring, std::uint8_t system_id) {
  auto const own = ring.vehicles.find(system_id);
  auto const& use = own != ring.vehicles.end() ? own->second : ring.everybody;
  if (use.empty()) return std::nullopt;
  auto const key = ring.keys.find(use.front());
  return key != ring.keys.end() ? std::optional(key->second) : std::nullopt;
}

bool is_local(std::string const& url) {
  auto const parsed = link::parse_url(url);
  if (!parsed) return false;
  if (parsed->transport == link::Transport::serial) return true;
  auto const& host = parsed->host;
  return host.starts_with("127.") || host == "localhost" || host == "::1" || host == "[::1]";
}

void SigningGuard::name_link(std::size_t number, std::string const& url) {
  links_[number] = {url, mavlink::is_local(url)};
}

KeyRing::Use const& SigningGuard::use_for(std::uint8_t system_id, std::size_t link) const {
  if (auto const own = ring_.vehicles.find(system_id); own != ring_.vehicles.end()) return own->second;
  if (auto const named = links_.find(link); named != links_.end()) {
    if (auto const of_link = ring_.links.find(named->second.url); of_link != ring_.links.end()) return of_link->second;
  }
  return ring_.everybody;
}

void SigningGuard::sign(Frame& frame, Peer to, std::uint8_t system_id, base::UtcTime now) {
  if (frame.version == 1) return;
  if (system_id == 0) {
    auto const there = systems_at_.find(to);
    if (there != systems_at_.end() && there->second.size() == 1) system_id = *there->second.begin();
  }
  auto const& use = use_for(system_id, to.link);
  if (use.empty()) return;
  auto const* last_used = last_key_of(system_id);
  bool const follows = last_used && std::ranges::find(use, *last_used) != use.end();
  auto const key = ring_.keys.find(follows ? *last_used : use.front());
  if (key == ring_.keys.end()) return;
  last_ = std::max(last_ + 1, signing_time(now));
  mavlink::sign(frame, key->second, static_cast<std::uint8_t>(to.link), last_);
}

/// The autopilot's; of a system that has none, that of the first of its components. Null: nothing of it was heard.
std::string const* SigningGuard::last_key_of(std::uint8_t system_id) const {
  auto found = key_of_.find({system_id, autopilot_component});
  if (found == key_of_.end()) found = key_of_.lower_bound({system_id, 0});
  return found != key_of_.end() && found->first.system == system_id ? &found->second : nullptr;
}

/// The name of the key, of those that hold for the sender; null when it is none of them.
std::string const* SigningGuard::signed_by(Frame const& frame, std::size_t link) const {
  for (auto const& name : use_for(frame.source.system, link)) {
    auto const key = ring_.keys.find(name);
    if (key != ring_.keys.end() && is_signed_with(frame, key->second)) return &key->first;
  }
  return nullptr;
}

bool SigningGuard::may_be_unsigned(Frame const& frame, std::size_t link) const {
  auto const& allowed = ring_.unsigned_frames;
  if (allowed.messages.contains(frame.message_id) || allowed.systems.contains(frame.source.system)) return true;
  auto const named = links_.find(link);
  return allowed.local_links && named != links_.end() && named->second.is_local;
}

bool SigningGuard::is_late(Frame const& frame, base::UtcTime now) {
  auto const time = time_of_signature(frame);
  Sender const sender{frame.source, frame.signature[0]};
  auto const known = heard_.find(sender);
  auto const ours = std::max(last_, signing_time(now));
  if (known == heard_.end() ? time + minute < ours : time <= known->second) return true;
  heard_[sender] = time;
  last_ = std::max(last_, time);
  return false;
}

bool SigningGuard::accepts(Frame const& frame, Peer from, base::UtcTime now) {
  if (!frame.is_signed() && frame.message_id == radio_status) return true;
  if (!frame.is_signed()) {
    if (!may_be_unsigned(frame, from.link)) {
      ++counters_.unsigned_frames;
      return false;
    }
    key_of_[frame.source] = {};
  } else {
    auto const* name = signed_by(frame, from.link);
    if (!name || is_late(frame, now)) {
      ++(name ? counters_.replayed : counters_.wrong_key);
      return false;
    }
    key_of_[frame.source] = *name;
    ++counters_.accepted;
  }
  systems_at_[from].insert(frame.source.system);
  return true;
}

std::optional<std::string> SigningGuard::key_of(Address source) const {
  auto const known = key_of_.find(source);
  return known != key_of_.end() ? std::optional(known->second) : std::nullopt;
}

}  // namespace lapwing::mavlink
