#include "autonomy/interface/state.hpp"

namespace lapwing::autonomy {

std::string_view to_string(State state) {
  using enum State;
  switch (state) {
    case idle: return "Idle";
    case configure: return "Configure";
    case arm: return "Arm";
    case takeoff: return "Takeoff";
    case hover: return "Hover";
    case autonomous_explore: return "AutonomousExplore";
    case autonomous_move: return "AutonomousMove";
    case compulsive_move: return "CompulsiveMove";
    case desired_location_error: return "DesiredLocationError";
    case no_parking_lot_detected: return "NoParkingLotDetected";
    case land: return "Land";
    case State::communication_lost: return "CommunicationLost";
    case malfunction: break;
  }
  return "Malfunction";
}

std::string_view to_string(UserError error) {
  using enum UserError;
  switch (error) {
    case none: return "None";
    case desired_location_out_of_bounds: return "Desired_Location_Out_Of_Bounds";
    case no_lot_detected: return "No_Lot_Detected";
    case height_params_invalid: break;
  }
  return "Height_Params_Invalid";
}

}  // namespace lapwing::autonomy
