#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/time.hpp"

/// A drone's live pictures over HTTP, as JPEG after JPEG (`multipart/x-mixed-replace`): who offers them and who looks.
namespace lapwing::link::pictures {

enum class View : std::uint8_t {
  raw,        ///< as the camera gave it
  annotated,  ///< with what was found drawn in
};

struct Picture {
  std::shared_ptr<std::string const> jpeg;
  base::UtcTime taken;  ///< when the light fell in, by the clock of who offers it
};

/// What of a stream's address says which view it is.
[[nodiscard]] constexpr char const* path_of(View view) {
  return view == View::raw ? "/raw.mjpg" : "/annotated.mjpg";
}

/// Beside the port of a drone's operator link: two drones on one machine do not get each other's pictures.
inline constexpr std::uint16_t ports_above_operator = 80;
inline constexpr std::uint16_t default_port = 3080;
/// The same as video, where browsers offer themselves for it (WHEP).
inline constexpr std::uint16_t whep_ports_above_operator = 180;
inline constexpr std::uint16_t default_whep_port = 3180;

}  // namespace lapwing::link::pictures
