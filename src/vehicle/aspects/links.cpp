#include "vehicle/aspects/links.hpp"

namespace lapwing::vehicle {

std::string_view to_string(Connection connection) {
  switch (connection) {
    case Connection::ok: return "ok";
    case Connection::lost: return "lost";
    case Connection::conflict: return "conflict";
  }
  return "lost";
}

}  // namespace lapwing::vehicle
