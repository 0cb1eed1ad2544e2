#include "link/operator_link/message.hpp"

namespace lapwing::link::operator_link {

std::string_view to_string(Kind kind) {
  switch (kind) {
    case Kind::durable: return "durable";
    case Kind::command: return "command";
    case Kind::latest: return "latest";
  }
  return "unknown";
}

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::taken: return "taken";
    case Outcome::overtaken: return "overtaken";
    case Outcome::expired: return "expired";
    case Outcome::unknown: return "unknown";
  }
  return "unknown";
}

}  // namespace lapwing::link::operator_link
