#pragma once

#include <string>

#include "mavlink/connection/connection.hpp"

namespace lapwing::mavlink {

struct SigningSetupOptions {
  int tries = 10;
  /// For the vehicle's next heartbeat.
  base::Duration wait = std::chrono::milliseconds(1500);
};

/// Tells the vehicle the key of this name of the connection's ring, until it signs with it. Whoever listens to the link
/// learns the key. The ring must name the key for this vehicle, and hear it as it is now (unsigned, or with its old
/// key): the vehicle changes over in an instant. Errors: timed_out (it does not sign with it: ArduPilot takes no key
/// while armed), invalid_input (no such key), those of Connection::send.
base::Task<base::Result<>> give_key(Connection& connection, Address target, std::string name,
                                    SigningSetupOptions options = {});

/// Switches signing off on the vehicle: it is told a key of zeros until it signs nothing any more, which the ring must
/// let it. Errors: as of `give_key`.
base::Task<base::Result<>> take_key_away(Connection& connection, Address target, SigningSetupOptions options = {});

}  // namespace lapwing::mavlink
