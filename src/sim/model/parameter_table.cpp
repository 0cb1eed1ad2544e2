#include "sim/model/parameter_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <span>

#include <fmt/core.h>

namespace lapwing::sim {

namespace {

using enum mavlink::MavParamType;
struct Default {
  std::string_view name;
  float value;
  mavlink::MavParamType type = real32;
};

constexpr Default common[] = {
    {"AHRS_EKF_TYPE", 3, int8},      {"ARMING_CHECK", 1, int32},    {"ARMING_REQUIRE", 1, int8},
    {"BARO1_GND_PRESS", 100250.0F},  {"BATT_ARM_MAH", 0, int32},    {"BATT_ARM_VOLT", 0},
    {"BATT_CAPACITY", 3300, int32},  {"BATT_CRT_MAH", 0},           {"BATT_CRT_VOLT", 0},
    {"BATT_FS_CRT_ACT", 0, int8},    {"BATT_FS_LOW_ACT", 0, int8},  {"BATT_LOW_MAH", 0},
    {"BATT_LOW_TIMER", 10, int8},    {"BATT_LOW_VOLT", 10.5F},      {"BATT_MONITOR", 4, int8},
    {"CAM1_TYPE", 1, int8},          {"MNT1_TYPE", 1, int8},        {"BRD_SAFETY_DEFLT", 0, int8},
    {"COMPASS_ENABLE", 1, int8},     {"COMPASS_USE", 1, int8},      {"EK3_ENABLE", 1, int8},
    {"FENCE_ACTION", 1, int8},       {"FENCE_ALT_MAX", 100},        {"FENCE_ALT_MIN", -10},
    {"FENCE_ENABLE", 0, int8},       {"FENCE_MARGIN", 2},           {"FENCE_RADIUS", 300},
    {"FENCE_TOTAL", 0, int8},        {"GPS_TYPE", 1, int8},         {"LOG_BACKEND_TYPE", 1, int8},
    {"LOG_BITMASK", 176126, int32},  {"LOG_DISARMED", 0, int8},     {"MIS_OPTIONS", 0, int16},
    {"MIS_RESTART", 0, int8},        {"MIS_TOTAL", 0, int16},       {"RALLY_TOTAL", 0, int8},
    {"SCHED_LOOP_RATE", 400, int16}, {"SERIAL0_PROTOCOL", 2, int8}, {"SIM_GPS_DISABLE", 0, int8},
    {"SIM_RC_FAIL", 0, int8},        {"SR0_EXTRA1", 0, int16},      {"SR0_EXTRA2", 0, int16},
    {"SR0_EXTRA3", 0, int16},        {"SR0_EXT_STAT", 0, int16},    {"SR0_POSITION", 0, int16},
    {"SR0_RAW_SENS", 0, int16},      {"SR0_RC_CHAN", 0, int16},     {"STAT_BOOTCNT", 1, int16},
    {"STAT_FLTTIME", 0, int32},      {"STAT_RUNTIME", 0, int32},    {"SYSID_ENFORCE", 0, int8},
    {"SYSID_MYGCS", 255, int16},     {"SYSID_THISMAV", 1, int16},
};

constexpr Default copter[] = {
    {"AUTO_OPTIONS", 0, int32},     {"DISARM_DELAY", 10, int8},
    {"FRAME_CLASS", 1, int8},       {"FRAME_TYPE", 0, int8},
    {"FS_CRASH_CHECK", 1, int8},    {"FS_DR_ENABLE", 2, int8},
    {"FS_DR_TIMEOUT", 30, int16},   {"FS_OPTIONS", 16, int32},
    {"FS_THR_VALUE", 975, int16},   {"FS_VIBE_ENABLE", 1, int8},
    {"FS_EKF_ACTION", 1, int8},     {"FS_EKF_THRESH", 0.8F},
    {"FS_GCS_ENABLE", 0, int8},     {"FS_GCS_TIMEOUT", 5},
    {"FS_THR_ENABLE", 1, int8},     {"GUID_TIMEOUT", 3},
    {"LAND_ALT_LOW", 1000, int16},  {"LAND_SPEED", 50, int16},
    {"LAND_SPEED_HIGH", 0, int16},  {"LOIT_SPEED", 1250},
    {"PILOT_SPEED_DN", 0, int16},   {"PILOT_SPEED_UP", 250, int16},
    {"PILOT_TKOFF_ALT", 0},         {"RTL_ALT", 1500, int32},
    {"RTL_ALT_FINAL", 0, int16},    {"RTL_CLIMB_MIN", 0, int16},
    {"RTL_LOIT_TIME", 5000, int32}, {"RTL_SPEED", 0, int16},
    {"WPNAV_ACCEL", 250},           {"WPNAV_ACCEL_Z", 100},
    {"WPNAV_RADIUS", 200},          {"WPNAV_SPEED", 1000},
    {"WPNAV_SPEED_DN", 150},        {"WPNAV_SPEED_UP", 250},
    {"CIRCLE_RADIUS", 1000},        {"RALLY_LIMIT_KM", 0.3F},
    {"RALLY_INCL_HOME", 1, int8},   {"FENCE_TYPE", 7, int8},
    {"SRTL_ACCURACY", 2},           {"SRTL_POINTS", 300, int16},
    {"AVOID_ENABLE", 3, int8},
};

constexpr Default plane[] = {
    {"AIRSPEED_CRUISE", 22},        {"AIRSPEED_MAX", 30, int16},    {"AIRSPEED_MIN", 10, int16},
    {"FS_GCS_ENABL", 0, int8},      {"FS_LONG_ACTN", 0, int8},      {"FS_LONG_TIMEOUT", 5},
    {"LAND_DISARMDELAY", 20, int8}, {"RTL_ALTITUDE", 100},          {"RTL_AUTOLAND", 0, int8},
    {"TECS_CLMB_MAX", 5},           {"TECS_SINK_MAX", 5},           {"TKOFF_ALT", 50},
    {"WP_LOITER_RAD", 60, int16},   {"WP_RADIUS", 50, int16},       {"RTL_RADIUS", 0, int16},
    {"RALLY_LIMIT_KM", 5},          {"RALLY_INCL_HOME", 0, int8},   {"FENCE_TYPE", 4, int8},
    {"THR_FAILSAFE", 1, int8},      {"THR_FS_VALUE", 950, int16},   {"FS_SHORT_ACTN", 0, int8},
    {"FS_SHORT_TIMEOUT", 1.5F},     {"FENCE_OPTIONS", 1, int16},    {"SERVO1_FUNCTION", 4, int16},
    {"SERVO2_FUNCTION", 19, int16}, {"SERVO3_FUNCTION", 70, int16}, {"SERVO4_FUNCTION", 21, int16},
};

constexpr Default rover[] = {
    {"CRUISE_SPEED", 5},
    {"FS_ACTION", 2, int8},
    {"FS_GCS_ENABLE", 0, int8},
    {"FS_GCS_TIMEOUT", 5},
    {"MIS_DONE_BEHAVE", 0, int8},
    {"RTL_SPEED", 0},
    {"TURN_RADIUS", 0.9F},
    {"WP_ACCEL", 0},
    {"WP_RADIUS", 2},
    {"WP_SPEED", 5},
    {"GUID_TIMEOUT", 3},
    {"CIRC_RADIUS", 20},
    {"SERVO1_FUNCTION", 26, int16},
    {"SERVO2_FUNCTION", 0, int16},
    {"SERVO3_FUNCTION", 70, int16},
    {"SERVO4_FUNCTION", 0, int16},
    {"FS_EKF_ACTION", 1, int8},
    {"FS_OPTIONS", 0, int32},
    {"FS_THR_ENABLE", 1, int8},
    {"FS_THR_VALUE", 910, int16},
    {"FS_TIMEOUT", 1.5F},
    {"AVOID_ENABLE", 3, int8},
    {"SRTL_ACCURACY", 2},
    {"SRTL_POINTS", 300, int16},
    {"FENCE_TYPE", 6, int8},
    {"RALLY_LIMIT_KM", 0.5F},
    {"RALLY_INCL_HOME", 1, int8},
};

constexpr Default underwater[] = {
    {"FS_GCS_ENABLE", 0, int8}, {"FS_GCS_TIMEOUT", 5},   {"GUID_TIMEOUT", 3},  {"WPNAV_ACCEL", 50},
    {"WPNAV_ACCEL_Z", 50},      {"WPNAV_RADIUS", 200},   {"WPNAV_SPEED", 150}, {"WPNAV_SPEED_DN", 50},
    {"WPNAV_SPEED_UP", 50},     {"FENCE_TYPE", 6, int8},
};

/// What every board has beside that: sensors and their calibration, servos, receiver, camera. Some of it, and the rest
/// of the failsafes', only to be read and set here.
constexpr Default equipment[] = {
    {"AHRS_TRIM_X", 0},
    {"AHRS_TRIM_Y", 0},
    {"BATT_AMP_OFFSET", 0},
    {"BATT_AMP_PERVLT", 17.0F},
    {"BATT_FS_VOLTSRC", 0, int8},
    {"BATT_OPTIONS", 0, int32},
    {"BATT_SERIAL_NUM", -1, int32},
    {"BATT_VOLT_MULT", 10.1F},
    {"BRD_BOOT_DELAY", 0, int16},
    {"BRD_SERIAL_NUM", 0, int32},
    {"CAM1_DURATION", 0.1F},
    {"CAM1_INTRVAL_MIN", 0},
    {"CAM1_SERVO_OFF", 1100, int16},
    {"CAM1_SERVO_ON", 1300, int16},
    {"CAM1_TRIGG_DIST", 0},
    {"CAM1_TYPE", 0, int8},
    {"CAM_AUTO_ONLY", 0, int8},
    {"CAM_MAX_ROLL", 0, int16},
    {"COMPASS_DEC", 0},
    {"COMPASS_DIA_X", 1},
    {"COMPASS_DIA_Y", 1},
    {"COMPASS_DIA_Z", 1},
    {"COMPASS_OFS_X", 5},
    {"COMPASS_OFS_Y", 13},
    {"COMPASS_OFS_Z", -18},
    {"FENCE_ALT_MIN", -10},
    {"FENCE_AUTOENABLE", 0, int8},
    {"FENCE_OPTIONS", 0, int16},
    {"INS_ACCEL_FILTER", 20, int16},
    {"INS_ACCOFFS_X", 0.001F},
    {"INS_ACCOFFS_Y", 0.001F},
    {"INS_ACCOFFS_Z", 0.001F},
    {"INS_ACCSCAL_X", 1.001F},
    {"INS_ACCSCAL_Y", 1.001F},
    {"INS_ACCSCAL_Z", 1.001F},
    {"INS_GYROFFS_X", 0.0002F},
    {"INS_GYROFFS_Y", -0.0001F},
    {"INS_GYROFFS_Z", 0.0003F},
    {"INS_GYRO_FILTER", 20, int16},
    {"MNT1_DEFLT_MODE", 3, int8},
    {"MNT1_PITCH_MAX", 20, int16},
    {"MNT1_PITCH_MIN", -90, int16},
    {"MNT1_ROLL_MAX", 30, int16},
    {"MNT1_ROLL_MIN", -30, int16},
    {"MNT1_TYPE", 0, int8},
    {"MNT1_YAW_MAX", 180, int16},
    {"MNT1_YAW_MIN", -180, int16},
    {"RALLY_INCL_HOME", 1, int8},
    {"RALLY_LIMIT_KM", 0.3F},
    {"RC_FS_TIMEOUT", 1},
    {"RC_OPTIONS", 32, int32},
    {"RC1_MAX", 2000, int16},
    {"RC1_MIN", 1000, int16},
    {"RC1_TRIM", 1500, int16},
    {"RC2_MAX", 2000, int16},
    {"RC2_MIN", 1000, int16},
    {"RC2_TRIM", 1500, int16},
    {"RC3_MAX", 2000, int16},
    {"RC3_MIN", 1000, int16},
    {"RC3_TRIM", 1500, int16},
    {"RC4_MAX", 2000, int16},
    {"RC4_MIN", 1000, int16},
    {"RC4_TRIM", 1500, int16},
    {"RC5_MAX", 2000, int16},
    {"RC5_MIN", 1000, int16},
    {"RC5_TRIM", 1500, int16},
    {"RC6_MAX", 2000, int16},
    {"RC6_MIN", 1000, int16},
    {"RC6_TRIM", 1500, int16},
    {"RC7_MAX", 2000, int16},
    {"RC7_MIN", 1000, int16},
    {"RC7_TRIM", 1500, int16},
    {"RC8_MAX", 2000, int16},
    {"RC8_MIN", 1000, int16},
    {"RC8_TRIM", 1500, int16},
    {"SERVO1_FUNCTION", 33, int16},
    {"SERVO1_MAX", 1900, int16},
    {"SERVO1_MIN", 1100, int16},
    {"SERVO1_TRIM", 1500, int16},
    {"SERVO2_FUNCTION", 34, int16},
    {"SERVO2_MAX", 1900, int16},
    {"SERVO2_MIN", 1100, int16},
    {"SERVO2_TRIM", 1500, int16},
    {"SERVO3_FUNCTION", 35, int16},
    {"SERVO3_MAX", 1900, int16},
    {"SERVO3_MIN", 1100, int16},
    {"SERVO3_TRIM", 1500, int16},
    {"SERVO4_FUNCTION", 36, int16},
    {"SERVO4_MAX", 1900, int16},
    {"SERVO4_MIN", 1100, int16},
    {"SERVO4_TRIM", 1500, int16},
    {"SERVO5_FUNCTION", 0, int16},
    {"SERVO5_MAX", 1900, int16},
    {"SERVO5_MIN", 1100, int16},
    {"SERVO5_TRIM", 1500, int16},
    {"SERVO6_FUNCTION", 0, int16},
    {"SERVO6_MAX", 1900, int16},
    {"SERVO6_MIN", 1100, int16},
    {"SERVO6_TRIM", 1500, int16},
    {"SERVO7_FUNCTION", 0, int16},
    {"SERVO7_MAX", 1900, int16},
    {"SERVO7_MIN", 1100, int16},
    {"SERVO7_TRIM", 1500, int16},
    {"SERVO8_FUNCTION", 0, int16},
    {"SERVO8_MAX", 1900, int16},
    {"SERVO8_MIN", 1100, int16},
    {"SERVO8_TRIM", 1500, int16},
    {"SR1_EXTRA1", 0, int16},
    {"SR1_EXTRA2", 0, int16},
    {"SR1_EXTRA3", 0, int16},
    {"SR1_EXT_STAT", 0, int16},
    {"SR1_POSITION", 0, int16},
    {"SR1_RAW_SENS", 0, int16},
    {"SR1_RC_CHAN", 0, int16},
    {"TELEM_DELAY", 0, int8},
};

// Of PX4's main branch, its generic copter with what planes and rovers add; whole numbers are int32.
constexpr Default px4[] = {
    {"BAT1_CAPACITY", 5000},      {"BAT1_N_CELLS", 3, int32},    {"BAT_CRIT_THR", 0.07F},
    {"BAT_EMERGEN_THR", 0.05F},   {"BAT_LOW_THR", 0.15F},        {"CAL_ACC0_ID", 1310988, int32},
    {"COM_ARM_WO_GPS", 1, int32}, {"COM_DISARM_LAND", 2},        {"COM_DISARM_PRFLT", 10},
    {"COM_DL_LOSS_T", 10, int32}, {"COM_LOW_BAT_ACT", 0, int32}, {"COM_OF_LOSS_T", 1},
    {"COM_RCL_EXCEPT", 0, int32}, {"COM_RC_IN_MODE", 3, int32},  {"EKF2_GPS_CTRL", 7, int32},
    {"EKF2_HGT_REF", 1, int32},   {"FW_AIRSPD_MIN", 10},         {"FW_AIRSPD_TRIM", 15},
    {"FW_T_CLMB_MAX", 5},         {"FW_T_SINK_MAX", 5},          {"GF_ACTION", 2, int32},
    {"GF_MAX_HOR_DIST", 0},       {"GF_MAX_VER_DIST", 0},        {"GND_SPEED_TRIM", 3},
    {"MAV_COMP_ID", 1, int32},    {"MAV_SYS_ID", 1, int32},      {"MAV_TYPE", 2, int32},
    {"MIS_DIST_1WP", 10000},      {"MIS_TAKEOFF_ALT", 2.5F},     {"MIS_TKO_LAND_REQ", 0, int32},
    {"MNT_MODE_IN", 4, int32},    {"MNT_MODE_OUT", 2, int32},    {"MPC_ACC_HOR", 3},
    {"MPC_LAND_SPEED", 0.7F},     {"MPC_XY_CRUISE", 5},          {"MPC_XY_VEL_MAX", 12},
    {"MPC_Z_V_AUTO_DN", 1.5F},    {"MPC_Z_V_AUTO_UP", 3},        {"NAV_ACC_RAD", 10},
    {"NAV_DLL_ACT", 0, int32},    {"NAV_LOITER_RAD", 80},        {"NAV_MC_ALT_RAD", 0.8F},
    {"NAV_RCL_ACT", 2, int32},    {"RTL_DESCEND_ALT", 30},       {"RTL_LAND_DELAY", 0},
    {"RTL_MIN_DIST", 10},         {"RTL_RETURN_ALT", 60},        {"RTL_TYPE", 0, int32},
    {"SDLOG_MODE", 0, int32},     {"SIM_GPS_USED", 10, int32},   {"SYS_AUTOSTART", 4001, int32},
    {"TRIG_INTERFACE", 3, int32},
};

std::span<Default const> common_defaults(Kind const& kind) {
  if (kind.is_px4()) return px4;
  return common;
}

std::span<Default const> own_defaults(Kind const& kind) {
  if (kind.is_px4()) return {};
  auto const family = kind.family;
  if (family == vehicle::Family::plane) return plane;
  if (family == vehicle::Family::rover || family == vehicle::Family::boat) return rover;
  if (family == vehicle::Family::sub) return underwater;
  return copter;
}

}  // namespace

ParameterTable::ParameterTable(Kind const& kind, int system_id) {
  auto const shared = common_defaults(kind);
  auto const own = own_defaults(kind);
  table_.reserve(shared.size() + own.size());
  for (auto const& row : shared) table_.push_back({std::string(row.name), row.value, row.type});
  for (auto const& row : own) table_.push_back({std::string(row.name), row.value, row.type});
  if (!kind.is_px4())
    for (auto const& row : equipment) table_.push_back({std::string(row.name), row.value, row.type});
  // Of two rows of one name the first counts: a family's own goes before what every board has.
  std::ranges::stable_sort(table_, {}, &Parameter::name);
  auto const again = std::ranges::unique(table_, {}, &Parameter::name);
  table_.erase(again.begin(), again.end());
  for (auto& parameter : table_) parameter.standard = parameter.value;
  // No two compasses are alike.
  set("COMPASS_OFS_X", 5.0F + static_cast<float>(system_id));
  set(kind.is_px4() ? "MAV_SYS_ID" : "SYSID_THISMAV", static_cast<float>(system_id));
}

std::optional<std::size_t> ParameterTable::index_of(std::string_view name) const {
  auto const found = std::ranges::lower_bound(table_, name, {}, &Parameter::name);
  if (found == table_.end() || found->name != name) return std::nullopt;
  return static_cast<std::size_t>(found - table_.begin());
}

double ParameterTable::value(std::string_view name, double otherwise) const {
  auto const index = index_of(name);
  return index ? static_cast<double>(table_[*index].value) : otherwise;
}

bool ParameterTable::set(std::string_view name, float value) {
  auto const index = index_of(name);
  if (!index) return false;
  table_[*index].value = value;
  ++revision_;
  return true;
}

namespace {

/// CRC-32 with the common reflected polynomial, begun with 0 and not inverted at the end, as PX4 has it.
std::uint32_t crc_over(std::uint32_t crc, std::span<std::uint8_t const> bytes) {
  constexpr std::uint32_t polynomial = 0xEDB88320U;
  for (auto const byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? crc >> 1U ^ polynomial : crc >> 1U;
  }
  return crc;
}

}  // namespace

std::uint32_t ParameterTable::hash() const {
  std::uint32_t crc = 0;
  for (auto const& parameter : table_) {
    crc = crc_over(crc, {reinterpret_cast<std::uint8_t const*>(parameter.name.data()), parameter.name.size()});
    auto const bits = std::bit_cast<std::array<std::uint8_t, 4>>(bytewise(parameter));
    crc = crc_over(crc, bits);
  }
  return crc;
}

float bytewise(Parameter const& parameter) {
  if (parameter.type == real32) return parameter.value;
  return std::bit_cast<float>(static_cast<std::int32_t>(parameter.value));
}

float from_bytewise(float on_the_wire, mavlink::MavParamType type) {
  if (type == real32) return on_the_wire;
  return static_cast<float>(std::bit_cast<std::int32_t>(on_the_wire));
}

base::Result<ParameterSetting> parse_parameter(std::string_view text) {
  auto const wrong = [&](std::string_view why) {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("parameter '{}' {}", text, why),
                      "write NAME=VALUE, e.g. SR0_POSITION=10");
  };
  auto const equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) return wrong("has no name or no value");
  auto const digits = text.substr(equals + 1);
  ParameterSetting setting{.name = std::string(text.substr(0, equals))};
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), setting.value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(setting.value)) {
    return wrong("has a value that is not a number");
  }
  return setting;
}

}  // namespace lapwing::sim
