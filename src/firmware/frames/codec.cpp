#include "firmware/frames/codec.hpp"

#include <array>
#include <span>
#include <variant>

#include "firmware/frames/bytes.hpp"

namespace lapwing::firmware {

namespace {

// Fractions of the units, as docs/reference/robot-serial.md has them.
double constexpr milli = 1e3;
double constexpr tenth_milli = 1e4;
double constexpr micro = 1e6;
double constexpr quaternion_one = 30'000;

/// Two turns: more than any heading or rate that means something.
float constexpr largest_turn = 12.6F;
float constexpr largest_speed_m_s = 10.0F;

/// `std::visit` throws for a variant without a value, which none of these can be; so a ladder of its own.
template <class Function, class... T>
void with(std::variant<T...> const& record, Function const& function) {
  auto const try_one = [&](auto const* is) {
    if (is != nullptr) function(*is);
  };
  (try_one(std::get_if<T>(&record)), ...);
}

bool is_within(float value, float limit) {
  return value >= -limit && value <= limit;
}

// ---- description ----

void put(ByteWriter& to, SonarPlace const& sonar) {
  to.quantity<std::int16_t>(sonar.x_m, milli);
  to.quantity<std::int16_t>(sonar.y_m, milli);
  to.quantity<std::int16_t>(sonar.angle_rad, milli);
  to.quantity<std::uint16_t>(sonar.half_cone_rad, milli);
  to.quantity<std::uint16_t>(sonar.longest_m, milli);
}

SonarPlace sonar_place(ByteReader& from) {
  SonarPlace sonar;
  sonar.x_m = from.quantity<std::int16_t>(milli);
  sonar.y_m = from.quantity<std::int16_t>(milli);
  sonar.angle_rad = from.quantity<std::int16_t>(milli);
  sonar.half_cone_rad = from.quantity<std::uint16_t>(milli);
  sonar.longest_m = from.quantity<std::uint16_t>(milli);
  return sonar;
}

void put(ByteWriter& to, LaserPlace const& laser) {
  to.number(laser.beams);
  to.quantity<std::int16_t>(laser.x_m, milli);
  to.quantity<std::int16_t>(laser.y_m, milli);
  to.quantity<std::int32_t>(laser.first_angle_rad, micro);
  to.quantity<std::int32_t>(laser.step_rad, micro);
  to.quantity<std::uint16_t>(laser.longest_m, milli);
  to.quantity<std::uint32_t>(laser.scan_duration_s, micro);
}

LaserPlace laser_place(ByteReader& from) {
  LaserPlace laser;
  laser.beams = from.number<std::uint16_t>();
  laser.x_m = from.quantity<std::int16_t>(milli);
  laser.y_m = from.quantity<std::int16_t>(milli);
  laser.first_angle_rad = from.quantity<std::int32_t>(micro);
  laser.step_rad = from.quantity<std::int32_t>(micro);
  laser.longest_m = from.quantity<std::uint16_t>(milli);
  laser.scan_duration_s = from.quantity<std::uint32_t>(micro);
  return laser;
}

void put(ByteWriter& to, Hello const& hello) {
  auto const& body = hello.description;
  to.number(hello.time.count());
  to.quantity<std::uint32_t>(body.wheel_base_m, micro);
  to.quantity<std::uint32_t>(body.pulses_per_m, milli);
  to.quantity<std::uint16_t>(body.top_speed_m_s, milli);
  to.quantity<std::uint16_t>(body.braking_m_s2, milli);
  to.quantity<std::uint16_t>(body.hull.front_m, milli);
  to.quantity<std::uint16_t>(body.hull.back_m, milli);
  to.quantity<std::uint16_t>(body.hull.half_width_m, milli);
  to.number(body.sonar_count);
  for (auto const& sonar : body.sonar_places()) put(to, sonar);
  put(to, body.laser);
}

bool is_possible(Description const& body) {
  return body.wheel_base_m > 0 && body.pulses_per_m > 0 && body.laser.beams <= most_beams &&
         is_within(body.laser.first_angle_rad, largest_turn) && is_within(body.laser.step_rad, largest_turn);
}

std::optional<FromBoard> hello(ByteReader from) {
  Hello hello;
  auto& body = hello.description;
  hello.time = Time(from.number<std::int64_t>());
  body.wheel_base_m = from.quantity<std::uint32_t>(micro);
  body.pulses_per_m = from.quantity<std::uint32_t>(milli);
  body.top_speed_m_s = from.quantity<std::uint16_t>(milli);
  body.braking_m_s2 = from.quantity<std::uint16_t>(milli);
  body.hull.front_m = from.quantity<std::uint16_t>(milli);
  body.hull.back_m = from.quantity<std::uint16_t>(milli);
  body.hull.half_width_m = from.quantity<std::uint16_t>(milli);
  body.sonar_count = from.number<std::uint8_t>();
  if (body.sonar_count > most_sonars) return std::nullopt;
  for (std::size_t i = 0; i < body.sonar_count; ++i) body.sonars[i] = sonar_place(from);
  body.laser = laser_place(from);
  if (!from.is_whole() || !is_possible(body)) return std::nullopt;
  return hello;
}

// ---- readings ----

template <class T>
void put(ByteWriter& to, Vector3 const& vector, double per_unit) {
  for (float const part : {vector.x, vector.y, vector.z}) to.quantity<T>(part, per_unit);
}

template <class T>
Vector3 vector3(ByteReader& from, double per_unit) {
  Vector3 vector;
  for (float* const part : {&vector.x, &vector.y, &vector.z}) *part = from.quantity<T>(per_unit);
  return vector;
}

/// All zero where there is none: no orientation is.
void put(ByteWriter& to, std::optional<Imu> const& imu) {
  auto const said = imu.value_or(Imu{.orientation = {.w = 0}, .rate_rad_s = {}, .acceleration_m_s2 = {}});
  auto const& turn = said.orientation;
  for (float const part : {turn.w, turn.x, turn.y, turn.z}) to.quantity<std::int16_t>(part, quaternion_one);
  put<std::int32_t>(to, said.rate_rad_s, micro);
  put<std::int16_t>(to, said.acceleration_m_s2, milli);
}

/// False where the quaternion is far from unit length.
bool read_imu(ByteReader& from, std::optional<Imu>& into) {
  Imu imu;
  auto& turn = imu.orientation;
  for (float* const part : {&turn.w, &turn.x, &turn.y, &turn.z}) *part = from.quantity<std::int16_t>(quaternion_one);
  imu.rate_rad_s = vector3<std::int32_t>(from, micro);
  imu.acceleration_m_s2 = vector3<std::int16_t>(from, milli);
  float const length = turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z;
  if (length == 0) return true;
  into = imu;
  return length > 0.9F && length < 1.1F;
}

std::uint8_t constexpr percent_unknown = 0xFF;

void put(ByteWriter& to, Readings const& readings) {
  to.number(readings.time.count());
  to.number(readings.left_pulses);
  to.number(readings.right_pulses);
  put(to, readings.imu);
  to.number(readings.sonar_count);
  for (auto const echo : readings.echoes()) to.number(echo);
  to.number(readings.battery_mv);
  to.number(readings.battery_percent.value_or(percent_unknown));
  to.number(readings.flags);
  to.number(readings.command);
  to.number(readings.completed);
  to.number(readings.left_output_permille);
  to.number(readings.right_output_permille);
}

std::optional<FromBoard> readings(ByteReader from) {
  Readings readings;
  readings.time = Time(from.number<std::int64_t>());
  readings.left_pulses = from.number<std::int32_t>();
  readings.right_pulses = from.number<std::int32_t>();
  bool const is_imu_possible = read_imu(from, readings.imu);
  readings.sonar_count = from.number<std::uint8_t>();
  if (readings.sonar_count > most_sonars || !is_imu_possible) return std::nullopt;
  for (std::size_t i = 0; i < readings.sonar_count; ++i) readings.echoes_us[i] = from.number<std::uint16_t>();
  readings.battery_mv = from.number<std::uint16_t>();
  auto const percent = from.number<std::uint8_t>();
  if (percent <= 100) readings.battery_percent = percent;
  if (percent > 100 && percent != percent_unknown) return std::nullopt;
  readings.flags = from.number<std::uint16_t>();
  readings.command = from.number<std::uint16_t>();
  readings.completed = from.number<std::uint16_t>();
  readings.left_output_permille = from.number<std::int16_t>();
  readings.right_output_permille = from.number<std::int16_t>();
  if (!from.is_whole()) return std::nullopt;
  return readings;
}

// ---- laser, completed, log ----

void put(ByteWriter& to, LaserPiece const& piece) {
  to.number(piece.time.count());
  to.quantity<std::int32_t>(piece.first_angle_rad, micro);
  to.quantity<std::int32_t>(piece.step_rad, micro);
  to.number(piece.beams);
  to.number(piece.begin);
  to.number(piece.count);
  for (auto const range : piece.ranges()) to.number(range);
}

std::optional<FromBoard> laser_piece(ByteReader from) {
  LaserPiece piece;
  piece.time = Time(from.number<std::int64_t>());
  piece.first_angle_rad = from.quantity<std::int32_t>(micro);
  piece.step_rad = from.quantity<std::int32_t>(micro);
  piece.beams = from.number<std::uint16_t>();
  piece.begin = from.number<std::uint16_t>();
  piece.count = from.number<std::uint8_t>();
  if (piece.count == 0 || piece.count > most_piece_ranges) return std::nullopt;
  for (std::size_t i = 0; i < piece.count; ++i) piece.ranges_mm[i] = from.number<std::uint16_t>();
  bool const is_inside = piece.beams <= most_beams && piece.begin + piece.count <= piece.beams;
  if (!from.is_whole() || !is_inside || !is_within(piece.first_angle_rad, largest_turn) ||
      !is_within(piece.step_rad, largest_turn))
    return std::nullopt;
  return piece;
}

void put(ByteWriter& to, Completed const& completed) {
  to.number(completed.number);
}

std::optional<FromBoard> completed(ByteReader from) {
  Completed const completed{.number = from.number<std::uint16_t>()};
  if (!from.is_whole() || completed.number == 0) return std::nullopt;
  return completed;
}

void put(ByteWriter& to, Log const& log) {
  to.number(log.time.count());
  to.number(static_cast<std::uint16_t>(log.code));
  to.number(log.value);
}

std::optional<FromBoard> log(ByteReader from) {
  Log log;
  log.time = Time(from.number<std::int64_t>());
  log.code = static_cast<LogCode>(from.number<std::uint16_t>());
  log.value = from.number<std::int32_t>();
  if (!from.is_whole()) return std::nullopt;
  return log;
}

// ---- from the host ----

void put(ByteWriter& to, Drive const& drive) {
  to.number(drive.number);
  to.quantity<std::int16_t>(drive.speed_m_s, milli);
  to.number(static_cast<std::uint8_t>(drive.by));
  to.quantity<std::int32_t>(drive.turn, micro);
}

std::optional<FromHost> drive(ByteReader from) {
  Drive drive;
  drive.number = from.number<std::uint16_t>();
  drive.speed_m_s = from.quantity<std::int16_t>(milli);
  auto const by = from.number<std::uint8_t>();
  drive.by = static_cast<Drive::By>(by);
  drive.turn = from.quantity<std::int32_t>(micro);
  if (!from.is_whole() || drive.number == 0 || by > 1 || !is_within(drive.speed_m_s, largest_speed_m_s) ||
      !is_within(drive.turn, largest_turn))
    return std::nullopt;
  return drive;
}

void put(ByteWriter& to, Turn const& turn) {
  to.number(turn.number);
  to.quantity<std::int32_t>(turn.heading_rad, micro);
}

std::optional<FromHost> turn(ByteReader from) {
  Turn turn;
  turn.number = from.number<std::uint16_t>();
  turn.heading_rad = from.quantity<std::int32_t>(micro);
  if (!from.is_whole() || turn.number == 0 || !is_within(turn.heading_rad, largest_turn)) return std::nullopt;
  return turn;
}

void put(ByteWriter& to, Stop const& stop) {
  to.number(stop.number);
}

std::optional<FromHost> stop(ByteReader from) {
  Stop const stop{.number = from.number<std::uint16_t>()};
  if (!from.is_whole() || stop.number == 0) return std::nullopt;
  return stop;
}

template <class T>
std::optional<FromHost> nothing_but(T record, ByteReader from) {
  if (!from.is_whole()) return std::nullopt;
  return record;
}

void put(ByteWriter&, Hail const&) {}
void put(ByteWriter&, Kill const&) {}
void put(ByteWriter&, Release const&) {}
void put(ByteWriter&, Alive const&) {}

FrameType constexpr type_of(Hello const&) {
  return FrameType::hello;
}
FrameType constexpr type_of(Readings const&) {
  return FrameType::readings;
}
FrameType constexpr type_of(LaserPiece const&) {
  return FrameType::laser;
}
FrameType constexpr type_of(Completed const&) {
  return FrameType::completed;
}
FrameType constexpr type_of(Log const&) {
  return FrameType::log;
}
FrameType constexpr type_of(Hail const&) {
  return FrameType::hail;
}
FrameType constexpr type_of(Drive const&) {
  return FrameType::drive;
}
FrameType constexpr type_of(Turn const&) {
  return FrameType::turn;
}
FrameType constexpr type_of(Stop const&) {
  return FrameType::stop;
}
FrameType constexpr type_of(Kill const&) {
  return FrameType::kill;
}
FrameType constexpr type_of(Release const&) {
  return FrameType::release;
}
FrameType constexpr type_of(Alive const&) {
  return FrameType::alive;
}

template <class Record>
FrameBytes write_any(Record const& record, std::uint8_t sequence) {
  std::array<std::uint8_t, longest_payload> payload{};
  ByteWriter writer(payload);
  FrameType type{};
  with(record, [&](auto const& what) {
    type = type_of(what);
    put(writer, what);
  });
  return write_frame({.type = static_cast<std::uint8_t>(type),
                      .sequence = sequence,
                      .payload = std::span<std::uint8_t const>(payload).first(writer.size())});
}

}  // namespace

FrameBytes write(FromBoard const& record, std::uint8_t sequence) {
  return write_any(record, sequence);
}

FrameBytes write(FromHost const& record, std::uint8_t sequence) {
  return write_any(record, sequence);
}

std::optional<FromBoard> read_from_board(Packet const& packet) {
  ByteReader const from(packet.payload);
  switch (static_cast<FrameType>(packet.type)) {
    case FrameType::hello: return hello(from);
    case FrameType::readings: return readings(from);
    case FrameType::laser: return laser_piece(from);
    case FrameType::completed: return completed(from);
    case FrameType::log: return log(from);
    default: return std::nullopt;
  }
}

std::optional<FromHost> read_from_host(Packet const& packet) {
  ByteReader const from(packet.payload);
  switch (static_cast<FrameType>(packet.type)) {
    case FrameType::hail: return nothing_but(Hail{}, from);
    case FrameType::drive: return drive(from);
    case FrameType::turn: return turn(from);
    case FrameType::stop: return stop(from);
    case FrameType::kill: return nothing_but(Kill{}, from);
    case FrameType::release: return nothing_but(Release{}, from);
    case FrameType::alive: return nothing_but(Alive{}, from);
    default: return std::nullopt;
  }
}

}  // namespace lapwing::firmware
